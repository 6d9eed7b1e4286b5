//! The plots of a report, drawn by [`occupant_pictures::plot`].

use super::{Finding, Input, Response};
use crate::base::shown::{shown_unit, significant};
use occupant_pictures::plot::{Axis, Curve, Figure, Style, inline};
use occupant_units::trig;

/// Size of a plot without its legend.
const SIZE: [f64; 2] = [380.0, 290.0];
/// Height of a plot with word labels: of the axes, per word, and per word if there are many.
const HEAD: f64 = 84.0;
const EACH: [f64; 2] = [24.0, 17.0];
const MANY: usize = 24;
/// Largest number of parameters in a plot with word labels; the tables have all.
const MOST_WORDS: usize = 200;
/// Largest number of dots.
pub const MOST_DOTS: usize = 1500;

const BLUE: &str = "#0072b2";
const ORANGE: &str = "#d55e00";
/// Colour of marked numbers.
const GREY: &str = "#9a9a9a";
const PALE: &str = "#a6cbe3";
/// Colours from the lowest to the highest fifth.
const FIFTHS: [&str; 5] = ["#0d0887", "#6a00a8", "#b12a90", "#e16462", "#fca636"];

/// The two kinds of numbers in a plot: colour, vertical offset, size of their dots.
const KINDS: [(&str, f64, f64); 2] = [(BLUE, -0.14, 7.5), (ORANGE, 0.14, 5.0)];

/// Rank correlations and regression coefficients with their intervals.
pub fn linear(of: &Finding<'_>) -> String {
    let quantities = [("rank_correlation", "rank correlation"), ("regression_coefficient", "regression coefficient")];
    let curves = intervals(of, 0..of.samples.inputs.len(), &quantities);
    let x = Axis { includes: Some([-1.0, 1.0]), ..Axis::of("95 % intervals", "") };
    words_figure("Rank correlation and regression", of, x, curves)
}

/// First-order and total indices with their intervals.
pub fn sobol(of: &Finding<'_>) -> String {
    let curves = intervals(of, of.order(), &[("sobol_first", "first order"), ("sobol_total", "total")]);
    let x = Axis { includes: Some([0.0, 1.0]), ..Axis::of("fraction of the variance, 95 % intervals", "") };
    words_figure("Sobol indices", of, x, curves)
}

/// μ* with its interval, and σ.
pub fn morris(of: &Finding<'_>) -> String {
    let (per, unit) = shown_unit(&of.response.unit);
    let mut curves = intervals(of, of.order(), &[("morris_mu_star", "μ*, mean magnitude")]);
    let deviation = |i: usize| of.value("morris_sigma", i) / per;
    let deviations = of.order().take(MOST_WORDS).enumerate().map(|(at, i)| [deviation(i), at as f64 + 0.14]);
    curves.push(Curve::new("σ, deviation", Style::dots(ORANGE, 7.0), deviations.collect()));
    let x = Axis { includes: Some([0.0, 0.0]), ..Axis::of(&of.response.name, unit) };
    words_figure("Elementary effects over the whole range", of, x, curves)
}

/// Range of the response for each parameter alone.
pub fn tornado(of: &Finding<'_>) -> String {
    let (per, unit) = shown_unit(&of.response.unit);
    let shown = names(of).len();
    let value = |quantity: &str, i: usize| of.value(quantity, i) / per;
    let [mut bars, mut at_least, mut at_greatest] = [const { Vec::new() }; 3];
    for (at, i) in of.order().take(shown).enumerate() {
        let y = at as f64;
        bars.extend([[value("alone_least", i), y], [value("alone_greatest", i), y], [f64::NAN; 2]]);
        at_least.push([value("alone_at_least_value", i), y]);
        at_greatest.push([value("alone_at_greatest_value", i), y]);
    }
    // words have no order, and then neither end
    for ends in [&mut at_least, &mut at_greatest] {
        ends.retain(|[x, _]: &[f64; 2]| x.is_finite());
    }
    let nominal = value("alone_nominal", 0);
    let curves = vec![
        Curve::new("range", Style::line(PALE, 12.0), bars),
        Curve::new("base", Style::line("#222222", 1.2), vec![[nominal, -0.5], [nominal, shown as f64 - 0.5]]),
        Curve::new("at the least value", Style::dots(BLUE, 7.0), at_least),
        Curve::new("at the greatest", Style::dots(ORANGE, 7.0), at_greatest),
    ];
    words_figure("One parameter at a time", of, Axis::of(&of.response.name, unit), curves)
}

/// A response over a parameter.
pub fn scatter(input: &Input, response: &Response) -> String {
    let every = input.values.len().div_ceil(MOST_DOTS).max(1);
    let pairs = input.values.iter().zip(&response.values).step_by(every);
    let up = shown_unit(&response.unit).0;
    let points: Vec<[f64; 2]> = pairs.map(|(x, y)| [place(input, *x), y / up]).collect();
    let curve = Curve::new("", Style::dots(BLUE, diameter(points.len())), points);
    let up = Axis::of(&response.name, shown_unit(&response.unit).1);
    dots_figure(&input.name, [axis_of(input), up], vec![curve])
}

