//! Occupant impact velocity and ridedown acceleration of the flail-space model (NCHRP 350, MASH).
//!
//! A free occupant keeps the initial velocity while the vehicle accelerates (planar, no yaw). With
//! the accelerations a_x, a_y of the vehicle's c.g. along its own axes, filtered CFC 180,
//! X = ∬a_x, Y = ∬a_y from the start of the record; the occupant meets the interior at the first
//! time t* at which |X| = 0.6 m or |Y| = 0.3 m. OIV_x = |∫₀^t* a_x dt|, OIV_y likewise, both at the
//! same t*. The ridedown accelerations are the largest 10 ms averages after t*. Where neither
//! distance is reached, the velocity change over the record stands for the impact velocity.
//!
//! The record must start at first contact. The manuals were not read as a whole: limits and lengths
//! come from sources that quote them. [`mod@super::thiv`] adds the yaw that is missing here.

use crate::signal::{CumulativeIntegral, MovingAverage, SignalError, WindowExtreme, require_same_length};

/// Free distances of the occupant, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlailDistances {
    /// Forward and backward, m.
    pub longitudinal_m: f64,
    /// To either side, m.
    pub lateral_m: f64,
}

impl Default for FlailDistances {
    /// 0.6 m and 0.3 m.
    fn default() -> Self {
        Self { longitudinal_m: 0.6, lateral_m: 0.3 }
    }
}

/// Result of the flail-space model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlailSpace {
    /// Time of impact with the interior, s; none if neither distance is reached.
    pub impact_s: Option<f64>,
    /// Longitudinal occupant impact velocity, m/s, as a magnitude.
    pub oiv_x_mps: f64,
    /// Lateral occupant impact velocity, m/s, as a magnitude.
    pub oiv_y_mps: f64,
    /// Longitudinal ridedown acceleration, m/s², with its sign and window; none without an impact or
    /// with less than 10 ms of record after it.
    pub ora_x: Option<WindowExtreme>,
    /// Lateral ridedown acceleration, m/s², likewise.
    pub ora_y: Option<WindowExtreme>,
}

/// Flail-space measures of the vehicle's accelerations in m/s², from first contact on.
///
/// # Errors
/// Fewer than two samples, different lengths, a sample that is not finite, an interval that is not
/// positive.
pub fn flail_space(
    ax_mps2: &[f64],
    ay_mps2: &[f64],
    dt_s: f64,
    distances: FlailDistances,
) -> Result<FlailSpace, SignalError> {
    require_same_length("lateral acceleration", ay_mps2, ax_mps2)?;
    let x = CumulativeIntegral::new(ax_mps2, dt_s)?;
    let y = CumulativeIntegral::new(ay_mps2, dt_s)?;
    let impact_s =
        [first_excursion(&x, dt_s, distances.longitudinal_m), first_excursion(&y, dt_s, distances.lateral_m)]
            .into_iter()
            .flatten()
            .reduce(f64::min);
    let at_s = impact_s.unwrap_or(x.duration_s());
    let ridedown = |a_mps2: &[f64]| -> Option<WindowExtreme> {
        MovingAverage::new(a_mps2, dt_s, 0.010).ok()?.extreme_from(impact_s?).ok()
    };
    Ok(FlailSpace {
        impact_s,
        oiv_x_mps: x.at(at_s).abs(),
        oiv_y_mps: y.at(at_s).abs(),
        ora_x: ridedown(ax_mps2),
        ora_y: ridedown(ay_mps2),
    })
}

/// First time at which the second integral reaches `distance_m` in magnitude.
fn first_excursion(a: &CumulativeIntegral, dt_s: f64, distance_m: f64) -> Option<f64> {
    let second = a.second_at_samples();
    let after = second.iter().position(|x| x.abs() >= distance_m)?;
    let (mut low_s, mut high_s) = (after.saturating_sub(1) as f64 * dt_s, after as f64 * dt_s);
    for _ in 0..60 {
        let middle_s = 0.5 * (low_s + high_s);
        if a.second_at(&second, middle_s).abs() >= distance_m {
            high_s = middle_s;
        } else {
            low_s = middle_s;
        }
    }
    Some(high_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::STANDARD_GRAVITY_MPS2 as G;

    fn constant(x_g: f64, y_g: f64, length_s: f64) -> FlailSpace {
        let n = (length_s / 1e-3) as usize + 1;
        flail_space(&vec![x_g * G; n], &vec![y_g * G; n], 1e-3, FlailDistances::default()).unwrap()
    }

    #[test]
    fn closed_forms_of_constant_acceleration() {
        let straight = constant(-10.0, 0.0, 0.2);
        let a = 10.0 * G;
        assert!((straight.impact_s.unwrap() - (1.2 / a).sqrt()).abs() < 1e-12);
        assert!((straight.oiv_x_mps - (2.0 * a * 0.6).sqrt()).abs() < 1e-10);
        assert!((straight.oiv_x_mps - 10.8480).abs() < 5e-5 && straight.oiv_y_mps == 0.0);
        assert!((straight.ora_x.unwrap().value + a).abs() < 1e-9);

        let both = constant(-10.0, 5.0, 0.2);
        assert!((both.oiv_x_mps - 10.8480).abs() < 5e-5 && (both.oiv_y_mps - 5.4240).abs() < 5e-5);

        let lateral_first = constant(-5.0, 8.0, 0.2);
        assert!((lateral_first.impact_s.unwrap() - 0.087_452).abs() < 5e-7);
        assert!((lateral_first.oiv_x_mps - 4.288_06).abs() < 5e-6);
        assert!((lateral_first.oiv_y_mps - 6.860_90).abs() < 5e-6);
    }

    #[test]
    fn ridedown_looks_only_after_the_impact() {
        // 20 g for 80 ms (0.6 m after 78.2 ms), then 4 g
        let mut ax = vec![-20.0 * G; 81];
        ax.extend(vec![-4.0 * G; 100]);
        let found = flail_space(&ax, &vec![0.0; ax.len()], 1e-3, FlailDistances::default()).unwrap();
        let ora = found.ora_x.unwrap();
        assert!((found.impact_s.unwrap() - (1.2 / (20.0 * G)).sqrt()).abs() < 1e-12);
        assert!(ora.start_s >= found.impact_s.unwrap() && ora.value < -4.0 * G && ora.value > -9.0 * G, "{ora:?}");
    }

    #[test]
    fn without_an_impact_the_velocity_change_stands() {
        let breakaway = constant(-1.0, 0.0, 0.1);
        assert_eq!((breakaway.impact_s, breakaway.ora_x), (None, None));
        assert!((breakaway.oiv_x_mps - 0.1 * G).abs() < 1e-12);
        // an impact in the last 10 ms has no ridedown window
        assert_eq!(constant(-10.0, 0.0, 0.115).ora_x, None);
        assert!(flail_space(&[1.0, 1.0], &[1.0], 1e-3, FlailDistances::default()).is_err());
    }
}
