//! A vehicle path from what sensors in the vehicle recorded: accelerations and turning rates along the vehicle's axes
//! (strapdown integration), or the velocity change of an event data recorder. All of it is ours; the report knows
//! only tables.
//!
//! The sensors are at r from the c.g. Their own motion is integrated, and the c.g. follows from it without any
//! derivative of the rates:
//!
//! ```text
//! X_cg = X_s − A r,   v_cg = v_s − ω × A r,   a_cg = a_s − ω̇ × A r − ω × (ω × A r)
//! ```
//!
//! Between samples the rates are straight lines, and so are recorded accelerations; [`strapdown`] integrates them.

mod baseline;
mod delta_v;
mod readings;
mod record;
mod strapdown;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::attitude::Attitude;
use super::cursor::PathCursor;
use super::frame::{FrameMotion, rotation_to_space, to_space};
use super::problem::{PathProblem, expect_finite};
use super::{AfterEnd, TravelDirection, VehiclePose, expect_finite_pose};
pub use baseline::Baseline;
use crash_measures::signal::ChannelClass;
pub use record::{AccelerationRecord, DeltaVRecord, SensorRecord};
use strapdown::{Piece, integrate};

/// Gravity in recorded accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "schema", schemars(rename = "RecordedGravity"))]
pub enum SensorGravity {
    /// Included: a level vehicle at rest reads 1 g upwards.
    Included,
    /// Zeroed before the test at rest in the initial attitude: the sensors read 0 there, and gravity appears as the
    /// vehicle rotates.
    Zeroed,
    /// Removed at every instant: a vehicle at rest reads 0 in any attitude.
    Removed,
}

/// Input of a record, and the initial state of the vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorDefinition {
    /// The record.
    pub record: SensorRecord,
    /// Pose of the vehicle when the path starts.
    pub initial: VehiclePose,
    /// Speed of the c.g. when the path starts, m/s, zero or more.
    pub initial_speed_m_s: f64,
    /// Direction of that speed.
    pub direction: TravelDirection,
    /// Position of the sensors from the c.g., in vehicle axes (x forward, y right, z down), m.
    pub offset_m: Vector3<f64>,
    /// Gravity in the accelerations; a velocity change has none.
    pub gravity: SensorGravity,
    /// g at the place of the record, m/s².
    pub gravity_m_s2: f64,
    /// Low-pass filter of all channels before integration.
    pub filter: Option<ChannelClass>,
    /// Duration of rest at the beginning of the record whose mean gives the sensors' zero errors, s.
    pub baseline_s: Option<f64>,
    /// Duration of rest at its end, s: zero errors are then linear between both means.
    pub baseline_end_s: Option<f64>,
    /// Factor of accelerations, without gravity, and of changes of the rates; 1 leaves the recorded motion unchanged.
    pub strength: f64,
    /// Time of the record at which the path starts, with the given pose and speed, s; the first sample if none.
    pub starts_at_s: Option<f64>,
    /// Motion after the last sample.
    pub after: AfterEnd,
}

/// A vehicle path from recorded motion, integrated.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorPath {
    definition: SensorDefinition,
    pieces: Vec<Piece>,
    end_s: f64,
    /// Motion at the start and at the end, from which the vehicle coasts.
    ends: [FrameMotion; 2],
    /// Roll, pitch and yaw at the end, and their rates in the last interval.
    last_attitude: Attitude,
    last_rates_rad_s: Vector3<f64>,
}

impl SensorPath {
    /// Integrates the record of `definition`.
    ///
    /// # Errors
    /// Everything that is wrong with the definition at once: a record without a channel, with too few samples, with
    /// times that do not increase, numbers that are not finite, samples too far apart for the turning or for the
    /// filter; a start or a baseline outside the record; a direction without length.
    pub fn new(definition: SensorDefinition) -> Result<Self, Vec<PathProblem>> {
        let mut problems = Vec::new();
        let direction = check_start(&definition, &mut problems);
        let readings = match readings::read(&definition) {
            Ok(readings) if problems.is_empty() => readings,
            Ok(_) => return Err(problems),
            Err(more) => return Err([problems, more].concat()),
        };
        let (pieces, last_attitude) = integrate(&readings, &definition, direction * definition.initial_speed_m_s)?;
        let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
        let end_s = readings.time_s[readings.time_s.len() - 1];
        let rise = last_attitude.to_vector() - last.attitude.to_vector();
        let offset_m = definition.offset_m;
        let ends = [(first, first.start_s), (last, end_s)].map(|(piece, t_s)| motion_of(piece, offset_m, t_s));
        let last_rates_rad_s = rise / (end_s - last.start_s);
        Ok(SensorPath { definition, pieces, end_s, ends, last_attitude, last_rates_rad_s })
    }

