//! A result file opened again: its scenario, its model, and its outputs as the very samples of the run.
//!
//! A file holds the scenario and a checkpoint at every output, so each output can be evaluated once more, to the bit.
//! Whatever is made from results (plots, views, reports, exports, scores) is a recorder over these samples.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crash_measures::injury::Options;
use occupant_core::diagnosis::FrictionWatch;
use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series};
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::fine::interval_s;
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::{Recorder, Watch};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{RunStatus, Summarizer, Summary};
use occupant_core::run::simulate::{attempt, replay};
use occupant_scenario::ending::{Balance, Ending};
use occupant_scenario::{Format, Loaded};

use super::mcap::StoredRun;
use super::part::{Part, in_ms};
use super::scenario::{format_of, stored};
use super::steps;
use crate::base::{Failure, ending, input_file, program, quoted, sha256};

/// Index of the time nearest to another, the later of two; of the first or the last beyond them. Of no times 0.
pub fn nearest(times_s: &[f64], time_s: f64) -> usize {
    let after = times_s.partition_point(|t| *t < time_s).min(times_s.len().saturating_sub(1));
    let before = after.saturating_sub(1);
    let off_s = |i: usize| times_s.get(i).map_or(f64::INFINITY, |t| (t - time_s).abs());
    if off_s(before) < off_s(after) { before } else { after }
}

/// A recorded run.
pub struct Results {
    /// The file.
    pub path: PathBuf,
    /// Its SHA-256.
    pub sha256: String,
    /// Metadata of the run from its start.
    pub run: BTreeMap<String, String>,
    /// Description of missing outputs.
    lost: Option<String>,
    /// Defects of the file.
    flaw: Option<String>,
    /// End of the run.
    status: RunStatus,
    /// The reason, if it did not complete.
    reason: Option<String>,
    /// The scenario, overrides included.
    pub loaded: Loaded,
    /// Its model.
    pub model: Model,
    /// The scenario as its author wrote it, without overrides.
    pub scenario_text: Option<String>,
    /// Its format.
    pub(super) format: Option<Format>,
    /// One per output, at least one, without gaps.
    pub checkpoints: Vec<Checkpoint>,
}

