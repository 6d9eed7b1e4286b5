//! The worst and best runs as whole scenario files, which `occupant run` accepts and which give the same figures to the bit.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use occupant_scenario::{Draft, Format};

use super::Report;
use crate::base::{Existing, Failure, file_name, write_whole};
use crate::files::scenario::Tables;
use crate::files::study_folder::NamedBy;
use crate::sweep::Stored;

/// Folder of the scenarios of a page: `report.html` has `report-runs`.
pub fn beside(page: &Path) -> PathBuf {
    let stem = page.file_stem().unwrap_or_default().to_string_lossy();
    page.with_file_name(format!("{stem}-runs"))
}

/// Name of the scenario of a run.
pub fn name(run: u64) -> String {
    format!("run-{run:06}.toml")
}

/// Writes the scenarios of all worst and best runs, and the tables that they name. Notes on runs that cannot be written.
///
/// # Errors
/// A file that is there and may not be replaced; an error of the operating system.
pub fn write(report: &Report, folder: &Path, existing: Existing) -> Result<Vec<String>, Failure> {
    let mut runs: BTreeMap<u64, Vec<String>> = BTreeMap::new();
    for finding in report.findings() {
        for number in finding.numbers {
            let Some(run) = &number.run else { continue };
            let value = crate::base::shown::with_unit(number.estimate.value, &finding.response.unit);
            let why = format!(
                "number {} of the {} runs for {}: {value}",
                run.place + 1,
                number.quantity,
                finding.response.name
            );
            runs.entry(run.number).or_default().push(why);
        }
    }
    let mut notes = Vec::new();
    let mut tables: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    if !runs.is_empty() {
        let unmade = |e| Failure::broke_off(format!("{} cannot be made: {e}", folder.display()));
        std::fs::create_dir_all(folder).map_err(unmade)?;
    }
    for (run, why) in runs {
        match scenario(&report.opened, run) {
            Ok((text, named)) => {
                let head = head(&report.opened, run, &why);
                write_whole(&folder.join(name(run)), existing, format!("{head}{text}").as_bytes())
                    .map_err(Failure::broke_off)?;
                tables.extend(named.0);
            }
            Err(why) => notes.push(format!("run {run} has no scenario file: {why}")),
        }
    }
    for (name, bytes) in tables {
        write_whole(&folder.join(name), existing, &bytes).map_err(Failure::broke_off)?;
    }
    Ok(notes)
}

/// Comment lines on the origin of a scenario.
fn head(opened: &Stored, run: u64, why: &[String]) -> String {
    let title = placed_text::shown(&opened.manifest.title);
    let mut lines = vec![format!("# Run {run} of the study \"{title}\", {}", opened.manifest.program)];
    lines.extend(why.iter().map(|why| format!("# {why}")));
    lines.push(format!("# sweep.json, SHA-256 {}", opened.manifest_sha256));
    lines.join("\n") + "\n\n"
}

/// The scenario of a run as TOML, and the tables that it names, under plain names.
///
/// # Errors
/// Why it cannot be written.
fn scenario(opened: &Stored, run: u64) -> Result<(String, Tables), String> {
    let plan = &opened.plan;
    let mut draft = plan.study.draft(run).map_err(|e| e.to_string())?;
    let mut tables = Vec::new();
    for (path, named) in draft.files() {
        let of = |text: &&crate::files::study_folder::Text| text.by == NamedBy::Scenario && text.name == named;
        let Some(text) = opened.manifest.texts.iter().find(of) else { continue };
        let copy = file_name(Path::new(&text.copy));
        draft.set_value(&path, &serde_json::Value::from(copy.as_str()).to_string()).map_err(|e| e.to_string())?;
        tables.push((copy, plan.tables.get(&named)?));
    }
    // files that no rule renames stay under their names, if these are plain
    let plain = |name: &str| file_name(Path::new(name)) == name;
    let others = plan.tables.0.iter().filter(|(name, _)| plain(name) && tables.iter().all(|(known, _)| known != name));
    let mut all = tables.clone();
    all.extend(others.cloned());
    let tables_of_run = Tables(all);
    let (loaded, ..) = tables_of_run.open(draft).map_err(|e| e.to_string())?;
    let text = loaded.scenario.to_toml().map_err(|e| e.to_string())?;
    let again = Draft::read(&text, Format::Toml, "run").and_then(|draft| tables_of_run.open(draft));
    match again {
        Ok((again, ..)) if again.scenario == loaded.scenario => Ok((text, tables_of_run)),
        _ => Err("its text does not read back as the same scenario".to_owned()),
    }
}
