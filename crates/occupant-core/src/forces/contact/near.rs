//! Which of many bounded objects are near each other: axis-aligned boxes, swept along the axis of largest spread.

use nalgebra::{Point3, Vector3};

/// The least box along the axes that holds something, m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    least: Vector3<f64>,
    most: Vector3<f64>,
}

impl Bounds {
    /// That of points; of none it is empty and near nothing.
    pub(crate) fn of<'a>(points: impl IntoIterator<Item = &'a Point3<f64>>) -> Self {
        points.into_iter().fold(Bounds::NONE, |all, p| all.and(Bounds { least: p.coords, most: p.coords }))
    }

    /// That of a ball.
    pub(crate) fn ball(centre_m: &Point3<f64>, radius_m: f64) -> Self {
        let arm = Vector3::repeat(radius_m);
        Bounds { least: centre_m.coords - arm, most: centre_m.coords + arm }
    }

    /// That of nothing.
    pub(crate) const NONE: Bounds = {
        let (least, most) = (f64::INFINITY, f64::NEG_INFINITY);
        Bounds { least: Vector3::new(least, least, least), most: Vector3::new(most, most, most) }
    };

    /// That of both.
    pub(crate) fn and(self, other: Bounds) -> Self {
        Bounds { least: self.least.inf(&other.least), most: self.most.sup(&other.most) }
    }

    /// The same with so much room around.
    pub(crate) fn grown(self, by_m: f64) -> Self {
        let arm = Vector3::repeat(by_m);
        Bounds { least: self.least - arm, most: self.most + arm }
    }

    /// Whether it ends on all sides.
    pub(crate) fn is_bounded(&self) -> bool {
        (0..3).all(|i| self.least[i].is_finite() && self.most[i].is_finite())
    }

    /// How far a point is beyond the side that it is farthest beyond, m, negative inside; the axis, and 1 for its upper end.
    pub(crate) fn beyond_m(&self, point: &Point3<f64>) -> (f64, usize, usize) {
        let sides = (0..3).flat_map(|i| [(self.least[i] - point[i], i, 0), (point[i] - self.most[i], i, 1)]);
        sides.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::NAN, 0, 0))
    }

    /// Whether a point is farther than `by_m` beyond any side.
    pub(crate) fn is_beyond(&self, point: &Point3<f64>, by_m: f64) -> bool {
        (0..3).any(|i| self.least[i] - point[i] > by_m || point[i] - self.most[i] > by_m)
    }

    /// How far a point is from it, m.
    pub(crate) fn distance_m(&self, point: &Point3<f64>) -> f64 {
        (point.coords.sup(&self.least).inf(&self.most) - point.coords).norm()
    }

    /// Its upper end along an axis, m.
    pub(crate) fn most_along(&self, axis: usize) -> f64 {
        self.most[axis]
    }

    /// Whether it is at most so far from another along every axis.
    pub(crate) fn is_near(&self, other: &Self, gap_m: f64) -> bool {
        (0..3).all(|i| self.least[i] <= other.most[i] + gap_m && other.least[i] <= self.most[i] + gap_m)
    }
}

/// Pairs that are near each other.
pub(crate) struct NearPairs {
    /// Indices, the first before the second; in ascending order.
    pub pairs: Vec<[usize; 2]>,
    /// Whether these are all: of so many that their number grows with the square of the things only some are listed.
    pub is_complete: bool,
}

/// Pairs of boxes at most `gap_m` apart on every axis that `matter`.
pub(crate) fn near_pairs(boxes: &[Bounds], gap_m: f64, matter: impl Fn(usize, usize) -> bool) -> NearPairs {
    let most = 10_000 + 20 * boxes.len();
    let spread = |axis: usize| {
        let (least, greatest) = boxes.iter().fold((f64::MAX, f64::MIN), |(a, b), own| {
            let middle = 0.5 * (own.least[axis] + own.most[axis]);
            if middle.is_finite() { (a.min(middle), b.max(middle)) } else { (a, b) }
        });
        greatest - least
    };
    let axis = (0..3).max_by(|a, b| spread(*a).total_cmp(&spread(*b))).unwrap_or_default();
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    order.sort_by(|i, j| boxes[*i].least[axis].total_cmp(&boxes[*j].least[axis]));
    let (mut pairs, mut is_complete) = (Vec::new(), true);
    for (at, &i) in order.iter().enumerate() {
        for &j in order[at + 1..].iter().take_while(|j| boxes[**j].least[axis] <= boxes[i].most[axis] + gap_m) {
            let (first, second) = (i.min(j), i.max(j));
            if matter(first, second) && boxes[i].is_near(&boxes[j], gap_m) {
                pairs.push([first, second]);
            }
        }
        is_complete = pairs.len() <= most;
        if !is_complete {
            break;
        }
    }
    pairs.sort_unstable();
    NearPairs { pairs, is_complete }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes with pseudo-random places and sizes.
    fn boxes(count: usize, size_m: f64) -> Vec<Bounds> {
        let mut seed = 1u64;
        let mut next = move || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..count).map(|_| Bounds::ball(&Point3::new(next(), 3.0 * next(), next()), size_m * next())).collect()
    }

    #[test]
    fn the_sweep_finds_what_all_pairs_show() {
        let boxes = boxes(300, 0.1);
        let found = near_pairs(&boxes, 0.01, |i, j| (i + j) % 3 != 0);
        let all = (0..boxes.len()).flat_map(|i| (i + 1..boxes.len()).map(move |j| [i, j]));
        let expected: Vec<_> = all.filter(|[i, j]| (i + j) % 3 != 0 && boxes[*i].is_near(&boxes[*j], 0.01)).collect();
        assert!(found.is_complete && expected.len() > 100);
        assert_eq!(found.pairs, expected);
    }

    #[test]
    fn a_point_is_beyond_a_box_where_it_is_beyond_a_side() {
        let room = Bounds::ball(&Point3::new(0.5, 1.5, 0.5), 0.4);
        let beyond = boxes(300, 0.2).into_iter().map(|own| {
            let point = Point3::from(0.5 * (own.least + own.most));
            let is_beyond = room.is_beyond(&point, 0.1);
            assert_eq!(is_beyond, room.beyond_m(&point).0 > 0.1, "{point}");
            usize::from(is_beyond)
        });
        assert!((20..280).contains(&beyond.sum::<usize>()));
    }

    #[test]
    fn a_crowd_is_said_to_be_one() {
        assert!(!near_pairs(&boxes(1000, 9.0), 0.0, |_, _| true).is_complete);
        assert!(near_pairs(&boxes(100, 9.0), 0.0, |_, _| true).is_complete);
    }
}
