//! The integrated state: position, orientations, hinge angles, their speeds, and the work sums of the energy ledger.
//!
//! Report: Eqs 8, 13–26 for the position of a segment; the state itself is ours, because Euler angles are singular for
//! an upright torso. It is one row of numbers; a [`Shape`] describes its layout. A rate of change has the same shape,
//! so that Runge–Kutta stages are sums of rows.

use std::array::from_fn;

#[cfg(any(target_arch = "x86_64", test))]
use crate::motion::lanes::Lanes;
use crate::motion::layout::{Layout, MOST_BODIES, MOST_SEGMENTS, MOST_SLIDES};
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
    pub(crate) fn rate(&self, omega: V3<S>) -> Self {
        let half = omega * S::of(0.5);
        Quat { w: -half.dot(self.v), v: half * self.w + half.cross(self.v) }
    }

    /// q·q.
    #[inline(always)]
    pub(crate) fn norm_squared(&self) -> S {
        self.w * self.w + self.v.norm_squared()
    }
}

/// Number of work sums of the force elements.
pub(crate) const WORK_SUMS: usize = 8;

/// Work of a body since the start, for the energy ledger, J.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work<S> {
    /// Work done on force elements, by work sum (`forces::SUMS`).
    pub sums: [S; WORK_SUMS],
    /// Work of moving vehicles and panels on the body through force elements.
    pub vehicle: S,
    /// Work of other bodies in contact on the body; the sum over all bodies is 0.
    pub others: S,
}

impl<S: Scalar> Work<S> {
    /// Zero work.
    #[inline(always)]
    pub fn zero() -> Self {
        let o = S::zero();
        Work { sums: [o; WORK_SUMS], vehicle: o, others: o }
    }
}

/// Largest number of state variables that force elements own.
pub(crate) const MOST_OWN: usize = 40 + 2 * MOST_SLIDES;
/// Scales of the state variables of a sliding point mass: s, m; ṡ, m/s. With that of ṡ, error control bounds both as
/// positions and velocities of the body.
pub(crate) const SLIDE_UNITS: [f64; 2] = [1.0, 100.0];
/// Largest count of numbers of a state.
const MOST_NUMBERS: usize = (6 + WORK_SUMS + 2) * MOST_BODIES + 7 * MOST_SEGMENTS + MOST_OWN;

/// Counts of the numbers of a state by kind. Order: T1 of each body, orientations (w, x, y, z), hinges; velocities of
/// T1, angular velocities, hinge rates; work sums of each body; state variables of force elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Bodies.
    bodies: usize,
    /// Orientations.
    free: usize,
    /// Angles of hinges.
    hinges: usize,
    /// State variables that force elements own.
    own: usize,
}

impl Shape {
    /// Shape for a body whose force elements own no state variables.
    pub fn of(layout: &Layout) -> Self {
        let (free, hinges) = (layout.free().len(), layout.hinged().len());
        Shape { bodies: layout.trunks().len(), free, hinges, own: 0 }
    }

    #[cfg(test)]
    /// Shape for one body with these numbers of orientations and hinge angles, whose force elements own no state
    /// variables.
    pub(crate) const fn new(free: usize, hinges: usize) -> Self {
        Shape { bodies: 1, free, hinges, own: 0 }
    }

    /// The same with `own` state variables of force elements.
    pub(crate) const fn with_own(self, own: usize) -> Self {
        Shape { own, ..self }
    }

    /// Bodies.
    #[inline(always)]
    pub(crate) fn bodies(&self) -> std::ops::Range<usize> {
        0..self.bodies
    }

    /// Number of work sums of a body; a single body receives no work from others.
    #[inline(always)]
    fn works(&self) -> usize {
        WORK_SUMS + 1 + usize::from(self.bodies > 1)
    }

    /// Index of an orientation among the numbers.
    #[inline(always)]
    pub(crate) fn turn(&self, slot: usize) -> usize {
        3 * self.bodies + 4 * slot
    }

    /// Index of an angular velocity among the numbers.
    #[inline(always)]
    pub(crate) fn spin(&self, slot: usize) -> usize {
        self.places() + 3 * self.bodies + 3 * slot
    }

    #[inline(always)]
    fn hinge(&self) -> usize {
        self.turn(self.free)
    }

