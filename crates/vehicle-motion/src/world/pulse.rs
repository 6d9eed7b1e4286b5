//! An impact of a run: an instantaneous impulse, or one spread over a time.

use crate::V3;
use crate::crush::touch::{Pose, Push};
use crate::impulse::{NoBlow, Planar, blow, cross};
use crate::integrate::Stack;
use crate::state::State;
use crate::world::setup::Setup;
use crate::world::{Contact, Impact, Miss, Partner};

/// How far outside of an outline the place of an impact may lie: outlines, times and places are estimates, m.
const AWAY_M: f64 = 1.0;

impl Impact {
    /// The pair, the vehicle of lower number first.
    pub(crate) fn pair(&self) -> (usize, Partner) {
        match self.between {
            (car, Partner::Car(other)) if other < car => (other, Partner::Car(car)),
            pair => pair,
        }
    }
}

/// An impact in progress: an impulse spread over time as a haversine.
#[derive(Clone, Debug)]
pub(crate) struct Pulse {
    bodies: [usize; 2],
    partner: Partner,
    start_s: f64,
    pub duration_s: f64,
    impulse: V3,
    /// Moments of the impulse about the vertical axes of both, N·m·s.
    turns: [f64; 2],
}

impl Pulse {
    /// Impulse of an impact that begins now.
    ///
    /// # Errors
    /// Why it does not act.
    pub fn of(setup: &Setup, impact: &Impact, time_s: f64, stack: &Stack, poses: &[Pose]) -> Result<Self, Miss> {
        let (car, partner) = impact.pair();
        let body = match partner {
            Partner::Car(other) => other,
            Partner::Barrier(barrier) => setup.vehicles.len() + barrier,
        };
        let place_m = impact.at_m.or_else(|| setup.first_touch_m(car, body, stack, poses)).ok_or(Miss::Untouched)?;
        let by_m = [car, body].map(|own| setup.outside_m(own, place_m, stack, poses)).into_iter().fold(0.0, f64::max);
        if by_m > AWAY_M {
            return Err(Miss::Away { time_s, by_m });
        }
        let planar = |body: usize| match setup.vehicles.get(body) {
            Some(vehicle) => {
                let state = &stack.cars[body];
                let (at, velocity) = (state.position_m(), state.velocity_m_s());
                Planar {
                    mass_kg: vehicle.mass_kg,
                    inertia_kg_m2: vehicle.yaw_kg_m2,
                    at_m: [at.x, at.y],
                    velocity_m_s: [velocity.x, velocity.y],
                    turning_rad_s: (state.attitude() * state.rotation_rad_s()).z,
                }
            }
            None => Planar {
                mass_kg: f64::INFINITY,
                inertia_kg_m2: f64::INFINITY,
                at_m: [poses[body].at_m.x, poses[body].at_m.y],
                velocity_m_s: [0.0; 2],
                turning_rad_s: 0.0,
            },
        };
        let both = [planar(car), planar(body)];
        let found = blow([&both[0], &both[1]], place_m, impact.normal_rad, impact.restitution, impact.friction);
        let impulse = found.map_err(|why| match why {
            NoBlow::Separate => Miss::Separate(time_s),
            NoBlow::Gains => Miss::Gains(time_s),
        });
        let impulse = impulse?.impulse_n_s;
        let turns = [cross(both[0].arm_m(place_m), impulse), -cross(both[1].arm_m(place_m), impulse)];
        Ok(Pulse {
            bodies: [car, body],
            partner,
            start_s: time_s,
            duration_s: impact.duration_s,
            impulse: V3::new(impulse[0], impulse[1], 0.0),
            turns,
        })
    }

    /// The vehicles that it strikes.
    pub fn cars(&self) -> impl Iterator<Item = usize> {
        let other = match self.partner {
            Partner::Car(other) => Some(other),
            Partner::Barrier(_) => None,
        };
        [Some(self.bodies[0]), other].into_iter().flatten()
    }

    pub fn contact(&self) -> Contact {
        let peak_n = if self.duration_s > 0.0 { 2.0 * self.impulse.norm() / self.duration_s } else { f64::INFINITY };
        Contact { impulse_n_s: self.impulse, peak_n, ..Contact::begin(self.bodies[0], self.partner, self.start_s) }
    }

    /// Changes the velocities instantly; the vehicles share the energy loss.
    pub fn strike(&self, setup: &Setup, stack: &mut Stack) {
        let mut lost_j = 0.0;
        for (i, car) in self.cars().enumerate() {
            let (vehicle, state) = (&setup.vehicles[car], &mut stack.cars[car]);
            let before_j = vehicle.chassis.kinetic_j(state);
            let sign = if i == 0 { 1.0 } else { -1.0 };
            let velocity = state.velocity_m_s() + self.impulse * (sign / vehicle.mass_kg);
            let turn = state.attitude().inverse() * V3::new(0.0, 0.0, self.turns[i] / vehicle.yaw_kg_m2);
            let turning = state.rotation_rad_s() + turn;
            state.put(7, velocity);
            state.put(10, turning);
            lost_j += before_j - vehicle.chassis.kinetic_j(state);
        }
        let share = lost_j / self.cars().count() as f64;
        for car in self.cars() {
            stack.cars[car].add_crush_j(share);
        }
    }

    /// Adds its force at a time.
    pub fn push(&self, time_s: f64, poses: &[Pose], pushes: &mut [Push]) {
        let s = (time_s - self.start_s) / self.duration_s;
        if !(0.0..=1.0).contains(&s) {
            return;
        }
        let shape = (1.0 - libm::cos(core::f64::consts::TAU * s)) / self.duration_s;
        let mut taken_w = 0.0;
        for (i, car) in self.cars().enumerate() {
            let sign = if i == 0 { 1.0 } else { -1.0 };
            let (force, moment) = (self.impulse * (sign * shape), V3::new(0.0, 0.0, self.turns[i] * shape));
            pushes[car].force_n += force;
            pushes[car].moment_n_m += moment;
            taken_w -= force.dot(&poses[car].velocity_m_s) + moment.dot(&poses[car].turning_rad_s);
        }
        let count = self.cars().count() as f64;
        self.cars().for_each(|car| pushes[car].crushing_w += taken_w / count);
    }
}

impl State {
    fn add_crush_j(&mut self, energy_j: f64) {
        self.0[crate::state::MOTION + 6] += energy_j;
    }
}
