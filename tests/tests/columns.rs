//! Steering columns: closed forms, a case that is integrated by hand, and what a frame that gives way does to a body.

use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::channel::{Channel, Series, channels};
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::{resume, simulate};
use occupant_tests::measure::{assert_below, assert_within};
use occupant_tests::room::{FINE, Last, ends_alike_side_by_side, setup};

/// An occupant who is far away, and a plate on a column that gives way along x.
const SPACE: &str = r#"
title = "a plate on a column"
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

[frames.column]
kind = "column"
axis = [2, 0, 0]
mass = 3
stroke = ["0 mm", "2 mm", "300 mm"]
force = ["0 kN", "8 kN", "8 kN"]

[surfaces.plate]
frame = "column"
meets = "all"
material = "rubber"
points = [[0, -0.5, -0.5], [0, 0.5, -0.5], [0, 0.5, 0.5], [0, -0.5, 0.5]]
inside = [-1, 0, 0]
"#;

/// A ball that flies along x against the plate.
fn ball(name: &str, mass: f64, y_m: f64, speed: f64) -> String {
    format!(
        "[loose.{name}]\nmass = {mass}\ninertia = [0.1, 0.1, 0.1]\nat = [-0.101, {y_m}, 0]\nvelocity = [{speed}, 0, 0]\n\
         spheres = {{ all = {{ centre = [0, 0, 0], radius = 0.1 }} }}\n"
    )
}

fn space(more: &str, set: &[&str]) -> Setup {
    setup(&format!("{SPACE}{more}"), set)
}

/// All values of the channels of these names, and how the run ended.
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

const STROKE: &str = "column.column.stroke";

