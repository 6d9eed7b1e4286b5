//! Deformable parts of the trunk: `body.chest`, `body.plates`, `body.plate_links` and `ride`.

use indexmap::IndexMap;
use nalgebra::{Point3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::body::BodySection;
use super::builder::Builder;
use super::functions::{function, listed, points};
use super::nodes::NodeSection;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, Quantity, all_si, point, si_or};
use super::{Damping, Force, Length, Mass, QuadraticDamping, Ratio, Scenario, Stiffness, Time};
use crate::presets::chest;
use occupant_core::body::{Body, Chest, Plate, Ride, Shares, Sides};
use occupant_core::forces::chain::Site;
use occupant_core::forces::contact::solid::Solid;
use occupant_core::forces::contact::surface::Surface;
use occupant_core::forces::function::Function;
use occupant_core::forces::plate::{Band, Damper};
use occupant_core::model::seating::InitialPosture;
use placed_text::{Problem, with_key};

/// Distance from a plate, laterally and vertically, within which webbing loads it, for the reference person, m.
const TENT_M: [f64; 2] = [0.13, 0.15];
/// Height above a plate's mass at which webbing loads it most, for the reference person, m. A belt as in Shaw's sled
/// tests then loads the sternum with 0.35 of its force.
const TENT_ABOVE_M: f64 = 0.046;

/// Choice of a chest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum ChestChoice {
    /// Rigid.
    Rigid,
    /// A person's: a sternum fitted to hub tests, and lower ribs on both sides.
    Person,
    /// That of the Hybrid III 50th-percentile male.
    Dummy50,
    /// That of the Hybrid III 5th-percentile female.
    Dummy05f,
}

impl ChestChoice {
    /// Name in scenarios.
    pub(crate) fn name(self) -> &'static str {
        match self {
            ChestChoice::Rigid => "rigid",
            ChestChoice::Person => "person",
            ChestChoice::Dummy50 => "dummy50",
            ChestChoice::Dummy05f => "dummy05f",
        }
    }
}

/// Whether the pelvis deforms under a lap belt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum PelvisChoice {
    /// Rigid.
    Rigid,
    /// Flesh between belt and bone; all of its values are guesses.
    Flesh,
}

/// Whether the body has an abdomen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum AbdomenChoice {
    /// None.
    Rigid,
    /// A sphere that deforms under all contacts.
    Person,
}

/// Ribs and abdomen under loads from the side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum SidesChoice {
    /// Rigid.
    Rigid,
    /// A person's: they yield to the side as to the front, fitted to no test from the side.
    Person,
    /// Those of the ES-2 side impact dummy, whose limits then apply: three ribs as one, and the load cells of its abdomen.
    Es2,
}

/// A deformable part of a segment, which moves along a line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyPlateSection {
    /// Segment that it belongs to. Its mass is part of the segment's.
    pub(crate) segment: Option<String>,
    /// Initial position of its mass, from the segment's lower end, segment axes (X forward, Y left, Z up when
    /// standing).
    pub(crate) at: Option<[Length; 3]>,
    /// Inward direction of its motion, segment axes; any length.
    pub(crate) inward: Option<[Ratio; 3]>,
    /// Moving mass. The segment's total mass does not change.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// Depth of the trunk behind it, for relative deflections.
    pub(crate) depth: Option<Length<POSITIVE>>,
    /// Force over deflection, the same outwards.
    pub(crate) spring: Option<BodySpringSection>,
    /// Force over outward deflection, if it differs.
    pub(crate) outward_spring: Option<BodySpringSection>,
    /// Its damper.
    pub(crate) damper: Option<BodyDamperSection>,
    /// A relaxing spring (Maxwell element) in parallel.
    pub(crate) viscous: Option<BodyViscousSection>,
}

/// A spring and a damper on a sum of plate deflections.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LinkSection {
    /// Factors on the plate deflections, by name: 1 and -1 for the difference, 1 and 1 for the sum.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) of: IndexMap<String, Ratio>,
    /// Force over that sum, the same below 0.
    pub(crate) spring: Option<BodySpringSection>,
    /// Force where the sum is below 0, if it differs.
    pub(crate) outward_spring: Option<BodySpringSection>,
    /// Its damper.
    pub(crate) damper: Option<BodyDamperSection>,
    /// A relaxing spring (Maxwell element) in parallel.
    pub(crate) viscous: Option<BodyViscousSection>,
}

/// A force over a deflection.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-at-most-one" = [["returned", "returned_each"]]))]
pub(crate) struct BodySpringSection {
    /// Deflections, from 0.
    pub(crate) depth: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each; must not fall. The last slope continues.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Linear stiffness, instead of depths and forces.
    pub(crate) stiffness: Option<Stiffness<POSITIVE>>,
    /// Fraction of its work that unloading returns; 1 if absent.
    pub(crate) returned: Option<Ratio<FRACTION>>,
    /// The same for each interval.
    pub(crate) returned_each: Option<Vec<Ratio<FRACTION>>>,
}

