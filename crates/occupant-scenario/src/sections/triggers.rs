//! `[triggers]`: conditions that fire devices, and their times.

use std::collections::HashMap;

use indexmap::IndexMap;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::{Acceleration, Force, Length, Ratio, Scenario, Speed, Time};
use occupant_core::forces::chain::{Cue, Watch, Watched};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::setup::{OtherFrame, TimeSpan};
use occupant_core::vehicle::VehiclePath;
use placed_text::{Problem, with_key};

/// A trigger of devices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum TriggerSection {
    /// At a time.
    Time {
        /// The time.
        at: Time,
    },
    /// The acceleration of a vehicle's centre of gravity, in the plane of its floor or along `direction`.
    VehicleAcceleration {
        /// Name of the vehicle; the first if absent.
        vehicle: Option<String>,
        /// Direction along which the acceleration counts, vehicle axes, any length: [-1, 0, 0] for an impact on the front. Any direction
        /// in the plane of the floor if absent.
        direction: Option<[Ratio; 3]>,
        /// Threshold.
        threshold: Acceleration<POSITIVE>,
        /// Minimum duration without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
    /// A vehicle's change of velocity, in the plane of its floor, since its acceleration last rose above `wake`.
    DeltaV {
        /// Name of the vehicle; the first if absent.
        vehicle: Option<String>,
        /// Threshold.
        threshold: Speed<POSITIVE>,
        /// Acceleration below which integration restarts from 0.
        wake: Acceleration<POSITIVE>,
    },
    /// The first of other triggers to fire.
    Any {
        /// Names of triggers.
        of: Vec<String>,
    },
    /// The last of other triggers to fire.
    All {
        /// Names of triggers.
        of: Vec<String>,
    },
    /// The tension at the first node of the belt to which the device belongs.
    BeltTension {
        /// Threshold.
        threshold: Force<POSITIVE>,
        /// Minimum duration without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
    /// Webbing paid out by the device's own spool since the start.
    Payout {
        /// Threshold.
        threshold: Length<POSITIVE>,
        /// Minimum duration without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
    /// Pay-out speed at the device's own spool.
    PayoutSpeed {
        /// Threshold.
        threshold: Speed<POSITIVE>,
        /// Minimum duration without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
    /// Pay-out acceleration at the device's own spool: its speed minus the average over 5 ms, divided by 5 ms.
    PayoutAcceleration {
        /// Threshold.
        threshold: Acceleration<POSITIVE>,
        /// Minimum duration without a break; 0 if absent.
        #[serde(rename = "for")]
        lasting: Option<Time<NOT_NEGATIVE>>,
    },
}

impl TriggerSection {
    /// Whether it needs the path of the vehicle in advance.
    pub(crate) fn is_of_path(&self) -> bool {
        matches!(self, TriggerSection::VehicleAcceleration { .. } | TriggerSection::DeltaV { .. })
    }
}

/// Firing conditions of triggers.
pub(super) struct Triggers<'s>(IndexMap<&'s str, Fires>);

/// Paths of the vehicles.
#[derive(Clone, Copy)]
pub(super) struct Paths<'p> {
    /// Path of the first vehicle.
    pub(super) first: &'p VehiclePath,
    /// Paths of the others, and of other frames, in their order.
    pub(super) others: &'p [OtherFrame],
}

/// Firing condition of a trigger.
#[derive(Clone, Copy)]
enum Fires {
    /// At a time, s.
    At(f64),
    /// When a quantity of a belt has exceeded a threshold for a duration, s.
    Watch(Watched, f64, f64),
}

impl Triggers<'_> {
    /// When a trigger fires, s; none if it does not fire in this run. Triggers by belts are refused at `path`.
    pub(super) fn time_s(&self, b: &mut Builder, path: &str, name: &str) -> Option<f64> {
        match self.0.get(name)? {
            Fires::At(at_s) => Some(*at_s),
            Fires::Watch(..) => {
                b.error(
                    path,
                    format!("\"{name}\", a trigger on a belt"),
                    "a trigger by time or by the vehicle's motion",
                );
                None
            }
        }
    }

    /// Condition for a device of a belt, `delay_s` after a trigger.
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

/// More triggers than this are a mistake; this also limits the depth of groups.
const MOST: usize = 100;
/// Largest duration of vehicle motion evaluated for all triggers together, s.
const MOST_MOTION_S: f64 = 500.0;

/// Firing time of each trigger; one that never fires is omitted, with a warning.
pub(super) fn triggers<'s>(b: &mut Builder, scenario: &'s Scenario, paths: Paths<'_>, time: &TimeSpan) -> Triggers<'s> {
    let mut fires = IndexMap::new();
    if is_too_much(b, scenario, time) {
        return Triggers(fires);
    }
    let mut search = Search { scenario, paths, time, known: HashMap::new() };
    for name in scenario.triggers.keys() {
        let at = with_key("triggers", name);
        match search.found(name, MOST) {
            Ok(Some(Fires::At(at_s))) if at_s <= time.end_s => drop(fires.insert(name.as_str(), Fires::At(at_s))),
            Ok(Some(watch @ Fires::Watch(..))) => drop(fires.insert(name.as_str(), watch)),
            // triggers of a car in words may wait for an impact that does not come
            Ok(_) if is_of_car(b, name) => {}
            Ok(_) => b.report(Problem::warning(at, "this trigger does not fire in this run", "a trigger that fires")),
            Err([found, expected]) => b.error(&at, found, expected),
        }
    }
    Triggers(fires)
}

/// Whether a trigger comes from an expanded `[car]`.
fn is_of_car(b: &Builder, name: &str) -> bool {
    let document = b.document;
    let node = document.root.get("triggers").and_then(|all| all.get(name));
    node.is_some_and(|node| document.sources.name(node.span.source) == super::CAR_TITLE)
}

/// Refuses more triggers, or more evaluated motion, than a run needs.
fn is_too_much(b: &mut Builder, scenario: &Scenario, time: &TimeSpan) -> bool {
    use TriggerSection::{DeltaV, VehicleAcceleration};
    let count = scenario.triggers.len();
    let by_motion = scenario.triggers.values().filter(|t| matches!(t, VehicleAcceleration { .. } | DeltaV { .. }));
    let motion_s = by_motion.count() as f64 * (time.end_s - time.start_s);
    if count > MOST {
        b.error("triggers", format!("{count} triggers"), format!("at most {MOST}"));
    } else if motion_s > MOST_MOTION_S {
        let found = format!("triggers that look at {motion_s} s of vehicle motion in all");
        b.error("triggers", found, format!("at most {MOST_MOTION_S} s: a shorter run or fewer triggers"));
    }
    count > MOST || motion_s > MOST_MOTION_S
}

/// Firing condition of a trigger, or its problems.
type Found = Result<Option<Fires>, [&'static str; 2]>;

/// Computes firing times, each once.
struct Search<'s> {
    scenario: &'s Scenario,
    paths: Paths<'s>,
    time: &'s TimeSpan,
    known: HashMap<&'s str, Found>,
}

impl<'s> Search<'s> {
    /// Firing condition of the trigger with this name; references to others are followed to `depth`.
    fn found(&mut self, name: &'s str, depth: usize) -> Found {
        if let Some(known) = self.known.get(name) {
            return *known;
        }
        let found = self.scenario.triggers.get(name).map_or(Ok(None), |trigger| self.look(trigger, depth));
        self.known.insert(name, found);
        found
    }

    fn look(&mut self, trigger: &'s TriggerSection, depth: usize) -> Found {
        let span_s = [self.time.start_s, self.time.end_s];
        let watch = |of, threshold, lasting: &Option<Time<NOT_NEGATIVE>>| {
            Ok(Some(Fires::Watch(of, threshold, si_or(lasting, 0.0))))
        };
        let by_motion = |vehicle: &Option<String>| {
            let path = self.path(vehicle.as_deref())?;
            let expected = "another kind of trigger, or a path with interpolate = \"spline\"";
            path.has_accelerations()
                .then_some(path)
                .ok_or(["a trigger by acceleration on a path without accelerations", expected])
        };
        match trigger {
            TriggerSection::Time { at } => Ok(Some(Fires::At(at.si()))),
            TriggerSection::VehicleAcceleration { vehicle, direction, threshold, lasting } => {
                let way = direction.as_ref().map(|way| Vector3::from(all_si(way)).try_normalize(0.0));
                let way = way.map(|way| way.ok_or(["a direction of no length", "a way along the vehicle's axes"]));
                let (way, path) = (way.transpose()?, by_motion(vehicle)?);
                Ok(path.jolt_s(span_s, way, threshold.si(), si_or(lasting, 0.0)).map(Fires::At))
            }
            TriggerSection::DeltaV { vehicle, threshold, wake } => {
                Ok(by_motion(vehicle)?.change_s(span_s, threshold.si(), wake.si()).map(Fires::At))
            }
            TriggerSection::Any { of } => {
                let times_s = self.times_s(of, depth)?;
                Ok(times_s.into_iter().flatten().min_by(f64::total_cmp).map(Fires::At))
            }
            TriggerSection::All { of } => {
                let times_s: Option<Vec<f64>> = self.times_s(of, depth)?.into_iter().collect();
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

    /// The path of a vehicle; by default the first.
    fn path(&self, vehicle: Option<&str>) -> Result<&'s VehiclePath, [&'static str; 2]> {
        let frame = vehicle.map_or(Some(Frame::Vehicle), |name| self.scenario.frame_named(name));
        match frame {
            Some(Frame::Vehicle) => Some(self.paths.first),
            Some(Frame::Other(i)) => {
                self.paths.others.get(i).filter(|other| other.parent.is_none()).map(|other| &other.path)
            }
            _ => None,
        }
        .ok_or(["a trigger by the motion of something that is not a vehicle", "\"vehicle\" or a name under `vehicles`"])
    }

    /// Firing times of other triggers, s; none for one that does not fire.
    fn times_s(&mut self, names: &'s [String], depth: usize) -> Result<Vec<Option<f64>>, [&'static str; 2]> {
        if depth == 0 {
            let found = "triggers that wait for one another in a loop";
            return Err([found, "triggers without a loop"]);
        }
        let mut list = Vec::new();
        for name in names.iter().filter(|name| self.scenario.triggers.contains_key(*name)) {
            match self.found(name, depth - 1)? {
                Some(Fires::Watch(..)) => {
                    let expected = "triggers by time or by the vehicle's motion";
                    return Err(["a group that contains a trigger on a belt", expected]);
                }
                Some(Fires::At(at_s)) => list.push(Some(at_s)),
                None => list.push(None),
            }
        }
        Ok(list)
    }
}
