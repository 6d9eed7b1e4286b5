//! An optimisation before its search: a study, its scenario, its measures.

use std::collections::BTreeMap;
use std::path::Path;

use occupant_core::model::Model;
use occupant_core::results::summary::{Caveat, Figure, Summarizer};
use occupant_core::run::simulate::attempt;
use occupant_scenario::ending::Ending;
use occupant_scenario::{Diagnostics, Draft};
use occupant_study::engine::Ran;
use occupant_study::search::Trial;
use occupant_study::{Bounds, MOST_RUNS, Optimise, Parameter, StudyText, Within, is_allowed};

use super::Measures;
use super::searched::most_candidates;
use crate::base::{Failure, file_name};
use crate::ensemble::judge::is_result;
use crate::files::scenario::{Tables, format_of, refused};
use crate::files::study_folder::{Column, Manifest, NamedBy, Role, Texts};
use crate::fit::experiment::Experiment;
use crate::fit::scenario_text::numbers;
use crate::risk::columns;
use crate::search::{Objective, Record, within};
use crate::sweep::plan::{study_text, unread};

/// Name of the scenario that is written.
pub const BEST: &str = "best.toml";

/// A study with an `[optimise]`, and its scenario. Shared by all threads.
pub struct Optimising {
    /// The optimise section of the study.
    pub optimise: Optimise,
    /// The scenario with the parameters of the study.
    pub experiment: Experiment,
    /// The measures.
    pub measures: Measures,
    /// Bounds of the parameters.
    pub bounds: Vec<Bounds>,
    /// The points that keep the constraints of the study.
    pub within: Option<Within>,
    /// Changes from the command line.
    pub overrides: Vec<String>,
    /// Manifest of the folder; its first text is the study.
    pub manifest: Manifest,
    /// Bytes of the manifest's texts.
    pub texts: Vec<Vec<u8>>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

impl Optimising {
    /// Reads a study and its scenario, and runs the base scenario to know its measures; `name` is its name in messages.
    ///
    /// # Errors
    /// All problems, as text.
    pub fn open(name: &Path, overrides: &[String], program: String) -> Result<Optimising, Failure> {
        Optimising::of(name, overrides, &Texts::of_files(name), program)
    }

    /// The same from these texts.
    ///
    /// # Errors
    /// As [`Optimising::open`].
    pub fn of(name: &Path, overrides: &[String], texts: &Texts, program: String) -> Result<Optimising, Failure> {
        let shown = name.display().to_string();
        let text = study_text(name, texts)?;
        let refuse = |problems: Diagnostics| refused(&shown, &problems);
        let optimise = text.optimise().map_err(refuse)?;
        let (experiment, warnings) = scenario(name, &text, texts, overrides)?;
        let study = &experiment.study;
        let bounds: Option<Vec<Bounds>> = study.parameters.iter().map(|p| p.law.bounds()).collect();
        // bind_optimise has refused parameters without ends
        let bounds = bounds.ok_or_else(|| Failure::plain("a parameter without a range"))?;
        let within = within(&study.relations, &bounds)?;
        // what cannot be written is no use at the end of a search
        let lower: Vec<f64> = bounds.iter().map(|b| b.from).collect();
        numbers(&experiment, &lower).map_err(|found| refuse(text.complaint("parameters", found, "numbers", None)))?;
        let (figures, base) = figures_of(&experiment);
        let measures = Measures::find(&text, &optimise, study.members(), &figures, &base);
        let measures = measures.map_err(|problems| {
            let mut all = Diagnostics::new();
            problems.into_iter().for_each(|more| all.extend(more));
            refuse(all)
        })?;
        let title = text.section.title.clone().unwrap_or_default();
        let samples = study.members().saturating_mul(most_candidates(&optimise));
        if samples > MOST_RUNS {
            let found = format!("up to {samples} runs, with {} of each candidate", study.members());
            let problem = text.complaint("optimise.budget", found, format!("at most {MOST_RUNS} runs"), None);
            return Err(refuse(problem));
        }
        let mut manifest = Manifest::new(program, title, samples, overrides.to_vec());
        let (of, texts) = texts.all();
        manifest.texts = of;
        let overrides = overrides.to_vec();
        Ok(Optimising { optimise, experiment, measures, bounds, within, overrides, manifest, texts, warnings })
    }

    /// What a recorded candidate shows.
    pub fn trial(&self, record: &Record) -> Trial {
        self.measures.trial(&record.parts, !record.caveats.is_empty())
    }

    /// Caveats of a run that matter: those on the measures that the study does not allow.
    pub fn mattering(&self, caveats: Vec<Caveat>) -> Vec<Caveat> {
        let touches = |caveat: &Caveat| self.measures.all.iter().any(|(name, ..)| caveat.touches(name));
        let matters = |c: &Caveat| touches(c) && !is_allowed(&self.optimise.allow_caveats, &c.name);
        caveats.into_iter().filter(matters).collect()
    }

