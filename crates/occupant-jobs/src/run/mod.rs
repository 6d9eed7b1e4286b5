//! One run: the file that it writes, the file that it resumes, and its observers. The core does the integration.

mod difference;
pub mod earlier;
pub mod estimate;
#[cfg(test)]
mod hostile_files;
pub mod recording;
pub mod resume;

use std::time::Instant;

use nalgebra::Point3;
use occupant_core::diagnosis::FrictionWatch;
use occupant_core::results::channel::{Channel, Series};
use occupant_core::results::outcome::{ResumeError, Status};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError, Watch};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::{attempt, resume};

use crate::base::Failure;
use crate::files::scenario::Opened;
use crate::judged::Impact;
use estimate::head_m;
use recording::{Recording, Written};
use resume::{Resumption, WithEarlier};

/// A computed run with its closed file.
pub struct Simulated {
    /// Whether it reached its end.
    pub completed: bool,
    /// Its summary.
    pub summary: Summary,
    /// Unstable friction.
    pub friction: FrictionWatch,
    /// Its histories.
    pub histories: Series,
    /// Position of the head at each output.
    pub head: Vec<Point3<f64>>,
    /// The written file.
    pub written: Written,
}

/// Ends a run at its first output.
pub struct FirstOutput;

impl Recorder for FirstOutput {
    fn record(&mut self, _sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        Ok(Flow::Stop)
    }
}

/// Computes a run, from its start or from the end of another, with the histories of `channels`; `watcher` sees each
/// output first, and may stop the run.
///
/// # Errors
/// A file that cannot be written; a checkpoint of another scenario.
pub fn run(
    opened: &Opened,
    from: Option<&Resumption>,
    mut recording: Recording,
    channels: Vec<Channel>,
    watcher: impl Recorder,
) -> Result<Simulated, Failure> {
    let (mut summarizer, mut friction, mut impact) = (Summarizer::new(), FrictionWatch::new(), Impact::default());
    let (mut histories, mut head) = (Series::new(channels), Vec::new());
    let watch_head = Watch(|sample: &Sample<'_>| head.push(head_m(sample)));
    let whole = WithEarlier {
        earlier: from.map(|f| f.earlier.clone()).unwrap_or_default(),
        recorder: (((&mut summarizer, &mut friction), &mut impact), (&mut histories, (watch_head, &mut recording))),
    };
    let recorders = (watcher, whole);
    let began = Instant::now();
    let ended = match from {
        Some(from) => resume(&opened.model, &from.checkpoint, recorders),
        None => attempt(&opened.model, recorders).map_err(ResumeError::Recording),
    };
    let outcome = ended.map_err(|error| Failure::broke_off(format!("{error}{}", recording.left())))?;
    let wall_time_s = began.elapsed().as_secs_f64();
    let completed = outcome.status == Status::Completed;
    let written = recording.close(completed)?;
    let mut summary = summarizer.summary(Some(wall_time_s)).ok_or_else(|| Failure::plain("the run has no summary"))?;
    impact.judge(&mut summary, &opened.model);
    Ok(Simulated { completed, summary, friction, histories, head, written })
}
