//! Theoretical head impact velocity and post-impact head deceleration (EN 1317-1, NCHRP 350, MASH).
//!
//! A free head keeps the vehicle's initial velocity in the plane while the vehicle translates and
//! yaws. In the ground frame that moves with the initial velocity, with ψ = ∫ yaw rate:
//!   Ẍ = a_x cos ψ − a_y sin ψ,  Ÿ = a_x sin ψ + a_y cos ψ,
//! the head stays at (X₀, Y₀) and, seen from the vehicle with Δx = X₀ − X, Δy = Y₀ − Y,
//!   x_b = Δx cos ψ + Δy sin ψ,  y_b = −Δx sin ψ + Δy cos ψ,
//!   V_x = −Ẋ cos ψ − Ẏ sin ψ + y_b ψ̇,  V_y = Ẋ sin ψ − Ẏ cos ψ − x_b ψ̇.
//! T is the first time at which x_b = X₀ + D_x, y_b = D_y or y_b = −D_y; THIV = √(V_x² + V_y²) there;
//! PHD is the largest 10 ms average of √(a_x² + a_y²) after T. Accelerations of the c.g. along the
//! vehicle's axes, filtered CFC 180; the record starts at first contact. Formulas collected from
//! programs and manuals, not from the standards; no published worked example was found.

use crate::signal::{CumulativeIntegral, MovingAverage, SignalError, WindowExtreme, require_same_length, resultant2};
use occupant_units::trig;

/// Initial position of the head and its flail distances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeadFlight {
    /// Initial position of the head forward of the c.g., X₀, m.
    pub start_x_m: f64,
    /// Initial position of the head to the right of the c.g., Y₀, m.
    pub start_y_m: f64,
    /// Free distance forward, D_x, m.
    pub forward_m: f64,
    /// Distance of the side surfaces from the vehicle's centre line, D_y, m.
    pub sideways_m: f64,
}

impl Default for HeadFlight {
    /// Head at the c.g., 0.6 m forward, 0.3 m to either side.
    fn default() -> Self {
        Self { start_x_m: 0.0, start_y_m: 0.0, forward_m: 0.6, sideways_m: 0.3 }
    }
}

/// Theoretical head impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thiv {
    /// THIV, m/s.
    pub speed_mps: f64,
    /// Time of the impact T, s.
    pub impact_s: f64,
    /// Position of the head in the vehicle at T: x_b, y_b, m.
    pub place_m: [f64; 2],
    /// Velocity of the head relative to the vehicle at T, vehicle axes: V_x, V_y, m/s.
    pub velocity_mps: [f64; 2],
    /// Post-impact head deceleration, m/s², and its window; none with less than 10 ms of record
    /// after the impact.
    pub phd: Option<WindowExtreme>,
}

impl Thiv {
    /// THIV in its usual unit, km/h.
    #[must_use]
    pub fn speed_kmh(&self) -> f64 {
        3.6 * self.speed_mps
    }
}

/// THIV and PHD of the vehicle's accelerations (m/s²) and yaw rate (rad/s), from first contact on.
///
/// # Errors
/// Fewer than two samples, different lengths, a sample that is not finite, an interval that is not
/// positive; a head that starts beyond a surface, or never reaches one within the record.
pub fn thiv(
    ax_mps2: &[f64],
    ay_mps2: &[f64],
    yaw_rate_rps: &[f64],
    dt_s: f64,
    flight: HeadFlight,
) -> Result<Thiv, SignalError> {
    require_same_length("lateral acceleration", ay_mps2, ax_mps2)?;
    require_same_length("yaw rate", yaw_rate_rps, ax_mps2)?;
    if flight.start_y_m.abs() >= flight.sideways_m || flight.forward_m <= 0.0 {
        return Err(SignalError::OutOfRange {
            what: "head's lateral start (m)",
            found: flight.start_y_m,
            expected: "a position between the surfaces, which are at positive distances",
        });
    }
    let heads = head_motion(ax_mps2, ay_mps2, yaw_rate_rps, dt_s, flight)?;
    let (impact_s, head) = first_contact(&heads, dt_s, flight)?;
    let planar = resultant2(ax_mps2, ay_mps2)?;
    let phd = MovingAverage::new(&planar, dt_s, 0.010).and_then(|average| average.extreme_from(impact_s)).ok();
    let [x_m, y_m, vx_mps, vy_mps] = head;
    Ok(Thiv {
        speed_mps: (vx_mps * vx_mps + vy_mps * vy_mps).sqrt(),
        impact_s,
        place_m: [x_m, y_m],
        velocity_mps: [vx_mps, vy_mps],
        phd,
    })
}

