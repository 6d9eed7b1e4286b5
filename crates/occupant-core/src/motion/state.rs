//! What is integrated: place, orientations, hinge angles, their speeds, and the work sums of the energy ledger.
//!
//! Report: Eqs 8, 13–26 for the place of a segment; the state itself is ours, because Euler angles are singular for an
//! upright torso. It is one row of numbers, of which a [`Shape`] says what stands where. A rate of change has the same
//! shape, so that Runge–Kutta stages are sums of rows.

use std::array::from_fn;

use crate::motion::layout::{Layout, MOST_SEGMENTS};
use crate::motion::scalar::Scalar;
use crate::motion::vector::{V3, v3};

/// A quaternion w + xi + yj + zk; a unit quaternion turns segment axes into space axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quat<S> {
    /// Real part.
    pub w: S,
    /// Imaginary part.
    pub v: V3<S>,
}

impl<S: Scalar> Quat<S> {
    /// q̇ = ½ ω q for an angular velocity in space axes.
    #[inline(always)]
    pub fn rate(&self, omega: V3<S>) -> Self {
        let half = omega * S::of(0.5);
        Quat { w: -half.dot(self.v), v: half * self.w + half.cross(self.v) }
    }

    /// q·q.
    #[inline(always)]
    pub(crate) fn norm_squared(&self) -> S {
        self.w * self.w + self.v.norm_squared()
    }
}

/// Work sums of the force elements.
pub(crate) const WORK_SUMS: usize = 6;

/// Work done since the start, for the energy ledger, J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work<S> {
    /// Done on force elements, as each of them says (`forces::SUMS`).
    pub sums: [S; WORK_SUMS],
    /// Done on the occupant by the motion of the vehicle through force elements.
    pub vehicle: S,
}

impl<S: Scalar> Work<S> {
    /// None yet.
    #[inline(always)]
    pub fn zero() -> Self {
        let o = S::zero();
        Work { sums: [o; WORK_SUMS], vehicle: o }
    }
}

/// Most numbers that force elements own in a state.
pub(crate) const MOST_OWN: usize = 24;
/// Most numbers of a state.
const MOST_NUMBERS: usize = 6 + 7 * MOST_SEGMENTS + WORK_SUMS + 1 + MOST_OWN;

/// How many numbers of each kind a state has. In a row: T1, orientations (w, x, y, z), hinges; velocity of T1, angular
/// velocities, hinge rates; work sums; numbers that force elements own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Orientations.
    free: usize,
    /// Angles of hinges.
    hinges: usize,
    /// Numbers that force elements own.
    own: usize,
}

impl Shape {
    /// That of a body whose force elements own no numbers.
    pub fn of(layout: &Layout) -> Self {
        Shape::new(layout.free().len(), layout.hinged().len())
    }

    /// That of a body with as many orientations and angles of hinges, whose force elements own no numbers.
    pub(crate) const fn new(free: usize, hinges: usize) -> Self {
        Shape { free, hinges, own: 0 }
    }

    /// The same with `own` numbers that force elements own.
    pub(crate) const fn with_own(self, own: usize) -> Self {
        Shape { own, ..self }
    }

    #[inline(always)]
    fn hinge(&self) -> usize {
        3 + 4 * self.free
    }

    /// How many numbers say where the body is; as many of the next, less one for each orientation, say how it moves.
    #[inline(always)]
    pub fn places(&self) -> usize {
        self.hinge() + self.hinges
    }

    #[inline(always)]
    fn hinge_rate(&self) -> usize {
        self.places() + 3 + 3 * self.free
    }

    /// Numbers before the work sums.
    #[inline(always)]
    pub fn moving(&self) -> usize {
        self.hinge_rate() + self.hinges
    }

    /// All numbers.
    #[expect(clippy::len_without_is_empty, reason = "no state is without T1")]
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.moving() + WORK_SUMS + 1 + self.own
    }
}

/// The integrated state, or its rate of change.
#[derive(Clone, Copy, Debug)]
pub struct State<S> {
    /// Those beyond the shape's are 0.
    numbers: [S; MOST_NUMBERS],
    shape: Shape,
}

impl<S: Copy> State<S> {
    /// f applied to every number and the one in the same place of `other`.
    #[inline(always)]
    pub fn zip<A: Copy, T>(&self, other: &State<A>, f: impl Fn(S, A) -> T) -> State<T> {
        State { numbers: from_fn(|i| f(self.numbers[i], other.numbers[i])), shape: self.shape }
    }

