//! How sharply the least value is determined: curvature at the size of what matters, correlations, flat directions.

use nalgebra::DMatrix;

use super::quadratic::{Bowl, explore};
use super::{Evaluate, Point, Reach, Stage, eigen};

/// Quadratic model at the minimum, over the coordinates that are not at a bound.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The coordinates.
    pub free: Vec<usize>,
    /// Reach of each coordinate alone, mean of down and up.
    pub lengths: Vec<f64>,
    /// Curvature in units of `lengths` and of the rise: 2 on its diagonal for an exact quadratic.
    pub curvature: DMatrix<f64>,
    /// Covariance: the square root of its diagonal is the reach of a coordinate while the others are re-optimised.
    pub covariance: DMatrix<f64>,
    /// Principal directions, flattest first: displacement of the coordinates at which the value has risen.
    pub directions: Vec<Vec<f64>>,
}

/// Least eigenvalue that finite differences can resolve, where a single coordinate has 2.
const FLATTEST: f64 = 1e-5;

impl Shape {
    /// The shape around `centre`, from points where the value rises by `rise`. A coordinate at a bound beyond which the
    /// value would fall further is left out. Also the lowest point found.
    ///
    /// # Errors
    /// An error of `evaluate`.
    pub fn look<E>(
        centre: &Point,
        reaches: &[[Reach; 2]],
        rise: f64,
        evaluate: &mut Evaluate<'_, E>,
    ) -> Result<(Shape, Point), E> {
        let centre = &centre.clone().in_cube();
        let reaches = &reaches[..reaches.len().min(centre.at.len())];
        let lengths: Vec<f64> = reaches.iter().map(length).collect();
        let n = lengths.len();
        let free: Vec<usize> = (0..n).filter(|i| !at_wall(centre.at[*i])).collect();
        let (bowl, met) = explore(Stage::Shape, centre, &lengths, &free, evaluate)?;
        let lowest = met.into_iter().fold(centre.clone(), Point::lower);
        Ok((Shape::of(&bowl, lengths, rise), lowest))
    }

    fn of(bowl: &Bowl, lengths: Vec<f64>, rise: f64) -> Shape {
        let n = bowl.free.len();
        let curvature = bowl.rising(&lengths, FLATTEST * rise) / rise;
        let eigen = eigen(curvature.clone());
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let length = |k: usize| lengths[bowl.free[k]];
        // ½ λ s² = 1
        let reach = |e: usize| (2.0 / eigen.eigenvalues[e].max(FLATTEST)).sqrt();
        let along = |e: usize, k: usize| eigen.eigenvectors[(k, e)] * reach(e) * length(k);
        let directions = order.iter().map(|e| (0..n).map(|k| along(*e, k)).collect()).collect();
        let covariance =
            DMatrix::from_fn(n, n, |i, j| order.iter().fold(0.0, |sum, e| sum + along(*e, i) * along(*e, j)));
        Shape { free: bowl.free.clone(), lengths, curvature, covariance, directions }
    }

    /// Whether it belongs to a cube with this many coordinates.
    pub(super) fn is_of(&self, coordinates: usize) -> bool {
        let n = self.free.len();
        let is_square = |matrix: &DMatrix<f64>| matrix.shape() == (n, n);
        self.lengths.len() == coordinates
            && self.free.iter().all(|i| *i < coordinates)
            && is_square(&self.curvature)
            && is_square(&self.covariance)
    }

    /// Index of a coordinate among the free ones.
    pub fn place(&self, coordinate: usize) -> Option<usize> {
        self.free.iter().position(|f| *f == coordinate)
    }

    /// Correlation of two coordinates among near-optimal points; none if one is at a bound.
    pub fn correlation(&self, a: usize, b: usize) -> Option<f64> {
        let (i, j) = (self.place(a)?, self.place(b)?);
        let c = &self.covariance;
        let r = c[(i, j)] / (c[(i, i)] * c[(j, j)]).sqrt();
        r.is_finite().then(|| r.clamp(-1.0, 1.0))
    }
}

/// Whether a coordinate is at a bound.
pub(super) fn at_wall(u: f64) -> bool {
    !(1e-6..=1.0 - 1e-6).contains(&u)
}

/// Mean of the two reaches; one cut short by a bound is ignored.
fn length(reaches: &[Reach; 2]) -> f64 {
    let [down, up] = reaches;
    let mean = match (down.open, up.open) {
        (true, false) => up.length,
        (false, true) => down.length,
        _ => 0.5 * (down.length + up.length),
    };
    mean.clamp(1e-9, 1.0)
}
