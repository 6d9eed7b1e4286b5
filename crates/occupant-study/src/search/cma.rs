//! The covariance matrix adaptation evolution strategy.
//!
//! N. Hansen, "The CMA evolution strategy: a tutorial", arXiv:1604.00772 (2016): figure 6 and table 1 with its standard
//! settings, negative weights included; equation numbers below are those of that text. A generation of λ points is drawn
//! from N(m, σ²C); their order alone, never their values, moves the mean m, the covariance C and the step σ.
//!
//! Random numbers are addressed by descent, generation, candidate and coordinate; products of matrices are written out, so
//! that their sums have one order on every machine.

use nalgebra::DMatrix;

use super::eigen;
use crate::normal::quantile;
use crate::random::{Purpose, unit};
use occupant_units::trig::{exp, ln};

/// State of a descent of CMA-ES.
#[derive(Clone, Debug)]
pub struct Cma {
    constants: Constants,
    seed: u64,
    descent: u64,
    generation: u64,
    mean: Vec<f64>,
    step: f64,
    covariance: DMatrix<f64>,
    /// Eigenvectors in columns, and the square roots of the eigenvalues.
    axes: DMatrix<f64>,
    lengths: Vec<f64>,
    /// Evolution paths p_σ and p_c.
    step_path: Vec<f64>,
    path: Vec<f64>,
    /// Least value of each generation, in order.
    least: Vec<f64>,
    last: Vec<f64>,
}

/// Table 1.
#[derive(Clone, Debug)]
struct Constants {
    weights: Vec<f64>,
    parents: usize,
    effective: f64,
    c_step: f64,
    d_step: f64,
    c_path: f64,
    c_one: f64,
    c_rank: f64,
    /// Expected length of a standard normal vector.
    chi: f64,
}

/// Invalid input of a descent.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BadDescent {
    /// An initial mean with this many coordinates.
    #[error("a mean of {0} coordinates, of which not all are finite; expected at least one, all finite")]
    Mean(usize),
    /// An invalid initial step.
    #[error("a step of {0}; expected a positive one")]
    Step(f64),
    /// A generation of the wrong size.
    #[error("{points} points and {values} values; expected {expected} of both")]
    Generation {
        /// Number of points given.
        points: usize,
        /// Number of values given.
        values: usize,
        /// Number of points of a generation.
        expected: usize,
    },
}

/// Largest size of a generation; more is taken for a mistake.
const MOST_POINTS: usize = 1_000_000;

/// Reason why a descent ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The values differ by no more than the tolerance.
    Values,
    /// The steps are negligibly short.
    Steps,
    /// The covariance is too ill-conditioned.
    Condition,
    /// The evaluations are used up.
    Budget,
}

impl Ending {
    /// Description in words.
    pub fn words(self) -> &'static str {
        match self {
            Ending::Values => "the values no longer differ",
            Ending::Steps => "the steps have become short",
            Ending::Condition => "one direction has become narrow",
            Ending::Budget => "no evaluation was left",
        }
    }
}

/// Step length below which nothing changes, as a fraction of the unit cube.
const SHORTEST_STEP: f64 = 1e-9;
const WORST_CONDITION: f64 = 1e14;

impl Constants {
    fn new(n: usize, population: usize) -> Self {
        let nf = n as f64;
        let parents = population / 2;
        // w′ᵢ = ln((λ + 1)/2) − ln i                                                                   (49)
        let half = ln((population as f64 + 1.0) / 2.0);
        let raw: Vec<f64> = (1..=population).map(|i| half - ln(i as f64)).collect();
        let effective_of = |w: &[f64]| {
            let sum: f64 = w.iter().sum();
            let squares: f64 = w.iter().map(|w| w * w).sum();
            if squares > 0.0 { sum * sum / squares } else { 0.0 }
        };
        let effective = effective_of(&raw[..parents]);
        let effective_negative = effective_of(&raw[parents..]);
        // (55) to (58)
        let c_step = (effective + 2.0) / (nf + effective + 5.0);
        let d_step = 1.0 + 2.0 * (((effective - 1.0) / (nf + 1.0)).sqrt() - 1.0).max(0.0) + c_step;
        let c_path = (4.0 + effective / nf) / (nf + 4.0 + 2.0 * effective / nf);
        let c_one = 2.0 / ((nf + 1.3) * (nf + 1.3) + effective);
        let c_rank =
            (2.0 * (0.25 + effective + 1.0 / effective - 2.0) / ((nf + 2.0) * (nf + 2.0) + effective)).min(1.0 - c_one);
        // (50) to (53)
        let least = (1.0 + c_one / c_rank)
            .min(1.0 + 2.0 * effective_negative / (effective + 2.0))
            .min((1.0 - c_one - c_rank) / (nf * c_rank));
        let positive: f64 = raw.iter().filter(|w| **w > 0.0).sum();
        let negative: f64 = -raw.iter().filter(|w| **w < 0.0).sum::<f64>();
        let weights = raw.iter().map(|w| if *w >= 0.0 { w / positive } else { w * least.max(0.0) / negative });
        Constants {
            weights: weights.collect(),
            parents,
            effective,
            c_step,
            d_step,
            c_path,
            c_one,
            c_rank,
            chi: nf.sqrt() * (1.0 - 1.0 / (4.0 * nf) + 1.0 / (21.0 * nf * nf)),
        }
    }
}

