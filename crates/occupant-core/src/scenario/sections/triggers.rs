//! `[triggers]`: what sets something off, and when it does.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::quantity::{NOT_NEGATIVE, POSITIVE, si_or};
use super::{Acceleration, Force, Length, Scenario, Speed, Time};
use crate::forces::chain::{Cue, Watch, Watched};
use crate::model::setup::TimeSpan;
use crate::vehicle::VehiclePath;
use placed_text::{Problem, with_key};

/// What sets something off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum TriggerSection {
    /// A time.
    Time {
        /// When.
        at: Time,
    },
    /// The vehicle's acceleration along its floor, of its centre of gravity.
    VehicleAcceleration {
        /// How strong it must be.
        threshold: Acceleration<POSITIVE>,
        /// For how long without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
    /// The vehicle's change of speed along its floor since its acceleration last rose above `wake`.
    DeltaV {
        /// How great it must be.
        threshold: Speed<POSITIVE>,
        /// Acceleration below which it counts from 0 again.
        wake: Acceleration<POSITIVE>,
    },
    /// The first of others that fires.
    Any {
        /// Names of triggers.
        of: Vec<String>,
    },
    /// The last of others that fires.
    All {
        /// Names of triggers.
        of: Vec<String>,
    },
    /// The tension where the belt leaves its first node, of the belt whose device answers.
    BeltTension {
        /// How great it must be.
        threshold: Force<POSITIVE>,
        /// For how long without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
    /// Webbing that has left the spool that answers, since the start.
    Payout {
        /// How much it must be.
        threshold: Length<POSITIVE>,
        /// For how long without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
    /// The speed at which webbing leaves the spool that answers.
    PayoutSpeed {
        /// How great it must be.
        threshold: Speed<POSITIVE>,
        /// For how long without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
    /// The acceleration of webbing that leaves the spool that answers: its speed less the average over 5 ms, over 5 ms.
    PayoutAcceleration {
        /// How great it must be.
        threshold: Acceleration<POSITIVE>,
        /// For how long without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
}

/// When triggers fire.
pub(super) struct Triggers<'s>(IndexMap<&'s str, Fires>);

/// When a trigger fires.
#[derive(Clone, Copy)]
enum Fires {
    /// At a time, s.
    At(f64),
    /// As soon as what a belt does has reached a threshold for so long, s.
    Watch(Watched, f64, f64),
}

impl Triggers<'_> {
    /// When a trigger fires, s; none if it does not in this run. What belts watch is refused at `path`.
    pub(super) fn time_s(&self, b: &mut Builder, path: &str, name: &str) -> Option<f64> {
        match self.0.get(name)? {
            Fires::At(at_s) => Some(*at_s),
            Fires::Watch(..) => {
                b.error(
                    path,
                    format!("\"{name}\", a trigger that belts watch"),
                    "a trigger by time or by the vehicle's motion",
                );
                None
            }
        }
    }

    /// What sets a device of a belt off `delay_s` after a trigger.
    pub(super) fn cue(&self, name: &str, delay_s: f64) -> Cue {
        match self.0.get(name) {
            None => Cue::NEVER,
            Some(Fires::At(at_s)) => Cue { due_s: at_s + delay_s, watch: None },
            Some(&Fires::Watch(of, threshold, lasting_s)) => {
                Cue { watch: Some(Watch { of, threshold, lasting_s, delay_s }), ..Cue::NEVER }
            }
        }
    }
}

/// When each trigger fires; one that never does is left out and warned about.
pub(super) fn triggers<'s>(
    b: &mut Builder,
    scenario: &'s Scenario,
    path: &VehiclePath,
    time: &TimeSpan,
) -> Triggers<'s> {
    let mut fires = IndexMap::new();
    for (name, trigger) in &scenario.triggers {
        let at = with_key("triggers", name);
        match found(scenario, trigger, path, time, scenario.triggers.len()) {
            Ok(Some(Fires::At(at_s))) if at_s <= time.end_s => drop(fires.insert(name.as_str(), Fires::At(at_s))),
            Ok(Some(watch @ Fires::Watch(..))) => drop(fires.insert(name.as_str(), watch)),
            Ok(_) => b.report(Problem::warning(at, "a trigger that never fires in this run", "one that does")),
            Err([found, expected]) => b.error(&at, found, expected),
        }
    }
    Triggers(fires)
}

/// When a trigger fires; others are followed at most `depth` deep.
fn found(
    scenario: &Scenario,
    trigger: &TriggerSection,
    path: &VehiclePath,
    time: &TimeSpan,
    depth: usize,
) -> Result<Option<Fires>, [&'static str; 2]> {
    let span_s = [time.start_s, time.end_s];
    let watch = |of, threshold, lasting: &Option<Time<NOT_NEGATIVE>>| {
        Ok(Some(Fires::Watch(of, threshold, si_or(lasting, 0.0))))
    };
    let by_motion = || {
        let expected = "another kind of trigger, or a path with interpolate = \"spline\"";
        path.has_accelerations().then_some(()).ok_or(["a trigger by acceleration with a path that has none", expected])
    };
    match trigger {
        TriggerSection::Time { at } => Ok(Some(Fires::At(at.si()))),
        TriggerSection::VehicleAcceleration { threshold, lasting } => {
            by_motion()?;
            Ok(path.jolt_s(span_s, threshold.si(), si_or(lasting, 0.0)).map(Fires::At))
        }
        TriggerSection::DeltaV { threshold, wake } => {
            by_motion()?;
            Ok(path.change_s(span_s, threshold.si(), wake.si()).map(Fires::At))
        }
        TriggerSection::Any { of } => {
            let times_s = times_s(scenario, of, path, time, depth)?;
            Ok(times_s.into_iter().flatten().min_by(f64::total_cmp).map(Fires::At))
        }
        TriggerSection::All { of } => {
            let times_s: Option<Vec<f64>> = times_s(scenario, of, path, time, depth)?.into_iter().collect();
            Ok(times_s.into_iter().flatten().max_by(f64::total_cmp).map(Fires::At))
        }
        TriggerSection::BeltTension { threshold, lasting } => watch(Watched::Tension, threshold.si(), lasting),
        TriggerSection::Payout { threshold, lasting } => watch(Watched::Payout, threshold.si(), lasting),
        TriggerSection::PayoutSpeed { threshold, lasting } => watch(Watched::PayoutSpeed, threshold.si(), lasting),
        TriggerSection::PayoutAcceleration { threshold, lasting } => {
            watch(Watched::PayoutAcceleration, threshold.si(), lasting)
        }
    }
}

/// When others fire, s; none of one that does not.
fn times_s(
    scenario: &Scenario,
    names: &[String],
    path: &VehiclePath,
    time: &TimeSpan,
    depth: usize,
) -> Result<Vec<Option<f64>>, [&'static str; 2]> {
    if depth == 0 {
        return Err(["triggers that wait for one another in a circle", "triggers of which the last waits for none"]);
    }
    let mut list = Vec::new();
    for name in names {
        let Some(trigger) = scenario.triggers.get(name) else { continue };
        match found(scenario, trigger, path, time, depth - 1)? {
            Some(Fires::Watch(..)) => {
                return Err(["a group with a trigger that belts watch", "triggers by time or by the vehicle's motion"]);
            }
            Some(Fires::At(at_s)) => list.push(Some(at_s)),
            None => list.push(None),
        }
    }
    Ok(list)
}
