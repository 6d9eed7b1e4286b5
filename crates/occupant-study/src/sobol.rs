//! Sobol's sequence by index, plain or with nested uniform scrambling.
//!
//! I. M. Sobol' (1967); direction numbers by Joe and Kuo; point n is that of the Gray code of n, the order in which the
//! sequence is published (I. A. Antonov, V. M. Saleev 1979). Scrambling: A. B. Owen, "Randomly permuted (t,m,s)-nets and
//! (t,s)-sequences" (1995): every bit is flipped by a random bit of its own dimension and of all bits above it. The first
//! 2^m points of a dimension then still fall one into each of 2^m equal intervals.

use super::direction_numbers::DIRECTIONS;
use super::random::{Purpose, bits, open_unit};

/// Binary digits of a coordinate.
pub(super) const BITS: u32 = 52;

/// Number of dimensions with known direction numbers.
pub(super) const MAX_DIMENSIONS: usize = DIRECTIONS.len() + 1;

/// The direction numbers of one dimension, v₁ first, as 52-bit integers.
type Directions = [u64; BITS as usize];

/// Direction numbers of the first dimensions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Sobol {
    directions: Vec<Directions>,
}

impl Sobol {
    /// Directions of this many dimensions, at most [`MAX_DIMENSIONS`].
    pub(super) fn new(dimensions: usize) -> Self {
        let first = std::array::from_fn(|i| 1 << (BITS as usize - 1 - i));
        let others = DIRECTIONS.iter().map(|(a, m)| directions(*a, m));
        Sobol { directions: std::iter::once(first).chain(others).take(dimensions).collect() }
    }

    /// A coordinate as a 52-bit integer; 0 for a dimension that was not asked for.
    pub(super) fn integer(&self, index: u64, dimension: usize) -> u64 {
        let gray = index ^ (index >> 1);
        let Some(directions) = self.directions.get(dimension) else { return 0 };
        let set = directions.iter().enumerate().filter(|(i, _)| gray >> i & 1 == 1);
        set.fold(0, |x, (_, v)| x ^ v)
    }

    /// A coordinate in (0, 1): the midpoint of its interval of 2⁻⁵².
    pub(super) fn plain(&self, index: u64, dimension: usize) -> f64 {
        open_unit(self.integer(index, dimension))
    }

    /// A scrambled coordinate in (0, 1).
    pub(super) fn scrambled(&self, index: u64, dimension: usize, seed: u64) -> f64 {
        open_unit(scramble(self.integer(index, dimension), seed, dimension as u32))
    }
}

/// Recurrence of Bratley and Fox (1988): mᵢ = 2a₁mᵢ₋₁ ⊕ 2²a₂mᵢ₋₂ ⊕ … ⊕ 2ˢmᵢ₋ₛ ⊕ mᵢ₋ₛ, written for vᵢ = mᵢ·2^(52−i).
fn directions(a: u32, m: &[u32]) -> Directions {
    let s = m.len();
    let mut v = [0_u64; BITS as usize];
    for i in 0..v.len() {
        v[i] = match m.get(i) {
            Some(m) => u64::from(*m) << (BITS as usize - 1 - i),
            None => {
                let inner = (1..s).filter(|k| a >> (s - 1 - k) & 1 == 1);
                inner.fold(v[i - s] ^ (v[i - s] >> s), |x, k| x ^ v[i - k])
            }
        };
    }
    v
}

