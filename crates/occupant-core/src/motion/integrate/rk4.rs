//! The classical fourth-order Runge–Kutta step.
//!
//! Orientations are integrated as quaternions in R⁴ and brought back to unit length after the step, which keeps the order.

use crate::motion::scalar::Scalar;
use crate::motion::state::State;

/// Where in a step a rate is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// At its start: the state is that of an accepted step.
    Start,
    /// At its middle.
    Middle,
    /// At its end.
    End,
}

/// The state after a step `h` (s); `rate` is called four times, first with [`Stage::Start`], and writes what it finds to its
/// last argument.
#[inline(always)]
pub fn step<S: Scalar>(state: &State<S>, h: S, mut rate: impl FnMut(Stage, &State<S>, &mut State<S>)) -> State<S> {
    let half = h * S::of(0.5);
    let two = S::of(2.0);
    let mut sum = *state;
    rate(Stage::Start, state, &mut sum); // (115), (116)
    let mut at = state.advanced(half, &sum);
    let mut k = sum;
    rate(Stage::Middle, &at, &mut k); // k₂ (117), (118)
    at.advance(state, half, &k);
    sum.add(two, &k);
    rate(Stage::Middle, &at, &mut k); // k₃ (119), (120)
    at.advance(state, h, &k);
    sum.add(two, &k);
    rate(Stage::End, &at, &mut k); // k₄ (121), (122)
    sum.add(S::one(), &k);
    at.advance(state, h / S::of(6.0), &sum); // (123), (124), (126), (127)
    at.normalize();
    at
}
