//! Memory of a column between steps.

use crate::motion::scalar::Scalar;

/// Stored state of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColumnPast<S> {
    /// x_m, the largest stroke, m.
    pub(super) greatest: S,
    /// Largest residual of its energy balance and largest absorbed work so far, J.
    pub(super) residual: S,
    pub(super) taken: S,
}

impl<S> ColumnPast<S> {
    /// Number of its numbers.
    pub(super) const SIZE: usize = 3;

    /// Calls f with every number and its counterpart in `other`.
    pub(super) fn each<A>(&mut self, other: &mut ColumnPast<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        f(&mut self.greatest, &mut other.greatest);
        f(&mut self.residual, &mut other.residual);
        f(&mut self.taken, &mut other.taken);
    }
}

impl<A: Copy> ColumnPast<A> {
    pub(super) fn map<S>(&self, f: &mut impl FnMut(A) -> S) -> ColumnPast<S> {
        ColumnPast { greatest: f(self.greatest), residual: f(self.residual), taken: f(self.taken) }
    }
}

impl<S: Scalar> ColumnPast<S> {
    /// Stored state without stroke.
    pub(super) fn none() -> Self {
        ColumnPast { greatest: S::zero(), residual: S::zero(), taken: S::zero() }
    }
}
