//! Belts whose upper anchor a back of a seat carries: the webbing turns the back. Belts that pass behind a chest.

use occupant_core::model::Model;
use occupant_core::results::channel::{Channel, Series, channels};
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::{resume, simulate};
use occupant_tests::measure::assert_below;
use occupant_tests::room::{FINE, Last, PULLED, ends_alike_side_by_side, setup};

/// A mass that floats behind a back in a car that is struck from behind with 100 m/s², and webbing from 0.6 m above the hinge to it.
const SPACE: &str = r#"
title = "webbing on a back"
gravity = 0
time = { end = "60 ms" }
output = { interval = "0.5 ms" }
integrator = { kind = "rk4", step = "10 us" }
path = { kind = "pulse", shape = "square", speed = "10 m/s", direction = [-1, 0, 0], delta_v = "10 m/s", duration = "100 ms" }
contact = { bodies = [] }
mount = { segment = "trunk", point = [0, 0, 0.2], place = [-0.3, 0, -0.3], let_go = [0, 0, 0] }

[body]
segments.trunk = { length = 0.4, cg_from_lower_end = 0.2, mass = 20, inertia = [2, 2, 2] }
segments.cap = { length = 0.1, cg_from_lower_end = 0, mass = 1e-6, inertia = [1e-9, 1e-9, 1e-9] }
joints.top = { proximal = "trunk", distal = "cap", kind = "fixed", on_proximal = [0, 0, 0.2], on_distal = [0, 0, 0] }
spheres.front = { segment = "trunk", centre = [0, 0, 0.2], radius = 0.1 }

[joints.top]

[frames.back]
kind = "hinge"
axis = [0, 2, 0]
origin = [0.2, 0, 0.3]
mass = 15
centre = [0.2, 0, -0.1]
inertia = 0.6
angle = [0, "0.02 rad", "1.5 rad"]
moment = ["0 N m", "1200 N m", "1200 N m"]

[webbings.w]
strain = [0, 1]
force = [0, "60 kN"]
returned = 1

[belts.b]
webbing = "w"
nodes = [{ name = "ring", at = [0.2, 0, -0.3], frame = "back" }, { name = "chest", on = "trunk", at = [0, 0, 0.2] }]
"#;

const NAMES: [&str; 3] = ["hinge.back.angle", "strap.b.ring_chest.force", "sphere.front.position.x"];

fn model(set: &[&str]) -> Model {
    Model::new(setup(SPACE, set)).unwrap_or_else(|problems| panic!("{set:?}: {problems}"))
}

fn traced(set: &[&str], names: &[&str]) -> (Vec<Vec<f64>>, Outcome) {
    let model = model(set);
    let known = channels(&model);
    let wanted = |name: &&str| {
        let found = known.iter().find(|c: &&Channel| c.name == **name).cloned();
        found.unwrap_or_else(|| panic!("no {name} among {:?}", known.iter().map(|c| &c.name).collect::<Vec<_>>()))
    };
    let mut series = Series::new(names.iter().map(wanted).collect());
    let outcome = simulate(&model, &mut series).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    (series.values, outcome)
}

/// By hand, in the axes of the car: angle and speed of the back, place and speed of the mass; angle, force and place ahead at each 0.5 ms.
fn by_hand() -> Vec<[f64; 3]> {
    let (push, inertia, stiffness, yields, h) = (100.0, 15.0 * 0.16 + 0.6, 60e3, 1200.0, 2e-6);
    let (mut angle, mut rate, mut place, mut speed) = (0.0_f64, 0.0, [-0.3, -0.3], [0.0; 2]);
    let (mut set, mut rows) = (0.0_f64, Vec::new());
    for i in 0..=30_000 {
        let arm = [-0.6 * angle.sin(), -0.6 * angle.cos()];
        let way = [place[0] - 0.2 - arm[0], place[1] - 0.3 - arm[1]];
        let length = way[0].hypot(way[1]);
        let tension = (60e3 * (length / 0.5 - 1.0)).max(0.0);
        let pull = way.map(|along| tension * along / length);
        if i % 250 == 0 {
            rows.push([angle, tension, place[0]]);
        }
        set = set.max(angle - yields / stiffness);
        let held = stiffness * (angle - set);
        // about y, which points right of x ahead and z down
        let moment = arm[1] * pull[0] - arm[0] * pull[1] + 15.0 * push * 0.4 * angle.cos();
        rate += h * (moment - held) / inertia;
        angle += h * rate;
        for k in 0..2 {
            speed[k] -= h * (pull[k] / 20.0 + if k == 0 { push } else { 0.0 });
            place[k] += h * speed[k];
        }
    }
    rows
}

