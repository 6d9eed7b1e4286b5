//! A drive from its start to its end.

use crate::car::{Car, CarError};
use crate::chassis::{Chassis, Controls, Report, State, WheelReport, Work};
use crate::driver::{Driver, LOOK_S, Steering, ackermann_rad};
use crate::ground::Ground;
use crate::integrate::{Tolerance, attempt, next_step};
use crate::{V3, WHEELS};
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion};

/// Shortest step, s: what needs shorter ones has no solution here.
const SHORTEST_S: f64 = 1e-9;
/// Spin against its carrier below which a braked wheel is held, rad/s.
const HELD_RAD_S: f64 = 0.5;
/// A wheel is held when the ground turns it with less than this share of its brake.
const HELD_SHARE: f64 = 0.8;

/// Where a vehicle starts, as it stands on the ground there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// Place of the centre of gravity in plan, m.
    pub x_m: f64,
    /// To the right, m.
    pub y_m: f64,
    /// Heading, clockwise from above, rad.
    pub yaw_rad: f64,
    /// Speed along the ground, m/s.
    pub speed_m_s: f64,
    /// Direction of the velocity to the right of the heading, rad.
    pub sideslip_rad: f64,
    /// Yaw rate, rad/s.
    pub yaw_rate_rad_s: f64,
    /// Whether the wheels start locked rather than rolling.
    pub wheels_stand: bool,
}

/// A vehicle, its driver and the ground.
#[derive(Clone, Debug)]
pub struct Drive {
    chassis: Chassis,
    ground: Ground,
    driver: Driver,
    /// What the error of a step is measured against.
    pub tolerance: Tolerance,
    rear_m: f64,
    wheelbase_m: f64,
    track_m: f64,
    ackermann: f64,
    steered: [bool; WHEELS],
}

/// The motion at an accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Station {
    /// Time, s.
    pub time_s: f64,
    /// Place of the centre of gravity, vehicle-space, m.
    pub position_m: V3,
    /// Its velocity, vehicle-space, m/s.
    pub velocity_m_s: V3,
    /// Its acceleration, vehicle-space, m/s².
    pub acceleration_m_s2: V3,
    /// Attitude, body axes to vehicle-space.
    pub attitude: UnitQuaternion<f64>,
    /// Angular velocity, body axes, rad/s.
    pub rotation_rad_s: V3,
    /// Angular acceleration, body axes, rad/s².
    pub turning_rad_s2: V3,
    /// What accelerometers at the centre of gravity read, body axes, m/s².
    pub felt_m_s2: V3,
    /// Mean angle of the front wheels, rad.
    pub steer_rad: f64,
    /// Wheels.
    pub wheels: [WheelReport; WHEELS],
    /// State of which all this follows.
    pub state: State,
}

/// A drive that was computed.
#[derive(Clone, Debug)]
pub struct Ride {
    stations: Vec<Station>,
    /// Evaluations of the rates.
    pub evaluations: u64,
    /// Steps that were tried and rejected.
    pub rejected: u64,
    energy_start_j: f64,
    energy_end_j: f64,
    greatest_kinetic_j: f64,
}

/// Why a drive could not be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DriveError {
    /// The start is no place or speed.
    #[error("the start of the drive must be finite numbers, and its end a time above 0")]
    Start,
    /// Steps became too short.
    #[error("at {time_s} s the step fell below {step_s} s: stiff parts or inputs beyond reason")]
    Step {
        /// When, s.
        time_s: f64,
        /// The step, s.
        step_s: f64,
    },
}

/// What is remembered between steps.
struct Memory {
    held: [bool; WHEELS],
    /// Road-wheel angle at two times, s and rad.
    steer: [(f64, f64); 2],
    /// Angles that the follower wanted, newest last.
    wanted: Vec<(f64, f64)>,
    /// When the follower looks next, s.
    look_s: f64,
}

impl Drive {
    /// Of a vehicle.
    ///
    /// # Errors
    /// What is wrong with the vehicle.
    pub fn new(car: &Car, ground: Ground, driver: Driver) -> Result<Self, CarError> {
        Ok(Drive {
            chassis: Chassis::new(car)?,
            ground,
            driver,
            tolerance: Tolerance::default(),
            rear_m: car.rear.ahead_m,
            wheelbase_m: car.wheelbase_m(),
            track_m: car.front.track_m,
            ackermann: car.ackermann,
            steered: [0, 1, 2, 3].map(|i| car.axle(i).is_steered),
        })
    }

