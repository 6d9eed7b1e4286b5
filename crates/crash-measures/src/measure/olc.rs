//! Occupant load criterion of a vehicle pulse.
//!
//! An occupant flies freely over 65 mm relative to the vehicle (until t₁), then is decelerated
//! evenly over another 235 mm so that both have the same velocity at t₂. With u = v₀ − v the
//! vehicle's velocity loss and s = ∫u dt: s(t₁) = 0.065 m, OLC = u(t₂)/(t₂ − t₁) and
//! s(t₂) − ½ u(t₂)(t₂ − t₁) = 0.300 m. Definition read in an open-source program.

use crate::signal::{CumulativeIntegral, SignalError};

const FREE_FLIGHT_M: f64 = 0.065;
const TOTAL_M: f64 = 0.065 + 0.235;

/// Occupant load criterion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Olc {
    /// The constant deceleration, m/s².
    pub olc_mps2: f64,
    /// End of the free flight t₁, s.
    pub free_flight_end_s: f64,
    /// Time of equal velocities t₂, s.
    pub end_s: f64,
}

/// OLC of the vehicle's longitudinal acceleration in m/s² (forward positive, so negative in a frontal
/// crash), from first contact on.
///
/// # Errors
/// Fewer than two samples, a sample that is not finite, an interval that is not positive, a record in
/// which the displacements are not reached.
pub fn olc(ax_mps2: &[f64], dt_s: f64) -> Result<Olc, SignalError> {
    let a = CumulativeIntegral::new(ax_mps2, dt_s)?;
    let second = a.second_at_samples();
    let flight = |t_s: f64| -a.second_at(&second, t_s);
    let start_s = first_reach(&flight, FREE_FLIGHT_M, 0.0, dt_s, a.duration_s(), "OLC: free flight (m)")?;
    let relative = |t_s: f64| flight(t_s) + 0.5 * a.at(t_s) * (t_s - start_s);
    let end_s = first_reach(&relative, TOTAL_M, start_s, dt_s, a.duration_s(), "OLC: flight and restraint (m)")?;
    Ok(Olc { olc_mps2: -a.at(end_s) / (end_s - start_s), free_flight_end_s: start_s, end_s })
}

/// First time after `from_s` at which `distance` reaches `needed`: by samples, then by bisection.
fn first_reach(
    distance: &impl Fn(f64) -> f64,
    needed: f64,
    from_s: f64,
    dt_s: f64,
    duration_s: f64,
    what: &'static str,
) -> Result<f64, SignalError> {
    let (mut low_s, mut reached) = (from_s, 0.0f64);
    while low_s < duration_s {
        let high_s = (((low_s / dt_s + 1e-6).floor() + 1.0) * dt_s).min(duration_s);
        reached = reached.max(distance(high_s));
        if reached >= needed {
            return Ok(bisect(distance, needed, low_s, high_s));
        }
        low_s = high_s;
    }
    Err(SignalError::NeverReached { what, reached, needed })
}

fn bisect(distance: &impl Fn(f64) -> f64, needed: f64, mut low_s: f64, mut high_s: f64) -> f64 {
    for _ in 0..60 {
        let middle_s = 0.5 * (low_s + high_s);
        if distance(middle_s) >= needed { high_s = middle_s } else { low_s = middle_s }
    }
    high_s
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::STANDARD_GRAVITY_MPS2 as G;
    use std::f64::consts::PI;

    #[test]
    fn constant_deceleration() {
        let a = 20.0 * G;
        let found = olc(&vec![-a; 200], 1e-3).unwrap();
        let t1 = (0.13 / a).sqrt();
        assert!((found.olc_mps2 / (60.0 / 47.0 * a) - 1.0).abs() < 1e-12);
        assert!((found.free_flight_end_s - t1).abs() < 1e-12 && (found.end_s - 60.0 / 13.0 * t1).abs() < 1e-12);
        assert!((found.olc_mps2 / G - 25.532).abs() < 5e-4);
    }

    #[test]
    fn the_occupant_of_a_half_sine_pulse_travels_300_mm() {
        let pulse: Vec<f64> = (0..=1000).map(|i| -35.0 * G * (PI * f64::from(i) / 1000.0).sin()).collect();
        let found = olc(&pulse, 1e-4).unwrap();
        // travel by time stepping of both, independent of the formula
        let (mut travel_m, mut vehicle_mps, mut occupant_mps, dt) = (0.0, 0.0, 0.0, 1e-6);
        let mut t = 0.0;
        while t < found.end_s {
            travel_m += (occupant_mps - vehicle_mps) * dt;
            vehicle_mps -= 35.0 * G * (PI * (t + 0.5 * dt) / 0.1).sin() * dt;
            if t > found.free_flight_end_s {
                occupant_mps -= found.olc_mps2 * dt;
            }
            t += dt;
        }
        // measured 4.2e-6 m and 3.9e-5 m/s, the error of the steps
        assert!((travel_m - 0.3).abs() < 2e-5, "{travel_m}");
        assert!((occupant_mps - vehicle_mps).abs() < 2e-4, "{occupant_mps} {vehicle_mps}");
    }

    #[test]
    fn a_mild_pulse_says_how_far_it_got() {
        let error = olc(&[-10.0; 100], 1e-3).unwrap_err();
        assert!(
            matches!(error, SignalError::NeverReached { reached, .. } if (reached - 0.5 * 10.0 * 0.099f64.powi(2)).abs() < 1e-9)
        );
    }
}
