//! Rank correlation and standardised regression.

use nalgebra::{DMatrix, DVector};

use super::{AnalysisError, Estimate, at_rows, bootstrap, complete_rows, deviation, mean};
use occupant_units::trig;

/// Spearman's rank correlation of a parameter and a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RankCorrelation {
    /// ρ, with the interval of Fisher's z at a variance of (1 + ρ²/2)/(n − 3): D. G. Bonett, T. A. Wright, Psychometrika 65
    /// (2000).
    pub rho: Estimate,
    /// Complete rows.
    pub rows: usize,
}

/// Linear model of a figure in the parameters, all divided by their standard deviations.
#[derive(Clone, Debug, PartialEq)]
pub struct Regression {
    /// Standardised coefficients, by parameter: standard deviations of the figure for one of the parameter.
    pub coefficients: Vec<Estimate>,
    /// R²: the part of the variance that the linear model explains. The coefficients mean little where it is below about 0.7.
    pub explained: f64,
    /// Complete rows.
    pub rows: usize,
}

/// Ranks from 1, ties at their mean rank.
pub fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
    let mut ranks = vec![0.0; values.len()];
    let mut start = 0;
    while start < order.len() {
        let tied = order[start..].iter().take_while(|&&i| values[i] == values[order[start]]).count().max(1);
        // ranks start + 1 to start + tied
        let rank = start as f64 + 0.5 * (tied as f64 + 1.0);
        for &i in &order[start..start + tied] {
            ranks[i] = rank;
        }
        start += tied;
    }
    ranks
}

/// Rank correlation of a parameter's values and a figure.
///
/// # Errors
/// Columns of different length, fewer than 5 complete rows, a column that is the same everywhere.
pub fn rank_correlation(parameter: &[f64], figure: &[f64]) -> Result<RankCorrelation, AnalysisError> {
    let rows = complete_rows([parameter, figure].into_iter(), 5)?;
    let [x, y] = [parameter, figure].map(|column| ranks(&at_rows(column, &rows)));
    let x = standardised(&x).ok_or(AnalysisError::Constant { parameter: Some(0) })?;
    let y = standardised(&y).ok_or(AnalysisError::Constant { parameter: None })?;
    let n = rows.len() as f64;
    let rho = x.iter().zip(&y).map(|(x, y)| x * y).sum::<f64>() / (n - 1.0);
    let rho = rho.clamp(-1.0, 1.0);
    let half = 1.959_964 * ((1.0 + 0.5 * rho * rho) / (n - 3.0)).sqrt();
    let z = 0.5 * trig::ln((1.0 + rho) / (1.0 - rho));
    let end = |z: f64| if z.is_infinite() { z.signum() } else { tanh(z) };
    Ok(RankCorrelation { rho: Estimate { value: rho, low: end(z - half), high: end(z + half) }, rows: rows.len() })
}

/// Standardised regression of a figure on all parameters at once.
///
/// # Errors
/// Columns of different length, fewer complete rows than twice the parameters and five, a column that is the same everywhere,
/// parameters that depend on one another.
pub fn regression(parameters: &[Vec<f64>], figure: &[f64], seed: u64) -> Result<Regression, AnalysisError> {
    let columns = parameters.iter().map(Vec::as_slice).chain([figure]);
    let rows = complete_rows(columns, 2 * parameters.len() + 5)?;
    let mut x = Vec::with_capacity(parameters.len());
    for (i, values) in parameters.iter().enumerate() {
        x.push(standardised(&at_rows(values, &rows)).ok_or(AnalysisError::Constant { parameter: Some(i) })?);
    }
    let y = standardised(&at_rows(figure, &rows)).ok_or(AnalysisError::Constant { parameter: None })?;
    let every: Vec<usize> = (0..rows.len()).collect();
    let fitted = least_squares(&x, &y, &every).ok_or(AnalysisError::Dependent)?;
    let error: f64 =
        every.iter().map(|&r| (y[r] - (0..x.len()).map(|i| fitted[i] * x[i][r]).sum::<f64>()).powi(2)).sum();
    let nothing = vec![f64::NAN; x.len()];
    // a resample has standard deviations of its own: what the figure owes to its largest values goes with them
    let of = |rows: &[usize]| {
        let drawn = |column: &[f64]| deviation(&at_rows(column, rows));
        let found = least_squares(&x, &y, rows).unwrap_or_else(|| nothing.clone());
        let of_figure = drawn(&y);
        found.iter().zip(&x).map(|(slope, x)| slope * drawn(x) / of_figure).collect()
    };
    Ok(Regression {
        coefficients: bootstrap::intervals(seed, rows.len(), x.len(), of),
        explained: 1.0 - error / (rows.len() - 1) as f64,
        rows: rows.len(),
    })
}

/// Values minus their mean, divided by their standard deviation; none for a constant column.
fn standardised(values: &[f64]) -> Option<Vec<f64>> {
    let (middle, deviation) = (mean(values), deviation(values));
    if deviation.is_nan() || deviation <= 1e-12 * middle.abs() || deviation == 0.0 {
        return None;
    }
    Some(values.iter().map(|v| (v - middle) / deviation).collect())
}

/// Least-squares coefficients of y on the columns x and a constant, over some rows; none if the columns are linearly
/// dependent there.
fn least_squares(x: &[Vec<f64>], y: &[f64], rows: &[usize]) -> Option<Vec<f64>> {
    let k = x.len();
    let entry = |r: usize, c: usize| if c == k { 1.0 } else { x[c][rows[r]] };
    let matrix = DMatrix::from_fn(rows.len(), k + 1, entry);
    let right = DVector::from_fn(rows.len(), |r, _| y[rows[r]]);
    let normal = matrix.tr_mul(&matrix);
    let solved = normal.clone().cholesky()?.solve(&matrix.tr_mul(&right));
    // a pivot lost in rounding means dependent columns
    let pivots = normal.cholesky()?.l().diagonal();
    let singular = pivots.min() < 1e-7 * pivots.max();
    (!singular).then(|| solved.iter().take(k).copied().collect())
}

fn tanh(z: f64) -> f64 {
    let e = trig::exp(-2.0 * z.abs());
    z.signum() * (1.0 - e) / (1.0 + e)
}
