//! The motion sheet: position, angles and speed of each vehicle and of each segment, every 1/20 s.
//!
//! All are in vehicle-space (SAE J670: X forward, Y right, Z down), with the angles of a vehicle: yaw to the right, then
//! pitch, nose up, then roll, right side down. A segment that is fixed to a vehicle, upright and looking forward, has the
//! angles of the vehicle.

use std::fmt::Write as _;

use crate::base::Failure;
use crate::risk::vehicles;
use nalgebra::{Matrix3, Vector3};
use occupant_core::body::Segment;
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::Model;
use occupant_core::results::sample::Sample;
use occupant_core::vehicle::{Attitude, PathCursor, VehiclePose};
use occupant_files::results::{Results, nearest};

/// Name of the part with the sheet.
pub(super) const MOTION: &str = "motion.csv";

/// Interval of the rows, s.
const INTERVAL_S: f64 = 0.05;
/// Columns of a row.
pub(super) const COLUMNS: [&str; 9] =
    ["part", "time_s", "x_m", "y_m", "z_m", "yaw_deg", "pitch_deg", "roll_deg", "speed_m_s"];

/// A part at one time.
pub(super) struct Row {
    pub part: String,
    pub time_s: f64,
    /// In the order of the columns; none where there is no number.
    pub values: [Option<f64>; 7],
}

/// Rows by part, then time.
pub(super) struct Sheet(pub Vec<Row>);

impl Sheet {
    /// The table as CSV, numbers with all their digits, empty where there is none.
    pub(super) fn csv(&self) -> String {
        let mut text = COLUMNS.join(",") + "\n";
        for Row { part, time_s, values } in &self.0 {
            _ = write!(text, "\"{}\",{time_s}", part.replace('"', "\"\""));
            values.iter().for_each(|value| _ = write!(text, ",{}", shown(*value, |x| x.to_string())));
            text.push('\n');
        }
        text
    }
}

/// A number as text; an empty one without it.
pub(super) fn shown(value: Option<f64>, as_text: impl Fn(f64) -> String) -> String {
    value.map(as_text).unwrap_or_default()
}

/// What has a motion.
#[derive(Clone, Copy)]
enum Part {
    Vehicle(Frame),
    Segment(Segment),
}

/// A part, its rows so far, and its last angles, which the next continue.
struct Track {
    name: String,
    part: Part,
    last: Option<Attitude>,
    rows: Vec<Row>,
}

/// Of each output nearest to a multiple of the interval.
pub(super) fn sheet(results: &Results) -> Result<Sheet, Failure> {
    let times_s: Vec<f64> = results.checkpoints.iter().map(|checkpoint| checkpoint.time_s).collect();
    let (rows, mut tracks, mut at) = (rows(&times_s), tracks(&results.model), 0);
    results.watch(|sample| {
        let is_row = rows.contains(&at);
        tracks.iter_mut().for_each(|track| track.follow(sample, is_row));
        at += 1;
    })?;
    Ok(Sheet(tracks.into_iter().flat_map(|track| track.rows).collect()))
}

/// Vehicles, then segments.
fn tracks(model: &Model) -> Vec<Track> {
    let frames = &model.setup().frames;
    let frame = |name: &str| frames.iter().position(|f| f.name == name).map_or(Frame::Vehicle, Frame::Other);
    let named = |name: &str| match frame(name) {
        Frame::Vehicle => name.to_owned(),
        _ => format!("vehicle.{name}"),
    };
    let track = |name, part| Track { name, part, last: None, rows: Vec::new() };
    let tree = &model.body().tree;
    let segments = tree.segments().zip(tree.segment_rows());
    let vehicles = vehicles(model.setup()).into_iter().map(|name| track(named(name), Part::Vehicle(frame(name))));
    vehicles.chain(segments.map(|(segment, row)| track(row.name.to_string(), Part::Segment(segment)))).collect()
}

impl Track {
    fn follow(&mut self, sample: &Sample<'_>, is_row: bool) {
        let (pose, speed_m_s) = match self.part {
            Part::Vehicle(frame) => (pose_of(sample, frame), sample.frame(frame).velocity_m_s.norm()),
            Part::Segment(segment) => (self.segment(sample, segment), sample.cg_velocity_m_s(segment).norm()),
        };
        self.last = Some(pose.attitude);
        if is_row {
            let (place, Attitude { roll_rad, pitch_rad, yaw_rad }) = (pose.position_m, pose.attitude);
            let [yaw, pitch, roll] = [yaw_rad, pitch_rad, roll_rad].map(f64::to_degrees);
            let values = [place.x, place.y, place.z, yaw, pitch, roll, speed_m_s];
            let values = values.map(|value| Some(value).filter(|value| value.is_finite()));
            self.rows.push(Row { part: self.name.clone(), time_s: sample.time_s, values });
        }
    }

