//! A vehicle whose motion is given frame by frame during the run: by a driving simulator, a game, a controller. Ours.
//!
//! Within a frame of length T, position and rotation are cubics in the time τ since its start, the rotation as a
//! rotation vector φ from the attitude there:
//!
//! ```text
//! R(τ) = exp([φ(τ)]) R(0)        ω = φ̇ + A φ×φ̇ + B φ×(φ×φ̇)        A = (1 − cos θ)/θ²    B = (θ − sin θ)/θ³    θ = |φ|
//! ```
//!
//! so that position, attitude and both velocities are continuous from frame to frame, and every velocity is the
//! derivative of its position. Accelerations jump between frames: error control ends a step there.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};
use occupant_units::trig;

use super::attitude::rotation_by;
use super::frame::{FrameMotion, to_space};
use super::own::VehicleState;
use super::{Attitude, VehiclePose};

/// Largest acceleration of a motion, m/s²; more is a jump.
const MOST_M_S2: f64 = 1e5;
/// Largest rotation within one frame, rad.
const MOST_RAD: f64 = 2.0;

/// A path given frame by frame: [`Run::push`](crate::run::Run::push). It starts as given and continues without
/// acceleration until more is given.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LivePath {
    /// Vehicle state at 0 s; its accelerations are ignored.
    pub start: VehicleState,
}

impl LivePath {
    /// Motion before the first frame.
    pub(super) fn motion(&self, t_s: f64) -> FrameMotion {
        self.start.motion().coasted(t_s)
    }

    /// Position and attitude before the first frame.
    pub(super) fn pose(&self, t_s: f64) -> VehiclePose {
        self.motion(t_s).pose(&self.start.pose.attitude)
    }
}

/// Motion of a vehicle in one frame, in vehicle-space axes (X′_v forward, Y′_v right, Z′_v down).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum VehicleInput {
    /// Constant accelerations over the frame.
    Acceleration {
        /// Of the c.g., m/s².
        linear_m_s2: Vector3<f64>,
        /// Angular, rad/s².
        angular_rad_s2: Vector3<f64>,
    },
    /// State at the end of the frame; its accelerations are ignored.
    State(VehicleState),
}

impl VehicleInput {
    /// An acceleration of the c.g. without angular acceleration, m/s².
    pub fn acceleration(linear_m_s2: [f64; 3]) -> Self {
        VehicleInput::Acceleration { linear_m_s2: linear_m_s2.into(), angular_rad_s2: Vector3::zeros() }
    }
}

/// A given frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LiveFrame {
    pub from_s: f64,
    pub until_s: f64,
    start: FrameMotion,
    near: Attitude,
    /// Factors of τ, τ², τ³.
    place: [Vector3<f64>; 3],
    turn: [Vector3<f64>; 3],
}

impl LiveFrame {
    /// From `start` on.
    ///
    /// # Errors
    /// Problems of the input, in words: what was found, and what was expected.
    pub(crate) fn new(
        [from_s, until_s]: [f64; 2],
        start: FrameMotion,
        near: Attitude,
        input: &VehicleInput,
    ) -> Result<Self, (String, &'static str)> {
        let t = until_s - from_s;
        let (velocity, omega) = (start.velocity_m_s, start.angular_velocity_rad_s);
        let (place, turn) = match input {
            VehicleInput::Acceleration { linear_m_s2, angular_rad_s2 } => {
                let half = |a: &Vector3<f64>| to_space(*a) * 0.5;
                let zero = Vector3::zeros();
                ([velocity, half(linear_m_s2), zero], [omega, half(angular_rad_s2), zero])
            }
            VehicleInput::State(end) => {
                let end = end.motion();
                let phi = rotation_vector(&(end.rotation * start.rotation.transpose()));
                let way = end.origin_m - start.origin_m;
                let turning = unturned(phi, end.angular_velocity_rad_s);
                (hermite(way, velocity, end.velocity_m_s, t), hermite(phi, omega, turning, t))
            }
        };
        let frame = LiveFrame { from_s, until_s, start, near, place, turn };
        let end = frame.motion(until_s);
        if !end.is_finite() {
            return Err(("numbers that are not finite".to_owned(), "finite numbers"));
        }
        let fastest =
            |cubic: &[Vector3<f64>; 3]| (cubic[1] * 2.0).norm().max((cubic[1] * 2.0 + cubic[2] * 6.0 * t).norm());
        if fastest(&frame.place) > MOST_M_S2 {
            let found = format!("an acceleration of {:.1e} m/s² within a frame of {t} s", fastest(&frame.place));
            return Err((found, "a position that changes as the velocity requires"));
        }
        let angle = at(&frame.turn, t)[0].norm();
        if angle > MOST_RAD {
            return Err((format!("a turn of {angle:.2} rad within one frame"), "shorter frames, or a slower turn"));
        }
        Ok(frame)
    }

