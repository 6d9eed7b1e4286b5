//! Analysis of a finished study: which parameters matter, how much, and how certain this is.
//!
//! All functions take plain slices with one number per run, NaN if a run has no such figure. They drop incomplete rows
//! and count them. Intervals are 95 % and by bootstrap unless said otherwise; the random numbers of a bootstrap follow
//! from its seed.

mod bootstrap;
mod indices;
mod regression;
mod screening;
mod sums;

use thiserror::Error;

pub use indices::{SobolIndices, SobolPoint, SobolSums, sobol_indices};
pub use regression::{RankCorrelation, Regression, RegressionSums, rank_correlation, ranks, regression};
pub use screening::{Effect, EffectSums, screening};
pub use sums::Grouping;

/// A number with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// 2.5 % of the resamples lie below.
    pub low: f64,
    /// 2.5 % of the resamples lie above.
    pub high: f64,
}

impl Estimate {
    /// Whether zero lies outside the interval: the sign is known.
    pub fn is_clear(&self) -> bool {
        self.low > 0.0 || self.high < 0.0
    }

    /// Width of the interval.
    pub fn width(&self) -> f64 {
        self.high - self.low
    }
}

/// Reason why an analysis is impossible.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AnalysisError {
    /// Columns of different length.
    #[error("a column of {found} rows next to one of {expected}")]
    Length {
        /// Rows found.
        found: usize,
        /// Rows of the first column.
        expected: usize,
    },
    /// Too few complete rows for the analysis.
    #[error("{found} complete rows; at least {needed} are needed")]
    TooFew {
        /// Complete rows.
        found: usize,
        /// Rows needed.
        needed: usize,
    },
    /// The figure, or a parameter, is the same in all rows.
    #[error("{} is the same in all rows", parameter.map_or("the figure".to_owned(), |i| format!("parameter {}", i + 1)))]
    Constant {
        /// Index of the parameter; none for the figure.
        parameter: Option<usize>,
    },
    /// Parameters that depend on one another, so that their effects cannot be separated.
    #[error("parameters that depend on one another cannot be separated")]
    Dependent,
}

/// Rows in which every column is finite; an error below the least number.
fn complete_rows<'a>(
    columns: impl Iterator<Item = &'a [f64]> + Clone,
    needed: usize,
) -> Result<Vec<usize>, AnalysisError> {
    let expected = columns.clone().next().map_or(0, <[f64]>::len);
    if let Some(odd) = columns.clone().find(|c| c.len() != expected) {
        let found = odd.len();
        return Err(AnalysisError::Length { found, expected });
    }
    let complete = |row: &usize| columns.clone().all(|c| c[*row].is_finite());
    let rows: Vec<usize> = (0..expected).filter(complete).collect();
    if rows.len() >= needed { Ok(rows) } else { Err(AnalysisError::TooFew { found: rows.len(), needed }) }
}

/// Values of a column at some rows.
fn at_rows(column: &[f64], rows: &[usize]) -> Vec<f64> {
    rows.iter().map(|&row| column[row]).collect()
}

/// Standard deviation of a sample.
fn deviation(values: &[f64]) -> f64 {
    let middle = mean(values);
    let squares: f64 = values.iter().map(|v| (v - middle).powi(2)).sum();
    (squares / (values.len() - 1) as f64).sqrt()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests;