/// Damping, which only dissipates energy.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyDamperSection {
    /// Force per inward speed; 0 if absent.
    pub(crate) linear: Option<Damping<NOT_NEGATIVE>>,
    /// Force per inward speed squared, added to it; 0 if absent.
    pub(crate) quadratic: Option<QuadraticDamping<NOT_NEGATIVE>>,
    /// Force per outward speed; `linear` if absent.
    pub(crate) outward: Option<Damping<NOT_NEGATIVE>>,
}

/// A relaxing spring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyViscousSection {
    /// Its stiffness.
    pub(crate) stiffness: Stiffness<POSITIVE>,
    /// Time constant.
    pub(crate) time: Time<POSITIVE>,
}

/// Share of each plate's deflection that a sphere follows, 0 to 1, by plate name and contact type.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RideSection {
    /// In contact with surfaces, solids and other spheres.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) contact: IndexMap<String, Ratio>,
    /// In contact with belts.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) belt: IndexMap<String, Ratio>,
    /// In contact with air bags.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) bag: IndexMap<String, Ratio>,
}

/// Support of a belt node; its position there determines the share of each plate's deflection that it follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum PlaceRide {
    /// On the chest.
    Chest,
}

/// The plates of `body`.
pub(super) fn plates(b: &mut Builder, section: &BodySection, body: &Body) -> Vec<Plate> {
    section.plates.iter().filter_map(|(name, s)| plate(b, name, s, body)).collect()
}

fn plate(b: &mut Builder, name: &str, s: &BodyPlateSection, body: &Body) -> Option<Plate> {
    let path = with_key("body.plates", name);
    let mut missing = |key: &str, is_there: bool, expected: &str| {
        if !is_there {
            b.error(&path, format!("`{path}` has no key `{key}`"), expected);
        }
    };
    missing("segment", s.segment.is_some(), "segment = the segment that it belongs to");
    missing("at", s.at.is_some(), "at = [x, y, z] from the lower end of that segment");
    missing("inward", s.inward.is_some(), "inward = its direction of motion, such as [-1, 0, 0]");
    let mass_kg = b.needed(&path, "mass", &s.mass);
    let named = s.segment.as_deref()?;
    let Some(segment) = body.tree.segment_named(named) else {
        let names: Vec<&str> = body.tree.segment_rows().iter().map(|row| row.name).collect();
        b.unknown(&with_key(&path, "segment"), "segment", named, &names);
        return None;
    };
    Some(Plate {
        name: name.to_owned(),
        segment,
        place_from_lower_end_m: s.at.as_ref().map_or_else(Point3::origin, point),
        inward: s.inward.as_ref().map_or_else(Vector3::zeros, |inward| Vector3::from(all_si(inward))),
        mass_kg,
        depth_m: s.depth.as_ref().map(Quantity::si),
    })
}

/// Resistance of the plates of a body that has them.
pub(super) fn bands(b: &mut Builder, section: &BodySection, body: &Body) -> Vec<Band> {
    if body.plates.is_empty() {
        return Vec::new();
    }
    let mut bands = Vec::new();
    for (i, plate) in body.plates.iter().enumerate() {
        let Some(s) = section.plates.get(&plate.name) else { continue };
        let parts = Parts { spring: &s.spring, outward: &s.outward_spring, damper: &s.damper, viscous: &s.viscous };
        let path = with_key("body.plates", &plate.name);
        bands.extend(parts.band(b, &path, &plate.name, vec![(i, 1.0)]));
    }
    for (name, s) in &section.plate_links {
        let path = with_key("body.plate_links", name);
        let parts = Parts { spring: &s.spring, outward: &s.outward_spring, damper: &s.damper, viscous: &s.viscous };
        let of = shares(b, &with_key(&path, "of"), &s.of, body);
        bands.extend(parts.band(b, &path, name, of));
    }
    bands
}

/// The components of a band.
struct Parts<'a> {
    spring: &'a Option<BodySpringSection>,
    outward: &'a Option<BodySpringSection>,
    damper: &'a Option<BodyDamperSection>,
    viscous: &'a Option<BodyViscousSection>,
}

