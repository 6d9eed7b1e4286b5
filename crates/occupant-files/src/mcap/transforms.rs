//! `/tf`: space → vehicle → the segments → spheres that ride on parts of them that yield. Every message holds every frame,
//! because a viewer that jumps in time reads only the last one.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use occupant_core::body::{Body, ContactSphere, Segment};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::results::sample::Sample;

use super::scene::compartment::frame_name;
use super::topics::{SPACE_FRAME, VEHICLE_FRAME, ridden_frame, segment_frame};
use super::wire::Wire;

/// Names of the frames of segments and of riding spheres, built once.
#[derive(Debug)]
pub struct FrameNames {
    segments: Vec<String>,
    /// By sphere; none if it rides on nothing.
    ridden: Vec<Option<String>>,
}

impl FrameNames {
    /// Names for a body.
    pub fn new(body: &Body) -> Self {
        let rides = |sphere: &ContactSphere| !sphere.ride.contact.is_empty();
        let ridden = |s: &ContactSphere| rides(s).then(|| ridden_frame(body.tree[s.segment].name, &s.name));
        FrameNames {
            segments: body.tree.segment_rows().iter().map(|row| segment_frame(row.name)).collect(),
            ridden: body.spheres.iter().map(ridden).collect(),
        }
    }

    /// The frame of a segment.
    pub fn of(&self, segment: Segment) -> &str {
        &self.segments[segment.index()]
    }

    /// The frame in which a sphere (index) is fixed.
    pub fn of_sphere(&self, body: &Body, sphere: usize) -> &str {
        self.ridden[sphere].as_deref().unwrap_or_else(|| self.of(body.spheres[sphere].segment))
    }
}

/// A `foxglove.FrameTransforms`.
pub fn write(wire: &mut Wire, ns: u64, sample: &Sample<'_>, names: &FrameNames) {
    let sample = &sample.seen_by_vehicle();
    let vehicle = sample.vehicle;
    let turned = Rotation3::from_matrix_unchecked(vehicle.rotation);
    let rotation = UnitQuaternion::from_rotation_matrix(&turned);
    let mut transform = |parent: &str, child: &str, translation: &Vector3<f64>, rotation: &UnitQuaternion<f64>| {
        wire.message(1, |w| {
            w.time(1, ns);
            w.text(2, parent);
            w.text(3, child);
            w.vector(4, translation);
            w.rotation(5, rotation);
        });
    };
    transform(SPACE_FRAME, VEHICLE_FRAME, &vehicle.origin_m, &rotation);
    let mut of = |frame: Frame| {
        let motion = sample.frame(frame);
        let turned = Rotation3::from_matrix_unchecked(motion.rotation);
        let rotation = UnitQuaternion::from_rotation_matrix(&turned);
        transform(SPACE_FRAME, &frame_name(sample.model, frame), &motion.origin_m, &rotation);
    };
    (0..sample.model.setup().frames.len()).for_each(|i| of(Frame::Other(i)));
    sample.model.system().carriers.iter().for_each(|segment| of(Frame::Segment(*segment)));
    for segment in sample.model.body().tree.segments() {
        let (place, turn) = (sample.cg_m(segment), sample.orientation(segment));
        transform(VEHICLE_FRAME, names.of(segment), &place.coords, &turn);
    }
    for (i, sphere) in sample.model.body().spheres.iter().enumerate() {
        if let (Some(frame), Some(carried_m)) = (&names.ridden[i], sample.sphere_carried_m(i)) {
            transform(names.of(sphere.segment), frame, &carried_m, &UnitQuaternion::identity());
        }
    }
}
