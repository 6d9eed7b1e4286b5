//! Search with a model of all candidates tried so far, for functions that cost more than their model.
//!
//! ```text
//! tried ─ Radial (goals, limits) ─ descents on the model, within a region round the best ─ a round of candidates ─ tried
//! ```
//!
//! Each round asks for the model's best candidates in boxes of four sizes round the best of the region: in all coordinates and in
//! some of them, drawn at random (R. G. Regis, C. A. Shoemaker, "Combining radial basis function surrogates and dynamic coordinate
//! search", Engineering Optimization 45, 2013). The region grows where the widest box wins and shrinks where none does. One that no
//! longer improves is closed, and the next begins at the best candidate that is far from it, because a model of a few hundred
//! candidates sees one basin at a time (D. Eriksson et al., "Scalable global optimization via local Bayesian optimization",
//! NeurIPS 2019).
//!
//! Limits are kept by prices, far above their multipliers: the model is cheap to search, however steep the edge. A candidate whose
//! nearest neighbour was refused counts as refused.

use std::convert::Infallible;

use super::constrained::{Rank, Trial, Try, front, lower};
use super::descents::{Descents, descend};
use super::radial::{Radial, apart, squares};
use super::{Point, Stage};
use crate::random::{Purpose, bits, unit};
use crate::sobol::Sobol;
use crate::spread::quantile;

/// Candidates of a round.
const ROUND: usize = 8;
/// Sizes of the boxes, as parts of the region's.
const PARTS: [f64; 4] = [1.0, 0.5, 0.25, 0.125];
/// Factors on the size of the region if the best candidate came from that box, and if none was better.
const GROWTH: [f64; 4] = [1.5, 1.0, 0.8, 0.7];
const SHRINKS: f64 = 0.6;
/// Half of a region's edge: at first, at most.
const FIRST: f64 = 0.4;
const MOST: f64 = 0.5;
/// What ends a region: half of its edge at least, and less improvement than this fraction in [`ROUNDS`] rounds.
const COARSE: [f64; 2] = [0.02, 0.003];
/// The same of the last region, round the best of all.
const FINE: [f64; 2] = [2e-4, 1e-5];
/// Probability that a coordinate is moved in the second half of a round.
const MOVED: f64 = 0.5;
/// Candidates closer to another than this part of their box show little that is new.
const NEW: f64 = 0.1;
/// Rounds in which a region must improve.
const ROUNDS: usize = 3;
/// Least root mean square distance of a region's start from the ends of those before.
const FAR: f64 = 0.25;
/// Largest number of candidates in a model, those nearest to the region.
const MODELLED: usize = 200;
/// Evaluations of the model for a candidate, and their population.
const INNER: u64 = 480;
const POPULATION: usize = 12;
/// Distance kept from the limits of the model, in units of a region's size.
const MARGIN: f64 = 0.0025;
/// Prices of limits: this many times the ratio of the ranges of goal and excess.
const PRICE: f64 = 10.0;
/// Values far above the others would bend the model: they are cut this many quartile distances above the upper quartile.
const CUT: f64 = 1.5;
/// Added to the merits of refused and failed candidates.
const REFUSED: f64 = 1e9;
const FAILED: f64 = 1e12;

/// Candidates and what they showed, in their order.
#[derive(Clone, Debug, Default)]
pub struct Tried {
    /// Points of the unit cube.
    pub points: Vec<Vec<f64>>,
    /// What they showed.
    pub trials: Vec<Trial>,
}

impl Tried {
    /// Adds a batch.
    pub(super) fn add(&mut self, points: &[Vec<f64>], trials: &[Trial]) {
        self.points.extend_from_slice(&points[..trials.len().min(points.len())]);
        self.trials.extend_from_slice(trials);
    }
}

/// What is minimised: one number of the terms of the goal.
#[derive(Clone, Debug)]
pub(super) enum Aim {
    /// Their sum.
    Sum,
    /// A point of the front between them: the largest of the weighted distances from the best of each, and a little of their sum
    /// (R. E. Steuer, E.-U. Choo, "An interactive weighted Tchebycheff procedure", Mathematical Programming 26, 1983). Unlike a
    /// weighted sum it also reaches hollows of the front.
    Front {
        /// The best of each term so far.
        best: Vec<f64>,
        /// Factor of each term: weight over range.
        factors: Vec<f64>,
    },
}

