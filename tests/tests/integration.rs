//! Integrators: observed order, error control, step halving, motion through the singular posture of Euler angles.

use nalgebra::{Point3, Vector3};
use occupant_core::body::tti12::TTI12;
use occupant_core::forces::joint::{AngularSpring, BallJoint, HingeJoint, Joints};
use occupant_core::forces::{belt, joint};
use occupant_core::model::Model;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::motion::report_coordinates::{DOF, EULER_START, ReportCoordinates};
use occupant_core::motion::state::State;
use occupant_core::motion::vector::V3;
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Format, Scenario};
use occupant_tests::cart;
use occupant_tests::cases::{afloat, belt, male50};
use occupant_tests::measure::{assert_below, assert_within};

/// Springs and dampers without stops.
fn supple() -> Joints {
    let ball = BallJoint {
        damping_n_m_s: 1.5,
        twist_damping_n_m_s: 0.3,
        stop: None,
        spring: Some(AngularSpring { stiffness_n_m: 120.0, rest_rad: None }),
    };
    let hinge = HingeJoint { damping_n_m_s: 1.0, ..HingeJoint::default() };
    Joints::alike(&TTI12, ball, hinge).with_epsilon(0.1)
}

/// A bent posture that turns and moves: every angle and rate different.
fn tumbling() -> InitialPosture {
    let (mut q, mut rates) = ([0.0; DOF], [0.0; DOF]);
    for i in 0..DOF {
        let spread = 2.0 * (0.618_033_988_749_894_9 * (i + 1) as f64).fract() - 1.0;
        (q[i], rates[i]) = (0.5 * spread, 2.0 * spread);
    }
    for at in EULER_START {
        // lean away from the vertical, where φ and ψ mean nothing
        q[at + 1] += 0.8;
    }
    InitialPosture::Coordinates(Box::new(ReportCoordinates { q, rates }))
}

/// A swinging body that hangs in two preloaded belts: everything smooth.
fn smooth_case(integrator: Integrator) -> Setup {
    let mut setup = afloat(male50(), 0.1, 1.0);
    setup.gravity_m_s2 = 9.81;
    setup.joints = supple();
    setup.posture = tumbling();
    // vehicle axes: z down
    let mut chest = belt([Point3::new(-0.9, -0.4, -1.2), Point3::new(-0.9, 0.4, -1.0)], 1.5e3, -0.4);
    (chest.name, chest.sphere) = ("chest".into(), 1);
    let mut pelvis = belt([Point3::new(-0.9, -0.5, 0.3), Point3::new(-0.8, 0.5, 0.2)], 2e3, -0.4);
    (pelvis.name, pelvis.sphere) = ("pelvis".into(), 2);
    setup.belts = vec![chest, pelvis];
    setup.integrator = integrator;
    setup
}

/// The state at the end, and how the run went.
fn end(setup: Setup) -> (State<f64>, Outcome) {
    let model = Model::new(setup).unwrap_or_else(|p| panic!("{p}"));
    let mut last = None;
    let outcome = simulate(
        &model,
        Watch(|s: &Sample<'_>| {
            last = Some(*s.state);
            assert!(s.actions.belts.iter().all(|b| b.loop_force > 0.0));
        }),
    )
    .unwrap();
    assert_eq!(outcome.status, Status::Completed);
    (last.unwrap(), outcome)
}

/// Distances of two states: places (m), orientations and hinge angles (rad), speeds, work sums (J).
fn distances(a: &State<f64>, b: &State<f64>) -> [f64; 4] {
    let v = |a: V3<f64>, b: V3<f64>| (a - b).norm_squared();
    let mut angles = 0.0;
    let mut speeds = v(a.velocity(), b.velocity());
    for i in 0..8 {
        let (p, q) = (a.orientation(i), b.orientation(i));
        angles += 4.0 * ((p.w - q.w).powi(2) + v(p.v, q.v));
        speeds += v(a.omega(i), b.omega(i));
    }
    for i in 0..4 {
        angles += (a.hinge()[i] - b.hinge()[i]).powi(2);
        speeds += (a.hinge_rate()[i] - b.hinge_rate()[i]).powi(2);
    }
    let (w, u) = (a.work(0), b.work(0));
    let work = [w.sums[joint::DAMPING] - u.sums[joint::DAMPING], w.sums[belt::STRETCH] - u.sums[belt::STRETCH]];
    let work: f64 = work.iter().map(|d| d * d).sum();
    [v(a.t1(), b.t1()), angles, speeds, work].map(f64::sqrt)
}

