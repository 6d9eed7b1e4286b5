//! Joints: the rate of β, springs, dampers, stops, twist.

use nalgebra::{Unit, UnitQuaternion, Vector3};
use occupant_core::body::tti12::{self, TTI12};
use occupant_core::forces::joint::{AngularSpring, BallJoint, HingeJoint, Joints, Stop};
use occupant_core::forces::joint::{DAMPING, JointAction, JointSystem};
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::layout::Layout;
use occupant_core::motion::skeleton::Skeleton;
use occupant_core::motion::state::{Quat, Shape, State};
use occupant_core::motion::vector::{V3, v3};
use occupant_tests::cases::male50;
use occupant_tests::measure::assert_below;

/// The neck: between segments 2 and 3.
const NECK: usize = 0;

fn system(neck: BallJoint, epsilon: f64) -> JointSystem<f64> {
    let joints = Joints::free(&TTI12).with(tti12::NECK, neck).with_epsilon(epsilon);
    laws(&joints, |_| 0.0)
}

fn laws(joints: &Joints, rest_rad: impl Fn(usize) -> f64) -> JointSystem<f64> {
    JointSystem::new(joints, &Skeleton::new(&male50(), 0.0), rest_rad)
}

fn kinematics(state: &State<f64>) -> Kinematics<f64> {
    Kinematics::new(&Skeleton::new(&male50(), 0.0), state)
}

/// Numbers spread evenly over (−1, 1), the same in every run.
fn spread(i: u32) -> f64 {
    2.0 * (f64::from(i) * 0.618_033_988_749_894_9).fract() - 1.0
}

/// A state in which everything is turned and turns.
fn tumbled(case: u32) -> State<f64> {
    let mut state = State::zero(Shape::of(&Layout::of(&TTI12)));
    for slot in state.turns() {
        let number = |i: u32| spread(1 + 61 * case + 7 * slot as u32 + i);
        let turn = UnitQuaternion::new(Vector3::new(number(0), number(1), number(2)) * 1.5);
        state.set_orientation(slot, quat(&turn));
        state.set_omega(slot, v3(number(3), number(4), number(5)) * 10.0);
    }
    state
}

fn quat(q: &UnitQuaternion<f64>) -> Quat<f64> {
    Quat { w: q.w, v: v3(q.i, q.j, q.k) }
}

/// Upper torso upright; the head bent by `beta` about the axis at `azimuth` in its horizontal plane, turning relatively
/// with `omega` (space axes).
fn bent(beta: f64, azimuth: f64, omega: Vector3<f64>) -> Kinematics<f64> {
    let mut state = State::zero(Shape::of(&Layout::of(&TTI12)));
    let axis = Vector3::new(azimuth.cos(), azimuth.sin(), 0.0);
    state.turns().for_each(|slot| state.set_orientation(slot, quat(&UnitQuaternion::identity())));
    let turn = UnitQuaternion::from_axis_angle(&Unit::new_normalize(axis), beta);
    state.set_orientation(2, quat(&turn));
    state.set_omega(2, V3::of(&omega));
    kinematics(&state)
}

/// The same state a moment `h` later at constant angular velocities.
fn later(state: &State<f64>, h: f64) -> State<f64> {
    let mut out = *state;
    for slot in state.turns() {
        let turn = UnitQuaternion::new(state.omega(slot).to_vector() * h);
        let Quat { w, v } = state.orientation(slot);
        let now = nalgebra::Quaternion::new(w, v.x, v.y, v.z);
        out.set_orientation(slot, quat(&(turn * UnitQuaternion::from_quaternion(now))));
    }
    out
}

/// n·ω, s² + ε² and the relative angular velocity of ball joint `i`, from the axes.
fn bending(i: usize, state: &State<f64>, epsilon: f64) -> (f64, f64, Vector3<f64>, Vector3<f64>) {
    let k = kinematics(state);
    let (inner, outer) = system(BallJoint::default(), 0.0).balls[i].segments;
    let (z_k, z_l) = (k.axes[inner].z.to_vector(), k.axes[outer].z.to_vector());
    let n = z_k.cross(&z_l);
    let omega = (k.omega[outer] - k.omega[inner]).to_vector();
    (n.dot(&omega), n.norm_squared() + epsilon * epsilon, omega, n)
}

#[test]
fn the_rate_of_beta_is_n_omega_over_the_root_of_s_squared_and_epsilon_squared() {
    let mut worst = 0.0_f64;
    for epsilon in [1e-3, 0.1] {
        let system = system(BallJoint::default(), epsilon);
        for case in 0..20 {
            let (state, h) = (tumbled(case), 1e-6);
            for i in 0..system.balls.len() {
                let beta = |h: f64| system.beta(i, &kinematics(&later(&state, h)));
                let found = (beta(h) - beta(-h)) / (2.0 * h);
                let (turn, square, omega, _) = bending(i, &state, epsilon);
                worst = worst.max((found - turn / square.sqrt()).abs() / omega.norm());
            }
        }
    }
    // Central differences.
    // Measured: 5.4e-9.
    assert_below("β̇, of |ω|", worst, 1e-7);
}

