//! Searches for rest where the load jumps: there is none to find, so they end soon, at the jump.

use nalgebra::{DVector, Vector6};

use super::{balanced, descend};
use crate::model::descent::Movable;
use crate::motion::state::{Shape, State};
use crate::motion::vector::v3;

/// Place of the jump, m.
const JUMP_M: f64 = 0.01;
/// Most evaluations of the load: an iteration that goes on at the jump takes 505, a descent thousands.
const FEW: usize = 400;

/// Load at a place: a spring of 10 kN/m about the jump, and 50 N towards it from both sides, as where a sphere passes from
/// one face to another.
fn load_n(x_m: f64) -> f64 {
    1e4 * (x_m - JUMP_M) + if x_m < JUMP_M { -50.0 } else { 50.0 }
}

#[test]
fn an_iteration_ends_at_a_jump_of_the_load() {
    let mut looks = 0;
    let mut load = |x: &Vector6<f64>| {
        looks += 1;
        Some(Vector6::new(load_n(x[0]), 1e4 * x[1], 1e4 * x[2], 1e4 * x[3], 1e4 * x[4], 1e4 * x[5]))
    };
    let first = load(&Vector6::zeros()).unwrap();
    let (x, r) = balanced(first, 1e-7, load);
    assert!((x[0] - JUMP_M).abs() < 1e-6 && (50.0..50.1).contains(&r[0].abs()), "{x} {r}");
    assert!(looks < FEW, "{looks} evaluations");
}

struct Jumping {
    looks: usize,
}

impl Movable for Jumping {
    fn gradient(&mut self, state: &State<f64>) -> DVector<f64> {
        self.looks += 1;
        DVector::from_element(1, load_n(state.t1().x))
    }

    fn moved(&self, state: &State<f64>, x: &DVector<f64>) -> State<f64> {
        let mut moved = *state;
        moved.set_t1(state.t1() + v3(x[0], 0.0, 0.0));
        moved
    }

    fn is_spent(&self) -> bool {
        false
    }
}

#[test]
fn a_descent_ends_at_a_jump_of_the_load() {
    let mut body = Jumping { looks: 0 };
    let (state, _) = descend(&mut body, &State::zero(Shape::new(0, 0)), 700.0);
    assert!((state.t1().x - JUMP_M).abs() < 1e-9, "{}", state.t1().x);
    assert!(body.looks < FEW, "{} evaluations", body.looks);
}
