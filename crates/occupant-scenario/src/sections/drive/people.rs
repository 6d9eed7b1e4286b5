//! Occupants of driven vehicles: their mass, and whether the crush reaches them.

use occupant_units::trig;
use vehicle_motion::V3;
use vehicle_motion::barrier::Barrier;
use vehicle_motion::body::Side;
use vehicle_motion::run::Station;
use vehicle_motion::world::{Miss, Partner};

use super::super::Scenario;
use super::super::builder::Builder;
use super::super::frames::VEHICLE;
use super::super::path::PathSection;
use super::{DrivenSection, Solved};
use occupant_core::model::Model;
use placed_text::{Diagnostics, Document, Problem, with_key};

/// Occupants of a vehicle: mass, and their centre of gravity in its axes, from its own without load.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct People {
    pub(crate) mass_kg: f64,
    pub(crate) centre_m: V3,
    balls: Vec<Ball>,
}

/// Initial position of an occupant's sphere, vehicle axes.
#[derive(Clone, Debug, PartialEq)]
struct Ball {
    /// The occupant's name in the scenario, and the sphere's name.
    who: String,
    name: String,
    place_m: V3,
    radius_m: f64,
}

/// What the crush pushes ahead of itself, in words.
const BEHIND_M: &str = "0.2 m of door and 0.4 m of engine";

/// Crush that reaches less deep into a sphere is ignored, m.
const REACHES_M: f64 = 0.05;

/// Whether a load depends on a vehicle's occupants, or its crush may reach them.
pub(crate) fn asks_for_people(s: &Scenario) -> bool {
    let Some(drive) = &s.drive else { return false };
    let may_crush = drive.vehicles.len() > 1 || !drive.barriers.is_empty();
    let carries = (0..drive.vehicles.len()).any(|number| s.carries(number));
    let passes = drive.passes.unwrap_or(0) > 0;
    drive.vehicles.values().any(DrivenSection::takes_people) || (may_crush || passes) && carries
}

impl Scenario {
    /// The vehicle of `drive` that a vehicle of the scenario follows.
    pub(super) fn driven(&self, vehicle: &str) -> Option<usize> {
        let own = self.vehicles.get(vehicle).map(|own| &own.path);
        let path = own.or_else(|| (vehicle == VEHICLE).then(|| self.first_path().map(|(_, path)| path)).flatten())?;
        match path {
            PathSection::Drive(own) => self.drive.as_ref()?.named(own),
            _ => None,
        }
    }

    /// Bodies: the path of each in the scenario, and its initial vehicle.
    fn homes(&self) -> impl Iterator<Item = (String, Option<&str>)> {
        let first = self.body.is_some().then_some(("body".to_owned(), Some(VEHICLE)));
        let others = self.occupants.iter().map(|(name, own)| (with_key("occupants", name), own.vehicle.as_deref()));
        let loose = self.loose.iter().map(|(name, own)| (with_key("loose", name), own.vehicle.as_deref()));
        first.into_iter().chain(others).chain(loose)
    }

    /// Whether anyone starts in a vehicle of `drive`.
    pub(super) fn carries(&self, number: usize) -> bool {
        self.homes().any(|(_, home)| home.and_then(|home| self.driven(home)) == Some(number))
    }

    /// Occupants that start in each vehicle of `drive`; `model` has them in vehicles at rest at the origin.
    pub(crate) fn weighed(&self, model: &Model) -> Vec<Option<People>> {
        let mut people = vec![None; self.drive.as_ref().map_or(0, |drive| drive.vehicles.len())];
        let bodies = if model.alone().is_empty() { std::slice::from_ref(model) } else { model.alone() };
        for ((who, home), body) in self.homes().zip(bodies) {
            let Some(vehicle) = home.and_then(|home| self.driven(home)) else { continue };
            let one = People::of(&who, body);
            people[vehicle] = Some(match people[vehicle].take() {
                Some(before) => one.and(before),
                None => one,
            });
        }
        people
    }

