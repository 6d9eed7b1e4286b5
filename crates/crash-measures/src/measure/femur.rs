//! Femur axial force against a limit that falls with duration.
//!
//! UN R94 draws the limit from 9.07 kN at 0 ms to 7.58 kN at 10 ms and level beyond. The text was not
//! read; whether durations count contiguously or in total is not known here, so they count in total,
//! which is never the milder reading.

use super::peak::maximum;
use super::three_ms::{Counting, Heights};
use crate::signal::SignalError;

/// A limit that falls linearly with duration and then stays.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DurationLimit {
    /// Limit at zero duration.
    pub at_once: f64,
    /// Limit at `settled_s` and longer.
    pub settled: f64,
    /// Duration from which the limit is level, s.
    pub settled_s: f64,
}

impl DurationLimit {
    /// Femur compression of UN R94, N.
    pub const FEMUR_R94_N: Self = Self { at_once: 9070.0, settled: 7580.0, settled_s: 0.010 };

    /// The limit for a load of duration `duration_s`.
    #[must_use]
    pub fn at(&self, duration_s: f64) -> f64 {
        let part = (duration_s / self.settled_s).clamp(0.0, 1.0);
        self.at_once + (self.settled - self.at_once) * part
    }
}

/// The duration at which a load comes closest to its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DurationUse {
    /// Load over limit there; 1 is the limit.
    pub ratio: f64,
    /// That duration, s.
    pub duration_s: f64,
    /// Level exceeded for that duration, in the unit of the load.
    pub level: f64,
}

/// Utilisation of a limit that falls with duration, by a load positive in the limited direction.
///
/// Twenty-one durations from zero to `settled_s` are compared; longer ones cannot be worse.
///
/// # Errors
/// Fewer than two samples, a sample that is not finite, an interval that is not positive.
pub fn duration_use(load: &[f64], dt_s: f64, limit: &DurationLimit) -> Result<DurationUse, SignalError> {
    const DIVISIONS: u32 = 20;
    let peak = maximum(load, dt_s)?.value;
    let mut worst = DurationUse { ratio: peak / limit.at(0.0), duration_s: 0.0, level: peak };
    // a longer time is held by a lower level, so that the last level found bounds what is to come
    let mut highest = peak;
    let record_s = load.len().saturating_sub(1) as f64 * dt_s;
    let mut heights = None;
    for k in 1..=DIVISIONS {
        let duration_s = limit.settled_s * f64::from(k) / f64::from(DIVISIONS);
        if duration_s > record_s {
            break;
        }
        if highest / limit.at(duration_s) <= worst.ratio {
            continue;
        }
        let heights = match &mut heights {
            Some(heights) => heights,
            none => none.insert(Heights::new(load, dt_s, limit.settled_s.min(record_s))?),
        };
        let level = heights.held(duration_s, Counting::Cumulative)?.level_mps2;
        highest = level;
        let ratio = level / limit.at(duration_s);
        if ratio > worst.ratio {
            worst = DurationUse { ratio, duration_s, level };
        }
    }
    Ok(worst)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_and_long_loads_meet_different_limits() {
        let limit = DurationLimit::FEMUR_R94_N;
        assert_eq!(limit.at(0.0), 9070.0);
        assert!((limit.at(0.005) - 8325.0).abs() < 1e-9);
        assert_eq!(limit.at(0.5), 7580.0);
        // a needle of 9070 N just uses the limit at once
        let needle = duration_use(&[0.0, 9070.0, 0.0], 1e-4, &limit).unwrap();
        assert_eq!((needle.ratio, needle.duration_s), (1.0, 0.0));
        // a plateau of 7580 N for 20 ms just uses the settled limit
        let mut plateau = vec![7580.0; 201];
        plateau.extend([0.0; 50]);
        let long = duration_use(&plateau, 1e-4, &limit).unwrap();
        assert!((long.ratio - 1.0).abs() < 1e-12 && (long.duration_s - 0.010).abs() < 1e-12);
    }
}
