//! Equations of motion: a rigid body that carries four wheels on slides.
//!
//! The accelerations a of the body's origin and α of its rotation follow from a symmetric system of six equations, from
//! which the wheels' travels along their slides are eliminated. Each wheel is a point mass m at p = c + û s; it
//! transmits all of its force across the slide to the body, and the spring force along it. The spin ϖ is absolute, so
//! the energy balance of an airborne, braked car closes.

use crate::car::{Axle, Car, CarError};
use crate::ground::Ground;
use crate::state::{MOTION, Outside, State, Work};
use crate::tyre::{Tyre, saturation, shear_n};
use crate::{GRAVITY_M_S2, V3, WHEELS};
use nalgebra::{Matrix3, Matrix6, Quaternion, Vector6};

/// Spin below which a wheel counts as stopped, rad/s.
const STANDING_RAD_S: f64 = 0.5;
/// Time constant with which slips decay off the ground, s.
const FADING_S: f64 = 0.05;
/// Slip at which a drive that spares the grip begins to let go, and the sliding speed to add near rest, m/s; at twice as
/// much it has let go. Tyres grip best at a slip of 0.1 to 0.2.
const SPARED_SLIP: f64 = 0.1;
const SPARED_M_S: f64 = 0.3;

/// Controls at a time, from driver and damage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Controls {
    /// Road-wheel angle of each wheel, rad; positive to the right.
    pub steer_rad: [f64; WHEELS],
    /// Brake torque, all wheels, N·m.
    pub brake_n_m: f64,
    /// Drive torque, all wheels, N·m.
    pub drive_n_m: f64,
    /// Whether the drive lets go of wheels that are off the ground or spin, as a driver or traction control does.
    pub spares_grip: bool,
}

/// A wheel at one evaluation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelReport {
    /// Normal force, N.
    pub load_n: f64,
    /// Shear force forward and right, N.
    pub shear_n: [f64; 2],
    /// Utilisation of friction; 1 is full sliding.
    pub saturation: f64,
    /// Sliding velocity of the contact forward and right, m/s.
    pub slide_m_s: [f64; 2],
    /// Contact point, vehicle-space, m.
    pub contact_m: V3,
    /// Available brake torque, N·m.
    pub brake_n_m: f64,
    /// Moment of the shear force about the axle, N·m.
    pub spun_n_m: f64,
    /// Spin relative to its carrier, rad/s.
    pub relative_spin_rad_s: f64,
    /// Energy in the tyre's radial spring, J.
    pub stored_j: f64,
}

/// Results of one evaluation besides the rates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    /// Wheels.
    pub wheels: [WheelReport; WHEELS],
    /// Specific force at the centre of gravity (acceleration minus gravity), body axes, m/s²: the accelerometer
    /// reading.
    pub felt_m_s2: V3,
    /// Angular acceleration, body axes, rad/s².
    pub turning_rad_s2: V3,
}

#[derive(Clone, Copy, Debug)]
struct Wheel {
    /// Centre at rest, body axes, m.
    centre_m: V3,
    /// Direction of jounce.
    slide: V3,
    /// Force of the suspension at rest, N.
    preload_n: f64,
    /// −1 on the left, 1 on the right.
    side: f64,
    axle: Axle,
}

/// A vehicle prepared for simulation.
#[derive(Clone, Debug)]
pub struct Chassis {
    mass_kg: f64,
    /// Body without its wheels.
    rest_kg: f64,
    /// Its first moment, kg·m.
    rest_moment: V3,
    /// Its inertia about the origin, kg·m².
    rest_inertia: Matrix3<f64>,
    wheels: [Wheel; WHEELS],
    tyre: Tyre,
    drag: f64,
    brake_share: [f64; WHEELS],
    drive_share: [f64; WHEELS],
    height_m: f64,
    static_loads_n: [f64; WHEELS],
}

fn skew(v: &V3) -> Matrix3<f64> {
    v.cross_matrix()
}

