//! Place, attitude and motion of the vehicles at one output.

use occupant_core::results::channel::{Channel, matching};
use occupant_core::results::sample::Sample;
use occupant_core::vehicle::VehiclePath;
use occupant_units::unit::Unit::{Metre, MetrePerSecond, RadianPerSecond, RadianPerSecondSquared};

use super::unit::{Unit, degree, g};
use super::{Pages, Table, Units};

/// Writes the lines of every vehicle.
pub(crate) fn write(pages: &mut Pages, units: Units, s: &Sample<'_>) {
    let all = matching(s.model, "vehicle.*");
    let setup = s.model.setup();
    own(pages, units, s, (&all, "vehicle", &setup.path));
    for frame in &setup.frames {
        let name = format!("vehicle.{}", frame.name);
        if all.iter().any(|channel| channel.name == format!("{name}.yaw")) {
            own(pages, units, s, (&all, &name, &frame.path));
        }
    }
}

fn own(pages: &mut Pages, units: Units, s: &Sample<'_>, (all, name, path): (&[Channel], &str, &VehiclePath)) {
    let value = |quantity: &str| {
        let name = format!("{name}.{quantity}");
        all.iter().find(|channel| channel.name == name).map_or(f64::NAN, |channel| channel.value(s))
    };
    let vector =
        |quantity: &str, unit: Unit| unit.vector(["x", "y", "z"].map(|axis| value(&format!("{quantity}.{axis}"))));
    let title = units.heading(
        &format!(
            "{}: POSITION ({{}}) FORWARD, RIGHT, DOWN; ATTITUDE (DEG) ROLL, PITCH, YAW; THE REST IN VEHICLE COORDINATES",
            name.replace('.', " ").to_uppercase()
        ),
        &[Metre],
    );
    let mut table = Table::new(title, "<|X|Y|Z|<|X|Y|Z");
    let of = if path.has_accelerations() { "" } else { " FROM DIFFERENCES OF THE STATIONS" };
    let rows = [
        (
            "POSITION".to_owned(),
            vector("position", units.of(Metre)),
            "ROLL, PITCH, YAW (DEG)".to_owned(),
            degree().vector(["roll", "pitch", "yaw"].map(value)),
        ),
        (
            units.heading("VELOCITY ({})", &[MetrePerSecond]),
            vector("velocity", units.of(MetrePerSecond)),
            "ANGULAR VELOCITY (RAD/S)".to_owned(),
            vector("angular_velocity", units.of(RadianPerSecond)),
        ),
        (
            format!("ACCELERATION (G){of}"),
            vector("acceleration", g()),
            "ANGULAR ACCELERATION (RAD/S2)".to_owned(),
            vector("angular_acceleration", units.of(RadianPerSecondSquared)),
        ),
    ];
    for (left, place, right, turn) in rows {
        table.row_of(&[&[left], &place, &[right], &turn]);
    }
    table.write(pages);
}
