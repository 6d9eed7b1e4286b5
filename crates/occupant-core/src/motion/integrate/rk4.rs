//! The classical fourth-order Runge–Kutta step.
//!
//! Orientations are integrated as quaternions in R⁴ and brought back to unit length after the step, which keeps the order.

use crate::motion::scalar::Scalar;
use crate::motion::state::{Shape, State};

/// Stage at which the derivative is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// At its start, with an accepted state.
    Start,
    /// At its middle.
    Middle,
    /// At its end.
    End,
}

/// Intermediate results of a step, reused by the next: a state of any tree is large to copy.
#[derive(Clone, Debug)]
pub struct Stages<S> {
    at: State<S>,
    k: State<S>,
    sum: State<S>,
}

impl<S: Scalar> Stages<S> {
    /// Space for states of this shape.
    #[inline(always)]
    pub fn new(shape: Shape) -> Self {
        let zero = State::zero(shape);
        Stages { at: zero, k: zero, sum: zero }
    }

    /// State after a step `h` (s); `rate` is called four times, first with [`Stage::Start`], and writes its result to
    /// its last argument.
    #[inline(always)]
    pub fn step(&mut self, from: &State<S>, h: S, mut rate: impl FnMut(Stage, &State<S>, &mut State<S>)) -> &State<S> {
        self.begin(from, &mut rate);
        self.go(from, h, rate)
    }

    /// First call of `rate` in a step, on which the step's length may depend.
    #[inline(always)]
    pub(crate) fn begin(&mut self, from: &State<S>, rate: impl FnOnce(Stage, &State<S>, &mut State<S>)) {
        rate(Stage::Start, from, &mut self.sum); // (115), (116)
    }

    /// Rest of a step `h` (s).
    #[inline(always)]
    pub(crate) fn go(
        &mut self,
        from: &State<S>,
        h: S,
        mut rate: impl FnMut(Stage, &State<S>, &mut State<S>),
    ) -> &State<S> {
        let Stages { at, k, sum } = self;
        let half = h * S::of(0.5);
        let two = S::of(2.0);
        at.advance(from, half, sum);
        rate(Stage::Middle, at, k); // k₂ (117), (118)
        at.advance(from, half, k);
        sum.add(two, k);
        rate(Stage::Middle, at, k); // k₃ (119), (120)
        at.advance(from, h, k);
        sum.add(two, k);
        rate(Stage::End, at, k); // k₄ (121), (122)
        sum.add(S::one(), k);
        at.advance(from, h / S::of(6.0), sum); // (123), (124), (126), (127)
        at.normalize();
        at
    }
}

/// A single [`Stages::step`].
#[inline(always)]
pub fn step<S: Scalar>(state: &State<S>, h: S, rate: impl FnMut(Stage, &State<S>, &mut State<S>)) -> State<S> {
    *Stages::new(state.shape()).step(state, h, rate)
}
