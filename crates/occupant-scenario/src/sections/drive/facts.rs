//! Figures of a drive, for the tables of studies.

use vehicle_motion::run::Station;
use vehicle_motion::world::{Contact, Partner, Struck};

use super::Drives;
use occupant_core::model::setup::{DRIVE_NUMBERS, DriveLog, Fact};

/// Figures of each vehicle over the whole drive.
pub(crate) fn facts(drives: &Drives) -> Vec<Fact> {
    let passes = drives.changes_m.last().map(|change_m| {
        let fact = |name: &str, unit, value| Fact { name: format!("drive.{name}"), unit, value };
        [fact("passes", "1", drives.changes_m.len() as f64), fact("pass_change", "m", *change_m)]
    });
    let of_vehicles = (0..drives.vehicles.len()).flat_map(|number| of(drives, number));
    of_vehicles.chain(passes.into_iter().flatten()).collect()
}

fn of(drives: &Drives, number: usize) -> Vec<Fact> {
    let name = &drives.vehicles[number].name;
    let (ride, damage) = (&drives.outcome.rides[number], &drives.outcome.damage[number]);
    let last = ride.last();
    let struck = drives.outcome.contacts.iter().filter_map(|contact| side(contact, number));
    let delta_v = struck.map(|struck| struck.delta_v_m_s.norm()).fold(0.0, f64::max);
    let max_roll = ride.turns_rad().iter().map(|[_, _, roll]| roll.abs()).fold(0.0, f64::max);
    let figures = [
        ("delta_v", "m/s", delta_v),
        ("ees", "m/s", damage.ees_m_s),
        ("crush", "m", damage.dynamic_m),
        ("crush_residual", "m", damage.residual_m),
        ("end_speed", "m/s", last.velocity_m_s.norm()),
        ("end_x", "m", last.position_m.x),
        ("end_y", "m", last.position_m.y),
        ("end_yaw", "rad", last.state.yaw_pitch_roll_rad()[0]),
        ("max_roll", "rad", max_roll),
    ];
    let fact =
        |(key, unit, value): (&str, &'static str, f64)| Fact { name: format!("drive.{name}.{key}"), unit, value };
    figures.into_iter().map(fact).collect()
}

/// The effects of a contact on a vehicle.
fn side(contact: &Contact, number: usize) -> Option<Struck> {
    let [first, second] = contact.struck;
    if contact.car == number { first } else { second.filter(|_| contact.partner == Partner::Car(number)) }
}

/// Histories of all vehicles.
pub(crate) fn logs(drives: &Drives) -> Vec<DriveLog> {
    let log = |(number, ride): (usize, &vehicle_motion::run::Ride)| DriveLog {
        name: drives.vehicles[number].name.clone(),
        times_s: ride.stations().iter().map(|station| station.time_s).collect(),
        rows: ride.stations().iter().map(row).collect(),
    };
    drives.outcome.rides.iter().enumerate().map(log).collect()
}

fn row(station: &Station) -> [f64; DRIVE_NUMBERS] {
    let own = station.attitude.inverse() * station.velocity_m_s;
    let slip_rad = if own.norm() < 0.5 { 0.0 } else { occupant_units::trig::atan2(own.y, own.x) };
    let (speed, struck, hull) = (own.norm(), station.struck_n.norm(), station.hull_n.norm());
    let mut row = [0.0; DRIVE_NUMBERS];
    row[..6].copy_from_slice(&[speed, slip_rad, station.steer_rad, station.crush_m, struck, hull]);
    let (jounce, spin) = (station.state.jounce_m(), station.state.spin_rad_s());
    for (i, wheel) in station.wheels.iter().enumerate() {
        let [slide, shear] = [wheel.slide_m_s, wheel.shear_n];
        row[6 + 9 * i..15 + 9 * i].copy_from_slice(&[
            wheel.load_n,
            jounce[i],
            spin[i],
            wheel.brake_n_m,
            slide[0],
            slide[1],
            shear[0],
            shear[1],
            wheel.saturation,
        ]);
    }
    row
}