    /// Reports occupants within the crush of their vehicle without an intruding panel.
    pub(crate) fn check_crush(&self, document: &Document, solved: &Solved) -> Diagnostics {
        let b = &mut Builder { document, problems: Diagnostics::new(), drives: None };
        for number in 0..solved.vehicles.len() {
            let Some((ball, reach_m)) = solved.reached(number, self.time.end.si()) else { continue };
            let name = &solved.vehicles[number].name;
            let found = format!(
                "the crush of {name} reaches {reach_m:.2} m into the {} of its occupant, but no panel of the scenario intrudes; {BEHIND_M} behind it are guesses",
                ball.name
            );
            let expected = "a panel in [frames] that intrudes as far, a seat farther away, or a milder collision";
            let problem = match self.has_panel(number) {
                true => Problem::warning(&ball.who, found, "a panel in [frames] that intrudes as far: check yours"),
                false => Problem::error(&ball.who, found, expected),
            };
            b.report(problem);
        }
        std::mem::take(&mut b.problems)
    }

    /// Whether a panel moves in a vehicle of `drive`.
    fn has_panel(&self, number: usize) -> bool {
        self.frames.iter().any(|(name, own)| {
            let home = self.frame_named(name).and_then(|frame| self.vehicle_of(frame));
            let names = std::iter::once(VEHICLE).chain(self.vehicles.keys().map(String::as_str));
            let mut driven = names.filter(|name| self.driven(name) == Some(number));
            own.path.is_some() && driven.any(|name| home.is_some() && self.frame_named(name) == home)
        })
    }
}

impl People {
    fn of(who: &str, body: &Model) -> Self {
        let turned = |at: nalgebra::Vector3<f64>| V3::new(at.x, -at.y, -at.z);
        let (mass_kg, centre) = body.centre_at_start();
        let spheres = body.body().spheres.iter().zip(body.spheres_at_start());
        let ball = |(sphere, place): (&occupant_core::body::ContactSphere, nalgebra::Vector3<f64>)| Ball {
            who: who.to_owned(),
            name: sphere.name.replace('_', " "),
            place_m: turned(place),
            radius_m: sphere.radius_m,
        };
        People { mass_kg, centre_m: turned(centre), balls: spheres.map(ball).collect() }
    }

    fn and(mut self, other: Self) -> Self {
        let mass_kg = self.mass_kg + other.mass_kg;
        self.centre_m = (self.centre_m * self.mass_kg + other.centre_m * other.mass_kg) / mass_kg;
        self.mass_kg = mass_kg;
        self.balls.extend(other.balls);
        self
    }
}

