//! `occupant measures --rating`.

use std::path::Path;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use crash_measures::injury::Measure;
use crash_measures::measure::Dummy;
use crash_measures::rating::{RATINGS, Rating};
use occupant_jobs::rated::bodies::{Item, One, different, of_runs, rate_all};
use occupant_jobs::rated::{Answer, Values, rate_values, text, write};
use placed_text::shown;

use super::{Args, Judged};
use crate::base::{Done, Failure, json, note, print, refuse_input, say};
use crate::commands::tables::summary::Marks;

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
        file,
        occupant: String::new(),
        notes,
        caveats: &[],
        dummy: dummy.name(),
        is_dummy: None,
        direction: None,
        measures: measures.to_vec(),
    });
    rate(args, rating, &items.collect::<Vec<_>>())
}

fn rate(args: &Args, rating: &'static Rating, items: &[Item<'_>]) -> Result<Done, Failure> {
    let values = args.values.as_ref().map(|file| Values::read(file, rating)).transpose()?;
    show(args, rating, &rate_all(rating, &args.place, values.as_ref(), items)?, items)
}

fn show(args: &Args, rating: &'static Rating, all: &[One], items: &[Item<'_>]) -> Result<Done, Failure> {
    if let Some(file) = &args.output {
        args.runs.iter().chain(&args.values).try_for_each(|input| refuse_input(file, input))?;
    }
    let is_unmet = all.iter().any(|one| one.rated.is_unmet());
    if args.json {
        print(&json(&Answer::new(rating, all.iter().map(One::told).collect()))?)?;
    } else {
        let several = all.len() > 1;
        let said = |one: &One, words: &String| if several { format!("{}: {words}", one.name()) } else { words.clone() };
        all.iter().flat_map(|one| one.notes.iter().map(move |words| said(one, words))).for_each(|words| note(&words));
        let head = format!("{}\n{}\n{}\n", rating.title, rating.source, rating.remark);
        let body = |one: &One| format!("\n{}\n{}{}", shown(&one.name()), explained(one, items), text(&one.rated));
        print(&all.iter().map(body).fold(head, |all, body| all + &body))?;
    }
    if let Some(file) = &args.output {
        filled(file, args.force, all)?;
    }
    Ok(if is_unmet && args.strict { Done::Unwell } else { Done::Well })
}

/// What explains the marks of a result.
fn explained(one: &One, items: &[Item<'_>]) -> String {
    let own = one.items.iter().filter_map(|i| items.get(*i));
    different(own, |item| Marks::of(item.caveats).explained().unwrap_or_default()).concat()
}

/// Writes values in the layout of the template.
fn filled(file: &Path, force: bool, all: &[One]) -> Result<(), Failure> {
    let rated: Vec<_> = all.iter().map(|one| &one.rated).collect();
    let written = write(file, force, &rated)?;
    say(&format!("wrote {}", written.display()));
    Ok(())
}