    /// Pose and motion at a time within, in space axes; beyond its end the vehicle coasts.
    pub(crate) fn motion(&self, t_s: f64) -> FrameMotion {
        let within_s = t_s.clamp(self.from_s, self.until_s) - self.from_s;
        let [way, velocity, acceleration] = at(&self.place, within_s);
        let [phi, dphi, ddphi] = at(&self.turn, within_s);
        let (omega, alpha) = turning(phi, dphi, ddphi);
        let motion = FrameMotion {
            origin_m: self.start.origin_m + way,
            rotation: rotation_by(phi) * self.start.rotation,
            velocity_m_s: velocity,
            angular_velocity_rad_s: omega,
            acceleration_m_s2: acceleration,
            angular_acceleration_rad_s2: alpha,
        };
        if t_s > self.until_s { motion.coasted(t_s - self.until_s) } else { motion }
    }

    /// Position and attitude at a time, for output.
    pub(crate) fn pose(&self, t_s: f64) -> VehiclePose {
        self.motion(t_s).pose(&self.near)
    }

    fn numbers(&self) -> [f64; FRAME] {
        let near = self.near.to_vector();
        let start = &self.start;
        let vectors = [&near, &start.origin_m, &start.velocity_m_s, &start.angular_velocity_rad_s];
        let all = vectors.into_iter().chain(&self.place).chain(&self.turn).flat_map(|v| v.iter());
        let mut list =
            [self.from_s, self.until_s].into_iter().chain(all.copied()).chain(start.rotation.iter().copied());
        std::array::from_fn(|_| list.next().unwrap_or_default())
    }

    fn from_numbers(numbers: &[f64; FRAME]) -> Self {
        let vector = |i: usize| Vector3::from_column_slice(&numbers[2 + 3 * i..5 + 3 * i]);
        let near = vector(0);
        let start = FrameMotion {
            origin_m: vector(1),
            velocity_m_s: vector(2),
            angular_velocity_rad_s: vector(3),
            rotation: Matrix3::from_column_slice(&numbers[FRAME - 9..]),
            ..FrameMotion::space()
        };
        LiveFrame {
            from_s: numbers[0],
            until_s: numbers[1],
            start,
            near: Attitude { roll_rad: near.x, pitch_rad: near.y, yaw_rad: near.z },
            place: [4, 5, 6].map(vector),
            turn: [7, 8, 9].map(vector),
        }
    }
}

/// Count of numbers of a frame: its times, ten vectors, a matrix.
const FRAME: usize = 2 + 3 * 10 + 9;

/// A cubic and its first two derivatives.
fn at(cubic: &[Vector3<f64>; 3], t: f64) -> [Vector3<f64>; 3] {
    let [a, b, c] = cubic;
    [(a + (b + c * t) * t) * t, a + (b * 2.0 + c * (3.0 * t)) * t, b * 2.0 + c * (6.0 * t)]
}

/// Cubic over the displacement `way` in a time `t`, with these rates at its ends.
fn hermite(way: Vector3<f64>, first: Vector3<f64>, last: Vector3<f64>, t: f64) -> [Vector3<f64>; 3] {
    [first, (way * (3.0 / t) - first * 2.0 - last) / t, (way * (-2.0 / t) + first + last) / (t * t)]
}

/// A, B and their derivatives by θ, divided by θ.
fn factors(square: f64) -> [f64; 4] {
    if square < 1e-3 {
        let q = square;
        return [
            1.0 / 2.0 - q / 24.0 + q * q / 720.0,
            1.0 / 6.0 - q / 120.0 + q * q / 5040.0,
            -1.0 / 12.0 + q / 180.0 - q * q / 6720.0,
            -1.0 / 60.0 + q / 1260.0 - q * q / 60480.0,
        ];
    }
    let theta = square.sqrt();
    let (sine, cosine) = trig::sin_cos(theta);
    let (a, sinc) = ((1.0 - cosine) / square, sine / theta);
    let b = (1.0 - sinc) / square;
    [a, b, (sinc - 2.0 * a) / square, (a - 3.0 * b) / square]
}

