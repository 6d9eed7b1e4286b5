//! The run of a world: steps, first contacts, memory.

use crate::chassis::Report;
use crate::crush::touch::Pose;
use crate::hull::Rub;
use crate::integrate::{Pair as Method, Stack, next_step};
use crate::ride::Station;
use crate::state::{NUMBERS, State};
use crate::vehicle::Memory;
use crate::world::contact::{Contact, ENDS_AFTER_S, FADES, LEAST_N};
use crate::world::evaluate::{Findings, NEAR_M};
use crate::world::pulse::Pulse;
use crate::world::setup::{Memories, Pair, Setup};
use crate::world::{Begin, Bend, Miss, Missed, Outcome, Partner, World, WorldError, Wrench};

/// Shortest step, s; smaller ones fail.
const SHORTEST_S: f64 = 1e-9;
/// Largest penetration at the end of a step with a first contact, m.
const TOUCH_M: f64 = 1e-4;
/// Travel per step near curbs, m.
const CURB_M: f64 = 0.02;
/// Longest step within the gap `NEAR_M`, s, and the way that may take longer for what has met and hardly moves, m.
const NEAR_S: f64 = 0.002;
const CREEP_M: f64 = 0.002;

/// Distance of a pair.
#[derive(Clone, Copy, Debug)]
struct Touch {
    gap_m: f64,
    has_touched: bool,
    /// The contact that continues.
    open: Option<usize>,
    /// Last force, s.
    felt_s: f64,
}

/// A run in progress.
pub(crate) struct Runner<'a> {
    pub setup: &'a Setup<'a>,
    pub stack: Stack,
    pub rate: Stack,
    pub memories: Memories,
    pub found: Findings,
    touches: Vec<Touch>,
    pub contacts: Vec<Contact>,
    pulses: Vec<Pulse>,
    fired: Vec<bool>,
    pub missed: Vec<Missed>,
    /// Of impacts without duration: contact, vehicle, and its motion before.
    pub before: Vec<(usize, usize, Station)>,
    pub rides: Vec<Vec<Station>>,
    /// Lines of each rail.
    pub bends: Vec<Vec<Bend>>,
    pub time_s: f64,
    corners_s: Vec<f64>,
    pub evaluations: u64,
    pub rejected: u64,
    greatest_j: f64,
}

impl World {
    /// Drives for `end_s` s.
    ///
    /// # Errors
    /// Problems of the vehicles, their starts or the barriers; steps that become too short.
    pub fn run(&self, end_s: f64) -> Result<Outcome, WorldError> {
        let setup = Setup::new(self)?;
        let cars = setup.begin();
        if !(end_s > 0.0 && end_s.is_finite() && cars.iter().all(|car| car.0.iter().all(|x| x.is_finite()))) {
            return Err(WorldError::Start);
        }
        let times_s = self.impulses.iter().map(|impact| impact.time_s).enumerate();
        for (impact, time_s) in times_s.filter_map(|(i, time_s)| Some((i, time_s?))) {
            if time_s >= end_s {
                return Err(WorldError::Late { impact, time_s, end_s });
            }
        }
        Runner::new(&setup, cars, end_s).run()
    }
}

