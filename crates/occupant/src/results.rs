//! Results of a run.

use occupant_core::model::Model;
use occupant_core::results::channel::{Series, channels, find};
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Figure, Summarizer, Summary};
use occupant_core::run::Run;
use occupant_core::run::simulate::simulate;

use crate::error::{no_channel, unknown};
use crate::measure::Measure;
use crate::{Error, ErrorKind};

/// A model that runs to its end.
pub trait Simulate {
    /// Runs it and keeps everything.
    ///
    /// # Errors
    /// A step that fails: an unstable run has no results.
    fn simulate(&self) -> Result<Results, Error>;
}

impl Simulate for Model {
    fn simulate(&self) -> Result<Results, Error> {
        let mut log = Log::new(self);
        simulate(self, &mut log)?;
        log.results()
    }
}

/// A recorder of everything that results need.
#[derive(Clone, Debug)]
pub struct Log {
    summarizer: Summarizer,
    series: Series,
    /// The recorded run from its first output.
    model: Option<Model>,
}

impl Log {
    /// Records all channels.
    pub fn new(model: &Model) -> Self {
        Log { summarizer: Summarizer::new(), series: Series::new(channels(model)), model: None }
    }

    /// Records only the named channels.
    ///
    /// # Errors
    /// An unknown channel.
    pub fn of(model: &Model, names: &[&str]) -> Result<Self, Error> {
        let chosen = names.iter().map(|name| find(model, name)).collect::<Result<Vec<_>, _>>()?;
        Ok(Log { summarizer: Summarizer::new(), series: Series::new(chosen), model: None })
    }

    /// Ends a recorded run at its present time.
    ///
    /// # Errors
    /// A run without records here, or with records beyond its present time.
    pub fn end(mut self, run: Run<'_>) -> Result<Results, Error> {
        let is_own = self.model.as_ref().is_none_or(|model| model.setup() == run.model().setup());
        if !is_own || self.series.time_s.last().is_some_and(|latest_s| *latest_s > run.time_s()) {
            return Err(Error::new(
                ErrorKind::Recording,
                "a run other than the recorded one; expected the one of this log",
            ));
        }
        run.end(Status::Completed, &mut self)?;
        self.results()
    }

    fn results(self) -> Result<Results, Error> {
        let none = || Error::new(ErrorKind::Recording, "a run without a record; expected `Run::record`");
        let summary = self.summarizer.summary(None).ok_or_else(none)?;
        let model = self.model.ok_or_else(none)?;
        let figures = summary.figures(&model);
        Ok(Results { summary, figures, series: self.series, model })
    }
}

impl Recorder for Log {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.summarizer.begin(model)?;
        self.model = Some(model.clone());
        self.series.begin(model)
    }

    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        let latest_s = self.series.time_s.last().copied();
        if latest_s.is_some_and(|latest_s| latest_s > sample.time_s) {
            return Err(format!(
                "an output at {} s after one at {latest_s:?} s: it belongs to another run",
                sample.time_s
            )
            .into());
        }
        self.series.record(sample)?;
        self.summarizer.record(sample)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.summarizer.end(outcome)
    }
}

/// The results of a run.
#[derive(Clone, Debug)]
pub struct Results {
    summary: Summary,
    figures: Vec<Figure>,
    series: Series,
    model: Model,
}

impl Results {
    /// A measure, in its SI unit.
    ///
    /// # Errors
    /// A measure that the run lacks, such as a neck measure of a body without a neck.
    pub fn measure<M: Measure>(&self, _measure: M) -> Result<f64, Error> {
        self.figure(M::NAME)
    }

    /// A figure by name, in its SI unit: `belts.lap.peak`.
    ///
    /// # Errors
    /// An unknown figure, or one without a value, such as the time of a contact that never came.
    pub fn figure(&self, name: &str) -> Result<f64, Error> {
        let names = || self.figures.iter().map(|figure| figure.name.as_str());
        let figure = self.figures.iter().find(|figure| figure.name == name);
        let value = figure.ok_or_else(|| unknown("measure", name, names()))?.value;
        value.ok_or_else(|| Error::new(ErrorKind::Name, format!("`{name}` has no value in this run")))
    }

    /// All figures.
    pub fn figures(&self) -> &[Figure] {
        &self.figures
    }

    /// Output times, s.
    pub fn time_s(&self) -> &[f64] {
        &self.series.time_s
    }

    /// A channel, one value per output time in its SI unit: `head.acceleration.resultant`.
    ///
    /// # Errors
    /// An unknown channel, or one that was not kept.
    pub fn channel(&self, name: &str) -> Result<&[f64], Error> {
        self.series.of(name).ok_or_else(|| match find(&self.model, name) {
            Ok(_) => Error::new(ErrorKind::Name, format!("the channel `{name}` was not kept: `Log::of`")),
            Err(_) => no_channel(&self.model, name),
        })
    }

    /// The summary, with contacts, peaks of belts, caveats.
    pub fn summary(&self) -> &Summary {
        &self.summary
    }
}
