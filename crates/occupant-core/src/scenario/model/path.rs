//! `[path]`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Acceleration, Angle, Length, Ratio, Speed, Time};

/// Motion of the vehicle, in vehicle-space axes: x forward, y right, z down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum PathSection {
    /// The vehicle stands still.
    Fixed(PoseSection),
    /// Straight travel, slowed by a deceleration pulse.
    Pulse(Box<PulseSection>),
    /// Places and angles at given times.
    Table(TableSection),
    /// Recorded accelerations and turning rates, or velocity changes.
    Sensors(Box<SensorsSection>),
}

/// Where the vehicle is. Angles are yaw, then pitch, then roll.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PoseSection {
    /// [x, y, z] of the vehicle's centre of gravity; [0, 0, 0] if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<[Length; 3]>,
    /// Roll; 0 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roll: Option<Angle>,
    /// Pitch; 0 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pitch: Option<Angle>,
    /// Yaw; 0 if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub yaw: Option<Angle>,
}

/// A deceleration pulse. The vehicle stays where its speed reaches zero, unless a rebound is given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-at-most-one" = [["peak", "delta_v"], ["file", "rows"]],
    "x-together" = [["columns", "rows"]],
))]
pub struct PulseSection {
    /// Shape of the deceleration over time.
    pub shape: PulseShape,
    /// Speed before the pulse, in the direction of travel.
    #[schemars(extend("minimum" = 0))]
    pub speed: Speed,
    /// Greatest deceleration. Give this or `delta_v`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak: Option<Acceleration>,
    /// Change of speed over the whole pulse. Give this or `peak`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub delta_v: Option<Speed>,
    /// Length of the pulse; half_sine, haversine, triangle, square.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub duration: Option<Time>,
    /// When a triangle has its peak, as a fraction of its duration; 0.5 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub peak_fraction: Option<Ratio>,
    /// Time a trapezoid takes to its plateau.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub rise: Option<Time>,
    /// Time a trapezoid stays on its plateau.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub plateau: Option<Time>,
    /// Time a trapezoid takes back to zero.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub fall: Option<Time>,
    /// CSV file beside the scenario with the deceleration of a tabulated pulse; columns `t` and `a`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Names and units of the columns of `rows`, such as `["t[ms]", "a[g]"]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub columns: Option<Vec<String>>,
    /// The table itself, one list for each time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<Vec<Vec<f64>>>,
    /// When the pulse starts; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub start: Option<Time>,
    /// Speed at which the vehicle may be driven back; it stays where it stops if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("minimum" = 0))]
    pub rebound: Option<Speed>,
    /// Direction of travel [x, y, z], any length; where the vehicle heads if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<[Ratio; 3]>,
    /// [x, y, z] of the vehicle's centre of gravity at time 0; [0, 0, 0] if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<[Length; 3]>,
    /// Roll; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roll: Option<Angle>,
    /// Pitch; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch: Option<Angle>,
    /// Yaw; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yaw: Option<Angle>,
}

/// Shape of a pulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PulseShape {
    /// Half a period of a sine.
    HalfSine,
    /// Sine squared.
    Haversine,
    /// Up and down in straight lines.
    Triangle,
    /// Up, level, down.
    Trapezoid,
    /// Constant.
    Square,
    /// Straight lines between the points of a table.
    Tabulated,
}

/// A table of times, places and angles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["file", "rows"]], "x-together" = [["columns", "rows"]]))]
pub struct TableSection {
    /// CSV file beside the scenario; its first line names the columns and their units, such as
    /// `t[s],x[m],y[m],z[m],roll[deg],pitch[deg],yaw[deg]`. Columns other than `t` may be left out and are then 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Names and units of the columns of `rows`, such as `["t[s]", "x[ft]", "yaw[deg]"]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub columns: Option<Vec<String>>,
    /// The table itself, one list for each time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<Vec<Vec<f64>>>,
    /// How the table is read between its times; "spline" if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interpolation: Option<Interpolate>,
    /// What the vehicle does after the last time; a run that goes on is refused if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after: Option<After>,
}

/// How a table is read between its times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Interpolate {
    /// Straight lines, as in the report; velocities jump at every time.
    Linear,
    /// Natural cubic splines.
    Spline,
}

/// What the vehicle does after the last time of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum After {
    /// A run that goes on is refused.
    Error,
    /// It goes on with constant velocity.
    Coast,
    /// It stands still.
    Hold,
}

/// What sensors in the vehicle recorded, along its axes: x forward, y right, z down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("x-exactly-one" = [["file", "rows"]], "x-together" = [["columns", "rows"]]))]
pub struct SensorsSection {
    /// CSV file beside the scenario; its first line names the columns and their units: `t`, accelerations `ax`, `ay`, `az`
    /// and rates `wx`, `wy`, `wz` (or `roll_rate`, `pitch_rate`, `yaw_rate`), such as `t[s],ax[g],ay[g],wz[deg/s]`; or
    /// velocity changes `dvx`, `dvy` with `wz`, such as `t[ms],dvx[km/h]`. An acceleration, rate or velocity change that
    /// has no column is a motion that is not there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Names and units of the columns of `rows`, such as `["t[ms]", "ax[g]"]`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub columns: Option<Vec<String>>,
    /// The record itself, one list for each time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows: Option<Vec<Vec<f64>>>,
    /// Speed of the vehicle's centre of gravity when the path starts.
    #[schemars(extend("minimum" = 0))]
    pub speed: Speed,
    /// Direction of that speed [x, y, z], any length; where the vehicle heads if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<[Ratio; 3]>,
    /// What gravity does in the accelerations. Must be given with them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<RecordedGravity>,
    /// Which way the sensors' axes point; "z_down" if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axes: Option<SensorAxes>,
    /// Where the sensors stand, [x, y, z] from the vehicle's centre of gravity, forward, right, down; [0, 0, 0] if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub offset: Option<[Length; 3]>,
    /// Channel frequency class (ISO 6487, without phase lag) that all accelerations and rates are filtered by; not
    /// filtered if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filter: Option<FilterClass>,
    /// Length of the rest, or steady travel, at the beginning of the record; what each channel reads there on average
    /// beyond what it should is taken away from all of it. Nothing is taken away if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub baseline: Option<Time>,
    /// Time of the record at which the path starts and position, angles and speed hold; its first time if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<Time>,
    /// [x, y, z] of the vehicle's centre of gravity when the path starts; [0, 0, 0] if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<[Length; 3]>,
    /// Roll when the path starts; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roll: Option<Angle>,
    /// Pitch when the path starts; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch: Option<Angle>,
    /// Yaw when the path starts; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yaw: Option<Angle>,
    /// What the vehicle does after the last time; a run that goes on is refused if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub after: Option<After>,
}

/// What gravity does in recorded accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RecordedGravity {
    /// It is in them: a level vehicle at rest reads 1 g upwards.
    Included,
    /// The sensors were zeroed before the test, at rest in the initial attitude: they read 0 there, and gravity comes
    /// in as the vehicle turns.
    Zeroed,
    /// It was taken out of them at every instant: a vehicle at rest reads 0 in any attitude.
    Removed,
}

/// Which way the axes of sensors point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SensorAxes {
    /// x forward, y right, z down (SAE J211, J670).
    ZDown,
    /// x forward, y left, z up (ISO 8855).
    ZUp,
}

/// Channel frequency class.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FilterClass {
    /// CFC 60.
    Cfc60,
    /// CFC 180.
    Cfc180,
    /// CFC 600.
    Cfc600,
    /// CFC 1000.
    Cfc1000,
}
