//! `[path]` of kind "pulse": its keys, converted to a [`PulsePath`].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::number_table::{Column, column};
use super::path::{direction, numbers, pose, refuse};
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, si_or};
use super::{Acceleration, Angle, Length, Ratio, Speed, Time};
use crate::kind;
use occupant_core::vehicle::{DecelerationPoint, PulseDefinition, PulsePath, PulseShape as Shape, Strength};
use placed_text::{Problem, SourceId};

/// A deceleration pulse. The vehicle stays where its speed reaches zero, unless a rebound is given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-at-most-one" = [["peak", "delta_v"], ["file", "rows"]],
    "dependentRequired" = {"rows": ["columns"]},
))]
pub(crate) struct PulseSection {
    /// Pulse shape: deceleration over time.
    pub(crate) shape: PulseShape,
    /// Speed before the pulse.
    pub(crate) speed: Speed<NOT_NEGATIVE>,
    /// Peak deceleration. Give this or `delta_v`.
    pub(crate) peak: Option<Acceleration>,
    /// Change of speed over the pulse. Give this or `peak`.
    pub(crate) delta_v: Option<Speed>,
    /// Duration of a half_sine, haversine, triangle or square pulse.
    pub(crate) duration: Option<Time<POSITIVE>>,
    /// Time of a triangle's peak, as a fraction of its duration; 0.5 if absent.
    pub(crate) peak_fraction: Option<Ratio<FRACTION>>,
    /// Rise time of a trapezoid.
    pub(crate) rise: Option<Time<NOT_NEGATIVE>>,
    /// Plateau time of a trapezoid.
    pub(crate) plateau: Option<Time<NOT_NEGATIVE>>,
    /// Fall time of a trapezoid.
    pub(crate) fall: Option<Time<NOT_NEGATIVE>>,
    /// CSV file beside the scenario with the deceleration of a tabulated pulse; columns `t` and `a`.
    pub(crate) file: Option<String>,
    /// Names and units of the columns of `rows`, such as `["t[ms]", "a[g]"]`; or of those of `file`, instead of its
    /// headings; `"-"` skips a column.
    pub(crate) columns: Option<Vec<String>>,
    /// The table itself, one list for each time.
    pub(crate) rows: Option<Vec<Vec<f64>>>,
    /// When the pulse starts; 0 if absent.
    pub(crate) start: Option<Time<NOT_NEGATIVE>>,
    /// Largest rebound speed; if absent the vehicle stays where it stops.
    pub(crate) rebound: Option<Speed<NOT_NEGATIVE>>,
    /// Direction of travel [x, y, z], any length; the vehicle's heading if absent.
    pub(crate) direction: Option<[Ratio; 3]>,
    /// [x, y, z] of the vehicle's centre of gravity at time 0; [0, 0, 0] if absent.
    pub(crate) position: Option<[Length; 3]>,
    /// Roll; 0 if absent.
    pub(crate) roll: Option<Angle>,
    /// Pitch; 0 if absent.
    pub(crate) pitch: Option<Angle>,
    /// Yaw; 0 if absent.
    pub(crate) yaw: Option<Angle>,
}

/// Shape of a pulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum PulseShape {
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

/// Columns of a tabulated pulse.
const COLUMNS: [Column; 2] = [column("t", kind::TIME, true), column("a", kind::ACCELERATION, true)];

/// The path; `file` is the CSV text the section names, if it names one.
pub(super) fn path(b: &mut Builder, s: &PulseSection, file: Option<SourceId>) -> Option<PulsePath> {
    let tabulated = file.is_some() || s.rows.is_some();
    let table = if tabulated { Some(numbers(b, file, &COLUMNS)?) } else { None };
    let points = table.as_ref().map(|t| {
        let each = t.rows.iter();
        each.map(|row| DecelerationPoint { time_s: row[0], deceleration_m_s2: row[1] }).collect()
    });
    let plain = PulseDefinition::new(s.speed.si(), shape(b, s, points)?);
    let definition = PulseDefinition {
        initial: pose(&s.position, [&s.roll, &s.pitch, &s.yaw]),
        direction: direction(&s.direction),
        starts_at_s: si_or(&s.start, plain.starts_at_s),
        rebound_m_s: s.rebound.as_ref().map(Speed::si),
        ..plain
    };
    PulsePath::new(definition).map_err(|p| refuse(b, &p, table.as_ref())).ok()
}

/// The keys that each shape knows, besides those every pulse has.
fn keys_of(shape: PulseShape) -> &'static [&'static str] {
    match shape {
        PulseShape::HalfSine | PulseShape::Haversine | PulseShape::Square => &["peak", "delta_v", "duration"],
        PulseShape::Triangle => &["peak", "delta_v", "duration", "peak_fraction"],
        PulseShape::Trapezoid => &["peak", "delta_v", "rise", "plateau", "fall"],
        PulseShape::Tabulated => &["file", "columns", "rows"],
    }
}

/// The shape of the pulse; `points` are those of its table, if it has one.
fn shape(b: &mut Builder, s: &PulseSection, points: Option<Vec<DecelerationPoint>>) -> Option<Shape> {
    refuse_foreign_keys(b, s);
    if s.shape == PulseShape::Tabulated {
        if points.is_none() {
            b.error("path", "a tabulated pulse without a table", "`file`, or `columns` and `rows`");
        }
        return points.map(|points| Shape::Tabulated { points });
    }
    let strength = strength(b, s);
    if s.shape == PulseShape::Trapezoid {
        return Some(Shape::Trapezoid {
            rise_s: b.needed("path", "rise", &s.rise),
            plateau_s: b.needed("path", "plateau", &s.plateau),
            fall_s: b.needed("path", "fall", &s.fall),
            strength: strength?,
        });
    }
    let duration_s = b.needed("path", "duration", &s.duration);
    let strength = strength?;
    Some(match s.shape {
        PulseShape::HalfSine => Shape::HalfSine { strength, duration_s },
        PulseShape::Haversine => Shape::Haversine { strength, duration_s },
        PulseShape::Triangle => Shape::Triangle { strength, duration_s, peak_fraction: si_or(&s.peak_fraction, 0.5) },
        PulseShape::Square | PulseShape::Trapezoid | PulseShape::Tabulated => Shape::Square { strength, duration_s },
    })
}

fn strength(b: &mut Builder, s: &PulseSection) -> Option<Strength> {
    match (&s.peak, &s.delta_v) {
        (Some(peak), _) => Some(Strength::PeakDeceleration(peak.si())),
        (None, Some(delta_v)) => Some(Strength::DeltaV(delta_v.si())),
        (None, None) => {
            let expected = "`peak`, the peak deceleration, or `delta_v`, the change of speed";
            let hint = "delta_v equal to speed brings the vehicle to rest";
            let found = "a pulse without `peak` or `delta_v`";
            b.report(Problem::error("path", found, expected).with_hint(Some(hint)));
            None
        }
    }
}

fn refuse_foreign_keys(b: &mut Builder, s: &PulseSection) {
    let known = keys_of(s.shape);
    let keys = ["peak", "delta_v", "duration", "peak_fraction", "rise", "plateau", "fall", "file", "columns", "rows"];
    let foreign: Vec<&str> = keys.into_iter().filter(|key| !known.contains(key)).collect();
    let expected = format!("this shape takes only {}", known.join(", "));
    b.refuse_keys("path", &foreign, |key| format!("this pulse shape does not use `{key}`"), &expected);
}
