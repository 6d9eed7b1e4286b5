//! Signals in one table, at the times of the one with most samples.

use std::io;

use crash_measures::signal::{Interpolant, Interpolation};

use crate::base::Failure;
use occupant_files::signals::Signal;
use occupant_files::table::{Cell, Form, Kind, Table};

/// The table as CSV: a column of times, and one for each signal with its unit in its heading.
///
/// # Errors
/// An error of the writer.
pub(super) fn table(signals: &[&Signal]) -> Result<Vec<u8>, Failure> {
    let time_s = signals.iter().max_by_key(|signal| signal.time_s.len()).map_or(&[][..], |signal| &signal.time_s);
    let columns: Vec<(String, Vec<f64>)> = signals.iter().map(|s| (heading(&s.name, s), at(s, time_s))).collect();
    written(time_s, &columns).map_err(|error| Failure::plain(format!("the table cannot be made: {error}")))
}

/// The table of these columns.
///
/// # Errors
/// An error of the writer.
pub(super) fn written(time_s: &[f64], columns: &[(String, Vec<f64>)]) -> io::Result<Vec<u8>> {
    let mut heads = vec![("t[s]".to_owned(), Kind::Number)];
    heads.extend(columns.iter().map(|(name, _)| (name.clone(), Kind::MaybeNumber)));
    let mut table = Table::new(Vec::new(), Form::Csv, &heads, &[])?;
    for (i, t) in time_s.iter().enumerate() {
        // 0 and not −0
        let values = columns.iter().map(|(_, values)| Cell::finite(values[i] + 0.0));
        table.row(std::iter::once(Cell::Number(*t)).chain(values).collect())?;
    }
    table.finish()
}

/// A name and the signal's unit.
pub(super) fn heading(name: &str, signal: &Signal) -> String {
    signal.unit.as_ref().map_or_else(|| name.to_owned(), |unit| format!("{name}[{unit}]"))
}

/// The values at other times, by straight lines; NaN where the signal has none.
pub(super) fn at(signal: &Signal, time_s: &[f64]) -> Vec<f64> {
    if signal.time_s == time_s {
        return signal.values.clone();
    }
    let known = signal.time_s.iter().zip(&signal.values).filter(|(_, value)| !value.is_nan());
    let (times, values): (Vec<f64>, Vec<f64>) = known.unzip();
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return vec![f64::NAN; time_s.len()] };
    let line = Interpolant::new(&times, &values, Interpolation::Linear);
    let is_in = |t: f64| (*first..=*last).contains(&t);
    let value = |t: &f64| line.as_ref().ok().filter(|_| is_in(*t)).map_or(f64::NAN, |line| line.value_at(*t));
    time_s.iter().map(value).collect()
}
