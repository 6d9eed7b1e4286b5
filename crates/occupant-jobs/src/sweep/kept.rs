//! Whole runs of chosen samples, written after the sweep: those of the worst, and those whose file is missing.

use std::collections::BTreeSet;
use std::fs;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use occupant_study::Keep;
use occupant_study::engine::Engine;

use super::{Plan, Simulation};
use crate::base::{Failure, partial_path};
use crate::files::study_folder::{Checksums, Folder, Journal, Problem, Role, Status};

/// Parses `none`, `all`, `3, 17` or `worst 5 by head.peak`.
pub fn parse(text: &str) -> Option<Keep> {
    Keep::from_words(text).or_else(|| {
        let numbers: Result<Vec<u64>, _> = text.split(',').map(|word| word.trim().parse()).collect();
        numbers.ok().map(Keep::of)
    })
}

/// Runs to keep, as given or else those of the study.
///
/// # Errors
/// Unknown words, samples and measures; not all runs if the study has a rating.
pub fn chosen(given: Option<&str>, plan: &Plan) -> Result<Keep, Failure> {
    let keep = match given {
        Some(text) => parse(text).ok_or_else(|| {
            Failure::with_help(
                format!("--keep {text}: unknown choice of runs"),
                "give all, none, numbers of samples such as '3, 17', or 'worst 5 by head.peak'",
            )
        })?,
        None => plan.study.keep.clone(),
    };
    let manifest = &plan.manifest;
    match &keep {
        Keep::Indices(numbers) => {
            if let Some(number) = numbers.iter().find(|n| **n >= manifest.samples) {
                return Err(Failure::plain(format!(
                    "keep: there is no sample {number}; the study has {}, counted from 0",
                    manifest.samples
                )));
            }
        }
        Keep::Worst { measure, .. } => {
            if manifest.figure(measure).is_none() {
                let figures = manifest.columns.iter().filter(|c| c.role == Role::Figure);
                let names: Vec<&str> = figures.map(|c| c.name.as_str()).collect();
                return Err(Failure::with_help(
                    format!("keep: there is no measure `{measure}`"),
                    &format!("the measures are {}", names.join(", ")),
                ));
            }
        }
        Keep::All | Keep::None => {}
    }
    plan.rating.iter().try_for_each(|rates| rates.refuse_unkept(&keep, given))?;
    Ok(keep)
}

/// Creates the folder of the kept runs, if any.
///
/// # Errors
/// An error of the operating system.
pub fn prepare(keep: &Keep, folder: &Folder) -> Result<(), Problem> {
    if *keep == Keep::None {
        return Ok(());
    }
    let runs = folder.runs();
    fs::create_dir_all(&runs).map_err(Problem::io("create", &runs))
}

/// Samples of a range whose result files are in a list.
pub fn among(files: &[PathBuf], folder: &Folder, samples: Range<u64>) -> Vec<u64> {
    let is_there = |i: &u64| files.contains(&folder.run(*i)) || files.contains(&partial_path(&folder.run(*i)));
    if files.is_empty() { Vec::new() } else { samples.filter(is_there).collect() }
}

/// Writes the result files of these finished samples where missing or damaged. A failed run has a partial file, a
/// refused sample none.
///
/// # Errors
/// A journal that cannot be read, a file that cannot be written.
pub fn write_missing(
    plan: &Plan,
    (folder, sums): (&Folder, &Checksums),
    journal: &Journal,
    samples: impl IntoIterator<Item = u64>,
    engine: &Engine,
    stop: &AtomicBool,
) -> Result<(), Failure> {
    let mut missing = Vec::new();
    // each once, however many want it
    for index in samples.into_iter().collect::<BTreeSet<u64>>() {
        let file = folder.run(index);
        if sums.holds(&file) {
            continue;
        }
        let row = journal.rows(index..index + 1)?.pop();
        let lacks = match row.map(|row| row.status) {
            Some(Status::Completed) => true,
            Some(Status::Failed) => !sums.holds(&partial_path(&file)),
            Some(Status::Refused | Status::Excluded | Status::Broken) | None => false,
        };
        if lacks {
            missing.push(index);
        }
    }
    let simulation = Simulation { plan, keep: &Keep::All, folder, sums };
    engine.run(&simulation, missing.into_iter(), stop, |_row| Ok(()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_of_a_command_line_are_read() {
        assert_eq!(parse("none"), Some(Keep::None));
        assert_eq!(parse(" all "), Some(Keep::All));
        assert_eq!(parse("7,3, 7"), Some(Keep::Indices(vec![3, 7])));
        let worst = Keep::Worst { count: 5, measure: "hic15".to_owned() };
        assert_eq!(parse("worst 5 by hic15"), Some(worst));
        for wrong in ["", "worst", "worst 0 by hic15", "worst five by hic15", "-1", "some"] {
            assert_eq!(parse(wrong), None, "{wrong}");
        }
    }
}
