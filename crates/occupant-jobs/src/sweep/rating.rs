//! The `[rating]` of a study: when all samples are finished, the bodies of their runs are rated.

use std::path::{Path, PathBuf};

use crash_measures::injury::Options;
use crash_measures::rating::Rating;
use occupant_core::model::Model;
use occupant_scenario::Diagnostics;
use occupant_study::engine::Engine;
use occupant_study::{Keep, RatingSection, StudyText};
use placed_text::{CELL, shortened};
use rayon::prelude::*;

use super::Plan;
use super::plan::unread;
use crate::base::{Existing, Failure, Units, file_name, json, sha256, write_whole};
use crate::files::scenario::refused;
use crate::files::study_folder::{Checksums, Folder, Journal, NamedBy, Row, Status, Texts, Waiting};
use crate::measures::Judged;
use crate::rated::bodies::{self, Item, One, answer, of_run, rate_all, tables};
use crate::rated::{Misplaced, Values, distinct, named, summary, unknown, write};
use occupant_files::results::Results;

/// What rates the bodies of a study's runs.
pub struct Rates {
    rating: &'static Rating,
    places: Vec<String>,
    values: Option<Values>,
    /// Names of the occupants of a run; empty for the only one.
    occupants: Vec<String>,
    /// What is said of a study that does not keep all runs.
    unkept: (String, Diagnostics),
    /// Digest of the rating and its values.
    pub digest: String,
}

/// Result of a rating.
#[derive(Default)]
pub struct Rated {
    /// The tables.
    pub text: String,
    /// Words on the bodies.
    pub notes: Vec<String>,
    /// Files that were written.
    pub files: Vec<PathBuf>,
}

impl Rates {
    /// The rating of a study of so many runs of a model, if it has one; `name` is its name in messages.
    ///
    /// # Errors
    /// Places that name no occupant, or not one for each body; values that cannot be read.
    pub fn of(
        text: &StudyText,
        texts: &Texts,
        name: &Path,
        (model, runs): (Option<Model>, u64),
    ) -> Result<Option<Rates>, Failure> {
        let shown = name.display().to_string();
        let section = text.section.rating.as_ref();
        // the check of words has refused all other names
        let Some((section, rating)) = section.and_then(|own| Some((own, Rating::named(&own.name)?))) else {
            return Ok(None);
        };
        let occupants = occupants(model.as_ref());
        check(rating, &section.places, (runs, occupants.len() as u64))
            .map_err(|(at, found, expected)| refused(&shown, &text.complaint(&at, found, expected, None)))?;
        let (values, sum) = values(section, rating, (text, texts), name)?;
        let (at, found) = match &text.section.keep {
            Some(_) => ("keep", "not all runs are kept"),
            None => ("rating", "no `keep`: no run is kept"),
        };
        let hint = Some("write keep = \"all\"".to_owned());
        let unkept = text.complaint(at, found, "all whole runs, which the rating is made of", hint);
        Ok(Some(Rates {
            rating,
            places: section.places.clone(),
            values,
            occupants,
            unkept: (shown, unkept),
            digest: sha256(format!("{}{sum}", json(section)?).as_bytes()),
        }))
    }

    /// Refuses a choice of runs that is not all of them; `given` is that of the command line.
    ///
    /// # Errors
    /// Runs that are missing.
    pub fn refuse_unkept(&self, keep: &Keep, given: Option<&str>) -> Result<(), Failure> {
        match given {
            _ if *keep == Keep::All => Ok(()),
            Some(given) => Err(Failure::with_help(
                format!("--keep {given}: the [rating] of the study is made of all whole runs"),
                "give --keep all, or leave it out",
            )),
            None => Err(refused(&self.unkept.0, &self.unkept.1)),
        }
    }

    /// In words, for a preview.
    pub fn words(&self) -> String {
        let how = match self.places.len() {
            0 => "each body as those with its dummy".to_owned(),
            1 => format!("each body as {}", self.places[0]),
            bodies => format!("{bodies} bodies together"),
        };
        format!("{}, {how}", self.rating.name)
    }

    /// The bodies of a sample, from its run or without one for a reason.
    fn bodies(&self, ended: &Ended, folder: &Folder, run_of: RunOf<'_>, units: Units) -> Result<Vec<Item>, Failure> {
        // the folder's own name is left out, so that a moved one has the same rating
        let file = format!("runs/{}", file_name(&folder.run(ended.index)));
        if let Some(missing) = &ended.missing {
            let missing = |occupant: &String| Item {
                file: file.clone(),
                occupant: occupant.clone(),
                notes: vec![missing.clone()],
                missing: Some(missing.clone()),
                ..Item::default()
            };
            return Ok(self.occupants.iter().map(missing).collect());
        }
        let Some(run) = run_of(ended.index) else {
            return Err(Failure::with_help(format!("{file} is missing"), "give the same command again"));
        };
        let mut results = Results::open(&run)?;
        results.path = file.into();
        Ok(of_run(&Judged::of(results, None, Options::default(), units, ())?))
    }

    /// Bodies to rate, and words on those left out: without a run they are blank if all are rated together.
    fn rateable(&self, mut items: Vec<Item>) -> (Vec<Item>, Vec<String>) {
        let mut left_out = Vec::new();
        if self.places.len() < 2 || items.iter().all(|item| item.missing.is_some()) {
            left_out = items.iter().filter_map(|item| item.missing.clone()).collect();
            left_out.dedup();
            let more = left_out.split_off(left_out.len().min(summary::SHOWN)).len();
            left_out.extend((more > 0).then(|| format!("{more} more samples without a run")));
            items.retain(|item| item.missing.is_none());
        }
        (items, left_out)
    }
}

/// A sample, and why it has no whole run.
struct Ended {
    index: u64,
    missing: Option<String>,
}

