//! The members of an ensemble, run on all cores.
//!
//! What a member leaves depends on its number alone, and the members stand in the order of their numbers: the results are
//! the same bits for any number of threads.

use std::ops::{ControlFlow, Range};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use indicatif::ProgressBar;
use occupant_core::model::Model;
use occupant_core::problem::Severity;
use occupant_core::results::channel::{Channel, Series};
use occupant_core::results::summary::{RunStatus, Summarizer, Summary};
use occupant_core::run::batch::{Ended, Job, simulate_many};
use occupant_core::scenario::Diagnostics;
use occupant_study::Study;

use super::judge::is_result;
use crate::base::failure::Failure;
use crate::base::interrupt::Interrupt;

/// The figures of a run mean nothing above this error of its energy balance.
pub(crate) const BROKEN_BALANCE: f64 = 0.1;

/// What a run of the ensemble left.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Member {
    /// It reached its end.
    Completed(Left),
    /// It did not, or its figures mean nothing; why.
    Failed(String),
}

/// Figures and histories of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Left {
    /// Name, unit and value of each figure.
    pub(crate) figures: Vec<(String, &'static str, Option<f64>)>,
    /// By channel: a value for each output.
    pub(crate) values: Vec<Vec<f64>>,
    /// Times of the outputs, s.
    pub(crate) time_s: Vec<f64>,
}

impl Left {
    /// The value of a figure by its place in the list; NaN if there is none.
    pub(crate) fn value(&self, figure: usize) -> f64 {
        let value = self.figures.get(figure).and_then(|f| f.2);
        value.unwrap_or(f64::NAN)
    }

    /// What the summary of a run and the histories say.
    pub(crate) fn of(summary: &Summary, model: &Model, histories: Series) -> Left {
        let figures = summary.figures(model).into_iter();
        Left {
            figures: figures.filter(|f| is_result(&f.name)).map(|f| (f.name, f.unit, f.value)).collect(),
            values: histories.values,
            time_s: histories.time_s,
        }
    }
}

/// What all members share.
pub(crate) struct Members<'a> {
    /// The ensemble.
    pub(crate) study: &'a Study,
    pub(crate) runs: Range<u64>,
    /// The files that the scenario names.
    pub(crate) resolver: &'a (dyn Fn(&str) -> Result<Vec<u8>, String> + Sync),
    /// Whose histories are kept.
    pub(crate) channels: &'a [Channel],
    pub(crate) threads: usize,
    /// What stops them.
    pub(crate) interrupt: &'a Interrupt,
    /// Shows how far they are.
    pub(crate) bar: &'a ProgressBar,
}

type Recorders = (Interrupt, (Summarizer, Series));

impl Members<'_> {
    /// Runs the members and gives them in order.
    ///
    /// # Errors
    /// Interrupted.
    pub(crate) fn run(&self) -> Result<Vec<Member>, Failure> {
        let count = self.runs.end.saturating_sub(self.runs.start);
        let next = AtomicU64::new(self.runs.start);
        let done: Mutex<Vec<(u64, Member)>> = Mutex::new(Vec::new());
        thread::scope(|scope| {
            for number in 1..self.threads {
                // where the system gives no more threads, those that there are do the work
                let _fewer = thread::Builder::new()
                    .name(format!("ensemble {number}"))
                    .spawn_scoped(scope, || self.work(&next, &done));
            }
            self.work(&next, &done);
        });
        self.bar.finish_and_clear();
        let mut done = done.into_inner().unwrap_or_else(|broken| broken.into_inner());
        match self.interrupt.is_asked() || (done.len() as u64) < count {
            true => Err(Failure::BrokeOff("error: the ensemble was interrupted".to_owned())),
            false => {
                done.sort_unstable_by_key(|(number, _)| *number);
                Ok(done.into_iter().map(|(_, member)| member).collect())
            }
        }
    }

    fn work(&self, next: &AtomicU64, done: &Mutex<Vec<(u64, Member)>>) {
        let put = |number: u64, member: Member| {
            let mut done = done.lock().unwrap_or_else(|broken| broken.into_inner());
            done.push((number, member));
            self.bar.inc(1);
        };
        let jobs = std::iter::from_fn(|| {
            while !self.interrupt.is_asked() {
                let number = next.fetch_add(1, Ordering::Relaxed);
                if number >= self.runs.end {
                    return None;
                }
                match self.model(number) {
                    Ok(model) => return Some(self.job(number, model)),
                    Err(problems) => put(number, Member::Failed(reason(&problems))),
                }
            }
            None
        });
        simulate_many(jobs, |ended| {
            let number = ended.tag;
            if let Some(member) = member(ended) {
                put(number, member);
            }
            ControlFlow::Continue(())
        });
    }

    fn model(&self, number: u64) -> Result<Model, Diagnostics> {
        let loaded = self.study.draft(number)?.load(&self.resolver)?;
        Ok(loaded.model()?.0)
    }

    fn job(&self, number: u64, model: Model) -> Job<u64, Recorders> {
        let histories = Series::new(self.channels.to_vec());
        Job { tag: number, model, recorder: (self.interrupt.clone(), (Summarizer::new(), histories)) }
    }
}

/// What a run that has ended left; nothing of one that was interrupted.
fn member(ended: Ended<u64, Recorders>) -> Option<Member> {
    let (_, (summarizer, histories)) = ended.recorder;
    if let Err(error) = ended.outcome {
        return Some(Member::Failed(error.to_string()));
    }
    let Some(summary) = summarizer.summary(None) else {
        return Some(Member::Failed("it left no summary".to_owned()));
    };
    let off = summary.energy.balance_error.abs();
    match summary.status {
        RunStatus::Interrupted => None,
        RunStatus::Failed => Some(Member::Failed(summary.reason.unwrap_or_default())),
        RunStatus::Completed if off > BROKEN_BALANCE => {
            Some(Member::Failed(format!("its energy balance is off by {:.0} %", 100.0 * off)))
        }
        RunStatus::Completed => Some(Member::Completed(Left::of(&summary, &ended.model, histories))),
    }
}

/// The first error, in one line.
fn reason(problems: &Diagnostics) -> String {
    let first = problems.iter().find(|d| d.problem.severity == Severity::Error);
    let line = first.map(|d| {
        let p = &d.problem;
        format!("{}: {}; expected {}", p.path, p.found, p.expected)
    });
    line.unwrap_or_default().replace(['\n', '\r'], " ")
}
