//! Motion of the frames that surfaces and anchors are fixed to, as the kernel uses it.
//!
//! Report: Eqs 82, 83 and 94. Space is frame 0 and the first vehicle frame 1; others follow. Last are the segments that
//! carry faces.

use std::ops::{Index, IndexMut};

use crate::motion::scalar::Scalar;
use crate::motion::vector::{M3, V3};
use crate::vehicle::FrameMotion;

/// Pose and velocity of a frame; axes are columns in space.
#[derive(Clone, Copy, Debug)]
pub struct Moving<S> {
    /// Origin, m.
    pub origin: V3<S>,
    /// Axes.
    pub axes: M3<S>,
    /// Velocity of the origin, m/s.
    pub velocity: V3<S>,
    /// Angular velocity, rad/s.
    pub omega: V3<S>,
    /// Acceleration of the origin, m/s².
    pub acceleration: V3<S>,
    /// Angular acceleration, rad/s².
    pub alpha: V3<S>,
}

/// Index of space among the frames.
pub const SPACE: usize = 0;
/// Index of the first vehicle among the frames.
pub const VEHICLE: usize = 1;
/// Largest number of frames: space, vehicles, the ground, panels.
pub const MOST_FRAMES: usize = 10;

impl<S: Copy> Moving<S> {
    /// f applied to corresponding numbers of this and `other`.
    #[inline(always)]
    pub(crate) fn zip<A: Copy, T>(&self, other: &Moving<A>, f: &impl Fn(S, A) -> T) -> Moving<T> {
        Moving {
            origin: self.origin.zip(&other.origin, f),
            axes: self.axes.zip(&other.axes, f),
            velocity: self.velocity.zip(&other.velocity, f),
            omega: self.omega.zip(&other.omega, f),
            acceleration: self.acceleration.zip(&other.acceleration, f),
            alpha: self.alpha.zip(&other.alpha, f),
        }
    }
}

impl<S> Moving<S> {
    /// Calls f with corresponding numbers of this and `other`, to copy values.
    #[inline]
    pub fn each<A: Copy>(&mut self, other: &Moving<A>, f: &mut impl FnMut(&mut S, A)) {
        let axes = (&mut self.axes, &other.axes);
        for (a, b) in [
            (&mut self.origin, &other.origin),
            (&mut axes.0.x, &axes.1.x),
            (&mut axes.0.y, &axes.1.y),
            (&mut axes.0.z, &axes.1.z),
            (&mut self.velocity, &other.velocity),
            (&mut self.omega, &other.omega),
            (&mut self.acceleration, &other.acceleration),
            (&mut self.alpha, &other.alpha),
        ] {
            f(&mut a.x, b.x);
            f(&mut a.y, b.y);
            f(&mut a.z, b.z);
        }
    }
}

impl Moving<f64> {
    /// Motion as plain data.
    pub(crate) fn motion(&self) -> FrameMotion {
        FrameMotion {
            origin_m: self.origin.to_vector(),
            rotation: self.axes.to_matrix(),
            velocity_m_s: self.velocity.to_vector(),
            angular_velocity_rad_s: self.omega.to_vector(),
            acceleration_m_s2: self.acceleration.to_vector(),
            angular_acceleration_rad_s2: self.alpha.to_vector(),
        }
    }
}

impl<S: Scalar> Moving<S> {
    /// Space.
    #[inline(always)]
    pub fn space() -> Self {
        let o = V3::zero();
        Moving { origin: o, axes: M3::identity(), velocity: o, omega: o, acceleration: o, alpha: o }
    }

    /// The same motion in every lane.
    #[inline]
    pub(crate) fn of(motion: &FrameMotion) -> Self {
        Moving {
            origin: V3::of(&motion.origin_m),
            axes: M3::of(&motion.rotation),
            velocity: V3::of(&motion.velocity_m_s),
            omega: V3::of(&motion.angular_velocity_rad_s),
            acceleration: V3::of(&motion.acceleration_m_s2),
            alpha: V3::of(&motion.angular_acceleration_rad_s2),
        }
    }

    /// Motion of a frame that moves as `other` relative to this one.
    pub(crate) fn carrying(&self, other: &Moving<S>) -> Self {
        let arm = self.axes.out(other.origin);
        let (turning, drift) = (self.omega.cross(arm), self.axes.out(other.velocity));
        let spin = self.axes.out(other.omega);
        let coriolis = self.omega.cross(drift) * S::of(2.0);
        Moving {
            origin: self.origin + arm,
            axes: self.axes.times(&other.axes),
            velocity: self.velocity + turning + drift,
            omega: self.omega + spin,
            acceleration: self.acceleration
                + self.alpha.cross(arm)
                + self.omega.cross(turning)
                + coriolis
                + self.axes.out(other.acceleration),
            alpha: self.alpha + self.omega.cross(spin) + self.axes.out(other.alpha),
        }
    }

    /// Motion of a frame fixed to this one, with its origin at `place` and these axes in it.
    #[inline(always)]
    pub(crate) fn carried(&self, place: V3<S>, axes: &M3<S>) -> Self {
        let arm = self.axes.out(place);
        let turning = self.omega.cross(arm);
        Moving {
            origin: self.origin + arm,
            axes: self.axes.times(axes),
            velocity: self.velocity + turning,
            acceleration: self.acceleration + self.alpha.cross(arm) + self.omega.cross(turning),
            ..*self
        }
    }

    /// Velocity of the frame's point at `point` in space.
    #[inline(always)]
    pub fn velocity_at(&self, point: V3<S>) -> V3<S> {
        self.velocity + self.omega.cross(point - self.origin)
    }
}

/// Motions of the frames at one instant: [`SPACE`], [`VEHICLE`] and the others in the setup's order.
#[derive(Clone, Copy, Debug)]
pub struct Frames<S> {
    /// Time of the scenario, s.
    pub time: S,
    /// The frames.
    pub moving: [Moving<S>; MOST_FRAMES],
}

impl<S: Copy> Frames<S> {
    /// f applied to corresponding numbers of this and `other`.
    pub fn zip<A: Copy, T>(&self, other: &Frames<A>, f: &impl Fn(S, A) -> T) -> Frames<T> {
        let moving = std::array::from_fn(|i| self.moving[i].zip(&other.moving[i], f));
        Frames { time: f(self.time, other.time), moving }
    }
}

impl<S: Scalar> Frames<S> {
    /// All frames at rest in space.
    pub fn still(time: S) -> Self {
        Frames { time, moving: [Moving::space(); MOST_FRAMES] }
    }
}

impl<S> Index<usize> for Frames<S> {
    type Output = Moving<S>;

    #[inline(always)]
    fn index(&self, frame: usize) -> &Moving<S> {
        &self.moving[frame]
    }
}

impl<S> IndexMut<usize> for Frames<S> {
    fn index_mut(&mut self, frame: usize) -> &mut Moving<S> {
        &mut self.moving[frame]
    }
}
