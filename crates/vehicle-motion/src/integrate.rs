//! The pair of Bogacki and Shampine, orders 3 and 2, with error control (Appl. Math. Lett. 2 (1989) 321).

use crate::chassis::{NUMBERS, State};

/// What the error of a step is measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of places and jounces, m.
    pub place_m: f64,
    /// Of velocities, and of spins and rotations times 1 m, m/s.
    pub speed_m_s: f64,
    /// Of each number, relative.
    pub relative: f64,
    /// Longest step, s.
    pub longest_s: f64,
}

impl Default for Tolerance {
    fn default() -> Self {
        Tolerance { place_m: 1e-5, speed_m_s: 1e-4, relative: 1e-5, longest_s: 0.02 }
    }
}

/// The state after a step, its rate there, and its error in units of the tolerance.
pub(crate) struct Trial {
    pub state: State,
    pub rate: State,
    pub error: f64,
}

/// `state` and `share` of the step's rates.
pub(crate) fn moved(state: &State, parts: &[(f64, &State)]) -> State {
    let mut out = *state;
    for (share, rate) in parts {
        for (to, by) in out.0.iter_mut().zip(&rate.0) {
            *to += share * by;
        }
    }
    out
}

/// Tries a step of `h` s from `state`, whose rate is `k1`; `rate` is called with the share of the step.
pub(crate) fn attempt(
    state: &State,
    k1: &State,
    h: f64,
    tolerance: &Tolerance,
    mut rate: impl FnMut(f64, &State) -> State,
) -> Trial {
    let k2 = rate(0.5, &moved(state, &[(0.5 * h, k1)]));
    let k3 = rate(0.75, &moved(state, &[(0.75 * h, &k2)]));
    let mut end = moved(state, &[(2.0 / 9.0 * h, k1), (h / 3.0, &k2), (4.0 / 9.0 * h, &k3)]);
    let length = end.0[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
    end.0[3..7].iter_mut().for_each(|x| *x /= length);
    let k4 = rate(1.0, &end);
    // third-order weights less 7/24, 1/4, 1/3, 1/8
    let weights = [-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0];
    let error = |i: usize| {
        let ks = [k1.0[i], k2.0[i], k3.0[i], k4.0[i]];
        h * weights.iter().zip(ks).map(|(w, k)| w * k).sum::<f64>()
    };
    let mut most = 0.0f64;
    for i in 0..NUMBERS {
        let scale = scale(i, &end, tolerance);
        let share = (error(i) / scale).abs();
        // a number that is none counts as far too large
        most = if share.is_nan() { f64::INFINITY } else { most.max(share) };
    }
    Trial { state: end, rate: k4, error: most }
}

/// Largest error of a number of the state.
fn scale(i: usize, state: &State, tolerance: &Tolerance) -> f64 {
    let relative = tolerance.relative * state.0[i].abs();
    match i {
        // a place far from the origin is no less exact
        0..3 => tolerance.place_m,
        13..17 => tolerance.place_m,
        3..7 => tolerance.place_m,
        7..13 | 17..21 => tolerance.speed_m_s + relative,
        21..25 => 3.0 * tolerance.speed_m_s + relative,
        25..33 => 10.0 * tolerance.place_m,
        // work follows what is integrated
        _ => f64::INFINITY,
    }
}

/// The next step after one of `h` s with an error, s (Gustafsson's proportional–integral control).
pub(crate) fn next_step(h: f64, error: f64, before: f64, is_accepted: bool) -> f64 {
    if !error.is_finite() {
        return 0.1 * h;
    }
    let error = error.max(1e-6);
    if is_accepted {
        let growth = 0.9 * libm::pow(error, -0.7 / 3.0) * libm::pow(before.max(1e-4), 0.4 / 3.0);
        h * growth.clamp(0.2, 4.0)
    } else {
        h * (0.9 * libm::pow(error, -1.0 / 3.0)).clamp(0.1, 0.9)
    }
}
