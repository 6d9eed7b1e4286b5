//! Ratings as a table in the layout of Euro NCAP's template.

use std::path::{Path, PathBuf};

use crash_measures::rating::{Rated, RatedCriterion};
use occupant_files::table::{Cell, Form, Kind, TableFile};

use super::values::COLUMNS;
use crate::base::{Existing, Failure};

/// Writes places, criteria, values and reasons for blanks; each place in each row. If a value is a colour, yes or no,
/// the column of values is one of texts.
///
/// # Errors
/// An ending that is none of a table; a file that is there and may not be replaced; an error of the operating system.
pub fn write(path: &Path, force: bool, all: &[&Rated]) -> Result<PathBuf, Failure> {
    let form = Form::of_output(path)?;
    let places = COLUMNS[..5].iter().map(|name| (*name, Kind::Text));
    let criteria =
        all.iter().flat_map(|rated| &rated.tests).flat_map(|test| &test.occupants).flat_map(|own| &own.regions);
    let has_words = criteria.flat_map(|region| &region.criteria).any(|own| word(own).is_some());
    let rest = [
        (COLUMNS[5], if has_words { Kind::MaybeText } else { Kind::MaybeNumber }),
        ("Unit", Kind::Text),
        ("Remark", Kind::MaybeText),
    ];
    let columns: Vec<(&str, Kind)> = places.chain(rest).collect();
    let about: Vec<_> = all.first().map(|rated| ("source", rated.rating.source.to_owned())).into_iter().collect();
    let mut table = TableFile::create(path.to_owned(), form, Existing::by(force), &columns, &about)?;
    for person in all.iter().flat_map(|rated| &rated.tests).flat_map(|test| &test.occupants) {
        let own = person.occupant;
        for (region, criterion) in person.regions.iter().flat_map(|one| one.criteria.iter().map(move |c| (one, c))) {
            let words = [own.case, own.seat, own.label, region.region.name, criterion.criterion.name];
            let remark = criterion.entry.remark.as_deref().map_or(Cell::Absent, Cell::text);
            let value = value(criterion, has_words);
            let rest = [value, Cell::text(criterion.unit.symbol), remark];
            table.row(words.into_iter().map(Cell::text).chain(rest).collect())?;
        }
    }
    table.publish()
}

fn word(own: &RatedCriterion) -> Option<&'static str> {
    own.entry.value.and_then(|value| own.criterion.scale.word(value))
}

/// A value; in a column of texts as one.
fn value(own: &RatedCriterion, is_text: bool) -> Cell {
    let number = || {
        own.entry
            .value
            .map_or(Cell::Absent, |value| if is_text { Cell::text(&value.to_string()) } else { Cell::Number(value) })
    };
    word(own).map_or_else(number, Cell::text)
}
