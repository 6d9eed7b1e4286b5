//! From a scenario's file name to a model.

use std::path::{Path, PathBuf};

use occupant_core::model::Model;
use occupant_scenario::{Diagnostics, Draft, Format, Loaded};
use placed_text::{Severity, Value};

use super::deck::{FromDeck, from_deck, is_deck};
use super::mcap::StoredRun;
use super::mcap::about::{BEYOND, RESOLVED};
use crate::base::{Failure, by_ending, ending, file_name, input_file, quoted};

/// A scenario and changes to it.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
pub struct ScenarioArgs {
    /// The scenario, TOML or JSON, or a card deck of 1970; `-` is standard input
    #[cfg_attr(feature = "clap", arg(value_name = "SCENARIO"))]
    pub scenario: PathBuf,

    /// Change a value, such as --set path.speed='30 mph' or --set joints.*.damping=2; =null removes it, such as --set
    /// belts.torso=null. May be repeated. The title of the run lists the changes
    #[cfg_attr(feature = "clap", arg(long = "set", value_name = "PATH.TO.KEY=VALUE"))]
    pub overrides: Vec<String>,
}

/// A scenario ready to run.
pub struct Opened {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// The scenario, overrides included.
    pub loaded: Loaded,
    /// Its model.
    pub model: Model,
    /// Warnings, with their places.
    pub warnings: Diagnostics,
    /// The deck that it was converted from.
    pub deck: Option<FromDeck>,
}

/// A scenario text with the changes applied.
pub struct Source {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// The text with the changes.
    pub draft: Draft,
    /// The deck that it was converted from.
    pub deck: Option<FromDeck>,
}

/// Reads the scenario, applies the changes and builds the model.
///
/// # Errors
/// A file that cannot be read; everything that is wrong with the scenario, at once.
pub fn open(args: &ScenarioArgs) -> Result<Opened, Failure> {
    open_source(args, source(args)?)
}

/// Reads the scenario's text, or converts the deck in its place, and applies the changes.
///
/// # Errors
/// A file that cannot be read; everything that is wrong with its words.
pub fn source(args: &ScenarioArgs) -> Result<Source, Failure> {
    let path = &args.scenario;
    let bytes = input_file::bytes(path).map_err(|error| unreadable(path, &error))?;
    let name = path.display().to_string();
    let refuse = |problems: Diagnostics| refused(&name, &problems);
    if ending(path) == "mcap" {
        let found = format!("{name} holds the results of a run, not a scenario");
        return Err(Failure::with_help(
            found,
            &format!("to look at it, use `occupant measures {0}` or `occupant report {0}`", quoted(&name)),
        ));
    }
    let deck = (format_of(path).is_none() && is_deck(&bytes)).then(|| from_deck(path, &bytes)).transpose()?;
    let mut draft = match &deck {
        Some(deck) => Draft::read(&deck.toml, Format::Toml, &name).map_err(refuse)?,
        None => {
            input_file::scenario_fits(&bytes).map_err(|error| unreadable(path, &error))?;
            Draft::read_bytes(&bytes, format_of(path), &name).map_err(refuse)?
        }
    };
    // a key of studies that no scenario has
    if draft.get("base").is_ok() {
        let help =
            format!("run it with `occupant sweep {}`; its `base` names the scenario that it varies", quoted(&name));
        return Err(Failure::with_help(format!("{name} is a study, not a scenario"), &help));
    }
    for assignment in &args.overrides {
        draft.set(assignment).map_err(refuse)?;
    }
    retitle(&mut draft, &args.overrides);
    Ok(Source { bytes, draft, deck })
}

/// Keys whose changes are not listed in the title.
const UNTOLD: [&str; 3] = ["title", "notes", "time.end"];
/// Largest number of changes listed in a title.
const MOST_TOLD: usize = 3;

/// Adds the changes to the title.
pub fn retitle(draft: &mut Draft, overrides: &[String]) {
    let changes = || overrides.iter().filter_map(|assignment| assignment.split_once('='));
    let told: Vec<String> = changes()
        .filter(|(path, _)| !UNTOLD.contains(&path.trim()))
        .map(|(path, value)| format!("{} = {}", path.trim(), value.trim()))
        .collect();
    if told.is_empty() || changes().any(|(path, _)| path.trim() == "title") {
        return;
    }
    let Some((_, Value::String(title))) = draft.get("title").ok().and_then(|mut found| found.pop()) else {
        return;
    };
    let more = told.len().saturating_sub(MOST_TOLD);
    let mut words = told[..told.len() - more].join(" and ");
    if more > 0 {
        words += &format!(" and {more} more");
    }
    // a text of JSON is one of TOML; a title that cannot be told so stays
    let _ = serde_json::to_string(&format!("{title}, with {words}")).map(|title| draft.set_value("title", &title));
}

/// Builds the model of a scenario.
///
/// # Errors
/// Everything that is wrong with the scenario, at once.
pub fn open_source(args: &ScenarioArgs, source: Source) -> Result<Opened, Failure> {
    let Source { bytes, draft, deck } = source;
    let name = args.scenario.display().to_string();
    let refuse = |problems: Diagnostics| refused(&name, &problems);
    let loaded = draft.load(&files_beside(&args.scenario)).map_err(refuse)?;
    let (model, warnings) = loaded.model().map_err(refuse)?;
    Ok(Opened { bytes, loaded, model, warnings, deck })
}

