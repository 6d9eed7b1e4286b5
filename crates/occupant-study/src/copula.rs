//! Correlated parameters: a Gaussian copula, which keeps each parameter's own distribution.
//!
//! z = Φ⁻¹(u), z′ = L z with the correlation matrix C = L Lᵀ, u′ = Φ(z′). Spearman's rank correlation r of the result
//! belongs to Pearson's ρ = 2 sin(π r/6) of the normal scores (K. Pearson 1907; W. H. Kruskal 1958).

use std::f64::consts::PI;

use super::normal;
use occupant_units::trig::sin_cos;

/// Least distance of probabilities from 0 and 1, as for the random numbers.
const LEAST: f64 = f64::EPSILON / 2.0;

/// Cholesky factor of the correlation matrix of all parameters.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Copula {
    /// Rows of L up to the diagonal; a single number for a parameter that depends on no earlier one.
    rows: Vec<Vec<f64>>,
}

/// Correlation of the normal scores that gives a rank correlation.
fn score_correlation(rank: f64) -> f64 {
    2.0 * sin_cos(PI * rank / 6.0).0
}

impl Copula {
    /// The copula of `n` parameters with rank correlations (i, j, r); none if the matrix is not positive definite.
    pub(super) fn new(n: usize, ranks: &[(usize, usize, f64)]) -> Option<Copula> {
        let entry = |i: usize, j: usize| {
            let given = ranks.iter().find(|(a, b, _)| (*a, *b) == (i, j) || (*a, *b) == (j, i));
            match (i == j, given) {
                (true, _) => 1.0,
                (_, Some((.., rank))) => score_correlation(*rank),
                _ => 0.0,
            }
        };
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(n);
        for i in 0..n {
            let mut row: Vec<f64> = Vec::with_capacity(i + 1);
            for (j, above) in rows.iter().enumerate() {
                let sum: f64 = row.iter().zip(above).map(|(a, b)| a * b).sum();
                row.push((entry(i, j) - sum) / above[j]);
            }
            let rest = 1.0 - row.iter().map(|x| x * x).sum::<f64>();
            if rest < 1e-12 {
                return None;
            }
            row.push(rest.sqrt());
            rows.push(row);
        }
        Some(Copula { rows })
    }

    /// Correlates the probabilities of one sample.
    pub(super) fn correlate(&self, u: &mut [f64]) {
        let z: Vec<f64> = u.iter().map(|u| normal::quantile(*u)).collect();
        for (i, row) in self.rows.iter().enumerate().take(u.len()) {
            // a parameter that depends on no other keeps its very bits
            if row[..i].iter().any(|x| *x != 0.0) {
                let score = row.iter().zip(&z).map(|(l, z)| l * z).sum();
                u[i] = normal::cumulative(score).clamp(LEAST, 1.0 - LEAST);
            }
        }
    }
}
