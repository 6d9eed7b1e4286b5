//! What there is to draw at one output, in vehicle axes.

use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_core::forces::shown::{Line, Section};
use occupant_core::model::Model;
use occupant_core::results::sample::{Contact, Sample};
use occupant_core::vehicle::FrameMotion;

use crate::files::mcap::scene::compartment::{corners_m, square_m};

/// Half side of the square that stands for an unbounded plane, m.
pub(crate) const PATCH_M: f64 = 3.0;

/// The body, the contacts and other force elements at one output.
#[derive(Clone, Debug)]
pub(crate) struct Snapshot {
    pub(crate) time_s: f64,
    /// By segment: turns and moves from segment axes at the centre of gravity to vehicle axes.
    pub(crate) poses: Vec<Isometry3<f64>>,
    /// Centres of the spheres, m.
    pub(crate) spheres_m: Vec<Point3<f64>>,
    /// Lines of force elements.
    pub(crate) lines: Vec<Line>,
    /// Plane figures of force elements.
    pub(crate) sections: Vec<Section>,
    /// Touching pairs.
    pub(crate) contacts: Vec<Contact>,
    /// Motion of the vehicle in space.
    pub(crate) vehicle: FrameMotion,
}

impl Snapshot {
    pub(crate) fn of(sample: &Sample<'_>) -> Self {
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
        }
    }

    /// What there is to touch, as polygons: the surfaces, then all sides of the solids, m.
    pub(crate) fn polygons_m(&self, model: &Model) -> Vec<Vec<Point3<f64>>> {
        let faces = model.faces().iter().map(|face| self.corners_m(face));
        let solids = &model.setup().solids;
        let sides = solids.iter().flat_map(|s| s.outline().into_iter().map(|side| self.placed(s.frame, side)));
        faces.chain(sides).collect()
    }

    /// A surface's corners, an unbounded one's as a square below the vehicle's origin, m.
    pub(crate) fn corners_m(&self, face: &FlatFace) -> Vec<Point3<f64>> {
        let corners = match &face.outline {
            Outline::Unbounded { .. } => self.patch_m(face),
            _ => corners_m(face),
        };
        self.placed(face.frame, corners)
    }

    /// Points of a frame in vehicle axes.
    fn placed(&self, frame: Frame, corners: Vec<Point3<f64>>) -> Vec<Point3<f64>> {
        match frame {
            Frame::Vehicle => corners,
            Frame::Space => {
                let place = |p: &Point3<f64>| self.vehicle.point_to_frame(p.coords).into();
                corners.iter().map(place).collect()
            }
        }
    }

    fn patch_m(&self, face: &FlatFace) -> Vec<Point3<f64>> {
        let origin = match face.frame {
            Frame::Vehicle => Vector3::zeros(),
            Frame::Space => self.vehicle.origin_m,
        };
        let height = face.normal.dot(&origin) - face.offset_m;
        let foot = origin - face.normal * height;
        square_m(face, foot.into(), PATCH_M)
    }
}
