//! `occupant measures --rating`.

use std::path::Path;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use crash_measures::injury::Measure;
use crash_measures::measure::Dummy;
use crash_measures::rating::{RATINGS, Rating};
use occupant_jobs::rated::bodies::{Item, One, answer, notes, of_runs, rate_all, tables};
use occupant_jobs::rated::{Values, rate_values, write};

use super::{Args, Judged};
use crate::base::{Done, Failure, json, note, print, refuse_input, say};

/// Ratings by name, each with its full name in help.
pub(super) fn names() -> impl TypedValueParser<Value = &'static Rating> {
    let names = RATINGS.iter().map(|rating| PossibleValue::new(rating.name).help(rating.title));
    PossibleValuesParser::new(names).try_map(|name| Rating::named(&name).ok_or("unknown name"))
}

/// Rates values without a run or test.
pub(super) fn values_alone(args: &Args) -> Result<Done, Failure> {
    let Some((rating, file)) = args.rating.zip(args.values.as_ref()) else {
        return Err(Failure::with_help("no run, no test and no values", "give a run, a test or --values"));
    };
    if let Some(place) = args.place.first() {
        let found = format!("--place {place}: values name their occupants themselves");
        return Err(Failure::with_help(found, "leave it out"));
    }
    let values = Values::read(file, rating)?;
    let rated = rate_values(rating, &values);
    if rated.tests.is_empty() {
        return Err(Failure::with_help(format!("{} has no value", file.display()), "give at least one criterion"));
    }
    let file = file.display().to_string();
    let one = One { items: Vec::new(), file, occupant: String::new(), notes: Vec::new(), rated };
    show(args, rating, &[one], &[])
}

/// Rates all occupants of runs.
pub(super) fn runs(args: &Args, rating: &'static Rating, all: &[Judged]) -> Result<Done, Failure> {
    rate(args, rating, &of_runs(all))
}

/// Rates tests: files with their measures and notes.
pub(super) fn tests(
    args: &Args,
    rating: &'static Rating,
    dummy: Dummy,
    all: &[(&str, &[Measure], &[String])],
) -> Result<Done, Failure> {
    let items = all.iter().map(|(file, measures, notes)| Item {
        file: (*file).to_owned(),
        notes: notes.to_vec(),
        dummy: dummy.name(),
        measures: measures.to_vec(),
        ..Item::default()
    });
    rate(args, rating, &items.collect::<Vec<_>>())
}

fn rate(args: &Args, rating: &'static Rating, items: &[Item]) -> Result<Done, Failure> {
    let values = args.values.as_ref().map(|file| Values::read(file, rating)).transpose()?;
    show(args, rating, &rate_all(rating, &args.place, values.as_ref(), items)?, items)
}

fn show(args: &Args, rating: &'static Rating, all: &[One], items: &[Item]) -> Result<Done, Failure> {
    if let Some(file) = &args.output {
        args.runs.iter().chain(&args.values).try_for_each(|input| refuse_input(file, input))?;
    }
    let is_unmet = all.iter().any(|one| one.rated.is_unmet());
    if args.json {
        print(&json(&answer(rating, all))?)?;
    } else {
        notes(all).iter().for_each(note);
        print(&tables(rating, all, items))?;
    }
    if let Some(file) = &args.output {
        filled(file, args.force, all)?;
    }
    Ok(if is_unmet && args.strict { Done::Unwell } else { Done::Well })
}

/// Writes values in the layout of the template.
fn filled(file: &Path, force: bool, all: &[One]) -> Result<(), Failure> {
    let rated: Vec<_> = all.iter().map(|one| &one.rated).collect();
    let written = write(file, force, &rated)?;
    say(&format!("wrote {}", written.display()));
    Ok(())
}