/// Before the moment of the back yields and after, when webbing and weight hold it in balance.
#[test]
fn webbing_turns_the_back_as_computed_by_hand() {
    let (values, outcome) = traced(&[], &NAMES);
    let hand = by_hand();
    assert!(hand.iter().any(|row| row[0] > 0.1) && hand.iter().any(|row| row[1] > 1000.0), "{hand:?}");
    let worst = |k: usize| values[k].iter().zip(&hand).map(|(own, row)| (own - row[k]).abs()).fold(0.0, f64::max);
    assert_eq!(values[0].len(), hand.len());
    assert_below("angle, rad", worst(0), 2e-5);
    assert_below("force, N", worst(1), 5.0);
    assert_below("place, m", worst(2), 2e-5);
    assert_below("energy balance", outcome.energy.balance_error, 1e-6);
    let mut summarizer = Summarizer::new();
    let model = model(&[]);
    simulate(&model, &mut summarizer).unwrap();
    let figures = summarizer.summary(None).unwrap().figures(&model);
    let book = figures.iter().find(|f| f.name == "hinges.back.book_error").and_then(|f| f.value).unwrap();
    assert_below("book of the hinge", book, 1e-5);
}

/// On a back that cannot lean it is an anchor of the car.
#[test]
fn a_back_that_does_not_give_is_the_car() {
    let stiff = traced(&["frames.back.moment=[0, \"40 MN m\", \"40 MN m\"]"], &NAMES[1..]).0;
    let fixed = traced(&["belts.b.nodes[0].frame=null"], &NAMES[1..]).0;
    let off = |k: usize| stiff[k].iter().zip(&fixed[k]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert_below("force, N", off(0), 5.0);
    assert_below("place, m", off(1), 1e-5);
    assert!(fixed[0].iter().any(|force| *force > 1000.0));
}

#[test]
fn it_has_the_same_bits_in_lanes_and_after_a_checkpoint() {
    ends_alike_side_by_side(|i| {
        model(&[&format!("frames.back.mass={}", 12.0 + f64::from(i)), "integrator.step=50 us"])
    });
    for integrator in ["integrator.step=50 us", FINE] {
        let model = model(&[integrator]);
        let mut all = Vec::new();
        simulate(&model, Watch(|s: &Sample<'_>| all.push(s.checkpoint()))).unwrap();
        for from in [0, 30, 77] {
            let mut last = Last::default();
            resume(&model, &all[from], &mut last).unwrap();
            assert!(last.0.as_ref() == all.last(), "{integrator}");
        }
    }
}

/// Pulled in by a pretensioner, and carried by a back of another vehicle's axes: books close.
#[test]
fn books_close_with_a_pretensioner_on_the_back() {
    let more = "[triggers.t]\nkind = \"time\"\nat = \"2 ms\"\n";
    let ring = "belts.b.nodes[0]={ name = \"ring\", at = [0.2, 0, -0.3], frame = \"back\", pretensioner = { trigger = \"t\", times = [0, \"8 ms\"], \
                pull = [0, \"50 mm\"], direction = [1, 0, 0], stall_force = \"9 kN\" } }";
    let model = Model::new(setup(&format!("{SPACE}{more}"), &[ring])).unwrap_or_else(|problems| panic!("{problems}"));
    let outcome = simulate(&model, &mut Last::default()).unwrap();
    assert_below("energy balance", outcome.energy.balance_error, 1e-5);
}

/// A driver who lies back at 40 degrees, 50 km/h into a stop, with a belt on the seat.
const RECLINED: &str = r#"
title = "a belt on a seat"
time = { end = "120 ms" }
path = { kind = "pulse", shape = "half_sine", speed = "50 km/h", delta_v = "50 km/h", duration = "100 ms" }

[car.seats.driver]
belt = "seat"
recline = 40
"#;

#[test]
fn a_reclined_driver_pulls_the_back_ahead_with_a_belt_on_the_seat() {
    let lean = |set: &[&str]| {
        let model = Model::new(setup(RECLINED, set)).unwrap_or_else(|problems| panic!("{set:?}: {problems}"));
        let channel = channels(&model).into_iter().find(|c: &Channel| c.name == "hinge.driver_recliner.angle").unwrap();
        let mut series = Series::new(vec![channel]);
        let outcome = simulate(&model, &mut series).unwrap();
        assert_eq!(outcome.status, Status::Completed);
        assert_below("energy balance", outcome.energy.balance_error, 1e-3);
        series.values[0].iter().fold(0.0_f64, |least, angle| least.min(*angle))
    };
    let (usual, pillar) =
        (lean(&[]), lean(&["car.seats.driver.belt=three_point", "car.seats.driver.back_moment=3.75 kN m"]));
    // ahead is negative: the limiter's force at 0.6 m, and weight, on the spring of the recliner
    assert!((-0.3..-0.01).contains(&usual) && usual < 1.5 * pillar, "{usual} {pillar}");
}

#[test]
fn backs_yield_by_their_years() {
    let moments = |set: &[&str]| {
        let setup = setup(RECLINED, &[&["car.seats.driver.belt=three_point"], set].concat());
        let hinges = setup.columns.iter().filter(|column| column.hinge.is_some());
        hinges.map(|column| column.force.points[1][1]).collect::<Vec<_>>()
    };
    for (years, expected) in [("1970s", 850.0), ("1990s", 1100.0), ("2000s", 1700.0)] {
        let years = format!("car.years={years}");
        assert_eq!(moments(&[&years]), [expected]);
        assert_eq!(moments(&[&years, "car.seats.driver.back_moment=2 kN m"]), [2000.0]);
    }
    assert!(moments(&[]).is_empty());
    assert_eq!(moments(&["car.seats.driver.belt=seat"]), [3750.0]);
}

#[test]
fn frames_of_no_vehicle_carry_no_webbing() {
    for (set, expected) in [
        ("belts.b.nodes[0].frame=space", "no part of a vehicle"),
        ("belts.b.nodes[0].frame=seat", "seat"),
        ("belts.b.nodes[1].frame=back", "`frame` in a node of the body"),
    ] {
        let mut draft = occupant_scenario::Draft::read(SPACE, occupant_scenario::Format::Toml, "test").unwrap();
        draft.set(set).unwrap();
        let said = draft.load(&|name: &str| Err(format!("no file {name}"))).and_then(|loaded| loaded.build());
        let said = said.err().map(|problems| problems.to_string()).unwrap_or_else(|| panic!("{set} is accepted"));
        assert!(said.contains(expected), "{set}: {said}");
    }
}

/// A chest that is held, and webbing at a constant tension in a car that goes ahead by 0.4 m: the line between its ends passes the
/// middle of the chest's sphere at 3 mm, and the plane of the webbing turns by half a turn.
const PASSES: &str = r#"
title = "webbing whose ends pass a chest"
gravity = 0
time = { end = "200 ms" }
output = { interval = "10 ms" }
path = { kind = "pulse", shape = "square", speed = "2 m/s", delta_v = "1e-9 m/s", duration = "0.2 s" }
contact = { bodies = [] }
mount = { segment = "upper_torso", frame = "space", point = [0, 0, 0], place = [0, 0, 0] }
body = { preset = "male50" }
joints = { preset = "gebod" }

[belts.torso]
webbing = "strap"
nodes = [
  { name = "reel", at = [-0.2, 0.003, -0.6], retractor = "reel" },
  { sphere = "chest" },
  { name = "sill", at = [-0.2, 0.003, 0.2] },
]
"#;

#[test]
fn webbing_that_passes_behind_a_chest_says_so() {
    for (end_ms, is_behind) in [(80, false), (200, true)] {
        let model = Model::new(setup(&[PASSES, PULLED].concat(), &[&format!("time.end=\"{end_ms} ms\"")])).unwrap();
        let mut summarizer = Summarizer::new();
        simulate(&model, &mut summarizer).unwrap();
        let caveats = summarizer.summary(None).unwrap().caveats;
        let told = caveats.iter().find(|caveat| caveat.name == "torso_behind");
        assert_eq!(told.is_some(), is_behind, "{end_ms} ms: {caveats:?}");
        let spoils = ["straps.torso_reel_sill.peak", "chest.peak"];
        assert!(spoils.iter().all(|figure| told.is_none_or(|told| told.touches(figure))));
    }
}
