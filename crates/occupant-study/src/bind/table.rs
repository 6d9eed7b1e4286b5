//! The samples of a CSV or Parquet file: names with units, then one row for each sample.

use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Once;

use bytes::Bytes;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::Binder;
use super::design::MOST_RUNS;
use super::law::kind_of;
use crate::law::{Law, Value};
use crate::parameter::{Parameter, Target, si_unit};
use crate::rows::Rows;
use crate::section::ApplyChoice;
use occupant_scenario::kind::Kind;
use occupant_scenario::{Diagnostic, Resolver, Wanted};
use placed_text::{CELL, Cell, Problem, Separator, Sources, Span, lines, name_and_unit, one_of, shortened, text_of};

/// Reading of the cells of a column.
struct Column {
    parameter: usize,
    wanted: Wanted,
    kind: Option<&'static Kind>,
    factor: f64,
}

/// The samples of a file. A heading that names no parameter is a path, which becomes a parameter.
pub(super) fn rows(binder: &mut Binder, file: &str, parameters: &mut Vec<Parameter>, resolver: Resolver) -> Rows {
    let bytes = match resolver(file) {
        Ok(bytes) => bytes,
        Err(reason) => {
            let found = format!("`{file}` cannot be read: {reason}");
            let is_large = reason.contains("the limit for");
            let hint = is_large
                .then(|| "a larger table is read from Parquet, as DuckDB's `copy … to` or polars write it".to_owned());
            binder.error("design.file", found, "a CSV or Parquet file, its name relative to the study", hint);
            return Rows::default();
        }
    };
    if bytes.starts_with(PARQUET) {
        return of_parquet(binder, file, bytes, parameters);
    }
    let text = match text_of(&bytes, file) {
        Ok(text) => text,
        Err(problems) => {
            binder.problems.extend(problems);
            return Rows::default();
        }
    };
    let mut sources = Sources::new();
    let id = sources.add_named(file, text);
    let mut lines = lines(&sources, id).peekable();
    let separator = Separator::of(lines.peek().map_or("", |header| sources.slice(*header)));
    let mut reader = Reader { sources: &sources, separator, binder };
    let Some(header) = lines.next() else {
        let start = sources.start_of(id);
        reader.error(start, "an empty table", "a line that names the columns");
        return Rows::default();
    };
    let cells = reader.separator.cells(&sources, header);
    let columns = reader.header(&cells, header, parameters);
    let mut rows = Rows::default();
    lines.filter_map(|line| reader.row(line, &columns, parameters.len())).for_each(|row| rows.push(row));
    if rows.is_empty() && !reader.binder.problems.has_errors() {
        reader.error(header, "a table without samples", "one line per sample");
    }
    rows
}

struct Reader<'s, 'b, 'a> {
    sources: &'s Sources,
    separator: Separator,
    binder: &'b mut Binder<'a>,
}

