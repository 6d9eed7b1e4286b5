//! Bands as a picture: a figure for each channel.
//!
//! The middle 90 % is pale, the middle half darker, the median a line, the unchanged run a dashed one; a red line marks
//! where the members diverge.

use super::{Bands, ChannelBand};
use crate::base::Units;
use occupant_pictures::plot::{Axis, Curve, Figure, Sheet, Style, sheet};

const BLUE: &str = "#0072b2";
/// Colours of the middle 90 % and the middle half.
const AREAS: [&str; 2] = ["#a6cbe3", "#5b9fcb"];
const RED: &str = "#c00000";

/// The drawing as SVG, with `title` and `words` above the figures.
pub fn svg(bands: &Bands, title: &str, words: &str, units: Units) -> String {
    let figures: Vec<Figure> = bands.channels.iter().map(|band| figure(band, &bands.time_s, units)).collect();
    sheet(&Sheet { title: title.to_owned(), lines: vec![words.to_owned()], columns: 2 }, &figures)
}

fn figure(channel: &ChannelBand, time_s: &[f64], units: Units) -> Figure {
    let (per, unit) = units.told(channel.unit).shown;
    let points = |values: &[f64]| -> Vec<[f64; 2]> {
        let timed = time_s.iter().zip(values).filter(|(_, value)| value.is_finite());
        timed.map(|(t, value)| [t * 1e3, value / per]).collect()
    };
    let around = |low: &[f64], high: &[f64]| [points(low), points(high).into_iter().rev().collect()].concat();
    let band = &channel.band;
    let mut curves = vec![
        Curve::new("90 % of the runs", Style::area(AREAS[0]), around(&band.q05, &band.q95)),
        Curve::new("half of them", Style::area(AREAS[1]), around(&band.q25, &band.q75)),
        Curve::new("median", Style::line(BLUE, 1.6), points(&band.median)),
        Curve::new("unchanged run", Style { dash: "4 2.5", ..Style::line("#222222", 1.0) }, points(&channel.nominal)),
    ];
    if let Some(lost_s) = channel.lost_at_s {
        let values = || curves.iter().flat_map(|curve| &curve.points).map(|[_, value]| *value);
        let ends = [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)];
        let at_ms = lost_s * 1e3;
        let label = format!("runs diverge at {at_ms:.1} ms");
        curves.push(Curve::new(label, Style::line(RED, 1.0), ends.map(|value| [at_ms, value]).to_vec()));
    }
    Figure::new(&channel.name, [Axis::of("time", "ms"), Axis::of("", unit)], curves)
}
