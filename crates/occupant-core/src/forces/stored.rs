//! Conversion of a run's memory to and from a result file, defined once for both directions.

use crate::quantity::{FieldWords, Value};

/// Message of a result file that is written or read field by field.
pub trait Archive {
    /// Writes `value`, or replaces it by the stored one, if there is one.
    fn exchange(&mut self, words: FieldWords, value: &mut Value);

    /// Following fields belong to the start of the step that leads beyond the output.
    fn begin_step(&mut self) {}

    /// Reports that the stored values are invalid, as text.
    fn refuse(&mut self, _why: &str) {}
}

impl dyn Archive + '_ {
    /// Reads or writes a number.
    pub(crate) fn number(&mut self, words: FieldWords, number: &mut f64) {
        let mut value = Value::Number(*number);
        self.exchange(words, &mut value);
        if let Value::Number(stored) = value {
            *number = stored;
        }
    }

    /// Reads or writes a whole number.
    pub(crate) fn count(&mut self, words: FieldWords, count: &mut u64) {
        let mut value = Value::Count(*count);
        self.exchange(words, &mut value);
        if let Value::Count(stored) = value {
            *count = stored;
        }
    }

    /// Reads or writes a list of numbers.
    pub(crate) fn numbers(&mut self, words: FieldWords, list: Vec<f64>) -> Vec<f64> {
        let mut value = Value::Numbers(list);
        self.exchange(words, &mut value);
        if let Value::Numbers(stored) = value { stored } else { Vec::new() }
    }

    /// Reads or writes a long list of numbers in single precision.
    pub(crate) fn singles(&mut self, words: FieldWords, list: Vec<f32>) -> Vec<f32> {
        let mut value = Value::Singles(list);
        self.exchange(words, &mut value);
        if let Value::Singles(stored) = value { stored } else { Vec::new() }
    }

    /// Reads or writes a list of indices.
    pub(crate) fn indices(&mut self, words: FieldWords, list: Vec<u32>) -> Vec<u32> {
        let mut value = Value::Indices(list);
        self.exchange(words, &mut value);
        if let Value::Indices(stored) = value { stored } else { Vec::new() }
    }
}
