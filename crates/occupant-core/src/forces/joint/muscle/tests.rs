//! Activation and torque of muscles.

use nalgebra::Vector3;

use super::*;
use crate::body::tti12::NECK;
use crate::forces::decay::decay;
use crate::forces::joint::BallJoint;
use crate::forces::joint::limit::{Limits, Lock, free_neck, nodding};
use crate::model::Model;
use crate::results::energy::EnergyLedger;
use crate::results::recorder::Watch;
use crate::results::sample::Sample;
use crate::run::simulate::simulate;

#[test]
fn decay_is_the_exponential() {
    for i in 0..320 {
        let x = f64::from(i) * 0.1;
        assert!((decay(x) / (-x).exp() - 1.0).abs() < 3e-14, "{x}");
    }
    assert_eq!((decay(0.0), decay(1e30)), (1.0, decay(32.0)));
}

/// Time, energies and muscles at an output.
type Output = (f64, EnergyLedger, Vec<MuscleAction<f64>>);

/// Outputs of a run, and its energy error.
fn run(model: &Model) -> (Vec<Output>, f64) {
    let mut list = Vec::new();
    let watch = Watch(|s: &Sample<'_>| list.push((s.time_s, s.energy, s.actions.muscles.clone())));
    let outcome = simulate(model, watch).unwrap();
    (list, outcome.energy.balance_error)
}

/// Neck muscle that activates over 30 ms from 10 ms until 80 ms.
fn waking() -> Muscle {
    Muscle { most_n_m: 12.0, tone: 0.2, rise_s: 0.01, times_s: [0.04, 0.08], ..tense() }
}

/// Fully active, without a limit.
fn tense() -> Muscle {
    Muscle {
        joint: NECK,
        stiffness_n_m: 60.0,
        damping_n_m_s: 1.0,
        reflex: None,
        most_n_m: NEVER_S,
        hold: None,
        torque_n_m: Vector3::zeros(),
        tone: 1.0,
        carries: true,
        rise_s: 1.0,
        times_s: [NEVER_S; 2],
    }
}

/// Head that nods at this rate, rad/s, against a muscle.
fn held(rate: f64, muscle: Muscle) -> Model {
    nodding(rate, |joints| joints.muscles.push(muscle))
}

/// ȧ = (u − a)/τ, integrated in small steps.
#[test]
fn the_activation_follows_its_aim() {
    let (list, _) = run(&held(5.0, waking()));
    let (mut a, mut t) = (0.2, 0.0);
    for (time_s, _, muscles) in &list {
        while t < time_s - 1e-9 {
            let aim = |t: f64| if (0.04..0.08).contains(&t) { 1.0 } else { 0.2 };
            let h = 1e-6;
            // the exact step of a constant aim
            a = aim(t + 0.5 * h) + (a - aim(t + 0.5 * h)) * (-h / 0.01_f64).exp();
            t += h;
        }
        assert!((muscles[0].activation - a).abs() < 1e-8, "{time_s}: {} {a}", muscles[0].activation);
    }
}

#[test]
fn no_muscle_is_stronger_than_its_limit_and_its_work_is_kept() {
    let (list, balance_error) = run(&held(20.0, waking()));
    let most = list.iter().map(|(_, _, m)| m[0].moment.norm_squared().sqrt() / m[0].activation).fold(0.0, f64::max);
    assert!((most - 12.0).abs() < 1e-9, "{most}");
    assert!(balance_error < 1e-6, "{balance_error:e}");
    // all that the head has lost went into the muscle
    let (first, last) = (list[0].1, list.last().unwrap().1);
    let taken = last.lost_j[WORK];
    assert!(taken.abs() > 0.5 && (first.kinetic_j - last.kinetic_j - taken).abs() < 1e-5, "{taken}");
}

/// Fully active and without a limit, it is a spring with a damper.
#[test]
fn a_tense_muscle_is_a_spring_and_a_damper() {
    let muscle = held(10.0, tense());
    let spring = nodding(10.0, |joints| {
        *joints.ball_mut(NECK).unwrap() =
            BallJoint { damping_n_m_s: 1.0, twist_damping_n_m_s: 1.0, ..BallJoint::default() };
        let lock = Some(Lock { until: 1e30, stiffness: 60.0, slips: false, relock_below: 0.0 });
        joints.limits.push(Limits { lock, ..free_neck() });
    });
    let end = |model: &Model| {
        let mut omega = Vec::new();
        let watch = Watch(|s: &Sample<'_>| omega.push(s.evaluation.kinematics.omega[2].y));
        simulate(model, watch).unwrap();
        omega
    };
    let (one, other) = (end(&muscle), end(&spring));
    let apart = one.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(one[0] == 10.0 && one.iter().any(|omega| *omega < 0.0));
    // measured: the tolerance of the integration
    assert!(apart < 1e-6, "{apart:e}");
}
