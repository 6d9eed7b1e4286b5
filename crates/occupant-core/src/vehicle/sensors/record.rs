//! A record, and its checks.

use std::f64::consts::FRAC_PI_2;

use crate::vehicle::problem::{PathProblem, check_row};

/// Content of a record.
#[derive(Clone, Debug, PartialEq)]
pub enum SensorRecord {
    /// Accelerations and angular rates.
    Accelerations(AccelerationRecord),
    /// Velocity changes, as event data recorders keep them.
    DeltaV(DeltaVRecord),
}

/// Accelerations and rates along the vehicle's axes (x forward, y right, z down). All channels are as long as `time_s`.
///
/// A channel that is not there is a motion that is not there: without an acceleration the place of the sensors has none
/// along that axis, whatever gravity does; without a rate the vehicle does not turn about it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AccelerationRecord {
    /// Times, increasing, s.
    pub time_s: Vec<f64>,
    /// Along x, y, z, m/s².
    pub acceleration_m_s2: [Option<Vec<f64>>; 3],
    /// About x, y, z (roll, pitch, yaw rate), rad/s.
    pub rate_rad_s: [Option<Vec<f64>>; 3],
}

/// Velocity changes along the vehicle's axes from any instant, and the yaw rate. Missing channels are zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeltaVRecord {
    /// Times, increasing, s.
    pub time_s: Vec<f64>,
    /// ∫a_x dt, m/s: negative for a decelerated vehicle.
    pub longitudinal_m_s: Option<Vec<f64>>,
    /// ∫a_y dt, to the right, m/s.
    pub lateral_m_s: Option<Vec<f64>>,
    /// Yaw rate, to the right, rad/s.
    pub yaw_rate_rad_s: Option<Vec<f64>>,
}

/// Names of accelerations and rates in messages.
pub(super) const ACCELERATIONS: [&str; 3] = ["ax", "ay", "az"];
pub(super) const RATES: [&str; 3] = ["wx", "wy", "wz"];

impl SensorRecord {
    /// Times of the samples, s.
    pub fn time_s(&self) -> &[f64] {
        match self {
            SensorRecord::Accelerations(record) => &record.time_s,
            SensorRecord::DeltaV(record) => &record.time_s,
        }
    }

    /// Names and samples of the present channels.
    pub fn channels(&self) -> Vec<(&'static str, &[f64])> {
        let all: Vec<(&'static str, &Option<Vec<f64>>)> = match self {
            SensorRecord::Accelerations(record) => ACCELERATIONS
                .into_iter()
                .zip(&record.acceleration_m_s2)
                .chain(RATES.into_iter().zip(&record.rate_rad_s))
                .collect(),
            SensorRecord::DeltaV(record) => {
                vec![("dvx", &record.longitudinal_m_s), ("dvy", &record.lateral_m_s), ("wz", &record.yaw_rate_rad_s)]
            }
        };
        let there = all.into_iter();
        there.filter_map(|(name, channel)| Some((name, channel.as_deref()?))).collect()
    }

    /// All problems of the samples, in their order.
    pub(super) fn problems(&self) -> Vec<PathProblem> {
        let (time_s, channels) = (self.time_s(), self.channels());
        let mut problems = Vec::new();
        if channels.is_empty() {
            let expected = "accelerations, rates or velocity changes";
            problems.push(PathProblem::new("found no channel that moves the vehicle", expected));
        }
        if time_s.len() < 2 {
            problems.push(PathProblem::too_few_stations(time_s.len()));
        }
        for (quantity, samples) in &channels {
            if samples.len() != time_s.len() {
                let found = format!("found {} samples of {quantity}", samples.len());
                problems.push(PathProblem::new(found, format!("{}, one for each time", time_s.len())));
            }
        }
        for (station, &here_s) in time_s.iter().enumerate() {
            let numbers = channels.iter().filter_map(|(name, samples)| Some((*name, *samples.get(station)?)));
            let previous_s = station.checked_sub(1).map(|before| time_s[before]);
            check_row(&mut problems, station, here_s, previous_s, numbers, LARGEST);
        }
        problems
    }
}

/// The largest magnitude of a sample; sums and products of such numbers stay finite.
const LARGEST: f64 = 1e60;

/// Adds a problem for every interval in which the vehicle rotates by more than 90°: linear interpolation between such
/// samples is meaningless.
pub(super) fn check_turning(time_s: &[f64], rate_norms_rad_s: &[f64], problems: &mut Vec<PathProblem>) {
    for station in 1..time_s.len() {
        let mean_rad_s = 0.5 * (rate_norms_rad_s[station - 1] + rate_norms_rad_s[station]);
        let turn_rad = mean_rad_s * (time_s[station] - time_s[station - 1]);
        if turn_rad > FRAC_PI_2 {
            let found = format_args!("the vehicle turns by {:.1}° since the sample before", turn_rad.to_degrees());
            let expected = "at most 90°; give rates in their true unit, or more samples";
            problems.push(PathProblem::at(station, found, expected));
        }
    }
}
