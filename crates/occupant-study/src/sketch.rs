//! Quantiles of a stream in bounded memory: exact up to a number of values, beyond it within a known error.
//!
//! Values are kept in levels; one of level h stands for 2^h. A full level is sorted, and every other value of it moves to the
//! next: J. I. Munro, M. S. Paterson, Theor. Comput. Sci. 12 (1980); G. S. Manku et al., SIGMOD (1998). Which ones move
//! alternates, so that most errors cancel. The same values in the same order give the same bits.

/// Values of which quantiles are wanted.
#[derive(Clone, Debug, Default)]
pub struct Sketch {
    /// Largest number of values of a level; without a limit all values are kept.
    capacity: Option<usize>,
    /// Values by level.
    levels: Vec<Level>,
    count: usize,
    missing: usize,
    ends: [f64; 2],
    /// Limits, and how many values exceed each: these counts are exact.
    above: Vec<(f64, usize)>,
}

#[derive(Clone, Debug, Default)]
struct Level {
    values: Vec<f64>,
    /// Whether the next to move are those at odd places.
    is_odd: bool,
}

impl Sketch {
    /// One that keeps all values until there are `capacity`, and about `capacity` for each doubling beyond.
    pub fn new(capacity: usize) -> Self {
        Sketch { capacity: Some(capacity.max(2)), ..Sketch::exact(&[]) }
    }

    /// One that keeps these values, and all others that it sees.
    pub fn exact(values: &[f64]) -> Self {
        let mut sketch = Sketch { ends: [f64::INFINITY, f64::NEG_INFINITY], ..Sketch::default() };
        values.iter().for_each(|value| sketch.see(*value));
        sketch
    }

    /// Also counts the values above these limits.
    pub fn counting(self, limits: impl IntoIterator<Item = f64>) -> Self {
        Sketch { above: limits.into_iter().map(|limit| (limit, 0)).collect(), ..self }
    }

    /// Adds a value; one that is not finite is missing.
    pub fn see(&mut self, value: f64) {
        if !value.is_finite() {
            self.missing += 1;
            return;
        }
        self.count += 1;
        self.ends = [self.ends[0].min(value), self.ends[1].max(value)];
        self.above.iter_mut().for_each(|(limit, count)| *count += usize::from(value > *limit));
        self.put(0, value);
    }

    fn put(&mut self, level: usize, value: f64) {
        if self.levels.len() == level {
            self.levels.push(Level::default());
        }
        self.levels[level].values.push(value);
        if self.capacity.is_some_and(|capacity| self.levels[level].values.len() >= capacity + capacity % 2) {
            let moved = self.levels[level].halve();
            moved.into_iter().for_each(|value| self.put(level + 1, value));
        }
    }

    /// Forgets all values.
    pub fn clear(&mut self) {
        let empty = Sketch { capacity: self.capacity, ..Sketch::exact(&[]) };
        *self = empty.counting(std::mem::take(&mut self.above).into_iter().map(|(limit, _)| limit));
    }

    /// Number of finite values.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Number of values that are not finite.
    pub fn missing(&self) -> usize {
        self.missing
    }

    /// Least and greatest value.
    pub fn ends(&self) -> Option<[f64; 2]> {
        (self.count > 0).then_some(self.ends)
    }

    /// Whether the values differ by more than rounding.
    pub fn varies(&self) -> bool {
        let [low, high] = self.ends;
        high - low > 1e-12 * low.abs().max(high.abs())
    }

    /// Number of values above a limit: exact if all values are kept, or if the limit was announced.
    pub fn above(&self, limit: f64) -> usize {
        let counted = self.above.iter().find(|(known, _)| *known == limit);
        counted.map_or_else(|| self.ordered().above(limit), |(_, count)| *count)
    }

    /// Largest error of a rank, as a fraction of all values: 0 while all are kept. Each level has been halved at most
    /// n/(capacity·2^h) times, each time with an error of at most 2^h.
    pub fn error(&self) -> f64 {
        let halved = self.levels.len().saturating_sub(1) as f64;
        self.capacity.map_or(0.0, |capacity| halved / capacity as f64)
    }

    /// Its values in order.
    pub fn ordered(&self) -> Ordered {
        if self.levels.len() < 2 {
            return Ordered::of(self.levels.first().map_or(&[], |level| &level.values));
        }
        let weighted = self.levels.iter().enumerate();
        let mut all: Vec<(f64, usize)> =
            weighted.flat_map(|(h, level)| level.values.iter().map(move |value| (*value, 1 << h))).collect();
        all.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        // the ends are known
        if let ([first, .., last], [least, greatest]) = (&mut all[..], self.ends) {
            (first.0, last.0) = (least, greatest);
        }
        let mut upto = 0;
        let count = |(_, weight): &(f64, usize)| {
            upto += weight;
            upto
        };
        Ordered { upto: all.iter().map(count).collect(), values: all.into_iter().map(|(value, _)| value).collect() }
    }
}

impl Level {
    /// Empties it; every other value in order.
    fn halve(&mut self) -> Vec<f64> {
        self.values.sort_unstable_by(f64::total_cmp);
        let skipped = usize::from(self.is_odd);
        self.is_odd = !self.is_odd;
        let moved = self.values.iter().copied().skip(skipped).step_by(2).collect();
        self.values.clear();
        moved
    }
}

/// Numbers in increasing order, each of which stands for one or more.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ordered {
    values: Vec<f64>,
    /// Number of values up to and with each; empty if each stands for one.
    upto: Vec<usize>,
}

