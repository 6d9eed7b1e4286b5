//! `occupant measures --rating`.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use crash_measures::injury::Measure;
use crash_measures::measure::Dummy;
use crash_measures::rating::{RATINGS, Rated, Rating};
use occupant_core::results::summary::Person;
use occupant_jobs::judged::Direction;
use occupant_jobs::rated::{Answer, Body, Result as Told, Values, choose, rate, rate_values, text, words};
use placed_text::shown;

use super::{Args, Judged};
use crate::base::{Done, Failure, json, note, print};
use crate::commands::tables::summary::Marks;

/// Ratings by name, each with its full name in help.
pub(super) fn names() -> impl TypedValueParser<Value = &'static Rating> {
    let names = RATINGS.iter().map(|rating| PossibleValue::new(rating.name).help(rating.title));
    PossibleValuesParser::new(names).try_map(|name| Rating::named(&name).ok_or("unknown name"))
}

/// One rated body: file, name of the occupant, words on it, what explains its marks, result.
struct One {
    file: String,
    occupant: String,
    notes: Vec<String>,
    marks: Option<String>,
    rated: Rated,
}

/// Rates values without a run or test.
pub(super) fn values_alone(args: &Args) -> Result<Done, Failure> {
    let Some((rating, file)) = args.rating.zip(args.values.as_ref()) else {
        return Err(Failure::with_help("no run, no test and no values", "give a run, a test or --values"));
    };
    if let Some(place) = &args.place {
        let found = format!("--place {place}: values name their occupants themselves");
        return Err(Failure::with_help(found, "leave it out"));
    }
    let values = Values::read(file, rating)?;
    let rated = rate_values(rating, &values);
    if rated.tests.is_empty() {
        return Err(Failure::with_help(format!("{} has no value", file.display()), "give at least one criterion"));
    }
    let file = file.display().to_string();
    show(args, rating, vec![One { file, occupant: String::new(), notes: Vec::new(), marks: None, rated }])
}

/// Rates all occupants of runs.
pub(super) fn runs(args: &Args, rating: &'static Rating, all: &[Judged]) -> Result<Done, Failure> {
    let values = values(args, rating)?;
    let mut rated = Vec::new();
    for one in all {
        let people = one.summary.people();
        let marks = Marks::of(&one.summary.caveats);
        for (prefix, person) in &people {
            let own = marks.of_occupant(prefix);
            let body = body(one, prefix.trim_end_matches('.'), person);
            let spoils = |measure: &Measure| own.spoils(measure.figure.unwrap_or(measure.name));
            let body = Body { spoils: &spoils, ..body };
            let chosen = choose(rating, args.place.as_deref(), body.dummy)?;
            rated.push(One {
                file: one.file.clone(),
                occupant: prefix.trim_end_matches('.').to_owned(),
                notes: one.notes.iter().cloned().chain(words(rating, &chosen, &body)).collect(),
                marks: own.explained(),
                rated: rate(rating, &chosen, &body, values.as_ref()),
            });
        }
    }
    show(args, rating, rated)
}

fn body<'a>(one: &Judged, name: &str, person: &'a Person) -> Body<'a> {
    let is_dummy = one.results.loaded.dummies().iter().any(|dummy| dummy == name);
    let direction = direction(one, name);
    Body { dummy: person.dummy, is_dummy: Some(is_dummy), direction, measures: &person.measures, spoils: &|_| false }
}

fn direction(one: &Judged, name: &str) -> Option<Direction> {
    let body = one.results.model.body().tree.bodies().iter().position(|row| row.name == name)?;
    Some(one.impact.direction(body))
}

/// Rates tests: files with their measures and notes.
pub(super) fn tests(
    args: &Args,
    rating: &'static Rating,
    dummy: Dummy,
    all: &[(&str, &[Measure], &[String])],
) -> Result<Done, Failure> {
    let values = values(args, rating)?;
    let one = |(file, measures, notes): &(&str, &[Measure], &[String])| {
        let body = Body { dummy: dummy.name(), is_dummy: None, direction: None, measures, spoils: &|_| false };
        let chosen = choose(rating, args.place.as_deref(), body.dummy)?;
        Ok(One {
            file: (*file).to_owned(),
            occupant: String::new(),
            notes: notes.iter().cloned().chain(words(rating, &chosen, &body)).collect(),
            marks: None,
            rated: rate(rating, &chosen, &body, values.as_ref()),
        })
    };
    show(args, rating, all.iter().map(one).collect::<Result<Vec<_>, Failure>>()?)
}

fn values(args: &Args, rating: &'static Rating) -> Result<Option<Values>, Failure> {
    args.values.as_ref().map(|file| Values::read(file, rating)).transpose()
}

fn show(args: &Args, rating: &'static Rating, all: Vec<One>) -> Result<Done, Failure> {
    let is_unmet = all.iter().any(|one| one.rated.is_unmet());
    if args.json {
        let told = |one: &One| Told::new(&one.file, &one.occupant, one.notes.clone(), &one.rated);
        print(&json(&Answer::new(rating, all.iter().map(told).collect()))?)?;
    } else {
        let several = all.len() > 1;
        all.iter().for_each(|one| {
            one.notes.iter().for_each(|words| note(&if several { said(one, words) } else { words.clone() }))
        });
        let head = format!("{}\n{}\n{}\n", rating.title, rating.source, rating.remark);
        let bodies = all.iter().map(|one| {
            let name = [shown(&one.file).to_string(), shown(&one.occupant).to_string()];
            let name: Vec<String> = name.into_iter().filter(|part| !part.is_empty()).collect();
            let marks = one.marks.as_deref().unwrap_or_default();
            format!("\n{}\n{}{marks}", name.join(", "), text(&one.rated))
        });
        print(&bodies.fold(head, |all, body| all + &body))?;
    }
    Ok(if is_unmet && args.strict { Done::Unwell } else { Done::Well })
}

fn said(one: &One, words: &str) -> String {
    let occupant = if one.occupant.is_empty() { String::new() } else { format!(", {}", one.occupant) };
    format!("{}{occupant}: {words}", one.file)
}
