//! The plots of a report, drawn by [`crate::pictures::plot`].

use occupant_study::analysis::{Effect, Estimate, SobolIndices};

use super::analysis::{Analysis, Reach};
use super::caution;
use super::samples::{Input, Response, Samples};
use super::shown::{shown_unit, significant};
use crate::pictures::plot::{Axis, Curve, Figure, Style, inline};

/// Size of a plot without its legend.
const SIZE: [f64; 2] = [380.0, 290.0];
/// Height of a plot of words: of the axes, and of each word.
const HEAD: f64 = 84.0;
const EACH: f64 = 24.0;
/// At most so many parameters stand in a plot of words.
const MOST_WORDS: usize = 16;
/// At most so many dots are drawn.
pub(crate) const MOST_DOTS: usize = 1500;

const BLUE: &str = "#0072b2";
const ORANGE: &str = "#d55e00";
/// What a rule marks.
const GREY: &str = "#9a9a9a";
const PALE: &str = "#a6cbe3";
/// From the least to the greatest fifth.
const FIFTHS: [&str; 5] = ["#0d0887", "#6a00a8", "#b12a90", "#e16462", "#fca636"];

/// A number of a parameter with its interval, and whether a rule marks it.
struct Entry {
    /// Place of the parameter.
    at: usize,
    value: f64,
    interval: [f64; 2],
    marked: bool,
}

impl Entry {
    fn of(at: usize, estimate: &Estimate, per: f64, mark: Option<String>) -> Self {
        Entry {
            at,
            value: estimate.value / per,
            interval: [estimate.low / per, estimate.high / per],
            marked: mark.is_some(),
        }
    }
}

/// Rank correlations and regression coefficients with their intervals.
pub(crate) fn linear(samples: &Samples, analysis: &Analysis) -> String {
    let place = |parameter: usize| analysis.order.iter().position(|p| *p == parameter);
    let ranks = analysis.linear.ranks.iter().enumerate().filter_map(|(i, rank)| {
        let rank = rank.as_ref().ok()?;
        Some(Entry::of(place(i)?, &rank.rho, 1.0, caution::rank(rank)))
    });
    let mut curves = entries("rank correlation", BLUE, ranks, -0.14);
    if let Ok((which, regression)) = &analysis.linear.regression {
        let coefficients = which
            .iter()
            .zip(&regression.coefficients)
            .filter_map(|(i, estimate)| Some(Entry::of(place(*i)?, estimate, 1.0, caution::regression(regression))));
        curves.extend(entries("regression coefficient", ORANGE, coefficients, 0.14));
    }
    let x = Axis { includes: Some([-1.0, 1.0]), ..Axis::of("95 % intervals", "") };
    words_figure("Rank correlation and regression", samples, analysis, x, curves)
}

/// First-order and total indices with their intervals.
pub(crate) fn sobol(samples: &Samples, analysis: &Analysis, indices: &SobolIndices) -> String {
    let of = |label: &str, colour: &'static str, estimates: &[Estimate], lower: f64| {
        let shown = analysis.order.iter().enumerate().filter_map(|(at, i)| {
            let estimate = estimates.get(*i)?;
            Some(Entry::of(at, estimate, 1.0, caution::index(estimate, *i, indices)))
        });
        entries(label, colour, shown, lower)
    };
    let curves = [of("first order", BLUE, &indices.first, -0.14), of("total", ORANGE, &indices.total, 0.14)].concat();
    let x = Axis { includes: Some([0.0, 1.0]), ..Axis::of("part of the variance, 95 % intervals", "") };
    words_figure("Sobol indices", samples, analysis, x, curves)
}

/// μ* with its interval, and σ.
pub(crate) fn morris(samples: &Samples, analysis: &Analysis, effects: &[Effect]) -> String {
    let response = &samples.responses[analysis.response];
    let (per, unit) = shown_unit(&response.unit);
    let all = || analysis.order.iter().enumerate().filter_map(|(at, i)| Some((at, effects.get(*i)?)));
    let magnitudes = all().map(|(at, effect)| Entry::of(at, &effect.mean_magnitude, per, caution::effect(effect)));
    let mut curves = entries("μ*, mean magnitude", BLUE, magnitudes, -0.14);
    let deviations = all().map(|(at, effect)| [effect.deviation / per, at as f64 + 0.14]);
    curves.push(Curve::new("σ, deviation", Style::dots(ORANGE, 7.0), deviations.collect()));
    let x = Axis { includes: Some([0.0, 0.0]), ..Axis::of(&response.name, unit) };
    words_figure("Elementary effects over the whole range", samples, analysis, x, curves)
}

/// What each parameter alone does.
pub(crate) fn tornado(samples: &Samples, analysis: &Analysis, reaches: &[Reach]) -> String {
    let response = &samples.responses[analysis.response];
    let (per, unit) = shown_unit(&response.unit);
    let shown = names(samples, analysis).len();
    let (mut bars, mut at_least, mut at_greatest) = (Vec::new(), Vec::new(), Vec::new());
    for (at, i) in analysis.order.iter().take(shown).enumerate() {
        let Some(reach) = reaches.get(*i) else {
            continue;
        };
        let y = at as f64;
        let [low, high] = reach.range().map(|x| x / per);
        bars.extend([[low, y], [high, y], [f64::NAN; 2]]);
        if let Some([least, greatest]) = reach.ends() {
            at_least.push([least / per, y]);
            at_greatest.push([greatest / per, y]);
        }
    }
    let nominal = reaches.first().map_or(f64::NAN, |r| r.nominal / per);
    let curves = vec![
        Curve::new("range", Style::line(PALE, 12.0), bars),
        Curve::new("base", Style::line("#222222", 1.2), vec![[nominal, -0.5], [nominal, shown as f64 - 0.5]]),
        Curve::new("at the least value", Style::dots(BLUE, 7.0), at_least),
        Curve::new("at the greatest", Style::dots(ORANGE, 7.0), at_greatest),
    ];
    words_figure("One parameter at a time", samples, analysis, Axis::of(&response.name, unit), curves)
}

