//! Throws and ejection: landings are touches of the ground, distances are those of the centre of gravity, and what leaves a
//! compartment is told.

use nalgebra::Vector3;
use occupant_core::model::Model;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::{Degree, Side, Summarizer, Summary, ThrowStart};
use occupant_core::run::simulate::simulate;
use occupant_tests::room::setup;

const PEDESTRIAN: &str = include_str!("../../scenarios/pedestrian.toml");
const RIDER: &str = include_str!("../../scenarios/thrown-rider.toml");
const ROLLOVER: &str = include_str!("../data/roads/rollover-ejection.toml");
const BELTED: &str = include_str!("../../tests/data/hand/three-point.toml");

/// What is seen of a run from outside: at each output the time, the centre of gravity, and the names of what touches the body.
type Seen = Vec<(f64, Vector3<f64>, Vec<String>)>;

fn seen(text: &str, set: &[&str]) -> (Summary, Seen) {
    let model = Model::new(setup(text, set)).unwrap();
    let (mut summarizer, mut seen) = (Summarizer::new(), Seen::new());
    let names: Vec<String> = model.setup().surface_names().map(str::to_owned).collect();
    let watch = Watch(|s: &Sample<'_>| {
        let touched = s.contacts().map(|contact| names[contact.surface].clone()).collect();
        seen.push((s.time_s, s.centre_of_body(0).0, touched));
    });
    simulate(&model, (&mut summarizer, watch)).unwrap();
    (summarizer.summary(None).unwrap(), seen)
}

/// First touch of the ground after the start, at the end of a step.
fn first_on_the_ground(summary: &Summary) -> f64 {
    let ground = summary.contacts.iter().filter(|contact| contact.surface == "ground" && !contact.at_start);
    ground.map(|contact| contact.time_s).fold(f64::INFINITY, f64::min)
}

fn place_at(seen: &Seen, time_s: f64) -> Vector3<f64> {
    let at = seen.partition_point(|(t, ..)| *t < time_s);
    seen[at.min(seen.len() - 1)].1
}

fn apart_m(a: Vector3<f64>, b: Vector3<f64>) -> f64 {
    (a - b).xy().norm()
}

#[test]
fn a_pedestrian_lands_on_the_ground_and_not_on_himself() {
    let (summary, seen) = seen(PEDESTRIAN, &[]);
    let throw = &summary.throws["walker"];
    let (landing, launch) = (throw.landing.as_ref().unwrap(), throw.launch.as_ref().unwrap());
    // 1197.8 ms
    assert_eq!((throw.from, landing.time_s), (ThrowStart::Struck, first_on_the_ground(&summary)));
    // his hand is on his head at 574 ms
    assert!((1.19..1.21).contains(&landing.time_s), "{throw:?}");
    // the car touches him last just before the launch
    let on_car = |touched: &[String]| {
        touched.iter().any(|name| ["bumper", "edge", "bonnet", "windscreen", "roof"].contains(&name.as_str()))
    };
    let last_s = seen
        .iter()
        .filter(|(t, _, touched)| *t < landing.time_s && on_car(touched))
        .map(|(t, ..)| *t)
        .fold(0.0, f64::max);
    assert!((launch.time_s - last_s - 2e-3).abs() < 1e-9, "{last_s} {launch:?}");
    // distances of the centre of gravity, to the 2 ms of outputs at 10 m/s
    let [start, land, end] = [throw.struck_s, landing.time_s, summary.reached_s].map(|t| place_at(&seen, t));
    assert!((landing.distance_m - apart_m(land, start)).abs() < 0.03, "{landing:?}");
    assert!((throw.distance_m - apart_m(end, start)).abs() < 0.03 && throw.at_rest, "{throw:?}");
    // on one line, or nearly
    let parts = launch.distance_m + throw.airborne_m.unwrap() + throw.slide_m.unwrap();
    assert!(parts >= throw.distance_m && parts < 1.05 * throw.distance_m, "{parts} {throw:?}");
    let searle = throw.searle.unwrap();
    assert_eq!(searle.friction, 0.7);
    let gone_m = throw.from_launch_m.unwrap();
    assert!(searle.distances_m[0] < gone_m && gone_m < searle.distances_m[1], "{gone_m} {searle:?}");
}

