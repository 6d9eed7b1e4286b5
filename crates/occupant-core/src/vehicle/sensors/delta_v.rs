//! From velocity changes to accelerations: the derivative of the monotone cubic through the recorded points.
//!
//! Monotone cubics do not overshoot and give no acceleration where the recorded velocity is constant, and their
//! integral is the record again. The motion between two points, 10 ms apart in most recorders, is unknown.

use nalgebra::Vector3;

use super::readings::Readings;
use super::record::{DeltaVRecord, check_turning};
use crate::vehicle::problem::PathProblem;
use crash_measures::signal::{Interpolant, Interpolation};

/// Longest interval of the integration, s.
const LONGEST_S: f64 = 1e-3;
/// Largest number of intervals of the integration between two points of the record.
const MOST_PARTS: f64 = 1e4;

/// The readings from `start_s` on. The record has been checked.
///
/// # Errors
/// Points too far apart for the yaw rate.
pub(super) fn read<'r>(record: &'r DeltaVRecord, start_s: f64) -> Result<Readings, Vec<PathProblem>> {
    let mut problems = Vec::new();
    if let Some(yaw) = &record.yaw_rate_rad_s {
        let norms: Vec<f64> = yaw.iter().map(|rate| rate.abs()).collect();
        check_turning(&record.time_s, &norms, &mut problems);
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    let through = |channel: &'r Option<Vec<f64>>, shape| {
        let through = channel.as_deref().map(|samples| Interpolant::new(&record.time_s, samples, shape)).transpose();
        through.map_err(|_| vec![PathProblem::not_finite("velocity change", f64::NAN)])
    };
    let longitudinal = through(&record.longitudinal_m_s, Interpolation::MonotoneCubic)?;
    let lateral = through(&record.lateral_m_s, Interpolation::MonotoneCubic)?;
    let yaw_rate = through(&record.yaw_rate_rad_s, Interpolation::Linear)?;
    let slope = |channel: &Option<Interpolant>, t_s| channel.as_ref().map_or(0.0, |through| through.slope_at(t_s));
    let acceleration_m_s2 = |t_s| Vector3::new(slope(&longitudinal, t_s), slope(&lateral, t_s), 0.0);
    let yaw_rad_s = |t_s| yaw_rate.as_ref().map_or(0.0, |through| through.value_at(t_s));
    let time_s = nodes(&record.time_s, start_s);
    Ok(Readings {
        acceleration_m_s2: time_s.iter().map(|&t_s| acceleration_m_s2(t_s)).collect(),
        rate_rad_s: time_s.iter().map(|&t_s| Vector3::new(0.0, 0.0, yaw_rad_s(t_s))).collect(),
        middle_m_s2: time_s.windows(2).map(|pair| acceleration_m_s2(0.5 * (pair[0] + pair[1]))).collect(),
        present: [true; 3],
        time_s,
    })
}

/// Times of the nodes: `start_s`, the later points of the record, and as many between as keep the intervals short.
fn nodes(stations_s: &[f64], start_s: f64) -> Vec<f64> {
    let mut nodes = vec![start_s];
    for &end_s in stations_s.iter().filter(|&&t| t > start_s) {
        let from_s = nodes[nodes.len() - 1];
        let length_s = end_s - from_s;
        let parts = (length_s / LONGEST_S).ceil().clamp(1.0, MOST_PARTS);
        for part in 1..parts as usize {
            nodes.push(from_s + length_s * (part as f64 / parts));
        }
        nodes.push(end_s);
    }
    nodes.dedup();
    nodes
}
