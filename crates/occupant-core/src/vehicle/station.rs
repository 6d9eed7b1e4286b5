//! Stations of a table: the vehicle's position and attitude at given times, and their checks.

use std::f64::consts::PI;

use nalgebra::{Vector3, Vector6};

use super::VehiclePose;
use super::attitude::Attitude;
use super::problem::{PathProblem, check_row};

/// Position and attitude of the vehicle at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Time, s.
    pub time_s: f64,
    /// Pose; its angles continue beyond ±180° (unwrapped).
    pub pose: VehiclePose,
}

impl Station {
    /// A station at `time_s` (s) from (x, y, z) in vehicle-space (m) and (roll, pitch, yaw) (rad).
    pub fn new(time_s: f64, position_m: [f64; 3], roll_pitch_yaw_rad: [f64; 3]) -> Self {
        let attitude = Attitude::from_vector(Vector3::from(roll_pitch_yaw_rad));
        Station { time_s, pose: VehiclePose { position_m: Vector3::from(position_m), attitude } }
    }

    /// (x, y, z, roll, pitch, yaw).
    pub(super) fn channels(&self) -> Vector6<f64> {
        let (place, angles) = (self.pose.position_m, self.pose.attitude.to_vector());
        Vector6::new(place.x, place.y, place.z, angles.x, angles.y, angles.z)
    }
}

/// Largest magnitude of a time, position or angle, s, m and rad: positions beyond it lose the digits that forces need.
const LARGEST: f64 = 1e8;

const COLUMNS: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];

/// Adds multiples of 360° (or takes the equivalent attitude) to the angles of `stations`, so that each is nearest to
/// the one before it. For tables with angles between −180° and 180°.
pub fn unwrap_angles(stations: &mut [Station]) {
    for i in 1..stations.len() {
        stations[i].pose.attitude = stations[i].pose.attitude.unwrapped_after(&stations[i - 1].pose.attitude);
    }
}

/// All problems of `stations`, in their order.
pub(super) fn problems_of(stations: &[Station]) -> Vec<PathProblem> {
    let mut problems = Vec::new();
    if stations.len() < 2 {
        problems.push(PathProblem::too_few_stations(stations.len()));
    }
    for (station, here) in stations.iter().enumerate() {
        let values = here.channels();
        let numbers = COLUMNS.into_iter().zip(values.iter().copied());
        let previous = station.checked_sub(1).map(|before| &stations[before]);
        check_row(&mut problems, station, here.time_s, previous.map(|p| p.time_s), numbers, LARGEST);
        if let Some(previous) = previous {
            compare_with_previous(station, previous, here, &mut problems);
        }
    }
    problems
}

/// Problems of a station relative to the one before it.
fn compare_with_previous(station: usize, previous: &Station, here: &Station, problems: &mut Vec<PathProblem>) {
    let (before, now) = (previous.channels(), here.channels());
    let length_s = here.time_s - previous.time_s;
    for (channel, quantity) in COLUMNS.into_iter().enumerate() {
        let (from, to) = (before[channel], now[channel]);
        if !(to - from).is_finite() {
            continue;
        }
        // The second derivatives of a spline divide by the time twice.
        if length_s > 0.0 && !((to - from) / length_s / length_s).is_finite() {
            let found =
                format_args!("{quantity} changes too much since the station before for its rate to be a number");
            problems.push(PathProblem::at(station, found, "stations farther apart in time"));
        }
        if channel >= 3 && (to - from).abs() > PI {
            let found = format_args!("{quantity} goes from {:.3}° to {:.3}°", from.to_degrees(), to.to_degrees());
            let expected = "less than half a turn between stations; unwrap the angles (add or take whole turns) or give more \
                            stations";
            problems.push(PathProblem::at(station, found, expected));
        }
    }
}
