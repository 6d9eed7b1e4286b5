//! Tables of force elements, one row per element of a kind, for a run's summary and for the diagnosis of its start.
//!
//! JSON, text tables, studies and reports use only the columns and name no kind.

use std::borrow::Borrow;
use std::ops::Index;

use occupant_units::unit::Unit;
use serde::{Serialize, Serializer};

/// Values by name, in order of insertion; few, so linear search is fastest. In JSON: an object.
#[derive(Clone, Debug, PartialEq)]
pub struct InOrder<K, V>(Vec<(K, V)>);

impl<K, V> Default for InOrder<K, V> {
    fn default() -> Self {
        InOrder(Vec::new())
    }
}

impl<K: Eq, V> InOrder<K, V> {
    /// An empty table.
    pub fn new() -> Self {
        InOrder::default()
    }

    /// Number of entries.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are no entries.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Names with their values.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&K, &V)> {
        self.0.iter().map(|(key, value)| (key, value))
    }

    /// Names.
    pub fn keys(&self) -> impl ExactSizeIterator<Item = &K> {
        self.0.iter().map(|(key, _)| key)
    }

    /// Values.
    pub fn values(&self) -> impl ExactSizeIterator<Item = &V> {
        self.0.iter().map(|(_, value)| value)
    }

    /// Value under a name.
    pub fn get<Q: Eq + ?Sized>(&self, name: &Q) -> Option<&V>
    where
        K: Borrow<Q>,
    {
        self.0.iter().find(|(key, _)| key.borrow() == name).map(|(_, value)| value)
    }

    /// Inserts or replaces the value under a name.
    pub fn insert(&mut self, name: K, value: V) {
        match self.0.iter_mut().find(|(key, _)| *key == name) {
            Some((_, own)) => *own = value,
            None => self.0.push((name, value)),
        }
    }

    /// Mutable value under a name, inserted with its default if absent.
    pub fn or_default(&mut self, name: K) -> &mut V
    where
        V: Default,
    {
        let place = self.0.iter().position(|(key, _)| *key == name).unwrap_or(self.0.len());
        if place == self.0.len() {
            self.0.push((name, V::default()));
        }
        &mut self.0[place].1
    }
}

impl<K: Eq, V> Extend<(K, V)> for InOrder<K, V> {
    fn extend<I: IntoIterator<Item = (K, V)>>(&mut self, more: I) {
        more.into_iter().for_each(|(name, value)| self.insert(name, value));
    }
}

impl<K: Eq, V> FromIterator<(K, V)> for InOrder<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(all: I) -> Self {
        let mut list = InOrder::default();
        list.extend(all);
        list
    }
}

impl<K, V> IntoIterator for InOrder<K, V> {
    type Item = (K, V);
    type IntoIter = std::vec::IntoIter<(K, V)>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a, K, V> IntoIterator for &'a InOrder<K, V> {
    type Item = (&'a K, &'a V);
    type IntoIter = std::iter::Map<std::slice::Iter<'a, (K, V)>, fn(&'a (K, V)) -> (&'a K, &'a V)>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter().map(|(key, value)| (key, value))
    }
}

impl<K: Borrow<Q>, V, Q: Eq + ?Sized> Index<&Q> for InOrder<K, V> {
    type Output = V;

    /// # Panics
    /// A name that is not there, as of any map: [`InOrder::get`] asks.
    fn index(&self, name: &Q) -> &V {
        let found = self.0.iter().find(|(key, _)| key.borrow() == name);
        &found.expect("a name that is there").1
    }
}

impl<K: Serialize, V: Serialize> Serialize for InOrder<K, V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self)
    }
}

/// Tables of several kinds, by the name of their elements.
pub type Tables = InOrder<&'static str, Table>;

/// Row: the name of an element under the name of its kind, then the cells under the keys of their columns.
pub(crate) type Row = InOrder<&'static str, Cell>;

/// Table of the elements of one kind. In JSON: an array of its rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Table {
    /// Columns; the first holds the names of the elements.
    #[serde(skip)]
    pub columns: Vec<Column>,
    /// Rows, in the scenario's order.
    pub rows: Vec<Row>,
}

/// Cell of a table.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// Text.
    Text(String),
    /// Number; none without a value, such as the time of a peak that was not reached.
    Number(Option<f64>),
}

/// A column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Key in JSON, with its unit.
    pub key: &'static str,
    /// Printed heading: quantity and printed unit.
    pub heading: &'static str,
    /// Printed number divided by that of JSON.
    pub scale: f64,
    /// Printed decimals.
    pub decimals: usize,
    /// Content.
    pub holds: Holds,
    /// Suffix of its name among the measures of a run, and its unit there.
    pub measure: Option<(&'static str, Unit)>,
}

/// Content of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// Text.
    Text,
    /// Numbers.
    Number,
    /// Time of the peak in the column before, s.
    Time,
}

impl Column {
    /// Column of text.
    pub(crate) const fn text(key: &'static str, heading: &'static str) -> Self {
        Column { holds: Holds::Text, ..Column::number(key, heading, 0) }
    }

    /// Column of numbers, printed in the unit of JSON.
    pub(crate) const fn number(key: &'static str, heading: &'static str, decimals: usize) -> Self {
        Column { key, heading, scale: 1.0, decimals, holds: Holds::Number, measure: None }
    }

    /// Column of the time of the peak in the column before.
    pub(crate) const fn time(key: &'static str) -> Self {
        Column { scale: 1e3, holds: Holds::Time, ..Column::number(key, "at, ms", 1) }
    }

    /// Column that is also a measure of a run.
    pub(crate) const fn measure(self, name: &'static str, unit: Unit) -> Self {
        Column { measure: Some((name, unit)), ..self }
    }
}

impl Table {
    /// Table of elements of kind `of`, with a row of cells for each name.
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

    /// Number under `key` of the element `name`.
    pub fn number(&self, name: &str, key: &str) -> Option<f64> {
        let row = self.rows.iter().find(|row| row.values().next().and_then(Cell::text) == Some(name));
        row?.get(key)?.number()
    }
}

impl Cell {
    /// Text of the cell.
    pub fn text(&self) -> Option<&str> {
        if let Cell::Text(text) = self { Some(text) } else { None }
    }

    /// Number of the cell.
    pub fn number(&self) -> Option<f64> {
        if let Cell::Number(number) = self { *number } else { None }
    }
}
