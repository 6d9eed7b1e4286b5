//! `[drive]`: vehicles that are simulated before the people, and their motion.

mod barriers;
mod crush;
mod driver;
mod facts;
mod ground;
mod parts;
mod passes;
mod people;
mod scenery;
mod standing;
mod survey;
mod vehicle;

use std::sync::Arc;

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vehicle_motion::car::{Car, CarError};
use vehicle_motion::integrate::Tolerance;
use vehicle_motion::path::DrivenPath as Motion;
use vehicle_motion::world::{Begin, Entry, Outcome, World, WorldError};
use vehicle_motion::{V3, WHEEL_NAMES};

use self::barriers::BarrierSection;
use self::crush::ImpactSection;
pub(super) use self::facts::{facts, logs};
use self::ground::RoadSection;
pub(crate) use self::passes::Pushers;
pub(crate) use self::people::{People, asks_for_people};
pub(super) use self::scenery::scenery;
pub use self::scenery::{Drawing, drawings};
pub use self::standing::moving_rails;
use self::vehicle::DrivenSection;
use super::builder::Builder;
use super::path::PathSection;
use super::quantity::{NOT_NEGATIVE, POSITIVE, si_or};
use super::{Length, Ratio, Scenario, Time};
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
use occupant_core::vehicle::{DrivenPath, VehiclePath};
use placed_text::{Diagnostics, Document, Problem, with_key};

/// Road vehicles, simulated before the occupants. Axes are vehicle-space: x forward, y to the right, z down; yaw and
/// steering are positive to the right, heights and slopes upward.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DriveSection {
    /// End of the drive, which starts at time 0.
    pub(crate) end: Time<POSITIVE>,
    /// Allowed position error of a step; 0.01 mm if absent.
    pub(crate) tolerance: Option<Length<POSITIVE>>,
    /// Passes in which people push their vehicles by the forces of the pass before, instead of riding as rigid mass; 0 if
    /// absent, at most 20. They end early once all positions change by less than 1 mm. Each is one more drive and one more
    /// run of the people.
    pub(crate) passes: Option<u64>,
    /// Vehicles by name. A `path` of kind "drive" names one of them.
    pub(crate) vehicles: IndexMap<String, DrivenSection>,
    /// The ground; a level road with friction 0.76 if absent.
    pub(crate) ground: Option<RoadSection>,
    /// Barriers and other obstacles beside the road, by name.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) barriers: IndexMap<String, BarrierSection>,
    /// Friction between vehicles in contact; 0.55 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
    /// Collisions modelled by impulse and momentum instead of crush.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) impacts: Vec<ImpactSection>,
}

/// The motion of a vehicle of `drive`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DrivenPathSection {
    /// Name of the vehicle in `drive.vehicles`; not needed if there is only one.
    pub(crate) vehicle: Option<String>,
}

/// The results of a drive. Clones share them.
#[derive(Clone, Debug)]
pub struct Drives(Arc<Solved>);

/// The drives of a scenario.
#[derive(Debug)]
pub struct Solved {
    /// The vehicles, in the scenario's order.
    pub vehicles: Vec<DrivenVehicle>,
    /// The motion of each vehicle, in that order, and their contacts.
    pub outcome: Outcome,
    /// Vehicles, ground, barriers and drivers.
    pub world: World,
    /// Name and kind of each barrier, in the order of the world's.
    pub barriers: Vec<(String, &'static str)>,
    /// Of each pass made, the largest change of the position of a compartment, m.
    pub changes_m: Vec<f64>,
    people: Vec<Option<People>>,
    paths: Vec<VehiclePath>,
}

/// A vehicle that was driven.
#[derive(Clone, Debug)]
pub struct DrivenVehicle {
    /// Its name.
    pub name: String,
    /// Its preset.
    pub preset: &'static vehicle_motion::presets::Preset,
    /// The vehicle without load.
    pub unladen: Car,
    /// The vehicle with its load.
    pub car: Car,
    /// Position of the compartment's origin (the unladen centre of gravity) from the laden centre of gravity, body
    /// axes, m.
    pub origin_m: V3,
    /// Keys given by the scenario instead of the preset.
    pub given: Vec<&'static str>,
}

impl std::ops::Deref for Drives {
    type Target = Solved;
    fn deref(&self) -> &Solved {
        &self.0
    }
}

impl Solved {
    /// What was driven; barriers and people are those of another drive.
    fn of(vehicles: Vec<DrivenVehicle>, outcome: Outcome, world: World, like: &Solved) -> Self {
        let (barriers, people) = (like.barriers.clone(), like.people.clone());
        Solved::new(vehicles, outcome, world, (barriers, people))
    }

