//! The reference's joints against the torques that the joint model states, as vectors.

use nalgebra::Vector3;
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::forces::joint::{BallJoint, HingeJoint, Joints, Stop};
use occupant_tests::{
    random::Random,
    reference::{DOF, ball, damping_forces, hinge, joint_angle, space_velocities, spine_energy},
    reference::{Dual, SpaceMotion},
    space_state::SpaceState,
};

/// Ball joints as (joint, k, l) with k and l counted among the free segments 1–6, 9, 10.
fn balls(joints: &Joints) -> [(BallJoint, usize, usize); 7] {
    [
        (ball(joints, tti12::NECK), 1, 2),
        (ball(joints, tti12::RIGHT_SHOULDER), 1, 5),
        (ball(joints, tti12::LEFT_SHOULDER), 1, 4),
        (ball(joints, tti12::UPPER_BACK), 0, 1),
        (ball(joints, tti12::LOWER_BACK), 0, 3),
        (ball(joints, tti12::RIGHT_HIP), 3, 7),
        (ball(joints, tti12::LEFT_HIP), 3, 6),
    ]
}

#[test]
fn damping_and_springs_do_the_work_of_their_torques() {
    let mut worst: f64 = 0.0;
    for seed in 0..20 {
        let mut random = Random::new(seed);
        let (body, joints) = (random.body(), random.joints());
        let (q, rates) = random.report_state();
        let state = SpaceState::from_report(&body, &q, &rates);
        let torques = balls(&joints).map(|(ball, k, l)| (torque(&ball, &joints, &state, k, l), k, l));
        let damping = damping_forces(&joints, &q, &rates);
        for (j, damping_j) in damping.iter().enumerate() {
            let column = space_velocities(&q, &unit(j));
            let spring = -spine_energy(&joints, &varied(&q, j)).slope;
            let found = damping_j + spring - hinge_part(&joints, &q, &rates, j);
            let expected = torques.iter().map(|(t, k, l)| work(t, &column, *k, *l)).sum::<f64>();
            worst = worst.max((found - expected).abs() / 400.0);
        }
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 1.5e-15.
}

/// T = −J [n (n·ω) + ε² ω_⊥]/(s² + ε²) − J_t Z_l (Z_l·ω) − K (β − β₀) n/√(s² + ε²) on l.
fn torque(ball: &BallJoint, joints: &Joints, state: &SpaceState, k: usize, l: usize) -> Vector3<f64> {
    let z = |i: usize| state.turn[i] * Vector3::z();
    let (z_k, z_l) = (z(k), z(l));
    let n = z_k.cross(&z_l);
    let omega = state.speed.angular[l] - state.speed.angular[k];
    let across = omega - z_k * z_k.dot(&omega);
    let e2 = joints.epsilon * joints.epsilon;
    let w = (n.norm_squared() + e2).sqrt();
    let beta = w.atan2(z_k.dot(&z_l));
    let stop = ball.stop.filter(|_| n.dot(&omega) > 0.0);
    let damping = stop.map_or(ball.damping_n_m_s, |s| {
        let way = ((beta - s.begin_rad) / (s.full_rad - s.begin_rad)).clamp(0.0, 1.0);
        (1.0 - way) * ball.damping_n_m_s + way * s.damping_n_m_s
    });
    let spring = ball.spring.map_or(0.0, |s| s.stiffness_n_m * (beta - s.rest_rad.unwrap_or(f64::NAN)));
    -damping * (n * n.dot(&omega) + e2 * across) / (w * w)
        - ball.twist_damping_n_m_s * z_l * z_l.dot(&omega)
        - spring * n / w
}

fn work(torque: &Vector3<f64>, column: &SpaceMotion, k: usize, l: usize) -> f64 {
    torque.dot(&(column.angular[l] - column.angular[k]))
}

/// R of an elbow or knee: −J α̇ in its own coordinate.
fn hinge_part(joints: &Joints, q: &[f64; DOF], rates: &[f64; DOF], j: usize) -> f64 {
    let hinge = match j + 1 {
        22 => hinge(joints, tti12::LEFT_ELBOW),
        23 => hinge(joints, tti12::RIGHT_ELBOW),
        30 => hinge(joints, tti12::LEFT_KNEE),
        31 => hinge(joints, tti12::RIGHT_KNEE),
        _ => return 0.0,
    };
    let stop = [hinge.lower_stop, hinge.upper_stop][usize::from(rates[j] > 0.0)];
    let damping = stop.map_or(hinge.damping_n_m_s, |s| {
        let way = ((q[j] - s.begin_rad) / (s.full_rad - s.begin_rad)).clamp(0.0, 1.0);
        (1.0 - way) * hinge.damping_n_m_s + way * s.damping_n_m_s
    });
    -damping * rates[j]
}

#[test]
fn a_stop_works_only_while_the_joint_moves_into_it() {
    let stop = |begin_rad, full_rad| Some(Stop { begin_rad, full_rad, damping_n_m_s: 9.0 });
    let elbow = HingeJoint { damping_n_m_s: 1.0, lower_stop: stop(-1.0, -2.0), upper_stop: stop(1.0, 2.0) };
    let joints = Joints::free(&TTI12).with(tti12::LEFT_ELBOW, elbow);
    let resistance = |alpha: f64, rate: f64| {
        let (mut q, mut rates) = ([1.0; DOF], [0.0; DOF]);
        (q[21], rates[21]) = (alpha, rate);
        -damping_forces(&joints, &q, &rates)[21] / rate
    };
    // (α, α̇) → J: 1 in between, 9 beyond, halfway 5.
    for (alpha, rate, expected) in [
        (0.0, 1.0, 1.0),
        (1.5, 2.0, 5.0),
        (3.0, 1.0, 9.0),
        (1.5, -2.0, 1.0),
        (-1.5, -0.5, 5.0),
        (-1.25, -0.5, 3.0),
        (-4.0, -0.5, 9.0),
        (-4.0, 0.5, 1.0),
    ] {
        let found = resistance(alpha, rate);
        assert!((found - expected).abs() < 1e-14, "{alpha} {rate}: {found}"); // Measured: 0.
    }
}

#[test]
fn the_joint_angle_is_smooth_and_near_the_report_s_arc_cosine() {
    // Two segments leaning by θ₁ and θ₁ + β in one plane: β without ε, and with it β + ε²/(2 tan β) + O(ε⁴).
    for beta in [0.2, 0.9, 1.7, 2.6] {
        let mut q = [0.3; DOF];
        (q[6], q[7]) = (q[3], q[4] + beta);
        let plain = joint_angle(&q, 1, 2, 0.0);
        assert!((plain - beta).abs() < 1e-14, "{plain}"); // Measured: 2.3e-16.
        let epsilon: f64 = 1e-3;
        let shift = joint_angle(&q, 1, 2, epsilon) - plain;
        let expected = epsilon.powi(2) * beta.cos() / (2.0 * beta.sin());
        assert!((shift - expected).abs() < 1e-10, "{shift:e}"); // Measured: 1.7e-11.
    }
}

fn unit(j: usize) -> [f64; DOF] {
    std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 })
}

fn varied(q: &[f64; DOF], j: usize) -> [Dual<f64>; DOF] {
    let direction = unit(j);
    std::array::from_fn(|i| Dual::new(q[i], direction[i]))
}