impl Chassis {
    /// Of a vehicle.
    ///
    /// # Errors
    /// What [`Car::check`] finds, and wheels that take all of its mass or inertia.
    pub fn new(car: &Car) -> Result<Self, CarError> {
        car.check()?;
        let tyre = car.tyre;
        let loads = car.wheel_loads_n();
        let wheel = |i: usize| {
            let axle = *car.axle(i);
            let side = if i.is_multiple_of(2) { -1.0 } else { 1.0 };
            let (half_m, load_n) = (0.5 * axle.track_m, loads[i]);
            let centre_m = V3::new(axle.ahead_m, side * half_m, car.height_m - (tyre.radius_m - tyre.depth_m(load_n)));
            // the contact moves at right angles to the line to the roll centre
            let slide = V3::new(axle.anti_pitch, side * axle.roll_centre_m / half_m, -1.0).normalize();
            let preload_n = -slide.z * (load_n - axle.wheel_kg * GRAVITY_M_S2);
            Wheel { centre_m, slide, preload_n, side, axle }
        };
        let wheels = [0, 1, 2, 3].map(wheel);
        let (mut rest_kg, mut rest_moment, mut rest_inertia) = (car.mass_kg, V3::zeros(), car.inertia_kg_m2);
        for Wheel { centre_m: c, axle, .. } in &wheels {
            rest_kg -= axle.wheel_kg;
            rest_moment -= c * axle.wheel_kg;
            rest_inertia -= (Matrix3::identity() * c.norm_squared() - c * c.transpose()) * axle.wheel_kg;
            rest_inertia[(1, 1)] -= axle.spin_kg_m2;
        }
        if !(rest_kg > 0.0 && rest_inertia.symmetric_eigenvalues().min() > 0.0) {
            return Err(CarError::Wheels);
        }
        Ok(Chassis {
            mass_kg: car.mass_kg,
            rest_kg,
            rest_moment,
            rest_inertia,
            wheels,
            tyre,
            drag: car.drag_n_s2_per_m2,
            brake_share: car.brake_share,
            drive_share: car.drive_share,
            height_m: car.height_m,
            static_loads_n: loads,
        })
    }

    /// Height of the centre of gravity over level ground at rest, m.
    pub fn height_m(&self) -> f64 {
        self.height_m
    }

    /// Depth of a tyre under its load at rest, m.
    pub(crate) fn rest_depth_m(&self, wheel: usize) -> f64 {
        self.tyre.depth_m(self.static_loads_n[wheel])
    }

    /// Spin of a wheel that rolls at a speed under its load at rest, rad/s.
    pub fn rolling_spin_rad_s(&self, wheel: usize, speed_m_s: f64) -> f64 {
        speed_m_s / (self.tyre.radius_m - self.rest_depth_m(wheel) / 3.0)
    }

    /// Position of a wheel's centre and direction of its axle to the right, body axes.
    pub(crate) fn wheel_at(&self, state: &State, i: usize, steer_rad: f64) -> (V3, V3) {
        let jounce_m = state.jounce_m()[i];
        let Wheel { centre_m, slide, .. } = self.wheels[i];
        (centre_m + slide * jounce_m, self.axle_direction(i, jounce_m, steer_rad))
    }

    /// The tyre of all wheels.
    pub(crate) fn tyre(&self) -> &Tyre {
        &self.tyre
    }

    /// Direction of a wheel's axle to the right, body axes.
    pub(crate) fn axle_direction(&self, i: usize, jounce_m: f64, steer_rad: f64) -> V3 {
        let Wheel { axle, side, .. } = &self.wheels[i];
        // toe-in turns the left wheel to the right
        let angle = steer_rad - side * axle.bump_steer_rad_per_m * jounce_m;
        let camber = side * axle.bump_camber_rad_per_m * jounce_m;
        let ((sine, cosine), (up, across)) = (libm::sincos(angle), libm::sincos(camber));
        V3::new(-sine, cosine * across, cosine * up)
    }

