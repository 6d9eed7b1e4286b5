//! Sobol's sensitivity indices of a Saltelli design.
//!
//! With f_A, f_B, f_ABᵢ, f_BAᵢ the figure at the rows of the blocks (see [`crate::Block`]), f₀ its mean and V its variance
//! over A and B:
//!
//! ```text
//! Sᵢ  = mean (f_B − f₀)(f_ABᵢ − f_A) / V        A. Saltelli et al., Comput. Phys. Commun. 181 (2010), table 2 (b)
//! STᵢ = mean (f_A − f_ABᵢ)² / 2V               M. J. W. Jansen, Comput. Phys. Commun. 117 (1999)
//! Sᵢⱼ = mean (f_BAᵢ f_ABⱼ − f_A f_B) / V − Sᵢ − Sⱼ
//!                                              A. Saltelli, Comput. Phys. Commun. 145 (2002), mean of both orders of i and j
//! ```
//!
//! Sᵢ is the part of the variance that parameter i explains alone, STᵢ the part in which it is involved, Sᵢⱼ the part that
//! i and j explain together beyond what each explains alone. An estimate may lie slightly outside 0 to 1; the interval shows
//! how much of that can be chance.

use super::sums::{Grouping, Sums};
use super::{AnalysisError, Estimate};

/// Smallest number of points for an index.
const LEAST_POINTS: usize = 16;
/// Largest number of parameters with indices of pairs: there are k(k − 1)/2.
const MOST_PAIRED: usize = 100;

/// First-order, second-order and total indices of all parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct SobolIndices {
    /// Sᵢ, by parameter.
    pub first: Vec<Estimate>,
    /// STᵢ, by parameter.
    pub total: Vec<Estimate>,
    /// Sᵢⱼ of each pair i < j; empty for a design without the blocks for them, and for more than 100 parameters.
    pub second: Vec<([usize; 2], Estimate)>,
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

/// The figure at the rows of one point.
#[derive(Clone, Debug, Default)]
pub struct SobolPoint {
    /// At the row of A.
    pub a: f64,
    /// At that of B.
    pub b: f64,
    /// At those of AB, by parameter.
    pub ab: Vec<f64>,
    /// At those of BA, by parameter; empty without them.
    pub ba: Vec<f64>,
}

/// Sums over the points of a design: memory does not grow with them if they are grouped.
#[derive(Clone, Debug)]
pub struct SobolSums {
    parameters: usize,
    pairs: Vec<[usize; 2]>,
    sums: Sums,
    /// The first value; all are taken from it, so that no digits are lost.
    origin: Option<f64>,
    points: usize,
    dropped: usize,
}

/// Places of the sums: count, Σ(a + b), Σ(a² + b²), Σab, then of each parameter, then of each pair.
const COMMON: usize = 4;
/// Sums of a parameter, with d = f_ABᵢ − f_A: Σbd, Σd, Σd², Σd⁴.
const EACH: usize = 4;

impl SobolSums {
    /// No points yet, of so many parameters; `second_order` tells whether there are rows of BA.
    pub fn new(parameters: usize, second_order: bool, by: Grouping) -> Self {
        let pairs = (0..parameters).flat_map(|i| (i + 1..parameters).map(move |j| [i, j]));
        let pairs: Vec<_> = pairs.filter(|_| second_order && parameters <= MOST_PAIRED).collect();
        let sums = Sums::new(COMMON + EACH * parameters + pairs.len(), by);
        SobolSums { parameters, pairs, sums, origin: None, points: 0, dropped: 0 }
    }

    /// Adds a point; one with a value that is not finite is left out and counted.
    pub fn see(&mut self, index: u64, point: &SobolPoint) {
        let all = [point.a, point.b].into_iter().chain(point.ab.iter().chain(&point.ba).copied());
        if all.into_iter().any(|x| !x.is_finite()) {
            self.dropped += 1;
            return;
        }
        self.points += 1;
        let origin = *self.origin.get_or_insert(point.a);
        let (a, b) = (point.a - origin, point.b - origin);
        let sums = self.sums.of_row(index);
        let (common, rest) = sums.split_at_mut(COMMON);
        add(common, [1.0, a + b, a * a + b * b, a * b]);
        let (each, pairs) = rest.split_at_mut(EACH * self.parameters);
        for (sums, ab) in each.chunks_exact_mut(EACH).zip(&point.ab) {
            let d = ab - point.a;
            add(sums, [b * d, d, d * d, d * d * d * d]);
        }
        let [ab, ba] = [&point.ab, &point.ba];
        let product = |i: usize, j: usize| (ba[i] - origin) * (ab[j] - origin);
        for (sum, [i, j]) in pairs.iter_mut().zip(&self.pairs) {
            *sum += 0.5 * (product(*i, *j) + product(*j, *i));
        }
    }