impl Cma {
    /// A descent of `population` points a generation from `mean`, 4 at least and a million at most, with steps of the length
    /// `step` in all directions at first. `seed` and `descent` name its random numbers.
    ///
    /// # Errors
    /// No coordinate; a mean that is not finite; a step that is not positive.
    pub fn new(mean: Vec<f64>, step: f64, population: usize, seed: u64, descent: u64) -> Result<Self, BadDescent> {
        let n = mean.len();
        if n == 0 || !mean.iter().all(|x| x.is_finite()) {
            return Err(BadDescent::Mean(n));
        }
        if !(step > 0.0 && step.is_finite()) {
            return Err(BadDescent::Step(step));
        }
        let population = population.clamp(4, MOST_POINTS);
        Ok(Cma {
            constants: Constants::new(n, population),
            seed,
            descent,
            generation: 0,
            mean,
            step,
            covariance: DMatrix::identity(n, n),
            axes: DMatrix::identity(n, n),
            lengths: vec![1.0; n],
            step_path: vec![0.0; n],
            path: vec![0.0; n],
            least: Vec::new(),
            last: Vec::new(),
        })
    }

    /// Number of points of a generation.
    pub fn population(&self) -> usize {
        self.constants.weights.len()
    }

    /// The points of the next generation, in the whole space: xₖ = m + σ B D zₖ (38 to 40).
    pub fn ask(&self) -> Vec<Vec<f64>> {
        (0..self.population()).map(|k| self.candidate(k)).collect()
    }

    fn candidate(&self, k: usize) -> Vec<f64> {
        let n = self.mean.len();
        let index = self.descent << 48 | self.generation << 20 | k as u64;
        let drawn: Vec<f64> =
            (0..n).map(|d| quantile(unit(self.seed, Purpose::Search, index, d as u32)) * self.lengths[d]).collect();
        (0..n).map(|i| self.mean[i] + self.step * dot((0..n).map(|j| (self.axes[(i, j)], drawn[j])))).collect()
    }

    /// Learns from the values of the points that [`Cma::ask`] gave; one that is not a number is the worst.
    ///
    /// # Errors
    /// The number of points or values is not the population size; nothing is learnt.
    pub fn tell(&mut self, points: &[Vec<f64>], values: &[f64]) -> Result<(), BadDescent> {
        let (expected, n) = (self.population(), self.mean.len());
        if points.len() != expected || values.len() != expected || points.iter().any(|point| point.len() != n) {
            return Err(BadDescent::Generation { points: points.len(), values: values.len(), expected });
        }
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by(|a, b| values[*a].total_cmp(&values[*b]).then(a.cmp(b)));
        let steps: Vec<Vec<f64>> = order
            .iter()
            .map(|k| {
                let pairs = points[*k].iter().zip(&self.mean);
                pairs.map(|(x, m)| (x - m) / self.step).collect()
            })
            .collect();
        self.generation += 1;
        self.move_mean(&steps);
        self.adapt_covariance(&steps);
        self.decompose();
        self.least.push(order.first().map_or(f64::INFINITY, |k| values[*k]));
        self.last = values.to_vec();
        Ok(())
    }