impl Reader<'_, '_, '_> {
    fn error(&mut self, span: Span, found: impl Into<String>, expected: impl Into<String>) {
        self.report(span, Problem::error("", found, expected));
    }

    fn report(&mut self, span: Span, problem: Problem) {
        let sources = self.sources;
        self.binder.problems.add(problem, |problem| Diagnostic::at(sources, span, problem));
    }

    /// The columns under these headings, which are at `line`.
    fn header(&mut self, cells: &[Cell], line: Span, parameters: &mut Vec<Parameter>) -> Vec<Option<Column>> {
        let mut columns: Vec<Option<Column>> = Vec::new();
        for cell in cells {
            let column = self.column(cell, parameters);
            let taken = |c: &Column| columns.iter().flatten().any(|o| o.parameter == c.parameter);
            match column {
                Some(column) if taken(&column) => {
                    let found = format!("two columns for `{}`", name_and_unit(cell.text).0);
                    self.error(cell.span, found, "each column once");
                    columns.push(None);
                }
                column => columns.push(column),
            }
        }
        for parameter in parameters.iter() {
            if !cells.iter().any(|c| name_and_unit(c.text).0 == parameter.name) {
                let found = format!("no column `{}`", parameter.name);
                self.error(line, found, "one column per parameter");
            }
        }
        columns
    }

    fn column(&mut self, cell: &Cell, parameters: &mut Vec<Parameter>) -> Option<Column> {
        let (name, unit) = name_and_unit(cell.text);
        let parameter = match parameters.iter().position(|p| p.name == name) {
            Some(i) => i,
            None => {
                parameters.push(self.of_path(name, cell.span)?);
                parameters.len() - 1
            }
        };
        let of = &parameters[parameter];
        let wanted = self.wanted(of)?;
        let kind = kind_of(&wanted, of.apply);
        let factor = self.factor(cell, name, unit, kind)?;
        Some(Column { parameter, wanted, kind, factor })
    }

    /// Kinds of values that the targets of a parameter accept.
    fn wanted(&self, parameter: &Parameter) -> Option<Wanted> {
        let path = &parameter.targets.first()?.path;
        let places = self.binder.base?.places(path).ok()?;
        places.first().map(|p| p.wanted.clone())
    }

    /// A parameter for a column headed by a path.
    fn of_path(&mut self, path: &str, span: Span) -> Option<Parameter> {
        let places = match self.binder.base?.places(path) {
            Ok(places) => places,
            Err(error) => {
                let expected = format!("the name of a parameter, or a path: {}", error.expected);
                self.report(span, Problem { expected, ..error });
                return None;
            }
        };
        let wanted = places.first().map(|p| p.wanted.clone())?;
        if let Some(other) = places.iter().find(|p| p.wanted != wanted) {
            let found = format!("`{}` is {}, others are not", other.path, other.wanted.noun());
            self.error(span, found, "paths of one quantity");
            return None;
        }
        Some(Parameter {
            name: path.to_owned(),
            unit: si_unit(&wanted),
            apply: ApplyChoice::Value,
            law: Law::Table,
            crossed: false,
            targets: places.iter().map(Target::of).collect(),
            source: "",
        })
    }

    /// Factor from the column's unit to SI.
    fn factor(&mut self, cell: &Cell, name: &str, unit: Option<&str>, kind: Option<&Kind>) -> Option<f64> {
        let factor = match (unit.filter(|u| !u.is_empty()), kind) {
            (None, None) => Ok(1.0),
            (None, Some(kind)) if kind.unit.expression().is_empty() => Ok(1.0),
            (unit, Some(kind)) => {
                let factor = kind.column_factor(name, unit);
                factor.map_err(|e| Problem::error("", e.found, e.expected).with_hint(e.hint))
            }
            (Some(_), None) => Err(Problem::error("", format!("a unit for names, `{name}`"), "no unit")),
        };
        factor.map_err(|problem| self.report(cell.span, problem)).ok()
    }

    fn row(&mut self, line: Span, columns: &[Option<Column>], n: usize) -> Option<Vec<Value>> {
        let cells = self.separator.cells(self.sources, line);
        if cells.len() != columns.len() {
            let expected = format!("{}, one for each column", columns.len());
            self.error(line, format!("{} values", cells.len()), expected);
            return None;
        }
        let mut row = vec![Value::Base; n];
        for (cell, column) in cells.iter().zip(columns) {
            if let Some(column) = column {
                row[column.parameter] = self.cell(cell, column)?;
            }
        }
        Some(row)
    }

    fn cell(&mut self, cell: &Cell, column: &Column) -> Option<Value> {
        if column.kind.is_some() {
            let number = self.separator.number(cell).map(|x| x * column.factor);
            return match number {
                Ok(x) if x.is_finite() => Some(Value::Number(x)),
                found => {
                    self.error(cell.span, found.err().unwrap_or_else(|| format!("`{}`", cell.text)), "a number");
                    None
                }
            };
        }
        let value = column.word(cell.text);
        if value.is_none() {
            self.error(cell.span, format!("`{}`", cell.text), column.expected());
        }
        value
    }
}

impl Column {
    /// A word as a value.
    fn word(&self, text: &str) -> Option<Value> {
        match (&self.wanted, text) {
            (Wanted::Truth, "true") => Some(Value::Truth(true)),
            (Wanted::Truth, "false") => Some(Value::Truth(false)),
            (Wanted::Names(names), text) if names.contains(&text) => Some(Value::Text(text.into())),
            (Wanted::Text, text) if !text.is_empty() => Some(Value::Text(text.into())),
            _ => None,
        }
    }

    /// What its cells are.
    fn expected(&self) -> String {
        match (&self.kind, &self.wanted) {
            (Some(_), _) => "a number".to_owned(),
            (None, Wanted::Names(names)) => one_of(names, '"'),
            (None, wanted) => wanted.noun().to_owned(),
        }
    }

    /// A field of Parquet as a value.
    fn field(&self, field: &Field) -> Option<Value> {
        if self.kind.is_none() {
            return match field {
                Field::Str(text) => self.word(text),
                Field::Bool(truth) => self.word(&truth.to_string()),
                _ => None,
            };
        }
        let number = match field {
            Field::Double(x) => *x,
            Field::Float(x) => f64::from(*x),
            Field::Byte(n) => f64::from(*n),
            Field::Short(n) => f64::from(*n),
            Field::Int(n) => f64::from(*n),
            Field::Long(n) => *n as f64,
            Field::UByte(n) => f64::from(*n),
            Field::UShort(n) => f64::from(*n),
            Field::UInt(n) => f64::from(*n),
            Field::ULong(n) => *n as f64,
            _ => return None,
        };
        let value = number * self.factor;
        value.is_finite().then_some(Value::Number(value))
    }
}

