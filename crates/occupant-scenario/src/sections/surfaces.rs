//! `[surfaces]` and `[contact]`: the keys of a surface, converted to a [`Surface`].

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::{Builder, index_of};
use super::frames::{Meets, ground};
use super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, point, si_or};
use super::{Angle, Length, Ratio, Scenario};
use occupant_core::body::Body;
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
use placed_text::{Problem, with_key};

/// A plane surface: `points`, `edge` with `half_width`, `disc`, or `plane`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-exactly-one" = [["points", "edge", "disc", "plane"]],
    "x-together" = [["edge", "half_width"]],
))]
pub(crate) struct SurfaceSection {
    /// Name of its material in `materials`.
    pub(crate) material: String,
    /// Frame that it is fixed to: "vehicle", "space", "ground", or the name of another vehicle, a frame or a loose
    /// body; "vehicle" if absent.
    pub(crate) frame: Option<String>,
    /// With several bodies, which ones can touch it: "own", those that start in its vehicle; "others", all except
    /// those; or "all". "own" if absent, because a surface has only one side; `check` then lists bodies that pass
    /// through it. Surfaces of no vehicle can be touched by all.
    pub(crate) meets: Option<Meets>,
    /// Corners [x, y, z] in order round a convex plane polygon.
    #[schemars(extend("minItems" = 3))]
    pub(crate) points: Option<Vec<[Length; 3]>>,
    /// Two points [x, z] of a rectangle seen from the side.
    pub(crate) edge: Option<[[Length; 2]; 2]>,
    /// Half the rectangle's width.
    pub(crate) half_width: Option<Length<POSITIVE>>,
    /// Half the width at the second point of `edge`, if it differs.
    pub(crate) end_half_width: Option<Length<NOT_NEGATIVE>>,
    /// Lateral position of the rectangle's centre; 0 if absent.
    pub(crate) y: Option<Length>,
    /// A circular disc, such as a steering wheel.
    pub(crate) disc: Option<DiscSection>,
    /// An unbounded plane.
    pub(crate) plane: Option<PlaneSection>,
    /// A point on the open side, in the surface's frame; the scenario's `inside` if absent.
    pub(crate) inside: Option<[Length; 3]>,
    /// "order": the order of the corners, or `normal`, gives the open side, instead of a point.
    pub(crate) facing: Option<FacingChoice>,
    /// Names of the body parts or spheres that can touch it; all if absent.
    pub(crate) spheres: Option<Vec<String>>,
    /// True: it supports the spine, as a seat back does, so a deformable chest meets it as rigid. If absent, only the
    /// `back` of the seat.
    pub(crate) behind: Option<bool>,
}

/// A circular disc.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["tilt", "normal"]]))]
pub(crate) struct DiscSection {
    /// Centre.
    pub(crate) centre: [Length; 3],
    /// Diameter.
    pub(crate) diameter: Length<POSITIVE>,
    /// Angle of the disc's plane from the vertical, upper edge forward, as for a steering wheel.
    pub(crate) tilt: Option<Angle>,
    /// Normal of the disc; any length.
    pub(crate) normal: Option<[Ratio; 3]>,
}

/// An unbounded plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaneSection {
    /// A point on it.
    pub(crate) point: [Length; 3],
    /// Its normal; any length.
    pub(crate) normal: [Ratio; 3],
}

/// Definition of the open side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum FacingChoice {
    /// Corners are counter-clockwise seen from the open side; a normal points to it.
    Order,
}

/// Options for contact forces.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactSection {
    /// Where the in-plane force of a surface's edge acts on a sphere. "centre" conserves energy. "contact_point", as in
    /// the 1970 report and in version 0.1.0, creates energy when bodies turn at edges. Solids have no such force.
    /// "centre" if absent.
    pub(crate) edge_force: Option<EdgeForce>,
    /// Default skin material of bodies that touch each other. The skins of two touching spheres deform in series.
    pub(crate) skin: Option<String>,
    /// Pairs of bodies that can touch each other, by their names; all if absent.
    pub(crate) bodies: Option<Vec<[String; 2]>>,
}

/// Point of action of the edge force.
pub(super) fn edge_force(s: &Scenario) -> EdgeForce {
    s.contact.as_ref().and_then(|c| c.edge_force).unwrap_or_default()
}

