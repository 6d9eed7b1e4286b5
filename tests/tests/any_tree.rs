//! Trees of any shape: against the closed forms of the report's body, against Newton's and Euler's equations of every
//! segment alone, and against what free flight keeps.

use nalgebra::Vector3;
use occupant_core::kernel::Situation;
use occupant_core::motion::dynamics::{Accelerations, Wrench, solve};
use occupant_core::motion::frame::{Frames, Moving, VEHICLE};
use occupant_core::motion::integrate::rk4;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::layout::{Axis, Freedom, MOST_OF_TREE, MOST_SEGMENTS};
use occupant_core::motion::skeleton::{Mount, Part, Skeleton};
use occupant_core::motion::state::{Shape, State, Work};
use occupant_core::motion::vector::{M3, V3, v3};
use occupant_core::results::energy;
use occupant_tests::any_tree::{AnyTree, Pose, Rates, bare};
use occupant_tests::core_side::momentum;
use occupant_tests::random::Random;

/// Loads on all segments.
fn loads(random: &mut Random) -> [Wrench<f64>; MOST_SEGMENTS] {
    std::array::from_fn(|_| Wrench { force: V3::of(&random.vector(500.0)), moment: V3::of(&random.vector(50.0)) })
}

fn as_vectors(loads: &[Wrench<f64>]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
    loads.iter().map(|load| (load.force.to_vector(), load.moment.to_vector())).collect()
}

/// Greatest difference of accelerations, as a part of the greatest.
fn difference(found: &Accelerations<f64>, expected: &[Rates]) -> f64 {
    let size = expected.iter().fold(1.0_f64, |most, rates| most.max(rates.joint.amax()).max(rates.turn.amax()));
    let gap = |(n, rates): (usize, &Rates)| {
        let joint = (found.joint[n].to_vector() - rates.joint).amax();
        joint.max((found.alpha[n].to_vector() - rates.turn).amax()) / size
    };
    expected.iter().enumerate().map(gap).fold(0.0, f64::max)
}

