//! `occupant measures --rating`.

use std::path::Path;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use crash_measures::injury::Measure;
use crash_measures::measure::Dummy;
use crash_measures::rating::{Occupant, RATINGS, Rated, Rating};
use occupant_jobs::judged::Direction;
use occupant_jobs::rated::{
    Answer, Body, Result as Told, Values, choose, rate, rate_together, rate_values, text, words, write,
};
use placed_text::shown;

use super::{Args, Judged};
use crate::base::{Done, Failure, json, note, print, refuse_input, say};
use crate::commands::tables::summary::Marks;

/// Ratings by name, each with its full name in help.
pub(super) fn names() -> impl TypedValueParser<Value = &'static Rating> {
    let names = RATINGS.iter().map(|rating| PossibleValue::new(rating.name).help(rating.title));
    PossibleValuesParser::new(names).try_map(|name| Rating::named(&name).ok_or("unknown name"))
}

/// A body of a run or test.
struct Item<'a> {
    file: &'a str,
    occupant: String,
    notes: &'a [String],
    marks: Marks<'a>,
    dummy: &'static str,
    /// None for a test.
    is_dummy: Option<bool>,
    direction: Option<Direction>,
    measures: Vec<Measure>,
}

/// A result: files, names of occupants, words on them, what explains marks.
struct One {
    file: String,
    occupant: String,
    notes: Vec<String>,
    marks: String,
    rated: Rated,
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
    show(args, rating, vec![One { file, occupant: String::new(), notes: Vec::new(), marks: String::new(), rated }])
}

/// Rates all occupants of runs.
pub(super) fn runs(args: &Args, rating: &'static Rating, all: &[Judged]) -> Result<Done, Failure> {
    let people: Vec<_> = all.iter().map(|one| (one, one.summary.people())).collect();
    let items = people.iter().flat_map(|(one, people)| {
        people.iter().map(|(prefix, person)| {
            let name = prefix.trim_end_matches('.').to_owned();
            Item {
                file: &one.file,
                notes: &one.notes,
                marks: Marks::of(&one.summary.caveats).of_occupant(prefix),
                dummy: person.dummy,
                is_dummy: Some(one.results.loaded.dummies().contains(&name)),
                direction: direction(one, &name),
                measures: person.measures.clone(),
                occupant: name,
            }
        })
    });
    rate_all(args, rating, &items.collect::<Vec<_>>())
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
    let items = all.iter().map(|(file, measures, notes)| Item {
        file,
        occupant: String::new(),
        notes,
        marks: Marks::default(),
        dummy: dummy.name(),
        is_dummy: None,
        direction: None,
        measures: measures.to_vec(),
    });
    rate_all(args, rating, &items.collect::<Vec<_>>())
}

/// Rates each body, or all of them together if each has its place.
fn rate_all(args: &Args, rating: &'static Rating, items: &[Item<'_>]) -> Result<Done, Failure> {
    let values = args.values.as_ref().map(|file| Values::read(file, rating)).transpose()?;
    let spoils: Vec<_> =
        items.iter().map(|item| |own: &Measure| item.marks.spoils(own.figure.unwrap_or(own.name))).collect();
    let bodies: Vec<Body<'_>> = items.iter().zip(&spoils).map(|(item, spoils)| item.body(spoils)).collect();
    let all = match &args.place[..] {
        [] | [_] => items
            .iter()
            .zip(&bodies)
            .map(|(item, body)| {
                let chosen = choose(rating, args.place.first().map(String::as_str), body.dummy)?;
                let rated = rate(rating, &chosen, body, values.as_ref());
                Ok(item.result(item.words(rating, &chosen, body), rated))
            })
            .collect::<Result<Vec<_>, Failure>>()?,
        places => vec![together(rating, places, items, &bodies, values.as_ref())?],
    };
    show(args, rating, all)
}

