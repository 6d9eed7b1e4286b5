//! The embedded 3(2) pair of Bogacki and Shampine (Appl. Math. Lett. 2, 1989, 321–325), with the error of a step in
//! units of the tolerance, and interpolation within a step.
//!
//! The forces of a crash have a corner every millisecond or two, where a contact begins or turns, and sticking friction
//! limits the step of any explicit method. A pair of higher order wastes its stages there: at equal error the one of
//! Dormand and Prince takes more evaluations at every tolerance (measured in `docs/accuracy.md`).

use crate::motion::scalar::Scalar;
use crate::motion::state::{Shape, State};
use crate::motion::vector::V3;

/// Evaluations of a step with a known first stage.
pub(crate) const EVALUATIONS: u64 = 3;

/// Lowest power of the step in the error estimate.
pub(crate) const ERROR_ORDER: f64 = 3.0;

/// Stage at which the derivative is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// Within the step, at this fraction.
    Within(f64),
    /// At its end, for the new state.
    End,
}

/// Tolerances of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tolerance<S = f64> {
    /// Of velocities, relative to their size.
    pub relative: S,
    /// Of positions, m; angles count at a radius of 1 m.
    pub absolute_m: S,
    /// Of velocities, m/s; angular velocities count at a radius of 1 m.
    pub absolute_m_s: S,
}

/// Errors of a trial step: root mean square of error over tolerance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Errors<S> {
    /// Of the whole step.
    pub whole: S,
    /// Error by the midpoint rule, from values before the end, where the rate may jump. Computed if the whole step may
    /// be rejected.
    pub within: S,
}

impl Errors<f64> {
    /// The error for step control, accepted up to 1; `jumps`: an element has switched by the end.
    pub(crate) fn counting(self, jumps: bool) -> f64 {
        let Errors { whole, within } = self;
        if jumps && whole.is_finite() && whole > 1.0 { whole.min(within) } else { whole }
    }
}

/// Results of a trial step, reused by the next: a state of any tree is large to copy.
#[derive(Clone, Debug)]
pub(crate) struct Room<S> {
    at: State<S>,
    k: [State<S>; 2],
    /// The state at the end of the trial.
    // boxed, as it changes hands
    pub end: Box<State<S>>,
    /// Rate there: the first stage of the next step.
    pub rate: Box<State<S>>,
}

impl<S: Scalar> Room<S> {
    /// Space for states of this shape.
    pub(crate) fn new(shape: Shape) -> Self {
        let zero = State::zero(shape);
        Room { at: zero, k: [zero; 2], end: Box::new(zero), rate: Box::new(zero) }
    }

    /// Tries a step `h` (s) from `state` with the rate `k1`; `rate` is called three times, last with [`Stage::End`].
    #[inline(always)]
    pub(crate) fn attempt(
        &mut self,
        state: &State<S>,
        k1: &State<S>,
        h: S,
        tolerance: &Tolerance<S>,
        mut rate: impl FnMut(Stage, &State<S>, &mut State<S>),
    ) -> Errors<S> {
        let Room { at, k: [k2, k3], end, rate: k4 } = self;
        at.advance(state, S::of(0.5) * h, k1);
        rate(Stage::Within(0.5), at, k2);
        at.advance(state, S::of(0.75) * h, k2);
        rate(Stage::Within(0.75), at, k3);
        at.advance(k1, S::of(1.5), k2);
        at.add(S::of(2.0), k3);
        end.advance(state, h * S::of(2.0 / 9.0), at);
        end.normalize();
        rate(Stage::End, end, k4);
        // third-order weights 2/9, 1/3, 4/9, 0 less second-order weights 7/24, 1/4, 1/3, 1/8
        at.sum(&[(h * S::of(-5.0 / 72.0), k1), (h / S::of(12.0), k2), (h / S::of(9.0), k3), (h / S::of(-8.0), k4)]);
        let whole = norm(at, state, end, tolerance);
        let mut within = whole;
        // not a number is no less than that
        if S::any(!whole.lt(S::one())) {
            at.sum(&[(h * S::of(2.0 / 9.0), k1), (h * S::of(-2.0 / 3.0), k2), (h * S::of(4.0 / 9.0), k3)]);
            within = norm(at, state, end, tolerance);
        }
        Errors { whole, within }
    }
}

/// State after a step `h` (s) and the rates of the three later stages, the last at its end.
#[inline(always)]
pub fn stages<S: Scalar>(
    state: &State<S>,
    k1: &State<S>,
    h: S,
    mut rate: impl FnMut(Stage, &State<S>, &mut State<S>),
) -> (State<S>, [State<S>; 3]) {
    let [mut k2, mut k3, mut k4] = [State::zero(state.shape()); 3];
    rate(Stage::Within(0.5), &state.advanced(S::of(0.5) * h, k1), &mut k2);
    rate(Stage::Within(0.75), &state.advanced(S::of(0.75) * h, &k2), &mut k3);
    let mut sum = k1.advanced(S::of(1.5), &k2);
    sum.add(S::of(2.0), &k3);
    let mut end = state.advanced(h * S::of(2.0 / 9.0), &sum);
    end.normalize();
    rate(Stage::End, &end, &mut k4);
    (end, [k2, k3, k4])
}

