//! The zero offsets of sensors: their readings at rest, at the start of a record and optionally at its end.

use crate::vehicle::problem::PathProblem;

/// Samples at rest: those before the first index, and those from the second on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Baseline {
    first: usize,
    last: Option<usize>,
}

impl Baseline {
    /// The rests at the two ends of times that increase, s.
    ///
    /// # Errors
    /// Rests of fewer than two samples, or that take up the record.
    pub fn of(time_s: &[f64], start_s: f64, end_s: Option<f64>) -> Result<Self, PathProblem> {
        let refused = |which: &str, length_s: f64, count: usize| {
            let found = format!("the baseline{which} of {length_s} s has {count} samples");
            PathProblem::new(found, "at least 2, and fewer than the record has")
        };
        let (Some(begins_s), Some(ends_s)) = (time_s.first(), time_s.last()) else {
            return Err(refused("", start_s, 0));
        };
        let first = time_s.partition_point(|&t| t <= begins_s + start_s);
        if start_s.is_nan() || start_s <= 0.0 || first < 2 || first == time_s.len() {
            return Err(refused("", start_s, first));
        }
        let Some(end_s) = end_s else { return Ok(Baseline { first, last: None }) };
        let last = time_s.partition_point(|&t| t < ends_s - end_s);
        let count = time_s.len() - last;
        if end_s.is_nan() || end_s <= 0.0 || count < 2 || last < first {
            return Err(refused(" at the end", end_s, count));
        }
        Ok(Baseline { first, last: Some(last) })
    }

    /// Subtracts the zero errors of the samples at rest; samples at other times are unchanged.
    pub fn take(&self, time_s: &[f64], samples: &mut [f64], should_read: f64) {
        let count = time_s.len();
        if samples.len() != count || self.first > count || self.last.is_some_and(|last| last >= count) {
            return;
        }
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let (from_s, from) = (mean(&time_s[..self.first]), mean(&samples[..self.first]) - should_read);
        let slope = self
            .last
            .map_or(0.0, |last| (mean(&samples[last..]) - should_read - from) / (mean(&time_s[last..]) - from_s));
        for (sample, t_s) in samples.iter_mut().zip(time_s) {
            *sample -= from + slope * (t_s - from_s);
        }
    }
}
