//! `[retractors]` and the pretensioners of belts: their keys, converted to [`Device`]s and [`Stroke`]s.

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::belts::BeltSection;
use super::builder::Builder;
use super::chains::Parts;
use super::functions::points;
use super::nodes::NodeSection;
use super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::{Force, Length, Ratio, Speed, Time};
use occupant_core::forces::chain::{Cue, Device, NEVER, Pull, Reel, Stroke};
use occupant_core::forces::function::Function;
use placed_text::with_key;

/// Transition time to a second limiter, s.
const SWITCH_S: f64 = 5e-3;
/// Maximum pull-in speed of a pretensioner given by force, m/s.
const PULL_M_S: f64 = 15.0;

/// A retractor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RetractorSection {
    /// Webbing on the spool at the start; 1 m if absent.
    pub(crate) on_spool: Option<Length<POSITIVE>>,
    /// Tension while it is open; 6 N if absent.
    pub(crate) spool_tension: Option<Force<POSITIVE>>,
    /// Its lock. If absent, only a pretensioner locks it.
    pub(crate) lock: Option<LockSection>,
    /// Name of the load limiter. If absent, the locked retractor pays out nothing.
    pub(crate) limiter: Option<String>,
    /// A second limiter that takes over.
    pub(crate) second_limiter: Option<SecondLimiterSection>,
    /// Pretensioner.
    pub(crate) pretensioner: Option<PullSection>,
}

/// Lock of a retractor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LockSection {
    /// Name of the trigger.
    pub(crate) trigger: String,
    /// Webbing that pays out between trigger and lock; 0 if absent.
    pub(crate) payout: Option<Length<NOT_NEGATIVE>>,
    /// Longest time from trigger to lock.
    pub(crate) within: Option<Time<NOT_NEGATIVE>>,
}

/// A second limiter, which replaces the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SecondLimiterSection {
    /// Its name.
    pub(crate) limiter: String,
    /// Name of the trigger.
    pub(crate) trigger: String,
    /// Transition time between the two forces; 5 ms if absent.
    pub(crate) within: Option<Time<POSITIVE>>,
}

/// A pretensioner of a retractor: webbing pulled in, or a force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["pull", "force"]]))]
pub(crate) struct PullSection {
    /// Name of the trigger.
    pub(crate) trigger: String,
    /// Time from the trigger until it acts; 0 if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Times since it began to act, from 0; it ends with the last.
    pub(crate) times: Vec<Time<NOT_NEGATIVE>>,
    /// Webbing pulled in at each time; must not fall.
    pub(crate) pull: Option<Vec<Length<NOT_NEGATIVE>>>,
    /// Force at each.
    pub(crate) force: Option<Vec<Force<NOT_NEGATIVE>>>,
    /// Largest pull-in speed of a pretensioner given by force; 15 m/s if absent.
    pub(crate) speed: Option<Speed<POSITIVE>>,
    /// Tension at which it stops; none if absent.
    pub(crate) stall_force: Option<Force<POSITIVE>>,
}

/// A pretensioner that pulls a buckle or an anchor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StrokeSection {
    /// Name of the trigger.
    pub(crate) trigger: String,
    /// Time from the trigger until it acts; 0 if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Direction of the pull, away from the belt, vehicle axes; down and back if absent.
    pub(crate) direction: Option<[Ratio; 3]>,
    /// Times since it began to act, from 0.
    pub(crate) times: Vec<Time<NOT_NEGATIVE>>,
    /// Its travel at each time; must not fall.
    pub(crate) pull: Vec<Length<NOT_NEGATIVE>>,
    /// Opposing force at which it stops for good; none if absent.
    pub(crate) stall_force: Option<Force<POSITIVE>>,
}

