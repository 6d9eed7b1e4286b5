//! Position and motion of the vehicle (report, "The Path of the Vehicle in Space", Eqs 78 to 83).
//!
//! The path is prescribed: the occupant never pushes the vehicle, which acts only through the positions and velocities
//! of its surfaces and belt anchors. A [`VehiclePath`] is built and checked once. At every stage of every integration
//! step it gives a [`FrameMotion`] in space axes.
//!
//! - [`TablePath`]: stations in time, read linearly ([`Interpolation::Linear`], the report's way) or by natural cubic
//!   splines (ours);
//! - [`PulsePath`]: straight travel with fixed attitude, slowed by a deceleration pulse that is integrated in closed form
//!   (ours);
//! - [`SensorPath`]: recorded accelerations and turning rates, or velocity changes, integrated (ours);
//! - [`FixedPath`]: a frame at rest, such as a vehicle in a free fall test (ours);
//! - [`DrivenPath`]: a vehicle that was driven on a road and beside it, by `vehicle_motion` (ours);
//! - [`OwnPath`]: a program's own vehicle model, any [`VehicleMotion`] (ours);
//! - [`LivePath`]: a vehicle whose motion is given frame by frame, by [`VehicleInput`]s (ours).
//!
//! Input is in the report's vehicle-space axes X′_v forward, Y′_v right, Z′_v down, with roll, pitch and yaw; output is
//! in space axes X′ forward, Y′ left, Z′ up. F = diag(1, −1, −1) converts one to the other (Eq. 81).
//!
//! Departures from the report, all ours: velocities come from differentiating the interpolant; the path is evaluated at
//! the integrator's stage times where the report moves the vehicle once a step; a linear table keeps the velocity of
//! the interval that contains the middle of the step.

mod attitude;
mod cursor;
mod differences;
mod driven;
mod fixed;
mod frame;
pub(crate) mod live;
mod own;
mod problem;
mod pulse;
mod sensors;
mod spline;
mod station;
mod table;
mod trigger;

use nalgebra::Vector3;

pub use attitude::Attitude;
pub use cursor::PathCursor;
pub use driven::DrivenPath;
pub use fixed::FixedPath;
pub use frame::FrameMotion;
pub(crate) use live::rotation_vector;
pub use live::{LivePath, VehicleInput};
pub use own::{OwnPath, VehicleMotion, VehicleState};
pub use problem::PathProblem;
pub use pulse::{DecelerationPoint, PulseDefinition, PulsePath, PulseShape, Stop, Strength, TravelDirection};
pub use sensors::{
    AccelerationRecord, Baseline, DeltaVRecord, SensorDefinition, SensorGravity, SensorPath, SensorRecord,
};
pub use station::{Station, unwrap_angles};
pub use table::{AfterEnd, Interpolation, TablePath};

/// Position of the vehicle, in the convention of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VehiclePose {
    /// The vehicle's c.g. in vehicle-space axes (X′_v forward, Y′_v right, Z′_v down), m.
    pub position_m: Vector3<f64>,
    /// Roll, pitch and yaw.
    pub attitude: Attitude,
}

impl Default for VehiclePose {
    /// At the origin, level, heading forward.
    fn default() -> Self {
        VehiclePose { position_m: Vector3::zeros(), attitude: Attitude::default() }
    }
}

/// The prescribed path of a moving frame. Immutable; checked when its kind was built.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum VehiclePath {
    /// Stations in time.
    Table(TablePath),
    /// Straight travel slowed by a pulse.
    Pulse(PulsePath),
    /// Recorded motion.
    Sensors(Box<SensorPath>),
    /// At rest.
    Fixed(FixedPath),
    /// A drive computed before.
    Driven(DrivenPath),
    /// Motion computed by the calling program.
    Own(OwnPath),
    /// Motion given during a run.
    Live(Box<LivePath>),
}

/// Fraction of a table's length by which a run may extend beyond it, so that summed times are not refused for rounding.
/// The motion coasts there.
const TIME_SLACK: f64 = 1e-9;

/// Time within a step at which the accelerations of its ends are evaluated, s: at the end of one step as at the
/// beginning of the next.
const WITHIN_S: f64 = 1e-10;

impl VehiclePath {
    /// A vehicle at rest, level, heading forward, its c.g. at the origin.
    pub fn parked() -> Self {
        VehiclePath::Fixed(FixedPath::default())
    }

    /// Path computed by a program's own vehicle model.
    pub fn own(motion: impl VehicleMotion + 'static) -> Self {
        VehiclePath::Own(OwnPath::new(motion))
    }

    /// A vehicle with the state `start` at 0 s whose motion is then given frame by frame:
    /// [`Run::push`](crate::run::Run::push).
    pub fn live(start: VehicleState) -> Self {
        VehiclePath::Live(Box::new(LivePath { start }))
    }

    /// Whether its motion is given during the run.
    pub fn is_live(&self) -> bool {
        matches!(self, VehiclePath::Live(_))
    }

