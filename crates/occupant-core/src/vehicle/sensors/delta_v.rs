//! From velocity changes to accelerations: the derivative of the monotone cubic through the recorded points.
//!
//! Monotone cubics neither overshoot nor give an acceleration where the recorded velocity is level, and their integral is
//! the record again. What happens between two points, 10 ms apart in most recorders, they cannot know.

use nalgebra::Vector3;

use super::readings::Readings;
use super::record::{DeltaVRecord, check_turning};
use crate::vehicle::problem::PathProblem;
use crash_measures::signal::{Interpolant, Interpolation, SignalError};

/// Longest interval of the integration, s.
const LONGEST_S: f64 = 1e-3;
/// Most intervals of the integration between two points of the record.
const MOST_PARTS: f64 = 1e4;

/// The readings from `start_s` on. The record has been checked.
///
/// # Errors
/// Points too far apart for the yaw rate.
pub(super) fn read(record: &DeltaVRecord, start_s: f64) -> Result<Readings, Vec<PathProblem>> {
    let mut problems = Vec::new();
    if let Some(yaw) = &record.yaw_rate_rad_s {
        let norms: Vec<f64> = yaw.iter().map(|rate| rate.abs()).collect();
        check_turning(&record.time_s, &norms, &mut problems);
    }
    if !problems.is_empty() {
        return Err(problems);
    }
    let channels = Channels::new(record)
        .map_err(|_| vec![PathProblem::not_finite("velocity change", f64::NAN)])?;
    let time_s = nodes(&record.time_s, start_s);
    let at_nodes = |f: &dyn Fn(f64) -> Vector3<f64>| time_s.iter().map(|&t| f(t)).collect();
    Ok(Readings {
        acceleration_m_s2: at_nodes(&|t| channels.acceleration_m_s2(t)),
        rate_rad_s: at_nodes(&|t| channels.rate_rad_s(t)),
        middle_m_s2: time_s.windows(2).map(|pair| channels.acceleration_m_s2(0.5 * (pair[0] + pair[1]))).collect(),
        present: [true; 3],
        time_s,
    })
}

/// The channels between their points.
struct Channels<'a> {
    longitudinal: Option<Interpolant<'a>>,
    lateral: Option<Interpolant<'a>>,
    yaw_rate: Option<Interpolant<'a>>,
}

impl<'a> Channels<'a> {
    fn new(record: &'a DeltaVRecord) -> Result<Self, SignalError> {
        let through = |channel: &'a Option<Vec<f64>>, shape| {
            let samples = channel.as_deref();
            samples.map(|samples| Interpolant::new(&record.time_s, samples, shape)).transpose()
        };
        Ok(Channels {
            longitudinal: through(&record.longitudinal_m_s, Interpolation::MonotoneCubic)?,
            lateral: through(&record.lateral_m_s, Interpolation::MonotoneCubic)?,
            yaw_rate: through(&record.yaw_rate_rad_s, Interpolation::Linear)?,
        })
    }

    fn acceleration_m_s2(&self, t_s: f64) -> Vector3<f64> {
        let slope = |channel: &Option<Interpolant<'_>>| {
            let channel = channel.as_ref();
            channel.map_or(0.0, |through| through.slope_at(t_s))
        };
        Vector3::new(slope(&self.longitudinal), slope(&self.lateral), 0.0)
    }

    fn rate_rad_s(&self, t_s: f64) -> Vector3<f64> {
        let yaw_rate = self.yaw_rate.as_ref();
        Vector3::new(0.0, 0.0, yaw_rate.map_or(0.0, |through| through.value_at(t_s)))
    }
}

/// Times of the nodes: `start_s`, the later points of the record, and between them as many as keep intervals short.
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
