//! `[path]`: its keys, converted to a [`VehiclePath`].

use std::ops::Range;

use nalgebra::{Rotation3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::adjusted::{CHANGES, scale_to, shift};
use super::builder::Builder;
use super::drive::{self, DrivenPathSection};
use super::number_table::{Column, NumberTable, column, names_of, read_csv, read_inline};
use super::pulse::{self, PulseSection};
use super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::sensors::{self, SensorAxes, SensorsSection};
use super::{Angle, Frequency, Length, Ratio, Scenario, Speed, Time};
use crate::kind;
use crash_measures::signal::smooth;
use occupant_core::vehicle::{
    AfterEnd, Attitude, FixedPath, Interpolation, PathProblem, Station, TablePath, TravelDirection, VehiclePath,
    VehiclePose,
};
use placed_text::{Diagnostic, Problem, SourceId, with_key};

/// Motion of the vehicle, in vehicle-space axes: x forward, y right, z down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum PathSection {
    /// The vehicle is at rest.
    Fixed(Box<PoseSection>),
    /// Straight travel with a deceleration pulse.
    Pulse(Box<PulseSection>),
    /// Positions and angles at given times.
    Table(Box<TableSection>),
    /// Recorded accelerations and angular rates, or velocity changes as from an event data recorder.
    Sensors(Box<SensorsSection>),
    /// A vehicle of `drive`.
    Drive(Box<DrivenPathSection>),
}

/// Pose of the vehicle. Angles are yaw, then pitch, then roll.
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

/// A table of times, positions or accelerations, and angles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["file", "rows"]], "dependentRequired" = {"rows": ["columns"]}))]
pub(crate) struct TableSection {
    /// CSV file beside the scenario; its first line names the columns and their units, such as
    /// `t[s],x[m],y[m],z[m],roll[deg],pitch[deg],yaw[deg]`. Columns other than `t` may be left out and are then 0.
    /// Accelerations `ax`, `ay`, `az` may stand for positions: along axes that do not turn, such as those of a sled,
    /// without gravity, straight lines between the times. They are integrated from rest.
    pub(crate) file: Option<String>,
    /// Names and units of the columns of `rows`, such as `["t[s]", "x[ft]", "yaw[deg]"]`; or of those of `file`,
    /// instead of its headings; `"-"` skips a column.
    pub(crate) columns: Option<Vec<String>>,
    /// The table itself, one list for each time.
    pub(crate) rows: Option<Vec<Vec<f64>>>,
    /// Axes of the table; "z_down" if absent.
    pub(crate) axes: Option<SensorAxes>,
    /// Order of the rotations; "yaw_pitch_roll" if absent.
    pub(crate) angles: Option<AngleOrder>,
    /// The vehicle point that the table follows, such as the middle of the rear axle: [x, y, z] from the centre of
    /// gravity, forward, right, down; [0, 0, 0] if absent.
    pub(crate) offset: Option<[Length; 3]>,
    /// Cut-off frequency (3 dB, no phase lag) of a smoothing filter on positions or accelerations and on angles, for
    /// tables whose rounding would dominate the second derivatives. Not smoothed if absent.
    pub(crate) filter: Option<Frequency<POSITIVE>>,
    /// Factor on the linear and angular accelerations of the path. Initial position, angles and rates stay. 1 if
    /// absent.
    pub(crate) strength: Option<Ratio<NOT_NEGATIVE>>,
    /// Largest change of the horizontal velocity from the first time on, to which the accelerations are scaled; `strength` acts
    /// on top of it. As in the table if absent.
    pub(crate) delta_v: Option<Speed<POSITIVE>>,
    /// Angle by which changes of the horizontal velocity are turned against the vehicle, clockwise seen from above: the
    /// uncertainty of a principal direction of force. 0 if absent.
    pub(crate) turn: Option<Angle>,
    /// Time added to the clock of the table. Until its first time the vehicle keeps its speed. 0 if absent.
    pub(crate) shift: Option<Time>,
    /// Interpolation between the times; "spline" if absent.
    pub(crate) interpolation: Option<Interpolation>,
    /// What the vehicle does after the last time. If absent, a run beyond it is an error.
    pub(crate) after: Option<AfterEnd>,
}