impl Results {
    /// Opens a result file; an incomplete one as far as it goes, a damaged one up to the first missing output.
    ///
    /// # Errors
    /// A file that cannot be read, holds no run, or whose scenario this program refuses.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        let is_there = path == Path::new("-") || path.exists();
        let absent = || {
            let found = format!("{} cannot be read: there is no such file", path.display());
            Failure::with_help(found, "check the path; `occupant run SCENARIO.toml` writes a result file")
        };
        Results::of_bytes(path, &input_file::read(path).map_err(|e| if is_there { e } else { absent() })?)
    }

    /// The same from the bytes of a file with this name.
    ///
    /// # Errors
    /// As [`Results::open`].
    pub fn of_bytes(path: &Path, bytes: &[u8]) -> Result<Self, Failure> {
        let mut run = StoredRun::read(bytes).map_err(|e| no_results(path, &e))?;
        if run.is_drive {
            let found = format!("{} contains a drive without occupants", path.display());
            let help = "`occupant run` of its scenario simulates the occupants; MCAP viewers show the drive";
            return Err(Failure::with_help(found, help));
        }
        if run.run.is_empty() || run.checkpoints.is_empty() {
            return Err(no_results(path, &format!("it contains no outputs of a run{}", run.because())));
        }
        let (loaded, model, _) = stored(path, &run)?;
        let (lost, mut flaw, (status, reason)) = (run.lost(), run.flaw(), run.ending());
        let wrong = run.checkpoints.iter().enumerate().find_map(|(i, c)| Some((i, c.check(&model).err()?)));
        match wrong {
            Some((i, e)) if i > 0 && e.is_blown_up() => {
                let at_ms = in_ms(run.checkpoints[i].time_s);
                flaw = flaw
                    .or(Some(format!("a run that became unstable: its numbers at {at_ms} ms are beyond all bounds")));
                run.checkpoints.truncate(i);
            }
            Some((_, e)) => return Err(no_results(path, &e.to_string())),
            None => {}
        }
        // nothing is computed over a gap
        let next_is_there = |pair: &&[Checkpoint]| pair[1].index == pair[0].index + 1;
        let whole = run.checkpoints.windows(2).take_while(next_is_there).count() + 1;
        run.checkpoints.truncate(whole);
        let name = run.run.get("scenario");
        let text = name.and_then(|n| run.attachments.get(n));
        Ok(Results {
            path: path.to_owned(),
            sha256: sha256(bytes),
            lost,
            flaw,
            scenario_text: text.map(|t| String::from_utf8_lossy(t).into_owned()),
            format: name.and_then(|n| format_of(Path::new(n))),
            run: run.run,
            status,
            reason,
            loaded,
            model,
            checkpoints: run.checkpoints,
        })
    }

    /// Whether the run reached its end.
    pub fn is_complete(&self) -> bool {
        self.status == RunStatus::Completed
    }

    /// Outcome of the run, by the common rule; none if it was interrupted.
    pub fn ending(&self) -> Option<Ending> {
        match self.status {
            RunStatus::Completed => Ending::of(&self.outcome()),
            RunStatus::Failed => Some(Ending::Failed(self.reason.clone().unwrap_or_default())),
            RunStatus::Interrupted => None,
        }
    }

    /// Reason to doubt its histories, if the energy balance is off.
    pub fn doubt(&self) -> Option<String> {
        let energy = self.outcome().energy;
        let worth = match energy.balance {
            Balance::Kept => return None,
            Balance::Doubtful => "doubtful",
            Balance::Lost => "worth nothing",
        };
        Some(format!("{}: what it holds is {worth}, its energy balance is {}", self.path.display(), energy.found()))
    }

    /// Notes to read before using the results.
    pub fn notes(&self) -> Vec<String> {
        let name = self.path.display();
        let mut notes = Vec::new();
        notes.extend(self.flaw.iter().map(|flaw| format!("{name} is {flaw}")));
        if self.lost.is_some() {
            notes.push(format!("only the outputs of {name} before the first missing one are used"));
        } else if let Some(reason) = &self.reason {
            notes.push(format!("the run in {name} did not complete: {reason}"));
        }
        notes.extend(self.span());
        let theirs = self.run.get("program").map_or("?", String::as_str);
        if theirs != program() {
            notes.push(format!(
                "{name} was written by {theirs}, this is {}: loads are recomputed from its states and may differ",
                program()
            ));
        }
        notes
    }

    /// Interval of instrument readings, s: files of 0.1.0 have them at the outputs only.
    pub fn readings_s(&self) -> f64 {
        let are_there = !self.checkpoints[0].peaks.is_empty();
        if are_there { interval_s(&self.model) } else { self.model.setup().time.output_s }
    }

    /// Replays every output to `recorder`, including the start but not the end of the run.
    ///
    /// # Errors
    /// An error of the recorder.
    pub fn replay(&self, mut recorder: impl Recorder) -> Result<(), Failure> {
        let refused =
            |e: &dyn std::fmt::Display| Failure::plain(format!("{} cannot be evaluated: {e}", self.path.display()));
        recorder.begin(&self.model).map_err(|e| refused(&e))?;
        for checkpoint in &self.checkpoints {
            replay(&self.model, checkpoint, &mut recorder).map_err(|e| refused(&e))?;
        }
        Ok(())
    }

    /// Calls `look` for every output.
    ///
    /// # Errors
    /// None for a file that was opened.
    pub fn watch(&self, look: impl FnMut(&Sample<'_>)) -> Result<(), Failure> {
        self.replay(Watch(look))
    }

    /// Time histories of channels of [`Results::model`].
    ///
    /// # Errors
    /// None for a file that was opened.
    pub fn series(&self, channels: Vec<Channel>) -> Result<Series, Failure> {
        let mut series = Series::new(channels);
        self.replay(&mut series)?;
        Ok(series)
    }

    /// The summary, as at the end of the run.
    ///
    /// # Errors
    /// None for a file that was opened.
    pub fn summary(&self) -> Result<Summary, Failure> {
        self.summary_judged(Options::default(), ())
    }

    /// The summary with measures filtered and compared as `options` require; `watch` sees the same outputs.
    ///
    /// # Errors
    /// None for a file that was opened.
    pub fn summary_judged(&self, options: Options, watch: impl Recorder) -> Result<Summary, Failure> {
        let mut seen = (Summarizer::judging(options), FrictionWatch::new());
        self.replay((&mut seen, watch))?;
        seen.end(&self.outcome()).map_err(|e| self.refused(&e.to_string()))?;
        self.told(&self.model, &seen)
    }

    /// The summary of a repeated run up to the last output, with readings every `interval_s`.
    ///
    /// # Errors
    /// More outputs than a run may have; a run that fails before.
    pub fn summary_again(&self, options: Options, interval_s: f64, watch: impl Recorder) -> Result<Summary, Failure> {
        let mut setup = self.model.setup().clone();
        setup.time.end_s = self.outcome().time_s;
        setup.output.readings_s = Some(interval_s);
        let again = |what: String| self.refused(&format!("it cannot be run again: {what}"));
        let model = Model::new(setup).map_err(|problems| again(self.loaded.diagnose(&problems).to_string()))?;
        let mut seen = (Summarizer::judging(options), FrictionWatch::new());
        let outcome = attempt(&model, (&mut seen, watch)).map_err(|e| again(e.to_string()))?;
        if let Status::Failed(error) = outcome.status {
            return Err(again(error.to_string()));
        }
        self.told(&model, &seen)
    }

    fn refused(&self, what: &str) -> Failure {
        Failure::plain(format!("{}: {what}", self.path.display()))
    }

    /// The finished summary, with the status of this run.
    fn told(&self, model: &Model, (summarizer, friction): &(Summarizer, FrictionWatch)) -> Result<Summary, Failure> {
        let mut summary = summarizer.summary(None).ok_or_else(|| self.refused("the run has no summary"))?;
        if self.is_complete() {
            let caveats = steps::caveats(model, friction, &summary);
            summary.caveats.extend(caveats);
        }
        let summary = summary.ended(self.status, self.reason.clone());
        Ok(match self.part() {
            Some(Part::Whole(text)) => summary.of_part(text),
            Some(Part::Rest(from_s)) => summary.of_rest(from_s),
            None => summary,
        })
    }

    /// Outcome up to the last output.
    fn outcome(&self) -> Outcome {
        self.checkpoints[self.checkpoints.len() - 1].outcome(&self.model)
    }
}

fn no_results(path: &Path, reason: &str) -> Failure {
    let name = path.display();
    if ["toml", "json"].contains(&ending(path).as_str()) {
        let results = quoted(path.with_extension("mcap").display());
        return Failure::with_help(
            format!("{name} is a scenario or a study, not the results of a run"),
            &format!("run it with `occupant run {}`, then give {results}", quoted(name)),
        );
    }
    Failure::with_help(format!("{name} contains no results: {reason}"), "give an .mcap file written by `occupant run`")
}
