//! `[muscles]`: the keys of a muscle, converted to [`Muscle`]s.

use indexmap::IndexMap;
use nalgebra::{UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::triggers::Triggers;
use super::{Angle, Moment, Ratio, RotationalDamping, RotationalStiffness, Scenario, Time};
use occupant_core::body::{Body, Joint, Side, Tree, both_sides};
use occupant_core::forces::joint::muscle::{Muscle, NEVER_S, Reflex};
use placed_text::{Problem, did_you_mean, one_of, with_key};

/// Readiness for a crash.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Readiness {
    /// At ease and unaware.
    Unaware,
    /// Aware, but does not brace.
    Aware,
    /// Tenses all muscles in advance.
    Braced,
}

/// Muscles of an occupant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct MusclesSection {
    /// Readiness of a volunteer (`joints.preset = "volunteer"`): "unaware", who reacts late; "aware", as the men whose
    /// tests it is fitted to; "braced", with tense muscles from the start. "aware" if absent.
    pub(crate) readiness: Option<Readiness>,
    /// Name of the trigger of a volunteer's muscles; if absent, 0.5 g of vehicle acceleration in the plane of its
    /// floor.
    pub(crate) trigger: Option<String>,
    /// Muscles by joint: active torques that hold its posture. `elbows` and the like stand for left and right, `all`
    /// for every joint. A single joint overrides its pair, and a pair overrides `all`. A volunteer has muscles in neck, back, clavicles,
    /// shoulders, elbows, wrists, hips, knees and ankles; only entries for these joints override them.
    #[serde(flatten)]
    pub(crate) named: IndexMap<String, MuscleSection>,
}

/// A muscle: a spring and a damper towards a posture of the joint, and a torque of its own, all scaled by its
/// activation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-together" = [["trigger", "rise"]]))]
pub(crate) struct MuscleSection {
    /// Name of its trigger; without one it keeps its tone.
    pub(crate) trigger: Option<String>,
    /// Reaction time: from the trigger until it begins to act; 0 if absent.
    pub(crate) reaction: Option<Time<NOT_NEGATIVE>>,
    /// Time constant of its activation.
    pub(crate) rise: Option<Time<POSITIVE>>,
    /// Time at which it relaxes to its tone; never if absent.
    pub(crate) until: Option<Time>,
    /// Posture that it maintains: [yaw, pitch, roll] of the outer segment from the joint's zero position; for a pin,
    /// pitch is its angle. For a left joint give those of the right one; they are mirrored. The initial posture if
    /// absent.
    pub(crate) hold: Option<[Angle; 3]>,
    /// Its own torque on the outer segment at full activation, [about X forward, about Y left, about Z up] of the
    /// joint's axes on the inner segment; for a pin the second value bends it. For a left joint give that of the right
    /// one; it is mirrored.
    pub(crate) torque: Option<[Moment; 3]>,
    /// Stiffness towards the posture, at full activation.
    pub(crate) stiffness: Option<RotationalStiffness<NOT_NEGATIVE>>,
    /// Damping, at full activation.
    pub(crate) damping: Option<RotationalDamping<NOT_NEGATIVE>>,
    /// Its reflex, with a delay.
    pub(crate) reflex: Option<ReflexSection>,
    /// Limit of the torque at full activation; none if absent.
    pub(crate) limit: Option<Moment<POSITIVE>>,
    /// Tone: activation before the trigger, 0 to 1; 0 if absent.
    pub(crate) tone: Option<Ratio<FRACTION>>,
    /// Whether in a settled body it carries, whatever its activation, the moment that its joint needs at the start. Only a
    /// muscle without `hold` and `torque` does. If absent, it does with a tone above 0.
    pub(crate) carries: Option<bool>,
}

/// Feedback of a muscle: a delayed torque per angle and rate. It is scaled by the activation and subject to the torque
/// limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReflexSection {
    /// Stiffness towards the posture, at full activation; 0 if absent.
    pub(crate) stiffness: Option<RotationalStiffness<NOT_NEGATIVE>>,
    /// Damping, at full activation; 0 if absent.
    pub(crate) damping: Option<RotationalDamping<NOT_NEGATIVE>>,
    /// Time constant of the torque, nerves and muscle together; at least 1 ms.
    pub(crate) delay: Time<POSITIVE>,
}

