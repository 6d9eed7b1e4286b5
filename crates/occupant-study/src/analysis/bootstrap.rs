//! Intervals by resampling rows.

use super::Estimate;
use crate::random::{Purpose, bits};
use crate::spread::quantile;

/// Number of bootstrap resamples; the ends of a 95 % interval are the 25th and 976th of them.
pub const RESAMPLES: u64 = 1000;

/// Row numbers of resample `number` of `rows` rows, drawn with replacement. The bias of the remainder is below rows/2⁶⁴.
pub fn resample(seed: u64, number: u64, rows: usize, into: &mut Vec<usize>) {
    into.clear();
    let draw = |i: usize| bits(seed, Purpose::Bootstrap, number, i as u32, 0) % rows as u64;
    into.extend((0..rows).map(|i| draw(i) as usize));
}

/// The 95 % bootstrap intervals of several statistics; `of` computes them from row numbers.
pub fn intervals(seed: u64, rows: usize, count: usize, of: impl Fn(&[usize]) -> Vec<f64>) -> Vec<Estimate> {
    let all: Vec<usize> = (0..rows).collect();
    let values = of(&all);
    let mut drawn: Vec<Vec<f64>> = vec![Vec::with_capacity(RESAMPLES as usize); count];
    let mut chosen = Vec::with_capacity(rows);
    for number in 0..RESAMPLES {
        resample(seed, number, rows, &mut chosen);
        for (column, value) in drawn.iter_mut().zip(of(&chosen)) {
            if value.is_finite() {
                column.push(value);
            }
        }
    }
    let interval = |(value, drawn): (f64, Vec<f64>)| Estimate {
        value,
        low: quantile(&drawn, 0.025).unwrap_or(f64::NAN),
        high: quantile(&drawn, 0.975).unwrap_or(f64::NAN),
    };
    values.into_iter().zip(drawn).map(interval).collect()
}
