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

/// The state after a step `h` (s); `rate` is called four times, first with [`Stage::Start`].
#[inline(always)]
pub fn step<S: Scalar>(state: &State<S>, h: S, mut rate: impl FnMut(Stage, &State<S>) -> State<S>) -> State<S> {
    let half = h * S::of(0.5);
    let two = S::of(2.0);
    let mut sum = rate(Stage::Start, state); // (115), (116)
    let mut at = state.advanced(half, &sum);
    let k2 = rate(Stage::Middle, &at); // (117), (118)
    at.advance(state, half, &k2);
    sum.add(two, &k2);
    let k3 = rate(Stage::Middle, &at); // (119), (120)
    at.advance(state, h, &k3);
    sum.add(two, &k3);
    let k4 = rate(Stage::End, &at); // (121), (122)
    sum.add(S::one(), &k4);
    at.advance(state, h / S::of(6.0), &sum); // (123), (124), (126), (127)
    at.normalize();
    at
}
