//! Random numbers by address: the number at (seed, purpose, index, dimension) is always the same, in any order of
//! requests.
//!
//! Philox 4×32-10, a block cipher weakened for speed: the address is the counter, the seed the key. J. K. Salmon,
//! M. A. Moraes, R. O. Dror, D. E. Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11 (2011); it passes TestU01's
//! BigCrush. A generator with a state would have to be wound forward to every sample; this one has none.

/// Purpose of random numbers, so that no two uses share a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(super) enum Purpose {
    /// Monte Carlo samples.
    MonteCarlo = 1,
    /// Position within a stratum of a Latin hypercube.
    Jitter = 2,
    /// Rounds of a keyed permutation.
    Permutation = 3,
    /// Scrambling of Sobol's points.
    Scramble = 4,
    /// Start of a Morris trajectory.
    Morris = 5,
    /// Members of an ensemble.
    Ensemble = 6,
    /// Rows of a resample.
    Bootstrap = 7,
    /// Errors of the sensors of a record.
    SensorErrors = 8,
    /// Points of a search.
    Search = 16,
    /// Coordinates and descents of a search with a model.
    Model = 17,
}

/// 64 random bits for an address; `round` tells apart several draws of one dimension.
pub(super) fn bits(seed: u64, purpose: Purpose, index: u64, dimension: u32, round: u8) -> u64 {
    let key = [seed as u32, (seed >> 32) as u32];
    let last = (purpose as u32) << 8 | u32::from(round);
    let [a, b, ..] = philox([index as u32, (index >> 32) as u32, dimension, last], key);
    u64::from(b) << 32 | u64::from(a)
}

/// A random number in (0, 1), neither end included, with 52 bits: (k + ½)/2⁵².
pub(super) fn unit(seed: u64, purpose: Purpose, index: u64, dimension: u32) -> f64 {
    open_unit(bits(seed, purpose, index, dimension, 0) >> 12)
}

/// A random number in (0, 1) of a resample, a pure function of its address.
pub fn of_resample(index: u64, dimension: u32) -> f64 {
    unit(0, Purpose::Bootstrap, index, dimension)
}

/// One of `of` numbers from 0, chosen at random for a stretch of something counted.
pub fn of_stretch(seed: u64, stretch: u64, of: u64) -> u64 {
    bits(seed, Purpose::Bootstrap, stretch, u32::MAX, 1) % of.max(1)
}

/// (k + ½)/2⁵² of the lower 52 bits: exact, never 0 or 1.
pub(super) fn open_unit(k: u64) -> f64 {
    const SCALE: f64 = 1.0 / (1_u64 << 52) as f64;
    ((k & ((1 << 52) - 1)) as f64 + 0.5) * SCALE
}

/// Ten rounds of Philox on four words.
fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for round in 0..10 {
        if round > 0 {
            key[0] = key[0].wrapping_add(0x9E37_79B9);
            key[1] = key[1].wrapping_add(0xBB67_AE85);
        }
        let p0 = u64::from(counter[0]) * 0xD251_1F53;
        let p1 = u64::from(counter[2]) * 0xCD9E_8D57;
        counter =
            [(p1 >> 32) as u32 ^ counter[1] ^ key[0], p1 as u32, (p0 >> 32) as u32 ^ counter[3] ^ key[1], p0 as u32];
    }
    counter
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Known answers published with the authors' own implementation (Random123, `kat_vectors`).
    #[test]
    fn gives_the_published_answers() {
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox([u32::MAX; 4], [u32::MAX; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        assert_eq!(
            philox([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }

    #[test]
    fn a_unit_number_is_never_an_end() {
        assert!(open_unit(0) > 0.0);
        assert!(open_unit(u64::MAX) < 1.0);
    }
}
