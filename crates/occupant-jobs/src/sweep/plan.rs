//! From the name of a study to samples that can be run.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use occupant_core::model::Model;
use occupant_core::results::channel::star;
use occupant_core::results::summary::{Figure, Summarizer};
use occupant_core::run::simulate::attempt;
use occupant_scenario::{Diagnostics, Draft, Loaded, names_file};
use occupant_study::{Design, Law, Parameter, Setting, Study, StudyText, Value};
use placed_text::Value as Written;

use super::identity::{digest, fixed};
use super::rating::Rates;
use crate::base::{Failure, file_name};
use crate::files::scenario::{Opened, ScenarioArgs, Tables, format_of, refused, retitle};
use crate::files::study_folder::{Column, Manifest, NamedBy, Role, Texts};
use crate::risk::columns as vehicle_columns;
use crate::run::FirstOutput;
use occupant_files::table::Cell;

/// Number of samples, spread over a study, checked before it is run if the first are refused.
const LOOKED_AT: u64 = 32;

/// Number of samples tried to find the columns if the base scenario itself cannot be run.
const TRIED: u64 = 16;

/// A study and everything it needs. Shared by all threads.
pub struct Plan {
    /// The study.
    pub study: Study,
    /// Path of the base scenario, for messages and results.
    scenario: PathBuf,
    bytes: Vec<u8>,
    /// Changes common to all samples, by the study and the command line.
    changes: Vec<String>,
    /// Files referred to by the scenarios of the samples.
    pub tables: Tables,
    /// What rates the bodies of its runs.
    pub rating: Option<Rates>,
    /// Manifest of the sweep's folder.
    pub manifest: Manifest,
    /// Bytes of the manifest's texts.
    pub texts: Vec<Vec<u8>>,
    /// Warnings about study and scenario.
    pub warnings: Diagnostics,
}

impl Plan {
    /// Reads a study and all its files; `name` is its name in messages.
    ///
    /// # Errors
    /// All problems of it, as text.
    pub fn open(name: &Path, overrides: &[String], texts: &Texts, program: String) -> Result<Plan, Failure> {
        Plan::on(&[], name, overrides, texts, program)
    }

    /// The same on a scenario with changes, which the study may change again.
    ///
    /// # Errors
    /// As [`Plan::open`].
    pub fn on(
        before: &[String],
        name: &Path,
        overrides: &[String],
        texts: &Texts,
        program: String,
    ) -> Result<Plan, Failure> {
        let text = study_text(name, texts)?;
        let shown = name.display().to_string();
        let scenario = name.parent().unwrap_or(Path::new("")).join(text.base());
        let bytes = texts.get(NamedBy::StudyAsBase, text.base());
        let bytes = bytes.map_err(|e| {
            refused(&shown, &unread(&text, "base", &format!("the scenario {}", scenario.display()), &e))
        })?;
        let scenario_name = scenario.display().to_string();
        let draft = Draft::read_bytes(&bytes, format_of(&scenario), &scenario_name).and_then(|mut draft| {
            before.iter().try_for_each(|change| draft.set(change))?;
            Ok(draft)
        });
        let draft = draft.map_err(|problems| refused(&scenario_name, &problems))?;
        let beside = |file: &str| texts.get(NamedBy::Study, file);
        let study = text.bind(draft, overrides, &beside).map_err(|problems| refused(&shown, &problems))?;
        let changes = [before, &changes_of(&text), overrides].concat();
        let title = text.section.title.clone().unwrap_or_default();
        let manifest = Manifest::new(program, title, study.len(), [before, overrides].concat());
        let mut plan = Plan {
            warnings: study.warnings.clone(),
            study,
            scenario,
            bytes,
            changes,
            tables: Tables::default(),
            rating: None,
            manifest,
            texts: Vec::new(),
        };
        plan.take_tables(texts);
        plan.manifest.columns = plan.columns()?;
        let model = text.section.rating.as_ref().and_then(|_| plan.base_model());
        plan.rating = Rates::of(&text, texts, name, (model, plan.study.len()))?;
        plan.manifest.rating = plan.rating.as_ref().map_or(String::new(), |rates| rates.digest.clone());
        (plan.manifest.texts, plan.texts) = texts.all();
        let texts: Vec<_> = plan.manifest.texts.iter().zip(plan.texts.iter().map(Vec::as_slice)).collect();
        plan.manifest.study = digest(&plan.study, &texts);
        plan.manifest.fixed = fixed(&plan.study.design);
        Ok(plan)
    }