/// ω and dω/dt of a rotation vector and its derivatives.
fn turning(phi: Vector3<f64>, dphi: Vector3<f64>, ddphi: Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let [a, b, da, db] = factors(phi.norm_squared());
    let (once, rate) = (phi.cross(&dphi), phi.dot(&dphi));
    let twice = phi.cross(&once);
    let omega = dphi + once * a + twice * b;
    let changing = dphi.cross(&once) + phi.cross(&phi.cross(&ddphi));
    let alpha = ddphi + once * (da * rate) + phi.cross(&ddphi) * a + twice * (db * rate) + changing * b;
    (omega, alpha)
}

/// φ̇ of a rotation vector for the angular velocity ω.
fn unturned(phi: Vector3<f64>, omega: Vector3<f64>) -> Vector3<f64> {
    let square = phi.norm_squared();
    let c = if square < 1e-3 {
        1.0 / 12.0 + square / 720.0 + square * square / 30240.0
    } else {
        let theta = square.sqrt();
        let (sine, cosine) = trig::sin_cos(theta);
        1.0 / square - (1.0 + cosine) / (2.0 * theta * sine)
    };
    let once = phi.cross(&omega);
    omega - once * 0.5 + phi.cross(&once) * c
}

/// Rotation vector of a rotation, of length 0 to π; of the two vectors of length π either. By the quaternion's half angle, which loses no
/// digits near 0 or near π.
pub(crate) fn rotation_vector(turn: &Matrix3<f64>) -> Vector3<f64> {
    let half = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*turn));
    let (by_sine, cosine) = (half.imag() * half.w.signum(), half.w.abs());
    let sine = by_sine.norm();
    // arcsin x = x (1 + x²/6) where x is small
    let factor = if sine < 1e-5 { 1.0 + sine * sine / 6.0 } else { trig::atan2(sine, cosine) / sine };
    by_sine * (2.0 * factor)
}

/// Latest given frames: a step that ends in the present one may have to be repeated from the previous one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LiveFrames {
    before: Option<LiveFrame>,
    now: LiveFrame,
}

impl LiveFrames {
    /// Adds a frame after the existing ones.
    pub(crate) fn with(before: Option<&LiveFrames>, now: LiveFrame) -> Self {
        LiveFrames { before: before.map(|frames| frames.now), now }
    }

    /// Latest frame.
    pub(crate) fn now(&self) -> &LiveFrame {
        &self.now
    }

    /// As plain numbers.
    pub(crate) fn numbers(&self) -> Vec<f64> {
        self.before.iter().chain([&self.now]).flat_map(LiveFrame::numbers).collect()
    }