    /// Count of position coordinates; that of velocities is less by one for each orientation.
    #[inline(always)]
    pub fn places(&self) -> usize {
        self.hinge() + self.hinges
    }

    #[inline(always)]
    fn hinge_rate(&self) -> usize {
        self.spin(self.free)
    }

    /// Count of the numbers before the work sums.
    #[inline(always)]
    pub fn moving(&self) -> usize {
        self.hinge_rate() + self.hinges
    }

    /// Count of all numbers.
    #[expect(clippy::len_without_is_empty, reason = "no state is without T1")]
    #[inline(always)]
    pub fn len(&self) -> usize {
        self.moving() + self.bodies * self.works() + self.own
    }
}

/// The integrated state, or its rate of change.
#[derive(Clone, Copy, Debug)]
pub struct State<S> {
    /// Numbers; 0 beyond the shape's.
    numbers: [S; MOST_NUMBERS],
    shape: Shape,
}

impl<S: Copy> State<S> {
    /// f applied to corresponding numbers of this and `other`.
    #[inline(always)]
    pub fn zip<A: Copy, T>(&self, other: &State<A>, f: impl Fn(S, A) -> T) -> State<T> {
        State { numbers: from_fn(|i| f(self.numbers[i], other.numbers[i])), shape: self.shape }
    }

    /// Counts by kind.
    #[inline(always)]
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// Copies a state of the same shape: only the numbers in use, for a state of any tree is large.
    #[inline(always)]
    pub(crate) fn take_over(&mut self, other: &Self) {
        self.numbers_mut().copy_from_slice(other.numbers());
    }

    /// All numbers in order; see [`Shape`].
    #[inline(always)]
    pub fn numbers(&self) -> &[S] {
        &self.numbers[..self.shape.len()]
    }

    /// All numbers, mutable.
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

    /// N numbers from an index on, with one bounds check.
    #[inline(always)]
    pub(crate) fn block<const N: usize>(&self, at: usize) -> &[S; N] {
        self.numbers[at..][..N].try_into().expect("as many")
    }

    /// T1, position of the root joint of the first body, space axes, m.
    #[inline(always)]
    pub fn t1(&self) -> V3<S> {
        self.t1_of(0)
    }

    /// T1 of a body, space axes, m.
    #[inline(always)]
    pub(crate) fn t1_of(&self, body: usize) -> V3<S> {
        self.vector(3 * body)
    }

    /// Sets [`State::t1`].
    #[inline(always)]
    pub fn set_t1(&mut self, place: V3<S>) {
        self.set_t1_of(0, place);
    }

    /// Sets [`State::t1_of`].
    #[inline(always)]
    pub(crate) fn set_t1_of(&mut self, body: usize, place: V3<S>) {
        self.set_vector(3 * body, place);
    }

    /// Orientation of a segment by its index in [`Layout::free`].
    #[inline(always)]
    pub fn orientation(&self, slot: usize) -> Quat<S> {
        let at = self.shape.turn(slot);
        Quat { w: self.numbers[at], v: self.vector(at + 1) }
    }

    /// Sets [`State::orientation`].
    #[inline(always)]
    pub fn set_orientation(&mut self, slot: usize, q: Quat<S>) {
        let at = self.shape.turn(slot);
        self.numbers[at] = q.w;
        self.set_vector(at + 1, q.v);
    }

    /// Angles of the hinges, in the order of [`Layout::hinged`], rad.
    #[inline(always)]
    pub fn hinge(&self) -> &[S] {
        &self.numbers[self.shape.hinge()..self.shape.places()]
    }

    /// Mutable [`State::hinge`].
    #[inline(always)]
    pub fn hinge_mut(&mut self) -> &mut [S] {
        &mut self.numbers[self.shape.hinge()..self.shape.places()]
    }

    /// Velocity of T1 of the first body, space axes, m/s.
    #[inline(always)]
    pub fn velocity(&self) -> V3<S> {
        self.velocity_of(0)
    }

    /// Velocity of T1 of a body, space axes, m/s.
    #[inline(always)]
    pub(crate) fn velocity_of(&self, body: usize) -> V3<S> {
        self.vector(self.shape.places() + 3 * body)
    }

    /// Sets [`State::velocity`].
    #[inline(always)]
    pub fn set_velocity(&mut self, velocity: V3<S>) {
        self.set_velocity_of(0, velocity);
    }

