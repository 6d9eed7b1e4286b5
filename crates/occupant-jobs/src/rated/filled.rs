//! Ratings as a table in the layout of Euro NCAP's template.

use std::path::{Path, PathBuf};

use crash_measures::rating::Rated;
use occupant_files::table::{Cell, Form, Kind, TableFile};

use super::values::COLUMNS;
use crate::base::{Existing, Failure};

/// Writes places, criteria, values and reasons for blanks; each place in each row.
///
/// # Errors
/// An ending that is none of a table; a file that is there and may not be replaced; an error of the operating system.
pub fn write(path: &Path, force: bool, all: &[&Rated]) -> Result<PathBuf, Failure> {
    let form = Form::of_output(path)?;
    let places = COLUMNS[..5].iter().map(|name| (*name, Kind::Text));
    let rest = [(COLUMNS[5], Kind::MaybeNumber), ("Unit", Kind::Text), ("Remark", Kind::MaybeText)];
    let columns: Vec<(&str, Kind)> = places.chain(rest).collect();
    let about: Vec<_> = all.first().map(|rated| ("source", rated.rating.source.to_owned())).into_iter().collect();
    let mut table = TableFile::create(path.to_owned(), form, Existing::by(force), &columns, &about)?;
    for person in all.iter().flat_map(|rated| &rated.tests).flat_map(|test| &test.occupants) {
        let own = person.occupant;
        for (region, criterion) in person.regions.iter().flat_map(|one| one.criteria.iter().map(move |c| (one, c))) {
            let words = [own.case, own.seat, own.label, region.region.name, criterion.criterion.name];
            let remark = criterion.entry.remark.as_deref().map_or(Cell::Absent, Cell::text);
            let value = criterion.entry.value.map_or(Cell::Absent, Cell::Number);
            let rest = [value, Cell::text(criterion.unit.symbol), remark];
            table.row(words.into_iter().map(Cell::text).chain(rest).collect())?;
        }
    }
    table.publish()
}
