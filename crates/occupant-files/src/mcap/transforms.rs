//! `/tf`: space → vehicle → the segments. Every message holds every frame, because a viewer that jumps in time
//! reads only the last one.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use occupant_core::body::{Body, Segment};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::results::sample::Sample;

use super::scene::compartment::frame_name;
use super::topics::{SPACE_FRAME, VEHICLE_FRAME, segment_frame};
use super::wire::Wire;

/// Names of the segments' frames, made once.
#[derive(Debug)]
pub struct FrameNames(Vec<String>);

impl FrameNames {
    /// Those of a body.
    pub fn new(body: &Body) -> Self {
        FrameNames(body.tree.segment_rows().iter().map(|row| segment_frame(row.name)).collect())
    }

    /// The frame of a segment.
    pub fn of(&self, segment: Segment) -> &str {
        &self.0[segment.index()]
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
}
