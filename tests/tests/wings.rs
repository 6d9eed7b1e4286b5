//! Lap belts on the iliac wings of a pelvis, and what happens when they slide up from it.

use occupant_core::diagnosis::diagnose;
use occupant_core::model::Model;
use occupant_core::results::channel::{Series, channels};
use occupant_core::results::outcome::Status;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::{assert_below, assert_within};
use occupant_tests::room::{PULLED, ends_alike_side_by_side, setup};

/// A pelvis that is held, a lap belt at a constant tension whose ends pull straight back, at an angle below the level.
const HELD: &str = r#"
title = "a lap belt on a pelvis that is held"
gravity = 0
time = { end = "120 ms" }
output = { interval = "0.5 ms" }
path = { kind = "fixed" }
contact = { bodies = [] }
mount = { segment = "lower_torso", frame = "space", point = [0, 0, 0], place = [0, 0, 0] }
body = { preset = "male50", abdomen = "person" }
joints = { preset = "gebod" }

[belts.lap]
webbing = "strap"
nodes = [
  { name = "reel", at = [-0.5, -0.1, 0], retractor = "reel" },
  { name = "left", wing = "left" },
  { name = "right", wing = "right" },
  { name = "sill", at = [-0.5, 0.1, 0] },
]
"#;

/// Where the webbing begins, in radii of the pelvis ahead of and above its middle; angle of the wing's normal there; friction across it.
const PLACE: f64 = 0.68;
const NORMAL_RAD: f64 = -0.09;
const ACROSS: f64 = 0.25;

/// The case with anchors so far below the level as seen from the wings.
fn held(below_rad: f64, more: &[&str]) -> Model {
    Model::new(setup(&held_text(below_rad), more)).unwrap_or_else(|problems| panic!("{problems}"))
}

fn held_text(below_rad: f64) -> String {
    let body = setup(&[HELD, PULLED].concat(), &[]).body;
    let sphere = &body.spheres[body.sphere("pelvis").unwrap()];
    let (c, r) = (sphere.centre_from_lower_end_m, sphere.radius_m);
    let anchor = |side: f64| {
        let x = c.x + r * PLACE - 0.6 * below_rad.cos();
        let z = c.z + r * PLACE - 0.6 * below_rad.sin();
        format!("[{x}, {}, {}]", -side * 0.95 * r, -z)
    };
    [HELD, PULLED].concat().replace("[-0.5, -0.1, 0]", &anchor(1.0)).replace("[-0.5, 0.1, 0]", &anchor(-1.0))
}

const CHANNELS: [&str; 6] = [
    "strap.lap.left_right.pelvis_angle",
    "strap.lap.left_right.bone_force",
    "strap.lap.right_sill.bone_force",
    "strap.lap.left_right.force",
    "plate.abdomen.deflection",
    "energy.balance",
];

/// Those channels, the names of caveats on belt, pelvis and chest, and the events' words.
fn traced(model: &Model) -> (Vec<Vec<f64>>, Vec<String>, Vec<String>) {
    let known = channels(model);
    let find = |name: &&str| known.iter().find(|c| c.name == **name).cloned();
    let missing: Vec<&&str> = CHANNELS.iter().filter(|name| find(name).is_none()).collect();
    let names: Vec<&String> = known.iter().map(|c| &c.name).filter(|name| name.contains("lap")).collect();
    assert!(missing.is_empty(), "{missing:?} among {names:?}");
    let mut watch = (Series::new(CHANNELS.iter().filter_map(find).collect()), Summarizer::new());
    let outcome = simulate(model, &mut watch).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    let summary = watch.1.summary(None).unwrap();
    let events = summary.events.iter().map(|event| format!("{event:?}")).collect();
    let spoils = ["straps.lap_left_right.peak", "pelvis.peak", "chest.peak"];
    let whole = summary.caveats.iter().filter(|caveat| spoils.iter().all(|figure| caveat.touches(figure)));
    (watch.0.values, whole.map(|caveat| caveat.name.clone()).collect(), events)
}

/// A belt rests where the tangent of its angle against the bone is below the friction, and slides off where it is above.
#[test]
fn a_belt_slides_off_a_wing_beyond_the_cone_of_friction() {
    // the belt turns inwards at a wing, which presses it on the bone too: F·t/N of a pull at `below`
    let across = |below: f64| {
        let off: f64 = NORMAL_RAD - below;
        off.sin() / (off.cos().powi(2) + 1.0).sqrt()
    };
    for (below, slides) in [(-0.41, false), (-0.46, true)] {
        assert_eq!(across(below) > ACROSS, slides);
        let (values, caveats, events) = traced(&held(below, &["time.end=0.4"]));
        assert_below("angle at the start, rad", (values[0][0] - across(below).atan()).abs(), 2e-3);
        let last = values[1].last().copied().unwrap();
        let told = events.iter().filter(|event| event.contains("iliac wing")).count();
        assert_eq!((last == 0.0, told), (slides, 2 * usize::from(slides)), "{below}: {last} N, {events:?}");
        assert_eq!(caveats.iter().any(|name| name == "submarining_left"), slides, "{caveats:?}");
        assert_eq!(caveats.iter().any(|name| name == "submarining_right"), slides, "{caveats:?}");
    }
}

