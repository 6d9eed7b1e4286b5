//! Tables of force elements, one row per element of a kind, for a run's summary and for the diagnosis of its start.
//!
//! JSON, text tables, studies and reports use only the columns and name no kind.

use std::borrow::Borrow;
use std::ops::Index;

use occupant_units::unit::Unit;
use serde::{Serialize, Serializer};

/// Values under names, in the order in which they came; few, so that looking through them is quickest. In JSON an object.
#[derive(Clone, Debug, PartialEq)]
pub struct InOrder<K, V>(Vec<(K, V)>);

impl<K, V> Default for InOrder<K, V> {
    fn default() -> Self {
        InOrder(Vec::new())
    }
}

impl<K: Eq, V> InOrder<K, V> {
    /// Nothing.
    pub fn new() -> Self {
        InOrder::default()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
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

    /// The value under a name.
    pub fn get<Q: Eq + ?Sized>(&self, name: &Q) -> Option<&V>
    where
        K: Borrow<Q>,
    {
        self.0.iter().find(|(key, _)| key.borrow() == name).map(|(_, value)| value)
    }

    /// Puts a value under a name, in place of one that is there.
    pub fn insert(&mut self, name: K, value: V) {
        match self.0.iter_mut().find(|(key, _)| *key == name) {
            Some((_, own)) => *own = value,
            None => self.0.push((name, value)),
        }
    }

    /// The value under a name, to be changed; a blank one if there is none.
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

/// Tables of several kinds, by what their elements are called.
pub type Tables = InOrder<&'static str, Table>;

/// A row: the name of an element under what one is called, then what stands in each column under its key.
pub(crate) type Row = InOrder<&'static str, Cell>;

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
    /// A number; none if there is none, such as the time of a peak that was not reached.
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