#[test]
fn halving_the_step_of_rk4_divides_every_error_by_sixteen() {
    let steps = [1e-3, 5e-4, 2.5e-4];
    let [coarse, middle, fine] = steps.map(|step_s| end(smooth_case(Integrator::Rk4 { step_s })).0);
    let (first, second) = (distances(&coarse, &middle), distances(&middle, &fine));
    for (i, what) in ["places", "orientations", "speeds", "work sums"].iter().enumerate() {
        let order = (first[i] / second[i]).log2();
        // Measured: 3.927 to 4.001.
        assert_within(&format!("order of {what}"), order, [3.9, 4.1]);
    }
    // Measured: 3.8e-11.
    assert_below("change of places at the finer step, m", second[0], 1e-7);
}

#[test]
fn the_energy_imbalance_of_rk4_falls_with_the_fourth_power_of_the_step() {
    let error = |step_s| end(smooth_case(Integrator::Rk4 { step_s })).1.energy.balance_error;
    let (coarse, fine) = (error(2e-3), error(1e-3));
    // Measured: 3.984.
    assert_within("order", (coarse / fine).log2(), [3.7, 5.2]);
    // Measured: 2.2e-9.
    assert_below("imbalance at 1 ms", fine, 1e-6);
}

fn adaptive(tolerance: f64) -> Integrator {
    Integrator::Adaptive {
        relative: tolerance,
        absolute_m: tolerance,
        absolute_m_s: tolerance,
        min_step_s: 1e-9,
        max_step_s: 0.05,
    }
}

#[test]
fn the_adaptive_integrator_meets_its_tolerance_and_agrees_with_rk4() {
    let reference = end(smooth_case(Integrator::Rk4 { step_s: 1e-4 })).0;
    let mut evaluations = Vec::new();
    for tolerance in [1e-5, 1e-7, 1e-9] {
        let (state, outcome) = end(smooth_case(adaptive(tolerance)));
        let error = distances(&state, &reference);
        // the tolerance is that of a step; speeds of the light forearms are the hardest
        // Measured: 9.8e-3 to 1.2e-2.
        assert_below("places, of the tolerance", error[0] / tolerance, 1.0);
        // Measured: 6.3e-1 to 6.9e-1.
        assert_below("orientations, of the tolerance", error[1] / tolerance, 1.0);
        // Measured: 5.9e1 to 6.1e1: in proportion to the tolerance.
        assert_below("speeds, of the tolerance", error[2] / tolerance, 100.0);
        evaluations.push(outcome.effort.evaluations as f64);
    }
    // an error estimate of third order: a hundredth of the tolerance costs 100^(1/3) = 4.6 times the work
    // Measured: 4.47.
    assert_within("cost of two digits", evaluations[2] / evaluations[1], [4.0, 5.2]);
}

