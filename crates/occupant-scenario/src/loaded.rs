//! A scenario that has passed the check, with the tables beside it, ready to be built.

use super::car::{self, Dimension};
use super::draft::Draft;
use super::ready::Ready;
use super::sections::{Drives, People, Scenario, asks_for_people, caveats, setup, solve, together};
use super::surface_files;
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use placed_text::{Diagnostics, Document, Format, Node, Problem, Problems, table_text, with_key};

/// Returns the bytes of a file named in a scenario, or the reason of the failure. The core reads no files itself.
pub type Resolver<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// A scenario that has passed the check.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scenario as it was written, overrides included.
    pub scenario: Scenario,
    explicit: Scenario,
    /// The tree of the explicit scenario.
    document: Document,
    /// The tree of the scenario as it was written.
    root: Node,
}

impl Scenario {
    /// Reads and checks a scenario text. `name` is its name in messages; `resolver` returns its files.
    ///
    /// # Errors
    /// All problems of it.
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
    pub(super) fn from_draft(draft: Draft, resolver: Resolver) -> Result<Loaded, Diagnostics> {
        let ready = draft.into_ready()?;
        let mut document = ready.document();
        let Ready { scenario, mut explicit, root, .. } = ready;
        read_tables(&mut document, &scenario, resolver)?;
        surface_files::lay(&mut document, &mut explicit, resolver)?;
        Ok(Loaded { scenario, explicit, document, root })
    }

    /// The plain data of the scenario, with warnings.
    ///
    /// # Errors
    /// Contradictions: unknown names, and keys that are missing or have no meaning here.
    pub fn build(&self) -> Result<(Setup, Diagnostics), Diagnostics> {
        let (drives, mut problems) = self.drives()?;
        let (setup, found) = self.built(drives.as_ref())?;
        problems.extend(found);
        if let Some(drives) = &drives {
            problems.extend(self.explicit.check_crush(&self.document, drives));
        }
        if problems.has_errors() {
            return Err(problems);
        }
        Ok((setup, problems))
    }

    pub(super) fn built(&self, drives: Option<&Drives>) -> Result<(Setup, Diagnostics), Diagnostics> {
        if self.explicit.body.is_none() && self.explicit.occupants.is_empty() {
            let found = "the scenario has no occupant";
            let expected =
                "`body` with `joints`, or `occupants`; to drive vehicles without people, use `occupant drive`";
            return Err(Diagnostics::from(self.document.place(Problem::error("", found, expected))));
        }
        let build = if self.explicit.has_several() { together } else { setup };
        build(&self.scenario, &self.explicit, &self.document, drives)
    }

    /// Names of the triggers that need the path of the vehicle in advance. Motion given frame by frame cannot have
    /// them.
    pub fn triggers_of_path(&self) -> Vec<String> {
        let looks_ahead = self.explicit.triggers.iter().filter(|(_, trigger)| trigger.is_of_path());
        looks_ahead.map(|(name, _)| name.clone()).collect()
    }

    /// Names of the occupants that are dummies, empty for a single one: those with the chest, the sides or the joints of
    /// a dummy. All others are people, for whom limits of dummies are yardsticks.
    pub fn dummies(&self) -> Vec<String> {
        let Scenario { body, joints, occupants, .. } = &self.scenario;
        let single = body.iter().map(|body| ("", body, joints.as_ref()));
        let all = single.chain(occupants.iter().map(|(name, own)| (name.as_str(), &own.body, Some(&own.joints))));
        let of_dummies =
            all.filter(|(_, body, joints)| body.is_of_dummy() || joints.is_some_and(|own| own.is_of_dummy()));
        of_dummies.map(|(name, ..)| name.to_owned()).collect()
    }

    /// The vehicles of `drive`, simulated before the people, with warnings; none in a scenario without `drive`.
    ///
    /// # Errors
    /// Problems of vehicles, ground and drivers; with coupled passes also those of the people's runs.
    pub fn drives(&self) -> Result<(Option<Drives>, Diagnostics), Diagnostics> {
        let people = if asks_for_people(&self.explicit) { self.people()? } else { Vec::new() };
        let (drives, mut problems) = solve(&self.explicit, &self.document, &people)?;
        let Some(drives) = drives else { return Ok((None, problems)) };
        let drives = self.passed(drives, &mut problems)?;
        problems.extend(caveats(&self.explicit, &self.document, &drives));
        Ok((Some(drives), problems))
    }

    /// The tree of the explicit scenario.
    pub(super) fn document(&self) -> &Document {
        &self.document
    }

    /// The occupants that begin in each vehicle of `drive`, seated while it stands.
    fn people(&self) -> Result<Vec<Option<People>>, Diagnostics> {
        let (setup, _) = self.built(None)?;
        let model = Model::new(setup).map_err(|problems| self.diagnose(&problems))?;
        Ok(self.explicit.weighed(&model))
    }

    /// The model of the scenario, ready to be run, with warnings.
    ///
    /// # Errors
    /// As [`Loaded::build`], and all problems of the model, including warnings.
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

    /// Positions in the text for problems found later, when the model is built or run.
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

    /// The distances of its `[car]`s: those of class and years, and its own values.
    pub fn dimensions(&self) -> Vec<Dimension> {
        car::dimensions(&self.document.sources, &self.root)
    }

    /// Names and texts of the scenario's tables and surface files, each once.
    pub fn tables(&self) -> Vec<(&str, &str)> {
        let sources = &self.document.sources;
        let mut tables: Vec<(&str, &str)> = Vec::new();
        let surfaces = self.scenario.materials.values().filter_map(|material| material.file.as_deref());
        for file in self.scenario.table_files().into_iter().map(|(_, file)| file).chain(surfaces) {
            if let (Some(id), true) = (sources.named(file), tables.iter().all(|(name, _)| *name != file)) {
                tables.push((file, sources.text(id)));
            }
        }
        tables
    }
}

/// Reads the CSV files at these paths, each once.
fn read_tables(document: &mut Document, scenario: &Scenario, resolver: Resolver) -> Result<(), Diagnostics> {
    let mut problems = Diagnostics::new();
    for (at, file) in scenario.table_files() {
        if document.sources.named(file).is_some() {
            continue;
        }
        let read = resolver(file).map_err(|reason| {
            let found = format!("`{file}` cannot be read: {reason}");
            let expected = "a CSV file, its name relative to the scenario";
            Diagnostics::from(document.place(Problem::error(with_key(&at, "file"), found, expected)))
        });
        match read.and_then(|bytes| table_text(&bytes, file)) {
            Ok(text) => _ = document.sources.add_named(file, text),
            Err(found) => problems.extend(found),
        }
    }
    if problems.is_empty() { Ok(()) } else { Err(problems) }
}