    fn new(
        vehicles: Vec<DrivenVehicle>,
        outcome: Outcome,
        world: World,
        (barriers, people): (Vec<(String, &'static str)>, Vec<Option<People>>),
    ) -> Self {
        let path =
            |(ride, own): (&_, &DrivenVehicle)| VehiclePath::Driven(DrivenPath::new(Motion::of(ride, own.origin_m)));
        let paths = outcome.rides.iter().zip(&vehicles).map(path).collect();
        Solved { vehicles, outcome, world, barriers, changes_m: Vec::new(), people, paths }
    }

    /// The motion of the compartment of a vehicle by its number.
    pub fn motion(&self, vehicle: usize) -> Motion {
        Motion::of(&self.outcome.rides[vehicle], self.vehicles[vehicle].origin_m)
    }

    /// The path of a vehicle's compartment by its number.
    pub fn path(&self, vehicle: usize) -> &VehiclePath {
        &self.paths[vehicle]
    }
}

impl DriveSection {
    /// Vehicles, ground and barriers; mistakes are reported.
    fn world(&self, b: &mut Builder, s: &Scenario, people: &[Option<People>]) -> (World, Vec<DrivenVehicle>) {
        let (ground, friction) = ground::ground(b, self.ground.as_ref());
        let usual = World::default();
        let mut world = World { ground, friction: si_or(&self.friction, usual.friction), ..usual };
        if let Some(tolerance) = &self.tolerance {
            // speeds go by ten times the places per second
            let place_m = tolerance.si();
            let speed_m_s = 10.0 * place_m;
            world.tolerance = Tolerance { place_m, speed_m_s, relative: place_m, ..world.tolerance };
        }
        world.tolerance.longest_s = LONGEST_S;
        let mut vehicles = Vec::new();
        for (i, (name, own)) in self.vehicles.iter().enumerate() {
            let at = with_key("drive.vehicles", name);
            let people = people.get(i).and_then(Option::as_ref);
            let riders = (people, s.carries(i), self.passes.unwrap_or(0) > 0);
            let Some(vehicle) = own.vehicle(b, &at, name, friction, riders) else { continue };
            let driver = driver::driver(b, &at, own, &vehicle.car);
            let begin = Begin::At(own.start.start());
            world.cars.extend(driver.map(|driver| Entry::new(vehicle.car.clone(), driver, begin)));
            vehicles.push(vehicle);
        }
        if self.passes.is_some_and(|passes| passes > passes::MOST) {
            let found = format!("{} passes", self.passes.unwrap_or_default());
            b.error("drive.passes", found, format!("at most {}: they settle after two or three", passes::MOST));
        }
        if self.vehicles.is_empty() {
            b.error("drive.vehicles", "no vehicle", "a table for each vehicle, such as [drive.vehicles.car]");
        }
        let first = self.vehicles.values().next().map(|own| own.start.start()).unwrap_or_default();
        for (name, own) in &self.barriers {
            world.barriers.extend(own.barrier(b, &with_key("drive.barriers", name), [first.x_m, first.y_m]));
        }
        for (i, own) in self.impacts.iter().enumerate() {
            world.impulses.extend(own.impact(b, &format!("drive.impacts[{i}]"), self));
        }
        (world, vehicles)
    }

    /// The number of the vehicle referred to by a path.
    fn named(&self, path: &DrivenPathSection) -> Option<usize> {
        match &path.vehicle {
            Some(name) => self.vehicles.get_index_of(name),
            None => (self.vehicles.len() == 1).then_some(0),
        }
    }
}

/// Simulates all vehicles; `people` are the occupants of each. None without vehicles.
///
/// # Errors
/// Problems of vehicles, ground and drivers, with its place; warnings are among the others.
pub(crate) fn solve(
    s: &Scenario,
    document: &Document,
    people: &[Option<People>],
) -> Result<(Option<Drives>, Diagnostics), Diagnostics> {
    let Some(section) = &s.drive else { return Ok((None, Diagnostics::new())) };
    let b = &mut Builder { document, problems: Diagnostics::new(), drives: None };
    let gravity_m_s2 = si_or(&s.gravity, STANDARD_GRAVITY_M_S2);
    if gravity_m_s2 != STANDARD_GRAVITY_M_S2 {
        b.error(
            "gravity",
            format!("vehicles that drive under {gravity_m_s2} m/s²"),
            "standard gravity: leave the key out",
        );
    }
    let (world, vehicles) = section.world(b, s, people);
    if b.problems.has_errors() {
        return Err(std::mem::take(&mut b.problems));
    }
    let outcome = match world.run(section.end.si()) {
        Ok(outcome) => outcome,
        Err(error) => {
            refuse(b, section, &error);
            return Err(std::mem::take(&mut b.problems));
        }
    };
    let barriers = section.barriers.iter().map(|(name, own)| (name.clone(), own.kind())).collect();
    let solved = Solved::new(vehicles, outcome, world, (barriers, people.to_vec()));
    Ok((Some(Drives(Arc::new(solved))), std::mem::take(&mut b.problems)))
}

/// Warnings about what happened in a drive.
pub(crate) fn caveats(s: &Scenario, document: &Document, solved: &Solved) -> Diagnostics {
    let b = &mut Builder { document, problems: Diagnostics::new(), drives: None };
    solved.warn_of_crush(b);
    solved.warn_of_rails(b);
    solved.warn_of_impacts(b);
    let ground = s.drive.as_ref().and_then(|drive| drive.ground.as_ref());
    if ground.is_some_and(|ground| ground.grid.is_some()) {
        solved.warn_of_grid(b);
    }
    std::mem::take(&mut b.problems)
}

/// Longest step of a drive, s: the occupants' frame moves along polynomials between its stations.
const LONGEST_S: f64 = 0.01;

/// The key of a vehicle that a problem is about, and what is expected of it.
fn mend(what: &CarError) -> (&'static str, &'static str) {
    match what {
        CarError::Inertia => ("inertia", "[roll, pitch, yaw], each at most the sum of the other two"),
        CarError::Wheels => ("suspension", "lighter wheels, or a heavier vehicle with larger moments of inertia"),
        CarError::Axles { .. } => ("cg_behind_front_axle", "a centre of gravity between the axles"),
        CarError::Crown { .. } => ("tyres", "a larger radius"),
        CarError::Shares { what: "brake", .. } => ("brakes", "four shares that sum to 1"),
        CarError::Shares { .. } => ("drive_shares", "four shares that sum to 1"),
        _ => ("preset", "a vehicle that can stand on its wheels"),
    }
}

/// Reports why vehicles could not be driven.
fn refuse(b: &mut Builder, section: &DriveSection, error: &WorldError) {
    let at = |car: usize| {
        section.vehicles.get_index(car).map_or_else(String::new, |(name, _)| with_key("drive.vehicles", name))
    };
    match error {
        WorldError::Car { car, what } => {
            let (key, expected) = mend(what);
            let own = at(*car);
            let place = if b.document.has(&format!("{own}.{key}")) { format!("{own}.{key}") } else { own };
            b.error(&place, what.to_string(), expected);
        }
        WorldError::Overlap { between: (one, other), depth_m } => {
            let name = |car: usize| section.vehicles.get_index(car).map_or("", |(name, _)| name.as_str());
            let found = format!("{} and {} overlap by {depth_m:.3} m at the start", name(*one), name(*other));
            b.error(&with_key(&at(*other), "start"), found, "vehicles that start apart");
        }
        WorldError::InBarrier { car, barrier, depth_m } => {
            let name = section.barriers.get_index(*barrier).map_or("", |(name, _)| name.as_str());
            let found = format!("it is {depth_m:.3} m within {name}");
            b.error(&with_key(&at(*car), "start"), found, "a start before the barrier");
        }
        WorldError::Late { impact, time_s, end_s } => {
            let found = format!("{time_s} s, and the drive ends at {end_s} s");
            b.error(&format!("drive.impacts[{impact}].time"), found, "a time before the end of the drive");
        }
        WorldError::Buried { car, wheel, depth_m, most_m } => {
            let wheel = WHEEL_NAMES[*wheel];
            let found = format!("its {wheel} wheel is {depth_m:.3} m deep in the ground at the start");
            let expected = format!("at most {most_m:.3} m: move the start, or the curb or edge that it lies across");
            b.error(&with_key(&at(*car), "start"), found, expected);
        }
        WorldError::Barrier { barrier, what } => {
            let name = section.barriers.get_index(*barrier).map_or("", |(name, _)| name.as_str());
            b.error(&with_key("drive.barriers", name), *what, "a barrier that stands");
        }
        WorldError::Step { .. } if b.document.has("drive.ground.curbs") => {
            let expected =
                "inputs that a vehicle can follow: no wheel that strikes a curb sideways at more than 14 m/s";
            b.error("drive.ground.curbs", error.to_string(), expected);
        }
        other => b.error("drive", other.to_string(), "inputs that a vehicle can follow"),
    }
}

/// The path of a vehicle of `drive`.
pub(super) fn path(b: &mut Builder, section: &DrivenPathSection) -> Option<VehiclePath> {
    let Some(drive) = b.section::<DriveSection>("drive") else {
        b.error(
            "path",
            "a path of kind \"drive\" where nothing is driven",
            "[drive] with a vehicle in [drive.vehicles.NAME]",
        );
        return None;
    };
    let Some(number) = drive.named(section) else {
        let names: Vec<&str> = drive.vehicles.keys().map(String::as_str).collect();
        match &section.vehicle {
            Some(name) => b.unknown("path.vehicle", "vehicle of `drive`", name, &names),
            None => b.error(
                "path",
                "several vehicles are driven",
                format!("vehicle = {}", placed_text::one_of(&names, '"')),
            ),
        }
        return None;
    };
    // people are weighed in a vehicle that stands
    Some(b.drives.map_or_else(VehiclePath::parked, |drives| drives.path(number).clone()))
}

/// Reports vehicles of the scenario that follow the same vehicle of `drive`.
pub(super) fn check_names(b: &mut Builder, s: &Scenario) {
    let Some(drive) = &s.drive else { return };
    let mut taken: Vec<(usize, String)> = Vec::new();
    for (at, path) in s.paths() {
        let PathSection::Drive(own) = path else { continue };
        let Some(number) = drive.named(own) else { continue };
        match taken.iter().find(|(other, _)| *other == number) {
            Some((_, other)) => {
                b.error(
                    &at,
                    format!("`{other}` is the same vehicle of `drive`"),
                    "another vehicle of `drive` for each path",
                );
            }
            None => taken.push((number, at)),
        }
    }
}

/// Warns if the mass of occupants, or a fixed load, is a large part of the vehicle's mass; people may push it instead.
fn warn_of_load(b: &mut Builder, at: &str, load_kg: f64, mass_kg: f64, are_people: bool) {
    if load_kg > 0.1 * mass_kg {
        let found = format!("a fixed load of {load_kg:.0} kg in a vehicle of {mass_kg:.0} kg");
        let expected = if are_people {
            "at most a tenth of its mass, or drive.passes = 3: heavier people move relative to the vehicle and push it"
        } else {
            "at most a tenth of its mass: heavier cargo moves relative to the vehicle and pushes it"
        };
        b.report(Problem::warning(with_key(at, "payload"), found, expected));
    }
}