    /// Values of a sample, by input column.
    pub fn inputs(&self, index: u64) -> Vec<Cell> {
        let columns = &self.manifest.columns;
        let cell = |(at, setting): (usize, &Setting)| {
            let is_text = columns.get(at).is_some_and(|c| c.role == Role::InputText);
            match &setting.value {
                Value::Number(x) if is_text => Cell::Text(x.to_string().into()),
                Value::Number(x) => Cell::Number(*x),
                Value::Text(text) => Cell::Text(text.as_str().into()),
                Value::Truth(b) => Cell::Text(b.to_string().into()),
                Value::Base => Cell::Absent,
            }
        };
        let settings = self.study.sample(index);
        let mut cells: Vec<Cell> = settings.iter().enumerate().map(cell).collect();
        if self.study.members() > 1 {
            let (sample, member) = self.study.sample_and_member(index);
            cells.extend([sample, member].map(|n| Cell::Number(n as f64)));
        }
        cells
    }

    /// The model of a sample.
    ///
    /// # Errors
    /// Problems of its scenario.
    pub fn open_sample(&self, index: u64) -> Result<Opened, Diagnostics> {
        let (loaded, model, warnings) = self.model(Some(index))?;
        // only a run that is kept needs the bytes
        Ok(Opened { bytes: Vec::new(), loaded, model, warnings, deck: None })
    }

    /// The model of the base scenario, or of the first sample if that is invalid.
    pub fn base_model(&self) -> Option<Model> {
        self.model(None).or_else(|_| self.model(Some(0))).ok().map(|(_, model, _)| model)
    }

    /// Refuses a study if every sample checked is refused, as with an unknown key in its scenario.
    ///
    /// # Errors
    /// Problems of the first of them.
    pub fn refuse_hopeless(&self) -> Result<(), Failure> {
        let samples = self.study.len();
        let spread = (0..LOOKED_AT).map(|i| i * samples / LOOKED_AT).chain([samples.saturating_sub(1)]);
        let mut first = None;
        for index in spread.filter(|index| *index < samples && self.study.excluded(*index).is_none()) {
            if self.study.assignments(index).is_empty() {
                continue;
            }
            match self.open_sample(index) {
                Ok(_) => return Ok(()),
                Err(problems) => first = first.or(Some((index, problems))),
            }
        }
        first.map_or(Ok(()), |(index, problems)| {
            let found = format!("every sample tried is invalid; sample {index}:\n{problems}");
            Err(Failure::with_help(found, "nothing was run; vary keys that the base scenario uses"))
        })
    }

    /// The model of a sample whose run is kept: its title lists the changes.
    ///
    /// # Errors
    /// Problems of its scenario.
    pub fn open_kept(&self, index: u64) -> Result<(Opened, ScenarioArgs), Diagnostics> {
        let (args, bytes) = self.command(index);
        let mut draft = self.study.base.clone();
        self.study.apply(index, &mut draft)?;
        retitle(&mut draft, &args.overrides);
        let (loaded, model, warnings) = self.tables.open(draft)?;
        Ok((Opened { bytes, loaded, model, warnings, deck: None }, args))
    }

    /// Arguments with which `occupant run` repeats a sample, and the scenario's bytes.
    pub fn command(&self, index: u64) -> (ScenarioArgs, Vec<u8>) {
        let mut overrides = self.changes.clone();
        let assignments = self.study.assignments(index);
        overrides.extend(assignments.iter().map(|a| format!("{}={}", a.path, a.text())));
        (ScenarioArgs { scenario: self.scenario.clone(), overrides }, self.bytes.clone())
    }

    /// The model of a sample, or of the base scenario.
    fn model(&self, index: Option<u64>) -> Result<(Loaded, Model, Diagnostics), Diagnostics> {
        let mut draft = self.study.base.clone();
        if let Some(index) = index {
            self.study.apply(index, &mut draft)?;
        }
        self.tables.open(draft)
    }

    /// Reads files referred to by the scenario, and by the samples if a study varies file names.
    fn take_tables(&mut self, texts: &Texts) {
        let mut names: Vec<String> = self.study.base.clone().files().into_iter().map(|(_, name)| name).collect();
        let varied = self.study.parameters.iter().any(|p| p.targets.iter().any(|t| names_file(&t.path)));
        for index in (0..self.study.len()).filter(|_| varied) {
            for assignment in &self.study.assignments(index) {
                if let (true, Value::Text(name)) = (names_file(&assignment.path), &assignment.value)
                    && !names.contains(name)
                {
                    names.push(name.clone());
                }
            }
        }
        for name in names {
            // one that cannot be read is a refusal of the samples that name it
            if let Ok(bytes) = texts.get(NamedBy::Scenario, &name) {
                self.tables.0.push((name, bytes));
            }
        }
    }

