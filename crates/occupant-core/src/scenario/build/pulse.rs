//! The shape of a `[path]` of kind "pulse".

use super::builder::Builder;
use crate::scenario::model::{PulseSection, PulseShape as Word};
use crate::scenario::path_text::with_key;
use crate::vehicle::{DecelerationPoint, PulseShape, Strength};

/// The keys that each shape knows, besides those every pulse has.
fn keys_of(shape: Word) -> &'static [&'static str] {
    match shape {
        Word::HalfSine | Word::Haversine | Word::Square => &["peak", "delta_v", "duration"],
        Word::Triangle => &["peak", "delta_v", "duration", "peak_fraction"],
        Word::Trapezoid => &["peak", "delta_v", "rise", "plateau", "fall"],
        Word::Tabulated => &["file", "columns", "rows"],
    }
}

/// The shape of the pulse; `points` are those of its table, if it has one.
pub(super) fn shape(b: &mut Builder, s: &PulseSection, points: Option<Vec<DecelerationPoint>>) -> Option<PulseShape> {
    refuse_foreign_keys(b, s);
    if s.shape == Word::Tabulated {
        if points.is_none() {
            b.error("path", "a tabulated pulse without a table", "`file`, or `columns` and `rows`");
        }
        return points.map(|points| PulseShape::Tabulated { points });
    }
    let strength = strength(b, s);
    if s.shape == Word::Trapezoid {
        return Some(PulseShape::Trapezoid {
            rise_s: b.needed("path", "rise", &s.rise),
            plateau_s: b.needed("path", "plateau", &s.plateau),
            fall_s: b.needed("path", "fall", &s.fall),
            strength: strength?,
        });
    }
    let duration_s = b.needed("path", "duration", &s.duration);
    let strength = strength?;
    Some(match s.shape {
        Word::HalfSine => PulseShape::HalfSine { strength, duration_s },
        Word::Haversine => PulseShape::Haversine { strength, duration_s },
        Word::Triangle => PulseShape::Triangle {
            strength,
            duration_s,
            peak_fraction: b.optional("path.peak_fraction", &s.peak_fraction, 0.5),
        },
        Word::Square | Word::Trapezoid | Word::Tabulated => PulseShape::Square { strength, duration_s },
    })
}

fn strength(b: &mut Builder, s: &PulseSection) -> Option<Strength> {
    match (&s.peak, &s.delta_v) {
        (Some(peak), _) => Some(Strength::PeakDeceleration(b.si("path.peak", peak))),
        (None, Some(delta_v)) => Some(Strength::DeltaV(b.si("path.delta_v", delta_v))),
        (None, None) => {
            b.error_with_hint(
                "path",
                "a pulse that does not say how strong it is",
                "`peak`, its greatest deceleration, or `delta_v`, its change of speed",
                "delta_v equal to speed brings the vehicle to rest",
            );
            None
        }
    }
}

fn refuse_foreign_keys(b: &mut Builder, s: &PulseSection) {
    let given = [
        ("peak", s.peak.is_some()),
        ("delta_v", s.delta_v.is_some()),
        ("duration", s.duration.is_some()),
        ("peak_fraction", s.peak_fraction.is_some()),
        ("rise", s.rise.is_some()),
        ("plateau", s.plateau.is_some()),
        ("fall", s.fall.is_some()),
        ("file", s.file.is_some()),
        ("columns", s.columns.is_some()),
        ("rows", s.rows.is_some()),
    ];
    let known = keys_of(s.shape);
    for (key, there) in given {
        if there && !known.contains(&key) {
            let found = format!("`{key}` has no meaning for this shape of pulse");
            b.error(&with_key("path", key), found, format!("of such keys only {}", known.join(", ")));
        }
    }
}