impl Parts<'_> {
    /// The band of a plate; none for a plate held only by links.
    fn band(&self, b: &mut Builder, path: &str, name: &str, of: Shares) -> Option<Band> {
        if self.spring.is_none() && self.damper.is_none() && self.viscous.is_none() {
            return None;
        }
        let nothing = || Function::lines(vec![[0.0, 0.0], [1.0, 1e-9]], 1.0);
        let spring = self.spring.as_ref().map(|spring| spring.function(b, &with_key(path, "spring")));
        let outward = self.outward.as_ref().map(|spring| spring.function(b, &with_key(path, "outward_spring")));
        let damper = self.damper.as_ref().map(|s| {
            let linear_n_s_m = si_or(&s.linear, 0.0);
            let quadratic_n_s2_m2 = si_or(&s.quadratic, 0.0);
            Damper { linear_n_s_m, quadratic_n_s2_m2, outward_n_s_m: si_or(&s.outward, linear_n_s_m) }
        });
        Some(Band {
            name: name.to_owned(),
            of,
            spring: spring.unwrap_or_else(nothing),
            outward,
            damper: damper.unwrap_or_default(),
            viscous: self.viscous.as_ref().map(|s| [s.stiffness.si(), s.time.si()]),
        })
    }
}

impl BodySpringSection {
    fn function(&self, b: &mut Builder, path: &str) -> Function {
        let points = match &self.stiffness {
            Some(stiffness) => vec![[0.0, 0.0], [1.0, stiffness.si()]],
            None => points(b, path, ["depth", "force"], listed(&self.depth), listed(&self.force)),
        };
        function(points, &None, &self.returned, &self.returned_each, 1.0)
    }
}

/// Shares of plate deflections that a sphere of `body` follows.
pub(super) fn ride(b: &mut Builder, path: &str, s: &RideSection, body: &Body) -> Ride {
    let mut on = |key: &str, named: &IndexMap<String, Ratio>| shares(b, &format!("{path}.ride.{key}"), named, body);
    Ride { contact: on("contact", &s.contact), belt: on("belt", &s.belt), bag: on("bag", &s.bag) }
}

/// Plates with numbers, by name.
pub(super) fn shares(b: &mut Builder, path: &str, named: &IndexMap<String, Ratio>, body: &Body) -> Shares {
    let mut list = Vec::new();
    for (name, share) in named {
        match body.plates.iter().position(|plate| plate.name == *name) {
            Some(plate) => list.push((plate, share.si())),
            None => {
                let names: Vec<&str> = body.plates.iter().map(|plate| plate.name.as_str()).collect();
                b.unknown(&with_key(path, name), "plate", name, &names);
            }
        }
    }
    list
}

/// Shares of plate deflections that a node at a position on `body` follows.
pub(super) fn node(b: &mut Builder, path: &str, s: &NodeSection, site: &Site, body: &Body) -> Shares {
    if s.ride.is_empty() && s.lies_on.is_none() {
        return Vec::new();
    }
    let (segment, at) = match site {
        Site::Segment(segment, at, _) => (*segment, *at),
        Site::Track(segment, track) => (*segment, track.points_m[1]),
        Site::Vehicle(..) | Site::Sphere(_) => {
            let found = "`ride` or `lies_on` in a node that is not a point of a segment";
            b.error(path, found, "`on` and `at`; for a sphere set `ride` in `body.spheres`");
            return Vec::new();
        }
    };
    if s.lies_on.is_some() { by_place(body, segment, at) } else { shares(b, &with_key(path, "ride"), &s.ride, body) }
}

/// Shares that decrease from 1 at a plate to 0 at the edge of its range.
fn by_place(body: &Body, segment: usize, at: Point3<f64>) -> Shares {
    let (reference, name) = (Body::male50(), body.tree[body.tree.segment(segment)].name);
    let length_m = |body: &Body| Some(body.segment(body.tree.segment_named(name)?).length_m);
    let scale = length_m(body).zip(length_m(&reference)).map_or(1.0, |(own, other)| own / other);
    let part = |off_m: f64, half_m: f64| (1.0 - off_m.abs() / (half_m * scale)).max(0.0);
    let share = |plate: &Plate| {
        let from = plate.place_from_lower_end_m;
        part(at.y - from.y, TENT_M[0]) * part(at.z - from.z - TENT_ABOVE_M * scale, TENT_M[1])
    };
    let own = body.plates.iter().enumerate().filter(|(_, plate)| plate.segment.index() == segment);
    own.map(|(i, plate)| (i, share(plate))).filter(|(_, share)| *share > 0.0).collect()
}

