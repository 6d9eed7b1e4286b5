//! A scenario that has passed the check, with the tables beside it, ready to be built.

use serde::Deserialize;

use super::build::build;
use super::check::check;
use super::diagnostic::{Diagnostic, Diagnostics};
use super::document::{Format, Node};
use super::draft::{Draft, refuse, text_of};
use super::expand::expand;
use super::model::{PathSection, Scenario};
use super::path_text::locate;
use super::source::{SourceId, Sources};
use crate::model::Model;
use crate::model::setup::Setup;
use crate::problem::{Problem, Problems};

/// Gives the bytes of a file named in a scenario, or says why not. The core reads no files itself.
pub type Resolver<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// A scenario that has passed the check.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scenario as it was written, overrides included.
    pub scenario: Scenario,
    sources: Sources,
    main: SourceId,
    explicit: Node,
    explicit_scenario: Scenario,
    path_table: Option<SourceId>,
}

impl Scenario {
    /// Reads and checks a scenario text. `name` is what messages call it; `resolver` gives the files it names.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn from_text(text: &str, format: Format, name: &str, resolver: Resolver) -> Result<Loaded, Diagnostics> {
        Draft::read(text, format, name)?.load(resolver)
    }

    /// The scenario as TOML.
    ///
    /// # Errors
    /// A name or text that TOML cannot hold.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(self)
    }

    /// The scenario as JSON.
    ///
    /// # Errors
    /// None for a scenario that was read from a text.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        serde_json::to_string_pretty(self)
    }
}

impl Loaded {
    pub(super) fn from_draft(draft: Draft, resolver: Resolver) -> Result<Loaded, Diagnostics> {
        let Draft { mut sources, main, root } = draft;
        let problems = check(&sources, &root);
        if problems.has_errors() {
            return Err(problems);
        }
        let explicit = expand(&mut sources, &root);
        let scenario = model_of(&sources, main, &root)?;
        let explicit_scenario = model_of(&sources, main, &explicit)?;
        let path_table = read_path_table(&mut sources, &explicit, &scenario, resolver)?;
        Ok(Loaded { scenario, sources, main, explicit, explicit_scenario, path_table })
    }

    /// The plain data of the scenario, with warnings.
    ///
    /// # Errors
    /// Everything that does not fit together: names that lead nowhere, keys that are missing or have no meaning here.
    pub fn build(&self) -> Result<(Setup, Diagnostics), Diagnostics> {
        build(&self.scenario, &self.explicit_scenario, &self.explicit, &self.sources, self.path_table)
    }

    /// The model of the scenario, ready to be run, with warnings.
    ///
    /// # Errors
    /// As [`Loaded::build`], and everything the model refuses; warnings are among them.
    pub fn model(&self) -> Result<(Model, Diagnostics), Diagnostics> {
        let (setup, mut diagnostics) = self.build()?;
        match Model::new(setup) {
            Ok(model) => {
                diagnostics.extend(self.diagnose(model.warnings()));
                Ok((model, diagnostics))
            }
            Err(problems) => {
                diagnostics.extend(self.diagnose(&problems));
                Err(diagnostics)
            }
        }
    }

    /// Places in the text for problems found later, when the model is built or run.
    pub fn diagnose(&self, problems: &Problems) -> Diagnostics {
        let mut placed = Diagnostics::new();
        for problem in problems.iter() {
            placed.push(place(&self.sources, self.main, &self.explicit, problem.clone()));
        }
        placed
    }

    /// The scenario with presets, pairs, `all` and joint sets written out.
    pub fn explicit(&self) -> &Scenario {
        &self.explicit_scenario
    }

    /// Name and text of the table the scenario names, if it names one.
    pub fn table(&self) -> Option<(&str, &str)> {
        let id = self.path_table?;
        Some((self.sources.name(id), self.sources.text(id)))
    }

    /// The text the scenario was read from.
    pub fn text(&self) -> &str {
        self.sources.text(self.main)
    }
}

/// Finds the words that a problem's path points at.
pub fn place(sources: &Sources, main: SourceId, root: &Node, problem: Problem) -> Diagnostic {
    match locate(root, &problem.path) {
        Some(span) => Diagnostic::at(sources, span, problem),
        None => Diagnostic::of(sources.name(main), problem),
    }
}

/// The serde model of a checked tree. A difference between checker and model is reported, not a panic.
fn model_of(sources: &Sources, main: SourceId, root: &Node) -> Result<Scenario, Diagnostics> {
    Scenario::deserialize(root.to_json())
        .map_err(|error| refuse(sources.name(main), format!("the scenario cannot be read: {error}"), "a scenario"))
}

/// Reads the CSV file that the vehicle path names.
fn read_path_table(
    sources: &mut Sources,
    explicit: &Node,
    scenario: &Scenario,
    resolver: Resolver,
) -> Result<Option<SourceId>, Diagnostics> {
    let file = match &scenario.path {
        PathSection::Table(table) => table.file.as_ref(),
        PathSection::Pulse(pulse) => pulse.file.as_ref(),
        PathSection::Sensors(sensors) => sensors.file.as_ref(),
        PathSection::Fixed(_) => None,
    };
    let Some(file) = file else {
        return Ok(None);
    };
    let bytes = resolver(file).map_err(|reason| {
        let mut problems = Problems::new();
        problems.error(
            "path.file",
            format!("`{file}` cannot be read: {reason}"),
            "a CSV file, its name relative to the scenario",
        );
        let mut placed = Diagnostics::new();
        for problem in problems.iter() {
            placed.push(place(sources, explicit.span.source, explicit, problem.clone()));
        }
        placed
    })?;
    let text = text_of(&bytes, file)?;
    Ok(Some(sources.add(file, text)))
}