impl<'a> Runner<'a> {
    fn new(setup: &'a Setup<'a>, cars: Vec<State>, end_s: f64) -> Self {
        let mut corners_s: Vec<f64> = setup.vehicles.iter().flat_map(|vehicle| vehicle.driver.corners_s()).collect();
        corners_s.extend(setup.world.impulses.iter().filter_map(|impact| impact.time_s));
        corners_s.extend(setup.world.cars.iter().filter_map(|entry| entry.push.as_ref()).flat_map(Wrench::corners_s));
        corners_s.retain(|t| *t > 0.0 && *t < end_s);
        corners_s.push(end_s);
        corners_s.sort_by(f64::total_cmp);
        corners_s.dedup();
        let stack = Stack { cars, more: vec![0.0; setup.more()], light_from: 2 * setup.solids.len() };
        let rate = Stack {
            cars: vec![State([0.0; NUMBERS]); stack.cars.len()],
            more: vec![0.0; stack.more.len()],
            light_from: stack.light_from,
        };
        let touch = Touch { gap_m: f64::INFINITY, has_touched: false, open: None, felt_s: f64::NEG_INFINITY };
        Runner {
            setup,
            rate,
            memories: setup.memories(),
            found: Findings {
                reports: vec![Report::default(); stack.cars.len()],
                rubs: vec![Rub::default(); stack.cars.len()],
                loads: vec![0.0; stack.more.len()],
                forces: vec![Default::default(); setup.pairs.len()],
                ..Findings::default()
            },
            touches: vec![touch; setup.pairs.len()],
            contacts: Vec::new(),
            pulses: Vec::new(),
            fired: vec![false; setup.world.impulses.len()],
            missed: Vec::new(),
            before: Vec::new(),
            rides: vec![Vec::new(); stack.cars.len()],
            bends: vec![Vec::new(); setup.rails.len()],
            stack,
            time_s: 0.0,
            corners_s,
            evaluations: 0,
            rejected: 0,
            greatest_j: 0.0,
        }
    }

    fn run(mut self) -> Result<Outcome, WorldError> {
        self.start()?;
        let end_s = self.corners_s[self.corners_s.len() - 1];
        let before_j = self.energy_j();
        self.greatest_j = self.kinetic_j();
        let mut method = Method::of(&self.stack);
        let mut trial = self.found.clone();
        let (mut wanted_s, mut before, mut cap_s) = (1e-4, 1.0, f64::INFINITY);
        let mut next_corner = 0;
        while self.time_s < end_s {
            let looks = self.memories.vehicles.iter().zip(&self.setup.vehicles).filter(|(_, v)| v.follows());
            let look_s = looks.map(|(memory, _)| memory.look_s).fold(f64::INFINITY, f64::min);
            let stop_s = self.corners_s[next_corner].min(look_s);
            let h = self.step(stop_s, wanted_s).min(cap_s);
            let Runner { setup, stack, rate, memories, pulses, time_s, .. } = &self;
            let error = method.attempt(stack, rate, h, &setup.world.tolerance, |share, at, rate| {
                setup.evaluate(time_s + share * h, at, memories, pulses, &mut trial, rate);
            });
            self.evaluations += 3;
            if error > 1.0 || !method.is_finite() {
                self.rejected += 1;
                wanted_s = next_step(h, error, before, false);
                if wanted_s < SHORTEST_S {
                    return Err(WorldError::Step { time_s: self.time_s, step_s: wanted_s });
                }
                continue;
            }
            if let Some(earlier_s) = self.first_touch_s(&trial.poses, h) {
                (cap_s, self.rejected) = (earlier_s, self.rejected + 1);
                continue;
            }
            if self.sinks(&method.end.cars) {
                self.rejected += 1;
                continue;
            }
            let is_full = h >= 0.99 * wanted_s;
            let grown_s = next_step(h, error, before, true);
            wanted_s = if is_full { grown_s } else { wanted_s.max(grown_s) };
            (before, cap_s) = (error, f64::INFINITY);
            self.time_s = if h >= stop_s - self.time_s { stop_s } else { self.time_s + h };
            core::mem::swap(&mut self.stack, &mut method.end);
            core::mem::swap(&mut self.rate, &mut method.end_rate);
            self.log(h, &trial);
            core::mem::swap(&mut self.found, &mut trial);
            while self.time_s >= self.corners_s[next_corner] && next_corner + 1 < self.corners_s.len() {
                next_corner += 1;
            }
            if self.commit() || self.time_s >= stop_s {
                self.evaluate();
            }
            self.greatest_j = self.greatest_j.max(self.kinetic_j());
            self.note();
        }
        let never = self.fired.iter().enumerate().filter(|(_, fired)| !**fired);
        self.missed.extend(never.map(|(impact, _)| Missed { impact, why: Miss::Untouched }));
        self.missed.sort_by_key(|missed| missed.impact);
        let balance = (self.energy_j() - before_j) / self.greatest_j.max(1e-9);
        Ok(self.outcome(balance))
    }

