//! The embedded 3(2) pair of Bogacki and Shampine (Appl. Math. Lett. 2, 1989, 321–325), with the error of a step in units
//! of the tolerance, and the course of the state within a step.
//!
//! The forces of a crash have a corner every millisecond or two, where a contact begins or turns, and friction that sticks
//! bounds the step of any explicit method. A pair of higher order spends its stages in vain there: at equal error the one of
//! Dormand and Prince takes more evaluations at every tolerance (measured in `docs/accuracy.md`).

use crate::motion::scalar::Scalar;
use crate::motion::state::State;
use crate::motion::vector::V3;

/// Evaluations of a step whose first stage is known.
pub(crate) const EVALUATIONS: u64 = 3;

/// The least power of the step in the error estimate.
pub(crate) const ERROR_ORDER: f64 = 3.0;

/// Where in a step a rate is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stage {
    /// Inside, at this fraction of the step.
    Within(f64),
    /// At its end, for the state that the step leads to.
    End,
}

/// Tolerances of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tolerance {
    /// On speeds, relative to their size.
    pub relative: f64,
    /// On positions, m; angles count at a radius of 1 m.
    pub absolute_m: f64,
    /// On speeds, m/s; angular speeds count at a radius of 1 m.
    pub absolute_m_s: f64,
}

/// A trial step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trial {
    /// The state at its end.
    pub state: State<f64>,
    /// The rate there: the first stage of the next step.
    pub rate: State<f64>,
    /// Root mean square of error over tolerance; up to 1 is accepted.
    pub error: f64,
    /// The same from what is known before the end, where that may jump: from the midpoint rule. That of all where it is
    /// accepted.
    pub error_within: f64,
}

/// Tries a step `h` (s) from `state`, whose rate is `k1`; `rate` is called three times, last with [`Stage::End`].
pub(crate) fn attempt(
    state: &State<f64>,
    k1: &State<f64>,
    h: f64,
    tolerance: &Tolerance,
    rate: impl FnMut(Stage, &State<f64>, &mut State<f64>),
) -> Trial {
    let (end, [k2, k3, k4]) = stages(state, k1, h, rate);
    // third-order weights 2/9, 1/3, 4/9, 0 less second-order weights 7/24, 1/4, 1/3, 1/8
    let mut error = State::zero(state.shape());
    for (weight, rate) in [(h * (-5.0 / 72.0), k1), (h / 12.0, &k2), (h / 9.0, &k3), (h / -8.0, &k4)] {
        error.add(weight, rate);
    }
    let error = norm(&error, state, &end, tolerance);
    let mut error_within = error;
    // not a number is no less than that
    if error.is_nan() || error > 1.0 {
        let mut within = State::zero(state.shape());
        for (weight, rate) in [(h * (2.0 / 9.0), k1), (h * (-2.0 / 3.0), &k2), (h * (4.0 / 9.0), &k3)] {
            within.add(weight, rate);
        }
        error_within = norm(&within, state, &end, tolerance);
    }
    Trial { error, error_within, state: end, rate: k4 }
}

/// The state after a step `h` (s) and the rates of the three later stages, the last of them at its end.
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

/// The state at fraction `s` of a step `h` (s), from states and rates at its ends: cubic in time, third order like the step.
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
fn norm(error: &State<f64>, from: &State<f64>, to: &State<f64>, tolerance: &Tolerance) -> f64 {
    let mut sum = Sum::default();
    let place = tolerance.absolute_m;
    let speed = |a: V3<f64>, b: V3<f64>| {
        let size = a.norm_squared().max(b.norm_squared()).sqrt();
        tolerance.absolute_m_s + tolerance.relative * size
    };
    for body in error.shape().bodies() {
        sum.add(error.t1_of(body), place);
        sum.add(error.velocity_of(body), speed(from.velocity_of(body), to.velocity_of(body)));
    }
    for i in error.turns() {
        // a small change dq of a unit quaternion turns by 2|dq|
        let q = error.orientation(i);
        sum.add(q.v * 2.0, place);
        sum.add(error.omega(i), speed(from.omega(i), to.omega(i)));
    }
    let scalar = |x: f64| V3 { x, y: 0.0, z: 0.0 };
    for (i, angle) in error.hinge().iter().enumerate() {
        sum.add(scalar(*angle), place);
        let [rate, from, to] = [error, from, to].map(|state| scalar(state.hinge_rate()[i]));
        sum.add(rate, speed(from, to));
    }
    for (error, (from, to)) in error.own().iter().zip(from.own().iter().zip(to.own())) {
        // of the order of 1
        sum.add(scalar(*error), place + tolerance.relative * from.abs().max(to.abs()));
    }
    (sum.squares / sum.count).sqrt()
}

#[derive(Default)]
struct Sum {
    squares: f64,
    count: f64,
}

impl Sum {
    fn add(&mut self, error: V3<f64>, tolerance: f64) {
        self.squares += error.norm_squared() / (tolerance * tolerance);
        self.count += 1.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::tti12::TTI12;
    use crate::motion::layout::Layout;
    use crate::motion::state::{Quat, Shape};
    use crate::motion::vector::v3;

    /// T1 swings about the origin with 1 rad/s; all else stands still.
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

    /// Errors of one step, in its middle and at its end, m, and its estimate in units of 1 m.
    fn errors(h: f64) -> [f64; 3] {
        let tolerance = Tolerance { relative: 0.0, absolute_m: 1.0, absolute_m_s: 1.0 };
        let (start, k1) = (start(), swing(&start()));
        let trial = attempt(&start, &k1, h, &tolerance, |_, state, rate| *rate = swing(state));
        let middle = within([&start, &k1], [&trial.state, &trial.rate], h, 0.5);
        [(middle.t1().x - (0.5 * h).cos()).abs(), (trial.state.t1().x - h.cos()).abs(), trial.error]
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
