//! Bodies of runs and tests, rated one by one or together.

use crash_measures::injury::Measure;
use crash_measures::rating::{Occupant, Rated, Rating};
use occupant_core::results::summary::{Caveat, Person};

use super::{Body, Result as Told, Values, choose, rate, rate_together, words};
use crate::base::Failure;
use crate::judged::Direction;
use crate::measures::Judged;

/// A body of a run or test.
pub struct Item<'a> {
    /// The file.
    pub file: &'a str,
    /// Name of the occupant; empty for the only one.
    pub occupant: String,
    /// Words on the file.
    pub notes: &'a [String],
    /// Caveats of the run.
    pub caveats: &'a [Caveat],
    /// The dummy whose limits apply.
    pub dummy: &'static str,
    /// Whether it is a dummy; none for a test.
    pub is_dummy: Option<bool>,
    /// Direction of the impact; none for a test.
    pub direction: Option<Direction>,
    /// Its measures.
    pub measures: Vec<Measure>,
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
pub fn of_runs(all: &[Judged]) -> Vec<Item<'_>> {
    all.iter().flat_map(of_run).collect()
}

fn of_run(one: &Judged) -> Vec<Item<'_>> {
    let item = |(prefix, person): (String, Person)| {
        let name = prefix.trim_end_matches('.').to_owned();
        Item {
            file: &one.file,
            notes: &one.notes,
            caveats: &one.summary.caveats,
            dummy: person.dummy,
            is_dummy: Some(one.results.loaded.dummies().contains(&name)),
            direction: direction(one, &name),
            measures: person.measures,
            occupant: name,
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
    items: &[Item<'_>],
) -> Result<Vec<One>, Failure> {
    let spoils: Vec<_> = items.iter().map(|item| |own: &Measure| item.spoils(own)).collect();
    let bodies: Vec<Body<'_>> = items.iter().zip(&spoils).map(|(item, spoils)| item.body(spoils)).collect();
    let alone = |(i, (item, body)): (usize, (&Item<'_>, &Body<'_>))| {
        let chosen = choose(rating, places.first().map(String::as_str), body.dummy)?;
        let rated = rate(rating, &chosen, body, values);
        let notes = item.words(rating, &chosen, body);
        Ok(One { items: vec![i], file: item.file.to_owned(), occupant: item.occupant.clone(), notes, rated })
    };
    match places {
        [] | [_] => items.iter().zip(&bodies).enumerate().map(alone).collect(),
        places => Ok(vec![together(rating, places, items, &bodies, values)?]),
    }
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
        let name = named(item.file, &item.occupant);
        item.words(rating, &[own], body).into_iter().map(move |words| format!("{name}: {words}"))
    });
    Ok(One {
        items: (0..items.len()).collect(),
        file: different(items, |item| item.file.to_owned()).join(", "),
        occupant: different(items, |item| item.occupant.clone()).join(", "),
        notes: notes.collect(),
        rated: rate_together(rating, &chosen, bodies, values),
    })
}

/// The texts of items, without those that repeat the one before.
pub fn different<'i, 'a: 'i>(
    items: impl IntoIterator<Item = &'i Item<'a>>,
    of: impl Fn(&Item<'a>) -> String,
) -> Vec<String> {
    let mut all: Vec<String> = items.into_iter().map(of).filter(|text| !text.is_empty()).collect();
    all.dedup();
    all
}

/// File and occupant.
fn named(file: &str, occupant: &str) -> String {
    if occupant.is_empty() { file.to_owned() } else { format!("{file}, {occupant}") }
}

impl Item<'_> {
    fn body<'b>(&'b self, spoils: &'b dyn Fn(&Measure) -> bool) -> Body<'b> {
        let Item { dummy, is_dummy, direction, .. } = *self;
        Body { dummy, is_dummy, direction, measures: &self.measures, spoils }
    }

    /// Whether a caveat applies to a measure.
    fn spoils(&self, own: &Measure) -> bool {
        let name = own.figure.unwrap_or(own.name);
        let figure = if self.occupant.is_empty() { name.to_owned() } else { format!("{}.{name}", self.occupant) };
        self.caveats.iter().any(|caveat| caveat.touches(&figure))
    }

    fn words(&self, rating: &Rating, chosen: &[&'static Occupant], body: &Body<'_>) -> Vec<String> {
        self.notes.iter().cloned().chain(words(rating, chosen, body)).collect()
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
