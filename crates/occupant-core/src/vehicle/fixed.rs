//! A vehicle (or any frame) that is at rest.

use super::frame::FrameMotion;
use super::problem::PathProblem;
use super::{VehiclePose, expect_finite_pose};

/// A frame at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct FixedPath {
    pose: VehiclePose,
    pub(super) motion: FrameMotion,
}

impl Default for FixedPath {
    /// At the origin, level, heading forward.
    fn default() -> Self {
        FixedPath::at(VehiclePose::default())
    }
}

impl FixedPath {
    /// A frame at rest at `pose`.
    ///
    /// # Errors
    /// Every number of the pose that is not finite.
    pub fn new(pose: VehiclePose) -> Result<Self, Vec<PathProblem>> {
        let mut problems = Vec::new();
        expect_finite_pose(&mut problems, &pose);
        if problems.is_empty() { Ok(FixedPath::at(pose)) } else { Err(problems) }
    }

    fn at(pose: VehiclePose) -> Self {
        FixedPath { pose, motion: FrameMotion::at_rest(&pose) }
    }

    /// Its pose.
    pub fn pose(&self) -> VehiclePose {
        self.pose
    }
}
