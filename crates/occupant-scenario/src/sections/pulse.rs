//! `[path]` of kind "pulse": its keys, converted to a [`PulsePath`].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::adjusted::CHANGES;
use super::builder::Builder;
use super::number_table::{Column, column};
use super::path::{numbers, pose, refuse, turned_direction};
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
    /// Name of a pulse of the library, such as that of a rear-impact seat test. Other keys override its values.
    #[schemars(extend("enum" = ["iiwpg_16", "fmvss_202a", "sra_16", "sra_24"]))]
    pub(crate) library: Option<String>,
    /// Pulse shape: deceleration over time. Needed, unless `library` has it.
    pub(crate) shape: Option<PulseShape>,
    /// Speed before the pulse. Needed, unless `library` has it.
    pub(crate) speed: Option<Speed<NOT_NEGATIVE>>,
    /// Peak deceleration. Give this or `delta_v`.
    pub(crate) peak: Option<Acceleration>,
    /// Change of speed over the pulse. Give this or `peak`. A tabulated pulse is scaled to it.
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
    /// Angle by which the direction of travel, and so the change of velocity, is turned against the vehicle, clockwise seen from
    /// above: the uncertainty of a principal direction of force. 0 if absent.
    pub(crate) turn: Option<Angle>,
    /// Factor on the deceleration of a tabulated pulse; 1 if absent.
    pub(crate) strength: Option<Ratio<NOT_NEGATIVE>>,
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
    let Some(kind) = s.shape else {
        b.error("path", "a pulse without `shape`", "`shape`, or `library` with a pulse that has it");
        return None;
    };
    let speed_m_s = b.needed("path", "speed", &s.speed);
    let plain = PulseDefinition::new(speed_m_s, shape(b, s, kind, points)?);
    let initial = pose(&s.position, [&s.roll, &s.pitch, &s.yaw]);
    let definition = PulseDefinition {
        direction: turned_direction(&s.direction, &s.turn, &initial),
        initial,
        starts_at_s: si_or(&s.start, plain.starts_at_s),
        rebound_m_s: s.rebound.as_ref().map(Speed::si),
        ..plain
    };
    let path = PulsePath::new(definition).map_err(|p| refuse(b, &p, table.as_ref())).ok()?;
    doubt(b, &path);
    Some(path)
}

/// Delta-v over speed above which a pulse is probably mistyped, unless the vehicle rebounds.
const TOO_MUCH: f64 = 1.02;

/// Warns of a pulse that continues after the vehicle has stopped, and of a table that accelerates the vehicle.
fn doubt(b: &mut Builder, path: &PulsePath) {
    let km_h = |m_s: f64| format!("{:.1} km/h", 3.6 * m_s);
    let lost = path.pulse_delta_v_m_s();
    let has = path.definition().initial_speed_m_s;
    let at_rest = path.stop().filter(|_| has > 0.0 && lost > TOO_MUCH * path.delta_v_m_s());
    let is_table = matches!(path.definition().shape, Shape::Tabulated { .. });
    if lost < 0.0 && is_table {
        let found = format!("the pulse speeds the vehicle up by {}", km_h(-lost));
        let hint = "a deceleration is positive: reverse the signs of `a`".to_owned();
        b.report(Problem::warning("path", found, "a pulse that slows the vehicle").with_hint(Some(hint)));
    } else if let Some(stop) = at_rest {
        let found = format!(
            "the pulse removes {}, but the vehicle has {}: it stops at {:.1} ms, and the rest of the pulse has no effect",
            km_h(lost),
            km_h(has),
            1e3 * stop.time_s
        );
        let hint = "write a greater `speed`, a smaller `delta_v`, or `rebound` for a vehicle that is driven back";
        b.report(
            Problem::warning("path", found, "a pulse that the vehicle's speed covers").with_hint(Some(hint.to_owned())),
        );
    }
}

/// The keys that each shape knows, besides those every pulse has.
fn keys_of(shape: PulseShape) -> &'static [&'static str] {
    match shape {
        PulseShape::HalfSine | PulseShape::Haversine | PulseShape::Square => &["peak", "delta_v", "duration"],
        PulseShape::Triangle => &["peak", "delta_v", "duration", "peak_fraction"],
        PulseShape::Trapezoid => &["peak", "delta_v", "rise", "plateau", "fall"],
        PulseShape::Tabulated => &["file", "columns", "rows", "delta_v", "strength"],
    }
}

/// The shape of the pulse; `points` are those of its table, if it has one.
fn shape(b: &mut Builder, s: &PulseSection, kind: PulseShape, points: Option<Vec<DecelerationPoint>>) -> Option<Shape> {
    refuse_foreign_keys(b, kind);
    if kind == PulseShape::Tabulated {
        if points.is_none() {
            b.error("path", "a tabulated pulse without a table", "`file`, or `columns` and `rows`");
        }
        let points = scaled(b, s, points?)?;
        return Some(Shape::Tabulated { points });
    }
    let strength = strength(b, s);
    if kind == PulseShape::Trapezoid {
        return Some(Shape::Trapezoid {
            rise_s: b.needed("path", "rise", &s.rise),
            plateau_s: b.needed("path", "plateau", &s.plateau),
            fall_s: b.needed("path", "fall", &s.fall),
            strength: strength?,
        });
    }
    let duration_s = b.needed("path", "duration", &s.duration);
    let strength = strength?;
    Some(match kind {
        PulseShape::HalfSine => Shape::HalfSine { strength, duration_s },
        PulseShape::Haversine => Shape::Haversine { strength, duration_s },
        PulseShape::Triangle => Shape::Triangle { strength, duration_s, peak_fraction: si_or(&s.peak_fraction, 0.5) },
        PulseShape::Square | PulseShape::Trapezoid | PulseShape::Tabulated => Shape::Square { strength, duration_s },
    })
}

/// The points of a table, scaled to a delta-v (the area below its straight lines) and by a strength.
fn scaled(b: &mut Builder, s: &PulseSection, mut points: Vec<DecelerationPoint>) -> Option<Vec<DecelerationPoint>> {
    let mut factor = si_or(&s.strength, 1.0);
    if let Some(asked) = &s.delta_v {
        let area = |pair: &[DecelerationPoint]| {
            0.5 * (pair[0].deceleration_m_s2 + pair[1].deceleration_m_s2) * (pair[1].time_s - pair[0].time_s)
        };
        let own_m_s: f64 = points.windows(2).map(area).sum();
        if own_m_s.abs() < 1e-6 {
            b.error("path.delta_v", "a `delta_v` beside a table in which the velocity does not change", CHANGES);
            return None;
        }
        factor *= asked.si() / own_m_s;
    }
    if factor != 1.0 {
        points.iter_mut().for_each(|point| point.deceleration_m_s2 *= factor);
    }
    Some(points)
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

fn refuse_foreign_keys(b: &mut Builder, kind: PulseShape) {
    let known = keys_of(kind);
    let keys = [
        "peak",
        "delta_v",
        "strength",
        "duration",
        "peak_fraction",
        "rise",
        "plateau",
        "fall",
        "file",
        "columns",
        "rows",
    ];
    let foreign: Vec<&str> = keys.into_iter().filter(|key| !known.contains(key)).collect();
    let expected = format!("this shape takes only {}", known.join(", "));
    b.refuse_keys("path", &foreign, |key| format!("this pulse shape does not use `{key}`"), &expected);
}
