//! The path of a point of a driven vehicle: `vehicle-motion` solves the drive before the run. Ours.

use std::sync::Arc;

use vehicle_motion::path::DrivenPath as Drive;

use super::VehiclePose;
use super::attitude::Attitude;
use super::frame::{FrameMotion, rotation_to_space, to_space};
use super::problem::PathProblem;

/// A driven vehicle. Clones share the drive.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenPath(Arc<Driven>);

#[derive(Debug, PartialEq)]
struct Driven {
    drive: Drive,
    /// Roll, pitch and yaw at the stations, each nearest to those of the one before.
    times_s: Vec<f64>,
    angles: Vec<Attitude>,
}

impl DrivenPath {
    /// Path of a drive.
    pub fn new(drive: Drive) -> Self {
        let times_s: Vec<f64> = drive.times_s().collect();
        let mut near = Attitude::default();
        let angles = times_s.iter().map(|t_s| {
            near = Attitude::from_matrix(&drive.at(*t_s).rotation, &near);
            near
        });
        let angles = angles.collect();
        DrivenPath(Arc::new(Driven { drive, times_s, angles }))
    }

    /// Pose and motion at `t_s`, in space axes. Outside the drive the vehicle coasts.
    pub(super) fn motion(&self, t_s: f64) -> FrameMotion {
        let inside_s = self.inside_s(t_s);
        let at = self.0.drive.at(inside_s);
        let motion = FrameMotion {
            origin_m: to_space(at.position_m),
            rotation: rotation_to_space(at.rotation),
            velocity_m_s: to_space(at.velocity_m_s),
            angular_velocity_rad_s: to_space(at.turning_rad_s),
            acceleration_m_s2: to_space(at.acceleration_m_s2),
            angular_acceleration_rad_s2: to_space(at.turning_rate_rad_s2),
        };
        if t_s == inside_s { motion } else { motion.coasted(t_s - inside_s) }
    }

    /// Position and attitude at `t_s`, for output.
    pub(super) fn pose(&self, t_s: f64) -> VehiclePose {
        let Driven { times_s, angles, .. } = &*self.0;
        let before = times_s.partition_point(|station_s| *station_s <= t_s).saturating_sub(1);
        self.motion(t_s).pose(&angles[before])
    }

    /// Whether the drive covers `start_s` to `end_s`.
    pub(super) fn check_span(&self, start_s: f64, end_s: f64) -> Result<(), PathProblem> {
        let [first_s, last_s] = self.0.drive.span_s();
        if first_s <= start_s && end_s <= last_s {
            return Ok(());
        }
        let expected = format!("a part of the drive, which lasts from {first_s} s to {last_s} s (`drive.end`)");
        Err(PathProblem::new(format!("the run lasts from {start_s} s to {end_s} s"), expected))
    }

    /// Times of the stations, s.
    pub(super) fn given_s(&self) -> &[f64] {
        &self.0.times_s
    }

    fn inside_s(&self, t_s: f64) -> f64 {
        let [first_s, last_s] = self.0.drive.span_s();
        t_s.clamp(first_s, last_s)
    }
}
