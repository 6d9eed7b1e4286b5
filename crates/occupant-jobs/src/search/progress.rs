//! Progress of a search: without a terminal a line for each stage, and now and then one when the score has improved.

use std::time::Duration;

use occupant_study::search::Stage;

use super::Record;
use crate::base::progress::{Runs, Show};

/// Interval of progress lines without a terminal, besides one per stage.
const LINE_EVERY: Duration = Duration::from_secs(2);

/// Progress of a search.
#[derive(Debug)]
pub struct Progress {
    runs: Runs,
    budget: u64,
    evaluations: u64,
    best: f64,
    /// The best score reported so far.
    said: f64,
    stage: &'static str,
}

impl Progress {
    /// Progress of a search with this budget of evaluations.
    pub fn new(budget: u64, show: Show) -> Self {
        let runs = Runs::new(budget, "evaluations", LINE_EVERY, show);
        Progress { runs, budget, evaluations: 0, best: f64::INFINITY, said: f64::INFINITY, stage: "" }
    }

    /// Sets the number of earlier evaluations.
    pub fn from(self, before: u64) -> Self {
        Progress { runs: self.runs.from(before), ..self }
    }

    /// Records a batch; `told` gives the words of a score.
    pub fn see(&mut self, stage: Option<Stage>, records: &[Record], told: &dyn Fn(f64) -> String) {
        self.evaluations += records.len() as u64;
        let least = records.iter().map(|r| r.score).fold(f64::INFINITY, f64::min);
        if stage.is_some() {
            self.best = self.best.min(least);
        }
        let (name, words) = words_of(stage);
        if let Some(bar) = self.runs.bar() {
            bar.set_length(self.budget.max(self.evaluations));
            bar.set_position(self.evaluations);
            bar.set_message(format!(", {words}: {}", told(self.best)));
        } else if stage.is_none() {
            self.runs.say(&format!("base scenario: {}", told(least)));
        } else {
            if name != self.stage || (self.best < self.said && self.runs.is_line_due()) {
                let far = self.runs.words(self.evaluations);
                self.runs.say(&format!("{far}, {words}: {}", told(self.best)));
                self.said = self.best;
            }
            self.stage = name;
        }
    }

    /// Ends the display.
    pub fn end(&self) {
        self.runs.end();
    }
}

/// Name of a stage, and its description.
pub fn words_of(stage: Option<Stage>) -> (&'static str, String) {
    match stage {
        None => ("base", "base scenario".to_owned()),
        Some(Stage::Sample) => ("sample", "samples of the whole range".to_owned()),
        Some(Stage::Descent { number, generation }) => {
            ("search", format!("descent {}, generation {}", number + 1, generation + 1))
        }
        Some(Stage::Model { region, round }) => ("model", format!("region {}, round {}", region + 1, round + 1)),
        Some(Stage::Refinement) => ("refinement", "refinement".to_owned()),
        Some(Stage::Scan) => ("scan", "each parameter alone".to_owned()),
        Some(Stage::Shape) => ("shape", "curvature".to_owned()),
        Some(Stage::Profile) => ("intervals", "intervals".to_owned()),
    }
}
