//! Ratings of runs and tests: which occupant of a rating a body is, what it is rated by, words on what it is not.

mod answer;
pub mod bodies;
mod filled;
mod text;
mod values;

use crash_measures::injury::Measure;
use crash_measures::measure::Blow;
use crash_measures::rating::{Entry, Occupant, Rated, Rating};

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
    let words =
        |text: &str| text.to_lowercase().replace(',', " ").split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    if let Some(place) = place {
        let wanted = words(place);
        let fits = |own: &&Occupant| words(&own.place()).windows(wanted.len().max(1)).any(|part| part == wanted);
        let found: Vec<_> = rating.occupants().filter(fits).collect();
        if found.is_empty() {
            let known: Vec<String> = rating.occupants().map(Occupant::place).collect();
            let found = format!("--place {place}: no occupant of {} has this name", rating.name);
            return Err(Failure::with_help(found, &format!("use a part of one of {}", known.join("; "))));
        }
        return Ok(found);
    }
    let own: Vec<_> = rating.occupants().filter(|own| own.dummy.is_some_and(|known| known.name() == dummy)).collect();
    Ok(if own.is_empty() { rating.occupants().take(1).collect() } else { own })
}

/// Rates a body as some occupants of a rating. Values that are given count before measures.
pub fn rate(rating: &'static Rating, chosen: &[&'static Occupant], body: &Body<'_>, values: Option<&Values>) -> Rated {
    let is_chosen = |own: &Occupant| chosen.iter().any(|other| other.place() == own.place());
    rating.rate(is_chosen, |occupant, region, criterion| {
        let given = values.and_then(|values| values.entry(occupant, region, criterion));
        given.unwrap_or_else(|| Entry::from_measures(region.name, criterion.name, body.measures, body.spoils))
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
            let measured =
                body.map(|body| Entry::from_measures(region.name, criterion.name, body.measures, body.spoils));
            given.or(measured).unwrap_or_default()
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
