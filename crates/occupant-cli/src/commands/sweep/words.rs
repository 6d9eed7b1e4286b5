//! What a sweep says it came to.

use std::path::PathBuf;

use crate::base::failure::{Done, Failure};
use crate::base::talk;
use crate::base::text_table::facts;
use crate::files::study_folder::folder::Folder;
use crate::files::study_folder::manifest::Manifest;
use crate::jobs::ensemble::of_table::{self, Ensembles};
use crate::jobs::ensemble::text::of_study;
use crate::jobs::sweep::census::Census;

/// What is stable, where the study has ensembles: read from the finished table and written beside it.
pub(crate) fn ensembles(folder: &Folder, manifest: &Manifest, csv: bool) -> Result<Option<Ensembles>, Failure> {
    if !of_table::has_ensembles(manifest) {
        return Ok(None);
    }
    of_table::write(&folder.parquet(), manifest, csv).map(Some)
}

/// What it came to.
pub(crate) fn tell(
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
    talk::print(&(facts(&lines) + &stable.unwrap_or_default()))?;
    Ok(Done::Well)
}
