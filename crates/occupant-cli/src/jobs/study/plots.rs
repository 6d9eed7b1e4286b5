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
    let names = names(samples, &analysis.order);
    let place = |parameter: usize| analysis.order.iter().position(|p| *p == parameter);
    let mut ranks = Vec::new();
    for (i, rank) in analysis.linear.ranks.iter().enumerate() {
        if let (Ok(found), Some(at)) = (rank, place(i)) {
            ranks.push(Entry::of(at, &found.rho, 1.0, caution::rank(found)));
        }
    }
    let mut coefficients = Vec::new();
    if let Ok((which, found)) = &analysis.linear.regression {
        for (i, estimate) in which.iter().zip(&found.coefficients) {
            if let Some(at) = place(*i) {
                coefficients.push(Entry::of(at, estimate, 1.0, caution::regression(found)));
            }
        }
    }
    let mut curves = entries("rank correlation", BLUE, ranks, -0.14);
    curves.extend(entries("regression coefficient", ORANGE, coefficients, 0.14));
    words_figure(
        &title("Rank correlation and regression", samples, analysis),
        Axis { includes: Some([-1.0, 1.0]), ..Axis::of("95 % intervals", "") },
        names,
        curves,
    )
}

/// First-order and total indices with their intervals.
pub(crate) fn sobol(samples: &Samples, analysis: &Analysis, found: &SobolIndices) -> String {
    let of = |estimates: &[Estimate]| -> Vec<Entry> {
        let all = analysis.order.iter().enumerate();
        all.filter_map(|(at, i)| {
            let estimate = estimates.get(*i)?;
            Some(Entry::of(at, estimate, 1.0, caution::index(estimate, found)))
        })
        .collect()
    };
    let mut curves = entries("first order", BLUE, of(&found.first), -0.14);
    curves.extend(entries("total", ORANGE, of(&found.total), 0.14));
    words_figure(
        &title("Sobol indices", samples, analysis),
        Axis { includes: Some([0.0, 1.0]), ..Axis::of("part of the variance, 95 % intervals", "") },
        names(samples, &analysis.order),
        curves,
    )
}

/// μ* with its interval, and σ.
pub(crate) fn morris(samples: &Samples, analysis: &Analysis, found: &[Effect]) -> String {
    let response = &samples.responses[analysis.response];
    let (per, unit) = shown_unit(&response.unit);
    let all = || analysis.order.iter().enumerate();
    let magnitude = |(at, i): (usize, &usize)| {
        let effect = found.get(*i)?;
        Some(Entry::of(at, &effect.mean_magnitude, per, caution::effect(effect)))
    };
    let mut curves = entries("μ*, mean magnitude", BLUE, all().filter_map(magnitude).collect(), -0.14);
    let sigma = |(at, i): (usize, &usize)| Some([found.get(*i)?.deviation / per, at as f64 + 0.14]);
    curves.push(Curve {
        label: "σ, deviation".to_owned(),
        style: Style::dots(ORANGE, 7.0),
        points: all().filter_map(sigma).collect(),
    });
    words_figure(
        &title("Elementary effects over the whole range", samples, analysis),
        Axis { includes: Some([0.0, 0.0]), ..Axis::of(&response.name, unit) },
        names(samples, &analysis.order),
        curves,
    )
}

