//! A vehicle path given by stations in time: the report's tabular record (its POSVEH), or a smooth one.

use nalgebra::{Rotation3, Vector3, Vector6};
use serde::{Deserialize, Serialize};

use super::attitude::Attitude;
use super::cursor::PathCursor;
use super::differences::Differences;
use super::frame::FrameMotion;
use super::problem::PathProblem;
use super::spline::{End, Piece, linear_pieces, spline_pieces};
use super::station::{Station, problems_of};
use super::{TIME_SLACK, VehiclePose, VehicleState};

/// Interpolation of a table between its times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "schema", schemars(rename = "Interpolate"))]
pub enum Interpolation {
    /// Linear, as in the report; velocities jump at every time.
    Linear,
    /// Cubic spline, with zero curvature at its ends, or zero velocity where the vehicle or panel is held after the
    /// last time.
    #[default]
    Spline,
}

/// Motion after the last time of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "schema", schemars(rename = "After"))]
pub enum AfterEnd {
    /// None: a longer run is refused.
    #[default]
    Error,
    /// It continues with constant velocity.
    Coast,
    /// It is at rest; a spline comes to rest there.
    Hold,
}

impl AfterEnd {
    /// End condition of a spline that is followed by this.
    fn end(self) -> End {
        if self == AfterEnd::Hold { End::AtRest } else { End::Given }
    }

    /// Whether a path given from `first_s` to `last_s` has an answer from `start_s` to `end_s`.
    ///
    /// # Errors
    /// A run that starts before the first time, or ends after the last one without a motion given beyond it.
    pub(super) fn check_span(self, (first_s, last_s): (f64, f64), start_s: f64, end_s: f64) -> Result<(), PathProblem> {
        let slack_s = TIME_SLACK * (last_s - first_s);
        if start_s < first_s - slack_s {
            let expected = format!("at or after the first station at {first_s} s");
            Err(PathProblem::new(format!("the run starts at {start_s} s"), expected))
        } else if end_s > last_s + slack_s && self == AfterEnd::Error {
            let expected = format!(
                "at or before the last station at {last_s} s; shorten the run, or say what the vehicle does after the last \
                 station: after = \"coast\" or \"hold\""
            );
            Err(PathProblem::new(format!("the run ends at {end_s} s"), expected))
        } else {
            Ok(())
        }
    }
}

/// A vehicle path through stations, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct TablePath {
    stations: Vec<Station>,
    interpolation: Interpolation,
    after: AfterEnd,
    /// Accelerations of a spline at the first and at the last station, m/s², in the axes of the stations.
    ends_m_s2: [Vector3<f64>; 2],
    pieces: Vec<Piece>,
    /// For linear interpolation only.
    differences: Option<Differences>,
    /// Motion at the first and at the last station, from which the vehicle coasts.
    ends: [FrameMotion; 2],
    /// Roll, pitch and yaw rates at the last station, rad/s.
    last_rates_rad_s: Vector3<f64>,
}

impl TablePath {
    /// A path through `stations`; a spline has zero curvature at its ends.
    ///
    /// # Errors
    /// Everything that is wrong with the stations at once: fewer than two of them, times that do not increase, numbers
    /// that are not finite, angles that jump by more than half a turn (see [`unwrap_angles`](super::unwrap_angles)).
    pub fn new(
        stations: Vec<Station>,
        interpolation: Interpolation,
        after: AfterEnd,
    ) -> Result<Self, Vec<PathProblem>> {
        TablePath::between(stations, [Vector3::zeros(); 2], interpolation, after)
    }

    /// A spline through `stations` with given accelerations at the first and at the last one, in the axes of the stations, m/s². So
    /// places that are integrals of accelerations along straight lines give these accelerations back. The last one does not count
    /// where the vehicle is at rest after it.
    ///
    /// # Errors
    /// As [`TablePath::new`].
    pub fn with_accelerations_at_ends(
        stations: Vec<Station>,
        ends_m_s2: [Vector3<f64>; 2],
        after: AfterEnd,
    ) -> Result<Self, Vec<PathProblem>> {
        TablePath::between(stations, ends_m_s2, Interpolation::Spline, after)
    }

