//! Shapes of deceleration pulses and their strength.

use std::f64::consts::PI;

use super::super::cursor::PathCursor;
use super::super::problem::{PathProblem, check_row, expect_finite};
use super::profile::Profile;

/// Strength of a pulse; negative for a pulse that accelerates the vehicle in its direction of travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strength {
    /// Greatest deceleration, m/s².
    PeakDeceleration(f64),
    /// Change of velocity over the whole pulse, m/s.
    DeltaV(f64),
}

/// One point of a tabulated pulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecelerationPoint {
    /// Time from the start of the pulse, s.
    pub time_s: f64,
    /// Deceleration, m/s²; negative where the vehicle is accelerated.
    pub deceleration_m_s2: f64,
}

/// Deceleration over time. With P the peak and T the duration:
#[derive(Clone, Debug, PartialEq)]
pub enum PulseShape {
    /// a = P sin(πτ/T); Δv = 2PT/π.
    HalfSine {
        /// Strength.
        strength: Strength,
        /// T, s.
        duration_s: f64,
    },
    /// a = P sin²(πτ/T); Δv = PT/2.
    Haversine {
        /// Strength.
        strength: Strength,
        /// T, s.
        duration_s: f64,
    },
    /// Linear rise and linear fall; Δv = PT/2.
    Triangle {
        /// Strength.
        strength: Strength,
        /// T, s.
        duration_s: f64,
        /// Time of the peak as a fraction of T, 0 to 1.
        peak_fraction: f64,
    },
    /// Linear rise, plateau, linear fall; Δv = P(rise + 2 plateau + fall)/2.
    Trapezoid {
        /// Strength.
        strength: Strength,
        /// Time to the plateau, s.
        rise_s: f64,
        /// Time on the plateau, s.
        plateau_s: f64,
        /// Time from the plateau to zero, s.
        fall_s: f64,
    },
    /// Constant; Δv = PT.
    Square {
        /// Strength.
        strength: Strength,
        /// T, s.
        duration_s: f64,
    },
    /// Straight lines between points, zero before the first and after the last.
    Tabulated {
        /// The points, in order of time.
        points: Vec<DecelerationPoint>,
    },
}

impl PulseShape {
    /// Start of the deceleration after the pulse's start, s: zero except for a table whose first point is later.
    pub(super) fn delay_s(&self) -> f64 {
        match self {
            PulseShape::Tabulated { points } => points.first().map_or(0.0, |point| point.time_s),
            _ => 0.0,
        }
    }

    /// The shape ready for evaluation; time there counts from `delay_s`.
    ///
    /// # Errors
    /// Everything that is wrong with the shape.
    pub(super) fn profile(&self) -> Result<Profile, Vec<PathProblem>> {
        let mut problems = Vec::new();
        self.find_problems(&mut problems);
        if !problems.is_empty() {
            return Err(problems);
        }
        let profile = self.unchecked_profile();
        if profile.peak_m_s2() == 0.0 {
            return Err(vec![PathProblem::new("the pulse is zero throughout", "a deceleration somewhere")]);
        }
        let end = profile.loss(profile.duration_s(), &mut PathCursor::default());
        expect_finite(&mut problems, "peak deceleration", profile.peak_m_s2());
        expect_finite(&mut problems, "delta-v", end.speed_m_s);
        expect_finite(&mut problems, "distance", end.distance_m);
        if problems.is_empty() { Ok(profile) } else { Err(problems) }
    }

    fn unchecked_profile(&self) -> Profile {
        match *self {
            PulseShape::HalfSine { strength, duration_s } => {
                // P = πΔv/(2T)
                Profile::HalfSine { peak_m_s2: strength.peak_m_s2(2.0 * duration_s / PI), duration_s }
            }
            PulseShape::Haversine { strength, duration_s } => {
                // P = 2Δv/T
                Profile::Haversine { peak_m_s2: strength.peak_m_s2(0.5 * duration_s), duration_s }
            }
            PulseShape::Triangle { strength, duration_s, peak_fraction } => {
                let rise_s = peak_fraction * duration_s;
                trapezoid(strength, rise_s, 0.0, duration_s - rise_s)
            }
            PulseShape::Trapezoid { strength, rise_s, plateau_s, fall_s } => {
                trapezoid(strength, rise_s, plateau_s, fall_s)
            }
            PulseShape::Square { strength, duration_s } => trapezoid(strength, 0.0, duration_s, 0.0),
            PulseShape::Tabulated { ref points } => {
                let delay_s = self.delay_s();
                let from_zero: Vec<(f64, f64)> =
                    points.iter().map(|point| (point.time_s - delay_s, point.deceleration_m_s2)).collect();
                Profile::through(&from_zero)
            }
        }
    }