/// The chest in the results; none if it is rigid.
pub(super) fn chest(b: &mut Builder, section: &BodySection, body: &Body) -> Option<Chest> {
    let choice = section.chest.filter(|choice| *choice != ChestChoice::Rigid);
    let place = |name: &str| body.plates.iter().position(|plate| plate.name == name);
    let (Some(breastbone), choice) = (place("sternum"), choice) else {
        if let Some(choice) = choice {
            let found = format!("the chest of `{}` in a child or a body with its own joints", choice.name());
            let expected = "an adult preset or person; for others give `body.plates`";
            b.error("body.chest", found, expected);
        }
        return None;
    };
    let depth_m = body.plates[breastbone].depth_m?;
    let sides = [("left", place("left_ribs")), ("right", place("right_ribs"))];
    let ribs = sides.iter().filter_map(|(side, ribs)| Some((*side, (*ribs)?)));
    let points = ribs.flat_map(|(side, ribs)| {
        let upper = vec![(breastbone, UPPER[0]), (ribs, UPPER[1])];
        [(format!("upper_{side}"), upper), (format!("lower_{side}"), vec![(ribs, 1.0)])]
    });
    let preset = choice.map_or("own", ChestChoice::name).to_owned();
    let viscous_scale = if preset.starts_with("dummy") { 1.3 } else { 1.0 };
    Some(Chest { of: String::new(), preset, breastbone, depth_m, viscous_scale, points: points.collect() })
}

/// The sides in the results, and the spheres that move with them: none if they are rigid.
pub(super) fn sides(b: &mut Builder, section: &BodySection, body: &mut Body) -> Option<Sides> {
    let choice = section.sides.filter(|choice| *choice != SidesChoice::Rigid)?;
    let place = |name: &str| body.plates.iter().position(|plate| plate.name == name);
    let [left, right] = chest::SIDES.map(|(name, _)| place(name));
    let (Some(left), Some(right)) = (left, right) else {
        let found = "the sides of a child or of a body with its own joints: they stay rigid";
        b.report(Problem::warning("body.sides", found, "an adult preset or person; for others give `body.plates`"));
        return None;
    };
    let abdomen = place(chest::ABDOMEN_SIDE);
    let half_breadth_m = chest::half_breadth_m(choice, body);
    let pelvis = chest::PELVIS.map(|(name, _)| place(name));
    let pelvis = pelvis[0].zip(pelvis[1]).map(|(left, right)| [left, right]);
    let of_abdomen = abdomen.map(|plate| {
        ["abdomen", "left_abdomen", "right_abdomen"].map(|name| (name, vec![(plate, chest::share_of_abdomen(choice))]))
    });
    let of_chest = pressed_in(["chest", "left_chest", "right_chest"], [left, right]);
    let of_pelvis = pelvis.map(|plates| pressed_in(["pelvis", "left_pelvis", "right_pelvis"], plates));
    for (name, shares) in of_chest.into_iter().chain(of_abdomen.into_iter().chain(of_pelvis).flatten()) {
        let Some(sphere) = body.spheres.iter_mut().find(|sphere| sphere.name == name) else {
            let is_removed = section.spheres.get(name).is_some_and(|own| own.remove == Some(true));
            if is_removed && name.ends_with("_abdomen") {
                continue;
            }
            let found = format!("no sphere `{name}`, which carries what strikes the ribs, the abdomen or the pelvis");
            b.error("body.sides", found, "body.sphere_set = \"even\", or \"full\"");
            return None;
        };
        for ride in [&mut sphere.ride.contact, &mut sphere.ride.bag] {
            ride.extend(&shares);
        }
    }
    let preset = (if choice == SidesChoice::Es2 { "es2" } else { "person" }).to_owned();
    let (ribs, pubic_share) = ([left, right], chest::pubic_share(choice));
    Some(Sides { of: String::new(), preset, ribs, abdomen, pelvis, pubic_share, half_breadth_m })
}

/// Spheres, the middle, left and right one, with the shares of a plate on each side: the middle moves half as far as a side that is
/// pressed in.
fn pressed_in([middle, to_left, to_right]: [&str; 3], [left, right]: [usize; 2]) -> [(&str, Shares); 3] {
    [(middle, vec![(left, 0.5), (right, 0.5)]), (to_left, vec![(left, 1.0)]), (to_right, vec![(right, 1.0)])]
}

/// Shares of sternum and lower ribs in the deflection of the upper ribs of a side: fitted to means of eight sled tests
/// (Shaw 2009).
const UPPER: [f64; 2] = [0.65, 0.19];

/// Surfaces, and solids behind them, that support the spine.
pub(super) fn behind(
    scenario: &Scenario,
    (surfaces, solids): (&[Surface], &[Solid]),
    posture: Option<&InitialPosture>,
) -> Vec<usize> {
    let seated = posture.and_then(|posture| match posture {
        InitialPosture::Seated(seating) => Some(seating.back),
        _ => None,
    });
    let said = |name: &str| {
        let own = scenario.surfaces.get(name).map(|surface| surface.behind);
        own.or_else(|| scenario.solids.get(name).map(|solid| solid.behind())).flatten()
    };
    let names = surfaces.iter().map(|s| s.name.as_str()).chain(solids.iter().map(|s| s.name.as_str()));
    let is_behind = |(i, name): &(usize, &str)| said(name).unwrap_or(seated == Some(*i));
    names.enumerate().filter(is_behind).map(|(i, _)| i).collect()
}