impl Parts<'_> {
    fn limiter(&self, b: &mut Builder, name: &str) -> Option<Function> {
        Some(self.scenario.limiters.get(name)?.function(b, &with_key("limiters", name)))
    }

    /// The device of the first node; a retractor anywhere else is an error.
    pub(super) fn device(&self, b: &mut Builder, path: &str, s: &BeltSection, nodes: &[NodeSection]) -> Device {
        for (i, _) in nodes.iter().enumerate().skip(1).filter(|(_, node)| node.retractor.is_some()) {
            let expected = "the retractor at the first node: reverse the order of the nodes";
            b.error(&format!("{path}.nodes[{i}].retractor"), format!("a retractor at node {}", i + 1), expected);
        }
        let reel = nodes.first().and_then(|node| self.scenario.retractors.get_key_value(node.retractor.as_ref()?));
        let Some((name, section)) = reel else {
            let limiter = s.limiter.as_ref().and_then(|name| self.limiter(b, name));
            return Device { limiter, second: None, reel: None };
        };
        if s.limiter.is_some() {
            b.error(
                &format!("{path}.limiter"),
                "a belt with both a limiter and a retractor",
                "`limiter` of the retractor",
            );
        }
        if section.second_limiter.is_some() && section.limiter.is_none() {
            b.error(path, "a retractor with a second limiter but no first", "`limiter` of the retractor");
        }
        let second = |second: &SecondLimiterSection, b: &mut Builder| {
            let limiter = self.limiter(b, &second.limiter)?;
            Some((limiter, self.triggers.cue(&second.trigger, 0.0), si_or(&second.within, SWITCH_S)))
        };
        Device {
            limiter: section.limiter.as_ref().and_then(|name| self.limiter(b, name)),
            second: section.second_limiter.as_ref().and_then(|section| second(section, b)),
            reel: Some(self.reel(b, &with_key("retractors", name), section)),
        }
    }

    fn reel(&self, b: &mut Builder, path: &str, s: &RetractorSection) -> Reel {
        let lock = s.lock.as_ref();
        let within = lock.and_then(|lock| lock.within.as_ref());
        Reel {
            on_spool_m: si_or(&s.on_spool, 1.0),
            tension_n: si_or(&s.spool_tension, 6.0),
            lock: lock.map_or(Cue::NEVER, |lock| self.triggers.cue(&lock.trigger, 0.0)),
            lock_after: [lock.map_or(0.0, |lock| si_or(&lock.payout, 0.0)), within.map_or(NEVER, |within| within.si())],
            pull: s.pretensioner.as_ref().map(|pull| self.pull(b, &with_key(path, "pretensioner"), pull)),
        }
    }

    fn pull(&self, b: &mut Builder, path: &str, s: &PullSection) -> Pull {
        let table = match (&s.pull, &s.force) {
            (Some(pull), _) => points(b, path, ["times", "pull"], &s.times, pull),
            (None, Some(force)) => points(b, path, ["times", "force"], &s.times, force),
            (None, None) => Vec::new(),
        };
        Pull {
            cue: self.triggers.cue(&s.trigger, si_or(&s.delay, 0.0)),
            table,
            by_force: s.force.as_ref().map(|_| si_or(&s.speed, PULL_M_S)),
            stall_n: si_or(&s.stall_force, NEVER),
        }
    }

    pub(super) fn stroke(&self, b: &mut Builder, path: &str, s: &StrokeSection) -> Stroke {
        let path = format!("{path}.pretensioner");
        let way = points(b, &path, ["times", "pull"], &s.times, &s.pull);
        let due_s = self.triggers.time_s(b, &format!("{path}.trigger"), &s.trigger);
        Stroke {
            due_s: due_s.map_or(NEVER, |at_s| at_s + si_or(&s.delay, 0.0)),
            direction: direction(s.direction.as_ref().map_or([-0.5, 0.0, 0.866], all_si)),
            way,
            stall_n: si_or(&s.stall_force, NEVER),
        }
    }
}

/// A unit vector; a zero vector stays zero.
pub(super) fn direction(along: [f64; 3]) -> Vector3<f64> {
    let along = Vector3::from(along);
    along.try_normalize(1e-12).unwrap_or(along)
}