/// First bytes of a Parquet file.
const PARQUET: &[u8] = b"PAR1";

/// The samples of a Parquet file, read by groups of rows.
fn of_parquet(binder: &mut Binder, file: &str, bytes: Vec<u8>, parameters: &mut Vec<Parameter>) -> Rows {
    let reader = match unbroken(|| SerializedFileReader::new(Bytes::from(bytes))).flatten() {
        Ok(reader) => reader,
        Err(error) => {
            binder.error("design.file", format!("`{file}` cannot be read: {error}"), "a Parquet file", None);
            return Rows::default();
        }
    };
    let schema = reader.metadata().file_metadata().schema();
    let names: Vec<&str> = schema.get_fields().iter().map(|field| field.name()).collect();
    // a line for each column, so that messages can point at it
    let mut sources = Sources::new();
    let id = sources.add_named(format!("{file}, columns"), names.join("\n"));
    let spans: Vec<Span> = lines(&sources, id).collect();
    let start = sources.start_of(id);
    let mut headings = Reader { sources: &sources, separator: Separator::of(","), binder };
    if spans.len() != names.len() || names.is_empty() {
        headings.error(start, "a column without a name, or with one of several lines", "names of parameters or paths");
        return Rows::default();
    }
    let cells: Vec<Cell> = spans.iter().map(|span| Cell { text: sources.slice(*span).trim(), span: *span }).collect();
    let columns = headings.header(&cells, start, parameters);
    let mut rows = Rows::default();
    if headings.binder.problems.has_errors() {
        return rows;
    }
    let unread =
        |error: ParquetError| (start, format!("a row that cannot be read: {error}"), "a Parquet file".to_owned());
    let read = unbroken(|| {
        each_row(&reader, |fields| {
            let mut row = vec![Value::Base; parameters.len()];
            for ((column, field), span) in columns.iter().zip(fields).zip(&spans) {
                let Some(column) = column else { continue };
                row[column.parameter] = column.field(field).ok_or_else(|| {
                    let found = shortened(&field.to_string(), CELL);
                    (*span, format!("`{found}` in row {}", rows.len() + 1), column.expected())
                })?;
            }
            rows.push(row);
            match rows.len() as u64 > MOST_RUNS {
                true => Err((start, format!("more than {MOST_RUNS} rows"), format!("at most {MOST_RUNS}"))),
                false => Ok(()),
            }
        })
    });
    let found = read.flatten().unwrap_or_else(|error| Err(unread(error)));
    if let Err((span, found, expected)) = found {
        headings.error(span, found, expected);
    } else if rows.is_empty() {
        headings.error(start, "a table without samples", "one row per sample");
    }
    rows
}

/// What is wrong with a row: its column, what was found and what was expected.
type Misfit = (Span, String, String);

thread_local! {
    /// Whether a panic of this thread is caught and told of in other words.
    static IS_QUIET: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}

/// What a reader of Parquet gives; it panics on some damaged files, which is not printed.
fn unbroken<T>(read: impl FnOnce() -> T) -> Result<T, ParquetError> {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let print = panic::take_hook();
        panic::set_hook(Box::new(move |of| {
            if !IS_QUIET.get() {
                print(of)
            }
        }));
    });
    IS_QUIET.set(true);
    let read = catch_unwind(AssertUnwindSafe(read));
    IS_QUIET.set(false);
    read.map_err(|_| ParquetError::General("it is damaged".to_owned()))
}

/// Passes on the fields of each row, until one does not fit.
fn each_row(
    reader: &SerializedFileReader<Bytes>,
    mut see: impl FnMut(&[&Field]) -> Result<(), Misfit>,
) -> Result<Result<(), Misfit>, ParquetError> {
    for row in reader.get_row_iter(None)? {
        if let Err(misfit) = see(&row?.get_column_iter().map(|(_, field)| field).collect::<Vec<_>>()) {
            return Ok(Err(misfit));
        }
    }
    Ok(Ok(()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_of_the_reader_is_an_error_in_our_words_and_later_ones_are_told_again() {
        let rows: Vec<u8> = Vec::new();
        let found = unbroken(|| rows[rows.len()]).unwrap_err();
        assert!(found.to_string().ends_with("it is damaged"), "{found}");
        assert!(!IS_QUIET.get());
        assert_eq!(unbroken(|| 3).ok(), Some(3));
    }
}
