//! Belts: geometry against hand figures, force against the gradient of the length, webbing, crossing the anchors' line.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Point3, Vector3};
use occupant_core::body::ContactSphere;
use occupant_core::body::tti12;
use occupant_core::forces::belt::law::{BeltAction, BeltLaw};
use occupant_core::forces::belt::{Belt, RestLength};
use occupant_core::kernel::Situation;
use occupant_core::model::Model;
use occupant_core::motion::vector::V3;
use occupant_tests::cases::{afloat, belt, male50, spring};
use occupant_tests::measure::assert_below;
use occupant_tests::room::setup;

const R: f64 = 0.1;
const K: f64 = 4e4;

/// Anchors at distances `l` (m) from the origin, `theta_3` apart, in a plane that lies askew in space.
fn anchors(l: [f64; 2], theta_3: f64) -> [Point3<f64>; 2] {
    let (along, across) = plane();
    let at = |l: f64, angle: f64| Point3::from((along * angle.cos() + across * angle.sin()) * l);
    [at(l[0], 0.0), at(l[1], theta_3)]
}

/// Axes of the belt's plane.
fn plane() -> (Vector3<f64>, Vector3<f64>) {
    let along = Vector3::new(2.0, -1.0, 2.0) / 3.0;
    (along, Vector3::new(1.0, -2.0, -2.0) / 3.0)
}

/// The belt round a sphere at the origin with 1 cm of preload: it pulls with 400 N.
fn preloaded(anchors_m: [Point3<f64>; 2]) -> BeltAction<f64> {
    let law = BeltLaw::laid(&belt(anchors_m, K, -0.01), R, V3::zero());
    law.act(V3::zero(), &law.initial_history(V3::zero()))
}

/// Checks wrap, length and force of a belt against hand figures; `force` in units of F_L.
fn check(l: [f64; 2], theta_3: f64, wrap: f64, length: f64, force: f64) {
    let action = preloaded(anchors(l, theta_3));
    // Measured: 4.4e-16.
    assert_below("wrap, rad", action.wrap - wrap, 1e-14);
    // Measured: 1.1e-16.
    assert_below("length, m", action.length - length, 1e-15);
    // Measured: 3.4e-13.
    assert_below("loop force, N", action.loop_force - 400.0, 1e-9);
    let found = action.force.to_vector();
    // Measured: 8.0e-13.
    assert_below("force, N", found.norm() - 400.0 * force, 1e-9);
    let half_angle = BeltLaw::half_angle(action.wrap);
    // Measured: 2.2e-16.
    assert_below("2 cos α", 2.0 * half_angle.cos() - force, 1e-14);
    // at the angle ½(θ₃ + θ₂ − θ₁) from the first anchor towards the second
    let [theta_1, theta_2] = l.map(|l| (R / l).acos());
    let (along, across) = plane();
    let angle: f64 = 0.5 * (theta_3 + theta_2 - theta_1);
    let direction = along * angle.cos() + across * angle.sin();
    // Measured: 2.5e-16.
    assert_below("direction", (found.normalize() - direction).norm(), 1e-13);
}

#[test]
fn parallel_sides_pull_with_twice_the_loop_force() {
    // l = 2r: θ₁ = θ₂ = 60°; θ₃ = 60° leaves a wrap of 180°
    let length = 2.0 * 0.2 * 0.75_f64.sqrt() + R * PI;
    check([2.0 * R, 2.0 * R], PI / 3.0, PI, length, 2.0);
    // l₁ = 5r/3, l₂ = 5r/4: θ₁ + θ₂ = 90°; θ₃ = 90°
    let length = R * (4.0 / 3.0 + 3.0 / 4.0 + PI);
    check([5.0 * R / 3.0, 5.0 * R / 4.0], FRAC_PI_2, PI, length, 2.0);
}

#[test]
fn sides_that_spread_towards_the_anchors_pull_with_2_f_cos_alpha() {
    // 3-4-5 triangles: θ₁ = θ₂ = acos 3/5, θ₃ = 90°, cos α = 7/(5√2)
    let wrap = TAU - 2.0 * 0.6_f64.acos() - FRAC_PI_2;
    let length = R * (8.0 / 3.0 + wrap);
    check([5.0 * R / 3.0; 2], FRAC_PI_2, wrap, length, 1.4 * 2_f64.sqrt());
}

