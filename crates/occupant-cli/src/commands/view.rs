//! `occupant view`.

use std::path::PathBuf;

use super::flags::history::seconds;
use crate::base::{Failure, deliver, file_name, note, refuse_input, with_word};
use crate::files::results::Results;
use crate::pictures::Format;
use crate::pictures::body::Snapshot;
use crate::pictures::view::{Strip, View, draw};

/// Pixels of a PNG for each unit of the drawing.
const PIXELS: f64 = 2.0;
/// Interval of the pictures without `--times`, ms.
const EVERY_MS: f64 = 40.0;
/// Without `--times`, no more pictures than this.
const MOST_BY_DEFAULT: usize = 12;
/// With `--times`, no more than this.
const MOST: usize = 120;

/// Draw the body in the compartment from the side, from above and from ahead, at chosen times
///
/// A strip as in the report's Figs 21 to 38: one column a time, one row a view, all to one scale, with belts, and with
/// contacts as arrows of the force on the body. Vehicle axes.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`
    #[arg(value_name = "RUN.mcap")]
    run: PathBuf,

    /// The picture: NAME.svg or NAME.png; RUN-view.svg beside the run if absent
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Replace a file that exists
    #[arg(short, long)]
    force: bool,

    /// Times, such as "0,40,80 ms" or "0.5 s"; a time without a unit takes that of the next one, else it is in seconds.
    /// The nearest output is drawn, and its time written above. Every 40 ms if absent, less often in a long run
    #[arg(long, value_name = "TIMES", allow_hyphen_values = true, value_parser = times)]
    times: Option<Times>,

    /// Views, in order
    #[arg(
        long,
        value_name = "VIEWS",
        value_enum,
        value_delimiter = ',',
        default_values = ["side", "top", "front"]
    )]
    views: Vec<View>,
}

pub(crate) fn view(args: &Args) -> Result<(), Failure> {
    let output = args.output.clone().unwrap_or_else(|| with_word(&args.run.with_extension("svg"), "-view"));
    let format = Format::of_output(&output)?;
    refuse_input(&output, &args.run)?;
    let results = Results::open(&args.run)?;
    results.notes().iter().for_each(note);
    let outputs = outputs(&results, args.times.as_ref())?;
    let mut views: Vec<View> = Vec::new();
    for view in &args.views {
        if !views.contains(view) {
            views.push(*view);
        }
    }
    let strip = Strip { model: &results.model, moments: moments(&results, &outputs)?, views, origin: origin(&results) };
    let bytes = format.encode(&draw(&strip), PIXELS);
    let bytes = bytes.map_err(|e| Failure::with_help(e, "draw fewer times"))?;
    deliver(&output, args.force, &bytes)
}

/// Times, s.
#[derive(Clone, Debug)]
struct Times(Vec<f64>);

/// Reads a list, from its end on, as a time without a unit takes that of the next one.
fn times(list: &str) -> Result<Times, String> {
    let mut unit = "s";
    let mut times = Vec::new();
    for entry in list.rsplit(',').map(str::trim) {
        let digits = entry.trim_end_matches(|c: char| c.is_alphabetic() || c == 'µ');
        let own = entry[digits.len()..].trim();
        let number = digits.trim();
        if !own.is_empty() && number.parse::<f64>().is_ok() {
            unit = own;
        }
        times.push(seconds(&format!("{number} {unit}")).map_err(|reason| format!("`{entry}` is {reason}"))?);
    }
    if times.len() > MOST {
        return Err(format!("{} pictures; at most {MOST} fit on a sheet", times.len()));
    }
    times.reverse();
    Ok(Times(times))
}

/// Indices of the outputs to draw, in order.
fn outputs(results: &Results, wanted: Option<&Times>) -> Result<Vec<usize>, Failure> {
    let at: Vec<f64> = results.checkpoints.iter().map(|c| c.time_s).collect();
    let (first, last) = (at[0], at[at.len() - 1]);
    let wanted = wanted.map_or_else(|| regular(first, last), |times| times.0.clone());
    let half_interval = 0.5 * results.model.setup().time.output_s * (1.0 + 1e-9);
    let nearest = |time: f64| {
        if time < first - half_interval || time > last + half_interval {
            return Err(Failure::with_help(
                format!("no output near {time} s: the outputs go from {first} s to {last} s"),
                "give --times within the run",
            ));
        }
        let after = at.partition_point(|t| *t < time).min(at.len() - 1);
        let before = after.saturating_sub(1);
        let nearer = (time - at[before]).abs() < (at[after] - time).abs();
        Ok(if nearer { before } else { after })
    };
    wanted.into_iter().map(nearest).collect()
}

/// Every 40 ms, or every 80, 200, 400, … in a long run.
fn regular(first_s: f64, last_s: f64) -> Vec<f64> {
    let span_ms = (last_s - first_s) * 1e3;
    let mut every_ms = EVERY_MS;
    for factor in [2.0, 2.5, 2.0].into_iter().cycle() {
        if span_ms / every_ms + 1.0 <= MOST_BY_DEFAULT as f64 || !span_ms.is_finite() {
            break;
        }
        every_ms *= factor;
    }
    let count = (span_ms / every_ms + 1e-6).floor().max(0.0) as usize;
    let time = |i| first_s + i as f64 * every_ms * 1e-3;
    (0..=count).map(time).collect()
}

/// Snapshots of outputs, in the order asked for.
fn moments(results: &Results, outputs: &[usize]) -> Result<Vec<Snapshot>, Failure> {
    let mut seen = Vec::new();
    let mut output = 0;
    results.watch(|sample| {
        if outputs.contains(&output) {
            seen.push((output, Snapshot::of(sample)));
        }
        output += 1;
    })?;
    let find = |wanted: &usize| seen.iter().find(|(at, _)| at == wanted);
    Ok(outputs.iter().filter_map(find).map(|s| s.1.clone()).collect())
}

/// The small print: file, its hash, program.
fn origin(results: &Results) -> String {
    let name = file_name(&results.path);
    let program = results.run.get("program").map_or("-", String::as_str);
    let state = if results.is_complete() { "" } else { ", a run that did not complete" };
    format!("{name} (SHA-256 {}…), run by {program}{state}", &results.sha256[..12])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_takes_the_unit_of_the_next() {
        let close = |list, expected: &[f64]| {
            let found = times(list).unwrap().0;
            assert_eq!(found.len(), expected.len(), "{list}");
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b).abs() < 1e-12, "{list}: {found:?}");
            }
        };
        close("0,40,80 ms", &[0.0, 0.04, 0.08]);
        close("0.1, 0.2", &[0.1, 0.2]);
        close("10ms,0.5 s", &[0.01, 0.5]);
        close("-5 ms", &[-0.005]);
        for wrong in ["", "now", "1 lbf", "1,,2", "inf", "1e400"] {
            assert!(times(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_long_run_gets_fewer_pictures() {
        let last = |v: &[f64]| v[v.len() - 1];
        let short = regular(0.0, 0.2);
        assert_eq!(short.len(), 6);
        assert!((last(&short) - 0.2).abs() < 1e-12);
        let long = regular(0.0, 2.4);
        assert_eq!(long.len(), 7);
        assert!((long[1] - 0.4).abs() < 1e-12);
        assert_eq!(regular(0.0, 0.0), [0.0]);
    }
}
