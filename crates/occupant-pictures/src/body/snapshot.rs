//! Drawing data of one output, in vehicle axes.

use nalgebra::{Isometry3, Matrix3, Point3, Translation3, Vector3};
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::solid::Solid;
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_core::forces::shown::{Line, Section};
use occupant_core::model::Model;
use occupant_core::model::setup::Scenery;
use occupant_core::results::sample::{Contact, Sample};
use occupant_core::vehicle::FrameMotion;

use occupant_files::mcap::scene::compartment::{corners_m, square_m};

/// Half side of the square drawn for an unbounded plane, m.
pub const PATCH_M: f64 = 3.0;

/// Name of the ground of driven vehicles among the scenery, and number of its pieces that is drawn as surfaces are.
const ROAD: &str = "road";
const FEW_PIECES: usize = 60;

/// The body, the contacts and other force elements at one output.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Time, s.
    pub time_s: f64,
    /// By segment: pose of the segment axes at the centre of gravity in vehicle axes.
    pub poses: Vec<Isometry3<f64>>,
    /// Centres of the spheres, m.
    pub spheres_m: Vec<Point3<f64>>,
    /// Lines of force elements.
    pub lines: Vec<Line>,
    /// Plane figures of force elements.
    pub sections: Vec<Section>,
    /// Touching pairs.
    pub contacts: Vec<Contact>,
    /// Motion of the vehicle in space.
    pub vehicle: FrameMotion,
    /// Motions of the other frames with surfaces or solids.
    frames: Vec<(Frame, FrameMotion)>,
}

impl Snapshot {
    /// The body of a sample.
    pub fn of(sample: &Sample<'_>) -> Self {
        let sample = &sample.seen_by_vehicle();
        let pose = |segment| {
            let at = Translation3::from(sample.cg_m(segment));
            Isometry3::from_parts(at, sample.orientation(segment))
        };
        let body = sample.model.body();
        Snapshot {
            time_s: sample.time_s,
            poses: body.tree.segments().map(pose).collect(),
            spheres_m: (0..body.spheres.len()).map(|s| sample.sphere_centre_m(s)).collect(),
            lines: sample.lines(),
            sections: sample.sections(),
            contacts: sample.contacts().collect(),
            vehicle: *sample.vehicle,
            frames: frames(sample),
        }
    }

    /// The same moment as if its vehicle were where another one is: nothing moves within the vehicle's axes.
    pub fn carried_by(&self, vehicle: &FrameMotion) -> Self {
        let own = &self.vehicle;
        let turn = vehicle.rotation * own.rotation.transpose();
        let moved = |motion: &FrameMotion| FrameMotion {
            origin_m: vehicle.origin_m + turn * (motion.origin_m - own.origin_m),
            rotation: turn * motion.rotation,
            ..*motion
        };
        // what stands still in space moves with it
        let space = FrameMotion { origin_m: Vector3::zeros(), rotation: Matrix3::identity(), ..*own };
        let still = (!self.frames.iter().any(|(known, _)| *known == Frame::Space)).then_some((Frame::Space, space));
        let frames = self.frames.iter().copied().chain(still).map(|(frame, motion)| (frame, moved(&motion))).collect();
        Snapshot { vehicle: *vehicle, frames, ..self.clone() }
    }

    /// The surfaces, then all faces of the solids, then scenery without relief, as polygons, m.
    pub fn polygons_m(&self, model: &Model) -> Vec<Vec<Point3<f64>>> {
        let faces = model.faces().iter().map(|face| self.corners_m(face));
        let solids = &model.setup().solids;
        let sides = solids.iter().flat_map(|s| s.outline().into_iter().map(|side| self.placed(s.frame, side)));
        let drawn = model.setup().scenery.iter().filter(|own| !is_relief(own));
        let drawn = drawn.flat_map(|own| own.polygons_m.iter().map(|side| self.placed(own.frame, side.clone())));
        faces.chain(sides).chain(drawn).collect()
    }

    /// Ground of many pieces, m.
    pub fn relief_m(&self, model: &Model) -> Vec<Vec<Point3<f64>>> {
        let drawn = model.setup().scenery.iter().filter(|own| is_relief(own));
        drawn.flat_map(|own| own.polygons_m.iter().map(|side| self.placed(own.frame, side.clone()))).collect()
    }

    /// A surface's corners, an unbounded one's as a square below the vehicle's origin, m.
    pub fn corners_m(&self, face: &FlatFace) -> Vec<Point3<f64>> {
        let corners = match &face.outline {
            Outline::Unbounded { .. } => self.patch_m(face),
            _ => corners_m(face),
        };
        self.placed(face.frame, corners)
    }

    /// The faces of a solid, m.
    pub fn solid_m(&self, solid: &Solid) -> Vec<Vec<Point3<f64>>> {
        solid.outline().into_iter().map(|side| self.placed(solid.frame, side)).collect()
    }

    /// Points of a frame, such as those of scenery, in vehicle axes, m.
    pub fn placed_m(&self, frame: Frame, points: &[Point3<f64>]) -> Vec<Point3<f64>> {
        self.placed(frame, points.to_vec())
    }

    /// Points of a frame converted to vehicle axes.
    fn placed(&self, frame: Frame, corners: Vec<Point3<f64>>) -> Vec<Point3<f64>> {
        let to_space = |p: &Point3<f64>| match self.frames.iter().find(|(known, _)| *known == frame) {
            Some((_, motion)) => motion.point_to_space(p.coords),
            None => p.coords,
        };
        match frame {
            Frame::Vehicle => corners,
            _ => corners.iter().map(|p| self.vehicle.point_to_frame(to_space(p)).into()).collect(),
        }
    }

    fn patch_m(&self, face: &FlatFace) -> Vec<Point3<f64>> {
        let origin = match face.frame {
            Frame::Vehicle => Vector3::zeros(),
            frame => {
                let motion = self.frames.iter().find(|(known, _)| *known == frame);
                motion.map_or(self.vehicle.origin_m, |(_, motion)| motion.point_to_frame(self.vehicle.origin_m))
            }
        };
        let height = face.normal.dot(&origin) - face.offset_m;
        let foot = origin - face.normal * height;
        square_m(face, foot.into(), PATCH_M)
    }
}

/// Whether scenery is ground of so many pieces that their edges would hide the body.
fn is_relief(own: &Scenery) -> bool {
    own.name == ROAD && own.polygons_m.len() > FEW_PIECES
}

/// Motions of the frames of surfaces, solids and scenery besides those of the vehicle and of space.
fn frames(sample: &Sample<'_>) -> Vec<(Frame, FrameMotion)> {
    let setup = sample.model.setup();
    let mut all: Vec<(Frame, FrameMotion)> = Vec::new();
    let touched = setup.surfaces.iter().map(|s| s.frame).chain(setup.solids.iter().map(|s| s.frame));
    for frame in touched.chain(setup.scenery.iter().map(|own| own.frame)) {
        if !matches!(frame, Frame::Vehicle | Frame::Space) && all.iter().all(|(known, _)| *known != frame) {
            all.push((frame, sample.frame(frame)));
        }
    }
    all
}
