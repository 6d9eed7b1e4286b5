//! Searle's bounds: the distance of a body thrown with a speed, whatever the angle and the bounces.
//!
//! J. A. Searle, A. Searle: "The Trajectories of Pedestrians, Motorcycles, Motorcyclists, etc., Following a Road
//! Accident", SAE 831622 (1983). From the launch to rest the horizontal force of the ground is μ times the vertical
//! one. Then, with the fall H of the centre of gravity from the launch to rest and the angle θ of the launch, the
//! distance is
//!
//! s = v² (cos θ + μ sin θ)² / (2 μ g) + μ H
//!
//! for any number of bounces. The bracket is 1 at θ = 0 and has its maximum, √(1 + μ²), at tan θ = μ: a speed has a
//! minimum and a maximum distance, and a distance has a minimum and a maximum speed.

use occupant_units::trig;
use serde::Serialize;

/// Searle's bounds of a throw.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Searle {
    /// μ: coefficient of friction of the body's ground contact.
    pub friction: f64,
    /// H: fall of the centre of gravity from launch to rest, m.
    pub fall_m: f64,
    /// Least and greatest speed for the throw distance, m/s.
    pub speeds_m_s: [f64; 2],
    /// Least and greatest distance from launch to rest for the launch speed, m.
    pub distances_m: [f64; 2],
    /// μ with which the formula gives the distance from launch to rest: less than that of the ground for a rolling
    /// body; none if no μ does.
    pub drag_factor: Option<f64>,
}

/// Throw of a body from launch to rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// μ of the ground.
    pub friction: f64,
    pub gravity_m_s2: f64,
    pub fall_m: f64,
    /// Throw distance, from the blow to rest, m.
    pub distance_m: f64,
    /// Distance from launch to rest, m.
    pub from_launch_m: f64,
    /// Launch speed, m/s, and its angle above the horizontal, rad.
    pub speed_m_s: f64,
    pub angle_rad: f64,
}

impl Searle {
    /// Bounds, for friction above 0.
    pub(super) fn new(way: &Way) -> Self {
        let Way { friction, gravity_m_s2, fall_m, distance_m, speed_m_s, .. } = *way;
        let best = 1.0 + friction * friction;
        let twice = 2.0 * friction * gravity_m_s2;
        let lost_m = friction * fall_m;
        let flat_m2_s2 = twice * (distance_m - lost_m).max(0.0);
        let flat_m = speed_m_s * speed_m_s / twice;
        Searle {
            friction,
            fall_m,
            speeds_m_s: [(flat_m2_s2 / best).sqrt(), flat_m2_s2.sqrt()],
            distances_m: [flat_m + lost_m, flat_m * best + lost_m],
            drag_factor: way.drag_factor(),
        }
    }
}

impl Way {
    /// The least μ with s = v² (cos θ + μ sin θ)² / (2 μ g) + μ H.
    fn drag_factor(&self) -> Option<f64> {
        let (sin, cos) = trig::sin_cos(self.angle_rad);
        let flat_m = self.speed_m_s * self.speed_m_s / (2.0 * self.gravity_m_s2);
        // (v²/2g sin²θ + H) μ² + (v²/g sin θ cos θ − s) μ + v²/2g cos²θ = 0
        let [a, b, c] =
            [flat_m * sin * sin + self.fall_m, 2.0 * flat_m * sin * cos - self.from_launch_m, flat_m * cos * cos];
        let root = (b * b - 4.0 * a * c).sqrt();
        // without cancellation, and where a is 0 too
        let least = 2.0 * c / (root - b);
        (least.is_finite() && least > 0.0).then_some(least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: f64 = 9.80665;

    /// Distance of a point that is launched, falls by `fall_m`, bounces `bounces` times with half the vertical speed
    /// each, loses μ times the vertical impulse of its horizontal speed at each contact, and slides to rest; none if it
    /// stops in a bounce.
    fn gone_m(friction: f64, fall_m: f64, speed_m_s: f64, angle: f64, bounces: usize) -> Option<f64> {
        let [mut along, mut up] = [speed_m_s * angle.cos(), speed_m_s * angle.sin()];
        let (mut height_m, mut x) = (fall_m, 0.0);
        for i in 0..=bounces {
            let down = (up * up + 2.0 * G * height_m).sqrt();
            x += along * (up + down) / G;
            let new_up = if i == bounces { 0.0 } else { 0.5 * down };
            along -= friction * (down + new_up);
            if along <= 0.0 {
                return None;
            }
            (up, height_m) = (new_up, 0.0);
        }
        Some(x + along * along / (2.0 * friction * G))
    }

    /// Throw at 12 m/s.
    fn thrown(friction: f64, fall_m: f64, s: f64) -> Way {
        let (distance_m, from_launch_m, speed_m_s) = (s, s, 12.0);
        Way { friction, gravity_m_s2: G, fall_m, distance_m, from_launch_m, speed_m_s, angle_rad: 0.0 }
    }

    #[test]
    fn a_point_that_bounces_goes_as_far_as_the_formula_says_and_never_beyond_the_bounds() {
        for friction in [0.3_f64, 0.7] {
            for fall_m in [0.0, 0.8] {
                for bounces in [0, 1, 4] {
                    for degrees in [0.0_f64, 10.0, 25.0, friction.atan().to_degrees()] {
                        let angle = degrees.to_radians();
                        let Some(s) = gone_m(friction, fall_m, 12.0, angle, bounces) else { continue };
                        let bracket = angle.cos() + friction * angle.sin();
                        let formula = (12.0 * bracket).powi(2) / (2.0 * friction * G) + friction * fall_m;
                        // measured: 4e-15
                        assert!((s / formula - 1.0).abs() < 1e-12, "{s} {formula}");
                        let way = Way { angle_rad: angle, ..thrown(friction, fall_m, s) };
                        let Searle { speeds_m_s: [slow, fast], distances_m: [near, far], drag_factor, .. } =
                            Searle::new(&way);
                        // μ itself, but where more friction would bring it farther
                        // measured: 1e-14
                        let drag = drag_factor.expect("one");
                        assert!(drag < friction + 1e-9, "{drag} {friction}");
                        if degrees < 20.0 {
                            assert!((drag / friction - 1.0).abs() < 1e-9, "{drag} {friction}");
                        }
                        assert!(slow < 12.0 + 1e-9 && fast > 12.0 - 1e-9, "{slow} {fast}");
                        assert!(near < s + 1e-9 && far > s - 1e-9, "{near} {s} {far}");
                    }
                    // the bounds are reached
                    for (bound, angle) in [friction.atan(), 0.0].into_iter().enumerate() {
                        let Some(s) = gone_m(friction, fall_m, 12.0, angle, bounces) else { continue };
                        assert!((Searle::new(&thrown(friction, fall_m, s)).speeds_m_s[bound] - 12.0).abs() < 1e-9);
                    }
                }
            }
        }
    }
}
