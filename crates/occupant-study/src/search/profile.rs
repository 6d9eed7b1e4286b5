//! How far each coordinate can move while all others adapt, until the value has risen by a given amount: the ends of a
//! profile interval, from evaluated values and not from the quadratic model.
//!
//! All coordinates and both sides advance in parallel. Each chain sets its own coordinate, moves the others to their
//! minimum (a Newton step with the curvature at the optimum and slopes by differences), and moves forward or back until
//! it has the required rise.

use nalgebra::DMatrix;

use super::bounds::{SIDES, room};
use super::quadratic::lowest_step;
use super::shape::Shape;
use super::{Evaluate, Point, Reach, Stage, evaluated};

/// End of an interval.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// The coordinate there.
    pub at: f64,
    /// Whether the bound was reached before the value had risen.
    pub open: bool,
    /// All coordinates there and the value.
    pub point: Point,
}

/// The ends of all intervals.
#[derive(Clone, Debug, PartialEq)]
pub struct Profiles {
    /// By coordinate: lower and upper end.
    pub ends: Vec<[End; 2]>,
    /// The lowest point found.
    pub lowest: Point,
}

const ROUNDS: usize = 8;
/// Re-optimisations of the others per position of a coordinate.
const WALKS: usize = 2;
/// Relative tolerance of the rise at an end.
const GOOD: f64 = 0.1;
const PARTS: [f64; 3] = [0.4, 1.0, 2.0];

struct Chain {
    coordinate: usize,
    side: f64,
    room: f64,
    /// Distance of the coordinate from the centre.
    t: f64,
    /// Displacements of the others per unit of t.
    follow: Vec<f64>,
    best: Point,
    /// Brackets: distances at which the rise is too small and too large, with the rises.
    low: (f64, f64),
    high: Option<(f64, f64)>,
    /// The point at `low` or `high` whose rise is nearest to the target.
    end: Option<End>,
    done: bool,
}

/// The intervals of all coordinates of `centre`; they are open, and nothing is evaluated, where reaches or shape are of other
/// coordinates.
///
/// # Errors
/// An error of `evaluate`.
pub fn profile<E>(
    centre: &Point,
    reaches: &[[Reach; 2]],
    shape: &Shape,
    rise: f64,
    evaluate: &mut Evaluate<'_, E>,
) -> Result<Profiles, E> {
    let centre = &centre.clone().in_cube();
    let n = centre.at.len();
    if reaches.len() != n || !shape.is_of(n) {
        let open = |at: &f64| [(); 2].map(|()| End { at: *at, open: true, point: centre.clone() });
        return Ok(Profiles { ends: centre.at.iter().map(open).collect(), lowest: centre.clone() });
    }
    let mut chains: Vec<Chain> =
        (0..centre.at.len()).flat_map(|i| [0, 1].map(|s| Chain::new(i, s, centre, &reaches[i], shape))).collect();
    for _ in 0..ROUNDS {
        begin(&mut chains, centre, evaluate)?;
        for _ in 0..WALKS {
            walk(&mut chains, shape, rise, evaluate)?;
        }
        for chain in chains.iter_mut().filter(|c| !c.done) {
            chain.see(centre, rise);
        }
    }
    let lowest = chains.iter().map(|c| c.best.clone()).fold(centre.clone(), Point::lower);
    let ends = chains.chunks(2).map(|both| [both[0].end(centre), both[1].end(centre)]);
    Ok(Profiles { ends: ends.collect(), lowest })
}

/// Sets every coordinate, and displaces the others as before.
fn begin<E>(chains: &mut [Chain], centre: &Point, evaluate: &mut Evaluate<'_, E>) -> Result<(), E> {
    let mut active: Vec<&mut Chain> = chains.iter_mut().filter(|c| !c.done).collect();
    let points = active.iter().map(|c| c.guess(centre)).collect();
    let points = evaluated(Stage::Profile, points, evaluate)?;
    for (chain, point) in active.iter_mut().zip(points) {
        chain.best = point;
    }
    Ok(())
}

