//! Tables of one number over another, straight between rows, constant before the first and after the last.

use crate::motion::scalar::Scalar;

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Steps<S>(Vec<[S; 2]>);

impl<S: Copy> Steps<S> {
    pub(crate) fn zip<A: Copy, T>(&self, other: &Steps<A>, f: &impl Fn(S, A) -> T) -> Steps<T> {
        Steps(self.0.iter().zip(&other.0).map(|(a, b)| [f(a[0], b[0]), f(a[1], b[1])]).collect())
    }

    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }
}

impl<S: Scalar> Steps<S> {
    pub(crate) fn new(rows: &[[f64; 2]]) -> Self {
        Steps(rows.iter().map(|row| row.map(S::of)).collect())
    }

    /// Value at x; 0 of an empty table.
    #[inline(always)]
    pub(crate) fn at(&self, x: S) -> S {
        let Some(first) = self.0.first() else { return S::zero() };
        let mut value = first[1];
        for (a, b) in self.0.iter().zip(self.0.iter().skip(1)) {
            value += (b[1] - a[1]) * ((x - a[0]) / (b[0] - a[0])).clamp01();
        }
        value
    }

    /// Force times the value at x; unchanged with an empty table.
    #[inline(always)]
    pub(crate) fn scale(&self, force: S, x: S) -> S {
        if self.0.is_empty() { force } else { force * self.at(x) }
    }

    /// x of the last row.
    #[inline(always)]
    pub(crate) fn end(&self) -> S {
        self.0.last().map_or(S::zero(), |row| row[0])
    }
}