#[test]
fn the_springs_torque_derives_from_its_energy() {
    let spring = AngularSpring { stiffness_n_m: 113.0, rest_rad: Some(0.4) };
    let data = BallJoint { spring: Some(spring), ..BallJoint::default() };
    let joints =
        Joints::free(&TTI12).with(tti12::UPPER_BACK, data).with(tti12::LOWER_BACK, data).with(tti12::NECK, data);
    let system = laws(&joints, |_| 0.0);
    let mut worst = 0.0_f64;
    for case in 0..20 {
        let (state, h) = (tumbled(case), 1e-6);
        for i in [0, 3, 4] {
            let stored = |h: f64| system.ball(i, &kinematics(&later(&state, h))).stored;
            let power = -(stored(h) - stored(-h)) / (2.0 * h);
            let action = system.ball(i, &kinematics(&state));
            let (_, _, omega, n) = bending(i, &state, 1e-3);
            let torque = action.moment.to_vector();
            worst = worst.max((torque.dot(&omega) - power).abs() / (113.0 * omega.norm()));
            // Measured: 1.6e-14.
            assert_below("torque off n, N·m", torque.cross(&n).norm(), 1e-12 * 113.0);
            assert_eq!(action.dissipated, 0.0);
        }
    }
    // Measured: 2.1e-9.
    assert_below("power against −dV/dt, of K|ω|", worst, 1e-7);
}

#[test]
fn the_spring_without_an_angle_of_its_own_rests_at_the_initial_one() {
    let data =
        BallJoint { spring: Some(AngularSpring { stiffness_n_m: 100.0, rest_rad: None }), ..BallJoint::default() };
    let joints = Joints::free(&TTI12).with(tti12::NECK, data);
    let system = laws(&joints, |i| if i == NECK { 0.5 } else { 0.0 });
    let stored = system.ball(NECK, &bent(0.8, 0.3, Vector3::zeros())).stored;
    // ε = 1e−3 moves β by less than 1e−6.
    // Measured: 1.5e-5.
    assert_below("½K(β − β₀)², J", stored - 50.0 * 0.3 * 0.3, 1e-4);
}

fn damped(epsilon: f64, k: &Kinematics<f64>) -> JointAction<f64> {
    let data = BallJoint { damping_n_m_s: 0.7, ..BallJoint::default() };
    system(data, epsilon).ball(NECK, k)
}

#[test]
fn away_from_zero_the_damper_resists_the_rate_of_beta_alone() {
    let (omega, azimuth) = (Vector3::new(3.0, -2.0, 1.5), 0.4_f64);
    let hinge_axis = Vector3::new(azimuth.cos(), azimuth.sin(), 0.0);
    for beta in [0.3, 1.2, 2.8] {
        let rate = hinge_axis.dot(&omega);
        let k = bent(beta, azimuth, omega);
        // the report's −J β̇ n̂
        let exact = damped(0.0, &k);
        let expected = hinge_axis * (-0.7 * rate);
        // Measured: 4.6e-16.
        assert_below("ε = 0, N·m", (exact.moment.to_vector() - expected).norm(), 1e-13);
        // Measured: 8.9e-16.
        assert_below("ε = 0, W", exact.dissipated - 0.7 * rate * rate, 1e-13);
        // (ε/s)² of |ω_⊥|² more, at most
        let smooth = damped(1e-3, &k);
        let allowed = 0.7 * omega.norm_squared() * (1e-3 / beta.sin()).powi(2);
        // Measured: 7.3e-5.
        assert_below("ε = 1e-3, W", smooth.dissipated - exact.dissipated, allowed);
    }
}

#[test]
fn at_zero_the_damper_resists_all_bending_and_no_twist() {
    let omega = Vector3::new(3.0, -2.0, 1.5);
    let across = Vector3::new(3.0, -2.0, 0.0);
    for epsilon in [1e-3, 0.05] {
        let action = damped(epsilon, &bent(0.0, 0.0, omega));
        let moment = action.moment.to_vector();
        // Measured: 0.
        assert_below("moment + J ω_⊥, N·m", (moment + across * 0.7).norm(), 1e-14);
        let expected = 0.7 * across.norm_squared();
        // Measured: 0.
        assert_below("dissipated, W", action.dissipated - expected, 1e-13);
    }
}

#[test]
fn the_damper_dissipates_what_its_moment_takes() {
    let mut worst = 0.0_f64;
    for case in 0..50 {
        let state = tumbled(case);
        let action = damped(1e-3, &kinematics(&state));
        let (_, _, omega, _) = bending(NECK, &state, 1e-3);
        let power = -action.moment.to_vector().dot(&omega);
        worst = worst.max((power - action.dissipated).abs() / power);
        assert!(action.dissipated >= 0.0);
    }
    // Measured: 4.0e-16.
    assert_below("power, relative", worst, 1e-12);
}