fn together(
    rating: &'static Rating,
    places: &[String],
    items: &[Item<'_>],
    bodies: &[Body<'_>],
    values: Option<&Values>,
) -> Result<One, Failure> {
    if places.len() != items.len() {
        let found = format!("{} bodies, but --place {} times", items.len(), places.len());
        return Err(Failure::with_help(found, "give one place for all, or one for each body in the order of the runs"));
    }
    let mut chosen: Vec<&'static Occupant> = Vec::new();
    for (place, body) in places.iter().zip(bodies) {
        let found = choose(rating, Some(place), body.dummy)?;
        match &found[..] {
            [only] if chosen.iter().all(|other| other.place() != only.place()) => chosen.push(only),
            [only] => {
                let found = format!("--place {place}: two bodies are {}", only.place());
                return Err(Failure::with_help(found, "give each body its own place"));
            }
            _ => {
                let known: Vec<String> = found.iter().map(|own| own.place()).collect();
                let found = format!("--place {place}: {} occupants have this name", known.len());
                return Err(Failure::with_help(found, &format!("choose one of {}", known.join("; "))));
            }
        }
    }
    let notes = items.iter().zip(bodies).zip(&chosen).flat_map(|((item, body), own)| {
        let name = item.name();
        item.words(rating, &[own], body).into_iter().map(move |words| format!("{name}: {words}"))
    });
    let of_all = |of: &dyn Fn(&Item<'_>) -> String| {
        let mut all: Vec<String> = items.iter().map(of).filter(|text| !text.is_empty()).collect();
        all.dedup();
        all
    };
    Ok(One {
        file: of_all(&|item| item.file.to_owned()).join(", "),
        occupant: of_all(&|item| item.occupant.clone()).join(", "),
        notes: notes.collect(),
        marks: of_all(&|item| item.marks.explained().unwrap_or_default()).concat(),
        rated: rate_together(rating, &chosen, bodies, values),
    })
}

impl Item<'_> {
    fn body<'b>(&'b self, spoils: &'b dyn Fn(&Measure) -> bool) -> Body<'b> {
        let Item { dummy, is_dummy, direction, .. } = *self;
        Body { dummy, is_dummy, direction, measures: &self.measures, spoils }
    }

    fn words(&self, rating: &Rating, chosen: &[&'static Occupant], body: &Body<'_>) -> Vec<String> {
        self.notes.iter().cloned().chain(words(rating, chosen, body)).collect()
    }

    fn name(&self) -> String {
        if self.occupant.is_empty() { self.file.to_owned() } else { format!("{}, {}", self.file, self.occupant) }
    }

    fn result(&self, notes: Vec<String>, rated: Rated) -> One {
        let marks = self.marks.explained().unwrap_or_default();
        One { file: self.file.to_owned(), occupant: self.occupant.clone(), notes, marks, rated }
    }
}

fn show(args: &Args, rating: &'static Rating, all: Vec<One>) -> Result<Done, Failure> {
    if let Some(file) = &args.output {
        args.runs.iter().chain(&args.values).try_for_each(|input| refuse_input(file, input))?;
    }
    let is_unmet = all.iter().any(|one| one.rated.is_unmet());
    if args.json {
        let told = |one: &One| Told::new(&one.file, &one.occupant, one.notes.clone(), &one.rated);
        print(&json(&Answer::new(rating, all.iter().map(told).collect()))?)?;
    } else {
        let several = all.len() > 1;
        let said = |one: &One, words: &String| if several { format!("{}: {words}", one.name()) } else { words.clone() };
        all.iter().flat_map(|one| one.notes.iter().map(move |words| said(one, words))).for_each(|words| note(&words));
        let head = format!("{}\n{}\n{}\n", rating.title, rating.source, rating.remark);
        let texts = all.iter().map(|one| format!("\n{}\n{}{}", shown(&one.name()), one.marks, text(&one.rated)));
        print(&texts.fold(head, |all, body| all + &body))?;
    }
    if let Some(file) = &args.output {
        filled(file, args.force, &all)?;
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

impl One {
    fn name(&self) -> String {
        if self.occupant.is_empty() { self.file.clone() } else { format!("{}, {}", self.file, self.occupant) }
    }
}
