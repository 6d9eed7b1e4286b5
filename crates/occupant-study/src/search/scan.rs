//! How far each coordinate can move alone until the value has risen by a given amount.

use super::bounds::{SIDES, room};
use super::{Evaluate, Point, Stage, evaluated};

/// Reach of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Distance, as a fraction of the cube.
    pub length: f64,
    /// Whether the bound was reached first.
    pub open: bool,
}

/// Largest number of rounds per reach.
const ROUNDS: usize = 14;
const FIRST: f64 = 0.02;
/// Tolerance factor of the rise at a reach.
const GOOD: f64 = 1.3;

/// Search for one reach.
struct Chain {
    coordinate: usize,
    side: f64,
    room: f64,
    next: f64,
    /// Distances at which the rise is too small and too large.
    low: f64,
    high: Option<f64>,
    found: Option<Reach>,
}

/// The reach of each coordinate of `centre`, down and up, and the lowest point found.
///
/// # Errors
/// An error of `evaluate`.
pub fn scan<E>(centre: &Point, rise: f64, evaluate: &mut Evaluate<'_, E>) -> Result<(Vec<[Reach; 2]>, Point), E> {
    let centre = &centre.clone().in_cube();
    let mut chains: Vec<Chain> =
        (0..centre.at.len()).flat_map(|i| SIDES.map(|side| Chain::new(i, side, centre))).collect();
    let mut lowest = centre.clone();
    for _ in 0..ROUNDS {
        let mut open: Vec<&mut Chain> = chains.iter_mut().filter(|c| c.found.is_none()).collect();
        let points = open.iter().map(|c| c.point(centre)).collect();
        let points = evaluated(Stage::Scan, points, evaluate)?;
        for (chain, point) in open.iter_mut().zip(points) {
            chain.see((point.value - centre.value) / rise);
            lowest = lowest.lower(point);
        }
    }
    let reaches = chains.chunks(2).map(|both| [both[0].reach(), both[1].reach()]);
    Ok((reaches.collect(), lowest))
}

impl Chain {
    fn new(coordinate: usize, side: f64, centre: &Point) -> Self {
        let room = room(side, centre.at[coordinate]);
        let none = Reach { length: 0.0, open: true };
        Chain {
            coordinate,
            side,
            room,
            next: FIRST.min(room),
            low: 0.0,
            high: None,
            found: (room < 1e-9).then_some(none),
        }
    }

    fn point(&self, centre: &Point) -> Vec<f64> {
        let mut at = centre.at.clone();
        let moved = at[self.coordinate] + self.side * self.next;
        at[self.coordinate] = moved.clamp(0.0, 1.0);
        at
    }

    /// Records the rise at `next`, as a fraction of the wanted one.
    fn see(&mut self, rise: f64) {
        let t = self.next;
        if rise < 1.0 && t >= self.room {
            self.found = Some(Reach { length: self.room, open: true });
        } else if (1.0 / GOOD..=GOOD).contains(&rise) {
            self.found = Some(Reach { length: t, open: false });
        }
        // a bowl rises with the square
        let guess = t / rise.max(1e-6).sqrt();
        if rise < 1.0 {
            self.low = t
        } else {
            self.high = Some(t)
        }
        self.next = match self.high {
            None => guess.clamp(1.5 * t, 6.0 * t).min(self.room),
            Some(high) if self.low > 0.0 => (self.low * high).sqrt(),
            Some(high) => guess.clamp(0.05 * high, 0.7 * high),
        };
    }

    fn reach(&self) -> Reach {
        self.found.unwrap_or(Reach { length: self.high.unwrap_or(self.low), open: false })
    }
}
