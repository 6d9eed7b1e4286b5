//! The members of an ensemble, run on all cores.
//!
//! The results of a member depend only on its number, and members are in the order of their numbers. So the results
//! have the same bits for any number of threads.

use std::ops::Range;

use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series};
use occupant_core::results::summary::{Caveat, Figure, Summarizer, Summary};
use occupant_study::Study;
use occupant_study::engine::{Engine, Finished, NotBegun, Source};

use super::judge::is_result;
use crate::base::progress::Bar;
use crate::base::{Failure, Interrupt};

/// Results of a member, or the reason why there are none.
pub type Member = Result<Left, String>;

/// Figures and histories of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Left {
    /// The figures.
    pub figures: Vec<Figure>,
    /// By channel: one value per output.
    pub values: Vec<Vec<f64>>,
    /// Times of the outputs, s.
    pub time_s: Vec<f64>,
    /// Caveats on the figures.
    pub caveats: Vec<Caveat>,
}

impl Left {
    /// The value of a figure by its position in the list; NaN if there is none.
    pub fn value(&self, figure: usize) -> f64 {
        self.figures.get(figure).and_then(|f| f.value).unwrap_or(f64::NAN)
    }

    /// Results of a run from its summary and histories.
    pub fn of(summary: &Summary, model: &Model, histories: Series) -> Left {
        let mut figures = summary.figures(model);
        figures.retain(|f| is_result(&f.name));
        let caveats = summary.caveats.clone();
        Left { figures, values: histories.values, time_s: histories.time_s, caveats }
    }
}

/// Data shared by all members.
pub struct Members<'a> {
    /// The ensemble.
    pub study: &'a Study,
    /// Indices of the runs.
    pub runs: Range<u64>,
    /// Reads files referred to by the scenario.
    pub resolver: &'a (dyn Fn(&str) -> Result<Vec<u8>, String> + Sync),
    /// Channels whose histories are kept.
    pub channels: &'a [Channel],
    /// Request to stop.
    pub interrupt: &'a Interrupt,
    /// Progress display.
    pub bar: Option<&'a dyn Bar>,
}

impl Members<'_> {
    /// Runs the members and returns them in order.
    ///
    /// # Errors
    /// Interrupted.
    pub fn run(&self, engine: &Engine) -> Result<Vec<Member>, Failure> {
        let mut members = Vec::new();
        let ended = engine.run(self, self.runs.clone(), &self.interrupt.asked, |member| {
            members.push(member);
            if let Some(bar) = self.bar {
                bar.set_position(members.len() as u64);
            }
            Ok(())
        });
        if let Some(bar) = self.bar {
            bar.clear();
        }
        ended?;
        if self.interrupt.is_asked() {
            let (done, all) = (members.len(), self.runs.end - self.runs.start);
            return Err(Failure::broke_off(format!(
                "the ensemble was interrupted after {done} of {all} runs: too few for a verdict"
            )));
        }
        members.sort_unstable_by_key(|(number, _)| *number);
        Ok(members.into_iter().map(|(_, member)| member).collect())
    }
}

impl Source for Members<'_> {
    type Recorder = (Summarizer, Series);
    type Row = (u64, Member);
    type Error = Failure;

    fn begin(&self, number: u64) -> Result<(Model, Self::Recorder), NotBegun<Failure>> {
        let loaded = self.study.draft(number)?.load(&self.resolver)?;
        Ok((loaded.model()?.0, (Summarizer::new(), Series::new(self.channels.to_vec()))))
    }

    fn end(&self, run: Finished<Self::Recorder>) -> Result<(u64, Member), Failure> {
        let left = run.ran.and_then(|ran| {
            let (summarizer, histories) = ran.recorder;
            Some(Left::of(&summarizer.summary(None)?, &ran.model, histories))
        });
        let member = match (run.ending.reason(), left) {
            (Some(reason), _) => Err(reason),
            (None, left) => left.ok_or_else(|| "it has no summary".to_owned()),
        };
        Ok((run.index, member))
    }
}