#[test]
fn how_often_a_run_is_recorded_does_not_change_its_motion() {
    let run = |output_s: f64, end_s: f64| {
        let mut setup = cart::lap(adaptive(1e-4));
        (setup.time.output_s, setup.time.end_s) = (output_s, end_s);
        let model = Model::new(setup).unwrap();
        let mut states = Vec::new();
        let outcome = simulate(&model, Watch(|s: &Sample<'_>| states.push(*s.state))).unwrap();
        (states, outcome.effort)
    };
    let (often, effort) = run(1e-3, 0.15);
    let (seldom, same) = run(0.05, 0.15);
    // the same steps, to the last one, and the same states but for the last digits of the output times
    assert_eq!(effort, same);
    for (i, state) in seldom.iter().enumerate() {
        let apart = distances(&often[50 * i], state);
        // Measured: 0.
        assert_below("state by how often it is recorded", apart[2], 1e-9);
    }
    // an end that comes sooner cuts no step short either
    let (short, _) = run(1e-3, 0.1);
    assert_eq!(short[..], often[..short.len()]);
}

/// Sphere centres of the lap case every millisecond with their times, and the energy imbalance.
fn crash(integrator: Integrator) -> (Vec<(f64, Vector3<f64>)>, f64) {
    let model = Model::new(cart::lap(integrator)).unwrap();
    let mut places = Vec::new();
    let outcome = simulate(
        &model,
        Watch(|s: &Sample<'_>| {
            places.extend((0..17).map(|i| (s.time_s, s.sphere_centre_m(i).coords)));
        }),
    )
    .unwrap();
    (places, outcome.energy.balance_error)
}

/// Greatest distance of two runs' spheres until `end_s`, m.
fn apart(a: &[(f64, Vector3<f64>)], b: &[(f64, Vector3<f64>)], end_s: f64) -> f64 {
    let until = a.iter().zip(b).filter(|(p, _)| p.0 < end_s + 1e-9);
    until.map(|(p, q)| (p.1 - q.1).norm()).fold(0.0, f64::max)
}

#[test]
fn a_whole_crash_converges_as_the_step_is_halved() {
    let runs = [2e-4, 1e-4, 5e-5, 2.5e-5].map(|step_s| crash(Integrator::Rk4 { step_s }));
    let change = |i: usize, end_s: f64| apart(&runs[i].0, &runs[i + 1].0, end_s);
    // Springs with kinks, met between the steps: second order.
    for (i, bound) in [8e-6, 2e-6, 5e-7].into_iter().enumerate() {
        // Measured: 2.8e-6.
        assert_below("paths until 0.08 s against half the step, m", change(i, 0.08), bound);
    }
    // At 0.0816 s each hand leaves the edge band of the wheel, where the edge force U/r drops to zero: first order, and
    // the error depends on where in a step it happens. It is the hands that differ.
    for (i, bound) in [8e-3, 4e-3, 2e-3].into_iter().enumerate() {
        // Measured: 2.2e-3.
        assert_below("paths until 0.2 s against half the step, m", change(i, 0.2), bound);
    }
    // Measured: 2.3e-6.
    assert_below("energy imbalance at 0.1 ms", runs[1].1, 1e-3);
    for pair in runs.windows(2) {
        // Measured: 2.3e-6.
        assert_below("energy imbalance at half the step", pair[1].1, 0.5 * pair[0].1);
    }
}

#[test]
fn an_integrator_that_finds_the_kinks_agrees_with_short_steps_of_rk4() {
    // Δ_m is committed at the ends of steps, so a long step may miss the peak of a deformation: no longer than 0.1 ms
    let adaptive = crash(Integrator::Adaptive {
        relative: 1e-7,
        absolute_m: 1e-8,
        absolute_m_s: 1e-7,
        min_step_s: 1e-12,
        max_step_s: 1e-4,
    });
    let rk4 = crash(Integrator::Rk4 { step_s: 1.25e-5 });
    // Measured: 3.9e-8.
    assert_below("paths until 0.08 s, m", apart(&adaptive.0, &rk4.0, 0.08), 5e-6);
    // Measured: 1.1e-5.
    assert_below("paths until 0.2 s, m", apart(&adaptive.0, &rk4.0, 0.2), 1e-3);
    // Measured: 6.6e-8.
    assert_below("energy imbalance", adaptive.1, 1e-3);
}

#[test]
fn error_control_costs_a_third_of_rk4_at_a_tenth_of_a_millisecond_and_is_as_near() {
    let head = |integrator| {
        let model = Model::new(cart::lap(integrator)).unwrap();
        let mut path = Vec::new();
        let watch = Watch(|s: &Sample<'_>| path.push((s.time_s, s.sphere_centre_m(0).coords)));
        let outcome = simulate(&model, watch).unwrap();
        (path, outcome.effort)
    };
    let (exact, _) = head(Integrator::Rk4 { step_s: 1e-5 });
    let (rk4, usual) = head(Integrator::Rk4 { step_s: 1e-4 });
    // enough for a short crash; the default is a hundred times finer
    let (adaptive, effort) = head(Integrator::Adaptive {
        relative: 3e-6,
        absolute_m: 3e-7,
        absolute_m_s: 3e-5,
        min_step_s: 1e-8,
        max_step_s: 2e-3,
    });
    // Measured: 8.2e-5.
    assert_below("head path of rk4, m", apart(&rk4, &exact, 0.2), 2e-4);
    // Measured: 1.1e-5.
    assert_below("head path, m", apart(&adaptive, &exact, 0.2), 5e-5);
    let share = effort.evaluations as f64 / usual.evaluations as f64;
    // Measured: 0.340.
    assert_within("share of the evaluations", share, [0.28, 0.4]);
    // three evaluations a trial, one at the start and one where the pulse ends
    let trials = effort.steps + effort.rejected;
    assert_eq!(effort.evaluations, 3 * trials + 2);
}

/// Where the head's centre is at each output of a case of `tests/data/roads`, by `integrator`, and the peak of its acceleration.
fn whole_run(scenario: &str, integrator: Integrator) -> (Vec<(f64, Vector3<f64>)>, f64) {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/data/roads/");
    let text = std::fs::read_to_string(format!("{folder}{scenario}.toml")).unwrap();
    let read = |name: &str| std::fs::read(format!("{folder}{name}")).map_err(|e| e.to_string());
    let loaded = Scenario::from_text(&text, Format::Toml, scenario, &read).unwrap();
    let (mut setup, _) = loaded.build().unwrap();
    (setup.integrator, setup.time.output_s) = (integrator, 1e-3);
    let (mut path, mut peak) = (Vec::new(), 0.0_f64);
    let watch = Watch(|s: &Sample<'_>| {
        let head = s.model.body().tree.landmarks().head.unwrap();
        path.push((s.time_s, s.cg_m(head).coords));
        peak = peak.max(s.specific_force_m_s2(head).norm());
    });
    simulate(&Model::new(setup).unwrap(), watch).unwrap();
    (path, peak)
}

#[test]
fn the_default_is_within_a_tenth_of_a_millimetre_over_long_runs() {
    for scenario in ["rollover-quarter-turn", "side-slope"] {
        let (exact, peak) = whole_run(scenario, Integrator::Rk4 { step_s: 2e-5 });
        let (path, own_peak) = whole_run(scenario, Integrator::default());
        // Measured: 1.9e-5 and 3.7e-5.
        assert_below("head path over the whole run, m", apart(&path, &exact, f64::INFINITY), 1e-4);
        // Measured: 1e-5.
        assert_below("peak of the head's acceleration", (own_peak / peak - 1.0).abs(), 1e-3);
    }
}

/// A body that sways through the upright posture: torso upright and arms hanging but for `offset` (rad).
fn through_upright(offset: f64) -> Vec<Vector3<f64>> {
    let mut setup = afloat(male50(), 0.3, 1e-3);
    setup.time.output_s = 0.01;
    setup.gravity_m_s2 = 9.81;
    setup.joints = supple();
    let (mut q, mut rates) = ([0.0; DOF], [0.0; DOF]);
    for (i, at) in EULER_START.into_iter().enumerate() {
        q[at + 1] = offset;
        rates[at + 1] = 1.0 + 0.3 * i as f64;
    }
    rates[0] = 1.0;
    setup.posture = InitialPosture::Coordinates(Box::new(ReportCoordinates { q, rates }));
    let model = Model::new(setup).unwrap();
    let mut places = Vec::new();
    simulate(
        &model,
        Watch(|s: &Sample<'_>| {
            places.extend((0..17).map(|i| s.sphere_centre_m(i).coords));
        }),
    )
    .unwrap();
    places
}

