//! Time range of a result file, and the figures of a partial file that are not those of the whole run.

use occupant_scenario::Draft;

use super::results::Results;

/// The missing part of a run.
pub(super) enum Part {
    /// Affects all figures; description.
    Whole(String),
    /// The part before this time, s; affects figures that do not start there.
    Rest(f64),
}

pub(super) fn in_ms(time_s: f64) -> f64 {
    (1e7 * time_s).round() / 1e4
}

impl Results {
    /// Description of the covered time if it is not the scenario's whole.
    pub(super) fn span(&self) -> Option<String> {
        let (first, last) = (&self.checkpoints[0], &self.checkpoints[self.checkpoints.len() - 1]);
        let name = self.path.display();
        let [from_ms, to_ms] = [first.time_s, last.time_s].map(in_ms);
        if first.index > 0 {
            let whole = if first.peaks.is_empty() {
                "no result includes the time before"
            } else {
                "peaks and measures count from the start of the run; events, throws, ejections and caveats from there"
            };
            return Some(format!("{name} resumes a run and covers {from_ms} to {to_ms} ms: {whole}"));
        }
        Some(format!("{name} covers {from_ms} to {to_ms} ms: it was run with {}", self.given_end()?))
    }

    /// Time span of the outputs, s.
    pub fn covers_s(&self) -> [f64; 2] {
        [0, self.checkpoints.len() - 1].map(|i| self.checkpoints[i].time_s)
    }

    /// End time given on the command line, as text.
    fn given_end(&self) -> Option<&str> {
        self.run.get("overrides")?.lines().rev().find(|line| line.starts_with("time.end="))
    }

    /// End time given by the scenario, s, if any.
    fn own_end_s(&self) -> Option<f64> {
        let draft = Draft::read(self.scenario_text.as_deref()?, self.format?, "scenario").ok()?;
        draft.places("time.end").ok()?.first()?.si
    }

    /// The missing part, which limits the validity of figures.
    pub(super) fn part(&self) -> Option<Part> {
        let [from_s, to_s] = self.covers_s();
        let first = &self.checkpoints[0];
        let is_early =
            self.is_complete() && self.given_end().is_some() && self.own_end_s().is_none_or(|own_s| to_s < own_s);
        match () {
            () if first.index > 0 && first.peaks.is_empty() => Some(Part::Whole(format!(
                "the file begins at {} ms: no result includes the time before",
                in_ms(from_s)
            ))),
            () if is_early => {
                let end = self.given_end().unwrap_or_default();
                Some(Part::Whole(format!(
                    "the run was ended at {} ms by {end}: all results are up to that time",
                    in_ms(to_s)
                )))
            }
            () if first.index > 0 => Some(Part::Rest(from_s)),
            () => None,
        }
    }
}