    fn between(
        stations: Vec<Station>,
        ends_m_s2: [Vector3<f64>; 2],
        interpolation: Interpolation,
        after: AfterEnd,
    ) -> Result<Self, Vec<PathProblem>> {
        let problems = problems_of(&stations);
        if !problems.is_empty() {
            return Err(problems);
        }
        let times_s: Vec<f64> = stations.iter().map(|station| station.time_s).collect();
        let values: Vec<Vector6<f64>> = stations.iter().map(Station::channels).collect();
        let pieces = match interpolation {
            Interpolation::Linear => linear_pieces(&times_s, &values),
            Interpolation::Spline => {
                let ends = ends_m_s2.map(|a| Vector6::new(a.x, a.y, a.z, 0.0, 0.0, 0.0));
                spline_pieces(&times_s, &values, ends, after.end())
            }
        };
        let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
        let (first_s, last_s) = (times_s[0], times_s[times_s.len() - 1]);
        let ends = [motion_of(first, first, first_s), motion_of(last, last, last_s)];
        let last_rates_rad_s = last.rate(last_s).fixed_rows::<3>(3).into_owned();
        let differences = (interpolation == Interpolation::Linear).then(|| Differences::new(&times_s, &values, after));
        Ok(TablePath { stations, interpolation, after, ends_m_s2, pieces, differences, ends, last_rates_rad_s })
    }

    /// The same path with accelerations, those of its angles too, times `strength`: place, angles and their rates at the first time stay.
    ///
    /// # Errors
    /// As [`TablePath::new`]: a strength that is not finite, or so large that angles jump.
    pub fn with_strength(&self, strength: f64) -> Result<Self, Vec<PathProblem>> {
        let first = &self.stations[0];
        let (from_s, start, rate) = (first.time_s, first.channels(), self.pieces[0].rate(first.time_s));
        let scaled = |station: &Station| {
            let steady = start + rate * (station.time_s - from_s);
            let v = steady + (station.channels() - steady) * strength;
            Station::new(station.time_s, [v[0], v[1], v[2]], [v[3], v[4], v[5]])
        };
        let ends_m_s2 = self.ends_m_s2.map(|a| a * strength);
        TablePath::between(self.stations.iter().map(scaled).collect(), ends_m_s2, self.interpolation, self.after)
    }