    /// Suspension force against jounce, N, its damping power, W, and the energy of spring and stops, J; half of the
    /// anti-roll bar counts for each wheel.
    fn suspension(&self, i: usize, jounce_m: f64, other_m: f64, rate_m_s: f64) -> [f64; 3] {
        let Wheel { axle, preload_n, .. } = &self.wheels[i];
        let damper = if rate_m_s > 0.0 { axle.jounce_n_s_per_m } else { axle.rebound_n_s_per_m } * rate_m_s;
        let twist_m = jounce_m - other_m;
        let into = (jounce_m - axle.jounce_stop_m).max(0.0);
        let out_of = (-jounce_m - axle.rebound_stop_m).max(0.0);
        // k_s d (1 + d/d₀), d₀ = 0.1 m
        let stop = |d: f64| axle.stop_n_per_m * d * (1.0 + 10.0 * d);
        let held = |d: f64| axle.stop_n_per_m * d * d * (0.5 + 10.0 * d / 3.0);
        let spring = preload_n + axle.rate_n_per_m * jounce_m + axle.anti_roll_n_per_m * twist_m;
        let stored = preload_n * jounce_m
            + 0.5 * axle.rate_n_per_m * jounce_m * jounce_m
            + 0.25 * axle.anti_roll_n_per_m * twist_m * twist_m
            + held(into)
            + held(out_of);
        [spring + stop(into) - stop(out_of) + damper, damper * rate_m_s, stored]
    }

    /// Rates of change of the state at these controls, where `held` wheels do not rotate relative to their carriers.
    pub fn rates(
        &self,
        state: &State,
        controls: &Controls,
        held: [bool; WHEELS],
        ground: &Ground,
        outside: &Outside,
        rates: &mut State,
    ) -> Report {
        let attitude = state.attitude().to_rotation_matrix();
        let to_body = attitude.inverse();
        let (velocity, turning) = (state.velocity_m_s(), state.rotation_rad_s());
        let velocity_b = to_body * velocity;
        let gravity_b = to_body * V3::new(0.0, 0.0, GRAVITY_M_S2);
        let (jounce, jounce_rate, spin) = (state.jounce_m(), state.jounce_rate_m_s(), state.spin_rad_s());
        let mut report = Report::default();
        let mut work = outside.powers;

        let air = velocity_b * (-self.drag * velocity_b.norm());
        work.air_j = -air.dot(&velocity_b);
        let (mut force, mut moment) = (air + outside.force_n, outside.moment_n_m);
        let mut inertia = self.rest_inertia;
        let mut mass = Matrix6::zeros();
        // per wheel: û·F − S, axle, centripetal acceleration, place
        let mut along = [(0.0, V3::zeros(), V3::zeros()); WHEELS];
        for i in 0..WHEELS {
            let Wheel { centre_m, slide: u, axle, .. } = self.wheels[i];
            let m = axle.wheel_kg;
            let place = centre_m + u * jounce[i];
            let [resists_n, damped_w, _] = self.suspension(i, jounce[i], jounce[i ^ 1], jounce_rate[i]);
            work.damping_j += damped_w;
            let axis = self.axle_direction(i, jounce[i], controls.steer_rad[i]);
            let carrier = Carrier {
                at_m: state.position_m() + attitude * place,
                axis,
                velocity: velocity_b + u * jounce_rate[i],
                turning,
                spin: spin[i],
                slips: state.slips(i),
                brake_n_m: controls.brake_n_m * self.brake_share[i],
                drive_n_m: controls.drive_n_m * self.drive_share[i],
                spares_grip: controls.spares_grip,
                spin_kg_m2: axle.spin_kg_m2,
                is_held: held[i],
            };
            let met = self.meet(&carrier, place, &attitude, ground, &mut work);
            report.wheels[i] = met.report;
            rates.0[25 + i] = met.slip_rates[0];
            rates.0[29 + i] = met.slip_rates[1];
            rates.0[13 + i] = jounce_rate[i];
            rates.0[21 + i] = met.spin_rate;

            let swings = turning.cross(&turning.cross(&place)) + turning.cross(&u) * (2.0 * jounce_rate[i]);
            let across = Matrix3::identity() - u * u.transpose();
            let held_by_body = across * (gravity_b - swings) * m;
            let pushed = met.force.dot(&u) - resists_n;
            force += held_by_body + met.force - u * pushed;
            moment += place.cross(&held_by_body) + met.arm_m.cross(&met.force) - place.cross(&u) * pushed + met.couple;
            // spinning wheels: τ = I_w ϖ̇ â − Ω×H, H = −I_w ϖ â; a held wheel is part of the body
            if held[i] {
                inertia += axis * axis.transpose() * axle.spin_kg_m2;
            } else {
                moment += axis * (axle.spin_kg_m2 * met.spin_rate) + turning.cross(&axis) * (axle.spin_kg_m2 * spin[i]);
            }
            let lever = skew(&place);
            let mut add = |row: usize, column: usize, block: Matrix3<f64>| {
                let mut view = mass.fixed_view_mut::<3, 3>(row, column);
                view += block;
            };
            add(0, 0, across * m);
            add(0, 3, -across * lever * m);
            add(3, 0, lever * across * m);
            add(3, 3, -lever * across * lever * m);
            along[i] = (pushed, u, swings);
        }
        let sigma = self.rest_moment;
        force += gravity_b * self.rest_kg - turning.cross(&turning.cross(&sigma));
        moment += sigma.cross(&gravity_b) - turning.cross(&(inertia * turning));
        let mut add = |row: usize, column: usize, block: Matrix3<f64>| {
            let mut view = mass.fixed_view_mut::<3, 3>(row, column);
            view += block;
        };
        add(0, 0, Matrix3::identity() * self.rest_kg);
        add(0, 3, -skew(&sigma));
        add(3, 0, skew(&sigma));
        add(3, 3, inertia);
        let right = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        // positive definite for every car that `check` lets through
        let solved = mass.cholesky().map_or_else(|| Vector6::repeat(f64::NAN), |factors| factors.solve(&right));
        let (acceleration, turning_rate) =
            (V3::new(solved[0], solved[1], solved[2]), V3::new(solved[3], solved[4], solved[5]));
        for i in 0..WHEELS {
            let Wheel { centre_m, axle, .. } = self.wheels[i];
            let (pushed, u, swings) = along[i];
            let place = centre_m + u * jounce[i];
            let carried = acceleration - gravity_b + turning_rate.cross(&place) + swings;
            rates.0[17 + i] = pushed / axle.wheel_kg - u.dot(&carried);
            if held[i] {
                rates.0[21 + i] = -turning_rate.dot(&self.axle_direction(i, jounce[i], controls.steer_rad[i]));
            }
        }
        self.write(state, rates, attitude * acceleration, turning_rate, &work);
        report.felt_m_s2 = acceleration - gravity_b;
        report.turning_rad_s2 = turning_rate;
        report
    }

