//! Samples of a table, by column: 8 bytes a value.

use indexmap::IndexMap;

use crate::law::Value;

/// The samples of a table, one value for each parameter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    len: usize,
    columns: Vec<Column>,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Column {
    /// Numbers, or the places of words; NaN for the value of the base.
    values: Vec<f64>,
    /// Its words by their texts; none in a column of numbers.
    words: IndexMap<String, Value>,
}

impl Rows {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The values of a sample; none beyond the last.
    pub fn row(&self, index: usize) -> Option<Vec<Value>> {
        (index < self.len).then(|| self.columns.iter().map(|column| column.value(index)).collect())
    }

    /// Whether a parameter has words.
    pub fn has_words(&self, parameter: usize) -> bool {
        self.columns.get(parameter).is_some_and(|column| !column.words.is_empty())
    }

    /// Whether a parameter has the value of the base in some samples.
    pub(crate) fn has_gaps(&self, parameter: usize) -> bool {
        self.columns.get(parameter).is_some_and(|column| column.values.iter().any(|x| x.is_nan()))
    }

    /// Adds a sample. All values of a parameter are numbers, or all are words.
    pub(crate) fn push(&mut self, row: Vec<Value>) {
        self.columns.resize_with(row.len(), Column::default);
        self.columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        self.len += 1;
    }
}

impl Column {
    fn push(&mut self, value: Value) {
        let text = match &value {
            Value::Number(x) => return self.values.push(*x),
            Value::Base => return self.values.push(f64::NAN),
            Value::Text(text) => text.clone(),
            Value::Truth(truth) => truth.to_string(),
        };
        let place = self.words.get_index_of(&text).unwrap_or_else(|| self.words.insert_full(text, value).0);
        self.values.push(place as f64);
    }

    fn value(&self, index: usize) -> Value {
        match self.values[index] {
            x if x.is_nan() => Value::Base,
            x if self.words.is_empty() => Value::Number(x),
            place => self.words[place as usize].clone(),
        }
    }
}
