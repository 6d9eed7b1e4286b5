//! Initial orientations of segments: from angles under their names to a state.

use nalgebra::{Matrix3, UnitQuaternion, Vector3};

use crate::body::{Body, Joint, Segment};
use crate::model::seating::{Mounting, angle_of};
use crate::motion::layout::Layout;
use crate::motion::report_coordinates::quaternion;
use crate::motion::state::{Shape, State};
use crate::motion::vector::V3;
use crate::vehicle::{Attitude, FrameMotion};

/// State of a body on a mount, with zero velocities. `carrier` is the motion of the mount's frame.
pub(crate) fn hang(body: &Body, mounting: &Mounting, carrier: &FrameMotion) -> State<f64> {
    let mount = mounting.mount(body.joint_m(body.tree.segment(0)));
    let yaw = Attitude { yaw_rad: mounting.attitude.yaw_rad, ..Attitude::default() };
    let pose = Pose::new(body, &mounting.angles_rad, |_| None, Some(mounting.facing(&yaw)), mount.axes.to_matrix());
    pose.state(body, mount.place.to_vector(), carrier)
}

/// Orientations of the segments, vehicle axes, and angles of the hinges.
pub(super) struct Pose {
    pub(super) axes: Vec<Matrix3<f64>>,
    /// By segment; 0 without a hinge.
    hinge_rad: Vec<f64>,
}

impl Pose {
    /// Segments lean in the vehicle's X–Z plane, or in the plane that `facing` turns it to; those of legs by `of_leg`.
    /// The first segment has the axes `first` unless its lean is given.
    pub(super) fn new(
        body: &Body,
        angles_rad: &[(String, f64)],
        of_leg: impl Fn(Segment) -> Option<f64>,
        facing: Option<Matrix3<f64>>,
        first: Matrix3<f64>,
    ) -> Self {
        let count = body.segments.len();
        let mut pose = Pose { axes: vec![first; count], hinge_rad: vec![0.0; count] };
        for segment in body.tree.segments() {
            let bearer = body.tree.bearer(segment);
            let row = bearer.map(|joint| &body.tree[joint]);
            let hinge = row.filter(|row| row.is_hinge());
            let name = hinge.map_or(body.tree[segment].name, |row| row.name);
            let said = of_leg(segment).or_else(|| angle_of(angles_rad, name));
            let axes = match (bearer, said) {
                (Some(joint), angle_rad) if hinge.is_some() => {
                    pose.hinge_rad[segment.index()] = angle_rad.unwrap_or_default();
                    pose.carried(body, joint, angle_rad.unwrap_or_default())
                }
                (_, Some(angle_rad)) => facing.map_or_else(|| leaned(angle_rad), |facing| facing * leaned(angle_rad)),
                (Some(joint), None) => pose.carried(body, joint, 0.0),
                (None, None) => first,
            };
            pose.axes[segment.index()] = axes;
        }
        pose
    }

    /// Axes of the outer segment of a joint, with the distal segment turned about the joint's Y axis.
    fn carried(&self, body: &Body, joint: Joint, angle_rad: f64) -> Matrix3<f64> {
        let [carrying, carried] = body.sites(joint);
        let angle_rad = if body.tree[joint].is_reversed() { -angle_rad } else { angle_rad };
        let turn =
            carrying.axes * UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle_rad) * carried.axes.inverse();
        self.axes[body.tree[joint].carrying()[0].index()] * turn.to_rotation_matrix().into_inner()
    }

    /// T1 for a lower end of `from` at `lower_end`, vehicle axes.
    pub(super) fn t1_m(&self, body: &Body, from: Segment, lower_end: Vector3<f64>) -> Vector3<f64> {
        let mut place = lower_end;
        for segment in body.tree.inwards(from) {
            place += self.axes[segment.index()] * body.joint_m(segment);
            if let Some(joint) = body.tree.carrier(segment) {
                let proximal = body.tree[joint].proximal.index();
                place -= self.axes[proximal] * body.place(joint).proximal.point_m;
            }
        }
        place
    }

    pub(super) fn state(&self, body: &Body, t1_m: Vector3<f64>, vehicle: &FrameMotion) -> State<f64> {
        let layout = Layout::of(body.tree);
        let mut state = State::zero(Shape::of(&layout));
        state.set_t1(V3::of(&vehicle.point_to_space(t1_m)));
        for (slot, &n) in layout.free().iter().enumerate() {
            // Bⁿ (111), which is Tⁿ at the start: X′ = Bⁿ X_n (110)
            state.set_orientation(slot, quaternion(&(vehicle.rotation * self.axes[n])));
        }
        for (slot, &n) in layout.hinged().iter().enumerate() {
            // of two axes the posture speaks of the first
            if layout.hinge_slot(n) == Some(slot) {
                state.hinge_mut()[slot] = self.hinge_rad[n];
            }
        }
        state
    }
}

/// Z axis of a segment that leans back by γ, vehicle axes (Eq. 109).
pub(super) fn along(gamma: f64) -> Vector3<f64> {
    let (s, c) = occupant_units::trig::sin_cos(gamma);
    Vector3::new(-s, 0.0, -c)
}

/// Axes of a segment that leans back by γ, vehicle axes: X forward, Y left.
pub(super) fn leaned(gamma: f64) -> Matrix3<f64> {
    let z = along(gamma);
    let y = -Vector3::y();
    Matrix3::from_columns(&[y.cross(&z), y, z])
}
