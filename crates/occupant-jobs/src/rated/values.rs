//! Values of a rating from a table, in the layout of Euro NCAP's template: load case, seat, dummy, region, criterion,
//! value. An empty cell of the first four means the cell above; without a load case, a seat and a dummy it is of all
//! occupants. A table of input parameters, as its workbook has one, answers questions on the car.

use std::path::Path;

use crash_measures::rating::{COLOURS, Criterion, Entry, INSPECTION, Occupant, Rating, Region, Scale};
use placed_text::{
    CELL, Cell, Diagnostic, Diagnostics, Problem, Separator, Sources, Span, is_missing, lines, nearest, shortened,
};

use crate::base::Failure;
use occupant_files::measured;

/// Columns, by their names in the template.
pub(super) const COLUMNS: [&str; 6] = ["Loadcase", "Seat position", "Dummy", "Body region", "Criteria", "Value"];
/// Columns of input parameters.
const PARAMETERS: [&str; 2] = ["Input parameter", "Value"];
/// Number of columns that repeat downwards.
const PLACES: usize = 4;
/// Largest number of problems shown.
const SHOWN: usize = 8;

/// Values of criteria.
#[derive(Clone, Debug, Default)]
pub struct Values {
    rows: Vec<Row>,
    /// Answers on the car, by their criteria.
    answers: Vec<(&'static str, Option<f64>)>,
}

/// A value with its place.
#[derive(Clone, Debug)]
struct Row {
    /// Name of the occupant; none for all.
    place: Option<String>,
    region: &'static str,
    criterion: &'static str,
    value: Option<f64>,
}

impl Values {
    /// Values of a rating from a file.
    ///
    /// # Errors
    /// A file that cannot be read; columns, places, criteria and numbers that are not those of the rating; a criterion
    /// that stands twice.
    pub fn read(path: &Path, rating: &'static Rating) -> Result<Self, Failure> {
        Values::of(path, measured::text(path)?, rating)
    }

    /// The same from the bytes of a file; `path` is its name.
    ///
    /// # Errors
    /// As [`Values::read`].
    pub fn from_bytes(path: &Path, bytes: Vec<u8>, rating: &'static Rating) -> Result<Self, Failure> {
        Values::of(path, measured::text_from(path, bytes)?, rating)
    }

    fn of(path: &Path, text: String, rating: &'static Rating) -> Result<Self, Failure> {
        let mut sources = Sources::new();
        let id = sources.add_named(path.display().to_string(), text);
        let mut reader = Reader { sources: &sources, rating, values: Values::default(), problems: Diagnostics::new() };
        let all: Vec<Span> = lines(&sources, id).collect();
        reader.tables(sources.start_of(id), &all);
        if reader.problems.has_errors() {
            return Err(Failure::CouldNotRun(reader.problems.abridged(SHOWN).to_string()));
        }
        Ok(reader.values)
    }

    /// Whether there is any row of an occupant.
    pub fn has(&self, occupant: &Occupant) -> bool {
        self.rows.iter().any(|row| row.is_of(occupant))
    }

    /// The value of a criterion; none if it has no row.
    pub fn entry(&self, occupant: &Occupant, region: &Region, criterion: &Criterion) -> Option<Entry> {
        let is_own = |row: &&Row| row.is_of(occupant) && row.region == region.name && row.criterion == criterion.name;
        let row = self.rows.iter().find(is_own).map(|row| row.value);
        let answer = || self.answers.iter().find(|(name, _)| *name == criterion.name).map(|(_, value)| *value);
        let value = row.or_else(answer)?;
        Some(value.map_or_else(|| Entry::blank("no value given"), Entry::of))
    }
}

impl Row {
    fn is_of(&self, occupant: &Occupant) -> bool {
        self.place.as_ref().is_none_or(|place| *place == occupant.place())
    }
}

struct Reader<'a> {
    sources: &'a Sources,
    rating: &'static Rating,
    values: Values,
    problems: Diagnostics,
}

