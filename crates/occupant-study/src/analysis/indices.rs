//! Sobol's sensitivity indices of a Saltelli design.
//!
//! With f_A, f_B, f_ABᵢ the figure at the rows of the blocks (see [`crate::Block`]), f₀ its mean and V its variance over A
//! and B:
//!
//! ```text
//! Sᵢ  = mean (f_B − f₀)(f_ABᵢ − f_A) / V        A. Saltelli et al., Comput. Phys. Commun. 181 (2010), table 2 (b)
//! STᵢ = mean (f_A − f_ABᵢ)² / 2V               M. J. W. Jansen, Comput. Phys. Commun. 117 (1999)
//! ```
//!
//! Sᵢ is the part of the variance that parameter i explains alone, STᵢ the part in which it is involved. An estimate
//! may lie slightly outside 0 to 1; the interval shows how much of that can be chance.

use super::{AnalysisError, Estimate, at_rows, bootstrap, complete_rows, mean};

/// Smallest number of points for an index.
const LEAST_POINTS: usize = 16;

/// First-order and total indices of all parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct SobolIndices {
    /// Sᵢ, by parameter.
    pub first: Vec<Estimate>,
    /// STᵢ, by parameter.
    pub total: Vec<Estimate>,
    /// Effective number of points behind STᵢ, by parameter: (Σd²)²/Σd⁴ of the differences d = f_A − f_ABᵢ. Equal to all
    /// points if the parameter acts equally everywhere, small if it acts rarely, 0 if no point shows an effect. The
    /// intervals of both indices are only as good as these points.
    pub carrying: Vec<f64>,
    /// Mean of the figure over A and B.
    pub mean: f64,
    /// Variance of the figure over A and B.
    pub variance: f64,
    /// Points whose runs are all complete.
    pub points: usize,
    /// Points left out because a run has no such figure.
    pub dropped: usize,
}

/// Indices from the figure at the rows of A, of B, and of AB for each parameter.
///
/// # Errors
/// Columns of different length, fewer than 16 complete points, a figure that is the same everywhere.
pub fn sobol_indices(a: &[f64], b: &[f64], ab: &[Vec<f64>], seed: u64) -> Result<SobolIndices, AnalysisError> {
    let columns = [a, b].into_iter().chain(ab.iter().map(Vec::as_slice));
    let rows = complete_rows(columns, LEAST_POINTS)?;
    let dropped = a.len() - rows.len();
    let (a, b) = (at_rows(a, &rows), at_rows(b, &rows));
    let ab: Vec<Vec<f64>> = ab.iter().map(|column| at_rows(column, &rows)).collect();
    let every: Vec<usize> = (0..rows.len()).collect();
    let (mean, variance) = moments(&a, &b, &every);
    // what rounding leaves of a constant figure is no variance
    if variance <= 1e-24 * mean * mean || variance == 0.0 {
        return Err(AnalysisError::Constant { parameter: None });
    }
    let of = |rows: &[usize]| {
        let (mean, variance) = moments(&a, &b, rows);
        let first = ab.iter().map(|ab| first(&a, &b, ab, rows, mean) / variance);
        let total = ab.iter().map(|ab| total(&a, ab, rows) / variance);
        first.chain(total).collect::<Vec<f64>>()
    };
    let mut first = bootstrap::intervals(seed, rows.len(), 2 * ab.len(), of);
    let total = first.split_off(ab.len());
    let carrying = ab.iter().map(|ab| carrying(&a, ab)).collect();
    Ok(SobolIndices { first, total, carrying, mean, variance, points: rows.len(), dropped })
}

/// Mean and variance of both blocks at the given rows.
fn moments(a: &[f64], b: &[f64], rows: &[usize]) -> (f64, f64) {
    let both: Vec<f64> = rows.iter().flat_map(|&r| [a[r], b[r]]).collect();
    let mean = mean(&both);
    let squares = both.iter().map(|y| (y - mean) * (y - mean)).sum::<f64>();
    (mean, squares / (both.len() - 1) as f64)
}

fn first(a: &[f64], b: &[f64], ab: &[f64], rows: &[usize], mean: f64) -> f64 {
    let sum: f64 = rows.iter().map(|&r| (b[r] - mean) * (ab[r] - a[r])).sum();
    sum / rows.len() as f64
}

fn total(a: &[f64], ab: &[f64], rows: &[usize]) -> f64 {
    let sum: f64 = rows.iter().map(|&r| (a[r] - ab[r]).powi(2)).sum();
    0.5 * sum / rows.len() as f64
}

fn carrying(a: &[f64], ab: &[f64]) -> f64 {
    let squares = || a.iter().zip(ab).map(|(a, ab)| (a - ab).powi(2));
    let fourth: f64 = squares().map(|d| d * d).sum();
    if fourth > 0.0 { squares().sum::<f64>().powi(2) / fourth } else { 0.0 }
}
