//! The embedded 5(4) pair of Dormand and Prince, with the error of a step in units of the tolerance.

use crate::kernel::scalar::Scalar;
use crate::kernel::state::State;
use crate::kernel::vector::V3;

/// Nodes of the stages as fractions of the step.
pub const NODES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];

/// Weights of the earlier stages in each later one; the last row is the fifth-order solution.
const STAGES: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
    ],
    &[
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
    ],
    &[
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];

/// Fifth-order weights less fourth-order weights.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// Tolerances of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// On speeds, relative to their size.
    pub relative: f64,
    /// On positions, m; angles count at a radius of 1 m.
    pub absolute_m: f64,
    /// On speeds, m/s; angular speeds count at a radius of 1 m.
    pub absolute_m_s: f64,
}

/// A trial step.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// The state at its end.
    pub state: State<f64>,
    /// The rate there: the first stage of the next step.
    pub rate: State<f64>,
    /// Root mean square of error over tolerance; up to 1 is accepted.
    pub error: f64,
}

/// Tries a step `h` (s) from `state`, whose rate is `first`; `rate` gets the fraction of the step.
pub fn attempt(
    state: &State<f64>,
    first: &State<f64>,
    h: f64,
    tolerance: &Tolerance,
    rate: impl FnMut(f64, &State<f64>) -> State<f64>,
) -> Trial {
    let (at, k) = stages(state, first, h, rate);
    let mut error = State::zero();
    for (weight, k) in ERROR.iter().zip(&k) {
        error = error.advanced(h * weight, k);
    }
    Trial {
        state: at,
        rate: k[6],
        error: norm(&error, state, &at, tolerance),
    }
}

/// The state after a step `h` (s) and the rates of all stages, the last of them at its end.
#[inline(always)]
pub fn stages<S: Scalar>(
    state: &State<S>,
    first: &State<S>,
    h: f64,
    mut rate: impl FnMut(f64, &State<S>) -> State<S>,
) -> (State<S>, [State<S>; 7]) {
    let mut k = [*first; 7];
    let mut at = *state;
    for (i, weights) in STAGES.iter().enumerate() {
        at = *state;
        for (weight, k) in weights.iter().zip(&k) {
            if *weight != 0.0 {
                at = at.advanced(S::of(h * weight), k);
            }
        }
        if i == 5 {
            at.normalize();
        }
        k[i + 1] = rate(NODES[i + 1], &at);
    }
    (at, k)
}

/// Root mean square of the components of `error` in units of their tolerance.
fn norm(error: &State<f64>, from: &State<f64>, to: &State<f64>, tolerance: &Tolerance) -> f64 {
    let mut sum = Sum::default();
    let place = tolerance.absolute_m;
    let speed = |a: V3<f64>, b: V3<f64>| {
        let size = a.norm_squared().max(b.norm_squared()).sqrt();
        tolerance.absolute_m_s + tolerance.relative * size
    };
    sum.add(error.t1, place);
    sum.add(error.velocity, speed(from.velocity, to.velocity));
    for i in 0..error.orientation.len() {
        // a small change dq of a unit quaternion turns by 2|dq|
        let q = error.orientation[i];
        sum.add(q.v * 2.0, place);
        sum.add(error.omega[i], speed(from.omega[i], to.omega[i]));
    }
    for i in 0..error.hinge.len() {
        let scalar = |x: f64| V3 { x, y: 0.0, z: 0.0 };
        sum.add(scalar(error.hinge[i]), place);
        let rates = (scalar(from.hinge_rate[i]), scalar(to.hinge_rate[i]));
        sum.add(scalar(error.hinge_rate[i]), speed(rates.0, rates.1));
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