    /// The indices.
    ///
    /// # Errors
    /// Fewer than 16 complete points, a figure that is the same everywhere.
    pub fn indices(&self, seed: u64) -> Result<SobolIndices, AnalysisError> {
        if self.points < LEAST_POINTS {
            return Err(AnalysisError::TooFew { found: self.points, needed: LEAST_POINTS });
        }
        let total = self.sums.total();
        let [mean, variance] = moments(&total);
        let mean_of_figure = mean + self.origin.unwrap_or(0.0);
        // what rounding leaves of a constant figure is no variance
        if variance <= 1e-24 * mean_of_figure * mean_of_figure || variance == 0.0 {
            return Err(AnalysisError::Constant { parameter: None });
        }
        let k = self.parameters;
        let mut first = self.sums.intervals(seed, 2 * k + self.pairs.len(), |sums| self.statistics(sums));
        let mut total_indices = first.split_off(k);
        let second = total_indices.split_off(k);
        let carrying = |sums: &[f64]| if sums[3] > 0.0 { sums[2] * sums[2] / sums[3] } else { 0.0 };
        Ok(SobolIndices {
            first,
            total: total_indices,
            second: self.pairs.iter().copied().zip(second).collect(),
            carrying: total[COMMON..COMMON + EACH * k].chunks_exact(EACH).map(carrying).collect(),
            mean: mean_of_figure,
            variance,
            points: self.points,
            dropped: self.dropped,
        })
    }

    /// All first-order, then all total, then all second-order indices.
    fn statistics(&self, sums: &[f64]) -> Vec<f64> {
        let [mean, variance] = moments(sums);
        let n = sums[0];
        let (each, pairs) = sums[COMMON..].split_at(EACH * self.parameters);
        let first = each.chunks_exact(EACH).map(|sums| (sums[0] - mean * sums[1]) / n / variance);
        let mut all: Vec<f64> = first.collect();
        all.extend(each.chunks_exact(EACH).map(|sums| 0.5 * sums[2] / n / variance));
        let joint = |(sum, [i, j]): (&f64, &[usize; 2])| (sum - sums[3]) / n / variance - all[*i] - all[*j];
        let second: Vec<f64> = pairs.iter().zip(&self.pairs).map(joint).collect();
        all.extend(second);
        all
    }
}

fn add<const N: usize>(sums: &mut [f64], terms: [f64; N]) {
    sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
}

/// Mean and variance of both blocks, from the origin.
fn moments(sums: &[f64]) -> [f64; 2] {
    let n = 2.0 * sums[0];
    let mean = sums[1] / n;
    [mean, (sums[2] - n * mean * mean) / (n - 1.0)]
}

/// Indices from the figure at the rows of A, of B, and of AB for each parameter.
///
/// # Errors
/// Columns of different length, fewer than 16 complete points, a figure that is the same everywhere.
pub fn sobol_indices(a: &[f64], b: &[f64], ab: &[Vec<f64>], seed: u64) -> Result<SobolIndices, AnalysisError> {
    let expected = a.len();
    if let Some(odd) = ab.iter().map(Vec::as_slice).chain([b]).find(|column| column.len() != expected) {
        return Err(AnalysisError::Length { found: odd.len(), expected });
    }
    let mut sums = SobolSums::new(ab.len(), false, Grouping::Rows);
    for i in 0..expected {
        let ab = ab.iter().map(|column| column[i]).collect();
        sums.see(i as u64, &SobolPoint { a: a[i], b: b[i], ab, ba: Vec::new() });
    }
    sums.indices(seed)
}