/// State at the fraction `s` of a step `h` (s), from states and rates at its ends: cubic in time, of third order like
/// the step.
pub fn within<S: Scalar>(from: [&State<S>; 2], to: [&State<S>; 2], h: S, s: S) -> State<S> {
    let ([start, k1], [end, k4]) = (from, to);
    let r = S::one() - s;
    let way = end.advanced(S::of(-1.0), start);
    let mut state = start.advanced(s * s * (S::of(3.0) - S::of(2.0) * s), &way);
    state.add(h * s * r * r, k1);
    state.add(-h * s * s * r, k4);
    state.normalize();
    state
}

/// Root mean square of the components of `error` in units of their tolerance.
#[inline(always)]
fn norm<S: Scalar>(error: &State<S>, from: &State<S>, to: &State<S>, tolerance: &Tolerance<S>) -> S {
    let mut sum = Sum { squares: S::zero(), count: 0.0 };
    let place = tolerance.absolute_m;
    for body in error.shape().bodies() {
        sum.add(error.t1_of(body), place);
        sum.add(error.velocity_of(body), tolerance.of_speed(from.velocity_of(body), to.velocity_of(body)));
    }
    for i in error.turns() {
        // a small change dq of a unit quaternion turns by 2|dq|
        let q = error.orientation(i);
        sum.add(q.v * S::of(2.0), place);
        sum.add(error.omega(i), tolerance.of_speed(from.omega(i), to.omega(i)));
    }
    for i in 0..error.hinge().len() {
        sum.add(along(error.hinge()[i]), place);
        let speed = tolerance.of_speed(along(from.hinge_rate()[i]), along(to.hinge_rate()[i]));
        sum.add(along(error.hinge_rate()[i]), speed);
    }
    for i in 0..error.own().len() {
        // of the order of 1
        let size = from.own()[i].abs().max(to.own()[i].abs());
        sum.add(along(error.own()[i]), place + tolerance.relative * size);
    }
    (sum.squares / S::of(sum.count)).sqrt()
}

/// A vector with one component.
#[inline(always)]
fn along<S: Scalar>(x: S) -> V3<S> {
    V3 { x, ..V3::zero() }
}

impl<S: Scalar> Tolerance<S> {
    /// Tolerance for the greater of two velocities.
    #[inline(always)]
    fn of_speed(&self, a: V3<S>, b: V3<S>) -> S {
        let size = a.norm_squared().max(b.norm_squared()).sqrt();
        self.absolute_m_s + self.relative * size
    }
}

struct Sum<S> {
    squares: S,
    count: f64,
}

impl<S: Scalar> Sum<S> {
    #[inline(always)]
    fn add(&mut self, error: V3<S>, tolerance: S) {
        self.squares += error.norm_squared() / (tolerance * tolerance);
        self.count += 1.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::tti12::TTI12;
    use crate::motion::layout::Layout;
    use crate::motion::state::Quat;
    use crate::motion::vector::v3;

    /// T1 turns about the origin with 1 rad/s; everything else is at rest.
    fn swing(state: &State<f64>) -> State<f64> {
        let mut rate = State::zero(state.shape());
        rate.set_t1(state.velocity());
        rate.set_velocity(state.t1() * -1.0);
        rate
    }

    fn start() -> State<f64> {
        let mut state = State::zero(Shape::of(&Layout::of(&TTI12)));
        state.set_t1(v3(1.0, 0.0, 0.0));
        for i in state.turns() {
            state.set_orientation(i, Quat { w: 1.0, v: V3::zero() });
        }
        state
    }

    /// Errors of one step at its middle and its end, m, and their estimate in units of 1 m.
    fn errors(h: f64) -> [f64; 3] {
        let tolerance = Tolerance { relative: 0.0, absolute_m: 1.0, absolute_m_s: 1.0 };
        let (start, k1) = (start(), swing(&start()));
        let mut room = Room::new(start.shape());
        let errors = room.attempt(&start, &k1, h, &tolerance, |_, state, rate| *rate = swing(state));
        let middle = within([&start, &k1], [&room.end, &room.rate], h, 0.5);
        [(middle.t1().x - (0.5 * h).cos()).abs(), (room.end.t1().x - h.cos()).abs(), errors.whole]
    }

    #[test]
    fn a_step_and_its_course_have_errors_of_fourth_order_and_the_estimate_one_of_third() {
        let (coarse, fine) = (errors(0.02), errors(0.01));
        for (i, order) in [(0, 4.0), (1, 4.0), (2, 3.0)] {
            let observed = (coarse[i] / fine[i]).log2();
            // Measured: 4.00, 4.00, 3.00.
            assert!((observed - order).abs() < 0.05, "{i}: {observed}");
        }
    }

    #[test]
    fn a_course_begins_and_ends_where_its_step_does() {
        let (start, k1) = (start(), swing(&start()));
        let end = start.advanced(0.1, &k1);
        let (from, to) = ([&start, &k1], [&end, &swing(&end)]);
        assert_eq!(within(from, to, 0.1, 0.0), start);
        assert_eq!(within(from, to, 0.1, 1.0).t1(), end.t1());
    }
}