/// A response over a parameter.
pub(crate) fn scatter(input: &Input, response: &Response) -> String {
    let every = input.values.len().div_ceil(MOST_DOTS).max(1);
    let pairs = input.values.iter().zip(&response.values).step_by(every);
    let per = [per(input), shown_unit(&response.unit).0];
    let points: Vec<[f64; 2]> = pairs.map(|(x, y)| [x / per[0], y / per[1]]).collect();
    let curve = Curve::new("", Style::dots(BLUE, diameter(points.len())), points);
    let up = Axis::of(&response.name, shown_unit(&response.unit).1);
    dots_figure(&input.name, [axis_of(input), up], vec![curve])
}

/// Two parameters, each sample coloured by the fifth that its response lies in.
pub(crate) fn map(across: &Input, up: &Input, response: &Response, fifths: &[f64; 4]) -> String {
    let (unit_per, unit) = shown_unit(&response.unit);
    let every = response.values.len().div_ceil(MOST_DOTS).max(1);
    let mut points: [Vec<[f64; 2]>; 5] = Default::default();
    for row in (0..response.values.len()).step_by(every) {
        let value = response.values[row];
        if value.is_finite() {
            let fifth = fifths.partition_point(|bound| *bound <= value);
            let at = [across.values[row] / per(across), up.values[row] / per(up)];
            points[fifth].push(at);
        }
    }
    let bound = |i: usize| significant(fifths[i] / unit_per);
    let labels = [
        format!("below {}", bound(0)),
        format!("to {}", bound(1)),
        format!("to {}", bound(2)),
        format!("to {}", bound(3)),
        format!("above {} {unit}", bound(3)).trim_end().to_owned(),
    ];
    let count = response.values.len() / every;
    let style = |colour| Style::dots(colour, diameter(count) + 1.0);
    let curves = points.into_iter().zip(labels).zip(FIFTHS);
    let curves = curves.map(|((points, label), colour)| Curve::new(label, style(colour), points));
    let title = format!("{} over two parameters", response.name);
    dots_figure(&title, [axis_of(across), axis_of(up)], curves.collect())
}

/// Names of the parameters that are drawn.
fn names(samples: &Samples, analysis: &Analysis) -> Vec<String> {
    let names = analysis.order.iter().map(|i| samples.inputs[*i].name.clone());
    names.take(MOST_WORDS).collect()
}

fn per(input: &Input) -> f64 {
    if input.is_number() { shown_unit(&input.unit).0 } else { 1.0 }
}

fn axis_of(input: &Input) -> Axis {
    match &input.words {
        Some(words) if !words.is_empty() => Axis::of_words(&input.name, words.clone()),
        _ => Axis::of(&input.name, shown_unit(&input.unit).1),
    }
}

/// Dots that many others do not hide.
fn diameter(count: usize) -> f64 {
    match count {
        0..=60 => 6.0,
        61..=300 => 5.0,
        301..=800 => 4.0,
        _ => 3.0,
    }
}

/// Whiskers and dots of one kind of number, what a rule marks in grey.
fn entries(label: &str, colour: &'static str, all: impl Iterator<Item = Entry>, lower: f64) -> Vec<Curve> {
    let (marked, sure): (Vec<Entry>, Vec<Entry>) = all.filter(|e| e.at < MOST_WORDS).partition(|e| e.marked);
    let mut curves = Vec::new();
    for (entries, label, colour) in [(sure, label.to_owned(), colour), (marked, format!("{label}, marked"), GREY)] {
        if entries.is_empty() {
            continue;
        }
        let y = |e: &Entry| e.at as f64 + lower;
        let whisker = |e: &Entry| [[e.interval[0], y(e)], [e.interval[1], y(e)], [f64::NAN; 2]];
        curves.push(Curve::new("", Style::line(colour, 1.6), entries.iter().flat_map(whisker).collect()));
        // the two kinds of numbers keep their shapes where a rule marks them
        let size = if lower < 0.0 { 7.5 } else { 5.0 };
        let dots = entries.iter().map(|e| [e.value, y(e)]).collect();
        curves.push(Curve::new(label, Style::dots(colour, size), dots));
    }
    curves
}

/// A plot of the parameters in the order of the analysis, by name.
fn words_figure(what: &str, samples: &Samples, analysis: &Analysis, x: Axis, curves: Vec<Curve>) -> String {
    let words = names(samples, analysis);
    let height = HEAD + EACH * words.len().max(2) as f64;
    let title = format!("{what}: {}", samples.responses[analysis.response].name);
    inline(&Figure::new(&title, [x, Axis::of_words("", words)], curves), [1.1 * SIZE[0], height])
}

/// A plot with a dot for each sample.
fn dots_figure(title: &str, axes: [Axis; 2], curves: Vec<Curve>) -> String {
    let empty = "no sample has a value".to_owned();
    inline(&Figure { empty, ..Figure::new(title, axes, curves) }, SIZE)
}