    /// Columns: inputs by the study, figures by the base scenario.
    fn columns(&self) -> Result<Vec<Column>, Failure> {
        let number = |name: &str, unit: &str| Column {
            name: format!("input.{name}"),
            unit: if unit.is_empty() { "1" } else { unit }.to_owned(),
            role: Role::Input,
        };
        let input = |(at, parameter): (usize, &Parameter)| {
            let column = number(&parameter.name, parameter.unit);
            if has_texts(&self.study, at) {
                return Column { unit: String::new(), role: Role::InputText, ..column };
            }
            column
        };
        let parameters = self.study.parameters.iter().enumerate();
        let mut columns: Vec<Column> = parameters.map(input).collect();
        if self.study.members() > 1 {
            columns.push(number("ensemble.sample", ""));
            columns.push(number("ensemble.member", ""));
        }
        let figure = |f: Figure| Column { name: f.name, unit: f.unit.to_owned(), role: Role::Figure };
        columns.extend(self.kept(self.figures()?)?.into_iter().map(figure));
        Ok(columns)
    }

    /// The figures that the study keeps.
    fn kept(&self, mut figures: Vec<Figure>) -> Result<Vec<Figure>, Failure> {
        let patterns = &self.study.measures;
        let is_of = |pattern: &String, figure: &Figure| star(pattern, &figure.name).is_some();
        if let Some(lost) = patterns.iter().find(|pattern| !figures.iter().any(|figure| is_of(pattern, figure))) {
            let names: Vec<&str> = figures.iter().map(|figure| figure.name.as_str()).collect();
            let help = format!("the measures are {}", names.join(", "));
            return Err(Failure::with_help(format!("output.measures: no measure is `{lost}`"), &help));
        }
        figures.retain(|figure| patterns.is_empty() || patterns.iter().any(|pattern| is_of(pattern, figure)));
        Ok(figures)
    }

    /// Figures of the first scenario that can be run.
    fn figures(&self) -> Result<Vec<Figure>, Failure> {
        let tried = std::iter::once(None).chain((0..self.study.len().min(TRIED)).map(Some));
        let mut first_refusal = None;
        for index in tried {
            match self.model(index) {
                Ok((_, model, _)) => {
                    let mut summarizer = Summarizer::new();
                    // one output is enough to know them
                    let stopped = attempt(&model, (&mut summarizer, FirstOutput));
                    if let (Ok(_), Some(summary)) = (stopped, summarizer.summary(None)) {
                        return Ok([summary.figures(&model), vehicle_columns(model.setup())].concat());
                    }
                }
                Err(problems) => {
                    first_refusal.get_or_insert(problems);
                }
            }
        }
        let scenario = self.scenario.display().to_string();
        Err(refused(&scenario, &first_refusal.unwrap_or_else(Diagnostics::new)))
    }
}

/// The text of a study; `name` is its name in messages.
///
/// # Errors
/// One that cannot be read; everything that is wrong with its words.
pub fn study_text(name: &Path, texts: &Texts) -> Result<StudyText, Failure> {
    let shown = name.display().to_string();
    let bytes = texts.get(NamedBy::CommandLine, &file_name(name));
    let bytes = bytes.map_err(|e| Failure::plain(format!("the study {shown} cannot be read: {e}")))?;
    StudyText::read_bytes(&bytes, format_of(name), &shown).map_err(|problems| {
        // a key of scenarios that no study has
        let draft = Draft::read_bytes(&bytes, format_of(name), &shown);
        if draft.is_ok_and(|mut draft| draft.get("time").is_ok() && draft.get("base").is_err()) {
            let help = format!("run it with `occupant run {shown}`, or name it as the `base` of a study");
            return Failure::with_help(format!("{shown} is a scenario, not a study"), &help);
        }
        refused(&shown, &problems)
    })
}

/// Problem of a study that refers, at this path, to an unreadable file.
pub fn unread(text: &StudyText, at: &str, file: &str, error: &dyn Display) -> Diagnostics {
    text.complaint(at, format!("{file} cannot be read: {error}"), "a file, with its path relative to the study", None)
}

/// Values that the study sets in all samples, as `--set` arguments.
fn changes_of(text: &StudyText) -> Vec<String> {
    let change = |(path, value): (&String, &Written)| match value {
        Written::Bool(b) => format!("{path}={b}"),
        Written::Integer(i) => format!("{path}={i}"),
        Written::Float(x) => format!("{path}={x:?}"),
        Written::String(text) => format!("{path}={}", serde_json::Value::from(text.as_str())),
        // the check has refused all others
        Written::Null | Written::Array(_) | Written::Table(_) => format!("{path}="),
    };
    text.section.set.iter().map(change).collect()
}

/// Whether a parameter has non-numeric values.
fn has_texts(study: &Study, at: usize) -> bool {
    let text = |value: &Value| matches!(value, Value::Text(_) | Value::Truth(_));
    match (study.parameters.get(at).map(|p| &p.law), &study.design) {
        (Some(Law::List(values)), _) => values.iter().any(text),
        (Some(Law::Table), Design::Table { rows, .. }) => rows.has_words(at),
        _ => false,
    }
}
