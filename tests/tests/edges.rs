//! Bounded faces: edge bands, where the edge force acts, passed pairs.

use nalgebra::Vector3;
use occupant_core::forces::contact::EdgeForce;
use occupant_core::forces::contact::material::Material;
use occupant_core::forces::contact::surface::Surface;
use occupant_core::forces::contact::{OPEN, PASSED, TOUCHING};
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::cases::{rectangle, smooth, spring, straight};
use occupant_tests::measure::{assert_below, assert_within};
use occupant_tests::probe::{Probe, RADIUS_M, bead_among};
use occupant_tests::rod;
use occupant_tests::room::setup;

const K: f64 = 2e4;

fn elastic() -> Vec<Material> {
    vec![smooth(spring(K, 1.0, K, 1.0, 1.0))]
}

/// The square |x|, |y| ≤ 0.5 m, facing up.
fn table() -> Vec<Surface> {
    vec![rectangle("table", [-0.5, 0.5], [-0.5, 0.5])]
}

fn v(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

/// A probe that touches the table at `d` beyond its edge x = 0.5 with deformation `depth`.
fn beside(d: f64, depth: f64) -> Vector3<f64> {
    v(0.5 + d, 0.1, RADIUS_M - depth)
}

#[test]
fn the_force_is_minus_the_gradient_of_the_stored_energy() {
    let mut probe = Probe::new(elastic(), table(), EdgeForce::AtCentre, v(0.0, 0.0, 1.0));
    let (depth, h) = (0.03, 1e-6);
    let stored = |probe: &mut Probe, at: Vector3<f64>| probe.at(at).touches[0].stored;
    let corner = v(0.5 + 0.03, 0.5 + 0.05, RADIUS_M - depth);
    let mut worst = 0.0_f64;
    for at in [beside(-0.2, depth), beside(0.02, depth), beside(0.09, depth), corner] {
        let gradient = Vector3::from_fn(|i, _| {
            let e = Vector3::ith(i, h);
            (stored(&mut probe, at + e) - stored(&mut probe, at - e)) / (2.0 * h)
        });
        worst = worst.max((probe.at(at).force_n + gradient).norm() / (K * depth));
    }
    // Central differences of a quadratic: their error is rounding.
    // Measured: 1.0e-11.
    assert_below("force against gradient, relative", worst, 1e-9);
}

/// Work of the surface on the probe along a straight line of places at a fixed angle, J.
fn work_along(probe: &mut Probe, from: Vector3<f64>, to: Vector3<f64>) -> f64 {
    // two Gauss–Legendre points in each of many pieces: exact for the piecewise quadratic force between kinks, and never
    // at an edge itself, where the edge force jumps
    let (n, node) = (1000, (1.0_f64 / 3.0).sqrt());
    let half = (to - from) / f64::from(2 * n);
    let mut sum = 0.0;
    for i in 0..n {
        let middle = from + half * f64::from(2 * i + 1);
        for side in [-node, node] {
            sum += probe.at(middle + half * side).force_n.dot(&half);
        }
    }
    sum
}

/// Work of the surface while the segment turns by `angle` (rad) about Y′ at one place, J: the moment does not depend on
/// the angle, because the sphere is round.
fn work_of_turn(probe: &mut Probe, at: Vector3<f64>, angle: f64) -> f64 {
    probe.at(at).moment_n_m.y * angle
}

/// Turn in the band, go inwards, turn back, come out again: a closed path in the space of place and angle.
fn closed_turn(edge_force: EdgeForce, turn_rad: f64) -> f64 {
    let mut probe = Probe::new(elastic(), table(), edge_force, v(0.0, 0.0, 1.0));
    let (out, edge, inside) = (beside(0.04, 0.03), beside(0.0, 0.03), beside(-0.1, 0.03));
    work_of_turn(&mut probe, out, turn_rad)
        + work_along(&mut probe, out, edge)
        + work_along(&mut probe, edge, inside)
        + work_of_turn(&mut probe, inside, -turn_rad)
        + work_along(&mut probe, inside, edge)
        + work_along(&mut probe, edge, out)
}

#[test]
fn a_closed_turn_over_an_edge_does_no_work_if_the_edge_force_acts_at_the_centre() {
    // of 9 J stored
    // Measured: 0.
    assert_below("net work, J", closed_turn(EdgeForce::AtCentre, 0.7), 1e-11);
}

#[test]
fn at_the_contact_point_each_closed_turn_over_an_edge_does_the_work_u_times_the_angle() {
    // the edge force (U/r)ê at −rN̂ has the moment U about the centre, only within the band
    let stored = 0.5 * K * 0.03 * 0.03;
    for turn in [0.7, -0.7, 0.2] {
        let work = closed_turn(EdgeForce::AtContactPoint, turn);
        // −r N̂ × (U/r) ê with N̂ = Z′, ê = X′ is −U Y′.
        // Measured: 8.9e-16.
        assert_below("net work less −U·turn, J", work + stored * turn, 1e-11);
    }
}

#[test]
fn without_a_turn_a_closed_path_over_an_edge_does_no_work_in_either_reading() {
    for edge_force in [EdgeForce::AtCentre, EdgeForce::AtContactPoint] {
        let mut probe = Probe::new(elastic(), table(), edge_force, v(0.0, 0.0, 1.0));
        let corners = [
            beside(0.04, 0.01),
            beside(0.0, 0.01),
            beside(-0.1, 0.01),
            beside(-0.1, 0.04),
            beside(0.0, 0.04),
            beside(0.04, 0.04),
            beside(0.04, 0.01),
        ];
        let work: f64 = corners.windows(2).map(|w| work_along(&mut probe, w[0], w[1])).sum();
        // of 16 J stored at most
        // Measured: 1.8e-13.
        assert_below("net work, J", work, 1e-11);
    }
}

/// A spinning bead that comes down beside the table's edge at a slant, and leaves again.
fn over_the_edge(edge_force: EdgeForce, spin_rad_s: f64, step_s: f64) -> Setup {
    let mut setup = bead_among(elastic(), table(), edge_force);
    setup.posture = straight(v(0.53, 0.1, 0.12), v(-0.5, 0.0, -1.0));
    if let occupant_core::model::seating::InitialPosture::Coordinates(q) = &mut setup.posture {
        // all segments turn about Y′ alike; θ̇ at θ = 0
        for at in occupant_core::motion::report_coordinates::EULER_START {
            q.rates[at + 1] = spin_rad_s;
        }
    }
    setup.time.end_s = 0.3;
    setup.time.output_s = 0.3;
    setup.integrator = occupant_core::model::setup::Integrator::Rk4 { step_s };
    setup
}

/// Kinetic energy at the end less that at the start, J, and the greatest imbalance as a fraction.
fn gain(setup: Setup) -> (f64, f64) {
    let model = Model::new(setup).unwrap();
    let mut kinetic = Vec::new();
    let outcome = simulate(
        &model,
        Watch(|s: &Sample<'_>| {
            kinetic.push(s.energy.kinetic_j);
            assert!(s.actions.contacts.is_empty());
        }),
    )
    .unwrap();
    assert_eq!(outcome.first_touches.len(), 1);
    (kinetic[1] - kinetic[0], outcome.energy.balance_error)
}

