//! Cubic pieces of curves: c₀ + c₁s + c₂s² + c₃s³ in s = x − x₀.

use crate::motion::scalar::Scalar;

/// Cubic polynomial from x₀ on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cubic<S> {
    /// x₀.
    pub(crate) from: S,
    /// c₀ to c₃.
    pub(crate) c: [S; 4],
}

impl<S: Copy> Cubic<S> {
    #[inline(always)]
    pub(crate) fn zip<A: Copy, T>(&self, other: &Cubic<A>, f: &impl Fn(S, A) -> T) -> Cubic<T> {
        let ([p, q, r, s], [t, u, v, w]) = (self.c, other.c);
        Cubic { from: f(self.from, other.from), c: [f(p, t), f(q, u), f(r, v), f(s, w)] }
    }
}

impl<S: Scalar> Cubic<S> {
    pub(crate) fn none() -> Self {
        Cubic { from: S::zero(), c: [S::zero(); 4] }
    }

    #[inline(always)]
    pub(crate) fn value(&self, x: S) -> S {
        let ([c0, c1, c2, c3], s) = (self.c, x - self.from);
        c0 + (c1 + (c2 + c3 * s) * s) * s
    }

    #[inline(always)]
    pub(crate) fn slope(&self, x: S) -> S {
        let ([_, c1, c2, c3], s) = (self.c, x - self.from);
        c1 + (c2 * S::of(2.0) + c3 * (S::of(3.0) * s)) * s
    }

    /// ∫ from x₀ to x.
    #[inline(always)]
    pub(crate) fn work(&self, x: S) -> S {
        let ([c0, c1, c2, c3], s) = (self.c, x - self.from);
        (c0 + (c1 * S::of(0.5) + (c2 * S::of(1.0 / 3.0) + c3 * (S::of(0.25) * s)) * s) * s) * s
    }
}

impl Cubic<f64> {
    /// Straight line through a point.
    pub(crate) fn line([x, y]: [f64; 2], slope: f64) -> Self {
        Cubic { from: x, c: [y, slope, 0.0, 0.0] }
    }

    /// Straight lines through points with rising x.
    pub(crate) fn lines(points: &[[f64; 2]]) -> Vec<Self> {
        points.windows(2).map(|p| Cubic::line(p[0], secant(p))).collect()
    }

    /// Monotone cubic interpolation of points with rising x (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980).
    pub(crate) fn monotone(points: &[[f64; 2]]) -> Vec<Self> {
        let secants: Vec<f64> = points.windows(2).map(secant).collect();
        let inner = secants.windows(2).map(|d| if d[0] * d[1] > 0.0 { 0.5 * (d[0] + d[1]) } else { 0.0 });
        let [first, last] = [secants.first(), secants.last()].map(|d| d.copied().unwrap_or(0.0));
        let mut slopes: Vec<f64> = [first].into_iter().chain(inner).chain([last]).collect();
        for (i, d) in secants.iter().enumerate() {
            let [a, b] = [slopes[i], slopes[i + 1]];
            let square = a * a + b * b;
            let scale = if square > 9.0 * d * d { 3.0 * d.abs() / square.sqrt() } else { 1.0 };
            (slopes[i], slopes[i + 1]) = (a * scale, b * scale);
        }
        let cubic = |(i, p): (usize, &[[f64; 2]])| {
            let (h, d, [a, b]) = (p[1][0] - p[0][0], secants[i], [slopes[i], slopes[i + 1]]);
            Cubic { from: p[0][0], c: [p[0][1], a, (3.0 * d - 2.0 * a - b) / h, (a + b - 2.0 * d) / (h * h)] }
        };
        points.windows(2).enumerate().map(cubic).collect()
    }

    /// Least and largest slope between x₀ and x.
    pub(crate) fn slopes(&self, x: f64) -> [f64; 2] {
        let [_, _, c2, c3] = self.c;
        // the slope is a parabola with its vertex here
        let vertex = if c3 == 0.0 { x } else { (self.from - c2 / (3.0 * c3)).clamp(self.from, x) };
        let found = [self.from, vertex, x].map(|x| self.slope(x));
        [found.iter().copied().fold(f64::INFINITY, f64::min), found.iter().copied().fold(f64::NEG_INFINITY, f64::max)]
    }
}

fn secant(pair: &[[f64; 2]]) -> f64 {
    (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0])
}
