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
