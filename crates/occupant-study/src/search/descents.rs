//! Descents one after the other, each with twice the points a generation of the one before, while evaluations last.
//!
//! A. Auger, N. Hansen, "A restart CMA evolution strategy with increasing population size", CEC 2005: a greater population
//! sees more of a rugged landscape and less of its single holes.

use super::bounds::fold;
use super::cma::{Cma, Ending};
use super::{Evaluate, Point, Stage, evaluated};
use crate::random::{Purpose, unit};

/// Settings of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Descents {
    /// Start of the first descent, coordinates from 0 to 1.
    pub start: Vec<f64>,
    /// Starts of the next descents. Those after them start at random points.
    pub next: Vec<Vec<f64>>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Largest number of evaluations.
    pub evaluations: u64,
    /// Population of the first descent, at least 4.
    pub population: usize,
    /// Converged when values differ by less than this.
    pub tolerance: f64,
}

/// One descent.
#[derive(Clone, Debug, PartialEq)]
pub struct Descent {
    /// Population.
    pub population: usize,
    /// Evaluations used.
    pub evaluations: u64,
    /// The point with the least value.
    pub best: Point,
    /// Reason why it ended.
    pub ending: Ending,
}

/// Result of all descents.
#[derive(Clone, Debug, PartialEq)]
pub struct Global {
    /// The point with the least value.
    pub best: Point,
    /// The descents in order.
    pub descents: Vec<Descent>,
}

/// Initial step, as a fraction of the cube.
const FIRST_STEP: f64 = 0.3;

/// Searches the unit cube for its least value. At least one generation is computed, however few evaluations there are.
///
/// # Errors
/// An error of `evaluate`.
pub fn descend<E>(how: &Descents, evaluate: &mut Evaluate<'_, E>) -> Result<Global, E> {
    let mut left = how.evaluations;
    let mut population = how.population.max(4);
    let mut descents: Vec<Descent> = Vec::new();
    loop {
        let number = descents.len();
        let start = start(how, number);
        let descent = one(how, number, population, start, left, evaluate)?;
        left = left.saturating_sub(descent.evaluations);
        // one that has asked for nothing would not ask the next time either
        let over = descent.ending == Ending::Budget || descent.evaluations == 0;
        descents.push(descent);
        population = population.saturating_mul(2);
        if over || left < population as u64 {
            break;
        }
    }
    let nothing = Point { at: how.start.clone(), value: f64::INFINITY };
    let all = descents.iter().map(|d| d.best.clone());
    Ok(Global { best: all.fold(nothing, Point::lower), descents })
}

fn start(how: &Descents, number: usize) -> Vec<f64> {
    match number {
        0 => how.start.clone(),
        _ if number <= how.next.len() => how.next[number - 1].clone(),
        _ => {
            let index = u64::MAX - number as u64;
            let anywhere = |d| unit(how.seed, Purpose::Search, index, d as u32);
            (0..how.start.len()).map(anywhere).collect()
        }
    }
}

fn one<E>(
    how: &Descents,
    number: usize,
    population: usize,
    start: Vec<f64>,
    left: u64,
    evaluate: &mut Evaluate<'_, E>,
) -> Result<Descent, E> {
    let mut best = Point { at: start.clone(), value: f64::INFINITY };
    // without a coordinate there is nothing to search
    let Ok(mut cma) = Cma::new(start, FIRST_STEP, population, how.seed, number as u64) else {
        return Ok(Descent { population, evaluations: 0, best, ending: Ending::Steps });
    };
    let mut evaluations = 0;
    let mut generation = 0;
    let ending = loop {
        let asked = cma.ask();
        let folded = asked.iter().map(|x| x.iter().map(|x| fold(*x)).collect()).collect();
        let stage = Stage::Descent { number, generation };
        let points = evaluated(stage, folded, evaluate)?;
        evaluations += points.len() as u64;
        generation += 1;
        let values: Vec<f64> = points.iter().map(|p| p.value).collect();
        if cma.tell(&asked, &values).is_err() {
            break Ending::Budget;
        }
        best = points.into_iter().fold(best, Point::lower);
        if let Some(ending) = cma.ending(how.tolerance) {
            break ending;
        }
        if evaluations + population as u64 > left {
            break Ending::Budget;
        }
    };
    Ok(Descent { population, evaluations, best, ending })
}