/// Order of the rotations of a vehicle, each about an axis rotated by the previous ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum AngleOrder {
    /// Yaw about the vertical, then pitch, then roll: ISO 8855, SAE J670, OpenSCENARIO.
    YawPitchRoll,
    /// Roll about the forward axis, then pitch, then yaw.
    RollPitchYaw,
}

/// Columns of a path table.
const COLUMNS: [Column; 10] = [
    column("t", kind::TIME, true),
    column("x", kind::LENGTH, false),
    column("y", kind::LENGTH, false),
    column("z", kind::LENGTH, false),
    column("roll", kind::ANGLE, false),
    column("pitch", kind::ANGLE, false),
    column("yaw", kind::ANGLE, false),
    column("ax", kind::ACCELERATION, false),
    column("ay", kind::ACCELERATION, false),
    column("az", kind::ACCELERATION, false),
];

/// Index of the first position and of the first acceleration among [`COLUMNS`].
const PLACES: [usize; 2] = [1, 7];

impl PathSection {
    /// The CSV file it names, if it names one.
    pub(crate) fn file(&self) -> Option<&str> {
        match self {
            PathSection::Table(table) => table.file.as_deref(),
            PathSection::Pulse(pulse) => pulse.file.as_deref(),
            PathSection::Sensors(sensors) => sensors.file.as_deref(),
            PathSection::Fixed(_) | PathSection::Drive(_) => None,
        }
    }
}

impl Scenario {
    /// All CSV files it names but surfaces, with the positions of the sections that name them.
    pub(crate) fn table_files(&self) -> Vec<(String, &str)> {
        let grid = self.drive.as_ref().and_then(|drive| drive.ground.as_ref()?.grid.as_ref()?.file.as_deref());
        let paths = self.paths().into_iter().filter_map(|(at, path)| Some((at, path.file()?)));
        paths.chain(grid.map(|file| ("drive.ground.grid".to_owned(), file))).collect()
    }

    /// All paths with their positions in the text.
    pub(crate) fn paths(&self) -> Vec<(String, &PathSection)> {
        let named = |key: &str, name: &str| with_key(&with_key(key, name), "path");
        let vehicles = self.vehicles.iter().map(|(name, own)| (named("vehicles", name), &own.path));
        let frames = self.frames.iter().filter_map(|(name, own)| Some((named("frames", name), own.path.as_ref()?)));
        self.path.iter().map(|path| ("path".to_owned(), path)).chain(vehicles).chain(frames).collect()
    }
}

