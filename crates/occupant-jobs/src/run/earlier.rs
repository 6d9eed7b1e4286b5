//! Results that a run may replace unasked: complete ones of the same scenario, changed or not, from its own folder.

use std::fs;
use std::path::Path;

use occupant_core::results::summary::RunStatus;

use crate::base::{file_name, input_file, partial_path};
use crate::files::scenario::{Opened, ScenarioArgs};
use occupant_files::mcap::StoredRun;

/// Whether `target` holds a whole run of the scenario file of `args` with the same `--set`, and stands beside it. The title
/// must be the same: another scenario that took the file's name has another one. A file that may not be written stays. What a run that broke off has left, from
/// which one can go on, is no such thing.
pub fn is_earlier(target: &Path, args: &ScenarioArgs, opened: &Opened) -> bool {
    let folder = |path: &Path| match path.parent() {
        Some(folder) if folder != Path::new("") => fs::canonicalize(folder).ok(),
        _ => fs::canonicalize(".").ok(),
    };
    let is_file = fs::symlink_metadata(target).is_ok_and(|found| found.is_file() && !found.permissions().readonly());
    if !is_file || partial_path(target).exists() || folder(target) != folder(&args.scenario) {
        return false;
    }
    let Ok(stored) = input_file::bytes(target).map_err(|e| e.to_string()).and_then(|b| StoredRun::read(&b)) else {
        return false;
    };
    let says = |key: &str, text: &str| stored.run.get(key).map_or("", String::as_str) == text;
    stored.ending().0 == RunStatus::Completed
        && stored.flaw().is_none()
        && says("resumed_from", "")
        && says("scenario", &file_name(&args.scenario))
        && says("title", &opened.model.setup().title)
        && says("overrides", &args.overrides.join("\n"))
}