impl<'a> Reader<'a> {
    /// The tables of a text: several, with the names of their sheets between, if it is a workbook.
    fn tables(&mut self, start: Span, all: &[Span]) {
        let is_head = |line: &Span| self.columns(*line).iter().skip(PLACES - 1).all(Option::is_some);
        let is_of_car = |line: &Span| self.found_columns(*line, PARAMETERS).iter().all(Option::is_some);
        let heads: Vec<usize> = (0..all.len()).filter(|i| is_head(&all[*i]) || is_of_car(&all[*i])).collect();
        if heads.is_empty() {
            return self.no_table(start, all.first());
        }
        let is_of_several = heads.iter().filter(|i| is_head(&all[**i])).count() > 1;
        let ends = heads.iter().skip(1).copied().chain([all.len()]);
        for (head, end) in heads.iter().zip(ends) {
            let rest = &all[head + 1..end];
            match self.found_columns(all[*head], PARAMETERS) {
                [Some(name), Some(value)] => self.parameters(all[*head], [name, value], rest),
                _ => self.table(all[*head], rest, is_of_several),
            }
        }
    }

    /// Answers on the car. Parameters of other ratings are left out.
    fn parameters(&mut self, head: Span, columns: [usize; 2], rest: &[Span]) {
        let separator = Separator::of(self.sources.slice(head));
        for line in rest {
            let cells = separator.cells(self.sources, *line);
            let [Some(name), value] = columns.map(|column| cells.get(column)) else { continue };
            let Some(own) = self.question(name.text) else { continue };
            if self.values.answers.iter().any(|(known, _)| *known == own.name) {
                self.wrong(name.span, &format!("`{}` a second time", own.name), "each parameter once");
            }
            if let Some(value) = self.value(separator, value, own) {
                self.values.answers.push((own.name, value));
            }
        }
    }

