//! `[seats]`, `[posture]` and `[initial_state]`: their keys, and the [`InitialPosture`] and [`InitialVelocity`] they come
//! to.

use indexmap::IndexMap;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::{Builder, index_of};
use super::mount::beginning;
use super::quantity::{all_si, si_or};
use super::stance::stance;
use super::{Angle, Length, Scenario, Speed};
use crate::check::units_of;
use occupant_core::body::{Body, Segment, Tree, both_sides};
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Seating, Settling};
use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
use placed_text::{Problem, with_key};

/// A seat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SeatSection {
    /// Name of the cushion in `surfaces` or `solids`.
    pub(crate) cushion: String,
    /// Name of the seat back in `surfaces` or `solids`.
    pub(crate) back: String,
    /// Lateral position of the occupant's midsagittal plane; left is negative; 0 if absent.
    pub(crate) y: Option<Length>,
}

/// Seated posture. Angles are pitch from the vehicle's vertical, positive leaning the top of a segment backward.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(extend("x-at-most-one" = [["moves_with_vehicle", "velocity"], ["hands", "upper_arms"], ["hands", "elbows"]]))]
pub(crate) struct PostureSection {
    /// Name of the seat in `seats`.
    pub(crate) seat: String,
    /// γ₁.
    pub(crate) middle_torso: Option<Angle>,
    /// γ₂.
    pub(crate) upper_torso: Option<Angle>,
    /// γ₃.
    pub(crate) head: Option<Angle>,
    /// γ₄.
    pub(crate) lower_torso: Option<Angle>,
    /// γ₅, both upper arms; positive moves the elbows ahead of the shoulders.
    pub(crate) upper_arms: Option<Angle>,
    /// α, both elbows; negative moves the hands forward.
    pub(crate) elbows: Option<Angle>,
    /// [x, z] of both heels, vehicle axes.
    pub(crate) heels: Option<[Length; 2]>,
    /// [x, z] of both hands, vehicle axes, with the elbows below, instead of `upper_arms` and `elbows`.
    pub(crate) hands: Option<[Length; 2]>,
    /// True: move the seated body, as one piece, into balance with cushion, back and belts. False: the seating of the
    /// 1970 report. True if absent.
    pub(crate) settle: Option<bool>,
    /// True: all joints are limp while the body settles, until limits, springs, locks and contacts carry it; `posture`
    /// is the start of settling. False if absent.
    pub(crate) limp: Option<bool>,
    /// True: every point starts with the velocity of the vehicle at that point. False: all points start with the
    /// velocity of the vehicle's origin. True if absent.
    pub(crate) moves_with_vehicle: Option<bool>,
    /// Initial velocity of every point, vehicle axes, instead of that of the vehicle.
    pub(crate) velocity: Option<[Speed; 3]>,
    /// Further angles by the names of segments, `neck`, or of pins; `left_upper_arm` and `right_upper_arm` give one
    /// side only. Other segments are aligned with their parent.
    #[serde(flatten)]
    pub(crate) others: IndexMap<String, Angle>,
}

impl PostureSection {
    /// Angles required for a seated person.
    fn usual(&self) -> [(&'static str, &Option<Angle>); 6] {
        [
            ("middle_torso", &self.middle_torso),
            ("upper_torso", &self.upper_torso),
            ("head", &self.head),
            ("lower_torso", &self.lower_torso),
            ("upper_arms", &self.upper_arms),
            ("elbows", &self.elbows),
        ]
    }

    /// All angles by name.
    pub(super) fn angles(&self) -> impl Iterator<Item = (&str, &Angle)> {
        let usual = self.usual().into_iter().filter_map(|(name, angle)| Some((name, angle.as_ref()?)));
        usual.chain(self.others.iter().map(|(name, angle)| (name.as_str(), angle)))
    }
}

/// Position and velocity at the start in the report's generalized coordinates.
///
/// The numbers have no unit of their own: q₁ to q₃ and their rates are in the file's length (m or in) and per second, all
/// others in radians and radians per second, as the report prints them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct InitialStateSection {
    /// q₁…q₃₁.
    #[schemars(extend("minItems" = 31, "maxItems" = 31))]
    pub(crate) q: Vec<f64>,
    /// Their rates.
    #[schemars(extend("minItems" = 31, "maxItems" = 31))]
    pub(crate) rates: Vec<f64>,
    /// To extend a run from cards: [sphere, surface] of pairs that have passed each other; all other overlapping pairs
    /// touch. If absent, a sphere has passed if its centre is beyond the plane or beside the face.
    pub(crate) passed: Option<Vec<[String; 2]>>,
}

/// Initial position and velocity.
pub(super) fn posture(b: &mut Builder, s: &Scenario, body: &Body) -> (Option<InitialPosture>, InitialVelocity) {
    if let Some(mount) = &s.mount {
        let (posture, velocity) = beginning(b, mount, body);
        return (Some(posture), velocity);
    }
    if let Some(section) = &s.stance {
        let (posture, velocity) = stance(b, s, section, body);
        return (Some(posture), velocity);
    }
    match (&s.posture, &s.initial_state) {
        (Some(posture), _) => (seating(b, s, posture, body.tree).map(InitialPosture::Seated), velocity(posture)),
        (None, Some(state)) => (state_of(b, s, state, body), InitialVelocity::default()),
        (None, None) => {
            let expected = "one of `posture`, `initial_state`, `mount`, `stance`";
            b.error("", "the initial posture of the body is missing", expected);
            (None, InitialVelocity::default())
        }
    }
}

