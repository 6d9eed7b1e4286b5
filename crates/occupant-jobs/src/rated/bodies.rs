//! Bodies of runs and tests, rated one by one or together.

use crash_measures::injury::Measure;
use crash_measures::rating::{Occupant, Rated, Rating};
use occupant_core::results::summary::{Caveat, Person};
use placed_text::shown;

use super::{Answer, Body, Result as Told, Values, choose, distinct, rate, rate_together, text, words};
use crate::base::Failure;
use crate::base::describe::caveat;
use crate::judged::Direction;
use crate::measures::Judged;

/// A body of a run or test.
#[derive(Clone, Debug, Default)]
pub struct Item {
    /// The file.
    pub file: String,
    /// Name of the occupant; empty for the only one.
    pub occupant: String,
    /// Words on the file.
    pub notes: Vec<String>,
    /// Caveats of the run.
    pub caveats: Vec<Caveat>,
    /// The dummy whose limits apply.
    pub dummy: &'static str,
    /// Whether it is a dummy; none for a test.
    pub is_dummy: Option<bool>,
    /// Direction of the impact; none for a test.
    pub direction: Option<Direction>,
    /// Its measures.
    pub measures: Vec<Measure>,
    /// Why there is no run of it.
    pub missing: Option<String>,
}

/// The rating of a body, or of several together.
pub struct One {
    /// Places of the bodies in the list.
    pub items: Vec<usize>,
    /// Their files.
    pub file: String,
    /// Their names.
    pub occupant: String,
    /// Words on them.
    pub notes: Vec<String>,
    /// The result.
    pub rated: Rated,
}

/// All occupants of runs.
pub fn of_runs(all: &[Judged]) -> Vec<Item> {
    all.iter().flat_map(of_run).collect()
}

/// All occupants of a run.
pub fn of_run(one: &Judged) -> Vec<Item> {
    let item = |(prefix, person): (String, Person)| {
        let name = prefix.trim_end_matches('.').to_owned();
        Item {
            file: one.file.clone(),
            notes: one.notes.clone(),
            caveats: one.summary.caveats.clone(),
            dummy: person.dummy,
            is_dummy: Some(one.results.loaded.dummies().contains(&name)),
            direction: direction(one, &name),
            measures: person.measures,
            occupant: name,
            missing: None,
        }
    };
    one.summary.people().into_iter().map(item).collect()
}

fn direction(one: &Judged, name: &str) -> Option<Direction> {
    let body = one.results.model.body().tree.bodies().iter().position(|row| row.name == name)?;
    Some(one.impact.direction(body))
}

