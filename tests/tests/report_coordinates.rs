//! The report's coordinates as input and output: there and back, against Eqs 6 and 44, and at their singular postures.

use nalgebra::Vector3;
use occupant_core::motion::kinematics::axes;
use occupant_core::motion::report_coordinates::ReportCoordinates;
use occupant_core::motion::state::Quat;
use occupant_core::motion::state::State;
use occupant_core::motion::vector::V3;
use occupant_core::motion::vector::v3;
use occupant_tests::{
    random::Random,
    reference::{FREE, pose, space_velocities},
};

#[test]
fn coordinates_become_the_state_of_equations_6_and_44() {
    let mut worst: f64 = 0.0;
    for seed in 0..100 {
        let mut random = Random::new(seed);
        let body = random.body();
        let (q, rates) = random.report_state();
        let state = ReportCoordinates { q, rates }.to_state();
        let (pose, speed) = (pose(&body, &q), space_velocities(&q, &rates));
        for (slot, segment) in FREE.into_iter().enumerate() {
            let (found, expected) = (axes(&state.orientation(slot)), pose.axes[segment.index()]);
            for (f, e) in [(found.x, expected.x), (found.y, expected.y), (found.z, expected.z)] {
                worst = worst.max((f.to_vector() - Vector3::from(e)).amax());
            }
            worst = worst.max((state.omega(slot).to_vector() - speed.angular[slot]).amax());
        }
        assert_eq!(state.hinge(), [q[21], q[22], q[29], q[30]]);
        assert_eq!(state.hinge_rate(), speed.hinge);
        assert_eq!(state.t1().to_vector(), Vector3::new(q[0], q[1], q[2]));
        assert_eq!(state.velocity().to_vector(), speed.t1);
    }
    assert!(worst < 1e-13, "{worst:e}"); // Measured: 3.6e-15.
}

#[test]
fn coordinates_come_back_from_the_state() {
    let mut worst: f64 = 0.0;
    for seed in 0..100 {
        let (q, rates) = Random::new(seed).report_state();
        let back = ReportCoordinates::from_state(&ReportCoordinates { q, rates }.to_state()).unwrap();
        for j in 0..31 {
            worst = worst.max((back.q[j] - q[j]).abs()).max((back.rates[j] - rates[j]).abs());
        }
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 5.4e-15.
}

#[test]
fn any_state_comes_back_from_its_coordinates_vertical_segments_included() {
    let mut worst: f64 = 0.0;
    for seed in 0..100 {
        let mut random = Random::new(seed);
        for state in [random.space_state(), random.vertical_state()] {
            let state = state.to_core();
            let back = ReportCoordinates::from_state(&state).unwrap().to_state();
            worst = worst.max(difference(&state, &back));
        }
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 2.4e-14.
}

#[test]
fn a_vertical_segment_gets_the_angles_of_the_rule() {
    // φ turns Y along the horizontal part of ω, φ̇ = 0, θ̇ = |ω_horizontal|; ψ takes the rest.
    for seed in 0..100 {
        let state = Random::new(seed).vertical_state();
        let omega = state.speed.angular[0];
        let coordinates = ReportCoordinates::from_state(&state.to_core()).unwrap();
        let [phi, theta, _psi] = [3, 4, 5].map(|j| coordinates.q[j]);
        let [phi_rate, theta_rate, psi_rate] = [3, 4, 5].map(|j| coordinates.rates[j]);
        let horizontal = omega.xy().norm();
        let along = Vector3::new(-phi.sin(), phi.cos(), 0.0) * horizontal;
        assert!((along.xy() - omega.xy()).amax() < 1e-13); // Measured: 2.7e-15.
        assert_eq!(phi_rate, 0.0);
        assert!((theta_rate - horizontal).abs() < 1e-13); // Measured: 1.8e-15.
        assert!(theta.sin().abs() < 1e-15); // Measured: 1.2e-16, sin of the nearest number to π.
        assert!((psi_rate * theta.cos() - omega.z).abs() < 1e-13); // Measured: 0.
    }
}

#[test]
fn an_upright_segment_at_rest_has_its_yaw_in_psi() {
    let mut state = Random::new(1).vertical_state().to_core();
    state.set_orientation(0, Quat { w: 0.3_f64.cos(), v: v3(0.0, 0.0, 0.3_f64.sin()) });
    state.set_omega(0, V3::zero());
    let coordinates = ReportCoordinates::from_state(&state).unwrap();
    assert_eq!(coordinates.q[3..5], [0.0, 0.0]);
    assert!((coordinates.q[5] - 0.6).abs() < 1e-15); // Measured: 1.2e-16.
    assert_eq!(coordinates.rates[3..6], [0.0; 3]);
}

/// Largest difference; orientations by their axes.
fn difference(a: &State<f64>, b: &State<f64>) -> f64 {
    let mut worst = (a.t1() - b.t1()).norm_squared().max((a.velocity() - b.velocity()).norm_squared());
    for slot in 0..8 {
        let (p, q) = (axes(&a.orientation(slot)), axes(&b.orientation(slot)));
        for gap in [p.x - q.x, p.y - q.y, p.z - q.z, a.omega(slot) - b.omega(slot)] {
            worst = worst.max(gap.norm_squared());
        }
    }
    for i in 0..4 {
        worst = worst.max((a.hinge()[i] - b.hinge()[i]).powi(2));
        worst = worst.max((a.hinge_rate()[i] - b.hinge_rate()[i]).powi(2));
    }
    worst.sqrt()
}
