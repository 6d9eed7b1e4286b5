//! A model of functions known at scattered points: cubic radial basis functions with a linear tail.
//!
//! ```text
//! f(x) = Σᵢ wᵢ |x − xᵢ|³ + c₀ + c·x      with Σᵢ wᵢ = 0 and Σᵢ wᵢ xᵢ = 0
//! ```
//!
//! It passes through all points and has nothing to tune (M. J. D. Powell, "The theory of radial basis function approximation
//! in 1990", Advances in Numerical Analysis 2, 1992).

use nalgebra::DMatrix;

/// Points closer than this, in each coordinate, are one.
const SAME: f64 = 1e-9;

/// The model of several functions of the same points.
pub(super) struct Radial {
    points: Vec<Vec<f64>>,
    /// Weights of the points, then the constant, then the slopes; a column for each function.
    weights: DMatrix<f64>,
}

impl Radial {
    /// The model through `values[i]`, one for each function, at `points[i]`. None with too few points.
    pub(super) fn through(points: &[&[f64]], values: &[Vec<f64>]) -> Option<Radial> {
        let functions = values.first()?.len();
        let n = points.first()?.len();
        let mut kept: Vec<usize> = Vec::new();
        for i in 0..points.len().min(values.len()) {
            if !kept.iter().any(|k| apart(points[*k], points[i]) < SAME) {
                kept.push(i);
            }
        }
        let m = kept.len();
        if m < n + 2 {
            return None;
        }
        let linear = |i: usize, j: usize| if j == 0 { 1.0 } else { points[kept[i]][j - 1] };
        let matrix = DMatrix::from_fn(m + n + 1, m + n + 1, |i, j| match (i < m, j < m) {
            (true, true) => cube(points[kept[i]], points[kept[j]]),
            (true, false) => linear(i, j - m),
            (false, true) => linear(j, i - m),
            (false, false) => 0.0,
        });
        let known = DMatrix::from_fn(m + n + 1, functions, |i, k| if i < m { values[kept[i]][k] } else { 0.0 });
        let weights = matrix.lu().solve(&known).filter(|weights| weights.iter().all(|w| w.is_finite()))?;
        Some(Radial { points: kept.iter().map(|i| points[*i].to_vec()).collect(), weights })
    }

    /// The values of all functions at a point.
    pub(super) fn at(&self, x: &[f64]) -> Vec<f64> {
        let m = self.points.len();
        let cubes: Vec<f64> = self.points.iter().map(|point| cube(point, x)).collect();
        let of = |k: usize| {
            let w = |i: usize| self.weights[(i, k)];
            let near = cubes.iter().enumerate().fold(0.0, |sum, (i, cube)| sum + w(i) * cube);
            x.iter().enumerate().fold(near + w(m), |sum, (j, x)| sum + w(m + 1 + j) * x)
        };
        (0..self.weights.ncols()).map(of).collect()
    }
}

/// Largest difference of a coordinate.
pub(super) fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

/// Square of the distance.
pub(super) fn squares(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (a, b)| sum + (a - b) * (a - b))
}

fn cube(a: &[f64], b: &[f64]) -> f64 {
    let square = squares(a, b);
    square * square.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::of_resample;

    fn points(count: u64, n: u32) -> Vec<Vec<f64>> {
        (0..count).map(|i| (0..n).map(|d| of_resample(i, d)).collect()).collect()
    }

    #[test]
    fn it_passes_through_its_points_and_keeps_a_plane() {
        let all = points(40, 5);
        let refs: Vec<&[f64]> = all.iter().map(Vec::as_slice).collect();
        let plane = |x: &[f64]| 3.0 + x.iter().enumerate().map(|(i, x)| (i as f64 - 2.0) * x).sum::<f64>();
        let bowl = |x: &[f64]| x.iter().map(|x| (x - 0.4) * (x - 0.4)).sum::<f64>();
        let values: Vec<Vec<f64>> = all.iter().map(|x| vec![plane(x), bowl(x)]).collect();
        let model = Radial::through(&refs, &values).unwrap();
        for (x, known) in all.iter().zip(&values) {
            let found = model.at(x);
            assert!(found.iter().zip(known).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} {known:?}");
        }
        for x in points(60, 5).iter().skip(40) {
            let found = model.at(x);
            assert!((found[0] - plane(x)).abs() < 1e-9);
            assert!((found[1] - bowl(x)).abs() < 0.1, "{} {}", found[1], bowl(x));
        }
    }

    #[test]
    fn points_that_show_too_little_have_no_model() {
        let all = points(6, 5);
        let refs: Vec<&[f64]> = all.iter().map(Vec::as_slice).collect();
        assert!(Radial::through(&refs, &vec![vec![1.0]; 6]).is_none());
        let same: Vec<&[f64]> = vec![&all[0]; 20];
        assert!(Radial::through(&same, &vec![vec![1.0]; 20]).is_none());
        assert!(Radial::through(&[], &[]).is_none());
    }
}