    /// Centre of gravity and angles of a segment; the first angles are those nearest to the vehicle's.
    fn segment(&self, sample: &Sample<'_>, segment: Segment) -> VehiclePose {
        let of = sample.model.body().tree.body_of(segment);
        let home = sample.model.setup().members.get(of).map_or(Frame::Vehicle, |member| member.home);
        let near = self.last.unwrap_or_else(|| pose_of(sample, home).attitude);
        let place = sample.homes[of].point_to_space(sample.cg_m(segment).coords);
        let rotation = sample.frame(Frame::Segment(segment.index())).rotation;
        VehiclePose { position_m: down(place), attitude: attitude(&rotation, &near) }
    }
}

/// Pose of a vehicle as its path gives it; that of the first for any other frame.
fn pose_of(sample: &Sample<'_>, frame: Frame) -> VehiclePose {
    match frame {
        Frame::Other(i) => sample.model.setup().frames[i].path.attitude(sample.time_s, &mut PathCursor::default()),
        _ => sample.vehicle_pose,
    }
}

/// From axes forward, left, up to those forward, right, down.
fn down(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, -v.y, -v.z)
}

/// Angles in vehicle-space of a segment whose axes (forward, left, up) `rotation` turns into space axes.
fn attitude(rotation: &Matrix3<f64>, near: &Attitude) -> Attitude {
    // A = F R F with F = diag(1, −1, −1) of Eq. 81, on both sides
    let turned = rotation.map_with_location(|i, j, x| if (i == 0) == (j == 0) { x } else { -x });
    Attitude::from_matrix(&turned, near)
}

/// Indices of the outputs nearest to the multiples of the interval since the start, the last output included.
fn rows(times_s: &[f64]) -> Vec<usize> {
    let (Some(start), Some(end)) = (times_s.first(), times_s.last()) else { return Vec::new() };
    let count = ((end - start) / INTERVAL_S + 1e-9).floor() as usize;
    let mut rows: Vec<usize> = (0..=count).map(|i| nearest(times_s, start + i as f64 * INTERVAL_S)).collect();
    rows.push(times_s.len() - 1);
    rows.dedup();
    rows
}

#[cfg(test)]
mod tests {
    use super::*;
    use occupant_core::vehicle::{AfterEnd, Interpolation, Station, TablePath, VehiclePath};

    #[test]
    fn the_outputs_nearest_to_twentieths_of_a_second_and_the_last_are_taken() {
        let times: Vec<f64> = (0..=40).map(|i| i as f64 * 0.003).collect();
        assert_eq!(rows(&times), [0, 17, 33, 40]);
        assert_eq!(rows(&[0.0]), [0]);
        assert!(rows(&[]).is_empty());
    }

    /// Beyond half a turn too.
    #[test]
    fn a_segment_fixed_to_the_vehicle_has_the_angles_of_the_vehicle() {
        let angles = [[0.1, -0.2, 0.3], [-0.4, 0.5, 2.0], [-1.2, 0.2, 4.5], [-4.0, -0.3, 7.0]];
        let stations = angles.iter().enumerate().map(|(i, a)| Station::new(i as f64, [9.0 * i as f64, 0.0, 0.0], *a));
        let table = TablePath::new(stations.collect(), Interpolation::Linear, AfterEnd::Error).expect("a path");
        let (path, cursor) = (VehiclePath::Table(table), &mut PathCursor::default());
        let (mut near, mut worst) = (path.attitude(0.0, cursor).attitude, 0.0_f64);
        for i in 0..=300 {
            let time_s = f64::from(i) / 100.0;
            let wanted = path.attitude(time_s, cursor).attitude;
            // forward, left, up of a segment in the axes of the vehicle: forward, right, down
            let upright = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
            near = attitude(&(path.motion(time_s, time_s, cursor).rotation * upright), &near);
            let off =
                [near.yaw_rad - wanted.yaw_rad, near.pitch_rad - wanted.pitch_rad, near.roll_rad - wanted.roll_rad];
            worst = off.iter().fold(worst, |worst, off| worst.max(off.abs()));
        }
        assert!(worst < 1e-14, "{worst} rad"); // 8.9e-16
    }

    #[test]
    fn a_missing_number_is_an_empty_cell() {
        let values = [Some(1.5), None, Some(-0.25), None, None, None, Some(0.0)];
        let sheet = Sheet(vec![Row { part: "a \"b\"".to_owned(), time_s: 0.05, values }]);
        assert_eq!(sheet.csv().lines().nth(1), Some("\"a \"\"b\"\"\",0.05,1.5,,-0.25,,,,0"));
    }
}
