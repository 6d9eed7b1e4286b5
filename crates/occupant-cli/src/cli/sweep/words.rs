//! What a sweep says: what it came to, and what went wrong.

use std::path::PathBuf;

use crate::cli::exit::{Done, Failure};
use crate::cli::speak;
use crate::cli::table::facts;
use crate::ensemble::of_table::{self, Ensembles};
use crate::ensemble::text::of_study;
use crate::sweep::census::Census;
use crate::sweep::folder::Folder;
use crate::sweep::journal::Journal;
use crate::sweep::manifest::Manifest;
use crate::sweep::plan::NoPlan;
use crate::sweep::problem::Problem;

/// Reads through the journals.
pub fn read_journal(folders: &[Folder], sha256: &str, manifest: &Manifest) -> Result<Journal, Failure> {
    Journal::read(folders, sha256, manifest.samples).map_err(told)
}

/// What names a manifest.
pub fn sha256_of(manifest: &Manifest) -> Result<String, Failure> {
    let sha256 = manifest.sha256();
    sha256.map_err(|error| Failure::plain(format!("the manifest cannot be written: {error}")))
}

/// What is stable, where the study has ensembles: read from the finished table and written beside it.
pub fn ensembles(folder: &Folder, manifest: &Manifest, csv: bool) -> Result<Option<Ensembles>, Failure> {
    if !of_table::has_ensembles(manifest) {
        return Ok(None);
    }
    let found = of_table::write(&folder.parquet(), manifest, csv);
    found.map(Some).map_err(|reason| Failure::BrokeOff(format!("error: {reason}")))
}

/// What it came to.
pub fn tell(
    census: &Census,
    files: &[PathBuf],
    work: Option<String>,
    ensembles: Option<&Ensembles>,
) -> Result<Done, Failure> {
    let mut ended = vec![format!("{} completed", census.completed)];
    for (count, word) in
        [(census.failed, "failed"), (census.refused, "refused"), (census.broken, "on which the program broke off")]
    {
        if count > 0 {
            ended.push(format!("{count} {word}"));
        }
    }
    let mut lines = vec![("samples", ended.join(", "))];
    for (index, reason) in &census.reasons {
        lines.push(("", format!("{index}: {reason}")));
    }
    if census.unbalanced > 0 {
        let found = "samples whose energy balance is off by more than 10 %: their figures mean nothing";
        lines.push(("doubtful", format!("{} {found}", census.unbalanced)));
    }
    lines.extend(work.map(|work| ("computed", work)));
    let files = files.iter().chain(ensembles.iter().flat_map(|e| &e.files));
    let names: Vec<String> = files.map(|f| f.display().to_string()).collect();
    lines.push(("written", names.join(", ")));
    let stable = ensembles.map(|e| format!("\n{}", of_study(e)));
    speak::print(&(facts(&lines) + &stable.unwrap_or_default()))?;
    Ok(Done::Well)
}

/// A study that cannot be run.
pub fn no_plan(reason: NoPlan) -> Failure {
    match reason.0.starts_with("error") {
        true => Failure::CouldNotRun(reason.0),
        false => Failure::plain(reason.0),
    }
}

/// A problem of the folder, in words.
pub fn told(problem: Problem) -> Failure {
    let help = problem.help();
    let broke_off =
        matches!(problem, Problem::Io { doing: "write", .. } | Problem::Table { .. } | Problem::Incomplete { .. });
    let help = help.map(|h| format!("\n = help: {h}")).unwrap_or_default();
    let message = format!("error: {problem}{help}");
    match broke_off {
        true => Failure::BrokeOff(message),
        false => Failure::CouldNotRun(message),
    }
}