/// Two parameters, each sample coloured by the quintile of its response.
pub fn map(across: &Input, up: &Input, response: &Response, fifths: &[f64; 4]) -> String {
    let (unit_per, unit) = shown_unit(&response.unit);
    let every = response.values.len().div_ceil(MOST_DOTS).max(1);
    let mut points: [Vec<[f64; 2]>; 5] = Default::default();
    for row in (0..response.values.len()).step_by(every) {
        let value = response.values[row];
        if value.is_finite() {
            let fifth = fifths.partition_point(|bound| *bound <= value);
            let at = [place(across, across.values[row]), place(up, up.values[row])];
            points[fifth].push(at);
        }
    }
    let bound = |i: usize| significant(fifths[i] / unit_per);
    let label = |fifth: usize| match fifth {
        0 => format!("below {}", bound(0)),
        4 => format!("above {} {unit}", bound(3)).trim_end().to_owned(),
        _ => format!("to {}", bound(fifth)),
    };
    let count = response.values.len() / every;
    let style = |colour| Style::dots(colour, diameter(count) + 1.0);
    let curves = points.into_iter().zip(FIFTHS).enumerate();
    let curves = curves.map(|(fifth, (points, colour))| Curve::new(label(fifth), style(colour), points));
    let title = format!("{} over two parameters", response.name);
    dots_figure(&title, [axis_of(across), axis_of(up)], curves.collect())
}

/// Names of the parameters drawn.
fn names(of: &Finding<'_>) -> Vec<String> {
    of.order().map(|i| of.samples.inputs[i].name.clone()).take(MOST_WORDS).collect()
}

/// Position of a value on the axis of a parameter.
fn place(input: &Input, value: f64) -> f64 {
    let value = if input.is_number() { value / shown_unit(&input.unit).0 } else { value };
    if input.by_ratios { trig::log10(value) } else { value }
}

fn axis_of(input: &Input) -> Axis {
    match &input.words {
        Some(words) if !words.is_empty() => Axis::of_words(&input.name, words.clone()),
        _ => Axis { is_of_powers: input.by_ratios, ..Axis::of(&input.name, shown_unit(&input.unit).1) },
    }
}

/// Dot diameter for this many dots.
fn diameter(count: usize) -> f64 {
    match count {
        0..=60 => 6.0,
        61..=300 => 5.0,
        301..=800 => 4.0,
        _ => 3.0,
    }
}

/// Whiskers and dots of quantities (name and label) of these parameters; marked ones are grey.
fn intervals(
    of: &Finding<'_>,
    parameters: impl Iterator<Item = usize> + Clone,
    quantities: &[(&str, &str)],
) -> Vec<Curve> {
    let mut curves = Vec::new();
    for ((quantity, label), (colour, lower, size)) in quantities.iter().zip(KINDS) {
        let placed = parameters.clone().filter_map(|i| {
            let at = of.order().take(MOST_WORDS).position(|p| p == i)?;
            Some((at as f64 + lower, of.number(quantity, i)?))
        });
        let (marked, sure): (Vec<_>, Vec<_>) = placed.partition(|(_, number)| of.is_marked(number));
        for (numbers, label, colour) in
            [(sure, (*label).to_owned(), colour), (marked, format!("{label}, marked"), GREY)]
        {
            let Some((_, first)) = numbers.first() else {
                continue;
            };
            let per = if first.in_unit { shown_unit(&of.response.unit).0 } else { 1.0 };
            let whiskers = numbers.iter().flat_map(|(y, n)| {
                let e = &n.estimate;
                [[e.low / per, *y], [e.high / per, *y], [f64::NAN; 2]]
            });
            curves.push(Curve::new("", Style::line(colour, 1.6), whiskers.collect()));
            let dots = numbers.iter().map(|(y, n)| [n.estimate.value / per, *y]);
            curves.push(Curve::new(label, Style::dots(colour, size), dots.collect()));
        }
    }
    curves
}

/// A plot of the parameters in the order of the analysis, by name.
fn words_figure(what: &str, of: &Finding<'_>, x: Axis, curves: Vec<Curve>) -> String {
    let words = names(of);
    let height = HEAD + EACH[usize::from(words.len() > MANY)] * words.len().max(2) as f64;
    let title = format!("{what}: {}", of.response.name);
    inline(&Figure::new(&title, [x, Axis::of_words("", words)], curves), [1.1 * SIZE[0], height])
}

/// A plot with a dot per sample.
fn dots_figure(title: &str, axes: [Axis; 2], curves: Vec<Curve>) -> String {
    let empty = "no sample has a value".to_owned();
    inline(&Figure { empty, ..Figure::new(title, axes, curves) }, SIZE)
}
