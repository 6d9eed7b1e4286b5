//! Left and right exchanged: bodies, joints, forces and states seen in the X–Z plane's mirror.

use crate::{
    reference::{PointForce, SpaceMotion, System},
    space_state::SpaceState,
};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::body::{Body, Segment};

impl System {
    /// The mirror image; gravity must lie in the mirror's plane.
    pub fn mirrored(&self) -> System {
        assert_eq!(self.gravity.y, 0.0);
        let mut joints = self.joints.clone();
        for (left, right) in [
            (tti12::LEFT_SHOULDER, tti12::RIGHT_SHOULDER),
            (tti12::LEFT_ELBOW, tti12::RIGHT_ELBOW),
            (tti12::LEFT_HIP, tti12::RIGHT_HIP),
            (tti12::LEFT_KNEE, tti12::RIGHT_KNEE),
        ] {
            joints = joints.with(left, self.joints[right]).with(right, self.joints[left]);
        }
        let force = |f: &PointForce| PointForce {
            segment: other_segment(f.segment),
            point: mirrored_vector(&f.point),
            force: mirrored_vector(&f.force),
        };
        System {
            body: mirrored_body(&self.body),
            joints,
            gravity: self.gravity,
            forces: self.forces.iter().map(force).collect(),
        }
    }
}

impl SpaceState {
    /// The mirror image.
    pub fn mirrored(&self) -> SpaceState {
        // R → S R S with S = diag(1, −1, 1)
        let turn = |q: &UnitQuaternion<f64>| UnitQuaternion::new_unchecked(Quaternion::new(q.w, -q.i, q.j, -q.k));
        SpaceState {
            t1: mirrored_vector(&self.t1),
            turn: FREE_OTHER_SIDE.map(|i| turn(&self.turn[i])),
            hinge: HINGE_OTHER_SIDE.map(|i| self.hinge[i]),
            speed: self.speed.mirrored(),
        }
    }
}

impl SpaceMotion {
    /// The mirror image.
    pub fn mirrored(&self) -> SpaceMotion {
        SpaceMotion {
            t1: mirrored_vector(&self.t1),
            angular: FREE_OTHER_SIDE.map(|i| -mirrored_vector(&self.angular[i])),
            hinge: HINGE_OTHER_SIDE.map(|i| self.hinge[i]),
        }
    }
}

/// Slots of [`crate::reference::FREE`] with arms and legs exchanged.
const FREE_OTHER_SIDE: [usize; 8] = [0, 1, 2, 3, 5, 4, 7, 6];
/// The same for [`crate::reference::HINGED`].
const HINGE_OTHER_SIDE: [usize; 4] = [1, 0, 3, 2];

fn mirrored_body(body: &Body) -> Body {
    let mut spheres = body.spheres.clone();
    for sphere in &mut spheres {
        sphere.segment = other_segment(sphere.segment);
        sphere.centre_from_lower_end_m.y = -sphere.centre_from_lower_end_m.y;
    }
    Body { segments: (0..body.segments.len()).map(|i| body.segments[other_side(i)]).collect(), spheres, ..body.clone() }
}

fn other_segment(segment: Segment) -> Segment {
    TTI12.segment(other_side(segment.index()))
}

const fn other_side(segment: usize) -> usize {
    [0, 1, 2, 3, 5, 4, 7, 6, 9, 8, 11, 10][segment]
}

fn mirrored_vector(v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, v.z)
}
