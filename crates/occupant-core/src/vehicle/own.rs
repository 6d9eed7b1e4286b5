//! A vehicle path that a program computes itself: its own vehicle model, another simulator, a formula. Ours.

use std::fmt::Debug;
use std::sync::Arc;

use nalgebra::Vector3;

use super::VehiclePose;
use super::attitude::turning;
use super::frame::{FrameMotion, rotation_to_space, to_space};
use super::problem::PathProblem;

/// State of the vehicle at one instant for a vehicle model: position, roll, pitch and yaw with their first and second
/// time derivatives, in vehicle-space axes (X′_v forward, Y′_v right, Z′_v down).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VehicleState {
    /// Position and attitude.
    pub pose: VehiclePose,
    /// Velocity of the c.g., m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Acceleration of the c.g., m/s².
    pub acceleration_m_s2: Vector3<f64>,
    /// dφ/dt, dθ/dt, dψ/dt of roll, pitch and yaw, rad/s. They differ from the readings of a rate gyro once the vehicle
    /// rolls or pitches.
    pub angle_rates_rad_s: Vector3<f64>,
    /// d²φ/dt², d²θ/dt², d²ψ/dt², rad/s².
    pub angle_accelerations_rad_s2: Vector3<f64>,
}

impl VehicleState {
    /// The same in space axes, with the angular velocity and acceleration as vectors.
    pub(crate) fn motion(&self) -> FrameMotion {
        let turning = turning(self.pose.attitude.to_vector(), self.angle_rates_rad_s, self.angle_accelerations_rad_s2);
        FrameMotion {
            origin_m: to_space(self.pose.position_m),
            rotation: rotation_to_space(turning.matrix),
            velocity_m_s: to_space(self.velocity_m_s),
            angular_velocity_rad_s: to_space(turning.velocity_rad_s),
            acceleration_m_s2: to_space(self.acceleration_m_s2),
            angular_acceleration_rad_s2: to_space(turning.acceleration_rad_s2),
        }
    }

    fn is_finite(&self) -> bool {
        let angles = self.pose.attitude.to_vector();
        let all = [
            &self.pose.position_m,
            &angles,
            &self.velocity_m_s,
            &self.acceleration_m_s2,
            &self.angle_rates_rad_s,
            &self.angle_accelerations_rad_s2,
        ];
        all.into_iter().flatten().all(|x| x.is_finite())
    }
}

/// A program's own vehicle model.
///
/// A run queries one instant several times, in any order, from any thread; a resumed run and a run in lanes query
/// again. So the answer must depend on the time alone, **to the bit**: no memory between calls, no clock, no random
/// numbers. Integrate a model that needs it before the run, and answer from the stored result.
///
/// The velocities must be the derivatives of position and angles: contacts and belts use them for the work of the
/// vehicle, and the energy ledger shows a contradiction as an imbalance. Position and velocity must be continuous;
/// accelerations may jump, at the times of [`VehicleMotion::breaks_s`]. For the same bits on every machine use the
/// sines of `occupant_units::trig`: those of the standard library differ in the last digit.
pub trait VehicleMotion: Debug + Send + Sync {
    /// State of the vehicle at `t_s`, a time within [`VehicleMotion::span_s`].
    fn at(&self, t_s: f64) -> VehicleState;

    /// First and last valid time, s. A run beyond them is refused.
    fn span_s(&self) -> (f64, f64) {
        (f64::NEG_INFINITY, f64::INFINITY)
    }

    /// Times at which an acceleration jumps, s: an integrator whose steps end there keeps its order.
    fn breaks_s(&self) -> Vec<f64> {
        Vec::new()
    }
}

/// Largest number of breaks; more are steps of a grid, not jumps.
const MOST_BREAKS: usize = 100_000;

/// Path computed by a [`VehicleMotion`]. Two are equal if they share one object.
#[derive(Clone, Debug)]
pub struct OwnPath(Arc<dyn VehicleMotion>);

impl PartialEq for OwnPath {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl OwnPath {
    /// The path of `motion`.
    pub(crate) fn new(motion: impl VehicleMotion + 'static) -> Self {
        OwnPath(Arc::new(motion))
    }

    /// Pose and motion at `t_s`, in space axes. Outside its span the vehicle coasts.
    pub(crate) fn motion(&self, t_s: f64) -> FrameMotion {
        let inside_s = self.inside_s(t_s);
        let motion = self.0.at(inside_s).motion();
        if t_s == inside_s { motion } else { motion.coasted(t_s - inside_s) }
    }

    /// Position and attitude at `t_s`, for output.
    pub(crate) fn pose(&self, t_s: f64) -> VehiclePose {
        let inside_s = self.inside_s(t_s);
        let pose = self.0.at(inside_s).pose;
        if t_s == inside_s { pose } else { self.motion(t_s).pose(&pose.attitude) }
    }

    /// As [`VehicleMotion::span_s`].
    pub(crate) fn span_s(&self) -> (f64, f64) {
        self.0.span_s()
    }

    /// As [`VehicleMotion::breaks_s`], in increasing order.
    pub(crate) fn breaks_s(&self) -> Vec<f64> {
        let mut breaks_s = self.0.breaks_s();
        breaks_s.sort_by(f64::total_cmp);
        breaks_s
    }

    /// Whether the path has an answer from `start_s` to `end_s`.
    ///
    /// # Errors
    /// A run outside the span; numbers that are not finite at its start or its end.
    pub(crate) fn check_span(&self, start_s: f64, end_s: f64) -> Result<(), PathProblem> {
        let (first_s, last_s) = self.span_s();
        if !(first_s <= start_s && end_s <= last_s) {
            let expected =
                format!("times from {first_s} s to {last_s} s, for which the program's own path has an answer");
            return Err(PathProblem::new(format!("the run lasts from {start_s} s to {end_s} s"), expected));
        }
        let breaks_s = self.breaks_s();
        if breaks_s.len() > MOST_BREAKS || breaks_s.iter().any(|t_s| !t_s.is_finite()) {
            let found = format!("the program's own path has {} times at which an acceleration jumps", breaks_s.len());
            return Err(PathProblem::new(found, format!("at most {MOST_BREAKS}, all finite")));
        }
        let broken_s = [start_s, end_s].into_iter().find(|&t_s| !self.0.at(t_s).is_finite());
        match broken_s {
            Some(time_s) => {
                let found = format!("the program's own path has numbers that are not finite at {time_s} s");
                Err(PathProblem::new(found, "finite numbers"))
            }
            None => Ok(()),
        }
    }

    fn inside_s(&self, t_s: f64) -> f64 {
        let (first_s, last_s) = self.span_s();
        t_s.max(first_s).min(last_s)
    }
}