    /// Pose and motion at `t_s`, in space axes.
    ///
    /// `step_middle_s` is the middle of the present integration step; it decides which interval of a linear table gives
    /// the velocities, and whether a held table already is at rest. For output at an instant give `t_s` itself. The
    /// answer depends only on the two times, never on `cursor`, except for a live path. Outside the path's span (see
    /// `VehiclePath::check_span`) the vehicle coasts.
    pub fn motion(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> FrameMotion {
        match self {
            VehiclePath::Table(table) => table.motion(t_s, step_middle_s, cursor),
            VehiclePath::Pulse(pulse) => pulse.motion(t_s, cursor),
            VehiclePath::Sensors(sensors) => sensors.motion(t_s, step_middle_s, cursor),
            VehiclePath::Fixed(fixed) => fixed.motion,
            VehiclePath::Driven(driven) => driven.motion(t_s),
            VehiclePath::Own(own) => own.motion(t_s),
            VehiclePath::Live(live) => match &cursor.live {
                Some(frames) => frames.of(step_middle_s).motion(t_s),
                None => live.motion(t_s),
            },
        }
    }

    /// [`VehiclePath::motion`] with the accelerations within the step, where they jump at one of its ends.
    pub fn motion_within(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> FrameMotion {
        let inwards_s = (step_middle_s - t_s).clamp(-WITHIN_S, WITHIN_S);
        let within = self.motion(t_s + inwards_s, step_middle_s, cursor);
        FrameMotion {
            acceleration_m_s2: within.acceleration_m_s2,
            angular_acceleration_rad_s2: within.angular_acceleration_rad_s2,
            ..self.motion(t_s, step_middle_s, cursor)
        }
    }

    /// Pose and motion at `t_s` for output, in space axes: as [`VehiclePath::motion`], but accelerations of a linearly
    /// interpolated table, whose velocity jumps at its stations, are second differences of the stations.
    pub fn shown_motion(&self, t_s: f64, cursor: &mut PathCursor) -> FrameMotion {
        let motion = self.motion(t_s, t_s, cursor);
        match self {
            VehiclePath::Table(table) => table.with_differences(t_s, motion, cursor),
            _ => motion,
        }
    }

    /// Position in vehicle-space axes and roll, pitch, yaw at `t_s`, for output.
    pub fn attitude(&self, t_s: f64, cursor: &mut PathCursor) -> VehiclePose {
        match self {
            VehiclePath::Table(table) => table.pose(t_s, cursor),
            VehiclePath::Pulse(pulse) => pulse.pose(t_s, cursor),
            VehiclePath::Sensors(sensors) => sensors.pose(t_s, cursor),
            VehiclePath::Fixed(fixed) => fixed.pose(),
            VehiclePath::Driven(driven) => driven.pose(t_s),
            VehiclePath::Own(own) => own.pose(t_s),
            VehiclePath::Live(live) => match &cursor.live {
                Some(frames) => frames.of(t_s).pose(t_s),
                None => live.pose(t_s),
            },
        }
    }

    /// Whether a run from `start_s` to `end_s` has a vehicle all along.
    ///
    /// # Errors
    /// Times that are not finite; a start before the first station of a table or sample of a record; an end past its
    /// last one unless the path says what comes after; a run outside the span of a program's own path.
    pub(crate) fn check_span(&self, start_s: f64, end_s: f64) -> Result<(), PathProblem> {
        for (quantity, value) in [("start of the run", start_s), ("end of the run", end_s)] {
            if !value.is_finite() {
                return Err(PathProblem::not_finite(quantity, value));
            }
        }
        match self {
            VehiclePath::Table(table) => table.check_span(start_s, end_s),
            VehiclePath::Sensors(sensors) => sensors.check_span(start_s, end_s),
            VehiclePath::Driven(driven) => driven.check_span(start_s, end_s),
            VehiclePath::Own(own) => own.check_span(start_s, end_s),
            VehiclePath::Pulse(_) | VehiclePath::Fixed(_) | VehiclePath::Live(_) => Ok(()),
        }
    }

    /// Times at which velocity or acceleration jumps, s, in increasing order: an integrator whose steps end there keeps
    /// its order.
    pub fn breaks_s(&self) -> Vec<f64> {
        match self {
            VehiclePath::Table(table) => table.breaks_s(),
            VehiclePath::Pulse(pulse) => pulse.breaks_s(),
            VehiclePath::Sensors(sensors) => sensors.breaks_s(),
            VehiclePath::Own(own) => own.breaks_s(),
            // accelerations are continuous, or told when they come
            VehiclePath::Fixed(_) | VehiclePath::Driven(_) | VehiclePath::Live(_) => Vec::new(),
        }
    }

    /// Times at which the path is given, s, in increasing order: stations, samples, corners. Between them it is smooth.
    pub(crate) fn given_s(&self) -> Vec<f64> {
        match self {
            VehiclePath::Table(table) => table.stations().iter().map(|station| station.time_s).collect(),
            VehiclePath::Sensors(sensors) => sensors.given_s(),
            VehiclePath::Driven(driven) => driven.given_s().to_vec(),
            _ => self.breaks_s(),
        }
    }
}

/// Adds a problem for every number of `pose` that is not finite.
fn expect_finite_pose(problems: &mut Vec<PathProblem>, pose: &VehiclePose) {
    let names = ["position x", "position y", "position z", "roll", "pitch", "yaw"];
    let angles = pose.attitude.to_vector();
    for (quantity, value) in names.into_iter().zip(pose.position_m.iter().chain(&angles)) {
        problem::expect_finite(problems, quantity, *value);
    }
}

#[cfg(test)]
#[path = "tests/support.rs"]
mod support;
#[cfg(test)]
#[path = "tests/path.rs"]
mod tests;