#[test]
fn a_rider_is_thrown_from_his_machine_and_not_from_where_he_lands() {
    let (summary, seen) = seen(RIDER, &[]);
    let throw = &summary.throws["rider"];
    let (landing, launch) = (throw.landing.as_ref().unwrap(), throw.launch.as_ref().unwrap());
    assert_eq!((throw.from, landing.time_s), (ThrowStart::Blow, first_on_the_ground(&summary)));
    assert!((0.93..0.95).contains(&landing.time_s), "{landing:?}");
    // the machine touches him last at 134 ms; his own hands touch each other at 540 ms
    let on_machine = |touched: &[String]| {
        touched.iter().any(|name| ["saddle", "hump", "tank", "tank_top", "pegs"].contains(&name.as_str()))
    };
    let last_s = seen.iter().filter(|(_, _, touched)| on_machine(touched)).map(|(t, ..)| *t).fold(0.0, f64::max);
    assert!((launch.time_s - last_s - 2e-3).abs() < 1e-9, "{last_s} {launch:?}");
    let [start, left, end] = [throw.struck_s, launch.time_s, summary.reached_s].map(|t| place_at(&seen, t));
    assert!((throw.distance_m - apart_m(end, start)).abs() < 0.03, "{throw:?}");
    assert!((throw.from_launch_m.unwrap() - apart_m(end, left)).abs() < 0.03, "{throw:?}");
    // he rolls: farther than one who slides
    let drag = throw.searle.unwrap().drag_factor.unwrap();
    assert!((0.3..0.7).contains(&drag), "{drag}");
    let ejection = &summary.ejections["rider"];
    assert_eq!((ejection.degree, ejection.inside.len()), (Degree::Complete, 0));
    assert!(ejection.parts.iter().all(|exit| exit.side == Side::Ahead));
}

#[test]
fn a_throw_that_has_not_come_to_rest_says_so_on_its_distances() {
    let (summary, _) = seen(PEDESTRIAN, &["time.end=\"1.5 s\""]);
    assert!(!summary.throws["walker"].at_rest && summary.throws["walker"].searle.is_none());
    let caveat = summary.caveats.iter().find(|caveat| caveat.name == "not_at_rest").unwrap();
    assert!(caveat.touches("walker.throw.distance") && !caveat.touches("walker.hic15"), "{caveat:?}");
}

#[test]
fn a_driver_who_goes_out_of_a_window_has_a_verdict_with_places_and_times() {
    let (summary, _) = seen(ROLLOVER, &[]);
    let ejection = &summary.ejections["driver"];
    // his right forearm ends across the sill
    assert_eq!((ejection.degree, &ejection.inside[..]), (Degree::Partial, &["driver.right_hand".to_owned()][..]));
    let exit = |part: &str| ejection.parts.iter().find(|exit| exit.part == part).unwrap();
    let (pelvis, head) = (exit("driver.pelvis"), exit("driver.head"));
    // over the sill pelvis first, at about 1.8 s
    assert!(pelvis.time_s > 1.6 && pelvis.time_s < 2.0 && head.time_s > pelvis.time_s, "{ejection:?}");
    assert_eq!((pelvis.side, pelvis.past.as_deref()), (Side::Left, Some("left_side")));
    // the outside of the left side is at 34.5 in to the left
    assert!(pelvis.place_m[1] < -34.5 * 0.0254, "{pelvis:?}");
}

/// What he goes past stands on that side: the steering wheel's hub does not, though the ball about it comes near.
#[test]
fn who_goes_out_of_a_window_goes_past_what_is_on_that_side() {
    let shipped = include_str!("../../scenarios/rollover-ejection.toml");
    let (summary, _) = seen(shipped, &["time.end=1.8", "output.interval=\"10 ms\""]);
    let ejection = summary.ejections.values().next().expect("an ejection");
    assert!(ejection.parts.iter().any(|exit| exit.part == "head"), "{ejection:?}");
    for exit in &ejection.parts {
        let past = exit.past.as_deref().unwrap_or_default();
        let side = if exit.side == Side::Above { "roof" } else { "left_" };
        assert!(matches!(exit.side, Side::Left | Side::Above) && past.starts_with(side), "{exit:?}");
    }
}

#[test]
fn a_head_that_flies_out_of_what_is_modelled_is_marked_and_one_in_a_belt_is_not() {
    let named = |summary: &Summary, name: &str| summary.caveats.iter().find(|caveat| caveat.name == name).cloned();
    let (unbelted, _) = seen(BELTED, &["belts.driver=null"]);
    let left = named(&unbelted, "head_left_compartment").expect("a caveat");
    assert!(
        left.touches("hic15") && left.touches("head_excursion.forward") && !left.touches("pelvis.peak"),
        "{left:?}"
    );
    assert!(left.text.contains(" ahead at "), "{left:?}");
    let cut = named(&unbelted, "window_at_end").expect("a caveat");
    assert!(cut.touches("hic15") && cut.touches("hic36"), "{cut:?}");
    let (belted, _) = seen(BELTED, &[]);
    assert!(named(&belted, "head_left_compartment").is_none() && named(&belted, "window_at_end").is_none());
    assert!(belted.ejections.is_empty());
}
