//! Histogram and distribution of a figure as plots.

use occupant_study::certainty::Histogram;

use super::quoting::bars;
use crate::base::Told;
use crate::base::shown::{shown_unit, with_unit};
use crate::quoted::Statement;
use occupant_pictures::plot::{Axis, Curve, Figure, Style, inline};

const SIZE: [f64; 2] = [380.0, 290.0];
const BLUE: &str = "#0072b2";
const GREY: &str = "#9a9a9a";
const RED: &str = "#c00000";
/// Largest number of limits drawn.
const LIMITS: usize = 3;

/// Counts over the figure, with its limits.
pub fn histogram(of: &Statement, counted: &Histogram, unit: &Told) -> String {
    let (per, symbol) = shown_unit(unit);
    let mut outline = Vec::new();
    for (from, to, count) in bars(counted) {
        let (from, to, count) = (from / per, to / per, count as f64);
        outline.extend([[from, 0.0], [from, count], [to, count], [to, 0.0]]);
    }
    let most = counted.counts.iter().max().map_or(1.0, |count| *count as f64);
    let mut curves = vec![Curve::new(format!("{} values", of.runs), Style::line(BLUE, 1.6), outline)];
    curves.extend(limits(of, unit, most));
    let axes = [Axis::of(&of.figure, symbol), Axis { includes: Some([0.0, most]), ..Axis::of("values", "") }];
    inline(&Figure::new(&title("Histogram", of), axes, curves), SIZE)
}

/// Fraction of the values up to each value, with its limits and the middle 95 %.
pub fn distribution(of: &Statement, unit: &Told) -> String {
    let (per, symbol) = shown_unit(unit);
    let n = of.values.len() as f64;
    let mut below = 0;
    let steps = of.values.steps().flat_map(|(x, upto)| {
        let from = std::mem::replace(&mut below, upto);
        [from, upto].map(|count| [x / per, count as f64 / n])
    });
    let mut curves = vec![Curve::new("values up to it", Style::line(BLUE, 1.6), steps.collect())];
    let ends = [0.025, 0.975].iter().filter_map(|part| of.quantile(*part));
    let middle = ends.flat_map(|q| [[q.value / per, 0.0], [q.value / per, 1.0], [f64::NAN; 2]]).collect();
    curves.push(Curve::new("2.5 and 97.5 %", Style::line(GREY, 1.1), middle));
    curves.extend(limits(of, unit, 1.0));
    let axes = [Axis::of(&of.figure, symbol), Axis { includes: Some([0.0, 1.0]), ..Axis::of("fraction", "") }];
    inline(&Figure::new(&title("Distribution", of), axes, curves), SIZE)
}

fn title(what: &str, of: &Statement) -> String {
    of.case.as_ref().map_or_else(|| format!("{what}: {}", of.figure), |case| format!("{what}: {}, {case}", of.figure))
}

/// The lowest limits near the values, as upright lines.
fn limits(of: &Statement, unit: &Told, top: f64) -> Vec<Curve> {
    let per = shown_unit(unit).0;
    let greatest = of.values.greatest().unwrap_or(f64::NEG_INFINITY);
    let mut levels: Vec<f64> =
        of.limits.iter().map(|limit| limit.most).filter(|most| *most <= 2.0 * greatest).collect();
    levels.sort_unstable_by(f64::total_cmp);
    levels.dedup();
    let line = |most: &f64| {
        let style = Style { dash: "5 3", ..Style::line(RED, 1.1) };
        Curve::new(with_unit(*most, unit), style, vec![[most / per, 0.0], [most / per, top]])
    };
    levels.iter().take(LIMITS).map(line).collect()
}
