//! `[path]` of kind "sensors".

use nalgebra::Vector3;

use super::builder::Builder;
use super::path::{after, column, direction, numbers, pose, refuse};
use crate::model::setup::STANDARD_GRAVITY_M_S2;
use crate::problem::{Problem, Severity};
use crate::scenario::diagnostic::Diagnostic;
use crate::scenario::kind;
use crate::scenario::model::{FilterClass, RecordedGravity, SensorAxes, SensorsSection};
use crate::scenario::number_table::{Column, NumberTable};
use crate::scenario::source::SourceId;
use crate::vehicle::{AccelerationRecord, DeltaVRecord, SensorDefinition, SensorGravity, SensorPath, SensorRecord};
use crash_measures::signal::ChannelClass;

/// Columns of a record: the time, accelerations, rates, velocity changes.
pub(in crate::scenario) const COLUMNS: [Column; 9] = [
    column("t", kind::TIME, true),
    column("ax", kind::ACCELERATION, false),
    column("ay", kind::ACCELERATION, false),
    column("az", kind::ACCELERATION, false),
    rate("wx", "roll_rate"),
    rate("wy", "pitch_rate"),
    rate("wz", "yaw_rate"),
    column("dvx", kind::SPEED, false),
    column("dvy", kind::SPEED, false),
];

/// How many of them come before the velocity changes.
pub(in crate::scenario) const RECORDED: usize = 7;

const fn rate(name: &'static str, alias: &'static str) -> Column {
    Column { alias, ..column(name, kind::ANGULAR_VELOCITY, false) }
}

/// The path of a record; `file` is the CSV text the section names, if it names one.
pub(super) fn path(
    b: &mut Builder,
    s: &SensorsSection,
    file: Option<SourceId>,
    gravity_m_s2: f64,
) -> Option<SensorPath> {
    let initial = pose(b, &s.position, [&s.roll, &s.pitch, &s.yaw]);
    let initial_speed_m_s = b.si("path.speed", &s.speed);
    let direction = direction(b, &s.direction);
    let offset_m = match &s.offset {
        Some(offset) => Vector3::from(b.triple("path.offset", offset)),
        None => Vector3::zeros(),
    };
    let baseline_s = s.baseline.as_ref().map(|t| b.si("path.baseline", t));
    let starts_at_s = s.start.as_ref().map(|t| b.si("path.start", t));
    let table = numbers(b, file, &COLUMNS)?;
    let record = record(b, s, &table)?;
    let path = SensorPath::new(SensorDefinition {
        record,
        initial,
        initial_speed_m_s,
        direction,
        offset_m,
        gravity: match s.gravity {
            Some(RecordedGravity::Included) => SensorGravity::Included,
            Some(RecordedGravity::Zeroed) => SensorGravity::Zeroed,
            Some(RecordedGravity::Removed) | None => SensorGravity::Removed,
        },
        gravity_m_s2: match gravity_m_s2 {
            0.0 => STANDARD_GRAVITY_M_S2,
            g => g,
        },
        filter: s.filter.map(class),
        baseline_s,
        starts_at_s,
        after: after(s.after),
    });
    path.map_err(|p| refuse(b, &p, Some(&table))).ok()
}

fn class(word: FilterClass) -> ChannelClass {
    match word {
        FilterClass::Cfc60 => ChannelClass::Cfc60,
        FilterClass::Cfc180 => ChannelClass::Cfc180,
        FilterClass::Cfc600 => ChannelClass::Cfc600,
        FilterClass::Cfc1000 => ChannelClass::Cfc1000,
    }
}

/// The channels of the table, in axes forward, right, down.
fn record(b: &mut Builder, s: &SensorsSection, table: &NumberTable) -> Option<SensorRecord> {
    let time_s = table.column(0).unwrap_or_default();
    let sign = match s.axes {
        Some(SensorAxes::ZUp) => [1.0, -1.0, -1.0],
        Some(SensorAxes::ZDown) | None => [1.0; 3],
    };
    let channel = |i: usize, axis: usize| {
        let samples = table.column(i)?;
        Some(samples.into_iter().map(|x| sign[axis] * x).collect())
    };
    let accelerations = (1..=3).any(|i| table.present[i]);
    if (7..=8).any(|i| table.present[i]) {
        let sound = check_delta_v(b, s, table);
        return sound.then(|| {
            SensorRecord::DeltaV(DeltaVRecord {
                time_s,
                longitudinal_m_s: channel(7, 0),
                lateral_m_s: channel(8, 1),
                yaw_rate_rad_s: channel(6, 2),
            })
        });
    }
    if accelerations && s.gravity.is_none() {
        b.error(
            "path",
            "`path` has no key `gravity`, and the record has accelerations",
            "gravity = \"included\", \"zeroed\" or \"removed\"",
        );
        return None;
    }
    Some(SensorRecord::Accelerations(AccelerationRecord {
        time_s,
        acceleration_m_s2: [channel(1, 0), channel(2, 1), channel(3, 2)],
        rate_rad_s: [channel(4, 0), channel(5, 1), channel(6, 2)],
    }))
}

/// Whether a record of velocity changes is free of what has no meaning there.
fn check_delta_v(b: &mut Builder, s: &SensorsSection, table: &NumberTable) -> bool {
    let before = b.problems.len();
    for i in [1, 2, 3, 4, 5].into_iter().filter(|&i| table.present[i]) {
        let problem = Problem {
            severity: Severity::Error,
            path: "path".into(),
            found: format!("`{}` beside velocity changes", COLUMNS[i].name),
            expected: "`t`, `dvx`, `dvy` and `wz`, or accelerations and rates without velocity changes".into(),
            hint: None,
        };
        let placed = Diagnostic::at(b.sources, table.header, problem);
        b.push(placed);
    }
    for (key, given) in
        [("gravity", s.gravity.is_some()), ("filter", s.filter.is_some()), ("baseline", s.baseline.is_some())]
    {
        if given {
            b.error(
                &format!("path.{key}"),
                format!("`{key}` with a record of velocity changes"),
                "a record of accelerations, or no such key",
            );
        }
    }
    b.problems.len() == before
}
