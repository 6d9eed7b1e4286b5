//! `[triggers]`: what sets something off, and when it does.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::quantity::{NOT_NEGATIVE, POSITIVE, si_or};
use super::{Acceleration, Scenario, Time};
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
}

/// When each trigger fires, s; one that never does is left out and warned about.
pub(super) fn triggers<'s>(
    b: &mut Builder,
    scenario: &'s Scenario,
    path: &VehiclePath,
    time: &TimeSpan,
) -> IndexMap<&'s str, f64> {
    let mut fires_s = IndexMap::new();
    for (name, trigger) in &scenario.triggers {
        let at = with_key("triggers", name);
        let found_s = match trigger {
            TriggerSection::Time { at } => Some(at.si()),
            TriggerSection::VehicleAcceleration { .. } if !path.has_accelerations() => {
                let found = "a trigger by acceleration with a path that has none";
                b.error(&at, found, "another kind of trigger, or a path with interpolate = \"spline\"");
                continue;
            }
            TriggerSection::VehicleAcceleration { threshold, lasting } => {
                path.jolt_s([time.start_s, time.end_s], threshold.si(), si_or(lasting, 0.0))
            }
        };
        match found_s.filter(|at_s| *at_s <= time.end_s) {
            Some(at_s) => drop(fires_s.insert(name.as_str(), at_s)),
            None => b.report(Problem::warning(at, "a trigger that never fires in this run", "one that does")),
        }
    }
    fires_s
}