impl Ordered {
    /// The finite ones of these numbers.
    pub fn of(values: &[f64]) -> Self {
        Ordered { values: sorted(values), upto: Vec::new() }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.upto.last().copied().unwrap_or(self.values.len())
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// The greatest.
    pub fn greatest(&self) -> Option<f64> {
        self.values.last().copied()
    }

    /// Each number with how many there are up to and with it.
    pub fn steps(&self) -> impl Iterator<Item = (f64, usize)> {
        self.values.iter().enumerate().map(|(i, value)| (*value, self.upto.get(i).copied().unwrap_or(i + 1)))
    }

    /// The number at a place from 0, below their count.
    pub(crate) fn at(&self, place: usize) -> f64 {
        match self.upto.is_empty() {
            true => self.values[place],
            false => self.values[self.upto.partition_point(|upto| *upto <= place)],
        }
    }

    /// Quantile `p`, as [`quantile`](crate::spread::quantile); there must be a number.
    pub(crate) fn quantile(&self, p: f64) -> f64 {
        if self.upto.is_empty() {
            return quantile_of_sorted(&self.values, p);
        }
        let place = (self.len() - 1) as f64 * p.clamp(0.0, 1.0);
        let below = place.floor() as usize;
        let pair = [below, (below + 1).min(self.len() - 1)].map(|place| self.at(place));
        quantile_of_sorted(&pair, place - below as f64)
    }

    fn above(&self, limit: f64) -> usize {
        let first = self.values.partition_point(|value| *value <= limit);
        let upto = first.checked_sub(1).map_or(0, |last| self.upto.get(last).copied().unwrap_or(first));
        self.len() - upto
    }
}

/// The finite numbers in increasing order.
pub fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted
}

/// Quantile `p` of sorted numbers, of which there must be one.
pub(crate) fn quantile_of_sorted(sorted: &[f64], p: f64) -> f64 {
    let place = (sorted.len() - 1) as f64 * p.clamp(0.0, 1.0);
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    let part = place - below as f64;
    if part == 0.0 || sorted[below] == sorted[above] {
        sorted[below]
    } else {
        sorted[below] * (1.0 - part) + sorted[above] * part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, unit};
    use crate::spread::quantile;

    fn draws(n: u64) -> impl Iterator<Item = f64> {
        (0..n).map(|i| unit(5, Purpose::MonteCarlo, i, 0))
    }

    /// Rank of a value among even ones in [0, 1) is the value itself.
    #[test]
    fn quantiles_are_within_the_error_that_it_states_in_any_order_of_the_values() {
        let n = 200_000_u64;
        let even = |i: u64| i as f64 / n as f64;
        let orders: [Box<dyn Fn(u64) -> f64>; 4] = [
            Box::new(even),
            Box::new(move |i| even(n - 1 - i)),
            Box::new(move |i| even((i * 7919) % n)),
            Box::new(move |i| even(if i.is_multiple_of(2) { i / 2 } else { n - 1 - i / 2 })),
        ];
        for order in orders {
            let mut sketch = Sketch::new(1024);
            (0..n).for_each(|i| sketch.see(order(i)));
            let ordered = sketch.ordered();
            assert_eq!((sketch.len(), ordered.len()), (n as usize, n as usize));
            let furthest = (0..=1000).map(|i| f64::from(i) / 1000.0).map(|p| (ordered.quantile(p) - p).abs());
            let furthest = furthest.fold(0.0, f64::max);
            // stated: 8 of 1024 = 0.0078; measured: at most 0.0018
            assert!(furthest <= sketch.error() && sketch.error() < 0.01, "{furthest} {}", sketch.error());
        }
    }

    #[test]
    fn few_values_are_kept_as_they_are() {
        let values: Vec<f64> = draws(999).collect();
        let mut sketch = Sketch::new(1000).counting([0.25]);
        values.iter().chain(&[f64::NAN, f64::INFINITY]).for_each(|value| sketch.see(*value));
        assert_eq!((sketch.ordered(), sketch.error()), (Ordered::of(&values), 0.0));
        assert_eq!((sketch.len(), sketch.missing()), (999, 2));
        for p in [0.0, 0.05, 0.5, 1.0] {
            assert_eq!(Some(sketch.ordered().quantile(p)), quantile(&values, p));
        }
        for limit in [0.25, 0.75, -1.0, 2.0] {
            assert_eq!(sketch.above(limit), values.iter().filter(|value| **value > limit).count());
        }
    }

    /// A level holds `capacity` values, and there is one for each doubling.
    #[test]
    fn its_size_grows_with_the_logarithm_of_the_values() {
        let mut sketch = Sketch::new(64).counting([0.9]);
        let held = |sketch: &Sketch| sketch.levels.iter().map(|level| level.values.capacity()).sum::<usize>();
        let mut sizes = Vec::new();
        for (i, value) in draws(1 << 18).enumerate() {
            sketch.see(value);
            if (i + 1).is_power_of_two() && i > 1 << 12 {
                sizes.push(held(&sketch));
            }
        }
        assert!(sizes.windows(2).all(|pair| pair[1] <= pair[0] + 2 * 64), "{sizes:?}");
        let above = draws(1 << 18).filter(|value| *value > 0.9).count();
        assert_eq!(sketch.above(0.9), above, "announced limits are counted exactly");
        assert_eq!(sketch.ends().map(|[low, _]| low), draws(1 << 18).reduce(f64::min));
        sketch.clear();
        assert!(sketch.is_empty() && sketch.above(0.9) == 0 && sketch.ends().is_none() && !sketch.varies());
    }
}
