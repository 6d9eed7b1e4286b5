//! Slip angle: direction of travel relative to the heading.

use vehicle_motion::V3;
use vehicle_motion::run::Station;

/// Speed below which the direction of travel is undefined, m/s.
const SLOW_M_S: f64 = 0.5;
const SLIDES_M_S: f64 = 2.0;
/// Largest lateral speed of a vehicle whose reversal counts as being pushed back, m/s.
const ASIDE_M_S: f64 = 2.0;

/// Velocity along the vehicle's axes, m/s.
fn own(station: &Station) -> V3 {
    station.attitude.inverse() * station.velocity_m_s
}

/// Slip angle: direction of travel to the right of the heading, rad; 0 at rest.
pub(super) fn slip_rad(station: &Station) -> f64 {
    let velocity = own(station);
    if velocity.norm() < SLOW_M_S { 0.0 } else { occupant_units::trig::atan2(velocity.y, velocity.x) }
}

/// Slip angles at all stations, measured from the tail while moving backward, as after a rebound; 0 below 2 m/s.
pub(super) fn slips_rad(stations: &[Station]) -> Vec<f64> {
    let mut backs = stations.first().is_some_and(|first| own(first).x < 0.0 && own(first).y.abs() <= ASIDE_M_S);
    let slip = |station: &Station| {
        let velocity = own(station);
        if (velocity.x < 0.0) != backs && velocity.y.abs() <= ASIDE_M_S {
            backs = !backs;
        }
        let sign = if backs { -1.0 } else { 1.0 };
        let is_slow = velocity.norm() < SLIDES_M_S;
        if is_slow { 0.0 } else { occupant_units::trig::atan2(sign * velocity.y, sign * velocity.x) }
    };
    stations.iter().map(slip).collect()
}
