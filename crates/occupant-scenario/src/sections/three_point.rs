//! `belts.*.preset`: a three-point belt whose points follow from the seat and the body.
//!
//! All positions are our estimates for an ordinary car, from the pelvis of the seated body: metres back, outboard and
//! down.

use indexmap::IndexMap;
use nalgebra::{Matrix2, Vector2};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::belts::BeltSection;
use super::builder::Builder;
use super::functions::WebbingSection;
use super::nodes::{NodeSection, WingSide};
use super::quantity::si_or;
use super::{Length, Ratio, Scenario};
use crate::presets;
use occupant_core::body::Body;
use occupant_core::forces::function::Function;

/// Belts positioned from the seat and the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Preset {
    /// Shoulder and lap belt from one webbing: from an upper anchor on one side over the shoulder, through a buckle on
    /// the other side, to an anchor on the first; it slides through ring and buckle.
    ThreePoint,
}

/// A side of the vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Side {
    /// At negative y.
    #[default]
    Left,
    /// At positive y.
    Right,
}

/// Support of a lap belt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Lap {
    /// The sphere of the pelvis.
    Pelvis,
    /// The iliac wings.
    Wings,
}

/// Retractor position from the pelvis: back, outboard and down, m.
const REEL_M: [f64; 3] = [0.40, 0.27, 0.12];
const RING_M: [f64; 3] = [0.40, 0.27, -0.64];
const BUCKLE_M: [f64; 3] = [0.06, -0.19, 0.04];
const SILL_M: [f64; 3] = [0.12, 0.25, 0.20];

/// Trunk length of the man for whom the ring's height is given; steps and range of its height adjuster, down and up, m.
const TRUNK_M: f64 = 0.4617;
const NOTCH_M: f64 = 0.02;
const ADJUSTS_M: [f64; 2] = [-0.06, 0.04];

/// Friction of a clamping tongue: around its bend it holds a thousand times the tension.
const CLAMPS: f64 = 3.0;

/// Friction of webbing over a steel ring, a tongue and a clothed shoulder; our estimates, similar to ATB's.
const FRICTION: [f64; 3] = [0.1, 0.15, 0.25];

/// Forward lean of the track's plane over the shoulder; our estimate.
const TRACK_LEANS_RAD: f64 = 25.0 * std::f64::consts::PI / 180.0;

/// Points over the chest, inboard of and above the middle of its sphere, in its radii: the belt crosses the middle of the breastbone, as on
/// the dummies of crash tests; the slopes are those of a man in an ordinary car. Ours.
const CHEST: [(&str, f64, f64); 2] = [("breastbone", 0.0, 0.0), ("ribs", 0.256, -0.5)];

/// Depth of a pelvis in a cushion, m.
const SINKS_M: f64 = 0.03;

/// Default webbing of a preset.
pub(super) fn webbing(b: &mut Builder) -> Function {
    let webbing: Option<WebbingSection> = presets::from_library("webbings", "webbing_atb");
    webbing.map_or_else(|| Function::lines(Vec::new(), 1.0), |webbing| webbing.function(b, "webbings").0)
}

