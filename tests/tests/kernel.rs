//! The simulator's recursion against the reference: same bodies, states, joints and forces, same motion.
//!
//! Differences are relative to the largest component of the kind (acceleration of T1; angular accelerations).

use nalgebra::{UnitQuaternion, Vector3};
use occupant_core::motion::frame::Moving;
use occupant_core::motion::vector::V3;
use occupant_core::results::energy;
use occupant_tests::{
    core_side::{CoreSide, momentum},
    golden::Golden,
    random::Random,
    reference::{
        System, damping_forces, equations_of_motion, gravity_energy, joint_angle, kinetic_energy, space_accelerations,
        spine_energy,
    },
    segment_motion::segment_motions,
    space_state::SpaceState,
};

#[test]
fn accelerations_agree_with_the_published_model_s_five_states() {
    let golden = Golden::load();
    let mut worst: f64 = 0.0;
    for published in &golden.states {
        let (q, rates) = published.coordinates();
        let accelerations = std::array::from_fn(|j| published.q_acceleration[j]);
        let expected = space_accelerations(&q, &rates, &accelerations);
        let state = SpaceState::from_report(&golden.body(), &q, &rates);
        let found = CoreSide::new(&golden.system(published), &state).accelerations;
        worst = worst.max(found.difference(&expected));
    }
    assert!(worst < 1e-11, "{worst:e}"); // Measured: 6.3e-15.
}

#[test]
fn accelerations_of_random_bodies_in_random_states_agree() {
    let mut worst: f64 = 0.0;
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let (system, state) = (random.system(), random.space_state());
        let found = CoreSide::new(&system, &state).accelerations;
        worst = worst.max(found.difference(&system.accelerations(&state)));
    }
    assert!(worst < 1e-11, "{worst:e}"); // Measured: 1.4e-13.
}

#[test]
fn accelerations_agree_exactly_at_singular_postures() {
    let mut worst: f64 = 0.0;
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let (system, state) = (random.system(), random.vertical_state());
        let found = CoreSide::new(&system, &state).accelerations;
        worst = worst.max(found.difference(&system.accelerations(&state)));
    }
    // Springs and dampers between two vertical segments divide rounding by ε, 1e-3 at least.
    assert!(worst < 1e-10, "{worst:e}"); // Measured: 1.5e-13.
}

#[test]
fn accelerations_agree_beside_singular_postures_without_turning_the_scene() {
    // At a lean of δ the report's D loses about 1e-16/δ³ in the reference; the simulator knows no such posture.
    let (difference, _) = lean(1e-2);
    assert!(difference < 1e-9, "{difference:e}"); // Measured: 2.5e-10.
    let (difference, _) = lean(1e-3);
    assert!(difference < 1e-5, "{difference:e}"); // Measured: 1.9e-7.
}

#[test]
fn accelerations_go_continuously_into_singular_postures() {
    let [(_, coarse), (_, fine)] = [lean(1e-4), lean(1e-6)];
    assert!(coarse < 2e-2, "{coarse:e}"); // Measured: 1.03e-2.
    let ratio = coarse / fine;
    assert!((ratio - 100.0).abs() < 1.0, "{ratio}"); // Measured: 100.005.
}

/// Worst difference from the reference when all segments of vertical postures lean by `lean_rad`, and the worst change of
/// the acceleration from the vertical posture.
fn lean(lean_rad: f64) -> (f64, f64) {
    let (mut difference, mut change): (f64, f64) = (0.0, 0.0);
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let (mut system, vertical) = (random.system(), random.vertical_state());
        system.joints.epsilon = 0.05;
        let mut leaning = vertical;
        for (i, turn) in leaning.turn.iter_mut().enumerate() {
            let axis = Vector3::new((i as f64).cos(), (i as f64).sin(), 0.0);
            *turn = UnitQuaternion::from_scaled_axis(axis * lean_rad) * *turn;
        }
        let at = CoreSide::new(&system, &vertical).accelerations;
        let beside = CoreSide::new(&system, &leaning).accelerations;
        let expected = system.accelerations_as_it_stands(&leaning);
        difference = difference.max(beside.difference(&expected));
        change = change.max(beside.difference(&at));
    }
    (difference, change)
}

