//! A bowl through values round a point: slope and curvature from differences.

use nalgebra::DMatrix;

use super::{Evaluate, Point, Stage, eigen, evaluated};

/// Quadratic model: gradient and curvature over some coordinates of the unit cube.
#[derive(Clone, Debug)]
pub struct Bowl {
    /// The coordinates.
    pub free: Vec<usize>,
    /// g.
    pub slope: Vec<f64>,
    /// A: the value is about F₀ + gᵀd + ½dᵀAd.
    pub curvature: DMatrix<f64>,
}

/// The two offsets of a coordinate: one on each side, or both on one side of a bound.
fn offsets(u: f64, length: f64) -> [f64; 2] {
    let (down, up) = (length.min(u), length.min(1.0 - u));
    if down >= 0.2 * up && up >= 0.2 * down {
        [-down, up]
    } else if up > down {
        [0.5 * up, up]
    } else {
        [-0.5 * down, -down]
    }
}

/// A quadratic model around `centre` through points at about `lengths` from it, and all points evaluated.
///
/// # Errors
/// An error of `evaluate`.
pub fn explore<E>(
    stage: Stage,
    centre: &Point,
    lengths: &[f64],
    free: &[usize],
    evaluate: &mut Evaluate<'_, E>,
) -> Result<(Bowl, Vec<Point>), E> {
    let n = free.len();
    let offsets: Vec<[f64; 2]> = free.iter().map(|i| offsets(centre.at[*i], lengths[*i])).collect();
    let moved = |moves: &[(usize, f64)]| {
        let mut at = centre.at.clone();
        for (k, offset) in moves {
            at[free[*k]] = (at[free[*k]] + offset).clamp(0.0, 1.0);
        }
        at
    };
    let mut asked = Vec::new();
    for (k, of) in offsets.iter().enumerate() {
        asked.extend(of.map(|o| moved(&[(k, o)])));
    }
    for k in 0..n {
        for l in 0..k {
            asked.extend([0, 1].map(|s| moved(&[(k, offsets[k][s]), (l, offsets[l][s])])));
        }
    }
    let points = evaluated(stage, asked, evaluate)?;
    let rise = |i: usize| points[i].value - centre.value;
    let mut slope = vec![0.0; n];
    let mut curvature = DMatrix::zeros(n, n);
    for (k, [a, b]) in offsets.iter().enumerate() {
        // F(a) − F₀ = g a + ½ A a², likewise b
        let (fa, fb) = (rise(2 * k) / a, rise(2 * k + 1) / b);
        curvature[(k, k)] = 2.0 * (fb - fa) / (b - a);
        slope[k] = fa - 0.5 * curvature[(k, k)] * a;
    }
    let mut pair = 2 * n;
    for k in 0..n {
        for l in 0..k {
            let mut mixed = 0.0;
            for (s, (a, b)) in offsets[k].iter().zip(&offsets[l]).enumerate() {
                let alone = rise(2 * k + s) + rise(2 * l + s);
                mixed += 0.5 * (rise(pair + s) - alone) / (a * b);
            }
            curvature[(k, l)] = mixed;
            curvature[(l, k)] = mixed;
            pair += 2;
        }
    }
    let free = free.to_vec();
    Ok((Bowl { free, slope, curvature }, points))
}

impl Bowl {
    /// The curvature in units of `lengths`, made positive definite: eigenvalues are raised to at least `least`.
    pub fn rising(&self, lengths: &[f64], least: f64) -> DMatrix<f64> {
        let n = self.free.len();
        let scale = |k: usize| lengths[self.free[k]];
        let scaled = DMatrix::from_fn(n, n, |i, j| self.curvature[(i, j)] * scale(i) * scale(j));
        let eigen = eigen(scaled);
        DMatrix::from_fn(n, n, |i, j| {
            (0..n).fold(0.0, |sum, e| {
                let along = eigen.eigenvectors[(i, e)] * eigen.eigenvectors[(j, e)];
                sum + along * eigen.eigenvalues[e].max(least)
            })
        })
    }
}

/// The step z that minimises gᵀz + ½zᵀAz within bounds, A positive definite, by coordinate descent.
pub fn lowest_step(slope: &[f64], curvature: &DMatrix<f64>, walls: &[[f64; 2]]) -> Vec<f64> {
    let n = slope.len();
    let mut z = vec![0.0; n];
    for _ in 0..500 {
        let mut moved = 0.0_f64;
        for i in 0..n {
            let pull = (0..n).fold(slope[i], |sum, j| sum + curvature[(i, j)] * z[j]);
            let next = (z[i] - pull / curvature[(i, i)]).max(walls[i][0]).min(walls[i][1]);
            moved = moved.max((next - z[i]).abs());
            z[i] = next;
        }
        if moved < 1e-12 {
            break;
        }
    }
    z
}
