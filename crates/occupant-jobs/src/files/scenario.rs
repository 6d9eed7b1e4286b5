//! Scenarios opened by the library of files, and messages about them.

use occupant_scenario::{Drives, Loaded};
use placed_text::Diagnostics;

pub use occupant_files::scenario::*;

use crate::base::{Failure, say};

/// Reports the conversion of a deck, and warnings.
pub fn warn_of(opened: &Opened) {
    opened.deck.iter().for_each(|deck| say(&deck.words));
    warn(&opened.warnings);
}

/// Prints warnings followed by a blank line.
pub fn warn(warnings: &Diagnostics) {
    if !warnings.is_empty() {
        say(&format!("{warnings}\n"));
    }
}

/// Reads the scenario and simulates its drive, without occupants.
///
/// # Errors
/// As [`open`]; a scenario in which nothing drives.
pub fn drives(args: &ScenarioArgs) -> Result<(Loaded, Drives), Failure> {
    let name = args.scenario.display().to_string();
    let refuse = |problems: Diagnostics| refused(&name, &problems);
    let loaded = source(args)?.draft.load(&files_beside(&args.scenario)).map_err(refuse)?;
    let (drives, warnings) = loaded.drives().map_err(refuse)?;
    warn(&warnings);
    let drives = drives.ok_or_else(|| {
        let help = "add [drive] with a vehicle, or start from `occupant new NAME.toml --template drive`";
        Failure::with_help(format!("{name} has no vehicle that drives"), help)
    })?;
    Ok((loaded, drives))
}
