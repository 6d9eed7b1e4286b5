//! Motion of a body left to itself: conservation laws over time, closed forms, order of the integrator.

use nalgebra::{Matrix2, UnitQuaternion, Vector2, Vector3};
use occupant_core::body::Body;
use occupant_core::body::Segment;
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::forces::joint::DAMPING;
use occupant_core::forces::joint::Joints;
use occupant_core::motion::kinematics::axes;
use occupant_core::motion::state::State;
use occupant_tests::{
    core_side::CoreSide,
    free_run::{FreeRun, distance},
    random::Random,
    reference::{PointForce, System},
    space_state::SpaceState,
};

/// A random body with free joints in a random state, no force at all.
fn loose(seed: u64) -> (System, State<f64>) {
    let mut random = Random::new(seed);
    let system =
        System { body: random.body(), joints: Joints::free(&TTI12), gravity: Vector3::zeros(), forces: Vec::new() };
    (system, random.space_state().to_core())
}

#[test]
fn energy_and_momenta_of_a_loose_body_are_conserved() {
    let mut worst: f64 = 0.0;
    for seed in 0..10 {
        let (system, start) = loose(seed);
        worst = worst.max(drift(&mut FreeRun::new(&system), &start, 2e-4, 1000));
    }
    assert!(worst < 1e-8, "{worst:e}"); // Measured: 1.3e-9.
}

#[test]
fn energy_and_momentum_errors_fall_with_the_fourth_power_of_the_step() {
    for seed in 0..5 {
        let (system, start) = loose(seed);
        let mut run = FreeRun::new(&system);
        let coarse = drift(&mut run, &start, 1e-3, 200);
        let fine = drift(&mut run, &start, 5e-4, 400);
        let order = (coarse / fine).log2();
        assert!((order - 4.0).abs() < 0.1, "{order}"); // Measured: 3.98 to 4.02.
    }
}

#[test]
fn the_whole_state_converges_with_order_four() {
    for seed in 0..5 {
        let mut random = Random::new(seed);
        let mut system = random.system();
        remove_stops(&mut system.joints);
        let start = random.space_state().to_core();
        let mut run = FreeRun::new(&system);
        let [a, b, c] = [1, 2, 4].map(|n| run.run(&start, 5e-4 / n as f64, 200 * n));
        let order = (distance(&a, &b) / distance(&b, &c)).log2();
        assert!((order - 4.0).abs() < 0.1, "{order}"); // Measured: 3.97 to 4.01.
    }
}

#[test]
fn springs_and_gravity_conserve_energy_and_dampers_account_for_theirs() {
    let mut worst: f64 = 0.0;
    for seed in 0..10 {
        let mut random = Random::new(seed);
        let mut system = random.system();
        remove_stops(&mut system.joints);
        let start = random.space_state().to_core();
        let mut run = FreeRun::new(&system);
        let (before, end) = (run.conserved(&start), run.run(&start, 2e-4, 1000));
        let after = run.conserved(&end);
        assert!(end.work(0).sums[DAMPING] > 0.0);
        worst = worst.max((after.energy - before.energy).abs() / before.energy.abs());
    }
    assert!(worst < 1e-8, "{worst:e}"); // Measured: 3.9e-9.
}

#[test]
fn the_whole_body_s_centre_of_gravity_falls_on_a_parabola() {
    let mut worst: f64 = 0.0;
    for seed in 0..10 {
        let mut random = Random::new(seed);
        let mut system = random.system();
        remove_stops(&mut system.joints);
        let start = random.space_state().to_core();
        let mut run = FreeRun::new(&system);
        let (h, steps) = (1e-4, 2000);
        let t = h * steps as f64;
        let ((mass, from), before) = (run.centre(&start), run.conserved(&start));
        let end = run.run(&start, h, steps);
        let expected = from + before.linear / mass * t + 0.5 * system.gravity * t * t;
        worst = worst.max((run.centre(&end).1 - expected).amax());
    }
    assert!(worst < 1e-8, "{worst:e}"); // Measured: 1.2e-9.
}

