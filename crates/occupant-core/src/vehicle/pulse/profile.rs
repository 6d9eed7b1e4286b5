//! The deceleration of a pulse and its two integrals, in closed form.
//!
//! Time here is τ, counted from the beginning of the pulse. "Lost" speed and distance are ∫a dτ and ∫∫a dτ²: the
//! difference from undisturbed travel.

use std::f64::consts::PI;

use super::super::cursor::PathCursor;
use occupant_units::trig;

/// Deceleration, loss of speed and loss of distance at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Loss {
    /// Deceleration a, m/s²; negative where the vehicle is accelerated.
    pub deceleration_m_s2: f64,
    /// ∫a dτ, m/s.
    pub speed_m_s: f64,
    /// ∫∫a dτ², m.
    pub distance_m: f64,
}

/// Interval of linear deceleration: a = a₀ + slope·σ, σ from its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ramp {
    pub start_s: f64,
    pub length_s: f64,
    pub first_m_s2: f64,
    pub last_m_s2: f64,
    /// Losses of speed and distance before it.
    pub speed_before_m_s: f64,
    pub distance_before_m: f64,
}

impl Ramp {
    pub(crate) fn slope_m_s3(&self) -> f64 {
        (self.last_m_s2 - self.first_m_s2) / self.length_s
    }

    /// Loss `since_s` after the ramp's start.
    pub(crate) fn loss(&self, since_s: f64) -> Loss {
        let (first, slope) = (self.first_m_s2, self.slope_m_s3());
        Loss {
            deceleration_m_s2: first + slope * since_s,
            // v = v₀ + a₀σ + ½ slope σ²
            speed_m_s: self.speed_before_m_s + (first + 0.5 * slope * since_s) * since_s,
            // x = x₀ + v₀σ + ½ a₀σ² + ⅙ slope σ³
            distance_m: self.distance_before_m
                + (self.speed_before_m_s + (0.5 * first + slope * since_s / 6.0) * since_s) * since_s,
        }
    }
}

/// Deceleration over time.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Profile {
    /// a = P sin(πτ/T).
    HalfSine { peak_m_s2: f64, duration_s: f64 },
    /// a = P sin²(πτ/T).
    Haversine { peak_m_s2: f64, duration_s: f64 },
    /// Straight lines; at least one ramp, each of positive length.
    Ramps(Vec<Ramp>),
}

impl Profile {
    /// Straight lines through (τ, a). Two points at one time are a jump. Times do not decrease and start at 0.
    pub(crate) fn through(points: &[(f64, f64)]) -> Self {
        let mut ramps: Vec<Ramp> = Vec::with_capacity(points.len());
        let (mut speed_before_m_s, mut distance_before_m) = (0.0, 0.0);
        for pair in points.windows(2) {
            let ((start_s, first_m_s2), (end_s, last_m_s2)) = (pair[0], pair[1]);
            let length_s = end_s - start_s;
            if length_s > 0.0 {
                let ramp = Ramp { start_s, length_s, first_m_s2, last_m_s2, speed_before_m_s, distance_before_m };
                let after = ramp.loss(length_s);
                (speed_before_m_s, distance_before_m) = (after.speed_m_s, after.distance_m);
                ramps.push(ramp);
            }
        }
        Profile::Ramps(ramps)
    }

    /// Duration T, s.
    pub(crate) fn duration_s(&self) -> f64 {
        match self {
            Profile::HalfSine { duration_s, .. } | Profile::Haversine { duration_s, .. } => *duration_s,
            Profile::Ramps(ramps) => ramps.last().map_or(0.0, |ramp| ramp.start_s + ramp.length_s),
        }
    }

