//! Largest roll, pitch and yaw.

use nalgebra::Vector3;

use super::VehicleSignals;
use super::missing::{Measured, Missing};
use crash_measures::measure::{Peak, largest_magnitude};
use crash_measures::signal::integrate;
use occupant_core::vehicle::{
    AccelerationRecord, AfterEnd, PathCursor, SensorDefinition, SensorGravity, SensorPath, SensorRecord,
    TravelDirection, VehiclePath, VehiclePose,
};

/// Largest roll, pitch and yaw.
#[derive(Clone, Debug, PartialEq)]
pub struct Angles {
    /// Roll, pitch, yaw of largest magnitude, rad. Yaw is measured from the initial heading.
    pub largest: [Measured<Peak>; 3],
    /// Roll, pitch, yaw over time, rad.
    pub histories: [Measured<Vec<f64>>; 3],
    /// True if all three rates are there, so that the angles are roll, pitch and yaw of the attitude; otherwise each is
    /// the integral of its own rate.
    pub of_attitude: bool,
}

impl Angles {
    /// The angles that can be computed from the rates.
    pub(super) fn of(signals: &VehicleSignals) -> Self {
        let of_attitude = signals.channels[3..].iter().all(Option::is_some);
        let histories = if of_attitude {
            match attitudes(signals) {
                Ok(histories) => histories.map(Ok),
                Err(missing) => [(); 3].map(|()| Err(missing.clone())),
            }
        } else {
            [0, 1, 2].map(|axis| alone(signals, axis))
        };
        let largest = [0, 1, 2].map(|axis: usize| {
            let angle = histories[axis].as_ref().map_err(Missing::clone)?;
            Ok(largest_magnitude(angle, signals.dt_s)?)
        });
        Angles { largest, histories, of_attitude }
    }
}

/// Roll, pitch and yaw of the attitude, integrated from the three rates.
fn attitudes(signals: &VehicleSignals) -> Measured<[Vec<f64>; 3]> {
    let time_s: Vec<f64> = (0..signals.samples()).map(|i| i as f64 * signals.dt_s).collect();
    let sensors = SensorPath::new(SensorDefinition {
        record: SensorRecord::Accelerations(AccelerationRecord {
            time_s: time_s.clone(),
            acceleration_m_s2: [const { None }; 3],
            rate_rad_s: [3, 4, 5].map(|place| signals.channels[place].clone()),
        }),
        initial: VehiclePose { attitude: signals.initial, ..VehiclePose::default() },
        initial_speed_m_s: 0.0,
        direction: TravelDirection::Heading,
        offset_m: Vector3::zeros(),
        gravity: SensorGravity::Removed,
        gravity_m_s2: 0.0,
        filter: None,
        baseline_s: None,
        baseline_end_s: None,
        strength: 1.0,
        starts_at_s: None,
        after: AfterEnd::Error,
    })
    .map_err(|problems| {
        let first = problems.first().map(ToString::to_string);
        Missing::Turning(first.unwrap_or_default())
    })?;
    let (path, mut cursor) = (VehiclePath::Sensors(Box::new(sensors)), PathCursor::default());
    let attitudes: Vec<_> = time_s.iter().map(|&t| path.attitude(t, &mut cursor).attitude).collect();
    let heading_rad = signals.initial.yaw_rad;
    Ok([
        attitudes.iter().map(|a| a.roll_rad).collect(),
        attitudes.iter().map(|a| a.pitch_rad).collect(),
        attitudes.iter().map(|a| a.yaw_rad - heading_rad).collect(),
    ])
}

/// Integral of one rate, from the initial angle.
fn alone(signals: &VehicleSignals, axis: usize) -> Measured<Vec<f64>> {
    let start = [signals.initial.roll_rad, signals.initial.pitch_rad, 0.0];
    Ok(integrate(signals.channel(3 + axis)?, signals.dt_s, start[axis])?)
}
