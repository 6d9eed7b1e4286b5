//! Slopes of smooth functions by differences over three steps, extrapolated to a step of zero.
//!
//! With D(h) = (f(p + h) − f(p − h))/2h the error of R(h) = (4 D(h/2) − D(h))/3 is of the order h⁴. The slope is R(h/2),
//! and its distance from R(h), with the last digit of f over the step, says how far it can be trusted. Where only one side of p is possible, D(h) is
//! (f(p + h) − f(p))/h and one more extrapolation is needed.

/// Sides of p on which a function can be evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Both,
    Above,
    Below,
}

/// A slope and its uncertainty.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slope {
    /// The slope.
    pub value: f64,
    /// Difference from the slope of larger steps, plus rounding.
    pub doubt: f64,
}

impl Slope {
    /// Slope of a constant.
    pub const ZERO: Slope = Slope { value: 0.0, doubt: 0.0 };
}

/// Largest number of points of a ladder.
pub(super) const POINTS: usize = 6;

/// Points at which a function is evaluated.
#[derive(Clone, Debug)]
pub(super) struct Ladder {
    side: Side,
    /// p.
    base: f64,
    /// p ± h, p ± h/2, p ± h/4.
    pub points: Vec<f64>,
}

impl Ladder {
    /// Steps `h`, `h`/2 and `h`/4 from `base`.
    pub fn new(base: f64, h: f64, side: Side) -> Self {
        let steps = [h, 0.5 * h, 0.25 * h];
        let points = match side {
            Side::Both => steps.iter().flat_map(|h| [base + h, base - h]).collect(),
            Side::Above => steps.iter().map(|h| base + h).collect(),
            Side::Below => steps.iter().map(|h| base - h).collect(),
        };
        Ladder { side, base, points }
    }

    /// Slope of a function from its values at the points, and `at_base` at p.
    pub fn slope(&self, at_base: f64, values: &[f64]) -> Slope {
        let p = &self.points;
        let quotient = |a: f64, b: f64, span: f64| if a == b { 0.0 } else { (a - b) / span };
        let value = |i: usize| values.get(i).copied().unwrap_or(f64::NAN);
        let d: [f64; 3] = std::array::from_fn(|i| match self.side {
            Side::Both => {
                let (up, down) = (2 * i, 2 * i + 1);
                quotient(value(up), value(down), p[up] - p[down])
            }
            Side::Above | Side::Below => quotient(value(i), at_base, p[i] - self.base),
        });
        let (value, other) = match self.side {
            Side::Both => ((4.0 * d[2] - d[1]) / 3.0, (4.0 * d[1] - d[0]) / 3.0),
            Side::Above | Side::Below => {
                let (coarse, fine) = (2.0 * d[1] - d[0], 2.0 * d[2] - d[1]);
                ((4.0 * fine - coarse) / 3.0, fine)
            }
        };
        // the last digit over the shortest step; what does not change at all is beyond doubt
        let still = values.iter().all(|v| *v == at_base);
        let rounding = if still && at_base == 0.0 || !at_base.is_finite() {
            0.0
        } else {
            f64::EPSILON * (at_base / (p[p.len() - 1] - self.base)).abs()
        };
        Slope { value, doubt: (value - other).abs() + rounding }
    }

    /// Slopes of several functions at once; `values` by point.
    pub fn slopes(&self, at_base: &[f64], values: &[Vec<f64>]) -> Vec<Slope> {
        let mut column = [0.0; POINTS];
        let count = self.points.len();
        let one = |i: usize, column: &mut [f64; POINTS]| {
            for (place, values) in column.iter_mut().zip(values) {
                *place = values.get(i).copied().unwrap_or(f64::NAN);
            }
            self.slope(at_base[i], &column[..count])
        };
        (0..at_base.len()).map(|i| one(i, &mut column)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slope(side: Side, f: impl Fn(f64) -> f64) -> Slope {
        let ladder = Ladder::new(0.7, 1e-3, side);
        let values: Vec<f64> = ladder.points.iter().map(|p| f(*p)).collect();
        ladder.slope(f(0.7), &values)
    }

    #[test]
    fn a_smooth_function_has_its_derivative_from_either_side() {
        let exact = 0.7_f64.exp();
        for (side, bound) in [
            // Measured: 7.3e-13; 1.1e-11 from one side.
            (Side::Both, 1e-11),
            (Side::Above, 1e-10),
            (Side::Below, 1e-10),
        ] {
            let found = slope(side, f64::exp);
            assert!((found.value - exact).abs() < bound, "{side:?} {found:?}");
            assert!(found.doubt < 1e-7, "{side:?} {found:?}");
        }
    }

    #[test]
    fn a_kink_is_seen() {
        // beyond a quarter and within the whole of the step
        let found = slope(Side::Both, |p| (p - 0.7004_f64).max(0.0));
        assert!(found.doubt > 0.05, "{found:?}");
    }

    #[test]
    fn what_does_not_change_has_no_slope_even_where_it_is_infinite() {
        assert_eq!(slope(Side::Both, |_| f64::INFINITY), Slope::ZERO);
        assert_eq!(slope(Side::Both, |_| 0.0), Slope::ZERO);
        // of a number that does not change only as far as its digits tell
        let found = slope(Side::Above, |_| 3.0);
        assert!(found.value == 0.0 && found.doubt < 1e-11, "{found:?}");
    }
}