    fn write(&self, state: &State, rates: &mut State, acceleration: V3, turning_rate: V3, work: &Work) {
        let (velocity, turning) = (state.velocity_m_s(), state.rotation_rad_s());
        rates.put(0, velocity);
        let q = Quaternion::new(state.0[3], state.0[4], state.0[5], state.0[6]);
        let half = q * Quaternion::from_imag(turning) * 0.5;
        rates.0[3] = half.w;
        rates.put(4, half.imag());
        rates.put(7, acceleration);
        rates.put(10, turning_rate);
        rates.0[MOTION..].copy_from_slice(&work.sums());
    }

    /// Contact of a wheel with the ground, with its brake and drive torque; powers are added to `work`.
    fn meet(
        &self,
        of: &Carrier,
        place: V3,
        attitude: &nalgebra::Rotation3<f64>,
        ground: &Ground,
        work: &mut Work,
    ) -> Met {
        let (tyre, spin_inertia) = (&self.tyre, of.spin_kg_m2);
        let relative = of.spin + of.turning.dot(&of.axis);
        let standing = relative / (relative * relative + STANDING_RAD_S * STANDING_RAD_S).sqrt();
        let footprint = ground.footprint(of.at_m, attitude * of.axis, tyre.radius_m, tyre.crown_m);
        let Some(at) = footprint else {
            let brake = of.brake_n_m * standing;
            let braked = if of.is_held { 0.0 } else { brake * relative };
            work.braking_j += braked;
            let drive_n_m = if of.spares_grip { 0.0 } else { of.drive_n_m };
            let driven = if of.is_held { 0.0 } else { drive_n_m * relative };
            work.driving_j += driven;
            return Met {
                force: V3::zeros(),
                couple: V3::zeros(),
                arm_m: place,
                spin_rate: (drive_n_m - brake) / spin_inertia,
                slip_rates: of.slips.map(|slip| -slip / FADING_S),
                report: WheelReport {
                    brake_n_m: of.brake_n_m,
                    relative_spin_rad_s: relative,
                    contact_m: of.at_m,
                    ..WheelReport::default()
                },
            };
        };
        let to_body = attitude.inverse();
        let normal = to_body * at.normal;
        let arm_m = place + to_body * (at.point_m - of.at_m);
        let velocity = of.velocity + of.turning.cross(&arm_m);
        let closing = -normal.dot(&velocity);
        let elastic = tyre.radial_n(at.depth_m) * at.share;
        let load = (elastic + tyre.damping_n_s_per_m * closing).max(0.0);
        work.damping_j += (load - elastic) * closing;
        let stored_j = tyre.radial_j(at.depth_m);

        let ahead = normal.cross(&of.axis).normalize();
        let right = ahead.cross(&normal);
        let lever = tyre.radius_m - at.depth_m / 3.0;
        let rolls = relative * lever;
        let slide = [ahead.dot(&velocity) - rolls, right.dot(&velocity)];
        let slides = (slide[0] * slide[0] + slide[1] * slide[1]).sqrt();
        let zone = ground.zone(at.point_m.x, at.point_m.y);
        let sideways = if slides > 1e-9 { slide[1] * slide[1] / (slides * slides) } else { 0.0 };
        let surface = zone.map_or(1.0, |zone| zone.friction * (1.0 + (zone.lateral - 1.0) * sideways));
        let most = tyre.friction_at(slides, load, surface) * load;
        let stiffness = tyre.stiffnesses_n(load);
        let slips = self.law_slips(of.slips, slide, rolls, stiffness, load, at.lean);
        let shear = shear_n(slips, stiffness, most);
        work.sliding_j -= shear[0] * slide[0] + shear[1] * slide[1];

        let resistance = zone.and_then(|zone| zone.rolling).unwrap_or(tyre.rolling);
        let low_m = tyre.radius_m - at.depth_m;
        let rolling = resistance * load * low_m * standing;
        // more than twice what the ground can turn acts like a lock; the bound keeps the step long
        let brake_n_m = of.brake_n_m.min(2.0 * most * low_m + 50.0);
        let brake = brake_n_m * standing;
        let spared_m_s = SPARED_M_S + SPARED_SLIP * (slide[0] + rolls).abs();
        let kept = if of.spares_grip { (2.0 + slide[0] / spared_m_s).clamp(0.0, 1.0) } else { 1.0 };
        let drive_n_m = of.drive_n_m * kept;
        if !of.is_held {
            work.braking_j += brake * relative;
            work.rolling_j += rolling * relative;
            work.driving_j += drive_n_m * relative;
        }
        let spun_n_m = shear[0] * lever;
        Met {
            force: ahead * shear[0] + right * shear[1] + normal * load,
            couple: to_body * at.couple_m * (elastic / at.share.max(1e-9)),
            arm_m,
            spin_rate: (drive_n_m - brake - spun_n_m - rolling) / spin_inertia,
            slip_rates: tyre.slip_rates(of.slips, slide, rolls),
            report: WheelReport {
                load_n: load,
                shear_n: shear,
                saturation: saturation(slips, stiffness, most),
                slide_m_s: slide,
                contact_m: at.point_m,
                brake_n_m,
                spun_n_m,
                relative_spin_rad_s: relative,
                stored_j,
            },
        }
    }