impl ReflexSection {
    fn reflex(&self) -> Reflex {
        Reflex {
            stiffness_n_m: si_or(&self.stiffness, 0.0),
            damping_n_m_s: si_or(&self.damping, 0.0),
            delay_s: self.delay.si(),
        }
    }
}

/// A turn of the right side, or its mirror image: yaw and roll go the other way.
fn mirrored_turn(side: Option<Side>, angles_rad: [f64; 3]) -> UnitQuaternion<f64> {
    let [roll, pitch, yaw] = mirrored(side, [angles_rad[2], angles_rad[1], angles_rad[0]]).into();
    UnitQuaternion::from_euler_angles(roll, pitch, yaw)
}

/// A torque about the forward, left and upward axes on the right side, or its mirror image.
fn mirrored(side: Option<Side>, about: [f64; 3]) -> Vector3<f64> {
    let hand = if side == Some(Side::Left) { -1.0 } else { 1.0 };
    Vector3::new(hand * about[0], about[1], hand * about[2])
}

/// Names of the joints of a body.
pub(super) fn joint_names(tree: &Tree) -> Vec<&'static str> {
    tree.joint_rows().iter().map(|row| row.name).collect()
}

/// The muscles of all joints that have any, in the tree's order. `names` are the joints of the whole body: what is said of those
/// that a mount leaves out is passed over.
pub(super) fn muscles(
    b: &mut Builder,
    scenario: &Scenario,
    names: &[&str],
    body: &Body,
    triggers: &Triggers<'_>,
) -> Vec<Muscle> {
    let Some(said) = &scenario.muscles else { return Vec::new() };
    // those of a volunteer have been written out
    for (key, is_said) in [("readiness", said.readiness.is_some()), ("trigger", said.trigger.is_some())] {
        if is_said {
            let found = format!("`{key}` without a volunteer");
            b.error(&with_key("muscles", key), found, "joints.preset = \"volunteer\"");
        }
    }
    let words = |name: &str| [Some(name.to_owned()), both_sides(name), Some("all".to_owned())];
    for name in said.named.keys() {
        if !names.iter().any(|joint| words(joint).iter().flatten().any(|word| word == name)) {
            let found = format!("no joint is named \"{name}\"");
            let hint = did_you_mean(name, names, '"');
            b.report(Problem::error(with_key("muscles", name), found, one_of(names, '"')).with_hint(hint));
        }
    }
    let mut list = Vec::new();
    for joint in body.tree.joints() {
        let words = words(body.tree[joint].name);
        let Some(key) = words.iter().flatten().find(|word| said.named.contains_key(*word)) else { continue };
        let (at, side) = (with_key("muscles", key), body.tree[joint].side());
        list.push(said.named[key].muscle(b, &at, joint, side, triggers));
    }
    list
}

impl MuscleSection {
    /// The muscle of a joint on a side of the body; `at` is its position in the scenario.
    fn muscle(&self, b: &mut Builder, at: &str, joint: Joint, side: Option<Side>, triggers: &Triggers<'_>) -> Muscle {
        let trigger = self.trigger.as_deref();
        let fired_s = trigger.and_then(|trigger| triggers.time_s(b, &format!("{at}.trigger"), trigger));
        let times_s = |at_s| [at_s + si_or(&self.reaction, 0.0), si_or(&self.until, NEVER_S)];
        let tone = si_or(&self.tone, 0.0);
        if self.carries == Some(true) && (self.hold.is_some() || self.torque.is_some()) {
            let found = "a muscle that carries the initial posture, beside `hold` or `torque`";
            b.error(&with_key(at, "carries"), found, "either `carries`, or `hold` and `torque`");
        }
        Muscle {
            joint,
            hold: self.hold.as_ref().map(|angles| mirrored_turn(side, all_si(angles))),
            torque_n_m: self.torque.as_ref().map_or_else(Vector3::zeros, |torque| mirrored(side, all_si(torque))),
            stiffness_n_m: si_or(&self.stiffness, 0.0),
            damping_n_m_s: si_or(&self.damping, 0.0),
            reflex: self.reflex.as_ref().map(ReflexSection::reflex),
            most_n_m: si_or(&self.limit, NEVER_S),
            tone,
            carries: self.carries.unwrap_or(tone > 0.0),
            rise_s: si_or(&self.rise, 1.0),
            times_s: fired_s.map_or([NEVER_S; 2], times_s),
        }
    }
}
