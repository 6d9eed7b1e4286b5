//! A vehicle with its driver: its start, its commands, its locked wheels.

use crate::body::Body;
use crate::car::{Car, CarError};
use crate::chassis::{Chassis, Controls, Report};
use crate::driver::{Driver, LOOK_S, OnImpact, Steering, ackermann_rad};
use crate::ground::Ground;
use crate::ride::Start;
use crate::state::State;
use crate::{V3, WHEELS};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion};

/// Relative spin below which a braked wheel is held, rad/s.
const HELD_RAD_S: f64 = 0.5;
/// Largest ratio of ground torque to brake torque at which a wheel is held.
const HELD_SHARE: f64 = 0.8;

/// A vehicle ready to be driven.
#[derive(Clone, Debug)]
pub(crate) struct Vehicle {
    pub chassis: Chassis,
    pub driver: Driver,
    pub body: Body,
    pub mass_kg: f64,
    /// With riders: what the driver speeds up.
    all_kg: f64,
    pub yaw_kg_m2: f64,
    rear_m: f64,
    radius_m: f64,
    wheelbase_m: f64,
    track_m: f64,
    ackermann: f64,
    steered: [bool; WHEELS],
}

/// State stored between steps.
#[derive(Clone, Debug)]
pub(crate) struct Memory {
    pub held: [bool; WHEELS],
    /// Road-wheel angle at two times, s and rad.
    steer: [(f64, f64); 2],
    /// Angles demanded by the follower, newest last.
    wanted: Vec<(f64, f64)>,
    /// How far along its line the follower has come, m.
    along_m: Option<f64>,
    /// Time of the follower's next update, s.
    pub look_s: f64,
    /// Time of the first collision, s.
    pub hit_s: Option<f64>,
}

impl Memory {
    pub fn new() -> Self {
        Memory {
            held: [false; WHEELS],
            steer: [(0.0, 0.0); 2],
            wanted: Vec::new(),
            along_m: None,
            look_s: 0.0,
            hit_s: None,
        }
    }
}

impl Vehicle {
    pub fn new(car: &Car, driver: Driver) -> Result<Self, CarError> {
        Ok(Vehicle {
            chassis: Chassis::new(car)?,
            driver,
            body: car.body.clone(),
            mass_kg: car.mass_kg,
            all_kg: car.riders.map_or(car.mass_kg, |riders| car.mass_kg + riders.mass_kg),
            yaw_kg_m2: car.inertia_kg_m2[(2, 2)],
            rear_m: car.rear.ahead_m,
            radius_m: car.tyre.radius_m,
            wheelbase_m: car.wheelbase_m(),
            track_m: car.front.track_m,
            ackermann: car.ackermann,
            steered: [0, 1, 2, 3].map(|i| car.axle(i).is_steered),
        })
    }

    pub fn follows(&self) -> bool {
        matches!(self.driver.steering, Steering::Follow(_))
    }

    /// The controls at a time.
    pub fn controls(&self, time_s: f64, state: &State, memory: &Memory) -> Controls {
        // who was hit keeps the wheel where it was
        let steer_s = memory.hit_s.map_or(time_s, |hit_s| time_s.min(hit_s));
        let mut pedals = self.driver.pedals(time_s, memory.hit_s);
        let ahead_m_s = || (state.attitude().inverse() * state.velocity_m_s()).x;
        let wanted =
            self.driver.speed_m_s.as_ref().and_then(|_| self.driver.speeds_up_m_s2(time_s, ahead_m_s(), memory.hit_s));
        if let Some(wanted) = wanted {
            let torque_n_m = self.all_kg * wanted * self.radius_m;
            pedals = [(-torque_n_m).max(0.0), torque_n_m.max(0.0)];
        }
        let [(from_s, from), (to_s, to)] = memory.steer;
        let mean = match &self.driver.steering {
            Steering::Table(table) if self.driver.on_impact == OnImpact::Continue => table.at(time_s),
            Steering::Table(table) => table.at(steer_s),
            Steering::Follow(_) if to_s > from_s => {
                from + (to - from) * ((time_s - from_s) / (to_s - from_s)).clamp(0.0, 1.0)
            }
            Steering::Follow(_) => to,
        };
        let pair = ackermann_rad(mean, self.ackermann, self.track_m, self.wheelbase_m);
        let steer_rad = [0, 1, 2, 3].map(|i| if self.steered[i] { pair[i % 2] } else { 0.0 });
        Controls { steer_rad, brake_n_m: pedals[0], drive_n_m: pedals[1], spares_grip: wanted.is_some() }
    }

    /// Updates the follower, and applies the demand from one delay ago.
    pub fn look(&self, state: &State, time_s: f64, memory: &mut Memory) {
        let Steering::Follow(follower) = &self.driver.steering else { return };
        let [yaw, _, _] = state.yaw_pitch_roll_rad();
        let (place, velocity) = (state.position_m(), state.velocity_m_s());
        let wants = follower.wants_rad(&mut memory.along_m, place, yaw, velocity, self.rear_m, self.wheelbase_m);
        memory.wanted.push((time_s, wants));
        let seen_s = time_s - follower.delay_s;
        let behind = memory.wanted.iter().take_while(|(t, _)| *t <= seen_s + 1e-9).count();
        memory.wanted.drain(..behind.saturating_sub(1));
        let acts = memory.hit_s.is_none() || self.driver.on_impact == OnImpact::Continue;
        let is_due = memory.wanted[0].0 <= seen_s + 1e-9;
        let now = memory.steer[1].1;
        let goal = if is_due && time_s < follower.until_s && acts { memory.wanted[0].1 } else { now };
        let most = follower.rate_rad_s * LOOK_S;
        let next = now + (goal - now).clamp(-most, most);
        memory.look_s = time_s + LOOK_S;
        memory.steer = [(time_s, now), (memory.look_s, next)];
    }