    /// What stands where.
    #[inline(always)]
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// All numbers in a row; see [`Shape`].
    #[inline(always)]
    pub fn numbers(&self) -> &[S] {
        &self.numbers[..self.shape.len()]
    }

    /// All numbers in a row.
    #[inline(always)]
    pub fn numbers_mut(&mut self) -> &mut [S] {
        &mut self.numbers[..self.shape.len()]
    }

    #[inline(always)]
    fn vector(&self, at: usize) -> V3<S> {
        let v = &self.numbers[at..at + 3];
        v3(v[0], v[1], v[2])
    }

    #[inline(always)]
    fn set_vector(&mut self, at: usize, v: V3<S>) {
        self.numbers[at..at + 3].copy_from_slice(&[v.x, v.y, v.z]);
    }

    /// T1, the place of the root's joint, space axes, m.
    #[inline(always)]
    pub fn t1(&self) -> V3<S> {
        self.vector(0)
    }

    /// Gives it another [`State::t1`].
    #[inline(always)]
    pub fn set_t1(&mut self, place: V3<S>) {
        self.set_vector(0, place);
    }

    /// Orientation of a segment by its place in [`Layout::free`].
    #[inline(always)]
    pub fn orientation(&self, slot: usize) -> Quat<S> {
        let at = 3 + 4 * slot;
        Quat { w: self.numbers[at], v: self.vector(at + 1) }
    }

    /// Gives it another [`State::orientation`].
    #[inline(always)]
    pub fn set_orientation(&mut self, slot: usize, q: Quat<S>) {
        let at = 3 + 4 * slot;
        self.numbers[at] = q.w;
        self.set_vector(at + 1, q.v);
    }

    /// Angles of the hinges, in the order of [`Layout::hinged`], rad.
    #[inline(always)]
    pub fn hinge(&self) -> &[S] {
        &self.numbers[self.shape.hinge()..self.shape.places()]
    }

    /// [`State::hinge`] to be changed.
    #[inline(always)]
    pub fn hinge_mut(&mut self) -> &mut [S] {
        &mut self.numbers[self.shape.hinge()..self.shape.places()]
    }

    /// Velocity of T1, space axes, m/s.
    #[inline(always)]
    pub fn velocity(&self) -> V3<S> {
        self.vector(self.shape.places())
    }

    /// Gives it another [`State::velocity`].
    #[inline(always)]
    pub fn set_velocity(&mut self, velocity: V3<S>) {
        self.set_vector(self.shape.places(), velocity);
    }

    /// Absolute angular velocity of a segment by its place in [`Layout::free`], space axes, rad/s.
    #[inline(always)]
    pub fn omega(&self, slot: usize) -> V3<S> {
        self.vector(self.shape.places() + 3 + 3 * slot)
    }

    /// Gives it another [`State::omega`].
    #[inline(always)]
    pub fn set_omega(&mut self, slot: usize, omega: V3<S>) {
        self.set_vector(self.shape.places() + 3 + 3 * slot, omega);
    }

    /// Rates of the hinges, rad/s.
    #[inline(always)]
    pub fn hinge_rate(&self) -> &[S] {
        &self.numbers[self.shape.hinge_rate()..self.shape.moving()]
    }

    /// [`State::hinge_rate`] to be changed.
    #[inline(always)]
    pub fn hinge_rate_mut(&mut self) -> &mut [S] {
        &mut self.numbers[self.shape.hinge_rate()..self.shape.moving()]
    }

    /// Work sums.
    #[inline(always)]
    pub fn work(&self) -> Work<S> {
        let w = &self.numbers[self.shape.moving()..][..WORK_SUMS + 1];
        Work { sums: from_fn(|i| w[i]), vehicle: w[WORK_SUMS] }
    }

    /// Gives it other [`State::work`] sums.
    #[inline(always)]
    pub fn set_work(&mut self, work: Work<S>) {
        let w = &mut self.numbers[self.shape.moving()..][..WORK_SUMS + 1];
        w[..WORK_SUMS].copy_from_slice(&work.sums);
        w[WORK_SUMS] = work.vehicle;
    }

    /// Numbers that force elements own, each scaled by its element to the order of 1.
    #[inline(always)]
    pub fn own(&self) -> &[S] {
        &self.numbers[self.shape.len() - self.shape.own..self.shape.len()]
    }