    /// Poses, gaps, held wheels and the first evaluation.
    fn start(&mut self) -> Result<(), WorldError> {
        let mut poses = Vec::new();
        self.setup.pose(&self.stack, &self.memories, &mut poses);
        self.memories.poses = poses;
        for (i, pair) in self.setup.pairs.iter().enumerate() {
            let gap_m = self.setup.gap_m(pair, &self.stack, &self.memories.poses);
            self.touches[i].gap_m = gap_m;
            if gap_m < -1e-3 {
                return Err(match pair.partner {
                    Partner::Car(other) => WorldError::Overlap { between: (pair.car, other), depth_m: -gap_m },
                    Partner::Barrier(barrier) => WorldError::InBarrier { car: pair.car, barrier, depth_m: -gap_m },
                });
            }
        }
        for (i, vehicle) in self.setup.vehicles.iter().enumerate() {
            let (entry, ground) = (&self.setup.world.cars[i], &self.setup.world.ground);
            let buried = vehicle.chassis.buried(&self.stack.cars[i], ground);
            if let (Begin::At(_), Some((wheel, depth_m, most_m))) = (&entry.begin, buried) {
                return Err(WorldError::Buried { car: i, wheel, depth_m, most_m });
            }
            vehicle.look(&self.stack.cars[i], 0.0, &mut self.memories.vehicles[i]);
            vehicle.hold_locked(&mut self.stack.cars[i], 0.0, &mut self.memories.vehicles[i]);
            let (hull, memory) = (&self.setup.hulls[i], &mut self.memories.hulls[i]);
            memory.clear_m = hull.clear_m(&self.stack.cars[i], &self.setup.world.ground);
            hull.commit(&self.stack.cars[i], &vehicle.chassis, || [0.0; 4], memory, &self.setup.world.ground);
        }
        self.fire();
        self.evaluate();
        self.note();
        Ok(())
    }

    fn evaluate(&mut self) {
        let Runner { setup, stack, rate, memories, pulses, time_s, found, .. } = self;
        setup.evaluate(*time_s, stack, memories, pulses, found, rate);
        self.evaluations += 1;
    }

    fn step(&self, stop_s: f64, wanted_s: f64) -> f64 {
        let left_s = stop_s - self.time_s;
        let near_s = self.near_s();
        let h = wanted_s.min(self.setup.world.tolerance.longest_s).min(near_s);
        // no crumb is left before a stop
        if h >= left_s * 0.999 { left_s } else { h.min(if h > 0.5 * left_s { 0.5 * left_s } else { h }) }
    }

    /// Longest step that leaps over no touch.
    fn near_s(&self) -> f64 {
        let mut near_s = f64::INFINITY;
        if self.setup.world.ground.has_steep() {
            // no edge of a wheel leaps behind a curb's face
            let fastest = self.stack.cars.iter().map(|car| car.velocity_m_s().norm()).fold(0.0, f64::max);
            near_s = CURB_M / fastest.max(1e-3);
        }
        for (pair, touch) in self.setup.pairs.iter().zip(&self.touches) {
            if touch.gap_m < f64::INFINITY {
                let speed = self.setup.closing_m_s(pair, &self.found.poses).max(1e-3);
                let has_met = |contact: &Contact| self.time_s - contact.until_s > ENDS_AFTER_S;
                let leans = touch.open.is_some_and(|number| has_met(&self.contacts[number]));
                let least_s = if leans { NEAR_S.max(CREEP_M / speed) } else { NEAR_S };
                near_s = near_s.min(((touch.gap_m - NEAR_M).max(0.0) / speed).max(least_s));
            }
        }
        near_s
    }

