//! The reference's accelerations of any state, singular postures of its coordinates included.
//!
//! A scene turned as a whole, gravity and forces with it, moves the same way; so a posture with a vertical segment is
//! turned until no segment is near vertical, solved there and turned back. Nothing is approximated.

use crate::{
    reference::{PointForce, SpaceMotion, System, equations_of_motion, space_accelerations},
    space_state::SpaceState,
};
use nalgebra::{UnitQuaternion, Vector3};

impl System {
    /// The same system in a scene turned by `r` about the origin.
    pub fn turned(&self, r: &UnitQuaternion<f64>) -> System {
        let force = |f: &PointForce| PointForce { force: r * f.force, ..f.clone() };
        System { gravity: r * self.gravity, forces: self.forces.iter().map(force).collect(), ..self.clone() }
    }

    /// Acceleration of T1, angular accelerations and α̈ of a state, by report coordinates in the scene as it stands.
    pub fn accelerations_as_it_stands(&self, state: &SpaceState) -> SpaceMotion {
        let (q, rates) = state.to_report();
        let accelerations = equations_of_motion(self, &q, &rates).accelerations;
        space_accelerations(&q, &rates, &accelerations)
    }

    /// The same for any posture.
    pub fn accelerations(&self, state: &SpaceState) -> SpaceMotion {
        let r = regular_turn(state);
        let turned = self.turned(&r).accelerations_as_it_stands(&state.turned(&r));
        turned.turned(&r.inverse())
    }
}

/// Of a fixed set of turns that which keeps all segments farthest from vertical.
fn regular_turn(state: &SpaceState) -> UnitQuaternion<f64> {
    let turns = (0..64).map(|i| {
        let (a, b) = (0.1 + 0.39 * f64::from(i % 8), 0.1 + 0.39 * f64::from(i / 8));
        UnitQuaternion::from_scaled_axis(Vector3::x() * a) * UnitQuaternion::from_scaled_axis(Vector3::y() * b)
    });
    let least_sine = |r: &UnitQuaternion<f64>| {
        let sines = state.turn.map(|turn| (r * turn * Vector3::z()).xy().norm());
        sines.into_iter().fold(1.0, f64::min)
    };
    turns.max_by(|a, b| least_sine(a).total_cmp(&least_sine(b))).unwrap_or_default()
}

impl SpaceMotion {
    /// Largest difference of a component, relative to the largest component of the kind (linear or angular).
    pub fn difference(&self, expected: &SpaceMotion) -> f64 {
        let (found, expected) = (self.numbers(), expected.numbers());
        let worst = |range: std::ops::Range<usize>| {
            let size = expected[range.clone()].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let gap = range.map(|i| (found[i] - expected[i]).abs()).fold(0.0, f64::max);
            gap / size
        };
        worst(0..3).max(worst(3..31))
    }
}