    /// [`State::own`] to be changed.
    #[inline(always)]
    pub(crate) fn own_mut(&mut self) -> &mut [S] {
        &mut self.numbers[self.shape.len() - self.shape.own..self.shape.len()]
    }

    /// Places of the orientations.
    #[inline(always)]
    pub fn turns(&self) -> std::ops::Range<usize> {
        0..self.shape.free
    }
}

impl<S: Scalar> State<S> {
    /// All zero: the neutral element of sums, not a posture.
    #[inline(always)]
    pub fn zero(shape: Shape) -> Self {
        State { numbers: [S::zero(); MOST_NUMBERS], shape }
    }

    /// The same without any motion.
    pub fn still(&self) -> Self {
        let mut still = *self;
        still.numbers[self.shape.places()..self.shape.moving()].fill(S::zero());
        still
    }

    /// Adds h·rate.
    #[inline(always)]
    pub(crate) fn add(&mut self, h: S, rate: &Self) {
        for (x, rate) in self.numbers_mut().iter_mut().zip(rate.numbers()) {
            *x += h * *rate;
        }
    }

    /// Becomes `from` + h·rate, of the same shape.
    #[inline(always)]
    pub(crate) fn advance(&mut self, from: &Self, h: S, rate: &Self) {
        for (x, (from, rate)) in self.numbers_mut().iter_mut().zip(from.numbers().iter().zip(rate.numbers())) {
            *x = *from + h * *rate;
        }
    }

    /// self + h·rate.
    #[inline(always)]
    pub(crate) fn advanced(&self, h: S, rate: &Self) -> Self {
        let mut sum = *self;
        sum.add(h, rate);
        sum
    }

    /// Where every component but the work sums is a finite number.
    #[inline(always)]
    pub(crate) fn finite(&self) -> S::Mask {
        let (limit, mut all) = (S::of(f64::INFINITY), S::truth(true));
        for x in self.numbers[..self.shape.moving()].iter().chain(self.own()) {
            all = all & x.abs().lt(limit);
        }
        all
    }

    /// Brings the quaternions back to unit length, which the integration keeps only to its order.
    #[inline(always)]
    pub(crate) fn normalize(&mut self) {
        for slot in self.turns() {
            let q = self.orientation(slot);
            let k = S::one() / q.norm_squared().sqrt();
            self.set_orientation(slot, Quat { w: q.w * k, v: q.v * k });
        }
    }
}

/// Numbers and shape.
impl PartialEq for State<f64> {
    fn eq(&self, other: &Self) -> bool {
        self.shape == other.shape && self.numbers() == other.numbers()
    }
}

impl State<f64> {
    /// The same with these numbers that force elements own, of which there are at most [`MOST_OWN`].
    pub(crate) fn with_own(mut self, own: &[f64]) -> Self {
        self.shape = self.shape.with_own(own.len());
        self.own_mut().copy_from_slice(own);
        self
    }

    /// The state of this shape with these numbers, if there are as many.
    pub fn from_numbers(shape: Shape, numbers: &[f64]) -> Option<Self> {
        let mut state = State::zero(shape);
        (numbers.len() == shape.len()).then(|| state.numbers_mut().copy_from_slice(numbers))?;
        Some(state)
    }

    /// True if every component but the work sums is a finite number.
    pub(crate) fn is_finite(&self) -> bool {
        self.finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::tti12::TTI12;

    #[test]
    fn a_state_is_its_numbers() {
        let shape = Shape::of(&Layout::of(&TTI12));
        let numbers: [f64; 77] = from_fn(|i| i as f64 + 0.5);
        let state = State::from_numbers(shape, &numbers).unwrap();
        assert_eq!(state.numbers(), numbers);
        assert_eq!((state.orientation(7).v.z, state.hinge()[0]), (34.5, 35.5));
        assert_eq!((state.velocity().x, state.omega(7).z, state.hinge_rate()), (39.5, 65.5, &numbers[66..70]));
        assert_eq!((state.work().sums[0], state.work().vehicle), (70.5, 76.5));
        assert_eq!(State::from_numbers(shape, &numbers[1..]), None);
        let owning = state.with_own(&[1.0, 2.0]);
        assert_eq!((owning.own(), owning.work(), owning.numbers().len()), (&[1.0, 2.0][..], state.work(), 79));
    }
}