    /// If a first contact is within a step of `h` s, the length of a step that ends just after it, s.
    fn first_touch_s(&self, poses: &[Pose], h: f64) -> Option<f64> {
        let mut earliest = None;
        for (pair, touch) in self.setup.pairs.iter().zip(&self.touches) {
            if touch.gap_m <= 0.0 || !self.setup.is_near(pair, poses) {
                continue;
            }
            let gap_m = self.setup.gap_m(pair, &self.stack, poses);
            if gap_m < -TOUCH_M && touch.gap_m.is_finite() {
                let at_s = h * (touch.gap_m + 0.5 * TOUCH_M) / (touch.gap_m - gap_m);
                earliest = Some(earliest.map_or(at_s, |other: f64| other.min(at_s)));
            }
        }
        earliest.filter(|at_s| *at_s > SHORTEST_S)
    }

    /// Whether a hull that was not evaluated touches the ground; it is evaluated from now on.
    fn sinks(&mut self, cars: &[State]) -> bool {
        let mut sinks = false;
        for (i, hull) in self.setup.hulls.iter().enumerate() {
            let memory = &mut self.memories.hulls[i];
            memory.clear_m = hull.clear_m(&cars[i], &self.setup.world.ground);
            if !memory.is_near && memory.clear_m < 0.0 {
                (memory.is_near, sinks) = (true, true);
            }
        }
        sinks
    }

    /// Stores what the step did; true if the rates jump.
    fn commit(&mut self) -> bool {
        let mut jumps = false;
        if !self.setup.pairs.is_empty() {
            self.setup.commit(&self.stack, &self.found.poses, &mut self.memories);
            for (i, pair) in self.setup.pairs.iter().enumerate() {
                let poses = &self.memories.poses;
                // how deep does not matter
                self.touches[i].gap_m = if self.touches[i].gap_m < 0.0 && self.setup.touches(pair, poses) {
                    -TOUCH_M
                } else if self.setup.is_near(pair, poses) {
                    self.setup.gap_m(pair, &self.stack, poses)
                } else {
                    f64::INFINITY
                };
            }
            jumps |= self.touch();
            jumps |= self.fire();
        }
        for (i, vehicle) in self.setup.vehicles.iter().enumerate() {
            let (state, memory) = (&mut self.stack.cars[i], &mut self.memories.vehicles[i]);
            let looks = vehicle.follows() && self.time_s >= memory.look_s;
            if looks {
                vehicle.look(state, self.time_s, memory);
            }
            jumps |= vehicle.commit(self.time_s, state, &self.found.reports[i], memory) || looks;
            let (hull, of_hull) = (&self.setup.hulls[i], &mut self.memories.hulls[i]);
            let steer = || vehicle.controls(self.time_s, state, memory).steer_rad;
            hull.commit(state, &vehicle.chassis, steer, of_hull, &self.setup.world.ground);
        }
        jumps
    }

    /// Notifies drivers of a first contact; true if there is one.
    fn touch(&mut self) -> bool {
        let mut jumps = false;
        for (pair, touch) in self.setup.pairs.iter().zip(&mut self.touches) {
            if touch.gap_m > 0.0 || touch.has_touched {
                continue;
            }
            touch.has_touched = true;
            if let Partner::Barrier(barrier) = pair.partner {
                let velocity = self.stack.cars[pair.car].velocity_m_s();
                let heading = libm::atan2(velocity.y, velocity.x);
                self.memories.slides[barrier].direction_rad.get_or_insert(heading);
            }
            let other = match pair.partner {
                Partner::Car(other) => Some(other),
                Partner::Barrier(_) => None,
            };
            for car in [Some(pair.car), other].into_iter().flatten() {
                hit(&mut self.memories.vehicles[car], self.time_s);
            }
            jumps = true;
        }
        jumps
    }

