//! What there is to draw at one output, in vehicle axes.

use nalgebra::{Isometry3, Point3, Translation3, Vector3};
use occupant_core::forces::contact::flat_face::FlatFace;
use occupant_core::forces::contact::surface::{Frame, Outline};
use occupant_core::results::sample::{Contact, Sample};
use occupant_core::vehicle::FrameMotion;

use crate::files::mcap::scene::belts::course_m;
use crate::files::mcap::scene::compartment::corners_m;

/// Half side of the square that stands for an unbounded plane, m.
pub(crate) const PATCH_M: f64 = 3.0;

/// The body, the belts and the contacts at one output.
#[derive(Clone, Debug)]
pub(crate) struct Snapshot {
    pub(crate) time_s: f64,
    /// By segment: turns and moves from segment axes at the centre of gravity to vehicle axes.
    pub(crate) poses: Vec<Isometry3<f64>>,
    /// Centres of the spheres, m.
    pub(crate) spheres_m: Vec<Point3<f64>>,
    /// Belts, in the setup's order.
    pub(crate) belts: Vec<BeltCourse>,
    /// Touching pairs.
    pub(crate) contacts: Vec<Contact>,
    /// Motion of the vehicle in space.
    pub(crate) vehicle: FrameMotion,
}

/// A belt from anchor to anchor.
#[derive(Clone, Debug)]
pub(crate) struct BeltCourse {
    pub(crate) points_m: Vec<Point3<f64>>,
    /// F_L, N.
    pub(crate) force_n: f64,
}

impl Snapshot {
    pub(crate) fn of(sample: &Sample<'_>) -> Self {
        let pose = |segment| {
            let at = Translation3::from(sample.cg_m(segment));
            Isometry3::from_parts(at, sample.orientation(segment))
        };
        let body = sample.model.body();
        let belts = sample.model.setup().belts.iter().zip(&sample.actions.belts);
        let course = |(belt, action): (&occupant_core::forces::belt::Belt, _)| {
            let radius = body.spheres[belt.sphere].radius_m;
            let centre = sample.sphere_centre_m(belt.sphere);
            course_m(belt, radius, centre, action)
        };
        Snapshot {
            time_s: sample.time_s,
            poses: body.tree.segments().map(pose).collect(),
            spheres_m: (0..body.spheres.len()).map(|s| sample.sphere_centre_m(s)).collect(),
            belts: belts.map(|both| BeltCourse { points_m: course(both), force_n: both.1.loop_force }).collect(),
            contacts: sample.contacts().collect(),
            vehicle: *sample.vehicle,
        }
    }

    /// A surface's corners, an unbounded one's as a square below the vehicle's origin, m.
    pub(crate) fn corners_m(&self, face: &FlatFace) -> Vec<Point3<f64>> {
        let corners = match &face.outline {
            Outline::Unbounded { .. } => self.patch_m(face),
            _ => corners_m(face),
        };
        match face.frame {
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
        let (u, v) = face.plane_axes();
        [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
            .map(|(a, b)| Point3::from(foot + (u * a + v * b) * PATCH_M))
            .to_vec()
    }
}
