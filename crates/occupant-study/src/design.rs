//! The samples of a study: for every index the coordinate of each parameter, computed from the index alone.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Study;
use super::law::Value;
use super::morris::Trajectory;
use super::permutation::permute;
use super::random::{Purpose, unit};
use super::rows::Rows;
use super::saltelli::{self, Block};
use occupant_scenario::{POSITIVE, Ratio};

/// Design of a study: the choice of samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Design {
    /// The scenario itself: one sample.
    #[serde(skip)]
    Single,
    /// All combinations of all values. The last parameter changes fastest, as in nested loops in the order written.
    FullFactorial,
    /// Latin hypercube: each parameter's range is cut into as many parts of equal probability as there are samples;
    /// each part is used once.
    LatinHypercube {
        /// Number of samples.
        #[schemars(extend("minimum" = 1))]
        samples: u64,
    },
    /// Sobol's low-discrepancy sequence from its first point, scrambled.
    Sobol {
        /// Number of samples, preferably a power of 2.
        #[schemars(extend("minimum" = 1))]
        samples: u64,
        /// Whether the sequence is scrambled by the seed; true if absent.
        #[serde(default = "scrambled")]
        scramble: bool,
    },
    /// Independent random samples.
    MonteCarlo {
        /// Number of samples.
        #[schemars(extend("minimum" = 1))]
        samples: u64,
    },
    /// The base scenario, then each parameter alone at each of its values, or at its low and its high one.
    OneAtATime {
        /// Tail probability of a normal distribution below its low and above its high value; 0.05 if absent.
        #[serde(default = "usual_tail")]
        tail: Ratio<POSITIVE>,
    },
    /// Samples from a CSV or Parquet file, one row each.
    Table {
        /// CSV or Parquet file beside the study; its first line, or its columns, name parameters or paths with their units, such
        /// as `joints.neck.damping[in lbf s/rad],belts.lap.slack[mm]`.
        file: String,
        /// Values of the file, one row per sample, one value per parameter.
        #[serde(skip)]
        rows: Rows,
    },
    /// Blocks for Sobol's sensitivity indices: A, A with one column of B for each parameter, B.
    Saltelli {
        /// Number of points of A and B, preferably a power of 2. With k parameters, each takes k + 2 runs, or 2k + 2.
        #[schemars(extend("minimum" = 1))]
        samples: u64,
        /// Whether B with one column of A is also run, for second-order interactions; false if absent.
        #[serde(default)]
        second_order: bool,
    },
    /// Trajectories for Morris's screening, along which one parameter changes at a time.
    Morris {
        /// Number of trajectories, of k + 1 runs each with k parameters.
        #[schemars(extend("minimum" = 1))]
        trajectories: u64,
        /// Number of levels of each range, even; 4 if absent.
        #[schemars(extend("minimum" = 2))]
        #[serde(default = "usual_levels")]
        levels: u64,
        /// Tail probability of a normal distribution below its low and above its high level; 0.05 if absent.
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

/// Role of a sample in its design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// An ordinary sample.
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
        /// The block.
        block: Block,
    },
    /// In a Morris design.
    Morris {
        /// Index of the trajectory.
        trajectory: u64,
        /// Steps made so far, 0 at its start.
        step: usize,
        /// The parameter changed by the last step, and the signed change as a fraction of its range.
        changed: Option<(usize, f64)>,
    },
}

/// Position of a parameter's value in its law.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Coordinate {
    /// The base scenario's value.
    Nominal,
    /// Number of one of its levels.
    Level(u64),
    /// A probability.
    Quantile(f64),
    /// A probability, and the tail at which unbounded distributions are cut off.
    Bounded(f64, f64),
    /// A value given by the design.
    Given(Value),
}

impl Design {
    /// Number of samples, for parameters with these numbers of levels; none if more than 2⁵².
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
            Design::Saltelli { samples: points, .. } | Design::Morris { trajectories: points, .. } => {
                points.checked_mul(self.unit(k))
            }
        };
        len.filter(|n| *n <= 1 << 52)
    }

    /// Number of consecutive samples that belong together, with so many parameters.
    pub(super) fn unit(&self, parameters: u64) -> u64 {
        match self {
            Design::Saltelli { second_order, .. } => saltelli::block_len(parameters, *second_order),
            Design::Morris { .. } => parameters + 1,
            _ => 1,
        }
    }

    /// Whether its samples are drawn from the parameters' laws, one coordinate for each.
    pub(super) fn is_sampled(&self) -> bool {
        matches!(self, Design::LatinHypercube { .. } | Design::Sobol { .. } | Design::MonteCarlo { .. })
    }

    /// Role of a sample in its design.
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

    /// Coordinates of a sample, one per parameter.
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
                let row = usize::try_from(index).ok().and_then(|i| rows.row(i));
                let row = row.unwrap_or_else(|| vec![Value::Base; k]);
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

/// Sets the coordinates of crossed parameters to the combination of their values with this index.
pub(super) fn cross(index: u64, levels: &[Option<u64>], crossed: &[bool], coordinates: &mut [Coordinate]) {
    let own = levels.iter().zip(crossed).map(|(levels, crossed)| levels.filter(|_| *crossed).or(Some(1)));
    let levels = full_factorial(index, &own.collect::<Vec<_>>());
    let places = coordinates.iter_mut().zip(levels).zip(crossed);
    places.filter(|(_, crossed)| **crossed).for_each(|((coordinate, level), _)| *coordinate = level);
}

/// Digits of the index in the mixed radix of the parameters' numbers of values, last digit fastest.
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

/// u = (π(i) + jitter)/n: the stratum by a separate permutation for each dimension.
fn stratified(index: u64, n: u64, dimension: u32, seed: u64) -> f64 {
    let stratum = permute(index, n, seed, dimension);
    let jitter = unit(seed, Purpose::Jitter, index, dimension);
    // rounding must not carry a sample over the edge of its stratum
    let u = (stratum as f64 + jitter) / n as f64;
    u.clamp(f64::EPSILON / 2.0, 1.0 - f64::EPSILON / 2.0)
}

/// The parameter varied by sample `index`, and the number of its value; none for the base scenario.
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