fn seating(b: &mut Builder, s: &Scenario, p: &PostureSection, tree: &Tree) -> Option<Seating> {
    let seat = s.seats.get(&p.seat)?;
    let solid = |name: &str| Some(s.surfaces.len() + usize::from(s.ground.is_some()) + s.solids.get_index_of(name)?);
    let part = |name: &str| s.surfaces.get_index_of(name).or_else(|| solid(name));
    check_angles(b, p, tree);
    if p.heels.is_none() && tree.landmarks().legs().next().is_some() {
        b.error("posture", "`posture` has no key `heels`", "heels = [x, z], vehicle axes");
    }
    Some(Seating {
        cushion: part(&seat.cushion)?,
        back: part(&seat.back)?,
        lateral_m: si_or(&seat.y, 0.0),
        angles_rad: p.angles().map(|(name, angle)| (name.to_owned(), angle.si())).collect(),
        hands_m: p.hands.as_ref().map(all_si),
        heels_m: p.heels.as_ref().map_or([0.0; 2], all_si),
        settle: settling(b, p),
    })
}

fn settling(b: &mut Builder, p: &PostureSection) -> Settling {
    match (p.settle.unwrap_or(true), p.limp == Some(true)) {
        (true, true) => Settling::Limp,
        (true, false) => Settling::Locked,
        (false, is_limp) => {
            if is_limp {
                b.error("posture.limp", "`limp = true` without settling", "settle = true, or no `limp`");
            }
            Settling::Not
        }
    }
}

/// Missing angles that the body requires, and given angles whose name the body does not have.
fn check_angles(b: &mut Builder, p: &PostureSection, tree: &Tree) {
    let is_of_leg = |segment: Segment| tree.landmarks().legs().any(|leg| segment == leg.upper || segment == leg.lower);
    let words = angle_words(tree, |segment| !is_of_leg(segment));
    let reaches = |name: &str| p.hands.is_some() && ["upper_arms", "elbows"].contains(&name);
    let needed = |name: &str| words.iter().any(|word| word == name) && !reaches(name);
    for (name, angle) in p.usual().iter().filter(|(name, _)| needed(name)) {
        b.needed("posture", name, angle);
    }
    unknown_angles(b, "posture", p.angles().map(|(name, _)| name), &words);
}

/// Names of the angles of these segments: their own, those of their hinges, and those of both sides.
pub(super) fn angle_words(tree: &Tree, is_asked: impl Fn(Segment) -> bool) -> Vec<String> {
    let words = tree.segments().filter(|segment| is_asked(*segment)).flat_map(|segment| {
        let joint = tree.bearer(segment).map(|joint| &tree[joint]);
        let name = joint.filter(|row| row.is_hinge()).map_or(tree[segment].name, |row| row.name);
        both_sides(name).into_iter().chain([name.to_owned()])
    });
    words.collect()
}

/// Reports unknown names at `path`.
pub(super) fn unknown_angles<'n>(b: &mut Builder, path: &str, names: impl Iterator<Item = &'n str>, words: &[String]) {
    let known: Vec<&str> = words.iter().map(String::as_str).collect();
    for name in names.filter(|name| !known.contains(name)) {
        b.unknown(&with_key(path, name), "segment or pin of the posture", name, &known);
    }
}

fn velocity(p: &PostureSection) -> InitialVelocity {
    match (&p.velocity, p.moves_with_vehicle) {
        (Some(v), _) => InitialVelocity::Given(Vector3::from(all_si(v))),
        (None, Some(false)) => InitialVelocity::VehicleOrigin,
        (None, Some(true)) => InitialVelocity::WithVehicle,
        (None, None) => InitialVelocity::default(),
    }
}

/// The exact state, with the pairs that have passed each other, if given.
fn state_of(b: &mut Builder, s: &Scenario, state: &InitialStateSection, body: &Body) -> Option<InitialPosture> {
    let coordinates = Box::new(coordinates(b, state)?);
    let Some(pairs) = &state.passed else { return Some(InitialPosture::Coordinates(coordinates)) };
    let mut passed = Vec::with_capacity(pairs.len());
    for (i, [sphere, surface]) in pairs.iter().enumerate() {
        let meeting = s.surfaces.get(surface).and_then(|f| f.spheres.as_ref());
        if meeting.is_some_and(|spheres| !spheres.contains(sphere)) {
            let found = format!("`{sphere}` cannot have passed `{surface}`: it is not one of its `spheres`");
            let expected = format!("one of the spheres of `surfaces.{surface}.spheres`");
            let hint = format!("add \"{sphere}\" to them, or leave this pair out");
            let path = format!("initial_state.passed[{i}][0]");
            b.report(Problem::error(path, found, expected).with_hint(Some(hint)));
        }
        passed.push((
            b.sphere(&format!("initial_state.passed[{i}][0]"), sphere, body),
            index_of(surface, s.surfaces.keys().map(String::as_str)),
        ));
    }
    Some(InitialPosture::Continued { coordinates, passed })
}

/// q₁–q₃ are lengths in the file's unit, all others radians.
fn coordinates(b: &Builder, section: &InitialStateSection) -> Option<ReportCoordinates> {
    let length_m = units_of(b.document).length_m();
    let si = |values: &[f64]| -> Option<[f64; DOF]> {
        let scaled = values.iter().enumerate();
        let scaled: Vec<f64> = scaled.map(|(i, x)| if i < 3 { x * length_m } else { *x }).collect();
        scaled.try_into().ok()
    };
    Some(ReportCoordinates { q: si(&section.q)?, rates: si(&section.rates)? })
}
