//! The time at which a pulse has removed a given speed: exact for straight lines and half sines, by bisection to the
//! last bit for a haversine.

use std::f64::consts::{PI, TAU};

use super::profile::{Profile, Ramp};
use occupant_units::trig;

/// Relative difference below which two speeds are equal. A pulse whose change of velocity is meant to equal the initial
/// speed misses it by rounding, and the vehicle must still stop at its end.
const SPEED_TOLERANCE: f64 = 1e-12;

/// First τ (s) at which `profile` has reduced the speed by `speed_m_s` (zero or more), if within the pulse.
///
///
/// For zero: the first time at which the speed would fall below the initial one.
pub(super) fn time_of_loss(profile: &Profile, speed_m_s: f64) -> Option<f64> {
    match profile {
        Profile::HalfSine { peak_m_s2, duration_s } => {
            // (2PT/π) sin²(πτ/2T) = speed
            let whole_m_s = 2.0 * peak_m_s2 * duration_s / PI;
            within(whole_m_s, *duration_s, speed_m_s, |fraction| 2.0 * duration_s / PI * trig::asin(fraction.sqrt()))
        }
        Profile::Haversine { peak_m_s2, duration_s } => {
            // ½P(τ − (T/2π) sin(2πτ/T)) = speed, or u − sin u = 2π·speed/whole with u = 2πτ/T
            let whole_m_s = 0.5 * peak_m_s2 * duration_s;
            within(whole_m_s, *duration_s, speed_m_s, |fraction| haversine_phase(TAU * fraction) / TAU * duration_s)
        }
        Profile::Ramps(ramps) => on_ramps(ramps, speed_m_s),
    }
}

/// Time at which a decelerating pulse has reduced the speed by `speed_m_s` of the `whole_m_s` over `duration_s`;
/// `time_at` answers for fractions strictly between 0 and 1.
fn within(whole_m_s: f64, duration_s: f64, speed_m_s: f64, time_at: impl Fn(f64) -> f64) -> Option<f64> {
    let tolerance_m_s = SPEED_TOLERANCE * (whole_m_s.abs() + speed_m_s);
    if whole_m_s <= 0.0 || speed_m_s > whole_m_s + tolerance_m_s {
        None
    } else if speed_m_s >= whole_m_s - tolerance_m_s {
        Some(duration_s)
    } else {
        Some(time_at(speed_m_s / whole_m_s))
    }
}

/// u in [0, 2π] with u − sin u = `phase`, by bisection to the last bit.
fn haversine_phase(phase: f64) -> f64 {
    let (mut low, mut high) = (0.0, TAU);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if middle - trig::sin_cos(middle).0 < phase {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// First crossing on straight lines, ramp by ramp.
fn on_ramps(ramps: &[Ramp], speed_m_s: f64) -> Option<f64> {
    let taken_m_s: f64 = ramps.iter().map(|ramp| 0.5 * (ramp.first_m_s2 + ramp.last_m_s2).abs() * ramp.length_s).sum();
    let tolerance_m_s = SPEED_TOLERANCE * (taken_m_s + speed_m_s);
    ramps.iter().find_map(|ramp| {
        let left_m_s = speed_m_s - ramp.speed_before_m_s;
        let left_after_m_s = speed_m_s - ramp.loss(ramp.length_s).speed_m_s;
        let comes_to_rest = ramp.last_m_s2 >= 0.0 && left_m_s > tolerance_m_s && left_after_m_s.abs() <= tolerance_m_s;
        let since_s = if comes_to_rest { Some(ramp.length_s) } else { on_ramp(ramp, left_m_s) };
        since_s.map(|since_s| ramp.start_s + since_s)
    })
}

/// First σ in [0, length] at which the ramp has reduced the speed by `left_m_s` (zero or more) and still decelerates.
fn on_ramp(ramp: &Ramp, left_m_s: f64) -> Option<f64> {
    let (first, slope) = (ramp.first_m_s2, ramp.slope_m_s3());
    let since_s = if left_m_s <= 0.0 {
        // σ(a₀ + ½ slope σ) = 0: at once, or when a gain at first is used up.
        match (first < 0.0, slope > 0.0) {
            (false, _) if first > 0.0 => 0.0,
            (false, true) => 0.0,
            (true, true) => -2.0 * first / slope,
            _ => return None,
        }
    } else {
        // a₀σ + ½ slope σ² = left, written so that nothing cancels
        let discriminant = first * first + 2.0 * slope * left_m_s;
        if discriminant < 0.0 || first + discriminant.sqrt() <= 0.0 {
            return None;
        }
        2.0 * left_m_s / (first + discriminant.sqrt())
    };
    (since_s <= ramp.length_s).then_some(since_s)
}

#[cfg(test)]
#[path = "../tests/crossing.rs"]
mod tests;