/// x_b, y_b, V_x, V_y of the head at every sample.
fn head_motion(
    ax_mps2: &[f64],
    ay_mps2: &[f64],
    yaw_rate_rps: &[f64],
    dt_s: f64,
    flight: HeadFlight,
) -> Result<Vec<[f64; 4]>, SignalError> {
    let yaw = CumulativeIntegral::new(yaw_rate_rps, dt_s)?;
    let turned: Vec<(f64, f64)> = yaw.at_samples().iter().map(|psi| trig::sin_cos(*psi)).collect();
    let along = |pick: fn(f64, f64, (f64, f64)) -> f64| -> Vec<f64> {
        ax_mps2.iter().zip(ay_mps2).zip(&turned).map(|((&ax, &ay), &turn)| pick(ax, ay, turn)).collect()
    };
    let ground_x = along(|ax, ay, (sin, cos)| ax * cos - ay * sin);
    let ground_y = along(|ax, ay, (sin, cos)| ax * sin + ay * cos);
    let (x, y) = (CumulativeIntegral::new(&ground_x, dt_s)?, CumulativeIntegral::new(&ground_y, dt_s)?);
    let (xs, ys) = (x.second_at_samples(), y.second_at_samples());
    let head = |i: usize| {
        let (sin, cos) = turned[i];
        let (dx, dy) = (flight.start_x_m - xs[i], flight.start_y_m - ys[i]);
        let (xd, yd, rate) = (x.at_samples()[i], y.at_samples()[i], yaw_rate_rps[i]);
        let (xb, yb) = (dx * cos + dy * sin, -dx * sin + dy * cos);
        [xb, yb, -xd * cos - yd * sin + yb * rate, xd * sin - yd * cos - xb * rate]
    };
    Ok((0..ax_mps2.len()).map(head).collect())
}

