//! Periodic curves: the limit of a joint over the azimuth.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use crate::forces::function::Cubic;
use crate::motion::scalar::Scalar;

/// Piecewise cubic curve; the first and the last piece extend without end.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve<S> {
    pieces: Vec<Cubic<S>>,
}

impl<S: Copy> Curve<S> {
    /// Number of pieces; curves with equal numbers can be computed side by side.
    pub(super) fn len(&self) -> usize {
        self.pieces.len()
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &Curve<A>, f: &impl Fn(S, A) -> T) -> Curve<T> {
        Curve { pieces: self.pieces.iter().zip(&other.pieces).map(|(a, b)| a.zip(b, f)).collect() }
    }
}

impl<S: Scalar> Curve<S> {
    #[inline(always)]
    fn piece(&self, x: S) -> Cubic<S> {
        let Some((first, others)) = self.pieces.split_first() else { return Cubic::none() };
        let later = |found: Cubic<S>, next: &Cubic<S>| {
            let before = x.lt(next.from);
            found.zip(next, &|a, b| S::select(before, a, b))
        };
        others.iter().fold(*first, later)
    }

    /// Value and slope of a periodic curve at an angle of −π to π.
    #[inline(always)]
    pub fn around(&self, angle: S) -> (S, S) {
        let first = self.pieces.first().map_or(S::zero(), |piece| piece.from);
        let x = S::select(angle.lt(first), angle + S::of(TAU), angle);
        let piece = self.piece(x);
        (piece.value(x), piece.slope(x))
    }
}

impl Curve<f64> {
    /// Constant curve.
    pub fn constant(value: f64) -> Self {
        Curve { pieces: vec![Cubic { from: -std::f64::consts::PI, c: [value, 0.0, 0.0, 0.0] }] }
    }

    /// Periodic cubic spline of period 2π through points with rising x within one period; NaN without points.
    pub fn periodic(points: &[[f64; 2]]) -> Self {
        if points.is_empty() {
            return Curve::constant(f64::NAN);
        }
        let count = points.len();
        let next = |i: usize| (i + 1) % count;
        let length = |i: usize| points[next(i)][0] - points[i][0] + if next(i) == 0 { TAU } else { 0.0 };
        let rise = |i: usize| (points[next(i)][1] - points[i][1]) / length(i);
        // h_i M_i + 2 (h_i + h_{i+1}) M_{i+1} + h_{i+1} M_{i+2} = 6 (slope_{i+1} − slope_i)
        let (mut matrix, mut right) = (DMatrix::<f64>::zeros(count, count), DVector::zeros(count));
        for i in 0..count {
            let (j, k) = (next(i), next(next(i)));
            matrix[(i, i)] += length(i);
            matrix[(i, j)] += 2.0 * (length(i) + length(j));
            matrix[(i, k)] += length(j);
            right[i] = 6.0 * (rise(j) - rise(i));
        }
        let second = matrix.lu().solve(&right).unwrap_or_else(|| DVector::from_element(count, f64::NAN));
        let piece = |i: usize| {
            let (m, n, h) = (second[i], second[next(i)], length(i));
            let cubic = [points[i][1], rise(i) - h * (2.0 * m + n) / 6.0, 0.5 * m, (n - m) / (6.0 * h)];
            Cubic { from: points[i][0], c: cubic }
        };
        Curve { pieces: (0..count).map(piece).collect() }
    }

    /// Least and largest value of a periodic curve, on a fine grid.
    pub(super) fn bounds(&self) -> [f64; 2] {
        let angles = (-720..720).map(|i| f64::from(i) * TAU / 1440.0);
        let values = angles.map(|angle| self.around(angle).0);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], v| [least.min(v), most.max(v)])
    }

    /// Whether a periodic curve is even, on a fine grid.
    pub(super) fn is_even(&self) -> bool {
        let angles = (0..720).map(|i| f64::from(i) * TAU / 1440.0);
        angles.into_iter().all(|angle| (self.around(angle).0 - self.around(-angle).0).abs() < 1e-6)
    }
}