    /// Definition of the path.
    pub fn definition(&self) -> &SensorDefinition {
        &self.definition
    }

    /// Times of the first and the last sample that the path uses, s.
    pub fn span_s(&self) -> (f64, f64) {
        (self.pieces[0].start_s, self.end_s)
    }

    /// Pose and motion at `t_s`, in space axes.
    ///
    /// Outside the record the vehicle coasts, or is at rest if the path says so; it is at rest in the steps whose
    /// middle, `step_middle_s`, is past the last sample.
    pub(crate) fn motion(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> FrameMotion {
        let (first_s, last_s) = self.span_s();
        let holds = self.definition.after == AfterEnd::Hold;
        let motion = if t_s < first_s {
            self.ends[0].coasted(t_s - first_s)
        } else if t_s <= last_s {
            motion_of(self.piece_at(t_s, cursor), self.definition.offset_m, t_s)
        } else if holds {
            self.ends[1]
        } else {
            self.ends[1].coasted(t_s - last_s)
        };
        if holds && step_middle_s > last_s { motion.held() } else { motion }
    }

    /// Position and attitude at `t_s`, for output.
    pub(crate) fn pose(&self, t_s: f64, cursor: &mut PathCursor) -> VehiclePose {
        let (first_s, last_s) = self.span_s();
        let near = if t_s < first_s {
            self.pieces[0].attitude
        } else if t_s <= last_s {
            self.piece_at(t_s, cursor).attitude
        } else {
            let run_on = self.last_rates_rad_s * (t_s - last_s);
            Attitude::from_vector(self.last_attitude.to_vector() + run_on)
        };
        self.motion(t_s, t_s, cursor).pose(&near)
    }

    /// Whether the path has an answer from `start_s` to `end_s`.
    ///
    /// # Errors
    /// A run that starts before the first sample, or ends past the last one without saying what comes after.
    pub(crate) fn check_span(&self, start_s: f64, end_s: f64) -> Result<(), PathProblem> {
        self.definition.after.check_span(self.span_s(), start_s, end_s)
    }

    /// Ends of the record, s. Between them, velocity and angular velocity are continuous.
    pub(crate) fn breaks_s(&self) -> Vec<f64> {
        vec![self.pieces[0].start_s, self.end_s]
    }

    /// Times of the samples that the path uses, s.
    pub(crate) fn given_s(&self) -> Vec<f64> {
        self.pieces.iter().map(|piece| piece.start_s).chain([self.end_s]).collect()
    }

    fn piece_at(&self, t_s: f64, cursor: &mut PathCursor) -> &Piece {
        &self.pieces[cursor.locate(self.pieces.len(), t_s, |piece| self.pieces[piece].start_s)]
    }
}

/// Checks the definition except its record; returns the direction of travel in vehicle-space axes.
fn check_start(definition: &SensorDefinition, problems: &mut Vec<PathProblem>) -> Vector3<f64> {
    expect_finite_pose(problems, &definition.initial);
    let names = ["offset x", "offset y", "offset z"];
    for (quantity, value) in names.into_iter().zip(definition.offset_m.iter()) {
        expect_finite(problems, quantity, *value);
    }
    for (quantity, value) in [
        ("speed", definition.initial_speed_m_s),
        ("gravity", definition.gravity_m_s2),
        ("strength", definition.strength),
    ] {
        expect_finite(problems, quantity, value);
        if value < 0.0 {
            problems.push(PathProblem::of_value(quantity, value, "0 or more"));
        }
    }
    definition.direction.unit(&definition.initial, problems)
}

/// Motion of the c.g. at `t_s`, in space axes, from that of sensors at `offset_m`.
fn motion_of(piece: &Piece, offset_m: Vector3<f64>, t_s: f64) -> FrameMotion {
    let sensor = piece.at(t_s);
    let arm_m = sensor.rotation * offset_m;
    let (omega, alpha) = (sensor.angular_velocity_rad_s, sensor.angular_acceleration_rad_s2);
    FrameMotion {
        origin_m: to_space(sensor.place_m - arm_m),
        rotation: rotation_to_space(sensor.rotation),
        velocity_m_s: to_space(sensor.velocity_m_s - omega.cross(&arm_m)),
        angular_velocity_rad_s: to_space(omega),
        acceleration_m_s2: to_space(sensor.acceleration_m_s2 - alpha.cross(&arm_m) - omega.cross(&omega.cross(&arm_m))),
        angular_acceleration_rad_s2: to_space(alpha),
    }
}

#[cfg(test)]
#[path = "tests/sensors.rs"]
mod tests;