#[test]
fn a_body_dropped_at_rest_falls_without_moving_its_joints() {
    for seed in 0..10 {
        let mut random = Random::new(seed);
        let mut system = random.system();
        system.joints.ball_mut(tti12::UPPER_BACK).unwrap().spring = None;
        system.joints.ball_mut(tti12::LOWER_BACK).unwrap().spring = None;
        let start = random.space_state().to_core().still();
        let end = FreeRun::new(&system).run(&start, 1e-2, 100);
        assert!((start.t1().z - end.t1().z - 0.5 * 9.806_65).abs() < 1e-11); // Measured: 4.5e-15.
        let mut fall = end;
        fall.set_t1(start.t1());
        fall.set_velocity(start.velocity());
        let moved = distance(&fall, &start);
        assert!(moved < 1e-11, "{moved:e}"); // Measured: 5.1e-17.
    }
}

#[test]
fn a_torque_free_symmetric_top_precesses_steadily() {
    // One heavy segment with I_x = I_y = A, I_z = C, all others 1e-12 of it: R(t) = exp(L t/A) R₀ exp(ω_z (A − C)/A t Z).
    let (system, start) = loose(3);
    let mut system = System { body: lightened(&system.body, &[0]), ..system };
    let (a, c) = (0.31, 0.12);
    system.body.segments[0].inertia_kg_m2 = Vector3::new(a, a, c);
    let space = Random::new(5).space_state();
    let (q, w) = (space.turn[0], space.speed.angular[0]);
    let (loose, mut start) = (start, space.to_core());
    (1..8).for_each(|slot| start.set_orientation(slot, loose.orientation(slot)));
    let (h, steps) = (1e-4, 5000);
    let t = h * steps as f64;

    let local = q.inverse() * w;
    let momentum = q * Vector3::new(a * local.x, a * local.y, c * local.z);
    let spin = Vector3::z() * (local.z * (a - c) / a * t);
    let turn = UnitQuaternion::from_scaled_axis;
    let expected = turn(momentum / a * t) * q * turn(spin);

    let end = FreeRun::new(&system).run(&start, h, steps);
    let found = axes(&end.orientation(0)).to_matrix();
    let gap = (found - expected.to_rotation_matrix().matrix()).amax();
    assert!(gap < 1e-9, "{gap:e}"); // Measured: 9.6e-12.
}

#[test]
fn an_arm_on_a_heavy_trunk_is_a_double_pendulum() {
    let mut worst: f64 = 0.0;
    for seed in 0..50 {
        let mut random = Random::new(seed);
        let mut body = random.body();
        let heavy = [tti12::MIDDLE_TORSO, tti12::UPPER_TORSO];
        for segment in heavy {
            let p = &mut body.segments[segment.index()];
            p.mass_kg *= 1e12;
            p.inertia_kg_m2 *= 1e12;
        }
        let g = random.between(5.0, 15.0);
        // the trunk is held against gravity at its centres of gravity
        let hold = |segment: Segment| PointForce {
            segment,
            point: Vector3::z() * body.segment(segment).cg_from_lower_end_m,
            force: Vector3::z() * body.segment(segment).mass_kg * g,
        };
        let forces = heavy.map(hold).to_vec();
        let gravity = Vector3::z() * -g;
        let system = System { body, joints: Joints::free(&TTI12), gravity, forces };
        let [angles, rates] =
            [8.0, 8.0].map(|size| Vector2::new(random.between(-size, size), random.between(-size, size)));
        let state = hanging_arm(&angles, &rates);
        let found = CoreSide::new(&system, &state).accelerations;
        let expected = double_pendulum(&system.body, g, &angles, &rates);
        let gap = Vector2::new(found.angular[4].y - expected.x, found.angular[4].y + found.hinge[0] - expected.y);
        worst = worst.max(gap.amax() / expected.amax());
        assert!(found.angular[4].xz().amax() < 1e-10 * expected.amax());
    }
    assert!(worst < 1e-10, "{worst:e}"); // Measured: 2.4e-11.
}

