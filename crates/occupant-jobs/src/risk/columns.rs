//! The measures as figures of a run, for the table of a study with a recorded vehicle motion.

use std::sync::Mutex;

use occupant_core::model::setup::Setup;
use occupant_core::results::summary::Figure;
use occupant_core::vehicle::VehiclePath;
use occupant_units::unit::Unit;

use super::{Figures, Report};

/// Path of the last run, its first and last time, and its measures: most runs of a study share a path.
type Last = Option<(VehiclePath, [f64; 2], Vec<Figure>)>;
static LAST: Mutex<Last> = Mutex::new(None);

/// `vehicle.oiv_x`, `vehicle.asi_2010` and so on, for a path that is a table, a record or a drive, and figures of the
/// drive; none for others.
pub fn columns(setup: &Setup) -> Vec<Figure> {
    let facts = setup.facts.iter().map(|own| Figure { name: own.name.clone(), unit: own.unit, value: Some(own.value) });
    of_path(setup).into_iter().chain(facts).collect()
}

fn of_path(setup: &Setup) -> Vec<Figure> {
    if !matches!(setup.path, VehiclePath::Table(_) | VehiclePath::Sensors(_) | VehiclePath::Driven(_)) {
        return Vec::new();
    }
    let ends = [setup.time.start_s, setup.time.end_s];
    let Ok(mut last) = LAST.lock() else { return measured(setup) };
    if let Some((path, of, figures)) = last.as_ref()
        && *of == ends
        && *path == setup.path
    {
        return figures.clone();
    }
    let figures = measured(setup);
    *last = Some((setup.path.clone(), ends, figures.clone()));
    figures
}

/// Measures as from `occupant risk`, with its filter and interval. A missing measure has no value.
fn measured(setup: &Setup) -> Vec<Figure> {
    let report = Report::of_run("", setup, None);
    let figures = report.map(|report| Figures::of(&report).figures).unwrap_or_default();
    let column = |(key, unit): (&str, Unit)| {
        let suffix = match unit {
            Unit::MetrePerSecond => "_m_s",
            Unit::MetrePerSecondSquared => "_m_s2",
            Unit::Radian => "_rad",
            _ => "",
        };
        let whole = format!("{key}{suffix}");
        let value = figures.iter().find(|figure| figure.key == whole).map(|figure| figure.value);
        let unit = if unit == Unit::One { "1" } else { unit.expression() };
        Figure { name: format!("vehicle.{key}"), unit, value }
    };
    COLUMNS.into_iter().map(column).collect()
}

/// Keys of the measures without their units, and their units.
const COLUMNS: [(&str, Unit); 15] = [
    ("oiv_x", Unit::MetrePerSecond),
    ("oiv_y", Unit::MetrePerSecond),
    ("ora_x", Unit::MetrePerSecondSquared),
    ("ora_y", Unit::MetrePerSecondSquared),
    ("thiv", Unit::MetrePerSecond),
    ("phd", Unit::MetrePerSecondSquared),
    ("asi_1998", Unit::One),
    ("asi_2010", Unit::One),
    ("max_50ms_x", Unit::MetrePerSecondSquared),
    ("max_50ms_y", Unit::MetrePerSecondSquared),
    ("max_50ms_z", Unit::MetrePerSecondSquared),
    ("max_roll", Unit::Radian),
    ("max_pitch", Unit::Radian),
    ("max_yaw", Unit::Radian),
    ("olc", Unit::MetrePerSecondSquared),
];