/// Rates each body, or all of them together if each has its place.
///
/// # Errors
/// Places that name no occupant, several, or one for two bodies.
pub fn rate_all(
    rating: &'static Rating,
    places: &[String],
    values: Option<&Values>,
    items: &[Item],
) -> Result<Vec<One>, Failure> {
    let spoils: Vec<_> = items.iter().map(|item| |own: &Measure| item.spoils(own)).collect();
    let bodies: Vec<Body<'_>> = items.iter().zip(&spoils).map(|(item, spoils)| item.body(spoils)).collect();
    let alone = |(i, (item, body)): (usize, (&Item, &Body<'_>))| {
        let chosen = choose(rating, places.first().map(String::as_str), body.dummy)?;
        let rated = rate(rating, &chosen, body, values);
        let notes = item.words(rating, &chosen, body);
        Ok(One { items: vec![i], file: item.file.clone(), occupant: item.occupant.clone(), notes, rated })
    };
    match places {
        [] | [_] => items.iter().zip(&bodies).enumerate().map(alone).collect(),
        places => Ok(vec![together(rating, places, items, &bodies, values)?]),
    }
}

fn together(
    rating: &'static Rating,
    places: &[String],
    items: &[Item],
    bodies: &[Body<'_>],
    values: Option<&Values>,
) -> Result<One, Failure> {
    if places.len() != items.len() {
        let found = format!("{} bodies, but --place {} times", items.len(), places.len());
        return Err(Failure::with_help(found, "give one place for all, or one for each body in the order of the runs"));
    }
    let chosen = distinct(rating, places).map_err(|wrong| {
        let place = places.get(wrong.at).map_or("", String::as_str);
        Failure::with_help(format!("--place {place}: {}", wrong.found), &format!("use {}", wrong.expected))
    })?;
    let notes = items.iter().zip(bodies).zip(&chosen).flat_map(|((item, body), own)| {
        let name = named(&item.file, &item.occupant);
        item.words(rating, &[own], body).into_iter().map(move |words| format!("{name}: {words}"))
    });
    Ok(One {
        items: (0..items.len()).collect(),
        file: different(items, |item| item.file.clone()).join(", "),
        occupant: different(items, |item| item.occupant.clone()).join(", "),
        notes: notes.collect(),
        rated: rate_together(rating, &chosen, bodies, values),
    })
}

/// The texts of items, without those that repeat the one before.
fn different<'i>(items: impl IntoIterator<Item = &'i Item>, of: impl Fn(&Item) -> String) -> Vec<String> {
    let mut all: Vec<String> = items.into_iter().map(of).filter(|text| !text.is_empty()).collect();
    all.dedup();
    all
}

/// File and occupant.
fn named(file: &str, occupant: &str) -> String {
    if occupant.is_empty() { file.to_owned() } else { format!("{file}, {occupant}") }
}

impl Item {
    fn body<'b>(&'b self, spoils: &'b dyn Fn(&Measure) -> bool) -> Body<'b> {
        let Item { dummy, is_dummy, direction, .. } = *self;
        let (measures, missing) = (&self.measures[..], self.missing.as_deref());
        Body { dummy, is_dummy, direction, measures, spoils, missing }
    }

    /// Whether a caveat applies to a measure.
    fn spoils(&self, own: &Measure) -> bool {
        let name = own.figure.unwrap_or(own.name);
        let figure = if self.occupant.is_empty() { name.to_owned() } else { format!("{}.{name}", self.occupant) };
        self.caveats.iter().any(|caveat| caveat.touches(&figure))
    }

    fn words(&self, rating: &Rating, chosen: &[&'static Occupant], body: &Body<'_>) -> Vec<String> {
        let own = if self.missing.is_none() { words(rating, chosen, body) } else { Vec::new() };
        self.notes.iter().cloned().chain(own).collect()
    }
}

impl One {
    /// Files and occupants.
    pub fn name(&self) -> String {
        named(&self.file, &self.occupant)
    }

    /// What is told of it in JSON.
    pub fn told(&self) -> Told {
        Told::new(&self.file, &self.occupant, self.notes.clone(), &self.rated)
    }
}

/// Words on all bodies; of several with their names.
pub fn notes(all: &[One]) -> Vec<String> {
    let several = all.len() > 1;
    let said = |one: &One, words: &String| if several { format!("{}: {words}", one.name()) } else { words.clone() };
    all.iter().flat_map(|one| one.notes.iter().map(move |words| said(one, words))).collect()
}

/// What is told of all in JSON.
pub fn answer(rating: &'static Rating, all: &[One]) -> Answer {
    Answer::new(rating, all.iter().map(One::told).collect())
}

/// Tables of all: the rating and its source, then each body with what explains its marks.
pub fn tables(rating: &Rating, all: &[One], items: &[Item]) -> String {
    let head = format!("{}\n{}\n{}\n", rating.title, rating.source, rating.remark);
    let body = |one: &One| format!("\n{}\n{}{}", shown(&one.name()), explained(one, items), text(&one.rated));
    all.iter().map(body).fold(head, |all, body| all + &body)
}

fn explained(one: &One, items: &[Item]) -> String {
    let own = one.items.iter().filter_map(|i| items.get(*i));
    different(own, |item| item.caveats.iter().map(caveat).collect()).concat()
}
