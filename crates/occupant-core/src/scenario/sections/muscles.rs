//! `[muscles]`: the keys of a muscle, and the [`Muscle`]s they come to.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, si_or};
use super::triggers::Triggers;
use super::{Moment, Ratio, RotationalDamping, RotationalStiffness, Scenario, Time};
use crate::body::{Body, both_sides};
use crate::forces::joint::muscle::{Muscle, NEVER_S};
use placed_text::{Problem, did_you_mean, one_of, with_key};

/// A muscle: a spring and a damper to the joint's posture at the start, as strong as it is active.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-together" = [["trigger", "rise"]]))]
pub(crate) struct MuscleSection {
    /// Name of the trigger that it answers; without one it keeps its tone.
    pub(crate) trigger: Option<String>,
    /// Time from the trigger until it begins to act; 0 if absent.
    pub(crate) reaction: Option<Time<NOT_NEGATIVE>>,
    /// Time constant with which its activation follows.
    pub(crate) rise: Option<Time<POSITIVE>>,
    /// Time at which it relaxes to its tone again; never if absent.
    pub(crate) until: Option<Time>,
    /// Torque per angle away from the posture, wholly active.
    pub(crate) stiffness: Option<RotationalStiffness<NOT_NEGATIVE>>,
    /// Torque per rate, wholly active.
    pub(crate) damping: Option<RotationalDamping<NOT_NEGATIVE>>,
    /// Greatest torque, wholly active; none if absent.
    pub(crate) limit: Option<Moment<POSITIVE>>,
    /// Activation before, 0 to 1; 0 if absent.
    pub(crate) tone: Option<Ratio<FRACTION>>,
}

/// The muscles of all joints that have any, in the tree's order.
pub(super) fn muscles(b: &mut Builder, scenario: &Scenario, body: &Body, triggers: &Triggers<'_>) -> Vec<Muscle> {
    let words = |name: &str| [Some(name.to_owned()), both_sides(name), Some("all".to_owned())];
    let names: Vec<&str> = body.tree.joint_rows().iter().map(|row| row.name).collect();
    for name in scenario.muscles.keys() {
        if !names.iter().any(|joint| words(joint).iter().flatten().any(|word| word == name)) {
            let found = format!("no joint is named \"{name}\"");
            let hint = did_you_mean(name, &names, '"');
            b.report(Problem::error(with_key("muscles", name), found, one_of(&names, '"')).with_hint(hint));
        }
    }
    let mut list = Vec::new();
    for joint in body.tree.joints() {
        let words = words(body.tree[joint].name);
        let Some(key) = words.iter().flatten().find(|word| scenario.muscles.contains_key(*word)) else { continue };
        let s = &scenario.muscles[key];
        let at = with_key("muscles", key);
        let fired_s = s.trigger.as_deref().and_then(|trigger| triggers.time_s(b, &format!("{at}.trigger"), trigger));
        let times_s = |at_s| [at_s + si_or(&s.reaction, 0.0), si_or(&s.until, NEVER_S)];
        list.push(Muscle {
            joint,
            stiffness_n_m: si_or(&s.stiffness, 0.0),
            damping_n_m_s: si_or(&s.damping, 0.0),
            most_n_m: si_or(&s.limit, NEVER_S),
            tone: si_or(&s.tone, 0.0),
            rise_s: si_or(&s.rise, 1.0),
            times_s: fired_s.map_or([NEVER_S; 2], times_s),
        });
    }
    list
}
