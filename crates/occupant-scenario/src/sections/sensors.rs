//! `[path]` of kind "sensors": its keys, converted to a [`SensorPath`].

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::adjusted::{CHANGES, scale_to, shift};
use super::builder::Builder;
use super::number_table::{Column, NumberTable, column};
use super::path::{direction, numbers, pose, refuse};
use super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::{Angle, Length, Ratio, Speed, Time};
use crate::kind;
use crash_measures::signal::ChannelClass;
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;
use occupant_core::vehicle::{
    AccelerationRecord, AfterEnd, DeltaVRecord, SensorDefinition, SensorGravity, SensorPath, SensorRecord, VehiclePath,
};
use occupant_units::trig::sin_cos;
use placed_text::{Diagnostic, Problem, SourceId};

/// Recordings of sensors in the vehicle, along its axes: x forward, y right, z down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["file", "rows"]], "dependentRequired" = {"rows": ["columns"], "baseline_end": ["baseline"]}))]
pub(crate) struct SensorsSection {
    /// CSV file beside the scenario; its first line names the columns and their units: `t`, accelerations `ax`, `ay`,
    /// `az` and rates `wx`, `wy`, `wz` (or `roll_rate`, `pitch_rate`, `yaw_rate`), such as
    /// `t[s],ax[g],ay[g],wz[deg/s]`; or velocity changes `dvx`, `dvy` with `wz`, such as `t[ms],dvx[km/h]`; or in the
    /// style of recorders, such as `Time (ms),Delta-V longitudinal (km/h)`. Separators are commas, semicolons, tabs or
    /// blanks. A missing acceleration, rate or velocity change counts as zero.
    pub(crate) file: Option<String>,
    /// Names and units of the columns of `rows`, such as `["t[ms]", "ax[g]"]`; or of those of `file`, instead of its
    /// headings; `"-"` skips a column.
    pub(crate) columns: Option<Vec<String>>,
    /// The record itself, one list for each time.
    pub(crate) rows: Option<Vec<Vec<f64>>>,
    /// Speed of the vehicle's centre of gravity at the start of the path.
    pub(crate) speed: Speed<NOT_NEGATIVE>,
    /// Direction of that speed [x, y, z], any length; the vehicle's heading if absent.
    pub(crate) direction: Option<[Ratio; 3]>,
    /// How gravity is treated in the accelerations. Needed with accelerations.
    pub(crate) gravity: Option<SensorGravity>,
    /// Axes of the sensors; "z_down" if absent.
    pub(crate) axes: Option<SensorAxes>,
    /// Position of the sensors, [x, y, z] from the vehicle's centre of gravity, forward, right, down; [0, 0, 0] if
    /// absent.
    pub(crate) offset: Option<[Length; 3]>,
    /// Channel frequency class (ISO 6487, no phase lag) of the filter for all accelerations and rates; not filtered if
    /// absent.
    pub(crate) filter: Option<FilterClass>,
    /// Length of the quiet part (rest or steady travel) at the start of the record. The mean offset of each channel
    /// there is subtracted from the whole record. Nothing is subtracted if absent.
    pub(crate) baseline: Option<Time<POSITIVE>>,
    /// Length of the quiet part at the end of the record, level as at the start. The subtracted offset then changes
    /// linearly from one mean to the other, which removes sensor drift.
    pub(crate) baseline_end: Option<Time<POSITIVE>>,
    /// Factor on the recorded motion: accelerations without gravity, velocity changes and changes of rate. The initial
    /// state stays. 1 if absent.
    pub(crate) strength: Option<Ratio<NOT_NEGATIVE>>,
    /// Largest change of the horizontal velocity from the first time on, to which the recorded motion is scaled; `strength` acts
    /// on top of it. As recorded if absent.
    pub(crate) delta_v: Option<Speed<POSITIVE>>,
    /// Angle by which recorded accelerations and velocity changes are turned about the vehicle's vertical axis, clockwise seen
    /// from above: the uncertainty of a principal direction of force. 0 if absent.
    pub(crate) turn: Option<Angle>,
    /// Time added to the clock of the record. Until its first time the first row holds. `start` is a time of the run. 0 if
    /// absent.
    pub(crate) shift: Option<Time>,
    /// Time of the record at which the path starts with the given position, angles and speed; its first time if absent.
    /// Set `time.start` to the same time to leave out braking before the crash, which folds a body without muscles.
    pub(crate) start: Option<Time>,
    /// [x, y, z] of the vehicle's centre of gravity when the path starts; [0, 0, 0] if absent.
    pub(crate) position: Option<[Length; 3]>,
    /// Roll when the path starts; 0 if absent.
    pub(crate) roll: Option<Angle>,
    /// Pitch when the path starts; 0 if absent.
    pub(crate) pitch: Option<Angle>,
    /// Yaw when the path starts; 0 if absent.
    pub(crate) yaw: Option<Angle>,
    /// What the vehicle does after the last time. If absent, a run beyond it is an error.
    pub(crate) after: Option<AfterEnd>,
}