/// The path of a vehicle or frame; `gravity_m_s2` is that of the scenario. Its CSV text is among those of the document.
pub(super) fn path(b: &mut Builder, section: &PathSection, gravity_m_s2: f64) -> Option<VehiclePath> {
    let table = section.file().and_then(|file| b.document.sources.named(file));
    match section {
        PathSection::Drive(s) => drive::path(b, s),
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
    let mut table = numbers(b, file, &COLUMNS)?;
    check_accelerations(b, s, &table)?;
    shift(&mut table, &s.shift, |before, row, after| {
        // places and angles go on as in the first interval, accelerations begin at 0
        let back = (before - row[0]) / (after[0] - row[0]);
        let channel = |(i, x): (usize, &f64)| if i < PLACES[1] { x + back * (after[i] - x) } else { 0.0 };
        row.iter().enumerate().map(channel).collect()
    });
    let after = s.after.unwrap_or_default();
    let path = if (PLACES[1]..PLACES[1] + 3).any(|i| table.present[i]) {
        if let Some(filter) = &s.filter {
            let channels = PLACES[0] + 3..COLUMNS.len();
            smooth_columns(&mut table.rows, channels, filter.si())
                .map_err(|found| b.error("path.filter", found, SMOOTHED))
                .ok()?;
        }
        let [last_m_s, most_m_s] = integrate(&mut table);
        if after == AfterEnd::Hold && last_m_s > 0.02 * most_m_s {
            let found = format!("\"hold\" after accelerations that leave the vehicle at {last_m_s:.2} m/s");
            b.error("path.after", found, "\"coast\", or accelerations that end at rest");
            return None;
        }
        TablePath::with_accelerations_at_ends(stations(s, &table.rows), ends(s, &table.rows), after)
    } else {
        let mut stations = stations(s, &table.rows);
        if let Some(filter) = &s.filter {
            stations =
                smoothed(&stations, filter.si()).map_err(|found| b.error("path.filter", found, SMOOTHED)).ok()?;
        }
        TablePath::new(stations, s.interpolation.unwrap_or_default(), after)
    };
    let path = match si_or(&s.turn, 0.0) {
        0.0 => path,
        turn_rad => path.and_then(|path| path.turned(turn_rad)),
    };
    let strength = s.strength.as_ref().map(Ratio::si);
    let found = match (path, &s.delta_v) {
        (Ok(path), Some(asked)) => {
            let strength =
                scale_to(asked.si(), &table, |strength| path.with_strength(strength).ok().map(VehiclePath::Table));
            let strength =
                strength.map_err(|found| b.error("path.delta_v", found, CHANGES)).ok()? * si_or(&s.strength, 1.0);
            path.with_strength(strength)
        }
        (path, _) => path.and_then(|path| strength.map_or(Ok(path.clone()), |strength| path.with_strength(strength))),
    };
    found.map_err(|p| refuse(b, &p, Some(&table))).ok()
}

/// Checks that each axis has a position or an acceleration, and that the path has accelerations if the table does.
fn check_accelerations(b: &mut Builder, s: &TableSection, table: &NumberTable) -> Option<()> {
    let before = b.problems.len();
    let has = |from: usize| (from..from + 3).any(|i| table.present[i]);
    for axis in 0..3 {
        let [place, acceleration] = PLACES.map(|from| from + axis);
        if table.present[place] && table.present[acceleration] {
            let found = format!("`{}` beside `{}`", COLUMNS[acceleration].name, COLUMNS[place].name);
            let problem = Problem::error("path", found, "the acceleration or the position along an axis, not both");
            b.problems.push(Diagnostic::at(&b.document.sources, table.header, problem));
        }
    }
    if has(PLACES[1]) && s.interpolation == Some(Interpolation::Linear) {
        let found = "straight lines between positions, whose accelerations the table gives";
        b.error("path.interpolation", found, "\"spline\", or leave the key out");
    }
    (b.problems.len() == before).then_some(())
}

/// Positions from accelerations that are straight lines between the times:
/// v′ = v + h (a + a′)/2, x′ = x + h v + h² (2a + a′)/6. A spline through them with the accelerations at its ends has
/// them everywhere. The speed at the end and the greatest one, m/s.
fn integrate(table: &mut NumberTable) -> [f64; 2] {
    let axes: Vec<usize> = (0..3).filter(|axis| table.present[PLACES[1] + axis]).collect();
    let (mut speed_m_s, mut most_m_s) = (Vector3::<f64>::zeros(), 0.0_f64);
    for i in 1..table.rows.len() {
        let h_s = table.rows[i][0] - table.rows[i - 1][0];
        for &axis in &axes {
            let [place, acceleration] = PLACES.map(|from| from + axis);
            let (a, next) = (table.rows[i - 1][acceleration], table.rows[i][acceleration]);
            table.rows[i][place] = table.rows[i - 1][place] + h_s * (speed_m_s[axis] + h_s * (2.0 * a + next) / 6.0);
            speed_m_s[axis] += 0.5 * h_s * (a + next);
        }
        most_m_s = most_m_s.max(speed_m_s.norm());
    }
    [speed_m_s.norm(), most_m_s]
}

/// Low-pass filters columns of a table at `cutoff_hz`.
fn smooth_columns(rows: &mut [Vec<f64>], columns: Range<usize>, cutoff_hz: f64) -> Result<(), String> {
    let time_s: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    for i in columns {
        let values: Vec<f64> = rows.iter().map(|row| row[i]).collect();
        let smooth = smooth(&time_s, &values, cutoff_hz).map_err(|error| error.to_string())?;
        rows.iter_mut().zip(smooth).for_each(|(row, value)| row[i] = value);
    }
    Ok(())
}

const SMOOTHED: &str = "three times or more that increase, and a frequency below half of their rate";

/// The stations, low-pass filtered at `cutoff_hz`.
fn smoothed(stations: &[Station], cutoff_hz: f64) -> Result<Vec<Station>, String> {
    let time_s: Vec<f64> = stations.iter().map(|station| station.time_s).collect();
    let channel = |of: &dyn Fn(&Station) -> f64| -> Result<Vec<f64>, String> {
        let values: Vec<f64> = stations.iter().map(of).collect();
        smooth(&time_s, &values, cutoff_hz).map_err(|error| error.to_string())
    };
    let [x, y, z] = [0, 1, 2].map(|axis| channel(&|station| station.pose.position_m[axis]));
    let angles = [
        channel(&|station| station.pose.attitude.roll_rad)?,
        channel(&|station| station.pose.attitude.pitch_rad)?,
        channel(&|station| station.pose.attitude.yaw_rad)?,
    ];
    let places = [x?, y?, z?];
    let at = |i: usize| Station::new(time_s[i], [0, 1, 2].map(|a| places[a][i]), [0, 1, 2].map(|a| angles[a][i]));
    Ok((0..time_s.len()).map(at).collect())
}

/// The accelerations at the first and at the last time, z down.
fn ends(s: &TableSection, rows: &[Vec<f64>]) -> [Vector3<f64>; 2] {
    let sign = s.axes.map_or([1.0; 3], SensorAxes::signs);
    let at = |row: &Vec<f64>| Vector3::from_fn(|axis, _| sign[axis] * row[PLACES[1] + axis]);
    [rows.first(), rows.last()].map(|row| row.map_or_else(Vector3::zeros, at))
}

/// The vehicle's centre of gravity and angles, z down, at the times of the table.
fn stations(s: &TableSection, rows: &[Vec<f64>]) -> Vec<Station> {
    let sign = s.axes.map_or([1.0; 3], SensorAxes::signs);
    let offset_m = Vector3::from(s.offset.as_ref().map_or([0.0; 3], all_si));
    let mut before = Attitude::default();
    let station = |r: &Vec<f64>| {
        // along X both kinds of axes point ahead: only turns about the other two change their sense
        let (place, angles) = ([0, 1, 2].map(|i| sign[i] * r[1 + i]), [0, 1, 2].map(|i| sign[i] * r[4 + i]));
        let [roll_rad, pitch_rad, yaw_rad] = angles;
        let mut attitude = Attitude { roll_rad, pitch_rad, yaw_rad };
        if s.angles == Some(AngleOrder::RollPitchYaw) {
            let turn = |axis, angle_rad| Rotation3::from_axis_angle(&axis, angle_rad);
            let (x, y, z) = (Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis());
            let turned = turn(x, roll_rad) * turn(y, pitch_rad) * turn(z, yaw_rad);
            attitude = Attitude::from_matrix(turned.matrix(), &before);
        }
        before = attitude;
        let place = Vector3::from(place) - attitude.matrix() * offset_m;
        Station::new(r[0], place.into(), [attitude.roll_rad, attitude.pitch_rad, attitude.yaw_rad])
    };
    rows.iter().map(station).collect()
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

/// The direction of travel turned about the vertical against the vehicle, whose pose is given.
pub(super) fn turned_direction(
    words: &Option<[Ratio; 3]>,
    turn: &Option<Angle>,
    pose: &VehiclePose,
) -> TravelDirection {
    let Some(turn_rad) = turn.as_ref().map(Angle::si).filter(|turn| *turn != 0.0) else { return direction(words) };
    let along = match words {
        Some(words) => Vector3::from(all_si(words)),
        None => pose.attitude.matrix() * Vector3::x(),
    };
    TravelDirection::Along(Rotation3::from_axis_angle(&Vector3::z_axis(), turn_rad) * along)
}

/// Reports the problems of a path, at the line of its table if it names one.
pub(super) fn refuse(b: &mut Builder, problems: &[PathProblem], table: Option<&NumberTable>) {
    for PathProblem { station, found, expected } in problems {
        let problem = Problem::error("path", found, expected);
        match station.and_then(|i| table?.row_spans.get(i).copied()) {
            None => b.report(problem),
            Some(span) => b.problems.add(problem, |problem| Diagnostic::at(&b.document.sources, span, problem)),
        }
    }
}