#[test]
fn a_turning_bead_pushed_over_an_edge_gains_nothing_if_the_edge_force_acts_at_the_centre() {
    for (spin, step) in [(6.0, 1e-4), (6.0, 1e-5), (-6.0, 1e-5), (0.0, 1e-5)] {
        let (gained, balance) = gain(over_the_edge(EdgeForce::AtCentre, spin, step));
        // One step straddles the inner end of the band, where the edge force, below 20 N, drops to zero; the bead goes
        // 0.5 m/s there. Of 6.3 J.
        // Measured: 1.4e-4.
        assert_below("gain, J", gained, 20.0 * 0.5 * step);
        // Measured: 5.0e-9.
        assert_below("energy imbalance", balance, 1e-7);
    }
}

#[test]
fn at_the_contact_point_the_turn_of_the_bead_makes_a_difference_that_the_ledger_books() {
    let forward = gain(over_the_edge(EdgeForce::AtContactPoint, 6.0, 1e-5));
    let backward = gain(over_the_edge(EdgeForce::AtContactPoint, -6.0, 1e-5));
    assert!(forward.0 * backward.0 < 0.0, "{forward:?} {backward:?}");
    // energy that no spring stored, either way round
    // Measured: 0.6002.
    assert_within("work of the turn, J", forward.0.abs(), [0.1, 5.0]);
    // Measured: 5.0e-9.
    assert_below("energy imbalance", forward.1.max(backward.1), 1e-7);
}

#[test]
fn a_pair_opens_touches_passes_and_opens_again() {
    let mut probe = Probe::new(elastic(), table(), EdgeForce::AtCentre, v(0.0, 0.0, 1.0));
    assert_eq!(probe.phase(0), OPEN);
    let mut step = |at: Vector3<f64>, phase: f64, pushes: bool| {
        let force = probe.at(at).force_n;
        assert_eq!((probe.phase(0), force.norm() > 0.0), (phase, pushes), "at {at:?}");
    };
    step(beside(-0.2, 0.02), TOUCHING, true);
    step(beside(0.05, 0.02), TOUCHING, true);
    step(beside(0.12, 0.02), PASSED, false);
    // back over the table below its plane: not caught by it
    step(beside(-0.2, 0.02), PASSED, false);
    step(beside(-0.2, 0.15), PASSED, false);
    // up and out, then down again
    step(beside(-0.2, -0.01), OPEN, false);
    step(beside(-0.2, 0.02), TOUCHING, true);
    // an open pair that dips below the plane beside the face has passed
    step(beside(0.3, -0.05), OPEN, false);
    step(beside(0.3, 0.01), PASSED, false);
    step(beside(0.3, -0.05), OPEN, false);
}