    /// The same path with the changes of its velocity turned about the vertical by `turn_rad`, to the right; angles stay.
    ///
    /// # Errors
    /// As [`TablePath::new`].
    pub fn turned(&self, turn_rad: f64) -> Result<Self, Vec<PathProblem>> {
        let first = &self.stations[0];
        let (from_s, start) = (first.time_s, first.pose.position_m);
        let speed_m_s = self.pieces[0].rate(from_s).fixed_rows::<3>(0).into_owned();
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad);
        let station = |station: &Station| {
            let steady = start + speed_m_s * (station.time_s - from_s);
            let place = steady + turn * (station.pose.position_m - steady);
            Station { pose: VehiclePose { position_m: place, ..station.pose }, ..*station }
        };
        let ends_m_s2 = self.ends_m_s2.map(|a| turn * a);
        TablePath::between(self.stations.iter().map(station).collect(), ends_m_s2, self.interpolation, self.after)
    }

    /// The stations.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// Interpolation between them.
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// Motion after the last one.
    pub fn after(&self) -> AfterEnd {
        self.after
    }

    /// Times of the first and the last station, s.
    pub fn span_s(&self) -> (f64, f64) {
        (self.stations[0].time_s, self.stations[self.stations.len() - 1].time_s)
    }

    /// Pose and motion at `t_s`, in space axes.
    ///
    /// The pose is the interpolant at `t_s` itself. Velocities differentiate the interpolant: of a spline at `t_s`; of
    /// straight lines in the interval that contains `step_middle_s`, so that one integration step sees one velocity
    /// even where it begins or ends at a station. Outside the stations the vehicle coasts, or is at rest if the path
    /// says so; it is at rest in the steps whose middle is past the last station.
    pub(crate) fn motion(&self, t_s: f64, step_middle_s: f64, cursor: &mut PathCursor) -> FrameMotion {
        let (first_s, last_s) = self.span_s();
        let inside_s = t_s.clamp(first_s, last_s);
        let place = self.piece_at(inside_s, cursor);
        let pace = match self.interpolation {
            Interpolation::Linear => self.piece_at(step_middle_s, cursor),
            Interpolation::Spline => place,
        };
        let mut motion = motion_of(place, pace, inside_s);
        if t_s != inside_s {
            let end = &self.ends[usize::from(t_s > last_s)];
            let stands = t_s > last_s && self.after == AfterEnd::Hold;
            let carried = if stands { end.held() } else { end.coasted(t_s - inside_s) };
            motion = FrameMotion {
                velocity_m_s: motion.velocity_m_s,
                angular_velocity_rad_s: motion.angular_velocity_rad_s,
                ..carried
            };
        }
        if self.after == AfterEnd::Hold && step_middle_s > last_s { motion.held() } else { motion }
    }

    /// The motion at `t_s` with accelerations by differences, for linear interpolation.
    pub(super) fn with_differences(&self, t_s: f64, motion: FrameMotion, cursor: &mut PathCursor) -> FrameMotion {
        let Some(differences) = &self.differences else { return motion };
        let (first_s, last_s) = self.span_s();
        let piece = self.piece_at(t_s.clamp(first_s, last_s), cursor);
        let mut state = state_of(piece, piece, t_s.clamp(first_s, last_s));
        let seconds = differences.at(t_s);
        state.acceleration_m_s2 = seconds.fixed_rows::<3>(0).into_owned();
        state.angle_accelerations_rad_s2 = seconds.fixed_rows::<3>(3).into_owned();
        let FrameMotion { acceleration_m_s2, angular_acceleration_rad_s2, .. } = state.motion();
        FrameMotion { acceleration_m_s2, angular_acceleration_rad_s2, ..motion }
    }

    /// Position and attitude at `t_s` from the table, for output.
    pub(crate) fn pose(&self, t_s: f64, cursor: &mut PathCursor) -> VehiclePose {
        let (first_s, last_s) = self.span_s();
        let inside_s = t_s.clamp(first_s, last_s);
        let values = self.piece_at(inside_s, cursor).value(inside_s);
        let angles = values.fixed_rows::<3>(3).into_owned();
        let pose =
            VehiclePose { position_m: values.fixed_rows::<3>(0).into_owned(), attitude: Attitude::from_vector(angles) };
        if t_s == inside_s || (t_s > last_s && self.after == AfterEnd::Hold) {
            return pose;
        }
        let near = Attitude::from_vector(angles + self.last_rates_rad_s * (t_s - last_s).max(0.0));
        self.ends[usize::from(t_s > last_s)].coasted(t_s - inside_s).pose(&near)
    }

    /// Whether the path has an answer from `start_s` to `end_s`.
    ///
    /// # Errors
    /// A run that starts before the first station, or ends past the last one without saying what comes after.
    pub(crate) fn check_span(&self, start_s: f64, end_s: f64) -> Result<(), PathProblem> {
        self.after.check_span(self.span_s(), start_s, end_s)
    }

    /// Times at which the velocity or the acceleration jumps, s, in increasing order.
    pub(crate) fn breaks_s(&self) -> Vec<f64> {
        match self.interpolation {
            Interpolation::Linear => self.stations.iter().map(|station| station.time_s).collect(),
            Interpolation::Spline => vec![self.span_s().0, self.span_s().1],
        }
    }

    fn piece_at(&self, t_s: f64, cursor: &mut PathCursor) -> &Piece {
        &self.pieces[cursor.locate(self.pieces.len(), t_s, |piece| self.pieces[piece].start_s)]
    }
}

/// Motion at `t_s`: pose from the piece `place`, derivatives from the piece `pace`.
fn motion_of(place: &Piece, pace: &Piece, t_s: f64) -> FrameMotion {
    state_of(place, pace, t_s).motion()
}

fn state_of(place: &Piece, pace: &Piece, t_s: f64) -> VehicleState {
    let (values, rates, seconds) = (place.value(t_s), pace.rate(t_s), pace.second_rate(t_s));
    let linear = |channels: &Vector6<f64>| channels.fixed_rows::<3>(0).into_owned();
    let angular = |channels: &Vector6<f64>| channels.fixed_rows::<3>(3).into_owned();
    VehicleState {
        pose: VehiclePose { position_m: linear(&values), attitude: Attitude::from_vector(angular(&values)) },
        velocity_m_s: linear(&rates),
        acceleration_m_s2: linear(&seconds),
        angle_rates_rad_s: angular(&rates),
        angle_accelerations_rad_s2: angular(&seconds),
    }
}

#[cfg(test)]
#[path = "tests/table.rs"]
mod tests;