#[test]
fn the_reports_body_moves_by_any_trees_sweeps_as_by_its_closed_forms() {
    let mut worst = 0.0_f64;
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let closed = Skeleton::new(&random.body(), 9.806_65);
        let any = closed.clone().without_closed_forms();
        let (state, loads) = (random.space_state().to_core(), loads(&mut random));
        let both = [&closed, &any].map(|skeleton| {
            let k = Kinematics::new(skeleton, &state);
            (k, solve(skeleton, &k, state.hinge_rate(), &loads))
        });
        let [(k, a), (others_k, b)] = &both;
        let size = (0..12).fold(0.0_f64, |most, n| most.max(a.alpha[n].norm_squared().sqrt()));
        for n in 0..12 {
            let gap = |a: V3<f64>, b: V3<f64>| (a - b).norm_squared().sqrt();
            worst = worst.max(gap(a.joint[n], b.joint[n]) / size).max(gap(a.alpha[n], b.alpha[n]) / size);
            worst = worst.max(gap(k.joint[n], others_k.joint[n])).max(gap(k.axes[n].x, others_k.axes[n].x));
            worst = worst.max(gap(k.joint_velocity[n], others_k.joint_velocity[n]) / 50.0);
        }
        for i in 0..4 {
            worst = worst.max((a.hinge[i] - b.hinge[i]).abs() / size);
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn any_tree_moves_as_its_segments_do_one_by_one() {
    let (mut place, mut worst) = (0.0_f64, 0.0_f64);
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let root = if seed % 3 == 0 { Freedom::Guided } else { Freedom::Ball };
        let tree = AnyTree::random(&mut random, 1 + seed as usize % MOST_OF_TREE, root);
        let (skeleton, state, loads) = (tree.skeleton(), tree.state(&mut random), loads(&mut random));
        let k = Kinematics::new(&skeleton, &state);
        let found = solve(&skeleton, &k, state.hinge_rate(), &loads);
        let poses = tree.poses(&state);
        for (n, Pose { joint, axes, rates, .. }) in poses.iter().enumerate() {
            place = place.max((k.joint[n].to_vector() - joint).amax()).max((k.axes[n].to_matrix() - axes).amax());
            place = place.max((k.joint_velocity[n].to_vector() - rates.joint).amax());
            place = place.max((k.omega[n].to_vector() - rates.turn).amax());
        }
        let expected = tree.accelerations(&poses, &as_vectors(&loads), Rates::default());
        worst = worst.max(difference(&found, &expected));
    }
    assert!(place < 1e-12, "{place:e}");
    assert!(worst < 1e-9, "{worst:e}");
}

/// What free flight loses of momentum, angular momentum and energy in 0.1 s of so many steps, of what there was: the worst of
/// twelve trees.
fn lost_in_flight(steps: usize) -> [f64; 3] {
    let mut worst = [0.0_f64; 3];
    for seed in 0..12 {
        let mut random = Random::new(1000 + seed);
        let tree = AnyTree { gravity: 0.0, ..AnyTree::random(&mut random, 2 + seed as usize, Freedom::Ball) };
        let skeleton = tree.skeleton();
        let start = tree.state(&mut random);
        let kept = |state: &State<f64>| {
            let k = Kinematics::new(&skeleton, state);
            let (linear, angular) = momentum(&skeleton, &k, V3::zero());
            (linear.to_vector(), angular.to_vector(), energy::kinetic(&skeleton, &k, &Moving::space()))
        };
        let mut state = start;
        for _ in 0..steps {
            state = rk4::step(&state, 0.1 / steps as f64, |_, state, rate| {
                let k = Kinematics::new(&skeleton, state);
                let loads = [Wrench::zero(); MOST_SEGMENTS];
                *rate = solve(&skeleton, &k, state.hinge_rate(), &loads).rate(&skeleton.layout, state, &[Work::zero()]);
            });
        }
        let (before, after) = (kept(&start), kept(&state));
        worst[0] = worst[0].max((after.0 - before.0).norm() / before.0.norm());
        worst[1] = worst[1].max((after.1 - before.1).norm() / before.1.norm());
        worst[2] = worst[2].max((after.2 - before.2).abs() / before.2);
    }
    worst
}

/// What is lost is the integrator's, of fourth order: half the step loses a sixteenth.
#[test]
fn free_flight_keeps_momentum_and_energy() {
    let (whole, half) = (lost_in_flight(200), lost_in_flight(400));
    for (whole, half) in whole.into_iter().zip(half) {
        assert!(half < 1e-6 && half < whole / 10.0, "{half:e} of {whole:e}");
    }
}

/// A rod on a pin below a carrier that is fixed to the vehicle, its state at `angle` and `rate`.
fn pendulum(random: &mut Random, angle: f64, rate: f64) -> (AnyTree, State<f64>) {
    let mut tree = AnyTree::random(random, 1, Freedom::Guided);
    tree.rows.push((Some(0), Freedom::Hinges(&[Axis::Y])));
    let rod = tree.parts[0];
    let straight = nalgebra::Matrix3::identity();
    tree.parts.push(Part { cg_m: Vector3::new(0.0, 0.0, -0.3), triads: [straight; 2], ..rod });
    let mut state = State::zero(Shape::of(&tree.layout()));
    (state.hinge_mut()[0], state.hinge_rate_mut()[0]) = (angle, rate);
    (tree, state)
}

#[test]
fn a_pendulum_on_a_mount_swings_as_its_closed_form_says() {
    let mut worst = 0.0_f64;
    for seed in 0..20 {
        let mut random = Random::new(seed);
        let (angle, rate) = (random.between(-3.0, 3.0), random.between(-4.0, 4.0));
        let (tree, state) = pendulum(&mut random, angle, rate);
        let skeleton = tree.skeleton().mounted(Mount {
            frame: VEHICLE,
            place: V3::of(&random.vector(0.5)),
            axes: M3::of(&nalgebra::Matrix3::identity()),
        });
        let (kernel, mut history) = bare(skeleton);
        let push = random.vector(100.0);
        let vehicle = Moving { acceleration: V3::of(&push), ..Moving::space() };
        let mut frames = Frames::still(0.0);
        frames[VEHICLE] = vehicle;
        let found = kernel.rate(Situation::within(&state, &frames), &mut history, &mut ());
        // (I_y + M l²) α̈ = M l (a_x cos α + (g + a_z) (−sin α)), the rod hanging along −Z
        let (part, l) = (&tree.parts[1], 0.3);
        let about = part.inertia_kg_m2[(1, 1)] + part.mass_kg * l * l;
        let moment = part.mass_kg * l * (push.x * angle.cos() - (tree.gravity + push.z) * angle.sin());
        worst = worst.max((found.hinge_rate()[0] - moment / about).abs() / (moment / about).abs());
        assert!((found.velocity().to_vector() - push).amax() < 1e-12, "the root goes with the vehicle");
    }
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn a_tree_on_a_mount_that_turns_moves_as_its_segments_do_one_by_one() {
    let mut worst = 0.0_f64;
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let tree = AnyTree::random(&mut random, 2 + seed as usize % 12, Freedom::Guided);
        let skeleton = tree.skeleton();
        let (place, turn) = (random.vector(0.5), random.turn().to_rotation_matrix().into_inner());
        let skeleton = skeleton.mounted(Mount { frame: VEHICLE, place: V3::of(&place), axes: M3::of(&turn) });
        let vehicle = Moving {
            origin: V3::of(&random.vector(2.0)),
            axes: M3::of(random.turn().to_rotation_matrix().matrix()),
            velocity: V3::of(&random.vector(10.0)),
            omega: V3::of(&random.vector(3.0)),
            acceleration: V3::of(&random.vector(200.0)),
            alpha: V3::of(&random.vector(50.0)),
        };
        // the same root by hand
        let (arm, w, alpha) = (vehicle.axes.to_matrix() * place, vehicle.omega.to_vector(), vehicle.alpha.to_vector());
        let mut state = tree.state(&mut random);
        state.set_t1(vehicle.origin + V3::of(&arm));
        state.set_velocity(vehicle.velocity + V3::of(&w.cross(&arm)));
        let q = nalgebra::UnitQuaternion::from_matrix(&(vehicle.axes.to_matrix() * turn));
        state.set_orientation(0, occupant_core::motion::state::Quat { w: q.w, v: v3(q.i, q.j, q.k) });
        state.set_omega(0, vehicle.omega);
        let guide = Rates {
            joint: vehicle.acceleration.to_vector() + alpha.cross(&arm) + w.cross(&w.cross(&arm)),
            turn: alpha,
        };
        let nothing = vec![(Vector3::zeros(), Vector3::zeros()); tree.parts.len()];
        let expected = tree.accelerations(&tree.poses(&state), &nothing, guide);
        let (kernel, mut history) = bare(skeleton);
        // the state's own root is not looked at
        state.set_t1(v3(7.0, 8.0, 9.0));
        state.set_omega(0, v3(1.0, 2.0, 3.0));
        let mut frames = Frames::still(0.0);
        frames[VEHICLE] = vehicle;
        let found = kernel.evaluate(Situation::within(&state, &frames), &mut history, &mut ());
        worst = worst.max(difference(&found.accelerations, &expected));
    }
    assert!(worst < 1e-9, "{worst:e}");
}
