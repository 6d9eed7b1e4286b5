//! A random permutation of 0…n−1 by index: no table, whatever n is.
//!
//! A Feistel network on the next even number of bits is a permutation of 4^b ≥ n numbers; walking along its cycle until
//! a number below n appears makes it one of n (J. Black, P. Rogaway, "Ciphers with arbitrary finite domains", CT-RSA
//! 2002). As 4^b < 4n, a walk takes four steps on average at
//! most, for small n as many as 256/n.

use super::random::{Purpose, bits};

/// Rounds of the Feistel network: four make it pseudorandom for large halves (Luby, Rackoff 1988), small ones need
/// more.
const ROUNDS: u8 = 8;

/// Least number of bits of a half. With two bits a network reaches only some permutations, whatever its rounds: the
/// orders of five things are then unevenly likely (χ² of 300 with 119 degrees of freedom; 118 with four bits).
const LEAST_HALF_BITS: u32 = 4;

/// Image of `index` under the permutation of 0…n−1 given by seed and stream; `index` itself if it is not below n.
pub(super) fn permute(index: u64, n: u64, seed: u64, stream: u32) -> u64 {
    if index >= n {
        return index;
    }
    let half = half_bits(n);
    let mut x = index;
    loop {
        x = feistel(x, half, seed, stream);
        if x < n {
            return x;
        }
    }
}

/// Bits b of a half, the least with 4^b ≥ n.
fn half_bits(n: u64) -> u32 {
    let bits = u64::BITS - n.saturating_sub(1).leading_zeros();
    bits.div_ceil(2).max(LEAST_HALF_BITS)
}

fn feistel(x: u64, half: u32, seed: u64, stream: u32) -> u64 {
    let mask = u64::MAX >> (u64::BITS - half);
    let (mut left, mut right) = (x >> half, x & mask);
    for round in 0..ROUNDS {
        let f = bits(seed, Purpose::Permutation, right, stream, round) & mask;
        (left, right) = (right, left ^ f);
    }
    left << half | right
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_appears_exactly_once() {
        for n in [1, 2, 3, 5, 16, 17, 100, 1000, 1023, 4099] {
            for seed in 0..3 {
                let mut seen = vec![false; n as usize];
                for i in 0..n {
                    seen[permute(i, n, seed, 7) as usize] = true;
                }
                assert!(seen.iter().all(|s| *s), "n = {n}, seed {seed}");
            }
        }
    }

    /// All 120 orders of five things appear about equally often: χ² with 119 degrees of freedom.
    #[test]
    fn all_orders_of_a_few_things_are_equally_likely() {
        let mut counts = std::collections::HashMap::new();
        let draws = 24_000;
        for seed in 0..draws {
            let order: Vec<u64> = (0..5).map(|i| permute(i, 5, seed, 0)).collect();
            *counts.entry(order).or_insert(0_u32) += 1;
        }
        let mean = draws as f64 / 120.0;
        let chi2: f64 = counts.values().map(|c| (f64::from(*c) - mean).powi(2) / mean).sum();
        assert_eq!(counts.len(), 120);
        // 99.9 % of truly random tables are below 173.6; measured: 115.2
        assert!(chi2 < 173.6, "{chi2}");
    }

    #[test]
    fn very_many_things_are_no_trouble() {
        for n in [u64::MAX, 1 << 52, (1 << 62) + 1] {
            assert!(permute(n - 1, n, 1, 1) < n);
        }
    }
}