/// Webbing that pulls a pelvis ahead lifts off its wings, unless it pulls as lightly as a belt that tightens in rebound.
#[test]
fn a_light_pull_lifts_no_webbing_off_a_wing() {
    for (tension, lifts) in [("400 N", false), ("2 kN", true)] {
        let (.., events) = traced(&held(std::f64::consts::PI, &[&format!("retractors.reel.spool_tension={tension}")]));
        let told = events.iter().filter(|event| event.contains("iliac wing")).count();
        assert_eq!(told, 2 * usize::from(lifts), "{tension}: {events:?}");
    }
}

/// Both wings of a belt that lies evenly let go at one time, the tension stays, the abdomen is pressed in, and no energy is lost from sight.
#[test]
fn what_slides_off_a_wing_presses_the_abdomen() {
    let (values, ..) = traced(&held(-0.63, &[]));
    let gone = |force: &[f64]| force.iter().position(|force| *force == 0.0).unwrap_or(usize::MAX);
    let [left, right] = [gone(&values[1]), gone(&values[2])];
    assert_eq!(left, right);
    // 40 mm, at speeds from 4 to 12 m/s: the pull less friction, over the drag
    assert_within("time, half ms", left as f64, [13.0, 17.0]);
    let tension = |i: usize| values[3][i];
    assert_below("tension, N", (tension(left) / tension(left - 1) - 1.0).abs(), 1e-6);
    let deepest = values[4].iter().fold(0.0, |most: f64, s| most.max(*s));
    assert!(values[4][left - 1].abs() < 1e-3 && deepest > 0.03, "{deepest}");
    let balance = values[5].iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert_below("balance, J", balance, 1e-2);
}

/// A belt that pulls slowly presses the flesh before the pelvis with its own force once: as deep
/// as the curve of the flesh says.
#[test]
fn flesh_before_the_pelvis_bears_the_belt_once() {
    let below = -0.41_f64;
    let depth_m = |force: f64| match force {
        _ if force < 1200.0 => force / 60e3,
        _ => 0.02 + (force - 1200.0) / (5000.0 / 0.015),
    };
    for tension in [500.0, 2000.0] {
        let reel = format!("retractors.reel.spool_tension={tension}");
        // so much damping that it never goes back
        let damper = "body.plates.flesh.damper={ linear = 5000 }";
        let model = held(below, &["body.pelvis=flesh", &reel, damper, "time.end=0.6"]);
        let known = channels(&model);
        let find = |name: &str| known.iter().find(|c| c.name == name).cloned().unwrap();
        let names = ["plate.flesh.deflection", "plate.flesh.force", "strap.lap.left_right.force"];
        let mut watch = Series::new(names.map(find).to_vec());
        simulate(&model, &mut watch).unwrap();
        let [depth, force, pull] = [0, 1, 2].map(|i| *watch.values[i].last().unwrap());
        let asked = 2.0 * pull * below.cos();
        assert_below("force on the flesh", (force / asked - 1.0).abs(), 0.03);
        assert_below("depth of the flesh, m", (depth - depth_m(force)).abs(), 1e-4);
        assert_within("tension, N", pull, [0.95 * tension, 1.05 * tension]);
    }
}

/// An abdomen that is pressed in farther than its force is known says so.
#[test]
fn an_abdomen_beyond_its_data_is_told_of() {
    let told = |more: &[&str]| {
        let mut summarizer = Summarizer::new();
        simulate(&held(-0.63, more), &mut summarizer).unwrap();
        let caveats = summarizer.summary(None).unwrap().caveats;
        caveats
            .iter()
            .filter(|caveat| caveat.touches("plates.abdomen.peak"))
            .map(|caveat| caveat.text.clone())
            .collect()
    };
    let known: Vec<String> = told(&[]);
    assert!(known.iter().all(|text| !text.contains("its force ends")), "{known:?}");
    let short = told(&["body.plates.abdomen.spring={ depth = [0, 0.02], force = [0, 600] }"]);
    assert!(short.iter().any(|text| text.contains("beyond 20 mm, where its force ends")), "{short:?}");
}

/// Side by side and alone, with belts that slide off at other times.
#[test]
fn wings_end_alike_side_by_side() {
    ends_alike_side_by_side(|i| held(0.05 * f64::from(i) - 0.73, &[]));
}

