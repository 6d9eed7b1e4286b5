//! How far a fit is: a bar on a terminal, else a line whenever the score has improved, now and then.

use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use occupant_study::search::Stage;

use super::evaluator::{Record, WORST};
use crate::base::progress::bar;
use crate::base::talk::say;

/// At most a line so often where there is no terminal, stages apart.
const LINE_EVERY: Duration = Duration::from_secs(2);

/// How far a fit is.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    quiet: bool,
    budget: u64,
    evaluations: u64,
    best: f64,
    told: f64,
    stage: &'static str,
    line: Instant,
}

impl Progress {
    /// Of a search of so many evaluations.
    pub(crate) fn new(budget: u64, quiet: bool) -> Self {
        Progress {
            bar: bar(Some(budget), "{bar:30} {pos} of {len} evaluations, {msg}", quiet),
            quiet,
            budget,
            evaluations: 0,
            best: f64::INFINITY,
            told: f64::INFINITY,
            stage: "",
            line: Instant::now(),
        }
    }

    /// What a batch came to.
    pub(crate) fn see(&mut self, stage: Option<Stage>, records: &[Record]) {
        self.evaluations += records.len() as u64;
        let least = records.iter().map(|r| r.score).fold(f64::INFINITY, f64::min);
        if stage.is_some() {
            self.best = self.best.min(least);
        }
        if self.quiet {
            return;
        }
        let (name, words) = words_of(stage);
        if !self.bar.is_hidden() {
            self.bar.set_length(self.budget.max(self.evaluations));
            self.bar.set_position(self.evaluations);
            self.bar.set_message(format!("{words}: score {:.5}", self.best));
            return;
        }
        match stage {
            None => say(&format!("base scenario: {}", score(least))),
            Some(_) => {
                let news = name != self.stage;
                if news || (self.best < self.told && self.line.elapsed() > LINE_EVERY) {
                    say(&format!("{} evaluations, {words}: {}", self.evaluations, score(self.best)));
                    self.told = self.best;
                    self.line = Instant::now();
                }
                self.stage = name;
            }
        }
    }

    /// No more.
    pub(crate) fn end(&self) {
        self.bar.finish_and_clear();
    }
}

/// A score in words.
fn score(score: f64) -> String {
    if score < WORST { format!("score {score:.5}") } else { "no run has completed".to_owned() }
}

/// A stage's name, and in words.
pub(crate) fn words_of(stage: Option<Stage>) -> (&'static str, String) {
    match stage {
        None => ("base", "base scenario".to_owned()),
        Some(Stage::Descent { number, generation }) => {
            ("search", format!("descent {}, generation {}", number + 1, generation + 1))
        }
        Some(Stage::Refinement) => ("refinement", "refinement".to_owned()),
        Some(Stage::Scan) => ("scan", "each parameter alone".to_owned()),
        Some(Stage::Shape) => ("shape", "curvature".to_owned()),
        Some(Stage::Profile) => ("intervals", "intervals".to_owned()),
    }
}
