//! Descent in potential energy to where a body rests: Newton's method, shifted so that it descends.
//!
//! (H + λ1) δ = −g,   g = ∂V/∂x, H its differences, made symmetric
//!
//! A step is accepted if V falls, ½(g + g′)·δ < 0.

use nalgebra::{DMatrix, DVector};

use crate::motion::state::State;

/// Largest motion of a freedom in one step, m: the forces are stiff and only piecewise smooth.
const MOST_STEP_M: f64 = 0.03;
/// Displacement of each freedom for difference quotients, m.
const DIFFERENCE_M: f64 = 1e-6;
/// Fraction of the weight below which loads count as zero.
pub(super) const REST: f64 = 1e-8;
/// Largest number of steps.
const MOST_STEPS: usize = 1000;
/// Motion of every freedom below which a step gains nothing, m: the load jumps there, or has reached its last digits.
const NOWHERE_M: f64 = 1e-12;

/// A body that can be moved by its freedoms, metres or angles times a lever.
pub(super) trait Movable {
    /// ∂V/∂x at a position.
    fn gradient(&mut self, state: &State<f64>) -> DVector<f64>;

    /// Position moved by `x` from another.
    fn moved(&self, state: &State<f64>, x: &DVector<f64>) -> State<f64>;

    /// Whether its number of evaluations is used up.
    fn is_spent(&self) -> bool;

    /// ∂²V/∂x².
    fn hessian(&mut self, state: &State<f64>, g: &DVector<f64>) -> DMatrix<f64> {
        let column = |i: usize| {
            let step = DVector::from_fn(g.len(), |j, _| if i == j { DIFFERENCE_M } else { 0.0 });
            let next = self.moved(state, &step);
            (self.gradient(&next) - g) / DIFFERENCE_M
        };
        let columns: Vec<DVector<f64>> = (0..g.len()).map(column).collect();
        let hessian = DMatrix::from_columns(&columns);
        (&hessian + hessian.transpose()) * 0.5
    }
}

/// Position below `from` where `body` rests, or where V falls no further, and the gradient there.
pub(super) fn descend(body: &mut impl Movable, from: &State<f64>, weight_n: f64) -> (State<f64>, DVector<f64>) {
    let (mut state, mut g) = (*from, body.gradient(from));
    let mut shift = 1e-3;
    for _ in 0..MOST_STEPS {
        if g.amax() < REST * weight_n.max(1.0) || body.is_spent() {
            break;
        }
        let hessian = body.hessian(&state, &g);
        let scale = hessian.diagonal().amax();
        let taken = std::iter::repeat_with(|| {
            let tried = downhill(&hessian, &g, shift * scale).map(|step| {
                let next = body.moved(&state, &step);
                let slope = body.gradient(&next);
                (next, (&g + &slope).dot(&step) < 0.0, slope, step.amax())
            });
            let found = tried.filter(|(_, falls, ..)| *falls);
            shift = if found.is_some() { (shift * 0.2).max(1e-12) } else { shift * 4.0 };
            found
        });
        let Some((next, _, slope, moved_m)) = taken.take(40).flatten().next() else { break };
        (state, g) = (next, slope);
        if moved_m < NOWHERE_M {
            break;
        }
    }
    (state, g)
}

/// −(H + λ1)⁻¹g, shortened to the largest step; none if H + λ1 is not positive definite.
fn downhill(hessian: &DMatrix<f64>, g: &DVector<f64>, shift: f64) -> Option<DVector<f64>> {
    let shifted = hessian + DMatrix::from_diagonal_element(g.len(), g.len(), shift + 1e-9);
    let step = -shifted.cholesky()?.solve(g);
    let most = step.amax();
    Some(if most > MOST_STEP_M { step * (MOST_STEP_M / most) } else { step })
}