    /// Slips of the tyre law: those of the tread, with damping at low speed and camber thrust.
    fn law_slips(
        &self,
        slips: [f64; 2],
        slide: [f64; 2],
        rolls_m_s: f64,
        stiffness_n: [f64; 2],
        load_n: f64,
        lean: f64,
    ) -> [f64; 2] {
        let tyre = &self.tyre;
        let [x, y] = Tyre::steady_slips(slips);
        let slow = tyre.slow_damping_n_s_per_m / (1.0 + 0.25 * rolls_m_s * rolls_m_s);
        let [c_x, c_y] = stiffness_n.map(|c| c.max(1e-3));
        [x - slow * slide[0] / c_x, y - slow * slide[1] / c_y - tyre.camber_per_rad * load_n * lean / c_y]
    }

    /// Kinetic energy, J.
    pub fn kinetic_j(&self, state: &State) -> f64 {
        let velocity = state.attitude().inverse() * state.velocity_m_s();
        let turning = state.rotation_rad_s();
        let mut sum = 0.5 * self.rest_kg * velocity.norm_squared()
            + velocity.dot(&turning.cross(&self.rest_moment))
            + 0.5 * turning.dot(&(self.rest_inertia * turning));
        for (i, wheel) in self.wheels.iter().enumerate() {
            let place = wheel.centre_m + wheel.slide * state.jounce_m()[i];
            let of_wheel = velocity + turning.cross(&place) + wheel.slide * state.jounce_rate_m_s()[i];
            let spin = state.spin_rad_s()[i];
            sum += 0.5 * wheel.axle.wheel_kg * of_wheel.norm_squared() + 0.5 * wheel.axle.spin_kg_m2 * spin * spin;
        }
        sum
    }

