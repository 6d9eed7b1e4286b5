//! Coupled passes: the drive anew, with the forces of the people on their vehicles instead of their mass.

use vehicle_motion::GRAVITY_M_S2;
use vehicle_motion::V3;
use vehicle_motion::car::Riders;
use vehicle_motion::driver::Table;
use vehicle_motion::path::DrivenPath as Motion;
use vehicle_motion::run::Station;
use vehicle_motion::world::{Begin, Entry, World, WorldError, Wrench};

use super::super::Scenario;
use super::super::frames::VEHICLE;
use super::{DriveSection, DrivenVehicle, Drives, People, Solved};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::results::reaction::{Reaction, push_on_vehicle};
use occupant_core::results::sample::Sample;

/// Largest number of passes.
pub(super) const MOST: u64 = 20;
/// Forces below this share of the vehicle's weight, and moments below as much at a metre, do not push.
const NOTHING: f64 = 1e-9;

/// What people exert on their vehicle over time: force, N, and moment about its compartment's origin, N·m, in its axes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Push {
    times_s: Vec<f64>,
    rows: Vec<[f64; 6]>,
}

/// The people of a run, watched for what they exert on the vehicles of `drive`.
pub(crate) struct Pushers<'s> {
    scenario: &'s Scenario,
    /// By vehicle of `drive`: the frame of the vehicle of the scenario that follows it with people in it.
    homes: Vec<Option<Frame>>,
    pub(crate) pushes: Vec<Push>,
}

impl<'s> Pushers<'s> {
    /// None where nobody rides in a vehicle of `drive`.
    pub(crate) fn of(scenario: &'s Scenario, drives: &Drives) -> Option<Self> {
        let names = || std::iter::once(VEHICLE).chain(scenario.vehicles.keys().map(String::as_str));
        let home = |number: usize| {
            drives.people.get(number)?.as_ref()?;
            scenario.frame_named(names().find(|name| scenario.driven(name) == Some(number))?)
        };
        let homes: Vec<Option<Frame>> = (0..drives.vehicles.len()).map(home).collect();
        let pushes = vec![Push::default(); homes.len()];
        homes.iter().any(Option::is_some).then_some(Pushers { scenario, homes, pushes })
    }

    /// Notes what they exert at an output.
    pub(crate) fn see(&mut self, sample: &Sample<'_>) {
        for (home, push) in self.homes.iter().zip(&mut self.pushes) {
            let Some(home) = home else { continue };
            let belongs = |frame: Frame| self.scenario.vehicle_of(frame) == Some(*home);
            let Reaction { force_n, moment_n_m } = push_on_vehicle(sample, *home, &belongs);
            push.times_s.push(sample.time_s);
            push.rows.push([force_n.x, force_n.y, force_n.z, moment_n_m.x, moment_n_m.y, moment_n_m.z]);
        }
    }
}

impl Push {
    /// With people as rigid mass before and behind the run, in the motion of the last pass.
    fn extended(&self, people: &People, own: &DrivenVehicle, stations: &[Station]) -> Self {
        let rigid = |station: &Station| {
            let (at, turning) = (people.centre_m + own.origin_m, station.rotation_rad_s);
            let felt = station.felt_m_s2 + station.turning_rad_s2.cross(&at) + turning.cross(&turning.cross(&at));
            let force = felt * -people.mass_kg;
            let moment = people.centre_m.cross(&force);
            (station.time_s, [force.x, force.y, force.z, moment.x, moment.y, moment.z])
        };
        let [from_s, until_s] = [self.times_s[0], self.times_s[self.times_s.len() - 1]];
        let before = stations.iter().filter(|station| station.time_s < from_s).map(rigid);
        let behind = stations.iter().filter(|station| station.time_s > until_s).map(rigid);
        let during = self.times_s.iter().copied().zip(self.rows.iter().copied());
        let (times_s, rows) = before.chain(during).chain(behind).unzip();
        Push { times_s, rows }
    }

    fn is_nothing(&self, mass_kg: f64) -> bool {
        self.rows.iter().flatten().all(|x| x.abs() < NOTHING * mass_kg * GRAVITY_M_S2)
    }

    /// None if a number is not finite or times do not rise.
    fn wrench(&self, about_m: V3) -> Option<Wrench> {
        let table = |i: usize| Table::new(self.times_s.clone(), self.rows.iter().map(|row| row[i]).collect()).ok();
        let [Some(a), Some(b), Some(c), Some(d), Some(e), Some(f)] = [0, 1, 2, 3, 4, 5].map(table) else { return None };
        Some(Wrench { about_m, components: [a, b, c, d, e, f] })
    }
}

impl Solved {
    /// The drive anew: `first` is that with people as mass, `self` the last one, `pushes` what people exerted in it.
    fn again(&self, section: &DriveSection, first: &Solved, pushes: &[Push]) -> Result<Solved, WorldError> {
        let mut world = World { cars: Vec::new(), ..first.world.clone() };
        let mut vehicles = first.vehicles.clone();
        for (i, (own, sections)) in vehicles.iter_mut().zip(section.vehicles.values()).enumerate() {
            let entry = &first.world.cars[i];
            let pushed = || {
                let people = first.people.get(i)?.as_ref()?;
                let push = pushes.get(i).filter(|push| !push.times_s.is_empty())?;
                let push = push.extended(people, &self.vehicles[i], self.outcome.rides[i].stations());
                let (mut car, origin_m) = if sections.takes_people() {
                    (own.unladen.clone(), V3::zeros())
                } else {
                    (own.car.clone(), own.origin_m)
                };
                car.riders = Some(Riders { mass_kg: people.mass_kg, place_m: people.centre_m + origin_m });
                let wrench = push.wrench(origin_m).filter(|_| !push.is_nothing(car.mass_kg))?;
                Some((car, origin_m, wrench))
            };
            let Some((car, origin_m, wrench)) = pushed() else {
                world.cars.push(entry.clone());
                continue;
            };
            // the compartment starts where it did
            let state = first.outcome.rides[i].stations()[0].state.seen_from(own.origin_m - origin_m);
            let begin = Begin::State(state);
            world.cars.push(Entry { push: Some(wrench), ..Entry::new(car.clone(), entry.driver.clone(), begin) });
            (own.car, own.origin_m) = (car, origin_m);
        }
        let outcome = world.run(section.end.si())?;
        let mut changes_m = self.changes_m.clone();
        let next = Solved::of(vehicles, outcome, world, first);
        changes_m.push(next.change_m(self));
        Ok(Solved { changes_m, ..next })
    }

    /// Largest distance of the compartments from where they were in another pass, m.
    fn change_m(&self, other: &Solved) -> f64 {
        let mut largest_m = 0.0f64;
        for (i, own) in self.vehicles.iter().enumerate() {
            let [now, before] = [self, other].map(|of| Motion::of(&of.outcome.rides[i], of.vehicles[i].origin_m));
            for time_s in now.times_s() {
                largest_m = largest_m.max((now.at(time_s).position_m - before.at(time_s).position_m).norm());
            }
            debug_assert_eq!(own.name, other.vehicles[i].name);
        }
        largest_m
    }
}

impl Drives {
    /// One pass more: see [`Solved::again`]. The largest change of a position is the last of `changes_m`.
    ///
    /// # Errors
    /// A drive that breaks off.
    pub(crate) fn again(&self, s: &Scenario, first: &Drives, pushes: &[Push]) -> Result<Drives, WorldError> {
        match &s.drive {
            Some(section) => Ok(Drives(self.0.again(section, first, pushes)?.into())),
            None => Ok(self.clone()),
        }
    }
}
