//! A fit before its search: a study, its tests, and their scenarios.

use std::path::Path;

use occupant_study::{ApplyChoice, Bounds, Distribution, Fit, Law, Parameter, StudyText};
use serde::Serialize;

use super::opening::{Given, Opening};
use super::{Correction, Experiment, Target};
use crate::base::{Failure, file_name, file_stem};
use crate::files::scenario::{nothing_was_run, refused};
use crate::files::study_folder::{Manifest, NamedBy, Text, Texts};
use crate::sweep::plan::study_text;

/// So many evaluations may come on top of the budget.
const ON_TOP: u64 = 1 << 20;

/// A study, its tests, and the scenarios that stand for them. Shared by all threads.
pub struct Fitting {
    /// What the study says of the fit.
    pub fit: Fit,
    /// The experiments.
    pub experiments: Vec<Experiment>,
    /// The tests.
    pub tests: Vec<Test>,
    /// What is looked for: the parameters of the study, then offsets and gains of tests.
    pub parameters: Vec<Parameter>,
    /// Between which ends the parameters are looked for.
    pub bounds: Vec<Bounds>,
    /// Changes from the command line.
    pub overrides: Vec<String>,
    /// What the folder of the fit will hold; its first text is the study.
    pub manifest: Manifest,
    /// Bytes of the manifest's texts.
    pub texts: Vec<Vec<u8>>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// A test.
#[derive(Clone, Debug, Serialize)]
pub struct Test {
    /// Its name in results.
    pub name: String,
    /// Its file, as it was named.
    pub file: String,
    /// SHA-256 of the file.
    pub sha256: String,
    /// The scenario that stands for it.
    pub scenario: String,
    /// That scenario with the fitted numbers.
    pub fitted: String,
    /// Which experiment that scenario is.
    #[serde(skip)]
    pub experiment: usize,
    /// Between which ends its offset and its gain are looked for.
    #[serde(skip)]
    pub nuisances: [Option<[f64; 2]>; 2],
}

impl Fitting {
    /// Reads a study, the scenarios and the tests; `name` is its name in messages.
    ///
    /// # Errors
    /// All problems, as text.
    pub fn open(name: &Path, given: &Given<'_>, program: String) -> Result<Fitting, Failure> {
        let (shown, texts) = (name.display().to_string(), Texts::of_files(name));
        let text = study_text(name, &texts)?;
        let fit = text.fit().map_err(|problems| refused(&shown, &problems))?;
        let folder = name.parent().unwrap_or(Path::new(""));
        let mut opening = Opening::new(folder, &text, &texts, given);
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
        let tests = name_fitted(&mut experiments, tests);
        let samples = experiments.len() as u64 * fit.budget.saturating_add(ON_TOP);
        let (manifest, texts) = manifest(&text, &texts, given, samples, program);
        let overrides = given.overrides.to_vec();
        Ok(Fitting { fit, experiments, tests, parameters, bounds, overrides, manifest, texts, warnings })
    }

    /// What stands between each test and the truth with these values of all parameters, or without any.
    pub fn corrections(&self, values: Option<&[f64]>) -> Vec<Correction> {
        let own = self.experiments[0].study.parameters.len();
        let mut found = values.and_then(|values| values.get(own..)).unwrap_or_default().iter();
        let mut next = |ends: Option<[f64; 2]>, none: f64| ends.and_then(|_| found.next().copied()).unwrap_or(none);
        let of =
            |test: &Test| Correction { offset_s: next(test.nuisances[0], 0.0), gain: next(test.nuisances[1], 1.0) };
        self.tests.iter().map(of).collect()
    }

    /// Values of the parameters, SI, at a point of the unit cube.
    pub fn values(&self, at: &[f64]) -> Vec<f64> {
        self.bounds.iter().zip(at).map(|(b, u)| b.value(*u)).collect()
    }

    /// The score of all targets, experiment by experiment.
    pub fn score(&self, parts: &[f64]) -> f64 {
        let weights = self.targets().map(|(_, target)| target.weight);
        self.fit.misfit.combined(weights.zip(parts.iter().copied()))
    }

    /// All targets, experiment by experiment, and of which test each is.
    pub fn targets(&self) -> impl Iterator<Item = &(usize, Target)> {
        self.experiments.iter().flat_map(|e| &e.targets)
    }

    /// Where the search begins: at the base scenario's values where they lie between the bounds, else in the middle.
    pub fn start(&self) -> Vec<f64> {
        let start = |(parameter, bounds): (&Parameter, &Bounds)| match parameter.nominal() {
            occupant_study::Value::Number(x) => {
                let u = bounds.part(x);
                if (0.0..=1.0).contains(&u) { u } else { 0.5 }
            }
            _ => 0.5,
        };
        self.parameters.iter().zip(&self.bounds).map(start).collect()
    }
}

/// Offset and gain of a test, as far as they are looked for. They act nowhere in a scenario.
fn nuisances(test: &Test) -> impl Iterator<Item = Parameter> {
    let kinds = [("offset", "s", ApplyChoice::Offset), ("gain", "", ApplyChoice::Factor)];
    kinds.into_iter().zip(test.nuisances).filter_map(|((word, unit, apply), ends)| {
        let [from, to] = ends?;
        let name = format!("{}.{word}", test.name);
        let law = Law::Distribution(Distribution::Uniform { from, to });
        Some(Parameter { name, unit, apply, law, crossed: false, targets: Vec::new() })
    })
}

/// Names the fitted scenarios: `fitted.toml`, or a file for each experiment, after its first test.
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

/// What the folder of the fit of so many samples will hold, and the bytes of its texts.
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

/// All problems as the end of the command, each once.
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
