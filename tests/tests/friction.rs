//! Regularised friction: creep below the friction angle, sliding above it, work, and frames that move.

use nalgebra::{Point3, Vector3};
use occupant_core::forces::contact::{EdgeForce, FRICTION};
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::cases::{BEAD_LENGTH_M, plane, smooth, spring, straight};
use occupant_tests::measure::{assert_below, assert_within};
use occupant_tests::probe::{Probe, RADIUS_M, bead_among};

const G: f64 = 9.81;
const K: f64 = 1e5;
const SLIP_M_S: f64 = 0.127;
const MASS_KG: f64 = 10.0;

/// A bead at rest on a plane that falls by `theta` towards +X′, in equilibrium along the normal.
///
/// The sphere's centre lies r above T1 along the normal, so that the point A at which normal force and friction act is
/// the centre of gravity: the heavy segment does not turn, and it moves as a mass point but for the eleven light
/// segments, 1.1e-8 of its mass.
fn incline(theta: f64, friction: f64, end_s: f64) -> Setup {
    let normal = Vector3::new(theta.sin(), 0.0, theta.cos());
    let mut material = smooth(spring(K, 1.0, K, 1.0, 1.0));
    (material.friction, material.friction_speed_m_s) = (friction, SLIP_M_S);
    let mut setup = bead_among(vec![material], vec![plane(normal)], EdgeForce::AtCentre);
    let upper_end = Point3::new(0.0, 0.0, BEAD_LENGTH_M);
    setup.body.spheres[0].centre_from_lower_end_m = upper_end + normal * RADIUS_M;
    setup.gravity_m_s2 = G;
    let sink = MASS_KG * G * theta.cos() / K;
    setup.posture = straight(normal * -sink, Vector3::zeros());
    setup.time.end_s = end_s;
    setup.time.output_s = end_s / 100.0;
    setup.integrator = Integrator::Rk4 { step_s: 1e-4 };
    setup
}

/// Time and speed down the slope at each output.
fn slide(setup: Setup, theta: f64) -> Vec<(f64, f64)> {
    let down = Vector3::new(theta.cos(), 0.0, -theta.sin());
    let model = Model::new(setup).unwrap();
    let mut out = Vec::new();
    simulate(&model, Watch(|s: &Sample<'_>| out.push((s.time_s, s.state.velocity().to_vector().dot(&down))))).unwrap();
    out
}

#[test]
fn below_the_friction_angle_the_body_creeps_at_the_speed_of_the_closed_form() {
    for (degrees, f) in [(5.0_f64, 0.5), (15.0, 0.5), (20.0, 0.6)] {
        let theta = degrees.to_radians();
        let speed = slide(incline(theta, f, 1.5), theta).last().unwrap().1;
        let tangent = theta.tan();
        // v_s tan θ/√(f² − tan² θ)
        let expected = SLIP_M_S * tangent / (f * f - tangent * tangent).sqrt();
        // Measured: 9.3e-9.
        assert_below("creep, relative", speed / expected - 1.0, 1e-6);
    }
}

#[test]
fn above_the_friction_angle_the_body_slides_as_the_closed_form_says() {
    let (theta, f) = (30_f64.to_radians(), 0.3);
    let run = slide(incline(theta, f, 1.0), theta);
    let acceleration = |v: f64| G * (theta.sin() - f * theta.cos() * v / v.hypot(SLIP_M_S));
    // t = ∫dv/a(v), by Simpson's rule
    let time_to = |v: f64| {
        let (n, mut sum) = (4000, 0.0);
        let h = v / f64::from(2 * n);
        for i in 0..n {
            let at = |j: i32| 1.0 / acceleration(h * f64::from(2 * i + j));
            sum += (at(0) + 4.0 * at(1) + at(2)) * h / 3.0;
        }
        sum
    };
    let worst = run.iter().map(|&(t, v)| (time_to(v) - t).abs()).fold(0.0, f64::max);
    // Measured: 3.4e-9.
    assert_below("time against ∫dv/a, s", worst, 1e-6);
    let (first, last) = (run[90], run[100]);
    let mean = (last.1 - first.1) / (last.0 - first.0);
    // asymptotically g(sin θ − f cos θ), from above by ½(v_s/v)² of the friction
    let limit = G * (theta.sin() - f * theta.cos());
    // Measured: 1.002.
    assert_within("acceleration over its limit", mean / limit, [1.0, 1.003]);
}

#[test]
fn friction_is_f_n_against_the_slip_of_the_contact_point() {
    let mut material = smooth(spring(K, 1.0, K, 1.0, 1.0));
    (material.friction, material.friction_speed_m_s) = (0.4, SLIP_M_S);
    let mut probe = Probe::new(vec![material], vec![plane(Vector3::z())], EdgeForce::AtContactPoint, Vector3::z());
    let at = Vector3::z() * (RADIUS_M - 0.01);
    let (velocity, omega) = (Vector3::new(0.3, -0.2, -0.5), Vector3::new(2.0, 3.0, -7.0));
    let load = probe.moving(at, velocity, omega);
    // A lies r below the centre
    let mut slip = velocity + omega.cross(&(Vector3::z() * -RADIUS_M));
    slip.z = 0.0;
    let friction = slip * (-0.4 * K * 0.01 / (slip.norm_squared() + SLIP_M_S * SLIP_M_S).sqrt());
    let force = Vector3::z() * (K * 0.01) + friction;
    let moment = (Vector3::z() * -RADIUS_M).cross(&friction);
    // Measured: 4.5e-13.
    assert_below("force, N", (load.force_n - force).norm(), 1e-10);
    // Measured: 6.3e-30.
    assert_below("moment, N·m", (load.moment_n_m - moment).norm(), 1e-10);
    // a sphere that rolls without slip feels no friction
    let rolling = probe.moving(at, Vector3::new(0.5, 0.0, 0.0), Vector3::new(0.0, 5.0, 0.0));
    // Measured: 0.
    assert_below("rolling, N", rolling.force_n.xy().norm(), 1e-10);
}

#[test]
fn what_friction_takes_from_a_sliding_body_stands_in_the_ledger() {
    let theta = 0.0;
    let mut setup = incline(theta, 0.3, 1.0);
    if let occupant_core::model::seating::InitialPosture::Coordinates(q) = &mut setup.posture {
        q.rates[0] = 4.0;
    }
    let model = Model::new(setup).unwrap();
    let mut last = None;
    let outcome = simulate(&model, Watch(|s: &Sample<'_>| last = Some(s.energy))).unwrap();
    let energy = last.unwrap();
    // 80 J at 4 m/s less ½ m v² after a second at nearly −0.3 g
    // Measured: 74.35.
    assert_within("lost to friction, J", energy.lost_j[FRICTION], [70.0, 80.0]);
    // Measured: 7.3e-15.
    assert_below("energy imbalance", outcome.energy.balance_error, 1e-9);
}
