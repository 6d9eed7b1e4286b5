//! Minimisation of a function on the unit cube, with the curvature at the minimum: the work of a fit.
//!
//! ```text
//! descend (global) ─ refine (local) ─ scan ─ Shape (curvature, correlations) ─ profile (intervals)
//! ```
//!
//! No derivatives are needed. Each stage requests whole batches of points, which a caller can evaluate in parallel. It
//! is deterministic: the same values lead to the same points, in any order of evaluation. So a caller that stores
//! values can repeat an interrupted search without computing anything twice.

mod bounds;
mod cma;
mod constrained;
mod descents;
mod modelled;
mod profile;
mod quadratic;
mod radial;
mod refine;
mod scan;
mod shape;

use nalgebra::{DMatrix, DVector, Dyn, SymmetricEigen};

pub use bounds::fold;
pub use cma::{Cma, Ending};
pub use constrained::{Found, Rank, Trial, Try, front, lower, search_within};
pub use descents::{Descent, Descents, Global, descend};
pub use modelled::Tried;
pub use profile::{End, Profiles, profile};
pub use refine::refine;
pub use scan::{Reach, scan};
pub use shape::Shape;

#[cfg(test)]
mod tests;

/// Purpose of a batch of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Points spread over the whole cube before the first descent.
    Sample,
    /// A round of candidates that a model of the earlier ones proposes, both counted from 0.
    Model {
        /// Number of the region.
        region: usize,
        /// Number of the round.
        round: usize,
    },
    /// A generation of a global descent, both counted from 0.
    Descent {
        /// Number of the descent.
        number: usize,
        /// Number of its generation.
        generation: usize,
    },
    /// A round of the local refinement.
    Refinement,
    /// Reach of each coordinate alone.
    Scan,
    /// Curvature at the minimum.
    Shape,
    /// Reach of each coordinate while the others are re-optimised.
    Profile,
}

/// A point of the unit cube and the value there.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Coordinates from 0 to 1.
    pub at: Vec<f64>,
    /// The value.
    pub value: f64,
}

impl Point {
    /// The point clamped to the cube; a NaN coordinate becomes ½.
    fn in_cube(mut self) -> Point {
        self.at.iter_mut().for_each(|u| *u = if u.is_nan() { 0.5 } else { u.clamp(0.0, 1.0) });
        self
    }

    /// The lower of the two; this one if equal.
    fn lower(self, other: Point) -> Point {
        if other.value < self.value { other } else { self }
    }
}

/// Eigenvalues and eigenvectors; those of the unit matrix if any entry is not finite. Empty if every coordinate is at a
/// bound.
fn eigen(matrix: DMatrix<f64>) -> SymmetricEigen<f64, Dyn> {
    let n = matrix.nrows();
    if n == 0 {
        return SymmetricEigen { eigenvectors: matrix, eigenvalues: DVector::zeros(0) };
    }
    if matrix.iter().all(|x| x.is_finite()) {
        matrix.symmetric_eigen()
    } else {
        DMatrix::identity(n, n).symmetric_eigen()
    }
}

/// Values of a batch of points in order, or the reason to stop the search. Points beyond the returned values have none.
pub type Evaluate<'a, E> = dyn FnMut(Stage, &[Vec<f64>]) -> Result<Vec<f64>, E> + 'a;

/// Points with their values.
fn evaluated<E>(stage: Stage, points: Vec<Vec<f64>>, evaluate: &mut Evaluate<'_, E>) -> Result<Vec<Point>, E> {
    if points.is_empty() {
        return Ok(Vec::new());
    }
    let values = evaluate(stage, &points)?;
    let pair = |(at, value)| Point { at, value };
    let values = values.into_iter().chain(std::iter::repeat(f64::NAN));
    Ok(points.into_iter().zip(values).map(pair).collect())
}
