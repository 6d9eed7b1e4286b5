//! Problems of a vehicle path.

use std::fmt::Display;

/// Problem of a vehicle path, with the value found and the value expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{found}, expected {expected}")]
pub struct PathProblem {
    /// Station, sample or point of a tabulated pulse, from 0; messages count from 1.
    pub station: Option<usize>,
    /// Value found.
    pub found: String,
    /// Value expected, and the remedy.
    pub expected: String,
}

impl PathProblem {
    /// Problem of the path as a whole.
    pub(super) fn new(found: impl Into<String>, expected: impl Into<String>) -> Self {
        PathProblem { station: None, found: found.into(), expected: expected.into() }
    }

    /// Problem of one station.
    pub(super) fn at(station: usize, found: impl Display, expected: impl Into<String>) -> Self {
        PathProblem {
            station: Some(station),
            ..PathProblem::new(format!("station {}: {found}", station + 1), expected)
        }
    }

    /// Invalid value of a quantity.
    pub(super) fn of_value(quantity: &str, value: f64, expected: &str) -> Self {
        PathProblem::new(format!("found {quantity} = {value}"), expected)
    }

    /// Number that is infinite or NaN.
    pub(super) fn not_finite(quantity: &str, value: f64) -> Self {
        PathProblem::of_value(quantity, value, FINITE)
    }

    /// Table, record or tabulated pulse of fewer than two stations.
    pub(super) fn too_few_stations(count: usize) -> Self {
        PathProblem::new(format!("found {count} stations"), "at least 2")
    }

    /// Number at a station that is infinite or NaN.
    pub(super) fn not_finite_at(station: usize, quantity: &str, value: f64) -> Self {
        PathProblem::at(station, format_args!("found {quantity} = {value}"), FINITE)
    }
}

const FINITE: &str = "a finite number";

/// Adds a problem to `problems` unless `value` is finite.
pub(super) fn expect_finite(problems: &mut Vec<PathProblem>, quantity: &'static str, value: f64) {
    if !value.is_finite() {
        problems.push(PathProblem::not_finite(quantity, value));
    }
}

/// Adds the problems of row `station` of numbers over time: numbers that are not finite or beyond `largest` in
/// magnitude, and a time that is not after that of the row before.
pub(super) fn check_row(
    problems: &mut Vec<PathProblem>,
    station: usize,
    time_s: f64,
    previous_s: Option<f64>,
    numbers: impl IntoIterator<Item = (&'static str, f64)>,
    largest: f64,
) {
    let all = std::iter::once(("t", time_s)).chain(numbers);
    problems.extend(all.filter_map(|(quantity, value)| match value {
        _ if !value.is_finite() => Some(PathProblem::not_finite_at(station, quantity, value)),
        _ if value.abs() > largest => {
            let found = format_args!("found {quantity} = {value}");
            Some(PathProblem::at(station, found, format!("at most {largest:e}")))
        }
        _ => None,
    }));
    if let Some(previous_s) = previous_s.filter(|previous_s| time_s <= *previous_s) {
        let expected = format!("a time after that of the station before ({previous_s} s)");
        problems.push(PathProblem::at(station, format_args!("found t = {time_s} s"), expected));
    }
}
