//! The simulator's recursion against the reference: same bodies, states, joints and forces, same motion.
//!
//! Differences are relative to the largest component of the kind (acceleration of T1; angular accelerations).

use nalgebra::{UnitQuaternion, Vector3};
use occupant_core::kernel::joints::BALLS;
use occupant_tests::{
    core_side::CoreSide,
    golden::Golden,
    random::Random,
    reference::{
        System, damping_forces, equations_of_motion, joint_angle, pose, space_accelerations,
        spine_energy,
    },
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
fn places_and_velocities_agree() {
    let mut worst: f64 = 0.0;
    for (system, q, rates, state) in report_scenes() {
        let core = CoreSide::new(&system, &state);
        let h = 1e-4;
        let at = |n: f64| {
            pose(
                &system.body,
                &std::array::from_fn(|j| q[j] + n * h * rates[j]),
            )
        };
        let (here, places) = (at(0.0), [at(1.0), at(-1.0), at(2.0), at(-2.0)]);
        for i in 0..12 {
            let cg = core.kinematics.cg(&core.skeleton, i).to_vector();
            worst = worst.max((cg - Vector3::from(here.cg[i])).amax());
            let z = core.kinematics.axes[i].z.to_vector();
            worst = worst.max((z - Vector3::from(here.axes[i].z)).amax());
            let [a, b, c, d] = [0, 1, 2, 3].map(|n| Vector3::from(places[n].cg[i]));
            let velocity = (8.0 * (a - b) - (c - d)) / (12.0 * h);
            let found = core.kinematics.cg_velocity(&core.skeleton, i).to_vector();
            assert!((found - velocity).amax() < 1e-9); // Measured: 9.4e-12.
        }
    }
    assert!(worst < 1e-13, "{worst:e}"); // Measured: 8.9e-16.
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
        for (i, (k, l)) in BALLS.into_iter().enumerate() {
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
        worst = worst.max(
            CoreSide::new(&system, &state)
                .accelerations
                .difference(&expected),
        );
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