    /// Deceleration of largest magnitude, with its sign, m/s².
    pub(crate) fn peak_m_s2(&self) -> f64 {
        match self {
            Profile::HalfSine { peak_m_s2, .. } | Profile::Haversine { peak_m_s2, .. } => *peak_m_s2,
            Profile::Ramps(ramps) => ramps
                .iter()
                .flat_map(|ramp| [ramp.first_m_s2, ramp.last_m_s2])
                .fold(0.0, |peak: f64, value| if value.abs() > peak.abs() { value } else { peak }),
        }
    }

    /// Largest gain of speed at the end of a ramp between `from_s` and `until_s`, m/s; zero without any, and for the
    /// sines, which have one sign.
    pub(crate) fn greatest_gain_m_s(&self, from_s: f64, until_s: f64) -> f64 {
        let Profile::Ramps(ramps) = self else {
            return 0.0;
        };
        ramps
            .iter()
            .filter(|ramp| (from_s..=until_s).contains(&(ramp.start_s + ramp.length_s)))
            .map(|ramp| -ramp.loss(ramp.length_s).speed_m_s)
            .fold(0.0, f64::max)
    }

    /// Loss at τ = `since_s`: zero before the pulse; after it the loss of speed is constant.
    pub(crate) fn loss(&self, since_s: f64, cursor: &mut PathCursor) -> Loss {
        let duration_s = self.duration_s();
        if since_s < 0.0 {
            return Loss { deceleration_m_s2: 0.0, speed_m_s: 0.0, distance_m: 0.0 };
        }
        if since_s >= duration_s {
            let end = self.loss_inside(duration_s, cursor);
            let distance_m = end.distance_m + end.speed_m_s * (since_s - duration_s);
            return Loss { deceleration_m_s2: 0.0, distance_m, ..end };
        }
        self.loss_inside(since_s, cursor)
    }

    /// Loss at τ in [0, T].
    fn loss_inside(&self, since_s: f64, cursor: &mut PathCursor) -> Loss {
        match self {
            Profile::HalfSine { peak_m_s2, duration_s } => half_sine(*peak_m_s2, *duration_s, since_s),
            Profile::Haversine { peak_m_s2, duration_s } => haversine(*peak_m_s2, *duration_s, since_s),
            Profile::Ramps(ramps) => {
                let ramp = &ramps[cursor.locate(ramps.len(), since_s, |ramp| ramps[ramp].start_s)];
                ramp.loss(since_s - ramp.start_s)
            }
        }
    }
}

/// Half sine. ∫a = (2PT/π) sin²(πτ/2T), ∫∫a = (PT/π)(τ − (T/π) sin(πτ/T)).
fn half_sine(peak_m_s2: f64, duration_s: f64, since_s: f64) -> Loss {
    let per_angle_s = duration_s / PI;
    let (sine, _) = trig::sin_cos(since_s / per_angle_s);
    let (half_sine, _) = trig::sin_cos(0.5 * since_s / per_angle_s);
    Loss {
        deceleration_m_s2: peak_m_s2 * sine,
        speed_m_s: 2.0 * peak_m_s2 * per_angle_s * half_sine * half_sine,
        distance_m: peak_m_s2 * per_angle_s * (since_s - per_angle_s * sine),
    }
}

/// Haversine. ∫a = ½P(τ − (T/2π) sin(2πτ/T)), ∫∫a = ½P(½τ² − (T²/2π²) sin²(πτ/T)).
fn haversine(peak_m_s2: f64, duration_s: f64, since_s: f64) -> Loss {
    let per_angle_s = duration_s / PI;
    let (sine, cosine) = trig::sin_cos(since_s / per_angle_s);
    Loss {
        deceleration_m_s2: peak_m_s2 * sine * sine,
        // sin(2x) = 2 sin x cos x
        speed_m_s: 0.5 * peak_m_s2 * (since_s - per_angle_s * sine * cosine),
        distance_m: 0.25 * peak_m_s2 * (since_s * since_s - (per_angle_s * sine) * (per_angle_s * sine)),
    }
}

#[cfg(test)]
#[path = "../tests/profile.rs"]
pub(super) mod tests;