#[test]
fn a_touching_sphere_may_sink_beyond_its_centre() {
    let mut probe = Probe::new(elastic(), table(), EdgeForce::AtCentre, v(0.0, 0.0, 1.0));
    probe.at(beside(-0.2, 0.05));
    let force = probe.at(beside(-0.2, 0.14)).force_n;
    assert_eq!(probe.phase(0), TOUCHING);
    // Measured: 0.
    assert_below("force less K·Δ, N", force.z - K * 0.14, 1e-9);
}

#[test]
fn at_the_start_a_pair_has_passed_where_the_centre_is_behind_or_beside_the_face() {
    let phase = |at: Vector3<f64>| Probe::new(elastic(), table(), EdgeForce::AtCentre, at).phase(0);
    assert_eq!(phase(beside(-0.2, -0.01)), OPEN);
    assert_eq!(phase(beside(-0.2, 0.09)), TOUCHING);
    assert_eq!(phase(beside(-0.2, 0.11)), PASSED);
    assert_eq!(phase(beside(0.09, 0.05)), TOUCHING);
    assert_eq!(phase(beside(0.11, 0.05)), PASSED);
}

#[test]
fn within_a_step_an_open_pair_already_gives_its_loading_force_and_keeps_its_state() {
    let mut probe = Probe::new(elastic(), table(), EdgeForce::AtCentre, v(0.0, 0.0, 0.11));
    probe.at(v(0.0, 0.0, 0.11));
    let force = probe.tried_at(beside(-0.2, 0.03)).force_n;
    // Measured: 0.
    assert_below("force less K·Δ, N", force.z - K * 0.03, 1e-9);
    assert_eq!((probe.phase(0), probe.greatest_m(0)), (OPEN, 0.0));
    assert_eq!(probe.tried_at(beside(0.2, 0.03)).force_n.norm(), 0.0);
}

#[test]
fn a_bead_that_goes_round_an_edge_is_not_caught_by_the_planes_extension() {
    // down beside the table, then under it, all in free flight
    let mut setup = bead_among(elastic(), table(), EdgeForce::AtCentre);
    setup.posture = straight(v(0.75, 0.0, 0.2), v(-1.0, 0.0, -2.0));
    setup.time.end_s = 0.5;
    setup.time.output_s = 0.5;
    let model = Model::new(setup).unwrap();
    let mut end = Vector3::zeros();
    let outcome = simulate(&model, Watch(|s: &Sample<'_>| end = s.state.t1().to_vector())).unwrap();
    assert!(outcome.first_touches.is_empty());
    // Measured: 2.2e-16.
    assert_below("place less free flight, m", (end - v(0.25, 0.0, -0.8)).norm(), 1e-12);
}

#[test]
fn moments_rebuilt_from_the_contact_records_are_those_of_the_run() {
    for edge_force in [EdgeForce::AtCentre, EdgeForce::AtContactPoint] {
        let mut setup = over_the_edge(edge_force, 6.0, 1e-4);
        setup.time.output_s = 0.005;
        let model = Model::new(setup).unwrap();
        let (mut off, mut on_edge) = (0.0_f64, 0);
        simulate(
            &model,
            Watch(|s: &Sample<'_>| {
                for c in s.contacts() {
                    let segment = model.body().spheres[c.sphere].segment.index();
                    let joint = s.vehicle.point_to_frame(s.evaluation.kinematics.joint[segment].to_vector());
                    let rest = (c.point_m.coords - joint).cross(&(c.force_n - c.edge_n));
                    let rebuilt = rest + (c.edge_point_m.coords - joint).cross(&c.edge_n);
                    let moment = s.vehicle.vector_to_frame(s.evaluation.wrench[segment].moment.to_vector());
                    off = off.max((rebuilt - moment).norm());
                    on_edge += usize::from(c.edge_n.norm() > 1.0);
                }
            }),
        )
        .unwrap();
        assert!(on_edge > 3, "{on_edge} outputs on the edge");
        // of some 10 N·m
        assert_below("moment less that of the records, N·m", off, 1e-9);
    }
}

#[test]
fn a_scenario_that_does_not_say_has_the_edge_force_at_the_centre() {
    let text = rod::text(1.0, 0.3, "", 0.1);
    assert_eq!(setup(&text, &[]).edge_force, EdgeForce::AtCentre);
    assert_eq!(setup(&text, &["contact.edge_force=contact_point"]).edge_force, EdgeForce::AtContactPoint);
}