impl Aim {
    /// The aim at one of `count` points spread over the front; none without several terms and candidates.
    pub(super) fn on_front(tried: &Tried, point: u64, count: u64, seed: u64) -> Option<Aim> {
        let known = || tried.trials.iter().filter(|trial| trial.is_known());
        let terms = known().next()?.terms().len();
        if terms < 2 {
            return None;
        }
        let ends: Vec<&Trial> = front(&tried.trials).into_iter().map(|i| &tried.trials[i]).collect();
        let all: Vec<&Trial> = if ends.is_empty() { known().collect() } else { ends };
        let end = |k: usize, of: fn(f64, f64) -> f64| all.iter().map(|trial| trial.terms()[k]).reduce(of);
        let best: Vec<f64> = (0..terms).filter_map(|k| end(k, f64::min)).collect();
        let worst: Vec<f64> = (0..terms).filter_map(|k| end(k, f64::max)).collect();
        let weights = weights(terms, point, count, seed);
        let factor =
            |((weight, best), worst): ((f64, &f64), &f64)| weight / (worst - best).max(1e-9 + 1e-3 * best.abs());
        let factors = weights.into_iter().zip(&best).zip(&worst).map(factor).collect();
        Some(Aim::Front { best, factors })
    }

    fn of(&self, terms: &[f64]) -> f64 {
        match self {
            Aim::Sum => terms.iter().sum(),
            Aim::Front { best, factors } => {
                let parts = || terms.iter().zip(best).zip(factors).map(|((term, best), factor)| factor * (term - best));
                parts().fold(f64::NEG_INFINITY, f64::max) + 0.02 * parts().sum::<f64>()
            }
        }
    }
}

/// The box in which candidates are sought.
struct Region {
    at: Vec<f64>,
    size: f64,
    /// [`COARSE`] or [`FINE`].
    ends: [f64; 2],
    /// Best merit after each round.
    merits: Vec<f64>,
}

/// A search in progress.
pub(super) struct Modelled<'a> {
    seed: u64,
    aim: Aim,
    tried: &'a mut Tried,
    prices: Vec<f64>,
    /// Largest number of regions, so that the rest of a large budget goes to descents without a model.
    regions: usize,
    closed: Vec<Vec<f64>>,
    /// Number of rounds, of earlier searches too.
    pub(super) rounds: usize,
}

impl<'a> Modelled<'a> {
    /// A search that continues from `tried`; `rounds` of earlier searches name its random numbers.
    pub(super) fn new(seed: u64, aim: Aim, regions: usize, tried: &'a mut Tried, rounds: usize) -> Self {
        let prices = prices(&aim, &tried.trials);
        Modelled { seed, aim, tried, prices, regions, closed: Vec::new(), rounds }
    }

    /// Searches until `evaluations` are used or the regions are closed; candidates evaluated and regions closed.
    ///
    /// # Errors
    /// An error of `evaluate`.
    pub(super) fn search<E>(
        &mut self,
        evaluations: u64,
        best: &mut (Point, Trial),
        evaluate: &mut Try<'_, E>,
    ) -> Result<(u64, usize), E> {
        let (mut used, mut present) = (0, None);
        while used < evaluations && self.closed.len() <= self.regions {
            let count = ROUND.min((evaluations - used) as usize);
            used += count as u64;
            let mut region = present.take().unwrap_or_else(|| self.begin());
            let points = self.round(&region, count);
            let stage = Stage::Model { region: self.closed.len(), round: self.rounds };
            let trials = evaluate(stage, &points)?;
            lower(best, &points, &trials);
            self.tried.add(&points, &trials);
            self.rounds += 1;
            self.see(&mut region, &points, &trials);
            if self.is_settled(&region) { self.closed.push(region.at) } else { present = Some(region) }
        }
        Ok((used, self.closed.len().min(self.regions)))
    }

    /// A region round the best candidate that is far from the ends of those before; the last one round the best of all.
    fn begin(&self) -> Region {
        let is_last = self.closed.len() == self.regions;
        let far = |point: &Vec<f64>| {
            let least = FAR * FAR * point.len() as f64;
            is_last || self.closed.iter().all(|end| squares(point, end) > least)
        };
        let merits: Vec<f64> = self.tried.trials.iter().map(|trial| self.merit(trial)).collect();
        let order = |all: &mut dyn Iterator<Item = usize>| all.min_by(|a, b| merits[*a].total_cmp(&merits[*b]));
        let count = merits.len();
        let first = order(&mut (0..count).filter(|i| far(&self.tried.points[*i]))).or_else(|| order(&mut (0..count)));
        let at = first.map_or_else(Vec::new, |i| self.tried.points[i].clone());
        let (size, ends) = if is_last { (COARSE[0], FINE) } else { (FIRST, COARSE) };
        Region { at, size, ends, merits: vec![first.map_or(FAILED, |i| merits[i])] }
    }

