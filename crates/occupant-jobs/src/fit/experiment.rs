//! A scenario that models one test or several, with the parameters of the study.

use std::path::PathBuf;

use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::results::channel::{Channel, Series};
use occupant_core::results::recorder::Recorder;
use occupant_core::run::simulate::attempt;
use occupant_scenario::ending::Ending;
use occupant_scenario::{Diagnostics, Loaded};
use occupant_study::{Misfit, Study};

use super::report::short;
use super::{Accord, FAMILY, Target};
use crate::compare::RATE_HZ;
use crate::files::history::{Filter, Histories, Treatment, Untreated, asked, treated};
use crate::files::scenario::Tables;

/// A scenario with the parameters of the study.
pub struct Experiment {
    /// Path of the scenario, for messages and results.
    pub scenario: PathBuf,
    /// Name of the file with the fitted values.
    pub fitted: String,
    /// Its text.
    pub text: String,
    /// The study with this scenario as its base.
    pub study: Study,
    /// Files referred to by the scenario.
    pub tables: Tables,
    /// The model without any parameter.
    pub model: Model,
    /// Measured channels, each with the index of its test.
    pub targets: Vec<(usize, Target)>,
    groups: Vec<(Filter, Vec<Channel>)>,
    /// Channels recorded by the runs.
    pub recorded: Vec<Channel>,
    /// Output interval of its runs, s, if denser than the scenario's.
    pub dense_s: Option<f64>,
}

/// Correction of a test: time offset and gain.
#[derive(Clone, Copy, Debug)]
pub struct Correction {
    /// Shift of time, s.
    pub offset_s: f64,
    /// Factor on the measured values.
    pub gain: f64,
}

impl Experiment {
    /// A scenario without tests.
    ///
    /// # Errors
    /// Problems of the scenario.
    pub fn new(
        scenario: PathBuf,
        text: String,
        study: Study,
        tables: Tables,
    ) -> Result<(Experiment, Diagnostics), Diagnostics> {
        let (_, model, warnings) = tables.open(study.base.clone())?;
        let experiment = Experiment {
            scenario,
            fitted: String::new(),
            text,
            study,
            tables,
            model,
            targets: Vec::new(),
            groups: Vec::new(),
            recorded: Vec::new(),
            dense_s: None,
        };
        Ok((experiment, warnings))
    }

    /// Adds a measured channel of a test.
    pub fn add(&mut self, test: usize, target: Target) {
        let group = self.groups.iter().position(|(f, _)| *f == target.filter);
        let group = group.unwrap_or_else(|| {
            self.groups.push((target.filter, Vec::new()));
            self.groups.len() - 1
        });
        let channels = &mut self.groups[group].1;
        if channels.iter().all(|c| c.name != target.channel.name) {
            channels.push(target.channel.clone());
        }
        self.targets.push((test, target));
        self.recorded.clear();
        for (filter, channels) in &self.groups {
            for channel in asked(&self.model, channels, *filter) {
                if self.recorded.iter().all(|c| c.name != channel.name) {
                    self.recorded.push(channel);
                }
            }
        }
    }

    /// Makes the outputs as dense as the samples of the tests, so that the comparison does not use chords between the
    /// scenario's outputs. At most 10 kHz, the rate of all comparisons, and at most one per fixed step; a study that
    /// varies integrator or outputs keeps its own.
    pub fn write_densely(&mut self) -> Option<String> {
        let interval_s = self.targets.iter().map(|(_, target)| target.interval_s()).fold(f64::INFINITY, f64::min);
        let setup = self.model.setup();
        let step_s = match setup.integrator {
            Integrator::Rk4 { step_s } => step_s,
            Integrator::Adaptive { .. } => 0.0,
        };
        let mut places = self.study.parameters.iter().flat_map(|p| &p.targets);
        let is_varied = places.any(|t| t.path.starts_with("integrator") || t.path.starts_with("output"));
        // what rounding has left in the times of a table is no interval
        let dense_s = (1e7 * interval_s.max(1.0 / RATE_HZ).max(step_s)).round() / 1e7;
        let own_s = setup.time.output_s;
        if is_varied || dense_s > 0.99 * own_s {
            return None;
        }
        self.dense_s = Some(dense_s);
        Some(format!(
            "note: this fit writes outputs every {} ms, the sample interval of the tests, not every {} ms as in {}; runs take longer",
            short(1e3 * dense_s),
            short(1e3 * own_s),
            self.scenario.display()
        ))
    }

    /// First and last comparable output, s.
    pub fn run_s(&self) -> [f64; 2] {
        let time = self.model.setup().time;
        // the last output need not be a whole interval after the one before
        let steps = crash_measures::signal::whole_steps(time.end_s - time.start_s, time.output_s);
        [time.start_s, time.start_s + steps as f64 * time.output_s]
    }