/// One re-optimisation step of the others of every chain.
fn walk<E>(chains: &mut [Chain], shape: &Shape, rise: f64, evaluate: &mut Evaluate<'_, E>) -> Result<(), E> {
    let others = |c: &Chain| -> Vec<usize> {
        let free = 0..shape.free.len();
        free.filter(|k| shape.free[*k] != c.coordinate).collect()
    };
    let has_others = |c: &&mut Chain| !c.done && !others(c).is_empty();
    let mut active: Vec<&mut Chain> = chains.iter_mut().filter(has_others).collect();
    let mut asked = Vec::new();
    let mut lengths = Vec::new();
    for chain in &active {
        for k in others(chain) {
            let (i, mut pair) = (shape.free[k], [0.0; 2]);
            for (side, length) in SIDES.into_iter().zip(&mut pair) {
                let u = chain.best.at[i];
                *length = (0.5 * shape.lengths[i]).min(room(side, u));
                let mut at = chain.best.at.clone();
                at[i] = (u + side * *length).clamp(0.0, 1.0);
                asked.push(at);
            }
            lengths.push(pair);
        }
    }
    let star = evaluated(Stage::Profile, asked, evaluate)?;
    let (mut star, mut lengths) = (star.chunks(2), lengths.into_iter());
    let mut asked = Vec::new();
    let mut met = Vec::new();
    for chain in &active {
        let others = others(chain);
        let mut slope = Vec::with_capacity(others.len());
        let mut lowest = chain.best.clone();
        for k in &others {
            let (Some([down, up]), Some([a, b])) = (star.next(), lengths.next()) else { continue };
            let span = (a + b).max(f64::MIN_POSITIVE);
            slope.push((up.value - down.value) / span * shape.lengths[shape.free[*k]] / rise);
            lowest = lowest.lower(down.clone()).lower(up.clone());
        }
        let step = chain.step(shape, &others, &slope);
        asked.extend(PARTS.map(|part| {
            let mut at = chain.best.at.clone();
            for (k, z) in others.iter().zip(&step) {
                let i = shape.free[*k];
                at[i] = (at[i] + part * z * shape.lengths[i]).clamp(0.0, 1.0);
            }
            at
        }));
        met.push(lowest);
    }
    let tried = evaluated(Stage::Profile, asked, evaluate)?;
    let tried = tried.chunks(PARTS.len());
    for ((chain, lowest), tried) in active.iter_mut().zip(met).zip(tried) {
        chain.best = tried.iter().cloned().fold(lowest, Point::lower);
    }
    Ok(())
}

impl Chain {
    fn new(i: usize, s: usize, centre: &Point, reaches: &[Reach; 2], shape: &Shape) -> Self {
        let side = SIDES[s];
        let room = room(side, centre.at[i]);
        let n = centre.at.len();
        let mut follow = vec![0.0; n];
        let mut t = reaches[s].length.max(0.0);
        if let Some(k) = shape.place(i) {
            let c = &shape.covariance;
            for (l, j) in shape.free.iter().enumerate() {
                follow[*j] = c[(l, k)] / c[(k, k)];
            }
            t = t.max(c[(k, k)].sqrt());
        }
        Chain {
            coordinate: i,
            side,
            room,
            t: t.min(room),
            follow,
            best: centre.clone(),
            low: (0.0, 0.0),
            high: None,
            end: None,
            done: room < 1e-9,
        }
    }

    fn guess(&self, centre: &Point) -> Vec<f64> {
        let t = self.side * self.t;
        let mut at: Vec<f64> = centre.at.iter().zip(&self.follow).map(|(u, f)| (u + f * t).clamp(0.0, 1.0)).collect();
        at[self.coordinate] = (centre.at[self.coordinate] + t).clamp(0.0, 1.0);
        at
    }

    /// The step of the others to the minimum of the quadratic model, in units of the lengths.
    fn step(&self, shape: &Shape, others: &[usize], slope: &[f64]) -> Vec<f64> {
        let n = others.len();
        if slope.len() != n || n == 0 {
            return vec![0.0; n];
        }
        let curvature = DMatrix::from_fn(n, n, |a, b| shape.curvature[(others[a], others[b])]);
        let walls: Vec<[f64; 2]> = others
            .iter()
            .map(|k| {
                let i = shape.free[*k];
                let (u, length) = (self.best.at[i], shape.lengths[i]);
                [-u / length, (1.0 - u) / length]
            })
            .collect();
        lowest_step(slope, &curvature, &walls)
    }

    /// Records the rise at t with the others at their minimum, and chooses the next t.
    fn see(&mut self, centre: &Point, rise: f64) {
        let t = self.t;
        let risen = (self.best.value - centre.value) / rise;
        let moved = self.side * t;
        for (j, f) in self.follow.iter_mut().enumerate() {
            *f = (self.best.at[j] - centre.at[j]) / moved;
        }
        let end = End { at: self.best.at[self.coordinate], open: false, point: self.best.clone() };
        if risen < 1.0 && t >= self.room {
            self.end = Some(End { open: true, ..end });
            self.done = true;
            return;
        }
        if (risen - 1.0).abs() < GOOD {
            self.end = Some(end);
            self.done = true;
            return;
        }
        if risen < 1.0 {
            self.low = (t, risen.max(0.0))
        } else {
            self.high = Some((t, risen))
        }
        self.end = Some(end);
        let guess = t / risen.max(1e-6).sqrt();
        self.t = match self.high {
            None => guess.clamp(1.3 * t, 5.0 * t).min(self.room),
            Some((high, above)) => {
                let (low, below) = self.low;
                let (a, b) = (below.sqrt(), above.sqrt());
                // between the brackets the root of the rise is a straight line, unless the value stays flat up to the wall
                // of another coordinate and rises only there
                let part = if low > 0.0 && below < 0.05 { 0.5 } else { ((1.0 - a) / (b - a)).clamp(0.1, 0.9) };
                low + part * (high - low)
            }
        };
    }

    /// The end, interpolated between its brackets if the rise was not met closely.
    fn end(&self, centre: &Point) -> End {
        let Some(end) = &self.end else {
            return End { at: centre.at[self.coordinate], open: true, point: centre.clone() };
        };
        let mut end = end.clone();
        if !self.done {
            end.at = (centre.at[self.coordinate] + self.side * self.t).clamp(0.0, 1.0);
        }
        end
    }
}
