//! A fit before its search: a study, its tests, and their scenarios.

use std::path::Path;

use occupant_core::model::Model;
use occupant_core::results::channel::Series;
use occupant_core::results::summary::Caveat;
use occupant_scenario::Diagnostics;
use occupant_study::engine::Ran;
use occupant_study::{ApplyChoice, Bounds, Distribution, Fit, Law, Parameter, StudyText, Within};
use serde::Serialize;

use super::opening::{Given, Opening};
use super::{Correction, Experiment, Objective, Target, WORST};
use crate::base::{Failure, file_name, file_stem};
use crate::files::scenario::{nothing_was_run, refused};
use crate::files::study_folder::{Column, Manifest, NamedBy, Role, Text, Texts};
use crate::search::within;
use crate::sweep::plan::study_text;

/// Largest number of evaluations beyond the budget.
const ON_TOP: u64 = 1 << 20;
/// Added to the score of a candidate that was moved across all of its range: more than any score, so that the lowest is where no
/// candidate is moved.
const OF_MOVE: f64 = 10.0;

/// A study, its tests, and their scenarios. Shared by all threads.
pub struct Fitting {
    /// The fit section of the study.
    pub fit: Fit,
    /// The experiments.
    pub experiments: Vec<Experiment>,
    /// The tests.
    pub tests: Vec<Test>,
    /// Fitted parameters: those of the study, then offsets and gains of tests.
    pub parameters: Vec<Parameter>,
    /// Bounds of the parameters.
    pub bounds: Vec<Bounds>,
    /// The points that keep the constraints of the study.
    pub within: Option<Within>,
    /// Changes from the command line.
    pub overrides: Vec<String>,
    /// Manifest of the fit's folder; its first text is the study.
    pub manifest: Manifest,
    /// Bytes of the manifest's texts.
    pub texts: Vec<Vec<u8>>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// A test.
#[derive(Clone, Debug, Serialize)]
pub struct Test {
    /// Its name in results.
    pub name: String,
    /// Its file, as given.
    pub file: String,
    /// SHA-256 of the file.
    pub sha256: String,
    /// The scenario that reproduces it.
    pub scenario: String,
    /// File of that scenario with fitted values.
    pub fitted: String,
    /// Index of its experiment.
    #[serde(skip)]
    pub experiment: usize,
    /// Ranges of its offset and gain.
    #[serde(skip)]
    pub nuisances: [Option<[f64; 2]>; 2],
}

impl Fitting {
    /// Reads a study, its scenarios and its tests; `name` is its name in messages.
    ///
    /// # Errors
    /// All problems, as text.
    pub fn open(name: &Path, given: &Given<'_>, program: String) -> Result<Fitting, Failure> {
        Fitting::of(name, given, &Texts::of_files(name), program)
    }

    /// The same from these texts.
    ///
    /// # Errors
    /// As [`Fitting::open`].
    pub fn of(name: &Path, given: &Given<'_>, texts: &Texts, program: String) -> Result<Fitting, Failure> {
        let shown = name.display().to_string();
        let text = study_text(name, texts)?;
        let fit = text.fit().map_err(|problems| refused(&shown, &problems))?;
        let folder = name.parent().unwrap_or(Path::new(""));
        let mut opening = Opening::new(folder, &text, texts, given);
        let tests = opening.tests(&fit);
        let Opening { problems, mut experiments, mut warnings, .. } = opening;
        if !problems.is_empty() || experiments.is_empty() {
            return Err(Failure::CouldNotRun(ended(&problems, &shown)));
        }
        warnings.extend(experiments.iter_mut().filter_map(Experiment::write_densely));
        let mut parameters = experiments[0].study.parameters.clone();
        parameters.extend(tests.iter().flat_map(nuisances));
        let bounds: Option<Vec<Bounds>> = parameters.iter().map(|p| p.law.bounds()).collect();
        // bind_fit has refused parameters without ends
        let bounds = bounds.ok_or_else(|| Failure::plain("a parameter without a range"))?;
        let within = within(&experiments[0].study.relations, &bounds)?;
        let tests = name_fitted(&mut experiments, tests);
        let samples = experiments.len() as u64 * fit.budget.saturating_add(ON_TOP);
        let (manifest, texts) = manifest(&text, texts, given, samples, program);
        let overrides = given.overrides.to_vec();
        Ok(Fitting { fit, experiments, tests, parameters, bounds, within, overrides, manifest, texts, warnings })
    }

    /// Corrections of all tests for these values of all parameters, or none.
    pub fn corrections(&self, values: Option<&[f64]>) -> Vec<Correction> {
        let own = self.experiments[0].study.parameters.len();
        let mut found = values.and_then(|values| values.get(own..)).unwrap_or_default().iter();
        let mut next = |ends: Option<[f64; 2]>, none: f64| ends.and_then(|_| found.next().copied()).unwrap_or(none);
        let of =
            |test: &Test| Correction { offset_s: next(test.nuisances[0], 0.0), gain: next(test.nuisances[1], 1.0) };
        self.tests.iter().map(of).collect()
    }