/// A loop round the sphere of a pelvis cannot slide off it: a pull that would draw it up over the wings is told of, before the run and after it.
#[test]
fn a_loop_that_would_slide_off_the_wings_is_told_of() {
    for (below, slides) in [(-0.23, false), (-0.63, true)] {
        let text = held_text(below);
        let nodes = r#"  { name = "left", wing = "left" },
  { name = "right", wing = "right" },
"#;
        assert!(text.contains(nodes));
        let model = Model::new(setup(&text.replace(nodes, "  { sphere = \"pelvis\" },\n"), &[])).unwrap();
        let warned = diagnose(&model).lap_belts;
        assert_eq!(warned.len(), usize::from(slides), "{warned:?}");
        let mut summarizer = Summarizer::new();
        simulate(&model, &mut summarizer).unwrap();
        let caveats = summarizer.summary(None).unwrap().caveats;
        let told = caveats.iter().find(|caveat| caveat.name == "submarining_pelvis");
        assert_eq!(told.is_some(), slides, "{below}");
        let spoils = ["straps.lap_reel_sill.peak", "pelvis.peak", "chest.peak"];
        assert!(told.is_none_or(|told| spoils.iter().all(|figure| told.touches(figure))));
    }
    let warned = [-0.41, -0.46].map(|below| diagnose(&held(below, &[])).lap_belts.len());
    assert_eq!(warned, [0, 1], "wings");
}

/// Webbing cannot leave plain points of a pelvis: that is said before the run, once for a belt, with the way out.
#[test]
fn a_lap_belt_over_plain_points_of_the_pelvis_is_told_of() {
    let said = |text: &str| {
        let model = Model::new(setup(text, &[])).unwrap_or_else(|problems| panic!("{problems}"));
        let said = model.warnings().to_string();
        (said.matches("submarining cannot be seen").count(), said, diagnose(&model).lap_belts.len())
    };
    let plain = |below: f64| {
        let text = held_text(below);
        let wings = ["wing = \"left\"", "wing = \"right\""];
        let points = ["on = \"lower_torso\", at = [0.1, 0.09, 0.06]", "on = \"lower_torso\", at = [0.1, -0.09, 0.06]"];
        (0..2).fold(text, |text, i| text.replace(wings[i], points[i]))
    };
    let (count, words, slides) = said(&plain(-0.23));
    assert_eq!((count, slides), (1, 0), "{words}");
    assert!(words.contains("a lap belt over `left`") && words.contains("wing = \"left\""), "{words}");
    // in tables of many runs too
    let unseen = |text: &str| {
        let mut summarizer = Summarizer::new();
        simulate(&Model::new(setup(text, &[])).unwrap(), &mut summarizer).unwrap();
        summarizer.summary(None).unwrap().caveats.iter().any(|caveat| caveat.name == "lap_submarining_unseen")
    };
    assert!(unseen(&plain(-0.23)) && !unseen(&held_text(-0.23)));
    // one that pulls up is told of as one round the pelvis is
    assert_eq!(said(&plain(-0.63)).2, 1);
    // on wings it can be seen, and a belt over the chest is none
    assert_eq!(said(&held_text(-0.23)).0, 0);
    let chest = plain(-0.23).replace("on = \"lower_torso\"", "on = \"upper_torso\"");
    assert_eq!(said(&chest).0, 0);
}

/// What makes no sense is refused with its place.
#[test]
fn wings_that_make_no_sense_are_refused() {
    let refused = |old: &str, new: &str, words: &str| {
        let text = match std::panic::catch_unwind(|| setup(&[HELD, PULLED].concat().replace(old, new), &[])) {
            Ok(setup) => match Model::new(setup) {
                Ok(_) => "nothing was refused".to_owned(),
                Err(problems) => problems.to_string(),
            },
            Err(problem) => problem.downcast_ref::<String>().cloned().unwrap_or_default(),
        };
        assert!(text.contains(words), "{text}");
    };
    let left = r#"wing = "left""#;
    let then =
        |on: &str, ride: &str| format!("{left}, then = {{ on = \"{on}\", at = [0, 0, 0], ride = {{ {ride} }} }}");
    refused(left, &then("belly", ""), "belly");
    refused(left, &then("middle_torso", "abdomen = 2"), "from 0 to 1");
    refused(left, &then("head", "abdomen = 1"), "another segment");
    refused(left, &then("head", "").replace(left, "on = \"head\", at = [0, 0, 0]"), "without a track");
    refused(left, r#"wing = "left", sphere = "pelvis""#, "wing");
    refused(r#"at = [-0.5, -0.1, 0], retractor = "reel""#, left, "an end");
}