/// Time and head state at the first contact, interpolated linearly between samples.
fn first_contact(heads: &[[f64; 4]], dt_s: f64, flight: HeadFlight) -> Result<(f64, [f64; 4]), SignalError> {
    // distance still free to each surface; a surface is met where it falls to zero
    let free = |head: &[f64; 4]| {
        [flight.start_x_m + flight.forward_m - head[0], flight.sideways_m - head[1], flight.sideways_m + head[1]]
    };
    for (i, pair) in heads.windows(2).enumerate() {
        let (before, after) = (free(&pair[0]), free(&pair[1]));
        let part = (0..3)
            .filter(|&k| after[k] <= 0.0)
            .map(|k| (before[k] / (before[k] - after[k])).clamp(0.0, 1.0))
            .reduce(f64::min);
        if let Some(part) = part {
            let head = std::array::from_fn(|k| pair[0][k] + part * (pair[1][k] - pair[0][k]));
            return Ok(((i as f64 + part) * dt_s, head));
        }
    }
    let reached = heads.iter().map(|head| head[0] - flight.start_x_m).fold(0.0, f64::max);
    Err(SignalError::NeverReached {
        what: "theoretical head impact: forward flight (m), without contact with a side surface",
        reached,
        needed: flight.forward_m,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::STANDARD_GRAVITY_MPS2 as G;

    fn constant(x_g: f64, y_g: f64, yaw_rate_dps: f64, start_x_m: f64, dt_s: f64) -> Thiv {
        let n = (0.15 / dt_s) as usize;
        let flight = HeadFlight { start_x_m, ..HeadFlight::default() };
        thiv(&vec![x_g * G; n], &vec![y_g * G; n], &vec![yaw_rate_dps.to_radians(); n], dt_s, flight).unwrap()
    }

    #[test]
    fn constant_acceleration_without_yaw() {
        let frontal = constant(-10.0, 0.0, 0.0, 0.0, 1e-4);
        assert!((frontal.impact_s - (1.2 / (10.0 * G)).sqrt()).abs() < 1e-7);
        assert!((frontal.speed_kmh() - 39.053).abs() < 5e-4);
        assert!((frontal.phd.unwrap().value - 10.0 * G).abs() < 1e-9);
        // both surfaces at once; 43.663 elsewhere with steps of 1e-5 s
        let oblique = constant(-10.0, 5.0, 0.0, 0.0, 1e-4).speed_kmh();
        assert!((oblique - 3.6 * (1.25 * 1.2 * 10.0 * G).sqrt()).abs() < 1e-4, "{oblique}");
    }

    #[test]
    fn constant_acceleration_with_yaw() {
        // exact solution of the constant case (circular functions of ψ = rt), bisected for y_b = −0.3 m
        let found = constant(-8.0, 6.0, 100.0, 0.0, 1e-5);
        assert!((found.impact_s - 0.094_595_936).abs() < 1e-8);
        assert!((found.place_m[0] - 0.319_729_0).abs() < 1e-6 && (found.place_m[1] + 0.3).abs() < 1e-9);
        assert!((found.speed_kmh() - 33.396_092).abs() < 2e-6, "{}", found.speed_kmh());
        let ahead = constant(-8.0, 6.0, 100.0, 0.3, 1e-5);
        assert!((ahead.impact_s - 0.087_488_366).abs() < 1e-8);
        assert!((ahead.speed_kmh() - 32.053_305).abs() < 2e-6);
        // computed elsewhere with steps of 1e-5 s, taking the first step past the surface
        assert!((found.impact_s - 0.0946).abs() < 1e-5 && (ahead.impact_s - 0.08749).abs() < 1e-5);
        assert!((found.velocity_mps[0] - 6.405_88).abs() < 5e-4 && (found.velocity_mps[1] + 6.710_38).abs() < 5e-4);
        assert!((found.speed_kmh() - 33.3975).abs() < 2e-3 && (ahead.speed_kmh() - 32.0539).abs() < 1e-3);
        // a tenth of the sample rate changes little
        assert!((constant(-8.0, 6.0, 100.0, 0.0, 1e-4).speed_kmh() - found.speed_kmh()).abs() < 1e-3);
    }

    #[test]
    fn pure_yaw_swings_the_head_of_an_unaccelerated_vehicle() {
        // the head is at rest at 0.5 m ahead of a c.g. that turns at 2 rad/s: it circles backwards
        let n = 2000;
        let flight = HeadFlight { start_x_m: 0.5, ..HeadFlight::default() };
        let found = thiv(&vec![0.0; n], &vec![0.0; n], &vec![2.0; n], 1e-3, flight).unwrap();
        // y_b = −0.5 sin 2t = −0.3
        assert!((found.impact_s - 0.6f64.asin() / 2.0).abs() < 1e-6, "{found:?}");
        assert!((found.speed_mps - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_head_that_meets_nothing_is_an_error() {
        let quiet = thiv(&[0.1; 50], &[0.0; 50], &[0.0; 50], 1e-3, HeadFlight::default());
        assert!(matches!(quiet, Err(SignalError::NeverReached { .. })));
        let outside = HeadFlight { start_y_m: 0.4, ..HeadFlight::default() };
        assert!(matches!(thiv(&[0.1; 5], &[0.0; 5], &[0.0; 5], 1e-3, outside), Err(SignalError::OutOfRange { .. })));
    }
}
