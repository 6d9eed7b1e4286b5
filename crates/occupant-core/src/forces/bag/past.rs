//! Memory of a bag between steps: plain numbers that change only at accepted steps.

use super::{MOST_SPHERES, MOST_VENTS};
use crate::motion::scalar::Scalar;

/// Stored state of a bag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BagPast<S> {
    /// 1 once it has fired.
    pub(super) fired: S,
    /// p − p_a, Pa, and V, m³, of the last accepted step.
    pub(super) gauge: S,
    pub(super) volume: S,
    /// ∫(p − p_a)dV over accepted steps, J; largest residual of it and largest U so far, J.
    pub(super) pressed: S,
    pub(super) residual: S,
    pub(super) greatest: S,
    /// Bit set 2^i of the spheres i whose centres were within the full envelope when it fired.
    pub(super) caught: S,
    /// 1 for each vent opened by the pressure.
    pub(super) open: [S; MOST_VENTS],
    /// Depth at which each sphere is held, m; 0 if it is not.
    pub(super) held: [S; MOST_SPHERES],
}

impl<S> BagPast<S> {
    /// Calls f with every number and its counterpart in `other`.
    pub(super) fn each<A>(&mut self, other: &mut BagPast<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        f(&mut self.fired, &mut other.fired);
        f(&mut self.gauge, &mut other.gauge);
        f(&mut self.volume, &mut other.volume);
        f(&mut self.pressed, &mut other.pressed);
        f(&mut self.residual, &mut other.residual);
        f(&mut self.greatest, &mut other.greatest);
        f(&mut self.caught, &mut other.caught);
        self.open.iter_mut().zip(&mut other.open).for_each(|(a, b)| f(a, b));
        self.held.iter_mut().zip(&mut other.held).for_each(|(a, b)| f(a, b));
    }
}

impl<A: Copy> BagPast<A> {
    pub(super) fn map<S>(&self, f: &mut impl FnMut(A) -> S) -> BagPast<S> {
        BagPast {
            fired: f(self.fired),
            gauge: f(self.gauge),
            volume: f(self.volume),
            pressed: f(self.pressed),
            residual: f(self.residual),
            greatest: f(self.greatest),
            caught: f(self.caught),
            open: self.open.map(&mut *f),
            held: self.held.map(&mut *f),
        }
    }
}

impl<S: Scalar> BagPast<S> {
    /// Open vents, held spheres, and whether it has fired.
    #[inline(always)]
    pub(super) fn switches(&self) -> S {
        let (o, mut bit, mut sum) = (S::zero(), 1.0, S::zero());
        for of in self.open.iter().chain(&self.held).chain([&self.fired]) {
            sum += S::select(of.gt(o), S::of(bit), o);
            bit *= 2.0;
        }
        sum
    }

    /// Stored state before firing.
    pub(super) fn none() -> Self {
        let o = S::zero();
        BagPast {
            fired: o,
            gauge: o,
            volume: o,
            pressed: o,
            residual: o,
            greatest: o,
            caught: o,
            open: [o; MOST_VENTS],
            held: [o; MOST_SPHERES],
        }
    }
}