    /// Sets [`State::velocity_of`].
    #[inline(always)]
    pub(crate) fn set_velocity_of(&mut self, body: usize, velocity: V3<S>) {
        self.set_vector(self.shape.places() + 3 * body, velocity);
    }

    /// Absolute angular velocity of a segment by its index in [`Layout::free`], space axes, rad/s.
    #[inline(always)]
    pub fn omega(&self, slot: usize) -> V3<S> {
        self.vector(self.shape.spin(slot))
    }

    /// Sets [`State::omega`].
    #[inline(always)]
    pub fn set_omega(&mut self, slot: usize, omega: V3<S>) {
        self.set_vector(self.shape.spin(slot), omega);
    }

    /// Rates of the hinges, rad/s.
    #[inline(always)]
    pub fn hinge_rate(&self) -> &[S] {
        &self.numbers[self.shape.hinge_rate()..self.shape.moving()]
    }

    /// Mutable [`State::hinge_rate`].
    #[inline(always)]
    pub fn hinge_rate_mut(&mut self) -> &mut [S] {
        &mut self.numbers[self.shape.hinge_rate()..self.shape.moving()]
    }

    /// Sets the [`State::work`] sums of a body.
    #[inline(always)]
    pub(crate) fn set_work(&mut self, body: usize, work: &Work<S>) {
        let works = self.shape.works();
        let w = &mut self.numbers[self.shape.moving() + body * works..][..works];
        w[..WORK_SUMS].copy_from_slice(&work.sums);
        w[WORK_SUMS] = work.vehicle;
        if let Some(others) = w.get_mut(WORK_SUMS + 1) {
            *others = work.others;
        }
    }

    /// State variables that force elements own, each scaled by its element to the order of 1.
    #[inline(always)]
    pub(crate) fn own(&self) -> &[S] {
        &self.numbers[self.shape.len() - self.shape.own..self.shape.len()]
    }

    /// Mutable [`State::own`].
    #[inline(always)]
    pub(crate) fn own_mut(&mut self) -> &mut [S] {
        &mut self.numbers[self.shape.len() - self.shape.own..self.shape.len()]
    }

    /// Indices of the orientations.
    #[inline(always)]
    pub fn turns(&self) -> std::ops::Range<usize> {
        0..self.shape.free
    }
}

impl<S: Scalar> State<S> {
    /// Work sums of a body.
    #[inline(always)]
    pub fn work(&self, body: usize) -> Work<S> {
        let works = self.shape.works();
        let w = &self.numbers[self.shape.moving() + body * works..][..works];
        let others = w.get(WORK_SUMS + 1).copied().unwrap_or(S::zero());
        Work { sums: from_fn(|i| w[i]), vehicle: w[WORK_SUMS], others }
    }

    /// All zero: the neutral element of sums, not a posture.
    #[inline(always)]
    pub fn zero(shape: Shape) -> Self {
        State { numbers: [S::zero(); MOST_NUMBERS], shape }
    }

    /// The same with zero velocities.
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

    /// Sets it to `from` + h·rate, of the same shape.
    #[inline(always)]
    pub(crate) fn advance(&mut self, from: &Self, h: S, rate: &Self) {
        for (x, (from, rate)) in self.numbers_mut().iter_mut().zip(from.numbers().iter().zip(rate.numbers())) {
            *x = *from + h * *rate;
        }
    }

    /// Sets it to a linear combination of rates, of the same shape.
    #[inline(always)]
    pub(crate) fn sum<const N: usize>(&mut self, terms: &[(S, &Self); N]) {
        for (i, x) in self.numbers_mut().iter_mut().enumerate() {
            let mut sum = S::zero();
            for (factor, rate) in terms {
                sum += *factor * rate.numbers[i];
            }
            *x = sum;
        }
    }

    /// self + h·rate.
    #[inline(always)]
    pub(crate) fn advanced(&self, h: S, rate: &Self) -> Self {
        let mut sum = *self;
        sum.add(h, rate);
        sum
    }

    /// Lanes in which every component except the work sums is finite.
    #[inline(always)]
    pub(crate) fn finite(&self) -> S::Mask {
        let (limit, mut all) = (S::of(f64::INFINITY), S::truth(true));
        for x in self.numbers[..self.shape.moving()].iter().chain(self.own()) {
            all = all & x.abs().lt(limit);
        }
        all
    }