    /// Updates mean, paths and step (41 to 45).
    fn move_mean(&mut self, steps: &[Vec<f64>]) {
        let n = self.mean.len();
        let c = &self.constants;
        let weighted = |i: usize| dot((0..c.parents).map(|k| (c.weights[k], steps[k][i])));
        let y: Vec<f64> = (0..n).map(weighted).collect();
        let whitened = self.whitened(&y);
        let c = &self.constants;
        let gain = (c.c_step * (2.0 - c.c_step) * c.effective).sqrt();
        for i in 0..n {
            self.mean[i] += self.step * y[i];
            self.step_path[i] = (1.0 - c.c_step) * self.step_path[i] + gain * whitened[i];
        }
        let length = norm(&self.step_path);
        // h_σ stops the rank-one update after a long step
        let settled = 1.0 - (0..2 * self.generation).fold(1.0, |p, _| p * (1.0 - c.c_step));
        let calm = length / settled.sqrt() < (1.4 + 2.0 / (n as f64 + 1.0)) * c.chi;
        let gain = if calm { (c.c_path * (2.0 - c.c_path) * c.effective).sqrt() } else { 0.0 };
        for (p, y) in self.path.iter_mut().zip(&y) {
            *p = (1.0 - c.c_path) * *p + gain * y;
        }
        // what h_σ takes away is given back to C
        let lost = if calm { 0.0 } else { c.c_one * c.c_path * (2.0 - c.c_path) };
        let rank: f64 = c.weights.iter().sum();
        self.covariance *= 1.0 + lost - c.c_one - c.c_rank * rank;
        self.step *= exp((c.c_step / c.d_step * (length / c.chi - 1.0)).min(1.0));
    }

    /// Rank-one and rank-μ update (46 and 47); the decay of the old matrix is applied in `move_mean`.
    fn adapt_covariance(&mut self, steps: &[Vec<f64>]) {
        let n = self.mean.len();
        let c = &self.constants;
        let weights: Vec<f64> = steps
            .iter()
            .zip(&c.weights)
            .map(|(y, w)| {
                if *w >= 0.0 {
                    c.c_rank * w
                } else {
                    let z = norm(&self.whitened(y));
                    c.c_rank * w * n as f64 / (z * z).max(f64::MIN_POSITIVE)
                }
            })
            .collect();
        for i in 0..n {
            for j in 0..=i {
                let of_path = c.c_one * self.path[i] * self.path[j];
                let of_steps = dot(weights.iter().zip(steps).map(|(w, y)| (*w, y[i] * y[j])));
                let value = self.covariance[(i, j)] + of_path + of_steps;
                self.covariance[(i, j)] = value;
                self.covariance[(j, i)] = value;
            }
        }
    }

    fn decompose(&mut self) {
        let eigen = eigen(self.covariance.clone());
        self.axes = eigen.eigenvectors;
        let greatest = eigen.eigenvalues.iter().fold(0.0_f64, |g, e| g.max(*e));
        let floor = greatest / WORST_CONDITION;
        self.lengths = eigen.eigenvalues.iter().map(|e| e.max(floor).sqrt()).collect();
    }

    /// C^(−½) y.
    fn whitened(&self, y: &[f64]) -> Vec<f64> {
        let n = y.len();
        let along: Vec<f64> =
            (0..n).map(|j| dot((0..n).map(|i| (self.axes[(i, j)], y[i]))) / self.lengths[j]).collect();
        (0..n).map(|i| dot((0..n).map(|j| (self.axes[(i, j)], along[j])))).collect()
    }

    /// Whether the descent has ended: all values of the last generation, and the least ones of the last 10 + 30n/λ
    /// generations, differ by less than `tolerance`; or its steps are too short or its covariance too narrow.
    pub fn ending(&self, tolerance: f64) -> Option<Ending> {
        let n = self.mean.len();
        let window = 10 + (30 * n).div_ceil(self.population());
        if self.least.len() >= window {
            let recent = self.least[self.least.len() - window..].iter();
            let range = spread(recent.chain(&self.last));
            if range < tolerance {
                return Some(Ending::Values);
            }
        }
        let longest = (0..n).map(|i| self.covariance[(i, i)].sqrt().max(self.path[i].abs())).fold(0.0, f64::max);
        if self.step * longest < SHORTEST_STEP {
            return Some(Ending::Steps);
        }
        let lengths = self.lengths.iter();
        let [short, long] = lengths.fold([f64::INFINITY, 0.0_f64], |[s, l], d| [s.min(*d), l.max(*d)]);
        let narrow = (long / short) * (long / short) >= 0.99 * WORST_CONDITION;
        (narrow || !self.step.is_finite()).then_some(Ending::Condition)
    }
}

/// Largest minus least value.
fn spread<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)]);
    high - low
}

fn dot(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    pairs.fold(0.0, |sum, (a, b)| sum + a * b)
}

fn norm(v: &[f64]) -> f64 {
    dot(v.iter().map(|x| (*x, *x))).sqrt()
}
