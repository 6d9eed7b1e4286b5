//! The reference formulation against the five states of `data/appendix3.json`, term by term, with ε = 0.
//!
//! Errors are relative, element by element; those of D relative to √(D_jj D_kk), because some of its elements vanish
//! and the file holds rounding there. Elements that are zero in the file must be zero to the same bound.

use occupant_tests::{
    golden::{Golden, GoldenState},
    reference::{DOF, Equations, equations_of_motion, joint_angle, kinetic_energy},
};

const BOUND: f64 = 2e-12;

#[test]
fn joint_angles_and_kinetic_energy_agree() {
    let golden = Golden::load();
    let body = golden.body();
    for state in &golden.states {
        let (q, rates) = state.coordinates();
        // Measured: 2e-16, 2e-16, 3e-16.
        let upper = joint_angle(&q, 1, 2, 0.0);
        assert!(error(upper, state.upper_back_angle) < BOUND);
        let lower = joint_angle(&q, 1, 4, 0.0);
        assert!(error(lower, state.lower_back_angle) < BOUND);
        let energy = kinetic_energy(&body, &q, &rates);
        assert!(error(energy, state.kinetic_energy) < BOUND);
    }
}

#[test]
fn d_agrees() {
    // Measured: 5.9e-16.
    let worst = worst_of(|equations, state| {
        let mut worst: f64 = 0.0;
        for j in 0..DOF {
            for k in 0..DOF {
                let size = (state.d[j][j] * state.d[k][k]).sqrt();
                worst = worst.max((equations.d[(j, k)] - state.d[j][k]).abs() / size);
            }
        }
        worst
    });
    assert!(worst < BOUND, "{worst:e}");
}

#[test]
fn e_agrees() {
    // Measured: 9.8e-14.
    let worst = worst_of(|equations, state| largest(&equations.e, &state.e));
    assert!(worst < BOUND, "{worst:e}");
}

#[test]
fn f_p_agrees() {
    // Measured: 3.2e-15.
    let worst = worst_of(|equations, state| largest(&equations.f_p, &state.f_p));
    assert!(worst < BOUND, "{worst:e}");
}

#[test]
fn f_s_agrees() {
    // Measured: 1.3e-13.
    let worst = worst_of(|equations, state| largest(&equations.f_s, &state.f_s));
    assert!(worst < BOUND, "{worst:e}");
}

#[test]
fn q_f_agrees() {
    // Measured: 2.2e-14.
    let worst = worst_of(|equations, state| largest(&equations.q_f, &state.q_f));
    assert!(worst < BOUND, "{worst:e}");
}

#[test]
fn r_agrees() {
    // Measured: 1.2e-14.
    let worst = worst_of(|equations, state| largest(&equations.r, &state.r));
    assert!(worst < BOUND, "{worst:e}");
}

#[test]
fn accelerations_agree() {
    // Measured: 2.3e-13.
    let worst = worst_of(|equations, state| largest(&equations.accelerations, &state.q_acceleration));
    assert!(worst < BOUND, "{worst:e}");
}

/// The largest error over the five states.
fn worst_of(error: impl Fn(&Equations, &GoldenState) -> f64) -> f64 {
    let golden = Golden::load();
    assert_eq!(golden.states.len(), 5);
    let errors = golden.states.iter().map(|state| {
        let (q, rates) = state.coordinates();
        error(&equations_of_motion(&golden.system(state), &q, &rates), state)
    });
    errors.fold(0.0, f64::max)
}

fn largest(found: &[f64; DOF], expected: &[f64]) -> f64 {
    assert_eq!(expected.len(), DOF);
    let errors = found.iter().zip(expected).map(|(&f, &e)| error(f, e));
    errors.fold(0.0, f64::max)
}

fn error(found: f64, expected: f64) -> f64 {
    let size = if expected == 0.0 { 1.0 } else { expected.abs() };
    (found - expected).abs() / size
}