    /// Normalizes the quaternions, whose length the integration keeps only to its order.
    #[inline(always)]
    pub(crate) fn normalize(&mut self) {
        for slot in self.turns() {
            let q = self.orientation(slot);
            let k = S::one() / q.norm_squared().sqrt();
            self.set_orientation(slot, Quat { w: q.w * k, v: q.v * k });
        }
    }
}

#[cfg(any(target_arch = "x86_64", test))]
impl<L: Scalar> State<L> {
    /// Copies lane `i`, of the same shape, to `alone`.
    pub(crate) fn lane(&self, i: usize, alone: &mut State<f64>)
    where
        L: Lanes,
    {
        for (x, lanes) in alone.numbers_mut().iter_mut().zip(self.numbers()) {
            *x = lanes.lane(i);
        }
    }

    /// Sets lane `i` to a state of the same shape.
    pub(crate) fn set_lane(&mut self, i: usize, alone: &State<f64>)
    where
        L: Lanes,
    {
        for (lanes, x) in self.numbers_mut().iter_mut().zip(alone.numbers()) {
            lanes.set_lane(i, *x);
        }
    }

    /// Copies lane `i` of `other`, of the same shape.
    pub(crate) fn copy_lane(&mut self, i: usize, other: &Self)
    where
        L: Lanes,
    {
        for (lanes, from) in self.numbers_mut().iter_mut().zip(other.numbers()) {
            lanes.set_lane(i, from.lane(i));
        }
    }
}

/// Compares numbers and shape.
impl PartialEq for State<f64> {
    fn eq(&self, other: &Self) -> bool {
        self.shape == other.shape && self.numbers() == other.numbers()
    }
}

impl State<f64> {
    /// The same with these state variables of force elements, at most [`MOST_OWN`].
    pub(crate) fn with_own(mut self, own: &[f64]) -> Self {
        self.shape = self.shape.with_own(own.len());
        self.own_mut().copy_from_slice(own);
        self
    }

    /// State of this shape with these numbers, if their count is right.
    pub(crate) fn from_numbers(shape: Shape, numbers: &[f64]) -> Option<Self> {
        let mut state = State::zero(shape);
        (numbers.len() == shape.len()).then(|| state.numbers_mut().copy_from_slice(numbers))?;
        Some(state)
    }

    /// States of several bodies as one, in their order; their force elements own no state variables.
    pub(crate) fn together(all: &[State<f64>]) -> Self {
        let sum = |part: fn(&Shape) -> usize| all.iter().map(|state| part(&state.shape)).sum();
        let shape = Shape { bodies: all.len(), free: sum(|s| s.free), hinges: sum(|s| s.hinges), own: 0 };
        let (mut state, mut free, mut hinge) = (State::zero(shape), 0, 0);
        for (body, one) in all.iter().enumerate() {
            state.set_t1_of(body, one.t1());
            state.set_velocity_of(body, one.velocity());
            for slot in one.turns() {
                state.set_orientation(free + slot, one.orientation(slot));
                state.set_omega(free + slot, one.omega(slot));
            }
            let hinges = hinge..hinge + one.hinge().len();
            state.hinge_mut()[hinges.clone()].copy_from_slice(one.hinge());
            state.hinge_rate_mut()[hinges.clone()].copy_from_slice(one.hinge_rate());
            state.set_work(body, &one.work(0));
            (free, hinge) = (free + one.shape.free, hinges.end);
        }
        state
    }

    /// Whether every component except the work sums is finite.
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
        let numbers: [f64; 79] = from_fn(|i| i as f64 + 0.5);
        let state = State::from_numbers(shape, &numbers).unwrap();
        assert_eq!(state.numbers(), numbers);
        assert_eq!((state.orientation(7).v.z, state.hinge()[0]), (34.5, 35.5));
        assert_eq!((state.velocity().x, state.omega(7).z, state.hinge_rate()), (39.5, 65.5, &numbers[66..70]));
        assert_eq!((state.work(0).sums[0], state.work(0).vehicle), (70.5, 78.5));
        assert_eq!(State::from_numbers(shape, &numbers[1..]), None);
        let owning = state.with_own(&[1.0, 2.0]);
        assert_eq!((owning.own(), owning.work(0), owning.numbers().len()), (&[1.0, 2.0][..], state.work(0), 81));
    }
}
