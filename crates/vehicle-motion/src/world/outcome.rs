//! Results of a run: stations at every step, and the outcome at its end.

use crate::V3;
use crate::rail::BeamMemory;
use crate::ride::{Ride, Station};
use crate::slider::SlideMemory;
use crate::world::contact::Struck;
use crate::world::damage::Damage;
use crate::world::run::Runner;
use crate::world::setup::{Pair, Rails};
use crate::world::{Bend, Bent, Outcome, Partner, Slid};

/// Lines of rails are kept this far apart, s, while a part of one moves faster than this, m/s.
const BENDS_S: f64 = 0.005;
const MOVES_M_S: f64 = 0.01;

impl Runner<'_> {
    fn note_rails(&mut self) {
        for (rail, bends) in self.setup.rails.iter().zip(&mut self.bends) {
            let y = &self.stack.more[rail.at.clone()];
            let is_due = bends.last().is_none_or(|last| self.time_s >= last.time_s + BENDS_S);
            if is_due && (bends.is_empty() || y.chunks(2).any(|own| own[1].abs() > MOVES_M_S)) {
                bends.push(Bend { time_s: self.time_s, line_m: rail.beam.line_m(y) });
            }
        }
    }

    pub fn note(&mut self) {
        self.note_rails();
        for i in 0..self.rides.len() {
            let station = self.station(i);
            self.rides[i].push(station);
        }
    }

    /// The motion of a vehicle now.
    pub fn station(&self, i: usize) -> Station {
        let (state, report) = (&self.stack.cars[i], &self.found.reports[i]);
        let steer = self.setup.vehicles[i].controls(self.time_s, state, &self.memories.vehicles[i]).steer_rad;
        let struck = |(pair, (force, _)): (&Pair, &(V3, f64))| match pair.partner {
            _ if pair.car == i => *force,
            Partner::Car(other) if other == i => -force,
            _ => V3::zeros(),
        };
        let rate = &self.rate.cars[i].0;
        let struck_n: V3 = self.setup.pairs.iter().zip(&self.found.forces).map(struck).sum();
        let before_m = self.rides[i].last().map_or(0.0, |station| station.crush_m);
        let crush_m = if struck_n == V3::zeros() { before_m } else { self.setup.deepest_m(i, &self.memories) };
        Station {
            time_s: self.time_s,
            position_m: state.position_m(),
            velocity_m_s: state.velocity_m_s(),
            acceleration_m_s2: V3::new(rate[7], rate[8], rate[9]),
            attitude: state.attitude(),
            rotation_rad_s: state.rotation_rad_s(),
            turning_rad_s2: report.turning_rad_s2,
            felt_m_s2: report.felt_m_s2,
            steer_rad: 0.5 * (steer[0] + steer[1]),
            struck_n,
            crush_m,
            hull_n: self.found.rubs[i].force_n,
            wheels: report.wheels,
            state: *state,
        }
    }

    pub fn outcome(self, balance: f64) -> Outcome {
        let Runner {
            setup, mut contacts, missed, before, rides, bends, evaluations, rejected, memories, stack, ..
        } = self;
        let damage = |i: usize| {
            let (shape, taken_j) = (&setup.shapes[i], stack.cars[i].work().crush_j);
            let mass_kg = setup.vehicles[i].mass_kg;
            let crush = Damage::of(&shape.nodes, &memories.most[i], &setup.laws[i], &shape.outline, taken_j, mass_kg);
            Damage { roof_m: setup.hulls[i].roof_m(&memories.hulls[i]), ..crush }
        };
        let damage = (0..rides.len()).map(damage).collect();
        for (number, contact) in contacts.iter_mut().enumerate() {
            let span_s = [contact.from_s, contact.until_s];
            let of = |car: usize, impulse| {
                let before = before.iter().find(|own| (own.0, own.1) == (number, car)).map(|own| &own.2);
                Struck::of(&rides[car], before, span_s, impulse, setup.vehicles[car].mass_kg)
            };
            contact.struck[0] = of(contact.car, contact.impulse_n_s);
            if let Partner::Car(other) = contact.partner {
                contact.struck[1] = of(other, -contact.impulse_n_s);
            }
        }
        contacts.sort_by(|a, b| a.from_s.total_cmp(&b.from_s));
        let ride = |stations| Ride { stations, evaluations, rejected, balance };
        let rides = rides.into_iter().map(ride).collect();
        let bent = |((rail, memory), moving): ((&Rails, &BeamMemory), Vec<Bend>)| Bent {
            barrier: rail.barrier,
            deflection_m: memory.most_m,
            tension_n: memory.most_n,
            released: memory.released(),
            line_m: rail.beam.line_m(&stack.more[rail.at.clone()]),
            moving,
        };
        let rails = setup.rails.iter().zip(&memories.rails).zip(bends).map(bent).collect();
        let slid = |(i, memory): (usize, &SlideMemory)| Slid {
            most_m: memory.most_m,
            direction_rad: memory.direction_rad.unwrap_or(0.0),
            speed_m_s: stack.more[2 * i + 1],
        };
        let slides = memories.slides.iter().enumerate().map(slid).collect();
        Outcome { rides, contacts, missed, damage, slides, rails, evaluations, rejected, balance }
    }
}