    fn see(&self, region: &mut Region, points: &[Vec<f64>], trials: &[Trial]) {
        let before = region.merits.last().copied().unwrap_or(FAILED);
        let merits: Vec<f64> = trials.iter().map(|trial| self.merit(trial)).collect();
        let least = (0..merits.len()).min_by(|a, b| merits[*a].total_cmp(&merits[*b]));
        let won = least.filter(|i| merits[*i] < before);
        region.size *= won.map_or(SHRINKS, |i| GROWTH[i % PARTS.len()]);
        region.size = region.size.clamp(region.ends[0], MOST);
        if let Some(i) = won {
            region.at = points[i].clone();
        }
        region.merits.push(won.map_or(before, |i| merits[i]));
    }

    fn is_settled(&self, region: &Region) -> bool {
        let Some(earlier) = region.merits.len().checked_sub(1 + ROUNDS).map(|at| region.merits[at]) else {
            return false;
        };
        let now = region.merits[region.merits.len() - 1];
        let goals: Vec<f64> =
            self.tried.trials.iter().filter(|t| t.is_known()).map(|t| self.aim.of(t.terms())).collect();
        let scale = now.abs().max(range(&goals));
        earlier - now <= region.ends[1] * scale
    }

    /// The aim of a candidate with what it exceeds, by the prices of limits.
    fn merit(&self, trial: &Trial) -> f64 {
        match trial.rank() {
            Rank::Failed => FAILED,
            Rank::Refused(_) => REFUSED + self.priced(trial.terms(), &trial.beyond, 0.0),
            Rank::Allowed(_) | Rank::Beyond(_) => self.priced(trial.terms(), &trial.beyond, 0.0),
        }
    }

    fn priced(&self, terms: &[f64], beyond: &[f64], margin: f64) -> f64 {
        let excess = beyond.iter().zip(&self.prices);
        excess.fold(self.aim.of(terms), |sum, (g, price)| sum + price * (g + margin).max(0.0))
    }

    /// The next `count` candidates of a region.
    fn round(&self, region: &Region, count: usize) -> Vec<Vec<f64>> {
        let model = self.model(&region.at);
        let mut points: Vec<Vec<f64>> = Vec::new();
        for k in 0..count {
            let seed = bits(self.seed, Purpose::Model, self.rounds as u64, k as u32, 0);
            let size = region.size * PARTS[k % PARTS.len()];
            let free = free(seed, region.at.len(), if k < PARTS.len() { 1.0 } else { MOVED });
            let sought = model.as_ref().map(|model| self.sought(model, region, size, &free, seed));
            let is_new = |x: &Vec<f64>| {
                let mut others = self.tried.points.iter().chain(&points);
                others.all(|other| apart(other, x) >= NEW * size)
            };
            points.push(sought.filter(is_new).unwrap_or_else(|| anywhere(&region.at, size, seed)));
        }
        points
    }

    /// The model of goals and limits, from the candidates nearest to a point.
    fn model(&self, at: &[f64]) -> Option<Radial> {
        let known = |i: &usize| self.tried.trials[*i].is_known();
        let mut near: Vec<(usize, f64)> =
            (0..self.tried.trials.len()).filter(known).map(|i| (i, squares(&self.tried.points[i], at))).collect();
        near.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        near.truncate(MODELLED);
        let points: Vec<&[f64]> = near.iter().map(|(i, _)| self.tried.points[*i].as_slice()).collect();
        let shown = |i: usize| [self.tried.trials[i].terms(), &self.tried.trials[i].beyond].concat();
        let mut values: Vec<Vec<f64>> = near.iter().map(|(i, _)| shown(*i)).collect();
        for k in 0..values.first().map_or(0, Vec::len) {
            let column: Vec<f64> = values.iter().map(|row| row[k]).collect();
            let most = quantile(&column, 0.75).unwrap_or(0.0) + CUT * range(&column);
            if range(&column) > 0.0 {
                values.iter_mut().for_each(|row| row[k] = row[k].min(most));
            }
        }
        Radial::through(&points, &values)
    }

