//! Rank correlation and standardised regression.

use nalgebra::{DMatrix, DVector};

use super::sums::{Grouping, Sums};
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

/// Normal equations of a regression over a stream of rows, exact for all of them, in memory that does not grow with them.
#[derive(Clone, Debug)]
pub struct RegressionSums {
    parameters: usize,
    /// Count, Σz, and the lower triangle of Σzzᵀ by rows, with z the parameters and the figure from those of the first row.
    sums: Sums,
    origin: Vec<f64>,
    /// The present z.
    row: Vec<f64>,
    rows: usize,
}

impl RegressionSums {
    /// No rows yet, of so many parameters; the rows are divided by the seed.
    pub fn new(parameters: usize, seed: u64) -> Self {
        let n = parameters + 1;
        let sums = Sums::new(1 + n + n * (n + 1) / 2, Grouping::Groups(seed));
        RegressionSums { parameters, sums, origin: Vec::new(), row: Vec::new(), rows: 0 }
    }

    /// Adds the row with this index; one with a value that is not finite is left out.
    pub fn see(&mut self, index: u64, parameters: impl Iterator<Item = f64>, figure: f64) {
        self.row.clear();
        self.row.extend(parameters.take(self.parameters).chain([figure]));
        if self.row.len() != self.parameters + 1 || self.row.iter().any(|x| !x.is_finite()) {
            return;
        }
        if self.rows == 0 {
            self.origin.clone_from(&self.row);
        }
        self.rows += 1;
        self.row.iter_mut().zip(&self.origin).for_each(|(z, origin)| *z -= origin);
        let sums = self.sums.of_row(index);
        sums[0] += 1.0;
        let (linear, mut products) = sums[1..].split_at_mut(self.row.len());
        for (i, (sum, z)) in linear.iter_mut().zip(&self.row).enumerate() {
            *sum += z;
            let (own, rest) = products.split_at_mut(i + 1);
            own.iter_mut().zip(&self.row).for_each(|(sum, other)| *sum += z * other);
            products = rest;
        }
    }

    /// The parameters that vary, by their numbers, and the regression on them.
    ///
    /// # Errors
    /// As of [`regression`]; no parameter that varies is [`AnalysisError::Constant`].
    pub fn regression(&self, seed: u64) -> Result<(Vec<usize>, Regression), AnalysisError> {
        let k = self.parameters;
        let total = self.sums.total();
        let varies = |i: &usize| {
            let mean = total[1 + i] / total[0];
            let deviation = (self.covariance(&total, *i, *i) / (total[0] - 1.0)).sqrt();
            deviation > 1e-12 * (mean + self.origin[*i]).abs()
        };
        let needed = |parameters: usize| AnalysisError::TooFew { found: self.rows, needed: 2 * parameters + 5 };
        if self.rows < 5 {
            return Err(needed(k));
        }
        let which: Vec<usize> = (0..k).filter(varies).collect();
        match (which.len(), varies(&k)) {
            (0, _) => return Err(AnalysisError::Constant { parameter: Some(0) }),
            (_, false) => return Err(AnalysisError::Constant { parameter: None }),
            (n, _) if self.rows < 2 * n + 5 => return Err(needed(n)),
            _ => {}
        }
        let (slopes, explained) = self.solve(&total, &which).ok_or(AnalysisError::Dependent)?;
        let of = |sums: &[f64]| {
            let found = self.solve(sums, &which);
            found.map_or_else(|| vec![f64::NAN; slopes.len()], |(slopes, _)| slopes)
        };
        let coefficients = self.sums.intervals(seed, which.len(), of);
        Ok((which, Regression { coefficients, explained, rows: self.rows }))
    }

    /// Σ(zᵢ − mean)(zⱼ − mean), i ≥ j.
    fn covariance(&self, sums: &[f64], i: usize, j: usize) -> f64 {
        let products = &sums[2 + self.parameters..];
        products[i * (i + 1) / 2 + j] - sums[1 + i] * sums[1 + j] / sums[0]
    }

    /// Standardised coefficients and R²; none if the parameters depend on one another.
    fn solve(&self, sums: &[f64], which: &[usize]) -> Option<(Vec<f64>, f64)> {
        let figure = self.parameters;
        let scale = |i: usize| self.covariance(sums, i, i).sqrt();
        let scales: Vec<f64> = which.iter().map(|i| scale(*i)).collect();
        let between = |r: usize, c: usize| {
            let (i, j) = (which[r].max(which[c]), which[r].min(which[c]));
            self.covariance(sums, i, j) / scales[r] / scales[c]
        };
        let matrix = DMatrix::from_fn(which.len(), which.len(), between);
        let with_figure = |r: usize, _| self.covariance(sums, figure, which[r]) / scales[r] / scale(figure);
        let right = DVector::from_fn(which.len(), with_figure);
        let factor = matrix.cholesky()?;
        // a pivot lost in rounding means dependent columns
        (factor.l_dirty().diagonal().min() > 1e-7).then_some(())?;
        let slopes = factor.solve(&right);
        Some((slopes.iter().copied().collect(), slopes.dot(&right)))
    }
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