/// What each parameter alone does.
pub(crate) fn tornado(samples: &Samples, analysis: &Analysis, found: &[Reach]) -> String {
    let response = &samples.responses[analysis.response];
    let (per, unit) = shown_unit(&response.unit);
    let names = names(samples, &analysis.order);
    let shown = names.len();
    let mut bars = Vec::new();
    let (mut at_least, mut at_greatest) = (Vec::new(), Vec::new());
    for (at, i) in analysis.order.iter().take(shown).enumerate() {
        let Some(reach) = found.get(*i) else {
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
    let nominal = found.first().map_or(f64::NAN, |r| r.nominal / per);
    let curve = |label: &str, style: Style, points: Vec<[f64; 2]>| Curve { label: label.to_owned(), style, points };
    let curves = vec![
        curve("range", Style::line(PALE, 12.0), bars),
        curve("base", Style::line("#222222", 1.2), vec![[nominal, -0.5], [nominal, shown as f64 - 0.5]]),
        curve("at the least value", Style::dots(BLUE, 7.0), at_least),
        curve("at the greatest", Style::dots(ORANGE, 7.0), at_greatest),
    ];
    words_figure(&title("One parameter at a time", samples, analysis), Axis::of(&response.name, unit), names, curves)
}

/// A response over a parameter.
pub(crate) fn scatter(input: &Input, response: &Response) -> String {
    let (across, up) = (axis_of(input), axis_of_response(response));
    let every = input.values.len().div_ceil(MOST_DOTS).max(1);
    let pairs = input.values.iter().zip(&response.values).step_by(every);
    let per = [per(input), shown_unit(&response.unit).0];
    let points: Vec<[f64; 2]> = pairs.map(|(x, y)| [x / per[0], y / per[1]]).collect();
    let figure = Figure {
        title: input.name.clone(),
        x: across,
        y: up,
        curves: vec![Curve { label: String::new(), style: Style::dots(BLUE, diameter(points.len())), points }],
        limits: Vec::new(),
        empty: "no sample has a value".to_owned(),
    };
    inline(&figure, SIZE)
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
    let fifth = |((points, label), colour): ((Vec<[f64; 2]>, String), &'static str)| Curve {
        label,
        style: Style::dots(colour, diameter(count) + 1.0),
        points,
    };
    let curves = points.into_iter().zip(labels).zip(FIFTHS).map(fifth);
    let figure = Figure {
        title: format!("{} over two parameters", response.name),
        x: axis_of(across),
        y: axis_of(up),
        curves: curves.collect(),
        limits: Vec::new(),
        empty: "no sample has a value".to_owned(),
    };
    inline(&figure, SIZE)
}

fn title(what: &str, samples: &Samples, analysis: &Analysis) -> String {
    format!("{what}: {}", samples.responses[analysis.response].name)
}

/// Names of the parameters that are drawn.
fn names(samples: &Samples, order: &[usize]) -> Vec<String> {
    let names = order.iter().map(|i| samples.inputs[*i].name.clone());
    names.take(MOST_WORDS).collect()
}

fn per(input: &Input) -> f64 {
    match input.is_number() {
        true => shown_unit(&input.unit).0,
        false => 1.0,
    }
}

fn axis_of(input: &Input) -> Axis {
    match &input.words {
        Some(words) if !words.is_empty() => Axis::of_words(&input.name, words.clone()),
        _ => Axis::of(&input.name, shown_unit(&input.unit).1),
    }
}

fn axis_of_response(response: &Response) -> Axis {
    Axis::of(&response.name, shown_unit(&response.unit).1)
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
fn entries(label: &str, colour: &'static str, all: Vec<Entry>, lower: f64) -> Vec<Curve> {
    let shown = all.into_iter().filter(|e| e.at < MOST_WORDS);
    let (marked, sure): (Vec<Entry>, Vec<Entry>) = shown.partition(|e| e.marked);
    let mut curves = Vec::new();
    for (entries, label, colour) in [(sure, label.to_owned(), colour), (marked, format!("{label}, marked"), GREY)] {
        if entries.is_empty() {
            continue;
        }
        let y = |e: &Entry| e.at as f64 + lower;
        let whisker = |e: &Entry| [[e.interval[0], y(e)], [e.interval[1], y(e)], [f64::NAN; 2]];
        curves.push(Curve {
            label: String::new(),
            style: Style::line(colour, 1.6),
            points: entries.iter().flat_map(whisker).collect(),
        });
        // what a rule marks stays told apart by its shape
        let size = if lower < 0.0 { 7.5 } else { 5.0 };
        curves.push(Curve {
            label,
            style: Style::dots(colour, size),
            points: entries.iter().map(|e| [e.value, y(e)]).collect(),
        });
    }
    curves
}

fn words_figure(title: &str, x: Axis, words: Vec<String>, curves: Vec<Curve>) -> String {
    let height = HEAD + EACH * words.len().max(2) as f64;
    let figure = Figure {
        title: title.to_owned(),
        x,
        y: Axis::of_words("", words),
        curves,
        limits: Vec::new(),
        empty: "nothing to draw".to_owned(),
    };
    inline(&figure, [1.1 * SIZE[0], height])
}