    fn find_problems(&self, problems: &mut Vec<PathProblem>) {
        match self {
            PulseShape::HalfSine { strength, duration_s }
            | PulseShape::Haversine { strength, duration_s }
            | PulseShape::Square { strength, duration_s } => {
                strength.find_problems(problems);
                expect_positive(problems, "duration", *duration_s);
            }
            PulseShape::Triangle { strength, duration_s, peak_fraction } => {
                strength.find_problems(problems);
                expect_positive(problems, "duration", *duration_s);
                if !(0.0..=1.0).contains(peak_fraction) {
                    let found = format!("found a peak at the fraction {peak_fraction} of the pulse");
                    problems.push(PathProblem::new(found, "0 to 1"));
                }
            }
            PulseShape::Trapezoid { strength, rise_s, plateau_s, fall_s } => {
                strength.find_problems(problems);
                let parts = [("rise", *rise_s), ("plateau", *plateau_s), ("fall", *fall_s)];
                for (quantity, value) in parts {
                    expect_not_negative(problems, quantity, value);
                }
                if parts.iter().all(|(_, value)| *value == 0.0) {
                    problems.push(PathProblem::of_value("rise + plateau + fall", 0.0, "more than 0"));
                }
            }
            PulseShape::Tabulated { points } => find_point_problems(points, problems),
        }
    }
}

impl Strength {
    /// The peak, m/s², of a shape whose Δv is `delta_v_per_peak_s` times its peak.
    fn peak_m_s2(self, delta_v_per_peak_s: f64) -> f64 {
        match self {
            Strength::PeakDeceleration(peak_m_s2) => peak_m_s2,
            Strength::DeltaV(delta_v_m_s) => delta_v_m_s / delta_v_per_peak_s,
        }
    }

    fn find_problems(self, problems: &mut Vec<PathProblem>) {
        match self {
            Strength::PeakDeceleration(value) => expect_finite(problems, "peak deceleration", value),
            Strength::DeltaV(value) => expect_finite(problems, "delta-v", value),
        }
    }
}

/// Rise, plateau, fall; any of the three may be missing.
fn trapezoid(strength: Strength, rise_s: f64, plateau_s: f64, fall_s: f64) -> Profile {
    // P = 2Δv/(r + 2p + f)
    let peak = strength.peak_m_s2(0.5 * (rise_s + 2.0 * plateau_s + fall_s));
    let (top_s, down_s) = (rise_s, rise_s + plateau_s);
    Profile::through(&[(0.0, 0.0), (top_s, peak), (down_s, peak), (down_s + fall_s, 0.0)])
}

fn find_point_problems(points: &[DecelerationPoint], problems: &mut Vec<PathProblem>) {
    if points.len() < 2 {
        problems.push(PathProblem::too_few_stations(points.len()));
    }
    for (station, point) in points.iter().enumerate() {
        let previous_s = station.checked_sub(1).map(|before| points[before].time_s);
        let numbers = [("deceleration", point.deceleration_m_s2)];
        check_row(problems, station, point.time_s, previous_s, numbers, f64::MAX);
    }
}

fn expect_positive(problems: &mut Vec<PathProblem>, quantity: &'static str, value: f64) {
    if value <= 0.0 {
        problems.push(PathProblem::of_value(quantity, value, "more than 0"));
    } else {
        expect_finite(problems, quantity, value);
    }
}

/// Adds a problem unless `value` is finite and zero or more.
pub(super) fn expect_not_negative(problems: &mut Vec<PathProblem>, quantity: &'static str, value: f64) {
    if value < 0.0 {
        problems.push(PathProblem::of_value(quantity, value, "0 or more"));
    } else {
        expect_finite(problems, quantity, value);
    }
}
