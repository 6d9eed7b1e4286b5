//! From a record to the integrated readings: zero offsets subtracted, filtered, cut to the start.

use nalgebra::Vector3;

use super::record::{ACCELERATIONS, AccelerationRecord, RATES, SensorRecord, check_turning};
use super::{Baseline, SensorDefinition, SensorGravity, delta_v};
use crate::vehicle::problem::PathProblem;
use crash_measures::signal::{CfcFamily, ChannelClass, SignalError, filter_cfc, uniform_interval};

/// Readings at the nodes of the integration, in vehicle axes. Rates are linear between nodes, accelerations are
/// parabolas through both ends and the middle.
pub(super) struct Readings {
    /// Times of the nodes, s.
    pub time_s: Vec<f64>,
    /// Accelerations at the nodes, m/s².
    pub acceleration_m_s2: Vec<Vector3<f64>>,
    /// Accelerations in the middle of each interval, m/s².
    pub middle_m_s2: Vec<Vector3<f64>>,
    /// Rates at the nodes, rad/s.
    pub rate_rad_s: Vec<Vector3<f64>>,
    /// Presence of the accelerations in the record.
    pub present: [bool; 3],
}

/// The readings of a definition's record.
///
/// # Errors
/// All problems of the record, or of its options.
pub(super) fn read(definition: &SensorDefinition) -> Result<Readings, Vec<PathProblem>> {
    let mut problems = definition.record.problems();
    let start_s = start(definition, &mut problems);
    if !problems.is_empty() {
        return Err(problems);
    }
    let mut readings = match &definition.record {
        SensorRecord::DeltaV(record) => delta_v::read(record, start_s),
        SensorRecord::Accelerations(record) => {
            let mut record = record.clone();
            take_baseline(definition, &mut record).map_err(|p| vec![p])?;
            if let Some(class) = definition.filter {
                filter(&mut record, class)?;
            }
            let norms: Vec<f64> = (0..record.time_s.len()).map(|i| triple(&record.rate_rad_s, i).norm()).collect();
            check_turning(&record.time_s, &norms, &mut problems);
            if problems.is_empty() { Ok(cut(&record, start_s)) } else { Err(problems) }
        }
    }?;
    if definition.strength != 1.0 {
        // accelerations are scaled where gravity has left them; the rate at the start is a part of the initial state
        let first = readings.rate_rad_s[0];
        readings.rate_rad_s.iter_mut().for_each(|rate| *rate = first + (*rate - first) * definition.strength);
    }
    Ok(readings)
}

/// Start of the path: within the record, with a sample after it.
fn start(definition: &SensorDefinition, problems: &mut Vec<PathProblem>) -> f64 {
    let time_s = definition.record.time_s();
    let (Some(&first_s), Some(&last_s)) = (time_s.first(), time_s.last()) else {
        return 0.0;
    };
    let start_s = definition.starts_at_s.unwrap_or(first_s);
    if !(start_s >= first_s && start_s < last_s) && time_s.len() > 1 {
        let expected = format!("a time of the record, from {first_s} s to before {last_s} s");
        problems.push(PathProblem::new(format!("the path starts at {start_s} s"), expected));
    }
    start_s
}

/// Subtracts the zero errors: the mean reading of each channel over the rest at the beginning, less the true value
/// there.
fn take_baseline(definition: &SensorDefinition, record: &mut AccelerationRecord) -> Result<(), PathProblem> {
    let Some(baseline_s) = definition.baseline_s else {
        return Ok(());
    };
    let AccelerationRecord { time_s, acceleration_m_s2, rate_rad_s } = record;
    let ends = Baseline::of(time_s, baseline_s, definition.baseline_end_s)?;
    let rest = match definition.gravity {
        // at rest: f = −Aᵀ g, z down
        SensorGravity::Included => {
            -definition.initial.attitude.matrix().tr_mul(&Vector3::new(0.0, 0.0, definition.gravity_m_s2))
        }
        SensorGravity::Zeroed | SensorGravity::Removed => Vector3::zeros(),
    };
    for axis in 0..3 {
        for (channel, should_read) in [(&mut acceleration_m_s2[axis], rest[axis]), (&mut rate_rad_s[axis], 0.0)] {
            if let Some(samples) = channel {
                ends.take(time_s, samples, should_read);
            }
        }
    }
    Ok(())
}

fn filter(record: &mut AccelerationRecord, class: ChannelClass) -> Result<(), Vec<PathProblem>> {
    let dt_s = uniform_interval(&record.time_s).map_err(|e| vec![problem_of(&e, "t")])?;
    let accelerations = ACCELERATIONS.into_iter().zip(&mut record.acceleration_m_s2);
    let rates = RATES.into_iter().zip(&mut record.rate_rad_s);
    for (name, channel) in accelerations.chain(rates) {
        if let Some(samples) = channel {
            *samples =
                filter_cfc(samples, dt_s, class, CfcFamily::default()).map_err(|e| vec![problem_of(&e, name)])?;
        }
    }
    Ok(())
}

/// Problem of a path from a filter's error.
fn problem_of(error: &SignalError, quantity: &'static str) -> PathProblem {
    match *error {
        SignalError::NotUniform { index, found_s, expected_s } => {
            let expected = format!(
                "{expected_s} s, for a filter needs samples evenly spaced in time; resample the record, or leave `filter` out"
            );
            PathProblem::at(index, format_args!("found t = {found_s} s"), expected)
        }
        SignalError::CornerAboveNyquist { corner_hz, nyquist_hz } => {
            let expected = format!(
                "less than half the sample rate, {nyquist_hz:.1} Hz; use a lower class or a record with more samples a \
                 second, or leave `filter` out"
            );
            PathProblem::new(format!("the filter's corner is {corner_hz:.1} Hz"), expected)
        }
        SignalError::NotFinite { index, found, .. } => PathProblem::not_finite_at(index, quantity, found),
        _ => PathProblem::not_finite(quantity, f64::NAN),
    }
}

/// The record from `start_s` on; the sample there is interpolated linearly.
fn cut(record: &AccelerationRecord, start_s: f64) -> Readings {
    let after = record.time_s.partition_point(|&t| t <= start_s);
    let before = after - 1;
    let part = (start_s - record.time_s[before]) / (record.time_s[after] - record.time_s[before]);
    let nodes = |channels: &[Option<Vec<f64>>; 3]| -> Vec<Vector3<f64>> {
        let (low, high) = (triple(channels, before), triple(channels, after));
        std::iter::once(low + (high - low) * part)
            .chain((after..record.time_s.len()).map(|i| triple(channels, i)))
            .collect()
    };
    let acceleration_m_s2 = nodes(&record.acceleration_m_s2);
    Readings {
        time_s: std::iter::once(start_s).chain(record.time_s[after..].iter().copied()).collect(),
        middle_m_s2: acceleration_m_s2.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5).collect(),
        acceleration_m_s2,
        rate_rad_s: nodes(&record.rate_rad_s),
        present: [0, 1, 2].map(|axis| record.acceleration_m_s2[axis].is_some()),
    }
}

/// Sample `i` of three channels; missing channels are zero.
fn triple(channels: &[Option<Vec<f64>>; 3], i: usize) -> Vector3<f64> {
    Vector3::from_fn(|axis, _| channels[axis].as_ref().map_or(0.0, |samples| samples[i]))
}