/// Everything at rest and upright but the left arm, which swings in the X–Z plane.
fn hanging_arm(angles: &Vector2<f64>, rates: &Vector2<f64>) -> SpaceState {
    let mut state = Random::new(0).space_state();
    state.turn = [UnitQuaternion::identity(); 8];
    state.speed.t1 = Vector3::zeros();
    state.speed.angular = [Vector3::zeros(); 8];
    (state.hinge, state.speed.hinge) = ([0.0; 4], [0.0; 4]);
    state.turn[4] = UnitQuaternion::from_scaled_axis(Vector3::y() * angles.x);
    state.speed.angular[4] = Vector3::y() * rates.x;
    state.hinge[0] = angles.y - angles.x;
    state.speed.hinge[0] = rates.y - rates.x;
    state
}

/// θ̈ of upper arm and forearm, θ from the vertical about Y, by hand:
/// (I₁ + m₁a² + m₂l²) θ̈₁ + m₂lb cos(θ₁−θ₂) θ̈₂ = −m₂lb sin(θ₁−θ₂) θ̇₂² − (m₁a + m₂l) g sin θ₁,
/// m₂lb cos(θ₁−θ₂) θ̈₁ + (I₂ + m₂b²) θ̈₂ = m₂lb sin(θ₁−θ₂) θ̇₁² − m₂bg sin θ₂.
fn double_pendulum(body: &Body, g: f64, angle: &Vector2<f64>, rate: &Vector2<f64>) -> Vector2<f64> {
    let (upper, lower) = (body.segment(tti12::LEFT_UPPER_ARM), body.segment(tti12::LEFT_FOREARM));
    let (m1, m2, l) = (upper.mass_kg, lower.mass_kg, upper.length_m);
    let a = upper.length_m - upper.cg_from_lower_end_m;
    let b = lower.length_m - lower.cg_from_lower_end_m;
    let (i1, i2) = (upper.inertia_kg_m2.y, lower.inertia_kg_m2.y);
    let (s, c) = (angle.x - angle.y).sin_cos();
    let coupling = m2 * l * b;
    let mass = Matrix2::new(i1 + m1 * a * a + m2 * l * l, coupling * c, coupling * c, i2 + m2 * b * b);
    let moment = Vector2::new(
        -coupling * s * rate.y.powi(2) - (m1 * a + m2 * l) * g * angle.x.sin(),
        coupling * s * rate.x.powi(2) - m2 * b * g * angle.y.sin(),
    );
    mass.lu().solve(&moment).expect("a pendulum has mass")
}

/// All segments but those of `kept` (indices) reduced to 1e-12 of their mass.
fn lightened(body: &Body, kept: &[usize]) -> Body {
    let mut body = body.clone();
    for (i, segment) in body.segments.iter_mut().enumerate() {
        if !kept.contains(&i) {
            segment.mass_kg *= 1e-12;
            segment.inertia_kg_m2 *= 1e-12;
        }
    }
    body
}

/// A stop has corners in time, where no method keeps its order.
fn remove_stops(joints: &mut Joints) {
    for joint in TTI12.joints() {
        if let Some(ball) = joints.ball_mut(joint) {
            ball.stop = None;
        }
        if let Some(hinge) = joints.hinge_mut(joint) {
            (hinge.lower_stop, hinge.upper_stop) = (None, None);
        }
    }
    joints.epsilon = 0.1;
}

/// Largest relative change of energy, momentum and angular momentum.
fn drift(run: &mut FreeRun, start: &State<f64>, h: f64, steps: usize) -> f64 {
    let (before, end) = (run.conserved(start), run.run(start, h, steps));
    let after = run.conserved(&end);
    let energy = (after.energy - before.energy).abs() / before.energy;
    let linear = (after.linear - before.linear).norm() / before.linear.norm();
    let angular = (after.angular - before.angular).norm() / before.angular.norm();
    energy.max(linear).max(angular)
}