    /// Energy in gravity, springs and the radial springs of the tyres, J; the latter as the evaluation `report` found them.
    pub fn stored_j(&self, state: &State, report: &Report) -> f64 {
        let down = |v: V3| (state.attitude() * v).z;
        let mut sum = -GRAVITY_M_S2 * (self.mass_kg * state.position_m().z + down(self.rest_moment));
        let jounce = state.jounce_m();
        for (i, wheel) in self.wheels.iter().enumerate() {
            let place = wheel.centre_m + wheel.slide * jounce[i];
            sum -= GRAVITY_M_S2 * wheel.axle.wheel_kg * down(place);
            sum += self.suspension(i, jounce[i], jounce[i ^ 1], 0.0)[2] + report.wheels[i].stored_j;
        }
        sum
    }

    /// Linear momentum in vehicle-space, N·s, and angular momentum about the space origin, N·m·s.
    pub fn momenta(&self, state: &State, controls: &Controls) -> [V3; 2] {
        let attitude = state.attitude();
        let velocity = attitude.inverse() * state.velocity_m_s();
        let turning = state.rotation_rad_s();
        let mut linear = velocity * self.rest_kg + turning.cross(&self.rest_moment);
        let mut angular = self.rest_moment.cross(&velocity) + self.rest_inertia * turning;
        for (i, wheel) in self.wheels.iter().enumerate() {
            let place = wheel.centre_m + wheel.slide * state.jounce_m()[i];
            let of_wheel = velocity + turning.cross(&place) + wheel.slide * state.jounce_rate_m_s()[i];
            let axis = self.axle_direction(i, state.jounce_m()[i], controls.steer_rad[i]);
            linear += of_wheel * wheel.axle.wheel_kg;
            angular +=
                place.cross(&of_wheel) * wheel.axle.wheel_kg - axis * (wheel.axle.spin_kg_m2 * state.spin_rad_s()[i]);
        }
        let linear = attitude * linear;
        [linear, attitude * angular + state.position_m().cross(&linear)]
    }
}

/// A wheel's carrier and its torques, body axes.
struct Carrier {
    /// Wheel centre, vehicle-space, m.
    at_m: V3,
    axis: V3,
    /// Velocity of the carrier at the body's origin, including jounce.
    velocity: V3,
    turning: V3,
    spin: f64,
    slips: [f64; 2],
    brake_n_m: f64,
    drive_n_m: f64,
    spares_grip: bool,
    spin_kg_m2: f64,
    is_held: bool,
}

/// Force and moment on a wheel from ground, brake and drive, body axes.
struct Met {
    force: V3,
    couple: V3,
    arm_m: V3,
    spin_rate: f64,
    slip_rates: [f64; 2],
    report: WheelReport,
}