/// Scrambles each bit by a random bit that depends on the bits above it.
fn scramble(x: u64, seed: u64, dimension: u32) -> u64 {
    (0..BITS).fold(0, |done, level| {
        let at = BITS - 1 - level;
        // the unscrambled bits above, as the node of the tree of intervals
        let node = x >> (at + 1);
        let flip = bits(seed, Purpose::Scramble, node, dimension, level as u8) & 1;
        done | ((x >> at & 1) ^ flip) << at
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONE: u64 = 1 << BITS;

    /// The first ten points of ten dimensions as Joe and Kuo print them with their program (`sobol.cc`).
    #[test]
    #[rustfmt::skip]
    fn begins_as_published() {
        let published: [[f64; 10]; 10] = [
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5],
            [0.75, 0.25, 0.25, 0.25, 0.75, 0.75, 0.25, 0.75, 0.75, 0.75],
            [0.25, 0.75, 0.75, 0.75, 0.25, 0.25, 0.75, 0.25, 0.25, 0.25],
            [0.375, 0.375, 0.625, 0.875, 0.375, 0.125, 0.375, 0.875, 0.875, 0.625],
            [0.875, 0.875, 0.125, 0.375, 0.875, 0.625, 0.875, 0.375, 0.375, 0.125],
            [0.625, 0.125, 0.875, 0.625, 0.625, 0.875, 0.125, 0.125, 0.125, 0.375],
            [0.125, 0.625, 0.375, 0.125, 0.125, 0.375, 0.625, 0.625, 0.625, 0.875],
            [0.1875, 0.3125, 0.9375, 0.4375, 0.5625, 0.3125, 0.4375, 0.9375, 0.9375, 0.3125],
            [0.6875, 0.8125, 0.4375, 0.9375, 0.0625, 0.8125, 0.9375, 0.4375, 0.4375, 0.8125],
        ];
        let sobol = Sobol::new(10);
        for (n, point) in published.iter().enumerate() {
            for (d, x) in point.iter().enumerate() {
                assert_eq!(sobol.integer(n as u64, d) as f64 / ONE as f64, *x, "point {n}, {d}");
            }
        }
    }

    /// Points far out, computed by SciPy 1.17 (`scipy.stats.qmc.Sobol`, unscrambled).
    #[test]
    fn agrees_with_another_program_in_high_dimensions() {
        let sobol = Sobol::new(MAX_DIMENSIONS);
        for (n, d, x) in [
            (100, 20, 0.757_812_5),
            (100, 59, 0.164_062_5),
            (1000, 99, 0.186_523_437_5),
            (2047, 127, 0.021_972_656_25),
            (4095, 159, 0.094_482_421_875),
            (3333, 140, 0.851_806_640_625),
        ] {
            assert_eq!(sobol.integer(n, d) as f64 / ONE as f64, x, "point {n}, {d}");
        }
    }

    /// In every dimension each run of 2^m points has one in each of 2^m equal intervals, scrambled or not.
    #[test]
    fn every_dimension_is_a_net() {
        let sobol = Sobol::new(MAX_DIMENSIONS);
        for (m, start) in [(6, 0), (6, 64), (8, 256)] {
            let n = 1_u64 << m;
            for d in 0..MAX_DIMENSIONS {
                let (mut plain, mut scrambled) = (vec![0; n as usize], vec![0; n as usize]);
                for i in start..start + n {
                    plain[(sobol.plain(i, d) * n as f64) as usize] += 1;
                    scrambled[(sobol.scrambled(i, d, 99) * n as f64) as usize] += 1;
                }
                assert!(plain.iter().all(|c| *c == 1), "dimension {d}");
                assert!(scrambled.iter().all(|c| *c == 1), "dimension {d}, scrambled");
            }
        }
    }

    /// The first two dimensions are a (0, m, 2)-net: one point in each box of area 2^−m, whatever its sides.
    #[test]
    fn two_dimensions_fill_boxes_of_every_shape() {
        let sobol = Sobol::new(2);
        let m = 8;
        for across in 0..=m {
            let (nx, ny) = (1_u64 << across, 1_u64 << (m - across));
            let mut plain = vec![0; 1 << m];
            let mut scrambled = vec![0; 1 << m];
            for i in 0..1 << m {
                let cell = |x: f64, y: f64| (x * nx as f64) as usize * ny as usize + (y * ny as f64) as usize;
                plain[cell(sobol.plain(i, 0), sobol.plain(i, 1))] += 1;
                scrambled[cell(sobol.scrambled(i, 0, 5), sobol.scrambled(i, 1, 5))] += 1;
            }
            assert!(plain.iter().chain(&scrambled).all(|c| *c == 1), "{nx} by {ny}");
        }
    }

    /// Over many seeds a scrambled point is anywhere: its mean is ½ and its variance 1/12.
    #[test]
    fn a_scrambled_point_is_uniform_over_the_seeds() {
        let sobol = Sobol::new(3);
        let n = 20_000;
        let x: Vec<f64> = (0..n).map(|seed| sobol.scrambled(5, 2, seed)).collect();
        let mean = x.iter().sum::<f64>() / n as f64;
        let variance = x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n as f64;
        // standard errors: 0.0020 and 0.0005
        assert!((mean - 0.5).abs() < 0.008, "{mean}");
        assert!((variance - 1.0 / 12.0).abs() < 0.002, "{variance}");
    }
}