#[test]
fn places_velocities_and_accelerations_of_every_segment_agree() {
    let (mut place, mut speed, mut rate): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for (system, q, rates, state) in report_scenes() {
        let solution = equations_of_motion(&system, &q, &rates).accelerations;
        let expected = segment_motions(&system.body, &q, &rates, &solution);
        let CoreSide { skeleton, kinematics: k, segments, .. } = CoreSide::new(&system, &state);
        let size = expected.iter().fold(0.0_f64, |m, s| m.max(s.alpha.amax()));
        for (i, motion) in expected.iter().enumerate() {
            let gap = |found: V3<f64>, expected| (found.to_vector() - expected as Vector3<f64>).amax();
            place = place.max(gap(k.cg(&skeleton, i), motion.place));
            place = place.max((k.axes[i].to_matrix() - motion.turn).amax());
            speed = speed.max(gap(k.cg_velocity(&skeleton, i), motion.velocity));
            speed = speed.max(gap(k.omega[i], motion.omega));
            rate = rate.max(gap(segments.cg(&skeleton, &k, i), motion.acceleration) / size);
            rate = rate.max(gap(segments.alpha[i], motion.alpha) / size);
        }
    }
    assert!(place < 1e-13, "{place:e}"); // Measured: 8.9e-16.
    assert!(speed < 1e-12, "{speed:e}"); // Measured: 5.4e-15.
    assert!(rate < 1e-11, "{rate:e}"); // Measured: 1.2e-14.
}

#[test]
fn energies_and_momenta_agree() {
    let mut worst: f64 = 0.0;
    for (system, q, rates, state) in report_scenes() {
        let CoreSide { skeleton, kinematics: k, .. } = CoreSide::new(&system, &state);
        let found = energy::kinetic(&skeleton, &k, &Moving::space());
        let expected = kinetic_energy(&system.body, &q, &rates);
        worst = worst.max((found - expected).abs() / expected);
        let found = energy::gravity(&skeleton, &k);
        let expected = gravity_energy(&system.body, &system.gravity, &q);
        worst = worst.max((found - expected).abs() / expected.abs());

        let motion = segment_motions(&system.body, &q, &rates, &[0.0; 31]);
        let (mut linear, mut angular) = (Vector3::zeros(), Vector3::zeros());
        for (m, segment) in motion.iter().zip(&system.body.segments) {
            linear += segment.mass_kg * m.velocity;
            angular += segment.mass_kg * m.place.cross(&m.velocity) + m.inertia * m.omega;
        }
        let (p, h) = momentum(&skeleton, &k, V3::zero());
        worst = worst.max((p.to_vector() - linear).norm() / linear.norm());
        worst = worst.max((h.to_vector() - angular).norm() / angular.norm());
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 8.1e-16.
}

#[test]
fn joints_store_and_dissipate_what_the_reference_says() {
    let mut worst: f64 = 0.0;
    for (system, q, rates, state) in report_scenes() {
        let core = CoreSide::new(&system, &state);
        let damping = damping_forces(&system.joints, &q, &rates);
        let power: f64 = damping.iter().zip(&rates).map(|(r, u)| r * u).sum();
        worst = worst.max((core.dissipated + power).abs() / power.abs());
        let energy = spine_energy(&system.joints, &q);
        let stored = core.joints.stored(&core.kinematics);
        worst = worst.max((stored - energy).abs() / energy);
        for (i, (k, l)) in core.joints.balls.iter().map(|ball| ball.segments).enumerate() {
            let expected = joint_angle(&q, k + 1, l + 1, system.joints.epsilon);
            worst = worst.max((core.joints.beta(i, &core.kinematics) - expected).abs());
        }
    }
    assert!(worst < 1e-12, "{worst:e}"); // Measured: 2.9e-15.
}

#[test]
fn the_reference_solves_the_same_scenes_in_its_own_coordinates() {
    let mut worst: f64 = 0.0;
    for (system, q, rates, state) in report_scenes() {
        let solution = equations_of_motion(&system, &q, &rates).accelerations;
        let expected = space_accelerations(&q, &rates, &solution);
        worst = worst.max(CoreSide::new(&system, &state).accelerations.difference(&expected));
    }
    assert!(worst < 1e-11, "{worst:e}"); // Measured: 2.2e-14.
}

/// Random bodies in random states that have report coordinates.
fn report_scenes() -> impl Iterator<Item = (System, [f64; 31], [f64; 31], SpaceState)> {
    (0..40).map(|seed| {
        let mut random = Random::new(seed);
        let system = random.system();
        let (q, rates) = random.report_state();
        let state = SpaceState::from_report(&system.body, &q, &rates);
        (system, q, rates, state)
    })
}
