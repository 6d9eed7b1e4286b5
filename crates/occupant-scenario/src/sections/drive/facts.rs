//! What a drive comes to in figures, for the tables of studies.

use vehicle_motion::run::Station;
use vehicle_motion::world::{Contact, Partner, Struck};

use super::Drives;
use occupant_core::model::setup::Fact;

/// Figures of each vehicle over the whole drive.
pub(crate) fn facts(drives: &Drives) -> Vec<Fact> {
    (0..drives.vehicles.len()).flat_map(|number| of(drives, number)).collect()
}

fn of(drives: &Drives, number: usize) -> Vec<Fact> {
    let name = &drives.vehicles[number].name;
    let (stations, damage) = (drives.outcome.rides[number].stations(), &drives.outcome.damage[number]);
    let last = drives.outcome.rides[number].last();
    let struck = drives.outcome.contacts.iter().filter_map(|contact| side(contact, number));
    let delta_v = struck.map(|struck| struck.delta_v_m_s.norm()).fold(0.0, f64::max);
    let roll = |station: &Station| station.state.yaw_pitch_roll_rad()[2].abs();
    let figures = [
        ("delta_v", "m/s", delta_v),
        ("ees", "m/s", damage.ees_m_s),
        ("crush", "m", damage.dynamic_m),
        ("crush_residual", "m", damage.residual_m),
        ("end_speed", "m/s", last.velocity_m_s.norm()),
        ("end_x", "m", last.position_m.x),
        ("end_y", "m", last.position_m.y),
        ("end_yaw", "rad", last.state.yaw_pitch_roll_rad()[0]),
        ("max_roll", "rad", stations.iter().map(roll).fold(0.0, f64::max)),
    ];
    let fact =
        |(key, unit, value): (&str, &'static str, f64)| Fact { name: format!("drive.{name}.{key}"), unit, value };
    figures.into_iter().map(fact).collect()
}

/// What a contact did to a vehicle.
fn side(contact: &Contact, number: usize) -> Option<Struck> {
    let [first, second] = contact.struck;
    if contact.car == number { first } else { second.filter(|_| contact.partner == Partner::Car(number)) }
}
