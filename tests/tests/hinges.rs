//! Hinges that give way: closed forms, and what a back of a seat does to a body.

use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::channel::{Channel, Series, channels};
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::{resume, simulate};
use occupant_tests::measure::assert_below;
use occupant_tests::room::{FINE, Last, ends_alike_side_by_side, setup};

/// An occupant who is far away, and a plate that leans back about an axis below it.
const SPACE: &str = r#"
title = "a plate on a hinge"
gravity = 0
time = { end = "60 ms" }
output = { interval = "0.5 ms" }
integrator = { kind = "rk4", step = "10 us" }
path = { kind = "fixed" }
contact = { bodies = [] }
body = { preset = "male50" }
joints = { preset = "male50" }
initial_state = { q = [900, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0], rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0] }

[materials]
rubber = { k1 = "300 kN/m", mu1 = 1, friction = 0.2 }
clay = { depth = ["0 mm", "10 mm"], force = ["0 MN", "10 MN"], viscous = { force = "100 kN", speed = "1 m/s", depth = "0.1 mm" }, friction = 0 }

[frames.back]
kind = "hinge"
axis = [0, 2, 0]
origin = [0.2, 0, 0.3]
mass = 15
centre = [0.2, 0, -0.1]
inertia = 0.6
angle = [0, "0.02 rad", "1.5 rad"]
moment = ["0 N m", "1200 N m", "1200 N m"]

[surfaces.plate]
frame = "back"
meets = "all"
material = "rubber"
points = [[0, -0.5, -0.5], [0, 0.5, -0.5], [0, 0.5, 0.5], [0, -0.5, 0.5]]
inside = [1, 0, 0]
"#;

const ANGLE: &str = "hinge.back.angle";
/// m r² + J of the plate.
const INERTIA: f64 = 15.0 * 0.16 + 0.6;

/// A ball that flies back against the plate, `up_m` above the axis.
fn ball(name: &str, mass: f64, y_m: f64, up_m: f64, speed: f64) -> String {
    format!(
        "[loose.{name}]\nmass = {mass}\ninertia = [0.1, 0.1, 0.1]\nat = [0.101, {y_m}, {}]\nvelocity = [-{speed}, 0, 0]\n\
         spheres = {{ all = {{ centre = [0, 0, 0], radius = 0.1 }} }}\n",
        0.3 - up_m
    )
}

fn space(more: &str, set: &[&str]) -> Setup {
    setup(&format!("{SPACE}{more}"), set)
}

fn traced(setup: Setup, names: &[&str]) -> (Vec<Vec<f64>>, Outcome) {
    let model = Model::new(setup).unwrap();
    let wanted = |name: &&str| channels(&model).into_iter().find(|c: &Channel| c.name == **name).unwrap();
    let mut series = Series::new(names.iter().map(wanted).collect());
    let outcome = simulate(&model, &mut series).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    (series.values, outcome)
}

fn figures(setup: Setup) -> impl Fn(&str) -> f64 {
    let model = Model::new(setup).unwrap();
    let mut summarizer = Summarizer::new();
    assert_eq!(simulate(&model, &mut summarizer).unwrap().status, Status::Completed);
    let figures = summarizer.summary(None).unwrap().figures(&model);
    move |name| figures.iter().find(|f| f.name == name).and_then(|f| f.value).unwrap_or(f64::NAN)
}

/// m a (r sin θ) of the pulse goes into the plateau, but for the rise to it: M(θ − θ₁/2).
#[test]
fn under_a_long_pulse_it_leans_as_far_as_work_says() {
    let pulse = "path={ kind = \"pulse\", shape = \"square\", speed = \"120 m/s\", direction = [-1, 0, 0], delta_v = \"120 m/s\", duration = \"600 ms\" }";
    let moment = "frames.back.moment=[\"0 N m\", \"1000 N m\", \"1000 N m\"]";
    let set = [pulse, moment, "time.end=550 ms", "frames.back.angle=[0, \"0.002 rad\", \"2 rad\"]"];
    let of = figures(space("", &set));
    let (push, mut angle) = (15.0 * 200.0 * 0.4, 1.0_f64);
    for _ in 0..60 {
        angle = push * angle.sin() / 1000.0 + 0.001;
    }
    assert!(angle > 0.9, "{angle}");
    assert_below("angle, rad", of("hinges.back.angle_max") - angle, 1e-5);
    assert_below("its book", of("hinges.back.book_error"), 1e-4);
}

/// As far as it does not yield: a spring of 60 kN·m/rad under a step, about m a r/K.
#[test]
fn it_swings_as_a_spring_before_it_yields() {
    let pulse = "path={ kind = \"pulse\", shape = \"square\", speed = \"10 m/s\", direction = [-1, 0, 0], delta_v = \"10 m/s\", duration = \"100 ms\" }";
    let (values, _) = traced(space("", &[pulse]), &[ANGLE]);
    let (own, still) = (f64::sqrt(60e3 / INERTIA), 15.0 * 100.0 * 0.4 / 60e3);
    for (i, angle) in values[0].iter().enumerate() {
        let exact = still * (1.0 - (own * 0.5e-3 * i as f64).cos());
        // sin θ for θ: of the second order of 0.02 rad
        assert!((angle - exact).abs() < 3e-5, "{i}: {angle} {exact}");
    }
}