/// Nodes of the preset belt at `path`.
pub(super) fn nodes(
    b: &mut Builder,
    scenario: &Scenario,
    body: &Body,
    path: &str,
    section: &BeltSection,
    Preset::ThreePoint: Preset,
) -> Vec<NodeSection> {
    let needed = ["pelvis", "chest", "left_shoulder", "right_shoulder"];
    let lacking = needed.into_iter().find(|name| body.sphere(name).is_none());
    let (Some([x, y, z]), None) = (pelvis_m(scenario, body), lacking) else {
        let expected = "a body with pelvis, chest and shoulders in a seat that has edges or profiles; else `nodes`";
        b.error(&format!("{path}.preset"), "a three-point preset without a suitable seat or body", expected);
        return Vec::new();
    };
    let out = if section.side == Some(Side::Right) { 1.0 } else { -1.0 };
    let at = |[back, outboard, down]: [f64; 3]| Some([x - back, y + out * outboard, z + down].map(Length::of_si));
    let said = |place: &Option<[Length; 3]>, usual| place.clone().or_else(|| at(usual));
    let placed = |name: &str, place| NodeSection { name: Some(name.to_owned()), at: place, ..NodeSection::none() };
    let plain = |name: &str, place| NodeSection { name: Some(name.to_owned()), at: at(place), ..NodeSection::none() };
    let sphere = |name: &str| NodeSection { sphere: Some(name.to_owned()), ..NodeSection::none() };
    let rubs = |node: NodeSection, friction| NodeSection { friction: Some(Ratio::of_si(friction)), ..node };
    let [ring, tongue, shoulder] = FRICTION;
    let ring_m = [RING_M[0], RING_M[1], RING_M[2] - adjusted_m(body)];
    let reel = NodeSection { retractor: section.retractor.clone(), ..plain("reel", REEL_M) };
    let mut nodes = vec![reel, rubs(placed("d_ring", said(&section.d_ring, ring_m)), ring)];
    if section.retractor.is_none() {
        nodes = vec![placed("upper_anchor", said(&section.d_ring, ring_m))];
    }
    nodes.iter_mut().for_each(|node| node.frame.clone_from(&section.d_ring_frame));
    let tongue = if section.locking_tongue == Some(true) { CLAMPS } else { tongue };
    let buckle =
        NodeSection { pretensioner: section.pretensioner.clone(), ..placed("buckle", said(&section.buckle, BUCKLE_M)) };
    nodes.push(rubs(track(body, out), shoulder));
    nodes.extend(over_chest(body, out));
    nodes.push(rubs(buckle, tongue));
    let above = section.lap_above.clone();
    let wing = |name: &str, side| NodeSection {
        name: Some(name.to_owned()),
        wing: Some(side),
        above: above.clone(),
        ..NodeSection::none()
    };
    let mut wings = [wing("right_wing", WingSide::Right), wing("left_wing", WingSide::Left)];
    if out > 0.0 {
        wings.reverse();
    }
    if let (Some(_), None | Some(Lap::Pelvis)) = (&section.lap_above, section.lap) {
        let expected = "`lap = \"wings\"`, on which webbing can lie higher or lower";
        b.error(&format!("{path}.lap_above"), "`lap_above` of a belt round the sphere of the pelvis", expected);
    }
    match section.lap {
        Some(Lap::Wings) => nodes.extend(wings),
        Some(Lap::Pelvis) | None => nodes.push(sphere("pelvis")),
    }
    nodes.push(placed("sill", said(&section.anchor, SILL_M)));
    nodes
}

/// Upward shift of the ring's height adjuster for a body, m: the ring is as far above the shoulder as for an average
/// man.
fn adjusted_m(body: &Body) -> f64 {
    let trunk = body.tree.segments().filter(|segment| body.tree.is_trunk(*segment));
    let trunk_m: f64 = trunk.map(|segment| body.segment(segment).length_m).sum();
    let [down, up] = ADJUSTS_M;
    (NOTCH_M * ((trunk_m - TRUNK_M) / NOTCH_M).round()).clamp(down, up)
}

/// Points of the webbing over the chest: on the front of its sphere, on lines from the middle of the breastbone to the shoulder and to the
/// buckle as seen from ahead. Round the sphere itself the webbing would lie in the plane of its neighbours, beside the chest or behind it.
fn over_chest(body: &Body, out: f64) -> [NodeSection; CHEST.len()] {
    let chest = &body.spheres[body.sphere("chest").unwrap_or(0)];
    let (centre, r) = (chest.centre_from_lower_end_m, chest.radius_m);
    let share = |(plate, share): &(usize, f64)| (body.plates[*plate].name.clone(), Ratio::of_si(*share));
    let ride: IndexMap<String, Ratio> = chest.ride.belt.iter().map(share).collect();
    CHEST.map(|(name, inboard, up)| {
        let normal = [(1.0 - inboard * inboard - up * up).sqrt(), out * inboard, up];
        NodeSection {
            name: Some(name.to_owned()),
            on: Some(body.tree[chest.segment].name.to_owned()),
            at: Some([0, 1, 2].map(|i| Length::of_si(centre[i] + r * normal[i]))),
            normal: Some(normal.map(Ratio::of_si)),
            ride: ride.clone(),
            ..NodeSection::none()
        }
    })
}

