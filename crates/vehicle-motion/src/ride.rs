//! The motion of one vehicle: its start, and the results at its accepted steps.

use core::f64::consts::{PI, TAU};

use nalgebra::{Quaternion, UnitQuaternion};

use crate::chassis::WheelReport;
use crate::state::State;
use crate::{V3, WHEELS};

/// Start of a vehicle, in equilibrium on the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// Position of the centre of gravity in plan, m.
    pub x_m: f64,
    /// To the right, m.
    pub y_m: f64,
    /// Heading, clockwise from above, rad.
    pub yaw_rad: f64,
    /// Speed along the ground, m/s.
    pub speed_m_s: f64,
    /// Direction of the velocity to the right of the heading, rad.
    pub sideslip_rad: f64,
    /// Yaw rate, rad/s.
    pub yaw_rate_rad_s: f64,
    /// Whether the wheels start locked rather than rolling.
    pub wheels_stand: bool,
}

/// The motion at an accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Station {
    /// Time, s.
    pub time_s: f64,
    /// Place of the centre of gravity, vehicle-space, m.
    pub position_m: V3,
    /// Its velocity, vehicle-space, m/s.
    pub velocity_m_s: V3,
    /// Its acceleration, vehicle-space, m/s².
    pub acceleration_m_s2: V3,
    /// Attitude, body axes to vehicle-space.
    pub attitude: UnitQuaternion<f64>,
    /// Angular velocity, body axes, rad/s.
    pub rotation_rad_s: V3,
    /// Angular acceleration, body axes, rad/s².
    pub turning_rad_s2: V3,
    /// Accelerometer reading at the centre of gravity, body axes, m/s².
    pub felt_m_s2: V3,
    /// Mean angle of the front wheels, rad.
    pub steer_rad: f64,
    /// Force of other vehicles and barriers, vehicle-space, N.
    pub struck_n: V3,
    /// Deepest crush so far, m.
    pub crush_m: f64,
    /// Force of the ground on hull and rims, vehicle-space, N.
    pub hull_n: V3,
    /// Wheels.
    pub wheels: [WheelReport; WHEELS],
    /// State of which all this follows.
    pub state: State,
}

/// A drive that was computed.
#[derive(Clone, Debug)]
pub struct Ride {
    pub(crate) stations: Vec<Station>,
    /// Evaluations of the rates.
    pub evaluations: u64,
    /// Number of rejected steps.
    pub rejected: u64,
    pub(crate) balance: f64,
}

impl Ride {
    /// The motion at all accepted steps; never empty.
    pub fn stations(&self) -> &[Station] {
        &self.stations
    }

    /// The motion at the end.
    pub fn last(&self) -> &Station {
        &self.stations[self.stations.len() - 1]
    }

    /// Yaw, pitch and roll (SAE J670) at all stations, rad, that continue beyond half a turn.
    ///
    /// An attitude has many names: whole turns may be added to each angle, and yaw and roll turned by half a turn with π − pitch
    /// for the pitch is the same attitude. Each is named by the angles nearest to those of the station before.
    pub fn turns_rad(&self) -> Vec<[f64; 3]> {
        let mut last: Option<[f64; 3]> = None;
        let name = |station: &Station| {
            let found = station.state.yaw_pitch_roll_rad();
            let Some(before) = last else { return *last.insert(found) };
            let near =
                |angles: [f64; 3]| [0, 1, 2].map(|i| angles[i] - TAU * libm::round((angles[i] - before[i]) / TAU));
            let far =
                |angles: &[f64; 3]| (0..3).map(|i| (angles[i] - before[i]) * (angles[i] - before[i])).sum::<f64>();
            let [yaw, pitch, roll] = found;
            let names = [near(found), near([yaw + PI, PI - pitch, roll + PI])];
            *last.insert(if far(&names[1]) < far(&names[0]) { names[1] } else { names[0] })
        };
        self.stations.iter().map(name).collect()
    }

    /// Error of the energy balance of everything driven together, relative to the largest kinetic energy.
    pub fn balance(&self) -> f64 {
        self.balance
    }

    /// Position and attitude at a time within the drive, by cubics in position and by the shortest rotation.
    pub fn at(&self, time_s: f64) -> (V3, UnitQuaternion<f64>) {
        let next =
            self.stations.partition_point(|station| station.time_s < time_s).clamp(1, self.stations.len().max(2) - 1);
        let [from, to] = [&self.stations[next - 1], &self.stations[next.min(self.stations.len() - 1)]];
        let h = to.time_s - from.time_s;
        let s = if h > 0.0 { ((time_s - from.time_s) / h).clamp(0.0, 1.0) } else { 0.0 };
        let (a, b) = (s * s * (3.0 - 2.0 * s), s * (1.0 - s));
        let place = from.position_m * (1.0 - a)
            + to.position_m * a
            + (from.velocity_m_s * (1.0 - s) - to.velocity_m_s * s) * (b * h);
        (place, turned(&from.attitude, &to.attitude, s))
    }
}

/// Attitude at a share of the shortest rotation from one to another.
fn turned(from: &UnitQuaternion<f64>, to: &UnitQuaternion<f64>, share: f64) -> UnitQuaternion<f64> {
    let (a, b) = (from.quaternion(), to.quaternion());
    let b = if a.dot(b) < 0.0 { -b } else { *b };
    let half = libm::acos(a.dot(&b).min(1.0));
    let weights: [f64; 2] = if half < 1e-8 {
        [1.0 - share, share]
    } else {
        [(1.0 - share) * half, share * half].map(|x| libm::sin(x) / libm::sin(half))
    };
    let mixed: Quaternion<f64> = a * weights[0] + b * weights[1];
    UnitQuaternion::new_normalize(mixed)
}