#[test]
fn motion_through_the_singular_posture_is_the_limit_of_motions_beside_it() {
    let exact = through_upright(0.0);
    let distance = |offset: f64| {
        let beside = through_upright(offset);
        let far = exact.iter().zip(&beside).map(|(a, b)| (a - b).norm());
        far.fold(0.0, f64::max)
    };
    let (far, near) = (distance(1e-5), distance(1e-7));
    // it grows with the motion by no more than a factor of a few
    // Measured: 1.1e-5.
    assert_below("paths at an offset of 1e-5 rad, m", far, 1e-4);
    // Measured: 100.
    assert_within("proportion to the offset", far / near, [90.0, 110.0]);
}

#[test]
fn outputs_come_at_their_times_exactly_whatever_the_step() {
    let integrators = [Integrator::Rk4 { step_s: 3.7e-4 }, Integrator::Rk4 { step_s: 0.5 }, adaptive(1e-6)];
    for integrator in integrators {
        let mut setup = smooth_case(integrator);
        setup.time.output_s = 0.03;
        let model = Model::new(setup).unwrap();
        let mut times = Vec::new();
        simulate(&model, Watch(|s: &Sample<'_>| times.push(s.time_s))).unwrap();
        let expected: Vec<f64> = (0..4).map(|i| f64::from(i) * 0.03).chain([0.1]).collect();
        assert_eq!(times, expected);
    }
}