/// The vehicle yaws: the middle of the mass is thrown out, m ω² x z′ about the axis, which lies 0.2 m ahead of the middle.
#[test]
fn the_turning_of_its_vehicle_leans_it() {
    let turn = "path={ kind = \"table\", interpolation = \"spline\", columns = [\"t[s]\", \"yaw[rad]\"], rows = [[0, 0], [0.1, 1], [0.2, 2]] }";
    let (values, _) =
        traced(space("", &[turn, "time.end=50 ms", "frames.back.angle=[0, \"0.2 rad\", \"1.5 rad\"]"]), &[ANGLE]);
    // by hand: x = 0.2 − 0.4 sin θ, z = −0.4 cos θ from the axis; θ̈ (m r²+J) = −m ω² x 0.4 cos θ − K θ
    let (mut angle, mut rate, h) = (0.0_f64, 0.0_f64, 1e-6);
    let felt = |t: f64| (-15.0 * 100.0 * (0.2 - 0.4 * t.sin()) * 0.4 * t.cos() - 6e3 * t) / INERTIA;
    for i in 1..=50_000 {
        let half = rate + 0.5 * h * felt(angle);
        angle += h * half;
        rate = half + 0.5 * h * felt(angle);
        if i % 500 == 0 {
            assert!((values[0][i / 500] - angle).abs() < 1e-8, "{i}: {} {angle}", values[0][i / 500]);
        }
    }
}

/// (m v R)²/(2 (I + m R²) M) of a mass that stays on the plate where it hits it, as long as sin θ is θ.
#[test]
fn a_mass_that_stays_is_stopped_by_the_plateau() {
    let set = [
        "surfaces.plate.material=\"clay\"",
        "frames.back.angle=[0, \"0.0005 rad\", \"1.5 rad\"]",
        "time.end=60 ms",
        "integrator.step=2 us",
    ];
    let angle = figures(space(&ball("one", 10.0, 0.0, 0.5, 6.0), &set))("hinges.back.angle_max");
    let closed = (10.0 * 6.0 * 0.5_f64).powi(2) / (2.0 * (INERTIA + 10.0 * 0.25) * 1200.0) + 0.00025;
    assert_below("angle over its closed form", angle / closed - 1.0, 0.02);
}

/// Friction, two bodies, a hinge that leans far: the books of each body and of the hinge close.
#[test]
fn books_of_bodies_and_hinge_close() {
    let more = ball("one", 20.0, -0.2, 0.7, 7.0) + &ball("two", 12.0, 0.2, 0.3, 5.0);
    let set = ["frames.back.moment=[\"0 N m\", \"900 N m\", \"900 N m\"]", "time.end=120 ms"];
    let (values, outcome) = traced(space(&more, &set), &[ANGLE, "hinge.back.push", "energy.columns"]);
    assert!(values[0].iter().any(|angle| *angle > 0.3) && values[1].iter().any(|push| *push > 1000.0));
    assert_below("energy balance", outcome.energy.balance_error, 1e-5);
    assert!(values[2].last().unwrap() > &100.0);
    let (mut worst, model) = (0.0_f64, Model::new(space(&more, &set)).unwrap());
    let watch = Watch(|s: &Sample<'_>| worst = s.ledgers.iter().map(|own| own.balance_j.abs()).fold(worst, f64::max));
    simulate(&model, watch).unwrap();
    assert_below("books of the bodies, J", worst, 2e-3);
    assert_below("its book", figures(space(&more, &set))("hinges.back.book_error"), 1e-4);
}

/// A hinge that cannot lean is its vehicle.
#[test]
fn a_hinge_that_does_not_give_is_its_vehicle() {
    let place = |set: &[&str]| traced(space(&ball("one", 5.0, 0.1, 0.6, 3.0), set), &["sphere.one.all.position.x"]).0;
    let stiff = place(&["frames.back.moment=[0, \"40 MN m\", \"40 MN m\"]", "time.end=30 ms"]);
    let fixed = place(&["frames.back=null", "surfaces.plate.frame=\"vehicle\"", "time.end=30 ms"]);
    let off = stiff[0].iter().zip(&fixed[0]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert_below("greatest distance, m", off, 1e-5);
}

/// The same bits alone and in lanes, from the start and from a checkpoint; a column beside it keeps its own place.
#[test]
fn a_hinge_has_the_same_bits_in_lanes_and_after_a_checkpoint() {
    let more = ball("one", 20.0, 0.0, 0.6, 7.0);
    let column = "frames.column={ kind = \"column\", axis = [-1, 0, 0], mass = 3, stroke = [0, 0.002, 0.3], force = [0, 3000, 3000] }";
    let model = |i: u32| {
        let mass = format!("frames.back.mass={}", 12.0 + 0.5 * f64::from(i));
        Model::new(space(&more, &[column, &mass, "integrator.step=50 us"])).unwrap()
    };
    ends_alike_side_by_side(model);
    for integrator in ["integrator.step=50 us", FINE] {
        let model = Model::new(space(&more, &[column, integrator])).unwrap();
        let mut all = Vec::new();
        simulate(&model, Watch(|s: &Sample<'_>| all.push(s.checkpoint()))).unwrap();
        let mut last = Last::default();
        resume(&model, &all[60], &mut last).unwrap();
        assert!(last.0.as_ref() == all.last(), "{integrator}");
    }
}