/// Reads files referred to by a scenario, from its folder.
pub fn files_beside(scenario: &Path) -> impl Fn(&str) -> Result<Vec<u8>, String> {
    // a file called `-` is not standard input
    let folder = Path::new(".").join(scenario.parent().unwrap_or(Path::new("")));
    move |file| input_file::bytes(&folder.join(file)).map_err(|error| error.to_string())
}

/// Inputs that outputs must not replace: the scenario or its results, and the tables it refers to.
pub fn inputs(of: &Path, loaded: &Loaded) -> Vec<PathBuf> {
    let folder = of.parent().unwrap_or(Path::new(""));
    let tables = loaded.tables();
    std::iter::once(of.to_owned()).chain(tables.iter().map(|(table, _)| folder.join(table))).collect()
}

/// Files that scenarios refer to, read once: names and bytes.
#[derive(Default)]
pub struct Tables(pub Vec<(String, Vec<u8>)>);

impl Tables {
    /// Bytes of a file, for resolvers of scenarios.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn get(&self, name: &str) -> Result<Vec<u8>, String> {
        let found = self.0.iter().find(|(table, _)| table == name);
        found.map(|(_, bytes)| bytes.clone()).ok_or_else(|| "it was not there when the run began".to_owned())
    }

    /// Scenario, model and warnings of a draft.
    ///
    /// # Errors
    /// Problems of it.
    pub fn open(&self, draft: Draft) -> Result<(Loaded, Model, Diagnostics), Diagnostics> {
        let loaded = draft.load(&|name| self.get(name))?;
        let (model, warnings) = loaded.model()?;
        Ok((loaded, model, warnings))
    }
}

/// The scenario stored in a result file, including all changes, with its model and warnings.
///
/// # Errors
/// A file without it, or with one that this program cannot read.
pub fn stored(file: &Path, run: &StoredRun) -> Result<(Loaded, Model, Diagnostics), Failure> {
    let name = file.display();
    let (is_resolved, format, bytes) = document(&name, run)?;
    let unreadable = |why: String| Failure::plain(format!("the scenario in {name} cannot be read:{why}"));
    input_file::scenario_fits(bytes).map_err(|error| unreadable(format!(" {error}")))?;
    let resolver = |table: &str| {
        let found = run.attachments.get(table).or_else(|| run.attachments.get(&file_name(Path::new(table))));
        found.cloned().ok_or_else(|| format!("{name} does not contain it"))
    };
    let loaded = Draft::read_bytes(bytes, format, RESOLVED)
        .and_then(|mut draft| {
            // what was resolved by version 0.1.0 does not say it, and then it was false
            if is_resolved && draft.get("posture.seat").is_ok() && draft.get("posture.settle").is_err() {
                draft.set_value("posture.settle", "false")?;
            }
            if is_resolved && draft.get("surfaces").is_ok() && draft.get("contact.edge_force").is_err() {
                draft.set_value("contact.edge_force", "contact_point")?;
            }
            draft.load(&resolver)
        })
        .map_err(|problems| unreadable(format!("\n{problems}")))?;
    let model = loaded.model();
    let (model, warnings) =
        model.map_err(|problems| Failure::plain(format!("the scenario in {name} is invalid:\n{problems}")))?;
    Ok((loaded, model, warnings))
}

/// The scenario of a run from the attachment of this name: whether it is resolved, its format, its text.
fn document<'r>(
    name: &impl std::fmt::Display,
    run: &'r StoredRun,
) -> Result<(bool, Option<Format>, &'r [u8]), Failure> {
    if let Some(beyond) = run.run.get(BEYOND) {
        let found = format!("{name} is from a run with parts that a scenario cannot describe: {beyond}");
        let help = "use the program that ran it; any MCAP reader can plot its messages";
        return Err(Failure::with_help(found, help));
    }
    if let Some(bytes) = run.attachments.get(RESOLVED) {
        return Ok((true, Some(Format::Toml), bytes));
    }
    let as_read = run.run.get("scenario").and_then(|own| Some((own, run.attachments.get(own)?)));
    let found = as_read.map(|(own, bytes)| (false, format_of(Path::new(own)), &bytes[..]));
    found.ok_or_else(|| Failure::plain(format!("{name} contains no scenario{}", run.because())))
}

/// The format for the file's extension, if any.
pub fn format_of(path: &Path) -> Option<Format> {
    by_ending(path, &[("toml", Format::Toml), ("json", Format::Json)])
}

fn unreadable(path: &Path, error: &std::io::Error) -> Failure {
    let found = format!("the scenario {} cannot be read: {error}", path.display());
    match error.kind() {
        std::io::ErrorKind::NotFound => {
            Failure::with_help(found, "check the path, or make a scenario with `occupant new NAME.toml`")
        }
        _ => Failure::plain(found),
    }
}

/// Failure of a command because of problems in a text.
pub fn refused(name: &str, problems: &Diagnostics) -> Failure {
    Failure::CouldNotRun(nothing_was_run(&problems.to_string(), name, problems.count(Severity::Error)))
}

/// Number of errors, as text.
pub fn counted(errors: usize) -> String {
    if errors == 1 { "1 error".to_owned() } else { format!("{errors} errors") }
}

/// Problems of a text, and the number of errors.
pub fn nothing_was_run(problems: &str, name: &str, errors: usize) -> String {
    format!("{problems}\n\n{name}: {}, nothing was run", counted(errors))
}
