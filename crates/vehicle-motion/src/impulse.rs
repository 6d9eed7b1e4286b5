//! Impacts by impulse and momentum: two bodies in plan, restitution, friction (Kudlich and Slibar).

use crate::V3;
use crate::chassis::State;
use crate::crush::touch::{Pose, Push};
use crate::integrate::Stack;
use crate::world::setup::Setup;
use crate::world::{Contact, Impact, Partner};

/// A body in plan: seen from above, turning clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planar {
    /// Mass, kg; infinite for what does not move.
    pub mass_kg: f64,
    /// Inertia about the vertical axis, kg·m².
    pub inertia_kg_m2: f64,
    /// Place of the centre of gravity, X and Y, m.
    pub at_m: [f64; 2],
    /// Velocity, m/s.
    pub velocity_m_s: [f64; 2],
    /// Yaw rate, rad/s.
    pub turning_rad_s: f64,
}

/// What an impact does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blow {
    /// Impulse on the first body, X and Y, N·s.
    pub impulse_n_s: [f64; 2],
    /// Change of velocity of each body, m/s.
    pub delta_v_m_s: [[f64; 2]; 2],
    /// Change of yaw rate of each, rad/s.
    pub delta_turning_rad_s: [f64; 2],
    /// Kinetic energy lost, J.
    pub lost_j: f64,
    /// Whether the bodies slid along each other to the end.
    pub slides: bool,
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Planar {
    fn arm_m(&self, place_m: [f64; 2]) -> [f64; 2] {
        [place_m[0] - self.at_m[0], place_m[1] - self.at_m[1]]
    }

    fn velocity_at(&self, place_m: [f64; 2]) -> [f64; 2] {
        let arm = self.arm_m(place_m);
        [self.velocity_m_s[0] - self.turning_rad_s * arm[1], self.velocity_m_s[1] + self.turning_rad_s * arm[0]]
    }
}

/// An impact of two bodies at a place, with the direction of the contact's normal in either sense, restitution on both
/// components, and the greatest ratio of the impulse along the contact to that across it. The sense is that in which they
/// close; none if they do not move across the contact.
pub fn blow(bodies: [&Planar; 2], place_m: [f64; 2], normal_rad: f64, restitution: f64, friction: f64) -> Option<Blow> {
    let [first, second] = bodies;
    let (a, b) = (first.velocity_at(place_m), second.velocity_at(place_m));
    let u = [a[0] - b[0], a[1] - b[1]];
    let (sine, cosine) = libm::sincos(normal_rad);
    // from the second to the first: they close along it
    let sense = if cosine * u[0] + sine * u[1] > 0.0 { -1.0 } else { 1.0 };
    let n = [sense * cosine, sense * sine];
    let t = [-n[1], n[0]];
    let arms = bodies.map(|body| body.arm_m(place_m));
    let k = |p: [f64; 2], q: [f64; 2]| {
        let of =
            |i: usize| dot(p, q) / bodies[i].mass_kg + cross(arms[i], p) * cross(arms[i], q) / bodies[i].inertia_kg_m2;
        of(0) + of(1)
    };
    let (k_n, k_t, k_nt) = (k(n, n), k(t, t), k(n, t));
    let (u_n, u_t) = (dot(u, n), dot(u, t));
    if u_n >= 0.0 {
        return None;
    }
    let det = k_n * k_t - k_nt * k_nt;
    let (mut p_n, mut p_t) = ((u_t * k_nt - u_n * k_t) / det, (u_n * k_nt - u_t * k_n) / det);
    let slides = p_t.abs() > friction * p_n;
    if slides {
        let sliding = |sign: f64| -u_n / (k_n + sign * friction * k_nt);
        let sign = p_t.signum();
        let sign = if sliding(sign) > 0.0 { sign } else { -sign };
        p_n = sliding(sign);
        p_t = sign * friction * p_n;
    }
    let [p_n, p_t] = [p_n, p_t].map(|p| p * (1.0 + restitution));
    let impulse = [p_n * n[0] + p_t * t[0], p_n * n[1] + p_t * t[1]];
    let change = |i: usize, sign: f64| {
        let Planar { mass_kg, inertia_kg_m2, .. } = *bodies[i];
        ([0, 1].map(|j| sign * impulse[j] / mass_kg), sign * cross(arms[i], impulse) / inertia_kg_m2)
    };
    let (of_first, of_second) = (change(0, 1.0), change(1, -1.0));
    // −J·(u + ½ΔU) with the change of the velocity of approach
    let (du_n, du_t) = (k_n * p_n + k_nt * p_t, k_nt * p_n + k_t * p_t);
    let lost_j = -(p_n * (u_n + 0.5 * du_n) + p_t * (u_t + 0.5 * du_t));
    (p_n > 0.0 && lost_j >= 0.0).then_some(Blow {
        impulse_n_s: impulse,
        delta_v_m_s: [of_first.0, of_second.0],
        delta_turning_rad_s: [of_first.1, of_second.1],
        lost_j,
        slides,
    })
}

impl Impact {
    /// The pair, the vehicle of lower number first.
    pub(crate) fn pair(&self) -> (usize, Partner) {
        match self.between {
            (car, Partner::Car(other)) if other < car => (other, Partner::Car(car)),
            pair => pair,
        }
    }
}

/// An impact under way: an impulse spread over a time as a haversine.
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
    /// The impulse of an impact that begins now; nothing where the bodies part.
    pub fn of(setup: &Setup, impact: &Impact, time_s: f64, stack: &Stack, poses: &[Pose]) -> Self {
        let (car, partner) = impact.pair();
        let body = match partner {
            Partner::Car(other) => other,
            Partner::Barrier(barrier) => setup.vehicles.len() + barrier,
        };
        let place_m = impact.at_m.unwrap_or_else(|| setup.first_touch_m(car, body, poses));
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
        let impulse = found.map_or([0.0; 2], |blow| blow.impulse_n_s);
        let turns = [cross(both[0].arm_m(place_m), impulse), -cross(both[1].arm_m(place_m), impulse)];
        Pulse {
            bodies: [car, body],
            partner,
            start_s: time_s,
            duration_s: impact.duration_s,
            impulse: V3::new(impulse[0], impulse[1], 0.0),
            turns,
        }
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

    /// Changes the velocities at once; the vehicles share the loss.
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
        self.0[crate::chassis::MOTION + 6] += energy_j;
    }
}