    /// Frames from the numbers of [`LiveFrames::numbers`]; none from invalid ones.
    pub(crate) fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let (frames, rest) = numbers.as_chunks::<FRAME>();
        let is_sound = rest.is_empty() && numbers.iter().all(|x| x.is_finite());
        match frames {
            [now] if is_sound => Some(LiveFrames { before: None, now: LiveFrame::from_numbers(now) }),
            [before, now] if is_sound => {
                Some(LiveFrames { before: Some(LiveFrame::from_numbers(before)), now: LiveFrame::from_numbers(now) })
            }
            _ => None,
        }
    }

    /// Frame of a step, by its middle.
    pub(super) fn of(&self, step_middle_s: f64) -> &LiveFrame {
        self.before.as_ref().filter(|_| step_middle_s < self.now.from_s).unwrap_or(&self.now)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn frame(input: &VehicleInput) -> LiveFrame {
        let start = VehicleState {
            velocity_m_s: Vector3::new(20.0, 1.0, 0.0),
            angle_rates_rad_s: Vector3::new(0.4, -0.3, 0.9),
            ..VehicleState::default()
        };
        LiveFrame::new([1.0, 1.25], start.motion(), Attitude::default(), input).expect("a frame")
    }

    fn end() -> VehicleState {
        VehicleState {
            pose: VehiclePose {
                position_m: Vector3::new(4.9, 0.3, 0.0),
                attitude: Attitude { roll_rad: 0.12, pitch_rad: -0.05, yaw_rad: 0.25 },
            },
            velocity_m_s: Vector3::new(18.0, 2.0, 0.1),
            angle_rates_rad_s: Vector3::new(0.5, 0.1, 1.1),
            ..VehicleState::default()
        }
    }

    /// Every angle from none to a half turn comes back, whatever rounding makes of the matrix's trace.
    #[test]
    fn a_rotation_vector_is_that_of_the_rotation() {
        let axis = Vector3::new(0.3, -0.5, 0.8).normalize();
        for angle in [0.0, 1e-12, 1e-9, 3e-6, 0.1, 2.0, 3.1, PI - 1e-7] {
            let turn = *Rotation3::new(axis * angle).matrix();
            for rounded in [turn, turn * (1.0 + 2e-16), turn * (1.0 - 2e-16)] {
                let off = (rotation_vector(&rounded) - axis * angle).norm();
                assert!(off < 1e-15 + 1e-14 * angle, "{angle}: off by {off}");
            }
        }
        let half = rotation_vector(Rotation3::new(axis * PI).matrix());
        assert!(half.cross(&axis).norm() < 1e-8 && (half.norm() - PI).abs() < 1e-8, "{half}");
    }

    fn inputs() -> [VehicleInput; 2] {
        let angular_rad_s2 = Vector3::new(2.0, 1.0, -3.0);
        let linear_m_s2 = Vector3::new(-80.0, 5.0, 1.0);
        [VehicleInput::Acceleration { linear_m_s2, angular_rad_s2 }, VehicleInput::State(end())]
    }

    /// Velocities are the derivatives of positions, accelerations those of velocities, by differences of 10 µs: 3e-9
    /// measured.
    #[test]
    fn what_is_told_fits_together() {
        for input in inputs() {
            let frame = frame(&input);
            for t in [1.001, 1.1, 1.24] {
                let h = 1e-5;
                let [a, m, b] = [t - h, t, t + h].map(|t| frame.motion(t));
                let slope = |f: fn(&FrameMotion) -> Vector3<f64>| (f(&b) - f(&a)) / (2.0 * h);
                assert!((slope(|m| m.origin_m) - m.velocity_m_s).norm() < 1e-7, "{input:?}");
                assert!((slope(|m| m.velocity_m_s) - m.acceleration_m_s2).norm() < 1e-6);
                let omega = (b.rotation - a.rotation) / (2.0 * h) * m.rotation.transpose();
                let omega = Vector3::new(omega[(2, 1)], omega[(0, 2)], omega[(1, 0)]);
                assert!(
                    (omega - m.angular_velocity_rad_s).norm() < 1e-8,
                    "{}",
                    (omega - m.angular_velocity_rad_s).norm()
                );
                let alpha = slope(|m| m.angular_velocity_rad_s) - m.angular_acceleration_rad_s2;
                assert!(alpha.norm() < 1e-7, "{}", alpha.norm());
            }
        }
    }

    /// A given state is reached, also where the next frame begins.
    #[test]
    fn a_state_is_reached() {
        let (reached, told) = (frame(&VehicleInput::State(end())).motion(1.25), end().motion());
        assert!((reached.origin_m - told.origin_m).norm() < 1e-14);
        assert!((reached.rotation - told.rotation).norm() < 1e-14);
        assert!((reached.velocity_m_s - told.velocity_m_s).norm() < 1e-13);
        assert!((reached.angular_velocity_rad_s - told.angular_velocity_rad_s).norm() < 1e-13);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let start = VehicleState::default().motion();
        let new = |input: VehicleInput| LiveFrame::new([0.0, 1e-3], start, Attitude::default(), &input);
        let leap = VehiclePose { position_m: Vector3::new(1.0, 0.0, 0.0), ..VehiclePose::default() };
        assert!(new(VehicleInput::State(VehicleState { pose: leap, ..VehicleState::default() })).is_err());
        assert!(new(VehicleInput::acceleration([f64::NAN, 0.0, 0.0])).is_err());
        let angular_rad_s2 = Vector3::new(0.0, 0.0, 1e7);
        assert!(new(VehicleInput::Acceleration { linear_m_s2: Vector3::zeros(), angular_rad_s2 }).is_err());
        assert!(new(VehicleInput::acceleration([-300.0, 0.0, 0.0])).is_ok());
    }
}