    /// The model's best point of a box round the region's best, in the free coordinates.
    fn sought(&self, model: &Radial, region: &Region, size: f64, free: &[usize], seed: u64) -> Vec<f64> {
        let walls: Vec<[f64; 2]> = free.iter().map(|i| ends(region.at[*i], size)).collect();
        let placed = |part: &[f64]| {
            let mut x = region.at.clone();
            for ((i, [low, high]), part) in free.iter().zip(&walls).zip(part) {
                x[*i] = low + part * (high - low);
            }
            x
        };
        let start = free.iter().zip(&walls).map(|(i, [low, high])| (region.at[*i] - low) / (high - low).max(1e-12));
        let how = Descents {
            start: start.collect(),
            next: Vec::new(),
            seed,
            evaluations: INNER,
            population: POPULATION,
            tolerance: 1e-7,
        };
        let terms = self.tried.trials.iter().find(|t| t.is_known()).map_or(1, |t| t.terms().len());
        let margin = MARGIN * region.size;
        let may_be_refused = self.tried.trials.iter().any(is_bad);
        let value = |part: &Vec<f64>| {
            let x = placed(part);
            let shown = model.at(&x);
            let (terms, beyond) = shown.split_at(terms.min(shown.len()));
            self.priced(terms, beyond, margin) + if may_be_refused && self.is_refused(&x) { REFUSED } else { 0.0 }
        };
        let Ok(found) =
            descend(&how, &mut |_, points: &[Vec<f64>]| Ok::<_, Infallible>(points.iter().map(value).collect()));
        placed(&found.best.at)
    }

    /// Whether the nearest candidate was refused or failed.
    fn is_refused(&self, x: &[f64]) -> bool {
        let all = self.tried.points.iter().zip(&self.tried.trials);
        let nearest = all.min_by(|a, b| squares(a.0, x).total_cmp(&squares(b.0, x)));
        nearest.is_some_and(|(_, trial)| is_bad(trial))
    }
}

fn is_bad(trial: &Trial) -> bool {
    matches!(trial.rank(), Rank::Refused(_) | Rank::Failed)
}

/// Prices of the limits, from the ranges of the candidates.
fn prices(aim: &Aim, trials: &[Trial]) -> Vec<f64> {
    let known: Vec<&Trial> = trials.iter().filter(|t| t.is_known()).collect();
    let goals: Vec<f64> = known.iter().map(|t| aim.of(t.terms())).collect();
    let limits = known.first().map_or(0, |t| t.beyond.len());
    let beyond = |k: usize| -> Vec<f64> { known.iter().map(|t| t.beyond[k]).collect() };
    (0..limits).map(|k| PRICE * range(&goals).max(1e-9) / range(&beyond(k)).max(1e-9)).collect()
}

/// Weights of several terms, which add up to 1, for one of `count` points of the front: evenly spaced for two, else the gaps between
/// the coordinates of a point of Sobol'.
fn weights(terms: usize, point: u64, count: u64, seed: u64) -> Vec<f64> {
    let sobol = Sobol::new(terms - 1);
    let coordinate =
        |d: usize| if terms == 2 { (point as f64 + 0.5) / count as f64 } else { sobol.scrambled(point, d, seed) };
    let mut cuts: Vec<f64> = (0..terms - 1).map(coordinate).chain([0.0, 1.0]).collect();
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// Distance of the quartiles.
fn range(values: &[f64]) -> f64 {
    let [low, high] = [0.25, 0.75].map(|p| quantile(values, p).unwrap_or(0.0));
    high - low
}

/// Coordinates that are moved, each with this probability, at least one.
fn free(seed: u64, n: usize, probability: f64) -> Vec<usize> {
    let drawn = |d: usize| unit(seed, Purpose::Model, 0, d as u32);
    let some: Vec<usize> = (0..n).filter(|d| drawn(*d) < probability).collect();
    let one = || (0..n).min_by(|a, b| drawn(*a).total_cmp(&drawn(*b))).into_iter().collect();
    if some.is_empty() { one() } else { some }
}

/// A random point of a box, with a few coordinates moved.
fn anywhere(at: &[f64], size: f64, seed: u64) -> Vec<f64> {
    let moved = free(seed ^ 1, at.len(), 0.4);
    let mut x = at.to_vec();
    for d in moved {
        let [low, high] = ends(at[d], size);
        x[d] = low + (high - low) * unit(seed, Purpose::Model, 1, d as u32);
    }
    x
}

/// Ends of a box in a coordinate.
fn ends(at: f64, size: f64) -> [f64; 2] {
    [(at - size).max(0.0), (at + size).min(1.0)]
}
