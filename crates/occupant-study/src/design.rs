//! The samples of a study: for every index the coordinate of each parameter, computed from the index alone.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::law::Value;
use super::morris::Trajectory;
use super::permutation::permute;
use super::random::{Purpose, unit};
use super::saltelli::{self, Block};
use occupant_scenario::{POSITIVE, Ratio};

/// How the samples are chosen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Design {
    /// The scenario itself: one sample.
    #[serde(skip)]
    Single,
    /// Every value of every parameter with every value of all others. The last parameter changes fastest, as in nested
    /// loops in the order written.
    FullFactorial,
    /// Each parameter's range is cut into as many parts of equal probability as there are samples; each part is used
    /// once.
    LatinHypercube {
        /// How many samples.
        #[schemars(extend("minimum" = 1))]
        samples: u64,
    },
    /// Sobol's low-discrepancy sequence from its first point, scrambled.
    Sobol {
        /// How many samples, best a power of 2.
        #[schemars(extend("minimum" = 1))]
        samples: u64,
        /// Whether the sequence is scrambled by the seed; true if absent.
        #[serde(default = "scrambled")]
        scramble: bool,
    },
    /// Independent random samples.
    MonteCarlo {
        /// How many samples.
        #[schemars(extend("minimum" = 1))]
        samples: u64,
    },
    /// The base scenario, then each parameter alone at each of its values, or at its low and its high one.
    OneAtATime {
        /// The part of a normal distribution that lies below its low and above its high value; 0.05 if absent.
        #[serde(default = "usual_tail")]
        tail: Ratio<POSITIVE>,
    },
    /// Samples from a CSV file, one row each.
    Table {
        /// CSV file beside the study; its first line names parameters or paths with their units, such as
        /// `joints.neck.damping[in lbf s/rad],belts.lap.slack[mm]`.
        file: String,
        /// What the file says, one value for each parameter.
        #[serde(skip)]
        rows: Vec<Vec<Value>>,
    },
    /// Blocks for Sobol's sensitivity indices: A, A with one column of B for each parameter, B.
    Saltelli {
        /// How many points A and B have, best a power of 2. There are (k + 2) runs for each with k parameters, or 2k + 2.
        #[schemars(extend("minimum" = 1))]
        samples: u64,
        /// Whether B with one column of A is run too, for interactions of two; false if absent.
        #[serde(default)]
        second_order: bool,
    },
    /// Trajectories for Morris's screening, along which one parameter changes at a time.
    Morris {
        /// How many trajectories, of k + 1 runs each with k parameters.
        #[schemars(extend("minimum" = 1))]
        trajectories: u64,
        /// Into how many levels each range is cut, an even number; 4 if absent.
        #[schemars(extend("minimum" = 2))]
        #[serde(default = "usual_levels")]
        levels: u64,
        /// The part of a normal distribution that lies below its low and above its high level; 0.05 if absent.
        #[serde(default = "usual_tail")]
        tail: Ratio<POSITIVE>,
    },
}

fn scrambled() -> bool {
    true
}

fn usual_tail() -> Ratio<POSITIVE> {
    Ratio::of_si(0.05)
}

fn usual_levels() -> u64 {
    4
}

/// What a sample is in its design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// One of many alike.
    Sample,
    /// The base scenario of a one-at-a-time design.
    Nominal,
    /// Only this parameter differs from the base scenario.
    Varied {
        /// Index of the parameter.
        parameter: usize,
    },
    /// In a Saltelli design.
    Saltelli {
        /// Index of the point in A and B.
        point: u64,
        /// Which block.
        block: Block,
    },
    /// In a Morris design.
    Morris {
        /// Index of the trajectory.
        trajectory: u64,
        /// Steps made so far, 0 at its start.
        step: usize,
        /// The parameter that the last step changed, and by which part of its range, with its sign.
        changed: Option<(usize, f64)>,
    },
}

/// Where a parameter stands in its law.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Coordinate {
    /// As the base scenario has it.
    Nominal,
    /// One of its levels.
    Level(u64),
    /// A probability.
    Quantile(f64),
    /// A probability, with distributions without ends cut off at a tail.
    Bounded(f64, f64),
    /// A value of the design's own.
    Given(Value),
}

impl Design {
    /// How many samples, for parameters with these numbers of levels; none if more than 2⁵².
    pub(super) fn len(&self, levels: &[Option<u64>]) -> Option<u64> {
        let k = levels.len() as u64;
        let len = match self {
            Design::Single => Some(1),
            Design::FullFactorial => levels.iter().try_fold(1_u64, |n, l| n.checked_mul(l.unwrap_or(1))),
            Design::LatinHypercube { samples } | Design::Sobol { samples, .. } | Design::MonteCarlo { samples } => {
                Some(*samples)
            }
            Design::OneAtATime { .. } => levels.iter().try_fold(1_u64, |n, l| n.checked_add(l.unwrap_or(2))),
            Design::Table { rows, .. } => Some(rows.len() as u64),
            Design::Saltelli { samples, second_order } => samples.checked_mul(saltelli::block_len(k, *second_order)),
            Design::Morris { trajectories, .. } => trajectories.checked_mul(k + 1),
        };
        len.filter(|n| *n <= 1 << 52)
    }

