//! Piecewise cubics: torque over what a joint is bent beyond its limit, and the limit over the azimuth.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use crate::motion::scalar::Scalar;

/// A curve of cubics, the first of which reaches down and the last up without end.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curve<S> {
    pieces: Vec<Piece<S>>,
}

/// c₀ + c₁s + c₂s² + c₃s³ in s = x − `from`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece<S> {
    from: S,
    c: [S; 4],
    /// ∫ of the curve from its first `from` to this one.
    area: S,
}

impl<S: Copy> Piece<S> {
    #[inline(always)]
    fn zip<A: Copy, T>(&self, other: &Piece<A>, f: &impl Fn(S, A) -> T) -> Piece<T> {
        let ([p, q, r, s], [t, u, v, w]) = (self.c, other.c);
        let c = [f(p, t), f(q, u), f(r, v), f(s, w)];
        Piece { from: f(self.from, other.from), c, area: f(self.area, other.area) }
    }
}

impl<S: Scalar> Piece<S> {
    #[inline(always)]
    fn value(&self, x: S) -> S {
        let ([c0, c1, c2, c3], s) = (self.c, x - self.from);
        c0 + (c1 + (c2 + c3 * s) * s) * s
    }

    #[inline(always)]
    fn slope(&self, x: S) -> S {
        let ([_, c1, c2, c3], s) = (self.c, x - self.from);
        c1 + (c2 * S::of(2.0) + c3 * (S::of(3.0) * s)) * s
    }

    #[inline(always)]
    fn area(&self, x: S) -> S {
        let ([c0, c1, c2, c3], s) = (self.c, x - self.from);
        self.area + (c0 + (c1 * S::of(0.5) + (c2 * S::of(1.0 / 3.0) + c3 * (S::of(0.25) * s)) * s) * s) * s
    }
}

impl<S: Copy> Curve<S> {
    /// How many pieces it has; curves of equally many can be computed side by side.
    pub(super) fn len(&self) -> usize {
        self.pieces.len()
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &Curve<A>, f: &impl Fn(S, A) -> T) -> Curve<T> {
        Curve { pieces: self.pieces.iter().zip(&other.pieces).map(|(a, b)| a.zip(b, f)).collect() }
    }
}

impl<S: Scalar> Curve<S> {
    #[inline(always)]
    fn piece(&self, x: S) -> Piece<S> {
        let Some((first, others)) = self.pieces.split_first() else { return Curve::none() };
        let later = |found: Piece<S>, next: &Piece<S>| {
            let before = x.lt(next.from);
            found.zip(next, &|a, b| S::select(before, a, b))
        };
        others.iter().fold(*first, later)
    }

    fn none() -> Piece<S> {
        Piece { from: S::zero(), c: [S::zero(); 4], area: S::zero() }
    }

    /// Value at x.
    #[inline(always)]
    pub(crate) fn value(&self, x: S) -> S {
        self.piece(x).value(x)
    }

    /// ∫ from where the curve begins to x.
    #[inline(always)]
    pub(super) fn area(&self, x: S) -> S {
        self.piece(x).area(x)
    }

    /// Value and slope of a periodic curve at an angle of −π to π.
    #[inline(always)]
    pub(crate) fn around(&self, angle: S) -> (S, S) {
        let first = self.pieces.first().map_or(S::zero(), |piece| piece.from);
        let x = S::select(angle.lt(first), angle + S::of(TAU), angle);
        let piece = self.piece(x);
        (piece.value(x), piece.slope(x))
    }
}

impl Curve<f64> {
    /// The same value everywhere.
    pub(crate) fn constant(value: f64) -> Self {
        Curve::of(vec![(-std::f64::consts::PI, [value, 0.0, 0.0, 0.0])])
    }

    /// c₁x + c₂x² + c₃x³.
    pub(crate) fn polynomial([c1, c2, c3]: [f64; 3]) -> Self {
        Curve::of(vec![(0.0, [0.0, c1, c2, c3])])
    }

    /// Straight lines through points with rising x; the last goes on.
    pub(crate) fn lines(points: &[[f64; 2]]) -> Self {
        let line =
            |(&[x, y], &[next_x, next_y]): (&[f64; 2], &[f64; 2])| (x, [y, (next_y - y) / (next_x - x), 0.0, 0.0]);
        Curve::of(points.iter().zip(points.iter().skip(1)).map(line).collect())
    }

    /// The periodic cubic spline of period 2π through points with x that rise within less than that.
    pub(crate) fn periodic(points: &[[f64; 2]]) -> Self {
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
            (points[i][0], cubic)
        };
        Curve::of((0..count).map(piece).collect())
    }

    fn of(cubics: Vec<(f64, [f64; 4])>) -> Self {
        let mut pieces: Vec<Piece<f64>> = Vec::with_capacity(cubics.len());
        for (from, c) in cubics {
            let area = pieces.last().map_or(0.0, |before| before.area(from));
            pieces.push(Piece { from, c, area });
        }
        Curve { pieces }
    }

    /// Least and greatest value of a periodic curve, on a fine grid.
    pub(super) fn bounds(&self) -> [f64; 2] {
        let angles = (-720..720).map(|i| f64::from(i) * TAU / 1440.0);
        let values = angles.map(|angle| self.around(angle).0);
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], v| [least.min(v), most.max(v)])
    }

    /// Whether a periodic curve is the same to both sides, on a fine grid.
    pub(super) fn is_even(&self) -> bool {
        let angles = (0..720).map(|i| f64::from(i) * TAU / 1440.0);
        angles.into_iter().all(|angle| (self.around(angle).0 - self.around(-angle).0).abs() < 1e-6)
    }

    /// The greatest slope up to x, and whether the curve falls anywhere on the way, on a fine grid.
    pub(super) fn steepness(&self, x: f64) -> (f64, bool) {
        let places = (0..=360).map(|i| x * f64::from(i) / 360.0);
        let slopes = places.map(|x| self.piece(x).slope(x));
        slopes.fold((0.0, false), |(most, falls), slope| (slope.max(most), falls || slope.is_nan() || slope < 0.0))
    }
}
