//! `[path]`: its keys, and the [`VehiclePath`] they come to.

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::number_table::{Column, NumberTable, column, names_of, read_csv, read_inline};
use super::pulse::{self, PulseSection};
use super::quantity::{all_si, si_or};
use super::sensors::{self, SensorsSection};
use super::{Angle, Length, Ratio};
use crate::kind;
use occupant_core::vehicle::{
    AfterEnd, Attitude, FixedPath, Interpolation, PathProblem, Station, TablePath, TravelDirection, VehiclePath,
    VehiclePose,
};
use placed_text::{Diagnostic, Problem, SourceId};

/// Motion of the vehicle, in vehicle-space axes: x forward, y right, z down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum PathSection {
    /// The vehicle stands still.
    Fixed(Box<PoseSection>),
    /// Straight travel, slowed by a deceleration pulse.
    Pulse(Box<PulseSection>),
    /// Places and angles at given times.
    Table(TableSection),
    /// Recorded accelerations and turning rates, or velocity changes.
    Sensors(Box<SensorsSection>),
}

/// Where the vehicle is. Angles are yaw, then pitch, then roll.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PoseSection {
    /// [x, y, z] of the vehicle's centre of gravity; [0, 0, 0] if absent.
    pub(crate) position: Option<[Length; 3]>,
    /// Roll; 0 if absent.
    pub(crate) roll: Option<Angle>,
    /// Pitch; 0 if absent.
    pub(crate) pitch: Option<Angle>,
    /// Yaw; 0 if absent.
    pub(crate) yaw: Option<Angle>,
}

/// A table of times, places and angles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["file", "rows"]], "dependentRequired" = {"rows": ["columns"]}))]
pub(crate) struct TableSection {
    /// CSV file beside the scenario; its first line names the columns and their units, such as
    /// `t[s],x[m],y[m],z[m],roll[deg],pitch[deg],yaw[deg]`. Columns other than `t` may be left out and are then 0.
    pub(crate) file: Option<String>,
    /// Names and units of the columns of `rows`, such as `["t[s]", "x[ft]", "yaw[deg]"]`; or of those of `file` in place of its headings, `"-"` for one
    /// that is left out.
    pub(crate) columns: Option<Vec<String>>,
    /// The table itself, one list for each time.
    pub(crate) rows: Option<Vec<Vec<f64>>>,
    /// How the table is read between its times; "spline" if absent.
    pub(crate) interpolation: Option<Interpolation>,
    /// What the vehicle does after the last time; a run that goes on is refused if absent.
    pub(crate) after: Option<AfterEnd>,
}

/// Columns of a path table.
const COLUMNS: [Column; 7] = [
    column("t", kind::TIME, true),
    column("x", kind::LENGTH, false),
    column("y", kind::LENGTH, false),
    column("z", kind::LENGTH, false),
    column("roll", kind::ANGLE, false),
    column("pitch", kind::ANGLE, false),
    column("yaw", kind::ANGLE, false),
];

impl PathSection {
    /// The CSV file it names, if it names one.
    pub(crate) fn file(&self) -> Option<&str> {
        match self {
            PathSection::Table(table) => table.file.as_deref(),
            PathSection::Pulse(pulse) => pulse.file.as_deref(),
            PathSection::Sensors(sensors) => sensors.file.as_deref(),
            PathSection::Fixed(_) => None,
        }
    }
}

/// The vehicle's path; `table` is the CSV text it names, if it names one, and `gravity_m_s2` that of the scenario.
pub(super) fn path(
    b: &mut Builder,
    section: &PathSection,
    table: Option<SourceId>,
    gravity_m_s2: f64,
) -> Option<VehiclePath> {
    match section {
        PathSection::Fixed(s) => {
            let path = FixedPath::new(pose(&s.position, [&s.roll, &s.pitch, &s.yaw]));
            path.map_err(|p| refuse(b, &p, None)).ok().map(VehiclePath::Fixed)
        }
        PathSection::Table(s) => table_path(b, s, table).map(VehiclePath::Table),
        PathSection::Pulse(s) => pulse::path(b, s, table).map(VehiclePath::Pulse),
        PathSection::Sensors(s) => {
            let path = sensors::path(b, s, table, gravity_m_s2)?;
            Some(VehiclePath::Sensors(Box::new(path)))
        }
    }
}

pub(super) fn pose(position: &Option<[Length; 3]>, [roll, pitch, yaw]: [&Option<Angle>; 3]) -> VehiclePose {
    VehiclePose {
        position_m: Vector3::from(position.as_ref().map_or([0.0; 3], all_si)),
        attitude: Attitude { roll_rad: si_or(roll, 0.0), pitch_rad: si_or(pitch, 0.0), yaw_rad: si_or(yaw, 0.0) },
    }
}

fn table_path(b: &mut Builder, s: &TableSection, file: Option<SourceId>) -> Option<TablePath> {
    let table = numbers(b, file, &COLUMNS)?;
    let stations = table.rows.iter().map(|r| Station::new(r[0], [r[1], r[2], r[3]], [r[4], r[5], r[6]])).collect();
    let path = TablePath::new(stations, s.interpolation.unwrap_or_default(), s.after.unwrap_or_default());
    path.map_err(|p| refuse(b, &p, Some(&table))).ok()
}

pub(super) fn numbers(b: &mut Builder, file: Option<SourceId>, columns: &[Column]) -> Option<NumberTable> {
    let table = match (file, b.document.root.get("path")) {
        (Some(id), section) => read_csv(&b.document.sources, id, columns, section.and_then(names_of)),
        (None, Some(section)) => read_inline(&b.document.sources, section, columns),
        (None, None) => return None,
    };
    table.map_err(|problems| b.problems.extend(problems)).ok()
}

pub(super) fn direction(words: &Option<[Ratio; 3]>) -> TravelDirection {
    match words {
        Some(words) => TravelDirection::Along(Vector3::from(all_si(words))),
        None => TravelDirection::default(),
    }
}

/// Reports what a path says is wrong with it, at the line of its table where it speaks of one.
pub(super) fn refuse(b: &mut Builder, problems: &[PathProblem], table: Option<&NumberTable>) {
    for PathProblem { station, found, expected } in problems {
        let problem = Problem::error("path", found, expected);
        match station.and_then(|i| table?.row_spans.get(i).copied()) {
            None => b.report(problem),
            Some(span) => b.problems.add(problem, |problem| Diagnostic::at(&b.document.sources, span, problem)),
        }
    }
}
