//! The runs with the largest and the least values of a figure.

/// The extreme runs of a figure: value and run.
#[derive(Clone, Debug, Default)]
pub struct Extremes<R> {
    /// Number of runs at each end.
    count: usize,
    /// Largest first; equal ones by index.
    pub worst: Vec<(f64, R)>,
    /// Least first.
    pub best: Vec<(f64, R)>,
}

impl<R: Clone> Extremes<R> {
    /// The worst so many; none yet.
    pub fn new(count: usize) -> Self {
        Extremes { count, worst: Vec::new(), best: Vec::new() }
    }

    /// Considers the next run. A run without a value is skipped.
    pub fn see(&mut self, run: &R, value: f64) {
        if value.is_finite() {
            put(&mut self.worst, (value, run), self.count, |a, b| a > b);
            put(&mut self.best, (value, run), self.count, |a, b| a < b);
        }
    }
}

fn put<R: Clone>(list: &mut Vec<(f64, R)>, new: (f64, &R), count: usize, before: impl Fn(f64, f64) -> bool) {
    let at = list.partition_point(|old| !before(new.0, old.0));
    if at < count {
        list.insert(at, (new.0, new.1.clone()));
        list.truncate(count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_found_and_ties_keep_their_order() {
        let mut extremes = Extremes::new(3);
        for (run, value) in [3.0, f64::NAN, 7.0, 1.0, 7.0, 2.0, 9.0].into_iter().enumerate() {
            extremes.see(&(run as u64), value);
        }
        assert_eq!(extremes.worst, [(9.0, 6), (7.0, 2), (7.0, 4)]);
        assert_eq!(extremes.best, [(1.0, 3), (2.0, 5), (3.0, 0)]);
    }
}