    /// Locks and releases wheels; true if the rates jump.
    pub fn commit(&self, time_s: f64, state: &mut State, report: &Report, memory: &mut Memory) -> bool {
        let before = memory.held;
        for (i, wheel) in report.wheels.iter().enumerate() {
            let is_locked = self.driver.locked_from_s[i].is_some_and(|from_s| time_s >= from_s)
                || self.driver.locked_on_impact[i] && memory.hit_s.is_some();
            let on_ground = wheel.load_n > 0.0;
            memory.held[i] = if is_locked {
                true
            } else if memory.held[i] {
                wheel.spun_n_m.abs() <= wheel.brake_n_m && wheel.brake_n_m > 0.0
            } else {
                let is_slow = wheel.relative_spin_rad_s.abs() < HELD_RAD_S;
                on_ground && is_slow && wheel.brake_n_m > 0.0 && wheel.spun_n_m.abs() < HELD_SHARE * wheel.brake_n_m
            };
            if memory.held[i] && !before[i] {
                self.hold(state, time_s, i, memory);
            }
        }
        before != memory.held
    }

    pub fn hold_locked(&self, state: &mut State, time_s: f64, memory: &mut Memory) {
        for i in 0..WHEELS {
            if self.driver.locked_from_s[i].is_some_and(|from_s| time_s >= from_s) {
                memory.held[i] = true;
                self.hold(state, time_s, i, memory);
            }
        }
    }

    /// Stops a wheel relative to its carrier. Its remaining spin energy goes into the brake.
    fn hold(&self, state: &mut State, time_s: f64, wheel: usize, memory: &Memory) {
        let steer = self.controls(time_s, state, memory).steer_rad[wheel];
        let axis = self.chassis.axle_direction(wheel, state.jounce_m()[wheel], steer);
        let before_j = self.chassis.kinetic_j(state);
        state.set_spin(wheel, -state.rotation_rad_s().dot(&axis));
        state.0[33 + 2] += before_j - self.chassis.kinetic_j(state);
    }
}

impl Chassis {
    /// A wheel that is too deep in the ground to start there: its number, its depth, and the largest allowed, m.
    pub(crate) fn buried(&self, state: &State, ground: &Ground) -> Option<(usize, f64, f64)> {
        let (place_m, attitude) = (state.position_m(), state.attitude());
        (0..WHEELS).find_map(|i| {
            let (centre_m, axle) = self.wheel_at(state, i, 0.0);
            let centre_m = place_m + attitude * centre_m;
            let footprint = ground.footprint(centre_m, attitude * axle, self.tyre().radius_m, self.tyre().crown_m);
            // a disc that lies all within the ground has no footprint
            let under_m = ground.height_m(centre_m.x, centre_m.y) + centre_m.z;
            let within_m = if under_m > 0.0 { self.tyre().radius_m + under_m } else { 0.0 };
            let depth_m = footprint.map_or(0.0, |at| at.depth_m).max(within_m);
            let most_m = self.tyre().rim_depth_m.max(2.0 * self.rest_depth_m(i));
            (depth_m > most_m).then_some((i, depth_m, most_m))
        })
    }

    /// State at the start: on the ground, wheels rolling unless they stand.
    pub fn state_at(&self, start: &Start, ground: &Ground) -> State {
        let normal = ground.normal(start.x_m, start.y_m);
        // heading along the ground, z against its normal
        let (sine, cosine) = libm::sincos(start.yaw_rad);
        let heading = V3::new(cosine, sine, 0.0);
        let ahead = (heading - normal * normal.dot(&heading)).normalize();
        let down = -normal;
        let right = down.cross(&ahead);
        let axes = Matrix3::from_columns(&[ahead, right, down]);
        let attitude = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let mut state = State::zero();
        let under = V3::new(start.x_m, start.y_m, -ground.height_m(start.x_m, start.y_m));
        // the centre of gravity stands over the ground by its height along the normal, above the place asked for
        let rise = self.height_m() / -normal.z;
        state.put(0, under - V3::z() * rise);
        state.0[3] = attitude.w;
        state.put(4, attitude.imag());
        let (side, along) = libm::sincos(start.sideslip_rad);
        state.put(7, (ahead * along + right * side) * start.speed_m_s);
        state.put(10, V3::new(0.0, 0.0, start.yaw_rate_rad_s));
        for i in 0..WHEELS {
            let rolling = self.rolling_spin_rad_s(i, start.speed_m_s * along);
            let standing = -state.rotation_rad_s().dot(&self.axle_direction(i, 0.0, 0.0));
            state.set_spin(i, if start.wheels_stand { standing } else { rolling });
        }
        state
    }
}