    /// Starts the impacts that are due; true if there is one.
    fn fire(&mut self) -> bool {
        let mut jumps = false;
        for i in 0..self.fired.len() {
            let impact = &self.setup.world.impulses[i];
            if self.fired[i] || !self.is_due(impact) {
                continue;
            }
            self.fired[i] = true;
            let pulse = match Pulse::of(self.setup, impact, self.time_s, &self.stack, &self.memories.poses) {
                Ok(pulse) => pulse,
                Err(why) => {
                    self.missed.push(Missed { impact: i, why });
                    continue;
                }
            };
            jumps = true;
            for car in pulse.cars() {
                hit(&mut self.memories.vehicles[car], self.time_s);
            }
            let mut contact = pulse.contact();
            if pulse.duration_s > 0.0 {
                let end_s = self.time_s + pulse.duration_s;
                let at = self.corners_s.partition_point(|t| *t < end_s);
                if at < self.corners_s.len() {
                    self.corners_s.insert(at, end_s);
                }
                contact.until_s = end_s;
                self.pulses.push(pulse);
            } else {
                let number = self.contacts.len();
                let before = pulse.cars().map(|car| (number, car, self.station(car)));
                self.before.extend(before.collect::<Vec<_>>());
                pulse.strike(self.setup, &mut self.stack);
            }
            self.contacts.push(contact);
        }
        jumps
    }

    fn is_due(&self, impact: &super::Impact) -> bool {
        match impact.time_s {
            Some(time_s) => self.time_s >= time_s,
            None => {
                let is_pair = |pair: &Pair| (pair.car, pair.partner) == impact.pair();
                let touches = self.setup.pairs.iter().zip(&self.touches);
                touches.into_iter().any(|(pair, touch)| is_pair(pair) && touch.gap_m <= 0.0)
            }
        }
    }

    /// Adds a step's forces to the contacts that go on.
    fn log(&mut self, h: f64, end: &Findings) {
        for (i, pair) in self.setup.pairs.iter().enumerate() {
            let ((from, from_n), (to, to_n)) = (self.found.forces[i], end.forces[i]);
            if from_n.max(to_n) < LEAST_N {
                continue;
            }
            let begun_s = self.time_s - h;
            let force_n = from_n.max(to_n);
            let touch = &mut self.touches[i];
            let was_apart = begun_s - touch.felt_s > ENDS_AFTER_S;
            touch.felt_s = self.time_s;
            let hits_again = |own: &Contact| {
                let has_ended = begun_s - own.until_s > ENDS_AFTER_S;
                has_ended && (was_apart || force_n > FADES * own.peak_n)
            };
            let open = touch.open.filter(|&c| !hits_again(&self.contacts[c]));
            let number = open.unwrap_or_else(|| {
                self.contacts.push(Contact::begin(pair.car, pair.partner, begun_s));
                self.contacts.len() - 1
            });
            touch.open = Some(number);
            let contact = &mut self.contacts[number];
            if begun_s - contact.until_s > ENDS_AFTER_S {
                // they lean on each other
                continue;
            }
            contact.impulse_n_s += (from + to) * (0.5 * h);
            contact.peak_n = contact.peak_n.max(force_n);
            if force_n > FADES * contact.peak_n {
                contact.until_s = self.time_s;
            }
        }
    }

    fn kinetic_j(&self) -> f64 {
        let cars = self.setup.vehicles.iter().zip(&self.stack.cars);
        let moving: f64 = cars.map(|(vehicle, state)| vehicle.chassis.kinetic_j(state)).sum();
        moving + self.setup.slides_j(&self.stack, &self.memories)[0]
    }

    /// Energy with all that was lost since the start less what was put in, J.
    fn energy_j(&self) -> f64 {
        let mut sum = self.setup.slides_j(&self.stack, &self.memories)[1] + self.kinetic_j();
        for (i, vehicle) in self.setup.vehicles.iter().enumerate() {
            let state = &self.stack.cars[i];
            sum += vehicle.chassis.stored_j(state, &self.found.reports[i]) + state.work().spent_j();
        }
        sum
    }
}

fn hit(memory: &mut Memory, time_s: f64) {
    memory.hit_s.get_or_insert(time_s);
}