    /// The equations of motion.
    pub fn chassis(&self) -> &Chassis {
        &self.chassis
    }

    /// State at the start: on the ground, wheels rolling unless they stand.
    pub fn state_at(&self, start: &Start) -> State {
        let normal = self.ground.normal(start.y_m);
        // heading along the ground, z against its normal
        let (sine, cosine) = libm::sincos(start.yaw_rad);
        let heading = V3::new(cosine, sine, 0.0);
        let ahead = (heading - normal * normal.dot(&heading)).normalize();
        let down = -normal;
        let right = down.cross(&ahead);
        let axes = Matrix3::from_columns(&[ahead, right, down]);
        let attitude = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let mut state = State::zero();
        let under = V3::new(start.x_m, start.y_m, -self.ground.height_m(start.x_m, start.y_m));
        // the centre of gravity stands over the ground by its height along the normal, above the place asked for
        let rise = self.chassis.height_m() / -normal.z;
        state.put(0, under - V3::z() * rise);
        state.0[3] = attitude.w;
        state.put(4, attitude.imag());
        let (side, along) = libm::sincos(start.sideslip_rad);
        state.put(7, (ahead * along + right * side) * start.speed_m_s);
        state.put(10, V3::new(0.0, 0.0, start.yaw_rate_rad_s));
        for i in 0..WHEELS {
            let rolling = self.chassis.rolling_spin_rad_s(i, start.speed_m_s * along);
            let standing = -state.rotation_rad_s().dot(&self.chassis.axle_direction(i, 0.0, 0.0));
            state.set_spin(i, if start.wheels_stand { standing } else { rolling });
        }
        state
    }

    /// The controls at a time.
    fn controls(&self, time_s: f64, memory: &Memory) -> Controls {
        let [(from_s, from), (to_s, to)] = memory.steer;
        let mean = match &self.driver.steering {
            Steering::Table(table) => table.at(time_s),
            Steering::Follow(_) if to_s > from_s => {
                from + (to - from) * ((time_s - from_s) / (to_s - from_s)).clamp(0.0, 1.0)
            }
            Steering::Follow(_) => to,
        };
        let pair = ackermann_rad(mean, self.ackermann, self.track_m, self.wheelbase_m);
        let steer = [0, 1, 2, 3].map(|i| if self.steered[i] { pair[i % 2] } else { 0.0 });
        Controls {
            steer_rad: steer,
            brake_n_m: self.driver.brake_n_m.at(time_s),
            drive_n_m: self.driver.drive_n_m.at(time_s),
        }
    }

    /// Drives from a start for `end_s` s.
    ///
    /// # Errors
    /// A start that is not finite; steps that become too short.
    pub fn run(&self, start: &Start, end_s: f64) -> Result<Ride, DriveError> {
        self.run_from(self.state_at(start), end_s)
    }