    /// Whether its samples are drawn from the parameters' laws, one coordinate for each.
    pub(super) fn is_sampled(&self) -> bool {
        matches!(self, Design::LatinHypercube { .. } | Design::Sobol { .. } | Design::MonteCarlo { .. })
    }

    /// What a sample is in its design.
    pub(super) fn role(&self, index: u64, levels: &[Option<u64>], seed: u64) -> Role {
        let k = levels.len();
        match self {
            Design::OneAtATime { .. } => match one_at_a_time(index, levels) {
                None => Role::Nominal,
                Some((parameter, _)) => Role::Varied { parameter },
            },
            Design::Saltelli { second_order, .. } => {
                let (point, block) = saltelli::place(index, k, *second_order);
                Role::Saltelli { point, block }
            }
            Design::Morris { levels, .. } => {
                let (path, step) = Trajectory::of_sample(index, k, *levels, seed);
                Role::Morris { trajectory: path.number, step, changed: path.change(step) }
            }
            _ => Role::Sample,
        }
    }

    /// The coordinates of a sample, one for each parameter.
    pub(super) fn coordinates(&self, index: u64, of: &Study) -> Vec<Coordinate> {
        let k = of.parameters.len();
        let dimensions = 0..k as u32;
        match self {
            Design::Single => vec![Coordinate::Nominal; k],
            Design::FullFactorial => full_factorial(index, &of.levels()),
            Design::LatinHypercube { samples } => {
                dimensions.map(|d| Coordinate::Quantile(stratified(index, *samples, d, of.seed))).collect()
            }
            Design::MonteCarlo { .. } => {
                dimensions.map(|d| Coordinate::Quantile(unit(of.seed, Purpose::MonteCarlo, index, d))).collect()
            }
            Design::Sobol { scramble, .. } => (0..k)
                .map(|d| if *scramble { of.sobol.scrambled(index, d, of.seed) } else { of.sobol.plain(index, d) })
                .map(Coordinate::Quantile)
                .collect(),
            Design::OneAtATime { tail } => low_and_high(index, tail.si(), &of.levels()),
            Design::Table { rows, .. } => {
                let row = usize::try_from(index).ok().and_then(|i| rows.get(i));
                let row = row.cloned().unwrap_or_else(|| vec![Value::Base; k]);
                row.into_iter().map(Coordinate::Given).collect()
            }
            Design::Saltelli { second_order, .. } => {
                let (point, block) = saltelli::place(index, k, *second_order);
                (0..k)
                    .map(|d| block.column(d, k))
                    .map(|column| Coordinate::Quantile(of.sobol.scrambled(point, column, of.seed)))
                    .collect()
            }
            Design::Morris { levels, tail, .. } => {
                let (path, step) = Trajectory::of_sample(index, k, *levels, of.seed);
                (0..k).map(|d| Coordinate::Bounded(path.coordinate(d, step), tail.si())).collect()
            }
        }
    }
}

/// Sets the coordinates of crossed parameters to combination number `index` of their values.
pub(super) fn cross(index: u64, levels: &[Option<u64>], crossed: &[bool], coordinates: &mut [Coordinate]) {
    let own = levels.iter().zip(crossed).map(|(levels, crossed)| levels.filter(|_| *crossed).or(Some(1)));
    let levels = full_factorial(index, &own.collect::<Vec<_>>());
    let places = coordinates.iter_mut().zip(levels).zip(crossed);
    places.filter(|(_, crossed)| **crossed).for_each(|((coordinate, level), _)| *coordinate = level);
}

/// The digits of the index in a number system whose digits have as many values as the parameters, last digit first.
fn full_factorial(index: u64, levels: &[Option<u64>]) -> Vec<Coordinate> {
    let mut rest = index;
    let mut digits: Vec<Coordinate> = levels
        .iter()
        .rev()
        .map(|levels| {
            let n = levels.unwrap_or(1).max(1);
            let digit = rest % n;
            rest /= n;
            Coordinate::Level(digit)
        })
        .collect();
    digits.reverse();
    digits
}

/// u = (π(i) + jitter)/n: the stratum by a permutation of its own for each dimension.
fn stratified(index: u64, n: u64, dimension: u32, seed: u64) -> f64 {
    let stratum = permute(index, n, seed, dimension);
    let jitter = unit(seed, Purpose::Jitter, index, dimension);
    // rounding must not carry a sample over the edge of its stratum
    let u = (stratum as f64 + jitter) / n as f64;
    u.clamp(f64::EPSILON / 2.0, 1.0 - f64::EPSILON / 2.0)
}

/// The parameter that sample `index` varies, and to which of its values; none for the base scenario.
fn one_at_a_time(index: u64, levels: &[Option<u64>]) -> Option<(usize, u64)> {
    let mut rest = index.checked_sub(1)?;
    for (parameter, levels) in levels.iter().enumerate() {
        let n = levels.unwrap_or(2);
        if rest < n {
            return Some((parameter, rest));
        }
        rest -= n;
    }
    None
}

fn low_and_high(index: u64, tail: f64, levels: &[Option<u64>]) -> Vec<Coordinate> {
    let mut coordinates = vec![Coordinate::Nominal; levels.len()];
    if let Some((parameter, value)) = one_at_a_time(index, levels) {
        coordinates[parameter] = match levels[parameter] {
            Some(_) => Coordinate::Level(value),
            None => Coordinate::Bounded(value as f64, tail),
        };
    }
    coordinates
}
