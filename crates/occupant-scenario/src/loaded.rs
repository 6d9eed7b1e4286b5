//! A scenario that has passed the check, with the tables beside it, ready to be built.

use super::draft::Draft;
use super::expand::expand;
use super::sections::{Scenario, setup, together};
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use placed_text::{Diagnostics, Document, Format, Problem, Problems, SourceId, text_of};

/// Gives the bytes of a file named in a scenario, or says why not. The core reads no files itself.
pub type Resolver<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// A scenario that has passed the check.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scenario as it was written, overrides included.
    pub scenario: Scenario,
    explicit: Scenario,
    /// The tree of the explicit scenario.
    document: Document,
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
        // by way of a tree, so that the sections are written by one serializer and not by two
        toml::to_string(&toml::Table::try_from(self)?)
    }
}

impl Loaded {
    pub(super) fn from_draft(mut draft: Draft, resolver: Resolver) -> Result<Loaded, Diagnostics> {
        let problems = draft.check_words();
        if problems.has_errors() {
            return Err(problems);
        }
        let mut document = draft.document;
        let scenario: Scenario = document.sections("scenario")?;
        document.root = expand(&mut document.sources, &document.root);
        let mut explicit: Scenario = document.sections("scenario")?;
        // result files hold the explicit form, and what it leaves out was false in version 0.1.0
        let others = explicit.occupants.values_mut().filter_map(|occupant| occupant.posture.as_mut());
        for posture in explicit.posture.iter_mut().chain(others) {
            posture.settle.get_or_insert(true);
        }
        let path_table = read_path_table(&mut document, &scenario, resolver)?;
        Ok(Loaded { scenario, explicit, document, path_table })
    }

    /// The plain data of the scenario, with warnings.
    ///
    /// # Errors
    /// Everything that does not fit together: names that lead nowhere, keys that are missing or have no meaning here.
    pub fn build(&self) -> Result<(Setup, Diagnostics), Diagnostics> {
        let build = if self.explicit.has_several() { together } else { setup };
        build(&self.scenario, &self.explicit, &self.document, self.path_table)
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
            placed.add(problem.clone(), |problem| self.document.place(problem));
        }
        placed
    }

    /// The scenario with presets, pairs, `all` and joint sets written out.
    pub fn explicit(&self) -> &Scenario {
        &self.explicit
    }

    /// Name and text of the table the scenario names, if it names one.
    pub fn table(&self) -> Option<(&str, &str)> {
        let id = self.path_table?;
        Some((self.document.sources.name(id), self.document.sources.text(id)))
    }
}

/// Reads the CSV file that the vehicle path names.
fn read_path_table(
    document: &mut Document,
    scenario: &Scenario,
    resolver: Resolver,
) -> Result<Option<SourceId>, Diagnostics> {
    let Some(file) = scenario.path.as_ref().and_then(|path| path.file()) else { return Ok(None) };
    let bytes = resolver(file).map_err(|reason| {
        let found = format!("`{file}` cannot be read: {reason}");
        document.place(Problem::error("path.file", found, "a CSV file, its name relative to the scenario"))
    })?;
    let text = text_of(&bytes, file)?;
    Ok(Some(document.sources.add_named(file, text)))
}