/// Direction of the axes of sensors and tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum SensorAxes {
    /// x forward, y right, z down (SAE J211, J670).
    ZDown,
    /// x forward, y left, z up (ISO 8855).
    ZUp,
}

impl SensorAxes {
    /// Signs that convert these axes to forward, right, down.
    pub(super) fn signs(self) -> [f64; 3] {
        match self {
            SensorAxes::ZDown => [1.0; 3],
            SensorAxes::ZUp => [1.0, -1.0, -1.0],
        }
    }
}

// in the order of `ChannelClass::ALL`
/// Channel frequency class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum FilterClass {
    /// CFC 60.
    Cfc60,
    /// CFC 180.
    Cfc180,
    /// CFC 600.
    Cfc600,
    /// CFC 1000.
    Cfc1000,
}

/// Columns of a record: the time, accelerations, rates, velocity changes.
pub(super) const COLUMNS: [Column; 9] = [
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

/// Number of columns before the velocity changes.
pub(super) const RECORDED: usize = 7;

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
    let mut table = numbers(b, file, &COLUMNS)?;
    shift(&mut table, &s.shift, |_, first, _| first.to_vec());
    turn(&mut table, s);
    let mut definition = SensorDefinition {
        record: record(b, s, &table)?,
        initial: pose(&s.position, [&s.roll, &s.pitch, &s.yaw]),
        initial_speed_m_s: s.speed.si(),
        direction: direction(&s.direction),
        offset_m: Vector3::from(s.offset.as_ref().map_or([0.0; 3], all_si)),
        gravity: s.gravity.unwrap_or(SensorGravity::Removed),
        gravity_m_s2: match gravity_m_s2 {
            0.0 => STANDARD_GRAVITY_M_S2,
            g => g,
        },
        filter: s.filter.map(|word| ChannelClass::ALL[word as usize]),
        baseline_s: s.baseline.as_ref().map(Time::si),
        baseline_end_s: s.baseline_end.as_ref().map(Time::si),
        strength: si_or(&s.strength, 1.0),
        starts_at_s: s.start.as_ref().map(Time::si),
        after: s.after.unwrap_or_default(),
    };
    if let Some(asked) = &s.delta_v {
        // a record that is none is refused with its own words below
        if SensorPath::new(definition.clone()).is_ok() {
            let with = |strength| SensorPath::new(SensorDefinition { strength, ..definition.clone() }).ok();
            let scale = scale_to(asked.si(), &table, |strength| Some(VehiclePath::Sensors(Box::new(with(strength)?))));
            definition.strength *= scale.map_err(|found| b.error("path.delta_v", found, CHANGES)).ok()?;
        }
    }
    SensorPath::new(definition).map_err(|p| refuse(b, &p, Some(&table))).ok()
}

/// Turns longitudinal and lateral columns about the vehicle's vertical axis.
fn turn(table: &mut NumberTable, s: &SensorsSection) {
    let turn_rad = si_or(&s.turn, 0.0);
    if turn_rad == 0.0 {
        return;
    }
    // to the right of the axes of the record
    let (sin, cos) = sin_cos(turn_rad * s.axes.map_or(1.0, |axes| axes.signs()[1]));
    for [x, y] in [[1, 2], [7, 8]] {
        if !(table.present[x] || table.present[y]) {
            continue;
        }
        table.present[x] = true;
        table.present[y] = true;
        for row in &mut table.rows {
            (row[x], row[y]) = (cos * row[x] - sin * row[y], sin * row[x] + cos * row[y]);
        }
    }
}

/// The channels of the table, in axes forward, right, down.
fn record(b: &mut Builder, s: &SensorsSection, table: &NumberTable) -> Option<SensorRecord> {
    let time_s = table.column(0).unwrap_or_default();
    let sign = s.axes.map_or([1.0; 3], SensorAxes::signs);
    let channel = |i: usize, axis: usize| {
        let samples = table.column(i)?;
        Some(samples.into_iter().map(|x| sign[axis] * x).collect())
    };
    let accelerations = (1..=3).any(|i| table.present[i]);
    if (7..=8).any(|i| table.present[i]) {
        let sound = check_delta_v(b, table);
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

/// Checks that a record of velocity changes has no inapplicable keys.
fn check_delta_v(b: &mut Builder, table: &NumberTable) -> bool {
    let before = b.problems.len();
    for i in [1, 2, 3, 4, 5].into_iter().filter(|&i| table.present[i]) {
        let found = format!("`{}` beside velocity changes", COLUMNS[i].name);
        let expected = "either `t`, `dvx`, `dvy` and `wz`, or accelerations and rates";
        let problem = Problem::error("path", found, expected);
        b.problems.push(Diagnostic::at(&b.document.sources, table.header, problem));
    }
    let expected = "accelerations, or leave the key out";
    let found = |key: &str| format!("`{key}` with a record of velocity changes");
    b.refuse_keys("path", &["gravity", "filter", "baseline", "baseline_end"], found, expected);
    b.problems.len() == before
}