/// All surfaces, in the order written.
pub(super) fn surfaces(b: &mut Builder, scenario: &Scenario, body: &Body) -> Vec<Surface> {
    let mut undecided = Vec::new();
    let each = scenario.surfaces.iter();
    let surfaces: Vec<Surface> = each
        .map(|(name, section)| surface(b, scenario, body, (&with_key("surfaces", name), name, section), &mut undecided))
        .collect();
    report_undecided(b, &undecided);
    surfaces.into_iter().chain(ground(scenario)).collect()
}

/// The surface defined at `path`.
pub(super) fn surface(
    b: &mut Builder,
    scenario: &Scenario,
    body: &Body,
    (path, name, section): (&str, &str, &SurfaceSection),
    undecided: &mut Vec<String>,
) -> Surface {
    let frame = b.frame(scenario, &with_key(path, "frame"), section.frame.as_deref());
    let spheres = format!("{path}.spheres");
    Surface {
        name: name.to_owned(),
        frame,
        outline: outline(b, path, section, frame),
        facing: facing(b, scenario, (path, section), frame, undecided),
        material: index_of(&section.material, scenario.materials.keys().map(String::as_str)),
        spheres: section.spheres.as_ref().map(|names| b.spheres(&spheres, names, body)),
    }
}

fn outline(b: &mut Builder, path: &str, section: &SurfaceSection, frame: Frame) -> Outline {
    if section.edge.is_none() {
        let for_edges = ["half_width", "end_half_width", "y"];
        b.refuse_keys(path, &for_edges, |key| format!("`{key}` without `edge`"), "`edge`, which it needs");
    }
    if let Some(plane) = &section.plane {
        let axis = Vector3::from(all_si(&plane.normal));
        return Outline::Unbounded { point_m: point(&plane.point), axis };
    }
    if let Some(section) = &section.disc {
        return disc(section, frame);
    }
    if let Some(edge) = &section.edge {
        let near = si_or(&section.half_width, f64::NAN);
        let far = si_or(&section.end_half_width, near);
        return Outline::strip(edge.each_ref().map(all_si), si_or(&section.y, 0.0), near, far);
    }
    Outline::Polygon(section.points.iter().flatten().map(point).collect())
}

fn disc(section: &DiscSection, frame: Frame) -> Outline {
    let (centre_m, diameter_m) = (point(&section.centre), section.diameter.si());
    match (&section.tilt, &section.normal) {
        (Some(tilt), None) => Outline::wheel(frame, centre_m, diameter_m, tilt.si()),
        (_, normal) => {
            let axis = normal.as_ref().map_or(Vector3::zeros(), |normal| Vector3::from(all_si(normal)));
            Outline::Disc { centre_m, radius_m: 0.5 * diameter_m, axis }
        }
    }
}

/// The open side: from the surface, otherwise the scenario's `inside`, otherwise a given normal.
fn facing(
    b: &mut Builder,
    scenario: &Scenario,
    (path, section): (&str, &SurfaceSection),
    frame: Frame,
    undecided: &mut Vec<String>,
) -> Facing {
    if let Some(inside) = &section.inside {
        if section.facing.is_some() {
            b.error(&with_key(path, "facing"), "`facing` and `inside` together", "one of them only");
        }
        return Facing::Towards(point(inside));
    }
    match (&section.facing, &scenario.inside, frame) {
        (Some(_), ..) => Facing::Order,
        (None, Some(inside), Frame::Vehicle) => Facing::Towards(point(inside)),
        _ if section.disc.is_some() || section.plane.is_some() => Facing::Order,
        _ => {
            undecided.push(path.to_owned());
            Facing::Order
        }
    }
}

/// One message for all surfaces without an open side.
pub(super) fn report_undecided(b: &mut Builder, paths: &[String]) {
    let Some((first, others)) = paths.split_first() else { return };
    let found = match others.len() {
        0 => format!("the open side of `{first}` is not given"),
        n => format!("the open sides of `{first}` and {n} more are not given"),
    };
    let expected = "inside = [x, y, z], a point on the open side, or facing = \"order\"";
    let hint = "a key `inside` at the top of the scenario applies to all surfaces of the vehicle";
    b.report(Problem::error(first, found, expected).with_hint(Some(hint)));
}
