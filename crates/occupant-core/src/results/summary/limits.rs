//! Limits by which the measures of a model's bodies are judged, known before any run.

use serde::Serialize;

use super::person::Watched;
use crate::model::Model;
use crate::results::fine::Fine;
use crash_measures::injury::{Options, assess};

/// Samples at rest, enough for the longest window of a measure: 0.2 s at 10 kHz.
const SAMPLES: usize = 2000;
const INTERVAL_S: f64 = 1e-4;

/// A limit of a figure of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureLimit {
    /// The figure, with the name of its occupant, as [`Summary::figures`](super::Summary::figures) names it.
    pub figure: String,
    /// The rule; none for a limit that a user gives.
    pub rule: Option<&'static str>,
    /// The dummy for which the rule states it; none for a limit that a user gives.
    pub dummy: Option<&'static str>,
    /// Largest value allowed, SI unit of the figure.
    pub most: f64,
    /// Whether it was read in a source that quotes the rule; otherwise it is from memory.
    pub quoted: bool,
}

impl FigureLimit {
    /// All limits of a model's bodies: those by which a run of it is judged. They are found by judging a body at rest.
    pub fn of_model(model: &Model) -> Vec<FigureLimit> {
        let fine = Fine::new(model);
        Watched::all(model, &fine).iter().flat_map(|body| of_body(body, &Options::default())).collect()
    }
}

fn of_body(body: &Watched, options: &Options) -> Vec<FigureLimit> {
    let mut signals = body.at_rest(SAMPLES);
    signals.interval_s = INTERVAL_S;
    let options = body.options(options);
    let prefix = if body.name.is_empty() { String::new() } else { format!("{}.", body.name) };
    let mut found: Vec<FigureLimit> = Vec::new();
    for measure in assess(&signals, &options) {
        let figure = format!("{prefix}{}", measure.figure.unwrap_or(measure.name));
        found.extend(measure.limits.iter().map(|limit| FigureLimit {
            figure: figure.clone(),
            rule: Some(limit.rule),
            dummy: Some(options.dummy.name()),
            most: limit.most,
            quoted: limit.quoted,
        }));
    }
    found
}