#[test]
fn sides_that_close_towards_the_anchors_pull_with_2_f_cos_alpha() {
    // θ₁ = θ₂ = 60°, θ₃ = 20°: W = 220°, α = 20°
    let degree = PI / 180.0;
    let length = 0.4 * 0.75_f64.sqrt() + R * 220.0 * degree;
    let force = 2.0 * (20.0 * degree).cos();
    check([2.0 * R; 2], 20.0 * degree, 220.0 * degree, length, force);
}

/// Numbers spread evenly over (−1, 1), the same in every run.
fn spread(i: u32) -> f64 {
    2.0 * (f64::from(i) * 0.618_033_988_749_894_9).fract() - 1.0
}

#[test]
fn the_force_is_minus_the_loop_force_times_the_gradient_of_the_length() {
    let mut worst = 0.0_f64;
    for case in 0..200 {
        let place = |i: u32| Vector3::from_fn(|j, _| spread(97 * case + 3 * i + j as u32 + 1));
        let centre = place(0) * 0.1;
        let anchor = |i: u32| {
            let towards = place(i).normalize();
            Point3::from(centre + towards * (0.13 + 0.2 * place(i).x.abs()))
        };
        let law = BeltLaw::laid(&belt([anchor(1), anchor(2)], K, -0.01), R, V3::of(&centre));
        let history = law.initial_history(V3::of(&centre));
        let action = law.act(V3::of(&centre), &history);
        if action.wrap < 0.1 {
            continue;
        }
        let h = 1e-6;
        let length = |at: Vector3<f64>| law.act(V3::of(&at), &history).length;
        let gradient = Vector3::from_fn(|i, _| {
            let e = Vector3::ith(i, h);
            (length(centre + e) - length(centre - e)) / (2.0 * h)
        });
        let expected = gradient * -action.loop_force;
        worst = worst.max((action.force.to_vector() - expected).norm() / action.loop_force);
    }
    // Central differences: h² l'''/6 and rounding.
    // Measured: 1.9e-10.
    assert_below("force against gradient, of F_L", worst, 1e-7);
}

#[test]
fn the_free_lengths_are_tangent_to_the_sphere() {
    for theta_3 in [0.3, 1.0, 2.5] {
        let anchors = anchors([0.17, 0.31], theta_3);
        let action = preloaded(anchors);
        for (anchor, free) in anchors.iter().zip(action.free) {
            let free = free.to_vector();
            // distance of the centre from the line through the anchor
            let distance = anchor.coords.cross(&free).norm();
            // Measured: 4.2e-17.
            assert_below("distance less r, m", distance - R, 1e-15);
            // Measured: 1.1e-16.
            assert_below("unit vector", free.norm() - 1.0, 1e-14);
        }
    }
}

#[test]
fn when_the_wrap_vanishes_the_belt_is_straight_and_its_force_on_the_sphere_fades_to_nothing() {
    // anchors 0.5 m apart on a line that the sphere crosses along its normal
    let anchors = [Point3::new(0.25, 0.0, 0.0), Point3::new(-0.25, 0.0, 0.0)];
    let start = V3::of(&Vector3::new(0.0, 0.0, -0.2));
    let mut law = BeltLaw::laid(&belt(anchors, K, 0.0), R, start);
    law.rest_length = 0.45;
    let mut history = law.initial_history(start);
    let mut last: Option<BeltAction<f64>> = None;
    let (mut off, step) = (None, 1e-5);
    // from 0.2 m before the line to 0.15 m beyond, and exactly through it: the belt leaves the sphere r beyond the line
    for i in -20_000..15_000 {
        let z = step * f64::from(i);
        let centre = V3::of(&Vector3::new(0.0, 0.0, z));
        let action = law.act(centre, &history);
        law.commit(&action, &mut history);
        if let Some(last) = last {
            // lengths change by less than 2 m per m, forces by their stiffness: no jump at z = 0 or at z = r
            assert!((action.length - last.length).abs() <= 2.0 * step + 1e-15, "{z}");
            let jump = (action.force - last.force).to_vector().norm();
            assert!(jump < 2e5 * step, "{z}: {jump} N");
        }
        if action.wrap <= 0.0 && off.is_none() {
            off = Some(z);
            // W and 2 cos α vanish together.
            // Measured: 1.6e-1.
            assert_below("last force before, N", last.unwrap().force.to_vector().norm(), 0.2);
            // Measured: 1.1e-16.
            assert_below("length less the anchors' distance, m", action.length - 0.5, 1e-6);
        }
        if action.wrap <= 0.0 {
            assert_eq!((action.loop_force, action.stored), (0.0, 0.0));
        }
        last = Some(action);
    }
    // Measured: 0.
    assert_below("place where it leaves less r, m", off.unwrap() - R, 2.0 * step);
}