    /// Drives from a state for `end_s` s.
    ///
    /// # Errors
    /// A state that is not finite; steps that become too short.
    pub fn run_from(&self, start: State, end_s: f64) -> Result<Ride, DriveError> {
        if !(end_s > 0.0 && end_s.is_finite() && start.0.iter().all(|x| x.is_finite())) {
            return Err(DriveError::Start);
        }
        let mut corners_s = self.driver.corners_s();
        corners_s.retain(|t| *t > 0.0 && *t < end_s);
        corners_s.push(end_s);
        let mut memory = Memory { held: [false; WHEELS], steer: [(0.0, 0.0); 2], wanted: Vec::new(), look_s: 0.0 };
        let (mut state, mut time_s, mut wanted_s, mut before) = (start, 0.0, 1e-4, 1.0);
        self.look(&state, 0.0, &mut memory);
        self.hold_locked(&mut state, 0.0, &mut memory);
        let (mut rate, report) = self.evaluate(time_s, &state, &memory);
        let mut ride =
            Ride::begin(self.station(time_s, &state, &rate, &report, &memory), self.energy_j(&state, &report));
        ride.greatest_kinetic_j = self.chassis.kinetic_j(&state);
        let mut next_corner = 0;
        while time_s < end_s {
            let stop_s = corners_s[next_corner].min(if self.follows() { memory.look_s } else { f64::INFINITY });
            let h = self.step(time_s, stop_s, wanted_s);
            let mut report = Report::default();
            let trial = attempt(&state, &rate, h, &self.tolerance, |share, at| {
                let (rate, found) = self.evaluate(time_s + share * h, at, &memory);
                // the last is that of the end
                report = found;
                rate
            });
            ride.evaluations += 3;
            if trial.error > 1.0 {
                ride.rejected += 1;
                wanted_s = next_step(h, trial.error, before, false);
                if wanted_s < SHORTEST_S {
                    return Err(DriveError::Step { time_s, step_s: wanted_s });
                }
                continue;
            }
            let is_full = h >= 0.99 * wanted_s;
            let grown_s = next_step(h, trial.error, before, true);
            wanted_s = if is_full { grown_s } else { wanted_s.max(grown_s) };
            before = trial.error;
            time_s = if h >= stop_s - time_s { stop_s } else { time_s + h };
            (state, rate) = (trial.state, trial.rate);
            if time_s >= corners_s[next_corner] && next_corner + 1 < corners_s.len() {
                next_corner += 1;
            }
            let looks = self.follows() && time_s >= memory.look_s;
            if looks {
                self.look(&state, time_s, &mut memory);
            }
            let turned = self.commit(time_s, &mut state, &report, &mut memory) || looks || time_s >= stop_s;
            if turned {
                (rate, report) = self.evaluate(time_s, &state, &memory);
                ride.evaluations += 1;
            }
            ride.greatest_kinetic_j = ride.greatest_kinetic_j.max(self.chassis.kinetic_j(&state));
            ride.energy_end_j = self.energy_j(&state, &report);
            ride.stations.push(self.station(time_s, &state, &rate, &report, &memory));
        }
        Ok(ride)
    }

    fn follows(&self) -> bool {
        matches!(self.driver.steering, Steering::Follow(_))
    }

    fn step(&self, time_s: f64, stop_s: f64, wanted_s: f64) -> f64 {
        let left_s = stop_s - time_s;
        let h = wanted_s.min(self.tolerance.longest_s);
        // no crumb is left before a stop
        if h >= left_s * 0.999 { left_s } else { h.min(if h > 0.5 * left_s { 0.5 * left_s } else { h }) }
    }

    fn evaluate(&self, time_s: f64, state: &State, memory: &Memory) -> (State, Report) {
        let mut rate = State([0.0; crate::chassis::NUMBERS]);
        let report = self.chassis.rates(state, &self.controls(time_s, memory), memory.held, &self.ground, &mut rate);
        (rate, report)
    }

    /// The follower looks, and turns the wheel by what he wanted a delay ago.
    fn look(&self, state: &State, time_s: f64, memory: &mut Memory) {
        let Steering::Follow(follower) = &self.driver.steering else { return };
        let [yaw, _, _] = state.yaw_pitch_roll_rad();
        let velocity = state.velocity_m_s();
        let speed = velocity.x.hypot(velocity.y);
        let wants = follower.wants_rad(state.position_m(), yaw, speed, self.rear_m, self.wheelbase_m);
        memory.wanted.push((time_s, wants));
        let seen_s = time_s - follower.delay_s;
        let behind = memory.wanted.iter().take_while(|(t, _)| *t <= seen_s + 1e-9).count();
        memory.wanted.drain(..behind.saturating_sub(1));
        let is_due = memory.wanted[0].0 <= seen_s + 1e-9;
        let now = memory.steer[1].1;
        let goal = if is_due && time_s < follower.until_s { memory.wanted[0].1 } else { now };
        let most = follower.rate_rad_s * LOOK_S;
        let next = now + (goal - now).clamp(-most, most);
        memory.look_s = time_s + LOOK_S;
        memory.steer = [(time_s, now), (memory.look_s, next)];
    }

