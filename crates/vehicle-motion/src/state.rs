//! The state of a vehicle: its numbers, how they are read, and the work that they sum up.

use nalgebra::{Quaternion, UnitQuaternion};

use crate::{V3, WHEELS};

/// Size of the state: position 3, attitude 4, velocity 3, rotation 3, and for each wheel jounce, its rate, spin and two
/// slips; then the sums of work.
pub const NUMBERS: usize = MOTION + SUMS;
/// Numbers of the state without its sums of work.
pub const MOTION: usize = 33;
/// Sums of work at the end of the state, in the order of [`Work`].
pub const SUMS: usize = 10;

/// The state of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State(pub [f64; NUMBERS]);

/// Work dissipated or supplied since the start, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// Sliding of the tyres, including energy stored in slips.
    pub sliding_j: f64,
    /// Dampers of suspension and tyres.
    pub damping_j: f64,
    /// Brakes.
    pub braking_j: f64,
    /// Rolling resistance.
    pub rolling_j: f64,
    /// Air.
    pub air_j: f64,
    /// Drive torque (supplied).
    pub driving_j: f64,
    /// Absorbed by crush, including stored energy.
    pub crush_j: f64,
    /// This vehicle's half of friction losses along others.
    pub rubbing_j: f64,
    /// Hull and rims on the ground, including stored energy.
    pub hull_j: f64,
    /// Supplied by occupants and other external loads.
    pub pushed_j: f64,
}

impl Work {
    pub(crate) fn of(sums: &[f64]) -> Self {
        Work {
            sliding_j: sums[0],
            damping_j: sums[1],
            braking_j: sums[2],
            rolling_j: sums[3],
            air_j: sums[4],
            driving_j: sums[5],
            crush_j: sums[6],
            rubbing_j: sums[7],
            hull_j: sums[8],
            pushed_j: sums[9],
        }
    }

    pub(crate) fn sums(&self) -> [f64; SUMS] {
        [
            self.sliding_j,
            self.damping_j,
            self.braking_j,
            self.rolling_j,
            self.air_j,
            self.driving_j,
            self.crush_j,
            self.rubbing_j,
            self.hull_j,
            self.pushed_j,
        ]
    }

    /// Total dissipated or stored in contacts minus supplied, J.
    pub fn spent_j(&self) -> f64 {
        let out = self.sliding_j + self.damping_j + self.braking_j + self.rolling_j + self.air_j;
        out + self.crush_j + self.rubbing_j + self.hull_j - self.driving_j - self.pushed_j
    }
}

/// Loads on the body besides wheels and air: force and moment about the centre of gravity, body axes, and powers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outside {
    /// N.
    pub force_n: V3,
    /// N·m.
    pub moment_n_m: V3,
    /// Powers, J/s in place of J; only crush, rubbing, hull and pushed count.
    pub powers: Work,
}

impl State {
    /// The same motion told of another point of the body: `shift_m` from the origin, body axes, m.
    #[must_use]
    pub fn seen_from(&self, shift_m: V3) -> Self {
        let (attitude, mut state) = (self.attitude(), *self);
        state.put(0, self.position_m() + attitude * shift_m);
        state.put(7, self.velocity_m_s() + attitude * self.rotation_rad_s().cross(&shift_m));
        state
    }

    /// All numbers 0, upright.
    pub fn zero() -> Self {
        let mut numbers = [0.0; NUMBERS];
        numbers[3] = 1.0;
        State(numbers)
    }

    pub(crate) fn vector(&self, at: usize) -> V3 {
        V3::new(self.0[at], self.0[at + 1], self.0[at + 2])
    }

    pub(crate) fn put(&mut self, at: usize, vector: V3) {
        self.0[at..at + 3].copy_from_slice(vector.as_slice());
    }

    /// Place of the centre of gravity, vehicle-space, m.
    pub fn position_m(&self) -> V3 {
        self.vector(0)
    }

    /// Attitude: body axes to vehicle-space.
    pub fn attitude(&self) -> UnitQuaternion<f64> {
        UnitQuaternion::new_normalize(Quaternion::new(self.0[3], self.0[4], self.0[5], self.0[6]))
    }

    /// Velocity of the centre of gravity, vehicle-space, m/s.
    pub fn velocity_m_s(&self) -> V3 {
        self.vector(7)
    }

    /// Angular velocity, body axes, rad/s.
    pub fn rotation_rad_s(&self) -> V3 {
        self.vector(10)
    }

    pub(crate) fn pose(&self) -> crate::crush::touch::Pose {
        let axes = *self.attitude().to_rotation_matrix().matrix();
        crate::crush::touch::Pose {
            at_m: self.position_m(),
            axes,
            velocity_m_s: self.velocity_m_s(),
            turning_rad_s: axes * self.rotation_rad_s(),
        }
    }

    pub(crate) fn of_wheels(&self, at: usize) -> [f64; WHEELS] {
        [0, 1, 2, 3].map(|i| self.0[at + i])
    }

    /// Jounce of each wheel, m.
    pub fn jounce_m(&self) -> [f64; WHEELS] {
        self.of_wheels(13)
    }

    /// Its rate, m/s.
    pub fn jounce_rate_m_s(&self) -> [f64; WHEELS] {
        self.of_wheels(17)
    }

    /// Absolute spin of each wheel, rad/s.
    pub fn spin_rad_s(&self) -> [f64; WHEELS] {
        self.of_wheels(21)
    }

    pub(crate) fn set_spin(&mut self, wheel: usize, spin_rad_s: f64) {
        self.0[21 + wheel] = spin_rad_s;
    }

    /// Transient slips of a wheel, longitudinal and lateral.
    pub fn slips(&self, wheel: usize) -> [f64; 2] {
        [self.0[25 + wheel], self.0[29 + wheel]]
    }

    /// Work since the start.
    pub fn work(&self) -> Work {
        Work::of(&self.0[MOTION..])
    }

    /// Yaw, pitch and roll (SAE J670): yaw about Z, then pitch, then roll, rad.
    pub fn yaw_pitch_roll_rad(&self) -> [f64; 3] {
        let r = self.attitude().to_rotation_matrix();
        let r = r.matrix();
        let pitch = -libm::asin(r[(2, 0)].clamp(-1.0, 1.0));
        [libm::atan2(r[(1, 0)], r[(0, 0)]), pitch, libm::atan2(r[(2, 1)], r[(2, 2)])]
    }
}