/// Ball and hub as two masses, integrated by hand: x of the plate and of the ball at a time, m.
fn by_hand(mass: f64, stiffness: f64, speed: f64, until_s: f64) -> [f64; 2] {
    let (hub, plateau, slope) = (3.0, 8000.0_f64, 4e6);
    let mut most = 0.0_f64;
    // hub, ball (its foremost point) and their speeds
    let mut state = [0.0, -0.001, 0.0, speed];
    let rate = |s: &[f64; 4], most: f64| {
        let greatest = most.max(s[0]);
        let held = plateau.min(slope * greatest) - slope * (greatest - s[0]);
        let press = stiffness * (s[1] - s[0]).max(0.0);
        [s[2], s[3], (press - held) / hub, -press / mass]
    };
    let step = 1e-6;
    let along = |s: &[f64; 4], h: f64, k: &[f64; 4]| std::array::from_fn::<f64, 4, _>(|i| s[i] + h * k[i]);
    for _ in 0..(until_s / step).round() as usize {
        most = most.max(state[0]);
        let k1 = rate(&state, most);
        let k2 = rate(&along(&state, 0.5 * step, &k1), most);
        let k3 = rate(&along(&state, 0.5 * step, &k2), most);
        let k4 = rate(&along(&state, step, &k3), most);
        state = std::array::from_fn(|i| state[i] + step / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
    [state[0], state[1]]
}

#[test]
fn a_ball_on_a_column_moves_as_two_masses_integrated_by_hand() {
    let scene = space(&ball("one", 20.0, 0.0, 7.0), &[]);
    let (values, outcome) = traced(scene, &[STROKE, "sphere.one.all.position.x"]);
    for (i, until_s) in [(6, 3e-3), (30, 15e-3), (60, 30e-3), (120, 60e-3)] {
        let [hub, ball] = by_hand(20.0, 300e3, 7.0, until_s);
        assert_below("stroke, m", values[0][i] - hub, 1e-6);
        assert_below("ball, m", values[1][i] + 0.1 - ball, 1e-6);
    }
    assert_below("energy balance", outcome.energy.balance_error, 1e-5);
}

/// Both balls push: as one of twice the mass on twice the stiffness, and every body's book closes.
#[test]
fn what_two_bodies_do_to_a_column_adds_up() {
    let scene = |set: &[&str]| space(&(ball("one", 10.0, -0.2, 7.0) + &ball("two", 10.0, 0.2, 7.0)), set);
    let (values, outcome) = traced(scene(&[]), &[STROKE]);
    let [hub, _] = by_hand(20.0, 600e3, 7.0, 60e-3);
    assert_below("stroke, m", values[0][120] - hub, 1e-6);
    assert_below("energy balance", outcome.energy.balance_error, 1e-5);
    let mut worst = 0.0_f64;
    let model = Model::new(scene(&["loose.two.velocity=[4, 0, 0]"])).unwrap();
    let watch = Watch(|s: &Sample<'_>| worst = s.ledgers.iter().map(|own| own.balance_j.abs()).fold(worst, f64::max));
    simulate(&model, watch).unwrap();
    assert_below("books of the bodies, J", worst, 2e-3);
}

/// m²v²/(2(m + m_h)F) of a mass that stays with the hub: all that is left of its energy goes into the plateau.
#[test]
fn a_mass_that_stays_with_the_hub_is_stopped_by_the_plateau() {
    let stiff = ["surfaces.plate.material=\"clay\"", "frames.column.stroke=[0, \"0.05 mm\", \"300 mm\"]"];
    let set = [&stiff[..], &["integrator.step=2 us", "time.end=40 ms"]].concat();
    let stroke = figures(space(&ball("one", 30.0, 0.0, 6.0), &set))("columns.column.stroke_max");
    let closed = (30.0 * 6.0_f64).powi(2) / (2.0 * 33.0 * 8000.0);
    // while they meet, for 0.1 ms, the plateau slows the hub already
    assert_below("stroke over its closed form", stroke / closed - 1.0, 0.01);
}

/// A square pulse of a and T: a hub of m_h a < F stays within m_h a/K, twice that as it swings; one that yields gets the speed
/// (a − F/m_h)T and goes as far as that brings it.
#[test]
fn without_a_body_a_pulse_moves_the_hub_as_its_closed_form_says() {
    let stroke = |set: &[&str]| {
        let pulse = "path={ kind = \"pulse\", shape = \"square\", speed = \"20 m/s\", peak = \"200 m/s^2\", duration = \"50 ms\" }";
        let set = [&[pulse, "time.end=120 ms", "output.interval=20 us", FINE], set].concat();
        figures(space("", &set))
    };
    let held = stroke(&["frames.column.force=[\"0 N\", \"1300 N\", \"1300 N\"]"]);
    assert_below("swing about m_h a/K", held("columns.column.stroke_max") / (2.0 * 600.0 * 0.002 / 1300.0) - 1.0, 1e-4);
    let stiff =
        ["frames.column.stroke=[0, \"0.1 mm\", \"500 mm\"]", "frames.column.force=[\"0 N\", \"300 N\", \"300 N\"]"];
    let given = stroke(&stiff);
    // a swing as far as it yields, (200 − 100) m/s² for the rest of the pulse, then 100 m/s² against it
    let own = f64::sqrt(3e6 / 3.0);
    let (yields_s, speed) = (std::f64::consts::FRAC_PI_3 / own, 200.0 / own * f64::sqrt(0.75));
    let rest_s = 0.05 - yields_s;
    let (at_end, fastest) = (1e-4 + speed * rest_s + 50.0 * rest_s * rest_s, speed + 100.0 * rest_s);
    assert_below("stroke, m", given("columns.column.stroke_max") - (at_end + fastest * fastest / 200.0), 2e-6);
    assert_below("its book", given("columns.column.book_error"), 1e-4);
}

/// A half sine that does not make it yield: a spring under a sine, exact and smooth.
#[test]
fn a_column_converges_with_the_fourth_order_of_rk4() {
    let off = |step: &str| {
        let pulse = "path={ kind = \"pulse\", shape = \"half_sine\", speed = \"20 m/s\", peak = \"100 m/s^2\", duration = \"60 ms\" }";
        let set = [pulse, "time.end=50 ms", &format!("integrator.step={step}"), "frames.column.force=[0, 500, 500]"];
        let (values, _) = traced(space("", &set), &[STROKE]);
        let (own, driven) = (f64::sqrt(500.0 / 0.002 / 3.0), std::f64::consts::PI / 0.06);
        let exact =
            |t: f64| 100.0 / (own * own - driven * driven) * (f64::sin(driven * t) - driven / own * f64::sin(own * t));
        values[0].iter().enumerate().map(|(i, x)| (x - exact(0.5e-3 * i as f64)).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (off("0.5 ms"), off("0.25 ms"));
    assert_within("order", (coarse / fine).log2(), [3.7, 4.3]);
}

/// The vehicle turns about the middle between its wheels: what turns with the column is thrown outwards.
#[test]
fn the_turning_of_its_vehicle_moves_a_column() {
    let turn = "path={ kind = \"table\", interpolation = \"spline\", columns = [\"t[s]\", \"yaw[rad]\"], rows = [[0, 0], [0.1, 1], [0.2, 2]] }";
    let place = ["frames.column.origin=[0.8, 0.3, 0]", "frames.column.force=[0, 500, 500]"];
    let set = [&[turn, "time.end=50 ms"], &place[..]].concat();
    let (values, _) = traced(space("", &set), &[STROKE]);
    let (rate, own) = (10.0_f64, 500.0 / 0.002 / 3.0 - 100.0);
    for (i, x) in values[0].iter().enumerate() {
        let exact = rate * rate * 0.8 / own * (1.0 - (own.sqrt() * 0.5e-3 * i as f64).cos());
        assert!((x - exact).abs() < 1e-9, "{i}: {x} {exact}");
    }
}

/// What was pushed in stays, but for what the force gives back.
#[test]
fn a_stroke_stays_when_the_ball_has_gone() {
    let (values, _) =
        traced(space(&ball("one", 20.0, 0.0, 7.0), &["time.end=120 ms"]), &[STROKE, "column.column.push"]);
    let most = values[0].iter().fold(0.0_f64, |most, x| most.max(*x));
    let last = values[1].iter().rposition(|push| *push > 0.0).unwrap();
    assert!(most > 0.04 && last < 200, "{most} {last}");
    // it swings about x_m − F/K, 2 mm before the farthest
    let left = &values[0][last + 1..];
    assert!(left.iter().all(|x| (x - (most - 0.002)).abs() < 0.00201), "{most} {left:?}");
}

const DRIVER: &str = include_str!("../../tests/data/hand/column-driver.toml");

/// A driver whose wheel hangs on this column.
fn driver(set: &[&str]) -> Setup {
    setup(DRIVER, set)
}

#[test]
fn a_column_that_does_not_give_is_its_vehicle() {
    let places = |setup: Setup| {
        let mut list = Vec::new();
        let model = Model::new(setup).unwrap();
        simulate(
            &model,
            Watch(|s: &Sample<'_>| list.extend((0..s.model.body().spheres.len()).map(|i| s.sphere_centre_m(i)))),
        )
        .unwrap();
        list
    };
    let stiff = ["frames.column.stroke=[0, \"1 mm\"]", "frames.column.force=[\"0 MN\", \"1 MN\"]"];
    let fixed = ["frames.column.kind=\"panel\"", "frames.column.path={ kind = \"fixed\" }"];
    let none = ["axis", "mass", "stroke", "force"].map(|key| format!("frames.column.{key}=null"));
    let fixed = fixed.iter().copied().chain(none.iter().map(String::as_str)).collect::<Vec<_>>();
    let off =
        places(driver(&stiff)).iter().zip(&places(driver(&fixed))).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    assert_below("greatest distance, m", off, 1e-3);
}

/// With belt and bag, with either and with nothing: energy, gas and column close, and forces on the column are those on the body.
#[test]
fn books_close_with_a_bag_on_a_column() {
    for set in [&[][..], &["bags.driver=null"], &["belts.driver=null"], &["belts.driver=null", "bags.driver=null"]] {
        let set = &[set, &[FINE]].concat()[..];
        let (values, outcome) = traced(driver(set), &["column.column.push", "column.column.stroke", "energy.columns"]);
        assert_below("energy of the body", outcome.energy.balance_error, 1e-5);
        let of = figures(driver(set));
        assert_below("book of the column", of("columns.column.book_error"), 1e-4);
        if !set.contains(&"bags.driver=null") {
            assert_below("energy of the gas", of("bags.driver.gas_balance_error"), 1e-5);
        }
        assert!(values[0].iter().any(|push| *push > 500.0), "{set:?}");
    }
}

#[test]
fn what_pushes_a_column_is_what_the_body_feels_of_all_that_it_carries() {
    let set = ["belts.driver=null"];
    let axis = nalgebra::Vector3::new(0.906, 0.0, 0.423).normalize();
    let model = Model::new(driver(&set)).unwrap();
    let channel = channels(&model).into_iter().find(|c| c.name == "column.column.push").unwrap();
    let names: Vec<&str> = model.setup().surface_names().collect();
    let on_wheel = |surface: usize| names[surface].starts_with("wheel");
    let mut most = 0.0_f64;
    let watch = Watch(|s: &Sample<'_>| {
        let touched = s.contacts().filter(|c| on_wheel(c.surface)).map(|c| c.force_n).sum::<nalgebra::Vector3<f64>>();
        let pulled = (0..s.model.body().spheres.len())
            .map(|i| s.sphere_pull_n(i, Some("bag")).unwrap())
            .sum::<nalgebra::Vector3<f64>>();
        let (push, felt) = (channel.value(s), -axis.dot(&(touched + pulled)));
        assert!((push - felt).abs() < 1e-6 + 1e-9 * push.abs(), "{push} {felt}");
        most = most.max(push);
    });
    simulate(&model, watch).unwrap();
    assert!(most > 2000.0, "{most}");
}

/// The same bits alone and in lanes, from the start and from a checkpoint, with a bag on the column.
#[test]
fn a_column_has_the_same_bits_in_lanes_and_after_a_checkpoint() {
    let steps = ["integrator={ kind = \"rk4\", step = \"0.1 ms\" }", "belts.driver=null", "time.end=0.08"];
    let model = |i: u32| {
        let mass = format!("frames.column.mass={}", 3.0 + 0.5 * f64::from(i));
        let force = format!("frames.column.force[1]=\"{} N\"", 2000 + 300 * i);
        Model::new(driver(&[&steps[..], &[&mass, &force]].concat())).unwrap()
    };
    ends_alike_side_by_side(model);
    for integrator in [steps[0], FINE] {
        let model = Model::new(driver(&[integrator, steps[1], steps[2]])).unwrap();
        let mut all = Vec::new();
        simulate(&model, Watch(|s: &Sample<'_>| all.push(s.checkpoint()))).unwrap();
        let mut last = Last::default();
        resume(&model, &all[60], &mut last).unwrap();
        assert!(last.0.as_ref() == all.last(), "{integrator}");
    }
}