    /// Catches and frees wheels; true if the rates jump.
    fn commit(&self, time_s: f64, state: &mut State, report: &Report, memory: &mut Memory) -> bool {
        let before = memory.held;
        for (i, wheel) in report.wheels.iter().enumerate() {
            let is_locked = self.driver.locked_from_s[i].is_some_and(|from_s| time_s >= from_s);
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

    fn hold_locked(&self, state: &mut State, time_s: f64, memory: &mut Memory) {
        for i in 0..WHEELS {
            if self.driver.locked_from_s[i].is_some_and(|from_s| time_s >= from_s) {
                memory.held[i] = true;
                self.hold(state, time_s, i, memory);
            }
        }
    }

    /// Stops a wheel against its carrier. What is left of its spin goes into the brake.
    fn hold(&self, state: &mut State, time_s: f64, wheel: usize, memory: &Memory) {
        let steer = self.controls(time_s, memory).steer_rad[wheel];
        let axis = self.chassis.axle_direction(wheel, state.jounce_m()[wheel], steer);
        let before_j = self.chassis.kinetic_j(state);
        state.set_spin(wheel, -state.rotation_rad_s().dot(&axis));
        state.0[33 + 2] += before_j - self.chassis.kinetic_j(state);
    }

    /// Energy with all that was lost since the start less what was put in, J.
    fn energy_j(&self, state: &State, report: &Report) -> f64 {
        let Work { sliding_j, damping_j, braking_j, rolling_j, air_j, driving_j } = state.work();
        let lost = sliding_j + damping_j + braking_j + rolling_j + air_j - driving_j;
        self.chassis.kinetic_j(state) + self.chassis.stored_j(state, report) + lost
    }

    fn station(&self, time_s: f64, state: &State, rate: &State, report: &Report, memory: &Memory) -> Station {
        let acceleration_m_s2 = V3::new(rate.0[7], rate.0[8], rate.0[9]);
        let steer = self.controls(time_s, memory).steer_rad;
        Station {
            time_s,
            position_m: state.position_m(),
            velocity_m_s: state.velocity_m_s(),
            acceleration_m_s2,
            attitude: state.attitude(),
            rotation_rad_s: state.rotation_rad_s(),
            turning_rad_s2: report.turning_rad_s2,
            felt_m_s2: report.felt_m_s2,
            steer_rad: 0.5 * (steer[0] + steer[1]),
            wheels: report.wheels,
            state: *state,
        }
    }
}

impl Ride {
    fn begin(first: Station, energy_j: f64) -> Self {
        Ride {
            stations: vec![first],
            evaluations: 1,
            rejected: 0,
            energy_start_j: energy_j,
            energy_end_j: energy_j,
            greatest_kinetic_j: 0.0,
        }
    }

    /// The motion at all accepted steps; never empty.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// The motion at the end.
    pub fn last(&self) -> &Station {
        &self.stations[self.stations.len() - 1]
    }

    /// Error of the energy balance over the greatest kinetic energy.
    pub fn balance(&self) -> f64 {
        (self.energy_end_j - self.energy_start_j) / self.greatest_kinetic_j.max(1e-9)
    }

    /// Place and attitude at a time within the drive, between the stations by cubics in place and by the shortest turn.
    pub fn at(&self, time_s: f64) -> (V3, UnitQuaternion<f64>) {
        let next =
            self.stations.partition_point(|station| station.time_s < time_s).clamp(1, self.stations.len().max(2) - 1);
        let [from, to] = [&self.stations[next - 1], &self.stations[next.min(self.stations.len() - 1)]];
        let h = to.time_s - from.time_s;
        let s = if h > 0.0 { ((time_s - from.time_s) / h).clamp(0.0, 1.0) } else { 0.0 };
        let (a, b) = (s * s * (3.0 - 2.0 * s), s * (1.0 - s));
        let place = from.position_m * (1.0 - a)
            + to.position_m * a
            + (from.velocity_m_s * (1.0 - s) - to.velocity_m_s * s) * (b * h);
        (place, turned(&from.attitude, &to.attitude, s))
    }
}

/// From one attitude to another by a share of the shortest turn.
fn turned(from: &UnitQuaternion<f64>, to: &UnitQuaternion<f64>, share: f64) -> UnitQuaternion<f64> {
    let (a, b) = (from.quaternion(), to.quaternion());
    let b = if a.dot(b) < 0.0 { -b } else { *b };
    let half = libm::acos(a.dot(&b).min(1.0));
    let weights: [f64; 2] = if half < 1e-8 {
        [1.0 - share, share]
    } else {
        [(1.0 - share) * half, share * half].map(|x| libm::sin(x) / libm::sin(half))
    };
    let mixed: Quaternion<f64> = a * weights[0] + b * weights[1];
    UnitQuaternion::new_normalize(mixed)
}
