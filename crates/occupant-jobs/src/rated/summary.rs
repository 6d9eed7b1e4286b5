//! Many rated bodies as one table.

use crash_measures::rating::{RatedOccupant, Rating};
use placed_text::shown;

use super::bodies::One;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::Table;

/// Number of bodies up to which each has its tables.
pub const SHOWN: usize = 20;

/// The rating and its source, then for each place the bodies with the least and the most, and those in the middle.
pub fn summary(rating: &Rating, all: &[One]) -> String {
    let people = || {
        all.iter().flat_map(|one| one.rated.tests.iter().flat_map(|test| &test.occupants).map(move |own| (one, own)))
    };
    let mut places: Vec<String> = Vec::new();
    for (_, person) in people() {
        let place = person.occupant.place();
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let mut table = Table::new(&[
        (Left, &["place"]),
        (Right, &["bodies", "marked !", "capped"]),
        (Left, &["least", "of", "median", "most", "of"]),
    ]);
    for place in places {
        let own = people().filter(|(_, person)| person.occupant.place() == place).collect();
        table.row(std::iter::once(shown(&place).to_string()).chain(row(rating, own)));
    }
    let head = format!("{}\n{}\n{}\n", rating.title, rating.source, rating.remark);
    format!("{head}\n{} bodies; rating.xlsx and rating.json have each\n{}", all.len(), table.text())
}

/// The cells of a place after its name, from its bodies, at least one.
fn row(rating: &Rating, mut own: Vec<(&One, &RatedOccupant)>) -> Vec<String> {
    own.sort_by(|a, b| a.1.outcome.now.total_cmp(&b.1.outcome.now));
    let count = |is: fn(&RatedOccupant) -> bool| own.iter().filter(|(_, person)| is(person)).count().to_string();
    let words = |at: usize| own[at].1.outcome.words(rating.method);
    let last = own.len().saturating_sub(1);
    let counts = [own.len().to_string(), count(|own| own.doubtful), count(|own| own.capped)];
    let ends = [words(0), own[0].0.name(), words(last / 2), words(last), own[last].0.name()];
    counts.into_iter().chain(ends).collect()
}
