//! The samples with the greatest values of a figure; of equals the first.

use std::cmp::Ordering;

/// The samples with the greatest values so far.
#[derive(Clone, Debug)]
pub(crate) struct Worst {
    count: usize,
    /// Greatest first.
    found: Vec<(f64, u64)>,
}

impl Worst {
    pub(crate) fn new(count: usize) -> Self {
        Worst { count, found: Vec::new() }
    }

    /// Looks at a sample; samples come in order.
    pub(crate) fn see(&mut self, value: f64, index: u64) {
        let not_less = |(v, _): &(f64, u64)| v.total_cmp(&value) != Ordering::Less;
        let at = self.found.partition_point(not_less);
        if at < self.count {
            self.found.insert(at, (value, index));
            self.found.truncate(self.count);
        }
    }

    /// Their numbers, greatest value first.
    pub(crate) fn indices(&self) -> Vec<u64> {
        self.found.iter().map(|(_, index)| *index).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_are_the_greatest_and_of_equals_the_first() {
        let mut worst = Worst::new(3);
        for (index, value) in [1.0, 5.0, 3.0, 5.0, 3.0, 0.0].into_iter().enumerate() {
            worst.see(value, index as u64);
        }
        assert_eq!(worst.indices(), [1, 3, 2]);
    }
}