/// J that the neck shows at `beta` while it bends (`sign` +1) or straightens (−1), for a stop from 0.8 to 1.2 rad.
fn resistance(beta: f64, sign: f64, stop: Option<Stop>) -> f64 {
    let data = BallJoint { damping_n_m_s: 2.0, stop, ..BallJoint::default() };
    let k = bent(beta, 0.0, Vector3::x() * sign);
    let moment = system(data, 0.0).ball(NECK, &k).moment;
    -moment.x * sign
}

#[test]
fn a_stop_resists_only_while_the_joint_moves_into_it() {
    let stop = Some(Stop { begin_rad: 0.8, full_rad: 1.2, damping_n_m_s: 90.0 });
    for (beta, into) in [(0.5, 2.0), (0.8, 2.0), (0.9, 24.0), (1.0, 46.0), (1.2, 90.0), (2.5, 90.0)] {
        // Measured: 2.5e-14.
        assert_below("J into the stop", resistance(beta, 1.0, stop) - into, 1e-11);
        // Measured: 4.4e-16.
        assert_below("J out of the stop", resistance(beta, -1.0, stop) - 2.0, 1e-11);
    }
    // it begins without a jump
    let rise = resistance(0.8 + 1e-9, 1.0, stop) - resistance(0.8 - 1e-9, 1.0, stop);
    // Measured: 2.2e-7.
    assert_below("J at the beginning", rise, 1e-6);
}

#[test]
fn a_stop_that_is_left_out_never_resists_and_one_of_equal_angles_does_so_at_once() {
    // Measured: 2.2e-16.
    assert_below("no stop", resistance(3.1, 1.0, None) - 2.0, 1e-11);
    let abrupt = Some(Stop { begin_rad: 1.0, full_rad: 1.0, damping_n_m_s: 90.0 });
    // Measured: 4.4e-16.
    assert_below("before", resistance(1.0 - 1e-6, 1.0, abrupt) - 2.0, 1e-11);
    // Measured: 1.4e-14.
    assert_below("behind", resistance(1.0 + 1e-6, 1.0, abrupt) - 90.0, 1e-9);
}

#[test]
fn twist_damping_turns_against_the_twist_about_the_outer_segment() {
    let data = BallJoint { twist_damping_n_m_s: 0.4, ..BallJoint::default() };
    let system = system(data, 1e-3);
    for case in 0..10 {
        let state = tumbled(case);
        let k = kinematics(&state);
        let action = system.ball(NECK, &k);
        let z = k.axes[system.balls[NECK].segments.1].z.to_vector();
        let (_, _, omega, _) = bending(NECK, &state, 1e-3);
        let twist = z.dot(&omega);
        let expected = z * (-0.4 * twist);
        // Measured: 0.
        assert_below("moment, N·m", (action.moment.to_vector() - expected).norm(), 1e-13);
        // Measured: 0.
        assert_below("dissipated, W", action.dissipated - 0.4 * twist * twist, 1e-12);
    }
}

#[test]
fn both_segments_of_a_joint_get_opposite_moments() {
    let joints = occupant_tests::cart::joints();
    let system = laws(&joints, |_| 0.2);
    let mut state = tumbled(3);
    state.hinge_mut().copy_from_slice(&[-2.2, -0.2, 0.05, 2.4]);
    state.hinge_rate_mut().copy_from_slice(&[-3.0, 2.0, -4.0, 1.0]);
    let k = kinematics(&state);
    let layout = Layout::of(&TTI12);
    let load = system.loads(&k, &state, &layout);
    let dissipated = load.power[0].sums[DAMPING];
    let sum: Vector3<f64> = load.wrench.iter().map(|w| w.moment.to_vector()).sum();
    // Measured: 8.6e-15.
    assert_below("sum of moments, N·m", sum.norm(), 1e-10);
    assert!(dissipated > 0.0);
}

#[test]
fn the_stops_of_a_hinge_resist_only_while_moving_into_them() {
    let hinge = HingeJoint {
        damping_n_m_s: 1.0,
        lower_stop: Some(Stop { begin_rad: 0.1, full_rad: -0.1, damping_n_m_s: 41.0 }),
        upper_stop: Some(Stop { begin_rad: 2.0, full_rad: 2.5, damping_n_m_s: 61.0 }),
    };
    let joints = Joints::free(&TTI12).with(tti12::LEFT_KNEE, hinge);
    let system = laws(&joints, |_| 0.0);
    // left elbow, right elbow, left knee, right knee
    let knee = &system.hinges[2];
    let expected = [
        // angle, J while it rises, J while it falls
        (-0.3, 1.0, 41.0),
        (0.0, 1.0, 21.0),
        (0.1, 1.0, 1.0),
        (1.0, 1.0, 1.0),
        (2.25, 31.0, 1.0),
        (2.6, 61.0, 1.0),
    ];
    for (angle, rising, falling) in expected {
        // Measured: 0.
        assert_below("rising", knee.torque(angle, 2.0) + 2.0 * rising, 1e-12);
        // Measured: 0.
        assert_below("falling", knee.torque(angle, -2.0) - 2.0 * falling, 1e-12);
    }
    assert_eq!(system.hinges[3].torque(2.6, 2.0), 0.0);
}