    /// All targets by experiment, each with the index of its test.
    pub fn targets(&self) -> impl Iterator<Item = &(usize, Target)> {
        self.experiments.iter().flat_map(|e| &e.targets)
    }

    /// Score from the misfits of all targets, by experiment.
    pub fn combined(&self, parts: &[f64]) -> f64 {
        let weights = self.targets().map(|(_, target)| target.weight);
        self.fit.misfit.combined(weights.zip(parts.iter().copied()))
    }
}

impl Objective for Fitting {
    type Recorder = Series;

    fn word(&self) -> &'static str {
        "fit"
    }

    fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    fn bounds(&self) -> &[Bounds] {
        &self.bounds
    }

    fn within(&self) -> Option<&Within> {
        self.within.as_ref()
    }

    fn of_move(&self, at: &[f64]) -> f64 {
        self.within.as_ref().map_or(0.0, |within| OF_MOVE * within.apart(&self.asked(at)))
    }

    fn runs(&self) -> u64 {
        self.experiments.len() as u64
    }

    fn begin(&self, run: u64, values: Option<&[f64]>) -> Result<(Model, Series), Diagnostics> {
        let experiment = &self.experiments[run as usize];
        Ok((experiment.model_of(values)?, Series::new(experiment.recorded.clone())))
    }

    fn end(&self, run: u64, values: Option<&[f64]>, ran: Ran<Series>) -> Result<(Vec<f64>, Vec<Caveat>), String> {
        let experiment = &self.experiments[run as usize];
        let misfits = experiment.misfits(self.fit.misfit, &ran.recorder, &self.corrections(values))?;
        Ok((misfits, Vec::new()))
    }

    fn score(&self, parts: &[f64], _has_caveats: bool) -> f64 {
        self.combined(parts)
    }

    fn told(&self, score: f64) -> String {
        if score < WORST { format!("score {score:.5}") } else { "no completed run yet".to_owned() }
    }

    fn columns(&self) -> Vec<Column> {
        let column = |(test, target): &(usize, Target)| Column {
            name: format!("{}.{}", self.tests[*test].name, target.channel.name),
            unit: "1".to_owned(),
            role: Role::Figure,
        };
        self.targets().map(column).collect()
    }

    fn row(&self, parts: &[f64]) -> Vec<f64> {
        (0..self.targets().count()).map(|i| parts.get(i).copied().unwrap_or(f64::NAN)).collect()
    }
}

/// Offset and gain of a test, if fitted. They do not affect the scenario.
fn nuisances(test: &Test) -> impl Iterator<Item = Parameter> {
    let kinds = [("offset", "s", ApplyChoice::Offset), ("gain", "", ApplyChoice::Factor)];
    kinds.into_iter().zip(test.nuisances).filter_map(|((word, unit, apply), ends)| {
        let [from, to] = ends?;
        let name = format!("{}.{word}", test.name);
        let law = Law::Distribution(Distribution::Uniform { from, to });
        Some(Parameter { name, unit, apply, law, crossed: false, targets: Vec::new(), source: "" })
    })
}

/// Names of the fitted scenarios: `fitted.toml`, or a file per experiment, named after its first test.
fn name_fitted(experiments: &mut [Experiment], mut tests: Vec<Test>) -> Vec<Test> {
    let one = experiments.len() == 1;
    for (e, experiment) in experiments.iter_mut().enumerate() {
        let first = tests.iter().find(|t| t.experiment == e);
        let name = first.map_or(e.to_string(), |t| file_stem(&t.name));
        experiment.fitted = if one { "fitted.toml".to_owned() } else { format!("fitted/{name}.toml") };
    }
    for test in &mut tests {
        test.fitted.clone_from(&experiments[test.experiment].fitted);
    }
    tests
}

/// Manifest of the fit's folder for this many samples, and the bytes of its texts.
fn manifest(
    text: &StudyText,
    texts: &Texts,
    given: &Given<'_>,
    samples: u64,
    program: String,
) -> (Manifest, Vec<Vec<u8>>) {
    let title = text.section.title.clone().unwrap_or_default();
    let words = given.overrides.iter().cloned();
    let words = words.chain(given.maps.iter().map(|m| format!("--map {m}")));
    let mut manifest = Manifest::new(program, title, samples, words.collect());
    let (texts, bytes) = texts.all();
    // where a test lies is no part of the fit
    let named = |text: Text| match text.by {
        NamedBy::CommandLineTest => Text { name: file_name(Path::new(&text.name)), ..text },
        _ => text,
    };
    manifest.texts = texts.into_iter().map(named).collect();
    (manifest, bytes)
}

/// All problems as the failure of the command, each once.
fn ended(problems: &[String], study: &str) -> String {
    let mut blocks: Vec<&str> = Vec::new();
    for block in problems.iter().flat_map(|p| p.split("\n\n")) {
        if !blocks.contains(&block) {
            blocks.push(block);
        }
    }
    let errors = blocks.iter().filter(|b| b.starts_with("error")).count();
    nothing_was_run(&blocks.join("\n\n"), study, errors)
}
