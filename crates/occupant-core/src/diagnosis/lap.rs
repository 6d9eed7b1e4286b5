//! Whether lap belts start at an angle at which they slide up the iliac wings.

use nalgebra::{Point3, Vector3};
use serde::Serialize;

use super::rates::frame_at;
use crate::body::Segment;
use crate::forces::chain::wing::{ACROSS, ANGLES_RAD, across};
use crate::forces::chain::{Chain, Node, Site};
use crate::forces::contact::surface::Frame;
use crate::model::Model;
use crate::motion::kinematics::Kinematics;

/// A lap belt that would slide up on the iliac wings from the start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LapBelt {
    /// Name of the belt.
    pub belt: String,
    /// Its support: a sphere or a segment.
    pub part: String,
    /// Angle of its pull to the wings' normal, positive towards the abdomen.
    pub angle_rad: f64,
    /// Largest angle held by friction.
    pub held_rad: f64,
}

/// All such belts.
pub(super) fn sliding(model: &Model) -> Vec<LapBelt> {
    let setup = model.setup();
    let loops = setup.belts.iter().filter_map(|belt| {
        let part = &setup.body.spheres[belt.sphere];
        let centre_m = part.centre_from_lower_end_m;
        one(model, &belt.name, (&part.name, part.segment, centre_m), (belt.frame, &belt.anchors_m))
    });
    loops.chain(setup.chains.iter().filter_map(|chain| of_chain(model, chain))).collect()
}

/// A belt over several nodes: its part on the pelvis between two vehicle nodes.
fn of_chain(model: &Model, chain: &Chain) -> Option<LapBelt> {
    let body = model.body();
    let on = |node: &Node| match &node.site {
        Site::Sphere(sphere) => {
            let sphere = &body.spheres[*sphere];
            Some((sphere.name.as_str(), sphere.segment, sphere.centre_from_lower_end_m))
        }
        Site::Track(segment, track) if track.wing.is_some() => {
            let segment = body.tree.segment(*segment);
            Some((body.tree[segment].name, segment, track.points_m[1]))
        }
        Site::Segment(segment, point_m, _) => {
            let segment = body.tree.segment(*segment);
            Some((body.tree[segment].name, segment, *point_m))
        }
        _ => None,
    };
    let is_lap = |node: &Node| on(node).is_some_and(|(_, segment, _)| is_pelvis(model, segment));
    let first = chain.nodes.iter().position(is_lap)?;
    let last = chain.nodes.iter().rposition(is_lap)?;
    let anchor = |node: Option<&Node>| match node?.site {
        Site::Vehicle(point, _) => Some(point),
        _ => None,
    };
    let anchors = [anchor(chain.nodes.get(first.checked_sub(1)?))?, anchor(chain.nodes.get(last + 1))?];
    one(model, &chain.belt, on(&chain.nodes[first])?, (chain.frame, &anchors))
}

fn is_pelvis(model: &Model, segment: Segment) -> bool {
    model.body().tree.landmarks_at(segment).pelvis == Some(segment)
}

/// A belt over a point of the pelvis, from its lower end, with anchors in a frame; none if friction holds it.
fn one(
    model: &Model,
    belt: &str,
    (part, segment, place_m): (&str, Segment, Point3<f64>),
    (frame, anchors_m): (Frame, &[Point3<f64>; 2]),
) -> Option<LapBelt> {
    if !is_pelvis(model, segment) {
        return None;
    }
    let held_by = frame_at(model, frame, model.setup().time.start_s);
    let k = Kinematics::new(&model.system().skeleton, &model.start().state);
    let n = segment.index();
    let (joint_m, axes) = (k.joint[n].to_vector(), k.axes[n].to_matrix());
    let place_m = place_m - model.body().joint_m(segment);
    let pull: Vector3<f64> = anchors_m
        .iter()
        .map(|anchor| axes.tr_mul(&(held_by.point_to_space(anchor.coords) - joint_m)) - place_m.coords)
        .map(|way| Vector3::new(way.x, 0.0, way.z).normalize())
        .sum();
    let below_rad = occupant_units::trig::atan2(-pull.z, -pull.x);
    let tangent = across(ANGLES_RAD[1], below_rad);
    let [angle_rad, held_rad] = [tangent, ACROSS].map(|tangent| occupant_units::trig::atan2(tangent, 1.0));
    (angle_rad > held_rad).then(|| LapBelt { belt: belt.to_owned(), part: part.to_owned(), angle_rad, held_rad })
}