#[test]
fn beyond_the_anchors_line_theta_3_exceeds_a_half_turn() {
    let anchors = [Point3::new(0.25, 0.0, 0.0), Point3::new(-0.25, 0.0, 0.0)];
    let start = V3::of(&Vector3::new(0.0, 0.0, -0.2));
    let law = BeltLaw::laid(&belt(anchors, K, 0.0), R, start);
    let history = law.initial_history(start);
    let beyond = V3::of(&Vector3::new(0.0, 0.0, 0.05));
    let l = 0.25_f64.hypot(0.05);
    let theta_3 = TAU - 2.0 * (0.25_f64 / 0.05).atan();
    let wrap = TAU - 2.0 * (R / l).acos() - theta_3;
    // Measured: 4.4e-16.
    assert_below("wrap, rad", law.act(beyond, &history).wrap - wrap, 1e-14);
    // a belt laid there anew would go round the other side
    let anew = law.act(beyond, &law.initial_history(beyond));
    let other_way = TAU - 2.0 * (R / l).acos() - (TAU - theta_3);
    // Measured: 4.4e-16.
    assert_below("wrap of a belt laid anew, rad", anew.wrap - other_way, 1e-14);
}

#[test]
fn webbing_with_fractions_unloads_below_its_loading_curve_and_remembers_it_for_the_run() {
    let anchors = [Point3::new(-0.3, -0.2, 0.2), Point3::new(-0.3, 0.2, 0.2)];
    let mut data: Belt = belt(anchors, K, 0.0);
    data.webbing = spring(K, 0.02, 2.0 * K, 0.5, 0.5);
    let at = |x: f64| V3::of(&Vector3::new(x, 0.0, 0.0));
    let law = BeltLaw::laid(&data, R, at(0.0));
    let mut history = law.initial_history(at(0.0));
    let mut pull = |x: f64| {
        let action = law.act(at(x), &history);
        law.commit(&action, &mut history);
        (action.elongation, action.loop_force)
    };
    let (top, force) = pull(0.02);
    assert!(top > 0.02);
    // Measured: 0.
    assert_below("loading, N", force - (K * 0.02 + 2.0 * K * (top - 0.02)), 1e-8);
    let line = |e: f64| {
        let rest = e - (top - 0.5 * top);
        2.0 * K * rest.clamp(0.0, 0.01) + 4.0 * K * (rest - 0.01).max(0.0)
    };
    for x in [0.018, 0.012, -0.05, 0.012, 0.018] {
        let (elongation, force) = pull(x);
        // Measured: 0.
        assert_below("unloading line, N", force - line(elongation), 1e-8);
    }
}