    /// Scenario and model with these values at these paths.
    ///
    /// # Errors
    /// Problems of the scenario then.
    pub fn scenario_with(
        &self,
        changes: impl IntoIterator<Item = (impl AsRef<str>, impl AsRef<str>)>,
    ) -> Result<(Loaded, Model, Diagnostics), Diagnostics> {
        let mut draft = self.study.base.clone();
        for (path, text) in changes {
            draft.set_value(path.as_ref(), text.as_ref())?;
        }
        self.tables.open(draft)
    }

    /// Model of a run of the fit with these values at these paths; its outputs may be denser.
    ///
    /// # Errors
    /// Problems of the scenario then.
    pub fn model_with(
        &self,
        changes: impl IntoIterator<Item = (impl Into<String>, impl Into<String>)>,
    ) -> Result<Model, Diagnostics> {
        let dense = self.dense_s.map(|s| ("output.interval".to_owned(), format!("{s:?} s")));
        let changes = changes.into_iter().map(|(path, text)| (path.into(), text.into())).chain(dense);
        self.scenario_with(changes).map(|(_, model, _)| model)
    }

    /// The model with these values of all parameters, or without any.
    ///
    /// # Errors
    /// Problems of the scenario then.
    pub fn model_of(&self, values: Option<&[f64]>) -> Result<Model, Diagnostics> {
        let assignments = values.map_or(Vec::new(), |v| self.study.assignments_of(v));
        self.model_with(assignments.iter().map(|a| (&a.path, a.text())))
    }

    /// Recorded channels of a run of a model; `also` observes the run too.
    ///
    /// # Errors
    /// An integration that fails; a run whose results mean nothing.
    pub fn run(&self, model: &Model, also: impl Recorder) -> Result<Series, String> {
        let mut series = Series::new(self.recorded.clone());
        let outcome = attempt(model, (&mut series, also)).map_err(|e| e.to_string())?;
        match Ending::of(&outcome).and_then(|ending| ending.reason()) {
            None => Ok(series),
            Some(reason) => Err(reason),
        }
    }

    /// Recorded channels for these values of all parameters, or for the base scenario.
    ///
    /// # Errors
    /// A scenario that is refused; as [`Experiment::run`].
    pub fn run_with(&self, values: Option<&[f64]>) -> Result<Series, String> {
        self.run(&self.model_of(values).map_err(|e| e.to_string())?, ())
    }

    /// Compared histories of a run, by filter.
    ///
    /// # Errors
    /// Outputs too far apart for a filter.
    pub fn histories(&self, series: &Series) -> Result<Vec<(Filter, Histories)>, String> {
        let of = |(filter, channels): &(Filter, Vec<Channel>)| {
            let treatment = Treatment { filter: *filter, family: FAMILY, interval_s: None };
            let histories = treated(&self.model, channels.clone(), series.clone(), treatment);
            histories.map(|h| (*filter, h)).map_err(|e| match e {
                Untreated::Run(reason) => reason,
                Untreated::Channel { name, reason } => format!("{name}: {reason}"),
            })
        };
        self.groups.iter().map(of).collect()
    }

    /// The misfit of each target of a run.
    ///
    /// # Errors
    /// Histories that cannot be compared.
    pub fn misfits(&self, misfit: Misfit, series: &Series, corrections: &[Correction]) -> Result<Vec<f64>, String> {
        self.compared(series, corrections, |target, computed| target.misfit(misfit, computed))
    }

    /// Agreement of each target with a run.
    ///
    /// # Errors
    /// Histories that cannot be compared.
    pub fn accords(&self, series: &Series, corrections: &[Correction]) -> Result<Vec<Accord>, String> {
        self.compared(series, corrections, |target, computed| Ok(Accord::of(&target.reference, computed)))
    }

    /// Computed minus measured values of each target, relative to the largest measured value.
    ///
    /// # Errors
    /// Histories that cannot be compared.
    pub fn residuals(&self, series: &Series, corrections: &[Correction]) -> Result<Vec<Vec<f64>>, String> {
        self.compared(series, corrections, |target, computed| {
            let peak = target.reference.iter().fold(0.0, |g: f64, m| g.max(m.abs()));
            let pairs = computed.iter().zip(&target.reference);
            Ok(pairs.map(|(c, m)| (c - m) / peak).collect())
        })
    }

    /// Applies a comparison to each target, with computed values on the grid of the measured ones.
    fn compared<T>(
        &self,
        series: &Series,
        corrections: &[Correction],
        compare: impl Fn(&Target, &[f64]) -> Result<T, String>,
    ) -> Result<Vec<T>, String> {
        let histories = self.histories(series)?;
        let of = |(test, target): &(usize, Target)| {
            compare(target, &target.computed(in_group(&histories, target.filter)?, corrections[*test])?)
        };
        self.targets.iter().map(of).collect()
    }
}

/// Histories of a filter.
///
/// # Errors
/// A filter that none has.
pub fn in_group(groups: &[(Filter, Histories)], filter: Filter) -> Result<&Histories, String> {
    let found = groups.iter().find(|(f, _)| *f == filter);
    found.map(|(_, histories)| histories).ok_or_else(|| "a channel without a time history".to_owned())
}