    /// The question of the rating that a parameter answers, with or without its question mark.
    fn question(&self, name: &str) -> Option<&'static Criterion> {
        let bare = |name: &str| name.trim_end_matches(['?', ' ']).to_lowercase();
        let criteria = self.rating.occupants().flat_map(|own| own.regions).flat_map(|region| region.criteria);
        criteria.filter(|own| matches!(own.scale, Scale::Answer)).find(|own| bare(own.name) == bare(name))
    }

    fn no_table(&mut self, start: Span, first: Option<&Span>) {
        let Some(head) = first else { return self.wrong(start, "an empty table", &COLUMNS.join(", ")) };
        let columns = self.columns(*head);
        let missing = (PLACES - 1..COLUMNS.len()).find(|i| columns[*i].is_none()).unwrap_or(PLACES);
        self.wrong(*head, &format!("no column `{}`", COLUMNS[missing]), &COLUMNS.join(", "));
    }

    /// Where the columns are in a line of headings.
    fn columns(&self, head: Span) -> [Option<usize>; COLUMNS.len()] {
        self.found_columns(head, COLUMNS)
    }

    fn found_columns<const N: usize>(&self, head: Span, names: [&str; N]) -> [Option<usize>; N] {
        let heads = Separator::of(self.sources.slice(head)).cells(self.sources, head);
        names.map(|name| heads.iter().position(|cell| cell.text.eq_ignore_ascii_case(name)))
    }

    /// One table. One of several is left out if it begins with an occupant whom the rating does not have.
    fn table(&mut self, head: Span, rest: &[Span], is_of_several: bool) {
        let (separator, columns) = (Separator::of(self.sources.slice(head)), self.columns(head));
        let mut above: [Option<Cell<'a>>; PLACES] = [None; PLACES];
        let mut is_known = !is_of_several;
        for line in rest {
            let cells = separator.cells(self.sources, *line);
            let cell = |i: usize| columns[i].and_then(|column| cells.get(column)).filter(|cell| !cell.text.is_empty());
            for (i, known) in above.iter_mut().enumerate() {
                *known = cell(i).copied().or(*known);
            }
            let Some(criterion) = cell(PLACES) else { continue };
            if !is_known && self.found(&above).is_empty() {
                return;
            }
            is_known = true;
            self.row(separator, &above, criterion, cell(PLACES + 1));
        }
    }

    fn row(
        &mut self,
        separator: Separator,
        place: &[Option<Cell<'_>>],
        criterion: &Cell<'_>,
        value: Option<&Cell<'_>>,
    ) {
        let Some(occupants) = self.occupants(place, criterion.span) else { return };
        let regions = || occupants.iter().flat_map(|own| own.regions.iter().map(|region| (*own, region)));
        let wanted = place[PLACES - 1].map_or("", |cell| cell.text);
        let is_wanted = |own: &(_, &Region)| same(own.1.name, wanted);
        let has_it = |own: &(_, &Region)| own.1.criteria.iter().any(|known| same(known.name, criterion.text));
        let found = regions().find(|own| is_wanted(own) && has_it(own)).or_else(|| regions().find(is_wanted));
        let Some((occupant, region)) = found else {
            let mut known: Vec<&str> = regions().map(|(_, region)| region.name).collect();
            known.sort_unstable();
            known.dedup();
            return self.unknown(place[PLACES - 1].map_or(criterion.span, |cell| cell.span), "region", wanted, &known);
        };
        let criteria = || region.criteria.iter().chain([&INSPECTION]);
        let Some(own) = criteria().find(|own| same(own.name, criterion.text)) else {
            let known: Vec<&str> = criteria().map(|own| own.name).collect();
            return self.unknown(criterion.span, "criterion", criterion.text, &known);
        };
        if self.values.entry(occupant, region, own).is_some() {
            return self.wrong(criterion.span, &format!("`{}` a second time", own.name), "each criterion once");
        }
        let Some(value) = self.value(separator, value, own) else { return };
        let place = (occupants.len() == 1).then(|| occupant.place());
        self.values.rows.push(Row { place, region: region.name, criterion: own.name, value });
    }

    /// A number, none for a word that means no value; nothing after a complaint.
    fn value(&mut self, separator: Separator, cell: Option<&Cell<'_>>, own: &Criterion) -> Option<Option<f64>> {
        let Some(cell) = cell.filter(|cell| !is_missing(cell.text)) else { return Some(None) };
        let expected = match own.scale {
            Scale::Excursion | Scale::Beside(_) => return self.colour(cell).map(Some),
            Scale::Answer => "yes, no, or nothing",
            _ => "a finite number, or nothing",
        };
        match (cell.text.to_lowercase().as_str(), separator.number(cell)) {
            ("true" | "yes", _) => Some(Some(1.0)),
            ("false" | "no", _) => Some(Some(0.0)),
            (_, Ok(number)) if !matches!(own.scale, Scale::Answer) || [0.0, 1.0].contains(&number) => {
                Some(Some(number))
            }
            (_, found) => {
                let found = found.err().unwrap_or_else(|| format!("`{}`", shortened(cell.text, CELL)));
                self.wrong(cell.span, &found, expected);
                None
            }
        }
    }

    /// The place of a colour; nothing after a complaint.
    fn colour(&mut self, cell: &Cell<'_>) -> Option<f64> {
        let place = COLOURS.iter().position(|colour| same(colour, cell.text));
        if place.is_none() {
            self.unknown(cell.span, "colour", cell.text, &COLOURS);
        }
        place.map(|place| place as f64)
    }

    /// The occupants that a line names.
    fn found(&self, place: &[Option<Cell<'_>>]) -> Vec<&'static Occupant> {
        let fits = |known: &str, i: usize| place[i].is_none_or(|cell| same(known, cell.text));
        let is_it = |own: &&Occupant| fits(own.case, 0) && fits(own.seat, 1) && fits(own.label, 2);
        self.rating.occupants().filter(is_it).collect()
    }

    /// The occupant of a line; all of them if it names none.
    fn occupants(&mut self, place: &[Option<Cell<'_>>], span: Span) -> Option<Vec<&'static Occupant>> {
        let named = || place[..PLACES - 1].iter().flatten();
        let found = self.found(place);
        if found.len() == 1 || named().next().is_none() {
            return Some(found);
        }
        let words: Vec<&str> = named().map(|cell| cell.text).collect();
        let known: Vec<String> = self.rating.occupants().map(Occupant::place).collect();
        let what = if found.is_empty() { "no occupant is" } else { "several occupants are" };
        let span = named().next_back().map_or(span, |cell| cell.span);
        let said = format!("{what} `{}`", shortened(&words.join(", "), CELL));
        self.wrong(span, &said, &format!("one of {}", known.join("; ")));
        None
    }

    fn unknown(&mut self, span: Span, what: &str, word: &str, known: &[&str]) {
        let hint = nearest(word, known.iter().copied()).map(|name| format!("did you mean `{name}`?"));
        let problem = Problem::error("", format!("the {what} `{}`", shortened(word, CELL)), known.join("; "));
        self.report(span, problem.with_hint(hint));
    }

    fn wrong(&mut self, span: Span, found: &str, expected: &str) {
        self.report(span, Problem::error("", found, expected));
    }

    fn report(&mut self, span: Span, problem: Problem) {
        self.problems.add(problem, |problem| Diagnostic::at(self.sources, span, problem));
    }
}

/// Whether two names are the same, whatever their capitals.
fn same(known: &str, word: &str) -> bool {
    known.to_lowercase() == word.to_lowercase()
}