impl Solved {
    /// The sphere that the crush of a vehicle before a time intrudes most deeply, and the depth, m; none if it reaches
    /// none.
    fn reached(&self, number: usize, end_s: f64) -> Option<(&Ball, f64)> {
        let meets = |contact: &&vehicle_motion::world::Contact| {
            contact.from_s < end_s && (contact.car == number || contact.partner == Partner::Car(number))
        };
        self.outcome.contacts.iter().find(meets)?;
        let (own, damage) = (&self.vehicles[number], &self.outcome.damage[number]);
        let balls = &self.people.get(number)?.as_ref()?.balls;
        let reach = |ball: &Ball| damage.reaches_m(&(ball.place_m + own.origin_m), ball.radius_m, &own.car);
        let reached = balls.iter().filter_map(|ball| Some((ball, reach(ball)?)));
        reached.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, reach_m)| *reach_m > REACHES_M)
    }

    /// Warns of vehicles that meet a rail beyond an end: there it is a point that holds, and nothing stands behind it.
    pub(super) fn warn_of_rails(&self, b: &mut Builder) {
        for contact in &self.outcome.contacts {
            let Partner::Barrier(number) = contact.partner else { continue };
            let Barrier::Rail(rail) = &self.world.barriers[number] else { continue };
            let (own, [from, to]) = (&self.vehicles[contact.car], rail.line_m);
            let length_m = trig::hypot(to[0] - from[0], to[1] - from[1]);
            let body = &own.car.body;
            let (ahead_m, behind_m) = (body.front_m, body.front_m - body.length_m);
            let share = |station: &Station, x: f64, y: f64| {
                let at = station.position_m + station.attitude * V3::new(x, y, 0.0);
                ((at.x - from[0]) * (to[0] - from[0]) + (at.y - from[1]) * (to[1] - from[1])) / (length_m * length_m)
            };
            let half_m = 0.5 * body.width_m;
            let corners = [(ahead_m, half_m), (ahead_m, -half_m), (behind_m, half_m), (behind_m, -half_m)];
            let meets = |station: &&Station| contact.from_s <= station.time_s && station.time_s <= contact.until_s;
            let beyond =
                |station: &Station| corners.iter().any(|(x, y)| !(0.0..=1.0).contains(&share(station, *x, *y)));
            let Some(first) = self.outcome.rides[contact.car].stations().iter().filter(meets).find(|s| beyond(s))
            else {
                continue;
            };
            let found =
                format!("{} is beyond an end of this rail at {:.3} s, while it touches it", own.name, first.time_s);
            let expected = "a longer line: an end is a point that does not move, without a terminal";
            b.report(Problem::warning(with_key("drive.barriers", &self.barriers[number].0), found, expected));
        }
    }

    /// Warns of impacts that did not act, and of people in one without duration.
    pub(super) fn warn_of_impacts(&self, b: &mut Builder) {
        for (i, impact) in self.world.impulses.iter().enumerate().filter(|(_, impact)| impact.duration_s == 0.0) {
            let (first, second) = impact.between;
            let cars = (0..self.vehicles.len()).filter(|car| *car == first || Partner::Car(*car) == second);
            let mut carry = cars.filter(|car| self.people.get(*car).is_some_and(Option::is_some));
            let acts = self.outcome.missed.iter().all(|missed| missed.impact != i);
            if let Some(car) = carry.next().filter(|_| acts) {
                let found = format!(
                    "people in {}, whose speed jumps: the acceleration that loads them is not defined",
                    self.vehicles[car].name
                );
                let expected = "a duration above 0, such as \"0.1 s\"";
                b.report(Problem::warning(format!("drive.impacts[{i}].duration"), found, expected));
            }
        }
        for missed in &self.outcome.missed {
            let (car, partner) = self.world.impulses[missed.impact].between;
            let partner = match partner {
                Partner::Car(other) => &self.vehicles[other].name,
                Partner::Barrier(number) => &self.barriers[number].0,
            };
            let found = format!(
                "the impact between {} and {partner} does not act: {}; they pass through each other",
                self.vehicles[car].name, missed.why
            );
            let expected = match missed.why {
                Miss::Untouched => "paths that meet, or a `time`",
                Miss::Separate(_) => "a `normal` along which they close, or no impact",
                Miss::Gains(_) => "a smaller `restitution` or `friction`",
                Miss::Away { .. } => "`at` and `time` where both meet",
            };
            b.report(Problem::warning(format!("drive.impacts[{}]", missed.impact), found, expected));
        }
    }

    /// Warns of vehicles that leave their grid of heights.
    pub(super) fn warn_of_grid(&self, b: &mut Builder) {
        for (own, ride) in self.vehicles.iter().zip(&self.outcome.rides) {
            let beyond = |station: &Station| {
                let mut rolls = station.wheels.iter().filter(|wheel| wheel.load_n > 0.0).map(|wheel| wheel.contact_m);
                rolls.find(|at| !self.world.ground.is_given(at.x, at.y)).map(|at| (station.time_s, at))
            };
            let Some((time_s, place)) = ride.stations().iter().find_map(beyond) else { continue };
            let found = format!(
                "a wheel of {} leaves the surveyed ground at {time_s:.2} s, x {:.2} m, y {:.2} m",
                own.name, place.x, place.y
            );
            let expected = "a larger grid: beyond its rim the ground is level outwards";
            b.report(Problem::warning("drive.ground.grid", found, expected));
        }
    }

    /// Warns of crush that is deeper than the front is long, or than half of the vehicle.
    pub(super) fn warn_of_crush(&self, b: &mut Builder) {
        for (own, damage) in self.vehicles.iter().zip(&self.outcome.damage) {
            let body = &own.car.body;
            let half_m = |side: Side| match side {
                Side::Front | Side::Rear => 0.5 * body.length_m,
                Side::Left | Side::Right => 0.5 * body.width_m,
            };
            if let Some(dent) = damage.dents.iter().find(|dent| dent.depth_m > half_m(dent.side)) {
                let found = format!("{} is crushed by {:.2} m, more than half of it", own.name, dent.depth_m);
                let expected = "a milder collision or a stiffer side: what is left of it has no stiffness of its own";
                b.report(Problem::warning(with_key("drive.vehicles", &own.name), found, expected));
                continue;
            }
            let front_m = own.car.body.front_m - own.car.front.ahead_m;
            if damage.front_m() > front_m {
                let found = format!("{} is crushed by {:.2} m at its front", own.name, damage.front_m());
                let expected = format!(
                    "at most {front_m:.2} m, the distance to its front axle: class stiffness does not model the firewall"
                );
                b.report(Problem::warning(with_key("drive.vehicles", &own.name), found, expected));
            }
        }
    }
}
