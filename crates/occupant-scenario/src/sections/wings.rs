//! `belts.*.nodes.wing`: the iliac wings of the pelvis, on which a lap belt bears, and the abdomen above them.
//!
//! Positions are relative to the sphere of the pelvis and scale with it. How far apart the wings are is a guess.

use nalgebra::{Point3, Vector3};

use super::builder::Builder;
use super::nodes::WingSide;
use occupant_core::body::{Body, Segment, Shares};
pub(super) use occupant_core::forces::chain::wing::ACROSS;
use occupant_core::forces::chain::wing::{ANGLES_RAD, DRAG_N_S_M, PLACE, RADIUS};
use occupant_core::forces::chain::{Next, Track, Wing};

/// Lateral position of a wing, as a fraction of the sphere's radius.
const BESIDE: f64 = 0.95;

/// Minimum initial distance of webbing from a wing's ends, rad.
const EDGE_RAD: f64 = 0.05;

/// The pelvis segment and the wing of a side, from which webbing slides to the abdomen.
pub(super) fn track(
    b: &mut Builder,
    path: &str,
    body: &Body,
    (side, above_m): (WingSide, f64),
) -> Option<(usize, Track)> {
    let pelvis = body.tree.landmarks().pelvis;
    let sphere = body.sphere("pelvis").map(|i| &body.spheres[i]).filter(|sphere| Some(sphere.segment) == pelvis);
    let (Some(sphere), Some(above)) = (sphere, pelvis.and_then(|pelvis| above(body, pelvis))) else {
        b.error(
            &format!("{path}.wing"),
            "`wing` in a body without a pelvis",
            "a body with a trunk and the sphere pelvis",
        );
        return None;
    };
    let r = sphere.radius_m;
    let (y, wing) = if side == WingSide::Left { (BESIDE * r, Wing::Left) } else { (-BESIDE * r, Wing::Right) };
    let radius_m = RADIUS * r;
    let along = |angle: f64| {
        let (sine, cosine) = occupant_units::trig::sin_cos(angle);
        radius_m * Vector3::new(cosine, 0.0, sine)
    };
    let start = sphere.centre_from_lower_end_m + Vector3::new(PLACE[0] * r, y, PLACE[1] * r);
    let point = |angle: f64| start + along(angle) - along(ANGLES_RAD[1]);
    let mut angles = ANGLES_RAD;
    angles[1] += above_m / radius_m;
    let [low, high] = [ANGLES_RAD[0] + EDGE_RAD, ANGLES_RAD[2] - EDGE_RAD];
    if !(low..=high).contains(&angles[1]) {
        let mm = |angle: f64| 1e3 * radius_m * (angle - ANGLES_RAD[1]);
        // of two wings of a belt the one tells it
        if side == WingSide::Right {
            return None;
        }
        b.error(
            &format!("{path}.above"),
            format!("webbing that begins {:.0} mm above its usual place, which is no place on the wing", 1e3 * above_m),
            format!("{:.0} mm to {:.0} mm on this pelvis", mm(low), mm(high)),
        );
        return None;
    }
    let then = Some(abdomen(body, above, 0.5 * y, r));
    Some((
        sphere.segment.index(),
        Track { points_m: angles.map(point), friction: ACROSS, drag_n_s_m: DRAG_N_S_M, wing: Some(wing), then },
    ))
}

/// The trunk segment adjacent to the pelvis.
pub(crate) fn above(body: &Body, pelvis: Segment) -> Option<Segment> {
    let mut ends = body.tree.joint_rows().iter().filter_map(|row| match pelvis {
        _ if row.proximal == pelvis => Some(row.distal),
        _ if row.distal == pelvis => Some(row.proximal),
        _ => None,
    });
    ends.find(|segment| body.tree.is_trunk(*segment))
}

/// Position of webbing that has slid off a wing: on the plate of the abdomen, or where its front would be.
fn abdomen(body: &Body, above: Segment, y: f64, radius_m: f64) -> Next {
    let plate = body.plates.iter().position(|plate| plate.name == "abdomen");
    let (segment, place, ride) = match plate {
        Some(i) => (body.plates[i].segment, body.plates[i].place_from_lower_end_m, vec![(i, 1.0)]),
        None => (above, Point3::new(0.8 * radius_m, 0.0, 0.5 * body.segment(above).length_m), Vec::new()),
    };
    Next { segment: segment.index(), point_m: Point3::new(place.x, y, place.z), ride }
}

/// Shares of the deflection of flesh in front of the pelvis that a wing follows, if there is any.
pub(super) fn flesh(body: &Body) -> Shares {
    let own = body
        .plates
        .iter()
        .position(|plate| plate.name == "flesh" && Some(plate.segment) == body.tree.landmarks().pelvis);
    own.map(|flesh| (flesh, 1.0)).into_iter().collect()
}