    /// The values that count of a run: those of all measures.
    ///
    /// # Errors
    /// A measure without a value.
    pub fn counted(&self, figures: &[Figure]) -> Result<Vec<f64>, String> {
        let value = |(name, _, at): &(String, &str, usize)| {
            let known = figures.get(*at).filter(|figure| figure.name == *name);
            let figure = known.or_else(|| figures.iter().find(|figure| figure.name == *name));
            let value = figure.and_then(|figure| figure.value).filter(|value| value.is_finite());
            value.ok_or_else(|| format!("it has no value of `{name}`"))
        };
        self.measures.all.iter().map(value).collect()
    }
}

impl Objective for Optimising {
    type Recorder = Summarizer;

    fn word(&self) -> &'static str {
        "optimisation"
    }

    fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    fn parameters(&self) -> &[Parameter] {
        &self.experiment.study.parameters
    }

    fn bounds(&self) -> &[Bounds] {
        &self.bounds
    }

    fn within(&self) -> Option<&Within> {
        self.within.as_ref()
    }

    fn runs(&self) -> u64 {
        self.experiment.study.members()
    }

    fn begin(&self, run: u64, values: Option<&[f64]>) -> Result<(Model, Summarizer), Diagnostics> {
        let (experiment, values) = (&self.experiment, values.unwrap_or_default());
        // as the scenario with these values would be written
        let written = (run == 0).then(|| numbers(experiment, values).ok()).flatten();
        let changes: Vec<(String, String)> = match written {
            Some(numbers) => numbers.into_iter().map(|n| (n.path, n.text)).collect(),
            None => {
                let all = experiment.study.assignments_of_member(values, run);
                all.into_iter().map(|a| (a.text(), a.path)).map(|(text, path)| (path, text)).collect()
            }
        };
        Ok((experiment.model_with(changes)?, Summarizer::new()))
    }

    fn end(&self, _run: u64, _values: Option<&[f64]>, ran: Ran<Summarizer>) -> Result<(Vec<f64>, Vec<Caveat>), String> {
        let summary = ran.recorder.summary(None).ok_or("it has no summary")?;
        let figures = [summary.figures(&ran.model), columns(ran.model.setup())].concat();
        Ok((self.counted(&figures)?, self.mattering(summary.caveats)))
    }

    fn score(&self, parts: &[f64], has_caveats: bool) -> f64 {
        Measures::score(&self.measures.trial(parts, has_caveats))
    }

    fn told(&self, score: f64) -> String {
        Measures::told(score)
    }

    fn columns(&self) -> Vec<Column> {
        let of = |value: usize| Column {
            name: self.measures.name(value),
            unit: self.measures.unit(value).to_owned(),
            role: Role::Figure,
        };
        (0..self.measures.uses.len()).map(of).collect()
    }

    fn row(&self, parts: &[f64]) -> Vec<f64> {
        self.measures.values(parts)
    }
}

/// The scenario of a study with its parameters, and warnings.
fn scenario(
    name: &Path,
    text: &StudyText,
    texts: &Texts,
    overrides: &[String],
) -> Result<(Experiment, Vec<String>), Failure> {
    let shown = name.display().to_string();
    let path = name.parent().unwrap_or(Path::new("")).join(text.base());
    let path_shown = path.display().to_string();
    let bytes = texts.get(NamedBy::StudyAsBase, text.base());
    let bytes = bytes.map_err(|e| refused(&shown, &unread(text, "base", &format!("the scenario {path_shown}"), &e)))?;
    let draft = Draft::read_bytes(&bytes, format_of(&path), &path_shown);
    let draft = draft.map_err(|problems| refused(&path_shown, &problems))?;
    let beside = |file: &str| texts.get(NamedBy::Study, file);
    let study = text.bind_optimise(draft, overrides, &beside).map_err(|problems| refused(&shown, &problems))?;
    let mut warnings: Vec<String> = Vec::new();
    if !study.warnings.is_empty() {
        warnings.push(study.warnings.to_string());
    }
    let names = study.base.clone().files().into_iter().map(|(_, name)| name);
    let tables = names.filter_map(|name| Some((texts.get(NamedBy::Scenario, &name).ok()?, name)));
    let tables = Tables(tables.map(|(bytes, name)| (name, bytes)).collect());
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let (mut experiment, more) =
        Experiment::new(path, text, study, tables).map_err(|problems| refused(&path_shown, &problems))?;
    if !more.is_empty() {
        warnings.push(more.to_string());
    }
    experiment.fitted = BEST.to_owned();
    Ok((experiment, warnings))
}

/// Figures of the base scenario, and their values if it completes.
fn figures_of(experiment: &Experiment) -> (Vec<Figure>, BTreeMap<String, f64>) {
    let mut summarizer = Summarizer::new();
    let outcome = attempt(&experiment.model, &mut summarizer);
    let is_whole = outcome.is_ok_and(|outcome| matches!(Ending::of(&outcome), Some(Ending::Completed)));
    let summary = summarizer.summary(None);
    let mut figures = summary.map_or_else(Vec::new, |summary| summary.figures(&experiment.model));
    figures.extend(columns(experiment.model.setup()));
    figures.retain(|figure| is_result(&figure.name));
    let known = figures.iter().filter(|_| is_whole);
    let base = known.filter_map(|figure| Some((figure.name.clone(), figure.value?))).collect();
    (figures, base)
}

/// Name of the base scenario's file.
pub fn base_name(of: &Optimising) -> String {
    file_name(&of.experiment.scenario)
}
