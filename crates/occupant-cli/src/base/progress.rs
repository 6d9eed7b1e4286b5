//! Progress of one or many runs: a bar on a terminal; a line for work that shows no bar within two seconds.

use std::fmt;
use std::io::{IsTerminal, stderr};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use std::{mem, thread};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use occupant_core::model::Model;
use occupant_core::results::outcome::Outcome;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;

use occupant_jobs::base::Show;
use occupant_jobs::base::progress::Bar;

/// A recorder that shows the progress of a run.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar on standard error if that is a terminal, else nothing.
    pub(crate) fn new(quiet: bool) -> Self {
        Progress { bar: bar(None, &counted("outputs"), quiet) }
    }
}

/// Time after which work without a bar shows a line.
const SILENT: Duration = Duration::from_secs(2);

/// Status line of work without a bar.
enum Line {
    NotYet,
    Shown(ProgressBar),
    /// Replaced by a bar or the result.
    Over,
}

static LINE: Mutex<Line> = Mutex::new(Line::NotYet);

fn line() -> MutexGuard<'static, Line> {
    LINE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Shows a line with the elapsed time on a terminal, after two seconds of silence.
pub(crate) fn watch(work: String) {
    if !stderr().is_terminal() {
        return;
    }
    thread::spawn(move || {
        thread::sleep(SILENT);
        let mut line = line();
        if matches!(*line, Line::NotYet) {
            let spinner = styled(None, "{spinner} {msg}: {elapsed} so far", false).with_elapsed(SILENT);
            spinner.set_message(work);
            spinner.enable_steady_tick(SILENT / 10);
            *line = Line::Shown(spinner);
        }
    });
}

/// Removes the line for good, before a bar or the result.
pub(crate) fn end_line() {
    if let Line::Shown(spinner) = mem::replace(&mut *line(), Line::Over) {
        spinner.finish_and_clear();
    }
}

/// Writes to the terminal without disturbing the line.
pub(crate) fn beside_line(write: impl FnOnce()) {
    match &*line() {
        Line::Shown(spinner) => spinner.suspend(write),
        _ => write(),
    }
}

/// Template of a bar that counts `what`: number, rate, remaining time, remarks.
pub(crate) fn counted(what: &str) -> String {
    format!("{{bar:30}} {{pos}} of {{len}} {what}, {{rate}}, {{eta}} to go{{msg}}")
}

/// A bar on standard error if that is a terminal, else nothing.
pub(crate) fn bar(length: Option<u64>, template: &str, quiet: bool) -> ProgressBar {
    end_line();
    styled(length, template, quiet)
}

fn styled(length: Option<u64>, template: &str, quiet: bool) -> ProgressBar {
    let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let bar = ProgressBar::with_draw_target(length, target);
    // the words of the template are ours; should they not parse, the plain bar does
    if let Ok(style) = ProgressStyle::with_template(template) {
        let rate = |state: &ProgressState, to: &mut dyn fmt::Write| {
            let _it_stays_empty = write!(to, "{:.1}/s", state.per_sec());
        };
        bar.set_style(style.with_key("rate", rate));
    }
    bar
}

/// Progress bar for jobs.
struct Terminal(ProgressBar);

impl Bar for Terminal {
    fn set_length(&self, all: u64) {
        self.0.set_length(all);
    }

    fn set_position(&self, done: u64) {
        self.0.set_position(done);
    }

    fn set_message(&self, words: String) {
        self.0.set_message(words);
    }

    fn forget_rate(&self) {
        self.0.reset_eta();
    }

    fn clear(&self) {
        self.0.finish_and_clear();
    }
}

/// Progress display of a job on standard error.
pub(crate) fn show(quiet: bool) -> Show {
    Show {
        quiet,
        bar: |all, what| {
            let bar = bar(Some(all), &counted(what), false);
            (!bar.is_hidden()).then(|| Box::new(Terminal(bar)) as Box<dyn Bar>)
        },
    }
}

impl Recorder for Progress {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.bar.set_length(model.output_count() as u64);
        Ok(())
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        if !self.bar.is_hidden() {
            self.bar.set_position(sample.index as u64 + 1);
            self.bar.set_message(format!(", at {:.1} ms", sample.time_s * 1e3));
        }
        Ok(Flow::Continue)
    }

    fn end(&mut self, _outcome: &Outcome) -> Result<(), RecorderError> {
        self.bar.finish_and_clear();
        Ok(())
    }
}