#[test]
fn slack_delays_the_pull_and_preload_advances_it() {
    let anchors = anchors([0.2, 0.25], 0.8);
    let action = |rest: RestLength| {
        let mut data = belt(anchors, K, 0.0);
        data.rest = rest;
        let law = BeltLaw::laid(&data, R, V3::zero());
        law.act(V3::zero(), &law.initial_history(V3::zero()))
    };
    let slack = action(RestLength::Slack { slack_m: 0.02 });
    // Measured: 1.7e-17.
    assert_below("elongation, m", slack.elongation + 0.02, 1e-15);
    assert_eq!((slack.loop_force, slack.stored), (0.0, 0.0));
    assert_eq!(slack.force.to_vector(), Vector3::zeros());
    let preload = action(RestLength::Slack { slack_m: -0.02 });
    // Measured: 6.8e-13.
    assert_below("preload, N", preload.loop_force - K * 0.02, 1e-9);
    let given = action(RestLength::Given { length_m: slack.length - 0.005 });
    // Measured: 1.7e-13.
    assert_below("given length, N", given.loop_force - K * 0.005, 1e-9);
}

/// A floating body whose pelvis wears a belt with its first anchor at `anchor`.
fn belted(anchor: Point3<f64>) -> Result<Model, occupant_core::Problems> {
    let mut setup = afloat(male50(), 0.1, 1e-3);
    let mut data = belt([anchor, Point3::new(-0.4, 0.3, 0.5)], K, 0.0);
    data.sphere = 2;
    setup.belts = vec![data];
    Model::new(setup)
}

#[test]
fn an_anchor_inside_the_sphere_is_an_error_that_names_it_and_the_distance() {
    let setup = afloat(male50(), 0.1, 1e-3);
    let torso = setup.body.segments[0].length_m + setup.body.segments[3].length_m;
    // the pelvis sphere hangs `torso` below T1; Z_v points down
    let text = belted(Point3::new(0.05, 0.0, torso)).unwrap_err().to_string();
    for part in ["belts.belt.anchors", "anchor 1", "0.0500 m", "pelvis", "0.1194 m"] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(belted(Point3::new(0.2, 0.0, torso)).is_ok());
}

#[test]
fn the_belt_force_acts_at_the_spheres_centre() {
    // a sphere off its segment's joint: the moment about the joint is arm × force
    let mut setup = afloat(male50(), 0.1, 1e-3);
    setup.body.spheres = vec![ContactSphere::new("probe", tti12::UPPER_TORSO, Point3::new(0.04, -0.03, 0.2), R)];
    let anchors = [Point3::new(-0.4, -0.2, 0.1), Point3::new(-0.3, 0.25, 0.2)];
    setup.belts = vec![belt(anchors, K, -0.01)];
    let model = Model::new(setup).unwrap();
    let frames = model.frames(0.0, 0.0, &mut Default::default());
    let mut history = model.start().history.clone();
    let e = model.system().evaluate(Situation::within(&model.start().state, &frames), &mut history, &mut ());
    let wrench = &e.wrench[tti12::UPPER_TORSO.index()];
    let (force, moment) = (wrench.force.to_vector(), wrench.moment.to_vector());
    assert!(force.norm() > 100.0);
    let arm = Vector3::new(0.04, -0.03, 0.2);
    // Measured: 0.
    assert_below("moment, N·m", (moment - arm.cross(&force)).norm(), 1e-12);
}

/// What is said of the driver's lap belt with these anchors.
fn said_of_lap(anchors: &str) -> String {
    let text = include_str!("../../tests/data/hand/cabin.toml");
    let driver = setup(text, &[&format!("belts.lap.anchors = {anchors}")]);
    Model::new(driver).unwrap().warnings().to_string()
}

#[test]
fn a_belt_beside_the_body_and_a_lap_belt_that_would_slip_are_warned_of() {
    assert_eq!(said_of_lap("[[-0.30, -0.58, 0.21], [-0.30, -0.12, 0.21]]"), "");
    let beside = said_of_lap("[[-0.30, 0.58, 0.21], [-0.30, 0.12, 0.21]]");
    assert!(beside.contains("belts.lap.anchors") && beside.contains("to the right of the pelvis"), "{beside}");
    let flat = said_of_lap("[[-0.40, -0.58, 0.05], [-0.40, -0.12, 0.05]]");
    assert!(flat.contains("slides up onto the abdomen"), "{flat}");
    let ahead = said_of_lap("[[-0.05, -0.58, 0.25], [-0.05, -0.12, 0.25]]");
    assert!(ahead.contains("20° to 80°"), "{ahead}");
}