/// Track across the outboard shoulder, from beside the neck over the clavicle to below the root of the arm, in a plane
/// that leans forward: webbing loads the front of a shoulder rather than its top.
fn track(body: &Body, out: f64) -> NodeSection {
    let shoulder = &body.spheres[body.sphere(if out > 0.0 { "right_shoulder" } else { "left_shoulder" }).unwrap_or(0)];
    let (centre, r) = (shoulder.centre_from_lower_end_m, shoulder.radius_m);
    let (ahead, up) = occupant_units::trig::sin_cos(TRACK_LEANS_RAD);
    let point = |share: f64, beyond: f64, height: f64| {
        let outward = share * centre.y + beyond * r * centre.y.signum();
        [centre.x + height * r * ahead, outward, centre.z + height * r * up].map(Length::of_si)
    };
    NodeSection {
        name: Some("shoulder".to_owned()),
        on: Some(body.tree[shoulder.segment].name.to_owned()),
        track: Some([point(0.3, 0.0, 1.0), point(0.7, 0.0, 1.0), point(1.0, 0.9, -0.3)]),
        ..NodeSection::none()
    }
}

/// Approximate position of the pelvis of the seated body: at the seat back and slightly in the cushion.
fn pelvis_m(scenario: &Scenario, body: &Body) -> Option<[f64; 3]> {
    let seat = scenario.seats.get(&scenario.posture.as_ref()?.seat)?;
    let r = body.spheres[body.sphere("pelvis")?].radius_m;
    // the faces that a body sits on and leans against, seen from the side
    let cushion = edge(scenario, &seat.cushion, -Vector2::y())?;
    let back = edge(scenario, &seat.back, Vector2::x())?;
    let (up, ahead) = (normal(cushion, -Vector2::y()), normal(back, Vector2::x()));
    let matrix = Matrix2::new(up.x, up.y, ahead.x, ahead.y);
    let right = Vector2::new(up.dot(&cushion[0]) + r - SINKS_M, ahead.dot(&back[0]) + r);
    let place = matrix.try_inverse()? * right;
    Some([place.x, si_or(&seat.y, 0.0), place.y])
}

/// The normal of an edge towards a direction.
fn normal([a, b]: [Vector2<f64>; 2], towards: Vector2<f64>) -> Vector2<f64> {
    let along = b - a;
    let normal = Vector2::new(-along.y, along.x).normalize();
    normal * normal.dot(&towards).signum()
}

/// The edge of a surface's or solid's side that faces a direction most, as points x, z, m.
fn edge(scenario: &Scenario, name: &str, looks: Vector2<f64>) -> Option<[Vector2<f64>; 2]> {
    let point = |point: &[Length; 2]| Vector2::new(point[0].si(), point[1].si());
    if let Some(surface) = scenario.surfaces.get(name) {
        return surface.edge.as_ref().map(|edge| edge.each_ref().map(point));
    }
    let points: Vec<_> = scenario.solids.get(name)?.profile()?.iter().map(point).collect();
    let middle = points.iter().sum::<Vector2<f64>>() / points.len() as f64;
    let edges = (0..points.len()).map(|i| [points[i], points[(i + 1) % points.len()]]);
    let outward = |[a, b]: [Vector2<f64>; 2]| normal([a, b], (a + b) / 2.0 - middle).dot(&looks);
    edges.max_by(|a, b| outward(*a).total_cmp(&outward(*b)))
}
