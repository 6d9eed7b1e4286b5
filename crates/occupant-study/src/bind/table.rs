//! The samples of a CSV file: a line of names with units, then one line for each sample.

use super::Binder;
use super::law::kind_of;
use crate::law::{Law, Value};
use crate::parameter::{Parameter, Target, si_unit};
use crate::section::ApplyChoice;
use occupant_scenario::kind::Kind;
use occupant_scenario::{Diagnostic, Resolver, Wanted};
use placed_text::{Cell, Problem, Separator, Sources, Span, lines, name_and_unit, one_of, text_of};

/// Reading of the cells of a column.
struct Column {
    parameter: usize,
    wanted: Wanted,
    kind: Option<&'static Kind>,
    factor: f64,
}

/// The samples of a file. A heading that names no parameter is a path, which becomes a parameter.
pub(super) fn rows(
    binder: &mut Binder,
    file: &str,
    parameters: &mut Vec<Parameter>,
    resolver: Resolver,
) -> Vec<Vec<Value>> {
    let bytes = match resolver(file) {
        Ok(bytes) => bytes,
        Err(reason) => {
            let found = format!("`{file}` cannot be read: {reason}");
            binder.error("design.file", found, "a CSV file, its name relative to the study", None);
            return Vec::new();
        }
    };
    let text = match text_of(&bytes, file) {
        Ok(text) => text,
        Err(problems) => {
            binder.problems.extend(problems);
            return Vec::new();
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
        return Vec::new();
    };
    let columns = reader.header(header, parameters);
    let rows: Vec<Vec<Value>> = lines.filter_map(|line| reader.row(line, &columns, parameters.len())).collect();
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

    fn header(&mut self, line: Span, parameters: &mut Vec<Parameter>) -> Vec<Option<Column>> {
        let mut columns: Vec<Option<Column>> = Vec::new();
        for cell in self.separator.cells(self.sources, line) {
            let column = self.column(&cell, parameters);
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
        let cells = self.separator.cells(self.sources, line);
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
        let value = match (&column.wanted, cell.text) {
            (Wanted::Truth, "true") => Some(Value::Truth(true)),
            (Wanted::Truth, "false") => Some(Value::Truth(false)),
            (Wanted::Names(names), text) if names.contains(&text) => Some(Value::Text(text.into())),
            (Wanted::Text, text) if !text.is_empty() => Some(Value::Text(text.into())),
            _ => None,
        };
        if value.is_none() {
            let expected = match &column.wanted {
                Wanted::Names(names) => one_of(names, '"'),
                wanted => wanted.noun().to_owned(),
            };
            self.error(cell.span, format!("`{}`", cell.text), expected);
        }
        value
    }
}
