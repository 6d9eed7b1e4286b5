//! `[mount]`: a segment held by a rig, and the [`Mounting`] it comes to.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::path::pose;
use super::posture::{angle_words, unknown_angles};
use super::quantity::{all_si, point};
use super::{Angle, Length, Speed};
use nalgebra::Vector3;
use occupant_core::body::{Body, JointKind, Segment, both_sides};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Mounting, Placing};
use placed_text::{Problem, with_key};

/// A mount that holds a segment, such as a pendulum or a sled with head and neck, or a bench with a leg. The body is
/// attached to that segment, which moves with the frame: `path` is the path of the mount.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MountSection {
    /// Name of the segment that is held.
    pub(crate) segment: String,
    /// Segments to leave out, with everything beyond them as seen from the mount: ["middle_torso", "upper_arms"] keeps
    /// head and neck on an upper torso. Words such as `upper_arms` stand for both sides. None if absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) without: Vec<String>,
    /// Frame of the mount; "vehicle", which moves by `path`, if absent. In "space", z is up and y left in `place` and
    /// `let_go`; in all other frames z is down and y right. Roll, pitch and yaw mean the same in both.
    pub(crate) frame: Option<MountFrame>,
    /// Mounting point, for which the load is given: from the segment's lower end, segment axes (X forward, Y left, Z up
    /// when standing); [0, 0, 0] if absent.
    pub(crate) point: Option<[Length; 3]>,
    /// Position of the mounting point in the frame (z down; z up in "space"); [0, 0, 0] if absent.
    pub(crate) place: Option<[Length; 3]>,
    /// Roll of the segment from upright and facing forward, positive with the right side down; 0 if absent.
    pub(crate) roll: Option<Angle>,
    /// Pitch, positive with the top leant back; 0 if absent.
    pub(crate) pitch: Option<Angle>,
    /// Yaw, positive to the right; 0 if absent.
    pub(crate) yaw: Option<Angle>,
    /// Velocity relative to the frame, in its axes, with which the body is released at the start, such as a head that
    /// falls. If absent, the mount holds the body throughout.
    pub(crate) let_go: Option<[Speed; 3]>,
    /// Angles of the other segments and of pins, as in `posture`, in the plane that the mount faces. Other segments are
    /// aligned with their parent.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) posture: IndexMap<String, Angle>,
}

/// Frame of a mount.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(crate) enum MountFrame {
    /// The vehicle: x forward, y right, z down from its centre of gravity.
    Vehicle,
    /// Space: x forward, y left, z up, unlike all other frames.
    Space,
}

/// The body on the mount, without omitted segments; none if a name is unknown.
pub(super) fn held(b: &mut Builder, section: &MountSection, body: &Body) -> Option<Body> {
    let tree = body.tree;
    let names: Vec<&str> = tree.segment_rows().iter().map(|row| row.name).collect();
    let root = tree.segment_named(&section.segment);
    if root.is_none() {
        b.unknown("mount.segment", "segment", &section.segment, &names);
    }
    let mut left_out = Vec::new();
    for (i, word) in section.without.iter().enumerate() {
        let called = |s: &Segment| tree[*s].name == word || both_sides(tree[*s].name).as_ref() == Some(word);
        let called: Vec<Segment> = tree.segments().filter(called).collect();
        let path = format!("mount.without[{i}]");
        if called.is_empty() {
            b.unknown(&path, "segment", word, &names);
        } else if called.iter().any(|s| Some(*s) == root) {
            b.error(&path, format!("`{word}`, which the mount holds"), "segments beyond the mounted one");
        }
        left_out.extend(called);
    }
    let held = body.hung_on(root?, &left_out);
    let turned = held.tree.joint_rows().iter().find(|row| row.is_reversed() && row.kind == JointKind::Universal);
    if let Some(row) = turned {
        let found = format!("the universal joint `{}` on the way to the mount", row.name);
        let problem = Problem::error("mount.segment", found, "a mount on the proximal side of universal joints");
        let hint =
            format!("swap `proximal` and `distal` of `body.joints.{}`, or leave out what is beyond it", row.name);
        b.report(problem.with_hint(Some(hint)));
    }
    Some(held)
}

/// Initial state of a body held or released by a mount.
pub(super) fn beginning(b: &mut Builder, section: &MountSection, body: &Body) -> (InitialPosture, InitialVelocity) {
    let at = mounting(b, section, body);
    tell_of_space(b, section);
    let Some(velocity) = &section.let_go else {
        return (InitialPosture::Mounted(Box::new(at)), InitialVelocity::default());
    };
    let placing = Placing { at, stands: false, spin_rad_s: Vector3::zeros() };
    (InitialPosture::Placed(Box::new(placing)), InitialVelocity::Given(all_si(velocity).into()))
}

/// Warns that z points up in this frame, unlike in all others.
fn tell_of_space(b: &mut Builder, section: &MountSection) {
    let place = section.place.as_ref().map(|place| ("mount.place", point(place).z, "m"));
    let let_go = section.let_go.as_ref().map(|v| ("mount.let_go", all_si(v)[2], "m/s"));
    for (path, z, unit) in place.into_iter().chain(let_go) {
        if section.frame == Some(MountFrame::Space) && z != 0.0 {
            let way = if z > 0.0 { "up" } else { "down" };
            let found = format!("z = {z} {unit} is {way} in \"space\", where z is up and y left");
            let expected = "this, or frame = \"vehicle\", where z is down and y right as in all other frames";
            b.report(Problem::warning(path, found, expected));
        }
    }
}

/// The mount of a body.
fn mounting(b: &mut Builder, section: &MountSection, body: &Body) -> Mounting {
    let root = body.tree.segment(0);
    let words = angle_words(body.tree, |segment| segment != root);
    unknown_angles(b, "mount.posture", section.posture.keys().map(String::as_str), &words);
    if section.posture.contains_key(&section.segment) {
        let path = with_key("mount.posture", &section.segment);
        b.error(&path, "an angle of the segment that is held", "`mount.pitch`, which leans it");
    }
    let triple = |of: &Option<[Length; 3]>| of.as_ref().map_or_else(Vector3::zeros, |of| point(of).coords);
    Mounting {
        frame: if section.frame == Some(MountFrame::Space) { Frame::Space } else { Frame::Vehicle },
        point_m: triple(&section.point),
        place_m: triple(&section.place),
        attitude: pose(&None, [&section.roll, &section.pitch, &section.yaw]).attitude,
        angles_rad: section.posture.iter().map(|(name, angle)| (name.clone(), angle.si())).collect(),
    }
}
