//! Tables of force elements, a row for each element of a kind: what a run's summary and a start's diagnosis give for them.
//!
//! JSON, text tables, studies and reports are made from the columns alone and name no kind.

use indexmap::IndexMap;
use occupant_units::unit::Unit;
use serde::Serialize;

/// Tables of several kinds, by what their elements are called.
pub type Tables = IndexMap<&'static str, Table>;

/// A row: the name of an element under what one is called, then what stands in each column under its key.
pub(crate) type Row = IndexMap<&'static str, Cell>;

/// A table of the elements of one kind. In JSON it is its rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Table {
    /// Columns; the first holds the names of the elements.
    #[serde(skip)]
    pub columns: Vec<Column>,
    /// Rows, in the scenario's order.
    pub rows: Vec<Row>,
}

/// What stands in one column of one row.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number; none where there is none, such as the time of a peak that was not reached.
    Number(Option<f64>),
}

/// A column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Key in JSON, with its unit.
    pub key: &'static str,
    /// What stands over it in print: what it is and its unit there.
    pub heading: &'static str,
    /// Printed number over that of JSON.
    pub scale: f64,
    /// Decimals in print.
    pub decimals: usize,
    /// What it holds.
    pub holds: Holds,
    /// The end of its name among the measures of a run, and its unit there.
    pub measure: Option<(&'static str, Unit)>,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// Words.
    Text,
    /// Numbers.
    Number,
    /// When the peak of the column before was reached, s.
    Time,
}

impl Column {
    /// Words.
    pub(crate) const fn text(key: &'static str, heading: &'static str) -> Self {
        Column { holds: Holds::Text, ..Column::number(key, heading, 0) }
    }

    /// Numbers, printed in the unit of JSON.
    pub(crate) const fn number(key: &'static str, heading: &'static str, decimals: usize) -> Self {
        Column { key, heading, scale: 1.0, decimals, holds: Holds::Number, measure: None }
    }

    /// When the peak of the column before was reached.
    pub(crate) const fn time(key: &'static str) -> Self {
        Column { scale: 1e3, holds: Holds::Time, ..Column::number(key, "at, ms", 1) }
    }

    /// Also a measure of a run.
    pub(crate) const fn measure(self, name: &'static str, unit: Unit) -> Self {
        Column { measure: Some((name, unit)), ..self }
    }
}

impl Table {
    /// A table of elements of which one is called `of`, with a row of cells for each name.
    pub(crate) fn new(
        of: &'static str,
        columns: &[Column],
        rows: impl IntoIterator<Item = (String, Vec<Cell>)>,
    ) -> Self {
        let columns = [&[Column::text(of, of)], columns].concat();
        let row = |(name, cells)| {
            let cells = [Cell::Text(name)].into_iter().chain(cells);
            columns.iter().map(|column| column.key).zip(cells).collect()
        };
        Table { rows: rows.into_iter().map(row).collect(), columns }
    }

    /// The number under `key` of the element `name`.
    pub fn number(&self, name: &str, key: &str) -> Option<f64> {
        let row = self.rows.iter().find(|row| row.values().next().and_then(Cell::text) == Some(name));
        row?.get(key)?.number()
    }
}

impl Cell {
    /// Its words.
    pub fn text(&self) -> Option<&str> {
        if let Cell::Text(text) = self { Some(text) } else { None }
    }

    /// Its number.
    pub fn number(&self) -> Option<f64> {
        if let Cell::Number(number) = self { *number } else { None }
    }
}
