//! `[path]` → [`VehiclePath`].

use nalgebra::Vector3;

use super::builder::Builder;
use crate::problem::{Problem, Severity};
use crate::scenario::diagnostic::Diagnostic;
use crate::scenario::kind;
use crate::scenario::model::{After, Interpolate, PathSection, PulseSection, TableSection};
use crate::scenario::model::{Angle, Length, Ratio};
use crate::scenario::number_table::{Column, NumberTable, read_csv, read_inline};
use crate::scenario::source::SourceId;
use crate::vehicle::{
    AfterEnd, Attitude, DecelerationPoint, FixedPath, Interpolation, PathProblem, PulseDefinition, PulsePath, Station,
    TablePath, TravelDirection, VehiclePath, VehiclePose,
};

use super::{pulse, sensors};

/// Columns of a path table.
const PATH_COLUMNS: [Column; 7] = [
    column("t", kind::TIME, true),
    column("x", kind::LENGTH, false),
    column("y", kind::LENGTH, false),
    column("z", kind::LENGTH, false),
    column("roll", kind::ANGLE, false),
    column("pitch", kind::ANGLE, false),
    column("yaw", kind::ANGLE, false),
];

/// Columns of a tabulated pulse.
const PULSE_COLUMNS: [Column; 2] = [column("t", kind::TIME, true), column("a", kind::ACCELERATION, true)];

pub(super) const fn column(name: &'static str, kind: usize, required: bool) -> Column {
    Column { name, alias: "", kind, required }
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
            let pose = pose(b, &s.position, [&s.roll, &s.pitch, &s.yaw]);
            let path = FixedPath::new(pose);
            path.map_err(|p| refuse(b, &p, None)).ok().map(VehiclePath::Fixed)
        }
        PathSection::Table(s) => table_path(b, s, table).map(VehiclePath::Table),
        PathSection::Pulse(s) => pulse_path(b, s, table).map(VehiclePath::Pulse),
        PathSection::Sensors(s) => {
            let path = sensors::path(b, s, table, gravity_m_s2)?;
            Some(VehiclePath::Sensors(Box::new(path)))
        }
    }
}

pub(super) fn pose(b: &mut Builder, position: &Option<[Length; 3]>, angles: [&Option<Angle>; 3]) -> VehiclePose {
    let position_m = match position {
        Some(position) => Vector3::from(b.triple("path.position", position)),
        None => Vector3::zeros(),
    };
    let [roll, pitch, yaw] = angles;
    VehiclePose {
        position_m,
        attitude: Attitude {
            roll_rad: b.optional("path.roll", roll, 0.0),
            pitch_rad: b.optional("path.pitch", pitch, 0.0),
            yaw_rad: b.optional("path.yaw", yaw, 0.0),
        },
    }
}

fn table_path(b: &mut Builder, s: &TableSection, file: Option<SourceId>) -> Option<TablePath> {
    let table = numbers(b, file, &PATH_COLUMNS)?;
    let stations = table.rows.iter().map(|r| Station::new(r[0], [r[1], r[2], r[3]], [r[4], r[5], r[6]])).collect();
    let interpolation = match s.interpolation {
        Some(Interpolate::Linear) => Interpolation::Linear,
        Some(Interpolate::Spline) => Interpolation::Spline,
        None => Interpolation::default(),
    };
    let path = TablePath::new(stations, interpolation, after(s.after));
    path.map_err(|p| refuse(b, &p, Some(&table))).ok()
}

pub(super) fn after(word: Option<After>) -> AfterEnd {
    match word {
        Some(After::Coast) => AfterEnd::Coast,
        Some(After::Hold) => AfterEnd::Hold,
        Some(After::Error) => AfterEnd::Error,
        None => AfterEnd::default(),
    }
}

fn pulse_path(b: &mut Builder, s: &PulseSection, file: Option<SourceId>) -> Option<PulsePath> {
    let tabulated = file.is_some() || s.rows.is_some();
    let table = match tabulated {
        true => Some(numbers(b, file, &PULSE_COLUMNS)?),
        false => None,
    };
    let points = table.as_ref().map(|t| {
        let each = t.rows.iter();
        each.map(|row| DecelerationPoint { time_s: row[0], deceleration_m_s2: row[1] }).collect()
    });
    let shape = pulse::shape(b, s, points)?;
    let direction = direction(b, &s.direction);
    let initial = pose(b, &s.position, [&s.roll, &s.pitch, &s.yaw]);
    let plain = PulseDefinition::new(b.si("path.speed", &s.speed), shape);
    let definition = PulseDefinition {
        initial,
        direction,
        starts_at_s: b.optional("path.start", &s.start, plain.starts_at_s),
        rebound_m_s: s.rebound.as_ref().map(|r| b.si("path.rebound", r)),
        ..plain
    };
    let path = PulsePath::new(definition);
    path.map_err(|p| refuse(b, &p, table.as_ref())).ok()
}

pub(super) fn numbers(b: &mut Builder, file: Option<SourceId>, columns: &[Column]) -> Option<NumberTable> {
    let table = match (file, b.root.get("path")) {
        (Some(id), _) => read_csv(b.sources, id, columns),
        (None, Some(section)) => read_inline(b.sources, section, columns),
        (None, None) => return None,
    };
    table.map_err(|problems| b.problems.extend(problems)).ok()
}

pub(super) fn direction(b: &mut Builder, words: &Option<[Ratio; 3]>) -> TravelDirection {
    match words {
        Some(words) => TravelDirection::Along(Vector3::from(b.triple("path.direction", words))),
        None => TravelDirection::default(),
    }
}

/// Reports what a path says is wrong with it, at the line of its table where it speaks of one.
pub(super) fn refuse(b: &mut Builder, problems: &[PathProblem], table: Option<&NumberTable>) {
    for problem in problems {
        let span = station_of(problem).and_then(|i| table?.row_spans.get(i).copied());
        let text = problem.to_string();
        let (found, expected) = text.split_once(", expected ").unwrap_or((&text, "a path that is possible"));
        match span {
            None => b.error("path", found, expected),
            Some(span) => {
                let problem = Problem {
                    severity: Severity::Error,
                    path: "path".into(),
                    found: found.into(),
                    expected: expected.into(),
                    hint: None,
                };
                let placed = Diagnostic::at(b.sources, span, problem);
                b.push(placed);
            }
        }
    }
}

/// The line of the table that a problem is about.
fn station_of(problem: &PathProblem) -> Option<usize> {
    match problem {
        PathProblem::TimeNotIncreasing { station, .. }
        | PathProblem::StationNotFinite { station, .. }
        | PathProblem::AngleJump { station, .. }
        | PathProblem::TooSteep { station, .. }
        | PathProblem::NotUniform { station, .. }
        | PathProblem::TurnsTooFar { station, .. } => Some(*station),
        _ => None,
    }
}
