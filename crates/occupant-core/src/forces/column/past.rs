//! Memory of a column between steps.

use crate::motion::scalar::Scalar;

/// Memory of a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColumnPast<S> {
    /// x_m, the largest stroke, m.
    pub(super) greatest: S,
    /// Largest residual of its book and largest work that it took up so far, J.
    pub(super) residual: S,
    pub(super) taken: S,
}

impl<S> ColumnPast<S> {
    /// How many numbers it has.
    pub(super) const SIZE: usize = 3;

    /// f called with every number and the one in the same place of `other`.
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
    /// Of a column that has not stroked.
    pub(super) fn none() -> Self {
        ColumnPast { greatest: S::zero(), residual: S::zero(), taken: S::zero() }
    }
}
