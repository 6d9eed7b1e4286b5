//! The maximum so far and its time.

/// Maximum so far and its time; the first of equal values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// Largest value; minus infinity before the first.
    pub value: f64,
    /// Its time.
    pub time_s: f64,
}

impl Peak {
    /// No value yet.
    pub(crate) const NONE: Peak = Peak { value: f64::NEG_INFINITY, time_s: f64::NAN };

    /// Takes a value; true if it is the largest so far.
    pub(crate) fn see(&mut self, value: f64, time_s: f64) -> bool {
        let greater = value > self.value;
        if greater {
            *self = Peak { value, time_s };
        }
        greater
    }
}
