//! The samples of a CSV file: a line of names with units, then one line for each sample.

use super::{Binder, noun};
use crate::law::{Law, Value};
use crate::parameter::{Parameter, Target, si_unit};
use crate::section::ApplyChoice;
use crate::text::problem;
use occupant_core::problem::Severity;
use occupant_core::scenario::csv_text::{Cell, cells, lines, name_and_unit};
use occupant_core::scenario::diagnostic::Diagnostic;
use occupant_core::scenario::draft::text_of;
use occupant_core::scenario::kind::{KINDS, Kind, RATIO};
use occupant_core::scenario::place::Wanted;
use occupant_core::scenario::source::{Sources, Span};
use occupant_core::scenario::{Resolver, unit_expression};

/// How the cells of a column are read.
struct Column {
    parameter: usize,
    wanted: Wanted,
    kind: Option<&'static Kind>,
    factor: f64,
}

/// The samples of a file; columns that name no parameter name a path, which becomes one.
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
    let id = sources.add(file, text);
    let mut reader = Reader { sources: &sources, binder };
    let mut lines = lines(&sources, id);
    let Some(header) = lines.next() else {
        let start = sources.start_of(id);
        reader.error(start, "an empty table", "a line that names the columns");
        return Vec::new();
    };
    let columns = reader.header(header, parameters);
    let rows: Vec<Vec<Value>> = lines.filter_map(|line| reader.row(line, &columns, parameters.len())).collect();
    if rows.is_empty() && !reader.binder.problems.has_errors() {
        reader.error(header, "a table without samples", "a line for each sample");
    }
    rows
}

struct Reader<'s, 'b, 'a> {
    sources: &'s Sources,
    binder: &'b mut Binder<'a>,
}

impl Reader<'_, '_, '_> {
    fn error(&mut self, span: Span, found: impl Into<String>, expected: impl Into<String>) {
        self.error_with_hint(span, found, expected, None);
    }

    fn error_with_hint(
        &mut self,
        span: Span,
        found: impl Into<String>,
        expected: impl Into<String>,
        hint: Option<String>,
    ) {
        let problem = problem(Severity::Error, "", found, expected, hint);
        let diagnostic = Diagnostic::at(self.sources, span, problem);
        self.binder.problems.push(diagnostic);
    }

    fn header(&mut self, line: Span, parameters: &mut Vec<Parameter>) -> Vec<Option<Column>> {
        let mut columns: Vec<Option<Column>> = Vec::new();
        for cell in cells(self.sources, line) {
            let column = self.column(&cell, parameters);
            let taken = |c: &Column| columns.iter().flatten().any(|o| o.parameter == c.parameter);
            match column {
                Some(column) if taken(&column) => {
                    let found = format!("a second column for `{}`", name_and_unit(cell.text).0);
                    self.error(cell.span, found, "each column once");
                    columns.push(None);
                }
                column => columns.push(column),
            }
        }
        let cells = cells(self.sources, line);
        for parameter in parameters.iter() {
            if !cells.iter().any(|c| name_and_unit(c.text).0 == parameter.name) {
                let found = format!("no column `{}`", parameter.name);
                self.error(line, found, "a column for each parameter");
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
        let kind = match (&wanted, of.apply) {
            (_, ApplyChoice::Factor) | (Wanted::Number, _) => Some(&KINDS[RATIO]),
            (Wanted::Quantity(kind), _) => Some(*kind),
            _ => None,
        };
        let factor = self.factor(cell, name, unit, kind)?;
        Some(Column { parameter, wanted, kind, factor })
    }

    /// What may stand at the places of a parameter.
    fn wanted(&self, parameter: &Parameter) -> Option<Wanted> {
        let path = &parameter.targets.first()?.path;
        let places = self.binder.base?.places(path).ok()?;
        places.first().map(|p| p.wanted.clone())
    }

    /// A parameter for a column that is named after a path.
    fn of_path(&mut self, path: &str, span: Span) -> Option<Parameter> {
        let places = match self.binder.base?.places(path) {
            Ok(places) => places,
            Err(error) => {
                let expected = format!("the name of a parameter, or a path: {}", error.expected);
                self.error_with_hint(span, error.found, expected, error.hint);
                return None;
            }
        };
        let wanted = places.first().map(|p| p.wanted.clone())?;
        if let Some(other) = places.iter().find(|p| p.wanted != wanted) {
            let found = format!("`{}` is {}, others are not", other.path, noun(&other.wanted));
            self.error(span, found, "places of one kind");
            return None;
        }
        Some(Parameter {
            name: path.to_owned(),
            unit: match wanted {
                Wanted::Quantity(kind) => si_unit(kind),
                _ => "",
            },
            apply: ApplyChoice::Value,
            law: Law::Table,
            targets: places.iter().map(Target::of).collect(),
        })
    }

    /// SI units in one of the column's own.
    fn factor(&mut self, cell: &Cell, name: &str, unit: Option<&str>, kind: Option<&Kind>) -> Option<f64> {
        let plain = kind.is_none_or(|k| k.si.is_empty());
        match (unit.filter(|u| !u.is_empty()), kind) {
            (None, _) if plain => Some(1.0),
            (None, kind) => {
                let (noun, si) = kind.map_or(("", ""), |k| (k.noun, k.si));
                let expected = format!("the unit of {noun} in brackets, such as `{name}[{si}]`");
                self.error(cell.span, format!("column `{name}` without a unit"), expected);
                None
            }
            (Some(_), None) => {
                self.error(cell.span, format!("a unit for names, `{name}`"), "no unit");
                None
            }
            (Some(unit), Some(kind)) => match unit_expression::parse(unit, 0) {
                Ok(scale) if scale.dimension.serves_as(kind.dimension) => Some(scale.factor),
                Ok(_) => {
                    let found = format!("`{unit}` is not the unit of {}", kind.noun);
                    self.error(cell.span, found, format!("{}: {}", kind.noun, kind.example));
                    None
                }
                Err(error) => {
                    self.error_with_hint(cell.span, error.found, error.expected, error.hint);
                    None
                }
            },
        }
    }

    fn row(&mut self, line: Span, columns: &[Option<Column>], n: usize) -> Option<Vec<Value>> {
        let cells = cells(self.sources, line);
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
            let number = cell.text.parse::<f64>().ok().map(|x| x * column.factor);
            if let Some(x) = number.filter(|x| x.is_finite()) {
                return Some(Value::Number(x));
            }
            let found = match cell.text {
                "" => "an empty cell".to_owned(),
                text => format!("`{text}`"),
            };
            self.error(cell.span, found, "a number");
            return None;
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
                Wanted::Names(names) => occupant_core::scenario::check::one_of(names, '"'),
                wanted => noun(wanted).to_owned(),
            };
            self.error(cell.span, format!("`{}`", cell.text), expected);
        }
        value
    }
}