impl Ended {
    fn of(row: &Row) -> Self {
        let reason = row.reason.lines().next().unwrap_or_default();
        let missing = || format!("sample {} {}: {reason}", row.index, row.status.word());
        Ended { index: row.index, missing: (row.status != Status::Completed).then(missing) }
    }
}

/// The whole run of a sample, if it is intact.
pub type RunOf<'a> = &'a (dyn Fn(u64) -> Option<PathBuf> + Sync);

/// Names of the occupants of a model.
fn occupants(model: Option<&Model>) -> Vec<String> {
    let bodies = model.map_or(Vec::new(), |model| model.body().tree.bodies());
    match &bodies[..] {
        [] | [_] => vec![String::new()],
        several => several.iter().map(|body| body.name.to_owned()).collect(),
    }
}

/// Place in the study, what was found and what was expected of places that are not those of the bodies.
fn check(rating: &Rating, places: &[String], (runs, occupants): (u64, u64)) -> Result<(), (String, String, String)> {
    let misplaced = |Misplaced { at, found, expected }: Misplaced| {
        (format!("rating.places[{at}]"), format!("\"{}\": {found}", shortened(&places[at], CELL)), expected)
    };
    match places {
        [] => return Ok(()),
        [one] if named(rating, one).is_empty() => return Err(misplaced(unknown(rating, 0))),
        [_] => return Ok(()),
        several => distinct(rating, several).map_err(misplaced)?,
    };
    if runs.checked_mul(occupants) == Some(places.len() as u64) {
        return Ok(());
    }
    let each = if occupants == 1 { "one occupant".to_owned() } else { format!("{occupants} occupants") };
    let found = format!("{} places, but {runs} runs with {each} each", places.len());
    let expected = "one for each occupant of each run in the order of the runs, or one for all".to_owned();
    Err(("rating.places".to_owned(), found, expected))
}

/// Values that a study gives, and the hash of their file.
fn values(
    section: &RatingSection,
    rating: &'static Rating,
    (text, texts): (&StudyText, &Texts),
    name: &Path,
) -> Result<(Option<Values>, String), Failure> {
    let Some(file) = &section.values else { return Ok((None, String::new())) };
    let path = name.parent().unwrap_or(Path::new("")).join(file);
    let bytes = texts.get(NamedBy::Rating, file).map_err(|error| {
        let table = format!("the table {}", path.display());
        refused(&name.display().to_string(), &unread(text, "rating.values", &table, &error))
    })?;
    let sum = sha256(&bytes);
    Ok((Some(Values::from_bytes(&path, bytes, rating)?), sum))
}

/// Completed samples whose whole run is nowhere.
///
/// # Errors
/// A journal that cannot be read.
pub fn lacking(plan: &Plan, journal: &Journal, run_of: RunOf<'_>) -> Result<Vec<u64>, Failure> {
    let mut lacking = Vec::new();
    if plan.rating.is_some() {
        journal.each_row(|row| {
            let is_lacking = row.status == Status::Completed && run_of(row.index).is_none();
            lacking.extend(is_lacking.then_some(row.index));
            Ok(())
        })?;
    }
    Ok(lacking)
}

/// Rates the runs of a finished sweep as its study says, and writes the filled template and JSON into its folder.
/// Without a rating it removes those of an earlier one.
///
/// # Errors
/// A run that cannot be read; interrupted; an error of the operating system.
pub fn rate(
    plan: &Plan,
    (folder, sums): (&Folder, &Checksums),
    journal: &Journal,
    run_of: RunOf<'_>,
    (engine, waiting): (&Engine, &Waiting<'_>),
) -> Result<Rated, Failure> {
    let none = |notes| {
        folder.rating().iter().try_for_each(|file| sums.remove(file))?;
        Ok(Rated { notes, ..Rated::default() })
    };
    let Some(rates) = &plan.rating else { return none(Vec::new()) };
    let units = Units::of_scenario(plan.study.base.units());
    let mut samples = Vec::new();
    journal.each_row(|row| {
        // with a place for each run those left out have theirs too
        if row.status != Status::Excluded || rates.places.len() > 1 {
            samples.push(Ended::of(&row));
        }
        Ok(())
    })?;
    let of_sample = |ended: &Ended| {
        waiting.interrupt.refuse("all samples are finished; run the same command again to rate them")?;
        rates.bodies(ended, folder, run_of, units)
    };
    let items = engine.share(|| samples.par_iter().map(of_sample).collect::<Result<Vec<_>, Failure>>())?;
    let (items, mut notes) = rates.rateable(items.concat());
    if items.is_empty() {
        return none(notes);
    }
    let all = rate_all(rates.rating, &rates.places, rates.values.as_ref(), &items)?;
    let is_short = all.len() <= summary::SHOWN;
    notes.extend(if is_short { bodies::notes(&all) } else { Vec::new() });
    let written = written(rates.rating, &all, folder, waiting);
    if written.is_err() {
        folder.remove_partial_tables();
    }
    let files = written?.to_vec();
    files.iter().try_for_each(|file| sums.add(file))?;
    let told = if is_short { tables(rates.rating, &all, &items) } else { summary::summary(rates.rating, &all) };
    Ok(Rated { text: format!("\n{told}"), notes, files })
}

fn written(
    rating: &'static Rating,
    all: &[One],
    folder: &Folder,
    waiting: &Waiting<'_>,
) -> Result<[PathBuf; 2], Failure> {
    let _alone = waiting.claim(|| folder.claim_table())?;
    let [table, told] = folder.rating();
    write(&table, true, &all.iter().map(|one| &one.rated).collect::<Vec<_>>())?;
    write_whole(&told, Existing::Replace, json(&answer(rating, all))?.as_bytes())?;
    Ok([table, told])
}
