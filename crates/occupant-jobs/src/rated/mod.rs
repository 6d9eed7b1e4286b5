//! Ratings of runs and tests: which occupant of a rating a body is, what it is rated by, words on what it is not.

mod answer;
pub mod bodies;
mod filled;
pub mod summary;
mod text;
mod values;

use crash_measures::injury::Measure;
use crash_measures::measure::Blow;
use crash_measures::rating::{Criterion, Entry, Occupant, Rated, Rating, Region};

use crate::base::Failure;
use crate::judged::Direction;

pub use answer::{Answer, Result};
pub use filled::write;
pub use text::text;
pub use values::Values;

/// A body to be rated.
pub struct Body<'a> {
    /// The dummy whose limits apply to its measures.
    pub dummy: &'static str,
    /// Whether it is a dummy; otherwise a person. None for a test.
    pub is_dummy: Option<bool>,
    /// Direction of the impact; none for a test.
    pub direction: Option<Direction>,
    /// Its measures.
    pub measures: &'a [Measure],
    /// Whether a caveat applies to a measure.
    pub spoils: &'a dyn Fn(&Measure) -> bool,
    /// Why there is no run of it: its criteria are blank.
    pub missing: Option<&'a str>,
}

impl Body<'_> {
    fn entry(&self, region: &Region, criterion: &Criterion) -> Entry {
        let measured = || Entry::from_measures(region.name, criterion.name, self.measures, self.spoils);
        self.missing.map_or_else(measured, Entry::blank)
    }
}

/// A place that is none of one body.
pub struct Misplaced {
    /// Its number among the places.
    pub at: usize,
    /// What was found.
    pub found: String,
    /// What was expected.
    pub expected: String,
}

/// The occupants of a rating that a body may be: those of `place` (a part of their names), else those with its dummy,
/// else the first.
///
/// # Errors
/// No occupant of that name.
pub fn choose(
    rating: &'static Rating,
    place: Option<&str>,
    dummy: &str,
) -> std::result::Result<Vec<&'static Occupant>, Failure> {
    if let Some(place) = place {
        let found = named(rating, place);
        return match found.is_empty() {
            true => {
                let Misplaced { found, expected, .. } = unknown(rating, 0);
                Err(Failure::with_help(format!("--place {place}: {found}"), &format!("use {expected}")))
            }
            false => Ok(found),
        };
    }
    let own: Vec<_> = rating.occupants().filter(|own| own.dummy.is_some_and(|known| known.name() == dummy)).collect();
    Ok(if own.is_empty() { rating.occupants().take(1).collect() } else { own })
}

/// The occupants of a rating whose names have these words one after the other.
pub fn named(rating: &Rating, place: &str) -> Vec<&'static Occupant> {
    let words =
        |text: &str| text.to_lowercase().replace(',', " ").split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let wanted = words(place);
    let fits = |own: &&Occupant| words(&own.place()).windows(wanted.len().max(1)).any(|part| part == wanted);
    rating.occupants().filter(fits).collect()
}

/// A place that no occupant has.
pub fn unknown(rating: &Rating, at: usize) -> Misplaced {
    let known: Vec<String> = rating.occupants().map(Occupant::place).collect();
    let found = format!("no occupant of {} has this name", rating.name);
    Misplaced { at, found, expected: format!("a part of one of {}", known.join("; ")) }
}

/// The occupants that places name, each another one.
///
/// # Errors
/// The first place that names no occupant, several, or one that has its body.
pub fn distinct(rating: &Rating, places: &[String]) -> std::result::Result<Vec<&'static Occupant>, Misplaced> {
    let mut chosen: Vec<&'static Occupant> = Vec::new();
    for (at, place) in places.iter().enumerate() {
        match &named(rating, place)[..] {
            [] => return Err(unknown(rating, at)),
            [only] if chosen.iter().all(|other| other.place() != only.place()) => chosen.push(only),
            [only] => {
                let found = format!("two bodies are {}", only.place());
                return Err(Misplaced { at, found, expected: "a place of its own for each body".to_owned() });
            }
            several => {
                let known: Vec<String> = several.iter().map(|own| own.place()).collect();
                let found = format!("{} occupants have this name", known.len());
                return Err(Misplaced { at, found, expected: format!("one of {}", known.join("; ")) });
            }
        }
    }
    Ok(chosen)
}

/// Rates a body as some occupants of a rating. Values that are given count before measures.
pub fn rate(rating: &'static Rating, chosen: &[&'static Occupant], body: &Body<'_>, values: Option<&Values>) -> Rated {
    let is_chosen = |own: &Occupant| chosen.iter().any(|other| other.place() == own.place());
    rating.rate(is_chosen, |occupant, region, criterion| {
        let given = values.and_then(|values| values.entry(occupant, region, criterion));
        given.unwrap_or_else(|| body.entry(region, criterion))
    })
}

/// Rates several bodies together, each as its own occupant.
pub fn rate_together(
    rating: &'static Rating,
    chosen: &[&'static Occupant],
    bodies: &[Body<'_>],
    values: Option<&Values>,
) -> Rated {
    let body_of = |own: &Occupant| chosen.iter().position(|other| other.place() == own.place());
    rating.rate(
        |own| body_of(own).is_some(),
        |occupant, region, criterion| {
            let given = values.and_then(|values| values.entry(occupant, region, criterion));
            let body = body_of(occupant).and_then(|i| bodies.get(i));
            given.or_else(|| body.map(|body| body.entry(region, criterion))).unwrap_or_default()
        },
    )
}

/// Rates values alone: all occupants that have any.
pub fn rate_values(rating: &'static Rating, values: &Values) -> Rated {
    rating.rate(
        |own| values.has(own),
        |occupant, region, criterion| {
            values.entry(occupant, region, criterion).unwrap_or_else(|| Entry::blank("no value given"))
        },
    )
}

/// Words on a body that is not the dummy of the protocol, or was not in its test.
pub fn words(rating: &Rating, chosen: &[&'static Occupant], body: &Body<'_>) -> Vec<String> {
    let mut labels: Vec<&str> = chosen.iter().filter(|own| !is_of(own, body)).map(|own| own.label).collect();
    labels.dedup();
    let other = (!labels.is_empty()).then(|| {
        format!("the dummy of the protocol is the {}; this body has the size of a {}", labels.join(" or "), body.dummy)
    });
    let surrogate = body.is_dummy.map(|is_dummy| match is_dummy {
        true => "a model of a dummy, not the dummy of the protocol: its rating is an estimate".to_owned(),
        false => "a person's body, not the dummy of the protocol: its rating is a yardstick".to_owned(),
    });
    let direction = body.direction.filter(|own| *own != Direction::Blow(rating.blow)).map(|own| {
        let found = match own {
            Direction::Blow(Blow::Front) => "a frontal impact",
            Direction::Blow(Blow::Side) => "a side impact",
            Direction::Blow(Blow::Rear) => "a rear impact",
            Direction::Blow(Blow::OnFoot) => "a blow on foot",
            Direction::Rollover => "a rollover",
            Direction::None => "no impact on the vehicle",
        };
        let wanted = if rating.blow == Blow::Side { "a side impact" } else { "a frontal impact" };
        format!("the run is {found}, the rating is of {wanted}")
    });
    [other, surrogate, direction].into_iter().flatten().collect()
}

fn is_of(occupant: &Occupant, body: &Body<'_>) -> bool {
    occupant.dummy.is_some_and(|known| known.name() == body.dummy)
}
