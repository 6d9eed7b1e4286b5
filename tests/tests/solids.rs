//! Whole runs among solids: energy, the same forces as other descriptions of the same bodies, resuming, runs side by side.

use allocation_counter::measure;
use nalgebra::Point3;
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::{resume, simulate};
use occupant_tests::room::{FINE, ends_alike_side_by_side, room, setup};

const FREE: &str = include_str!("../../scenarios/free-fall.toml");
const SOIL: &str = "materials.soil={ k1 = 50000, mu1 = 0.5, friction = 0 }";
const STEPS: &str = "integrator={ kind = \"rk4\", step = \"0.1 ms\" }";

/// Centres of all spheres at every output, and the outcome.
fn centres(setup: Setup) -> (Vec<Point3<f64>>, Outcome) {
    let model = Model::new(setup).unwrap();
    let mut places = Vec::new();
    let look = |s: &Sample<'_>| places.extend((0..s.model.body().spheres.len()).map(|i| s.sphere_centre_m(i)));
    let outcome = simulate(&model, Watch(look)).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    (places, outcome)
}

/// The greatest distance between the same centres of two runs, which both touch something.
fn apart_m(one: Setup, other: Setup) -> f64 {
    let ((a, touched), (b, _)) = (centres(one), centres(other));
    assert!(!touched.first_touches.is_empty());
    a.iter().zip(&b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

#[test]
fn a_half_space_is_an_unbounded_face() {
    let plane = "surfaces.soil={ material = \"soil\", frame = \"space\", plane = { point = [0, 0, 0.7], normal = [0.1, 0, 1] } }";
    let solid = "solids.soil={ kind = \"half_space\", material = \"soil\", frame = \"space\", point = [0, 0, 0.7], normal = [0.1, 0, 1] }";
    let of = |ground: &str| setup(FREE, &[SOIL, STEPS, ground, "time.end=0.3"]);
    let apart_m = apart_m(of(plane), of(solid));
    assert!(apart_m < 1e-12, "{apart_m}");
}

#[test]
fn two_halves_of_a_box_in_a_group_are_the_box() {
    let slab = |name: &str, from: f64, to: f64| {
        let (middle, length) = (0.5 * (from + to), to - from);
        format!(
            "solids.{name}={{ kind = \"box\", material = \"soil\", frame = \"space\", group = \"slab\", centre = [0, {middle}, 0.6], lengths = [2, {length}, 0.2] }}"
        )
    };
    let (left, right, whole) = (slab("left", -1.0, 0.09), slab("right", 0.09, 1.0), slab("whole", -1.0, 1.0));
    let of = |slabs: &[&str]| {
        setup(FREE, &[&[SOIL, STEPS, "time.end=0.2", "materials.soil.k1=2000000"][..], slabs].concat())
    };
    let apart_m = apart_m(of(&[&left, &right]), of(&[&whole]));
    assert!(apart_m < 1e-12, "{apart_m}");
}

#[test]
fn a_fall_through_a_room_of_solids_keeps_its_energy() {
    let (_, coarse) = centres(room(&[]));
    let (_, fine) = centres(room(&["integrator.step=\"0.05 ms\""]));
    let touched: std::collections::BTreeSet<usize> = coarse.first_touches.iter().map(|touch| touch.surface).collect();
    assert!(touched.len() >= 5, "only {touched:?} were touched");
    let [coarse, fine] = [coarse, fine].map(|outcome| outcome.energy.balance_error.abs());
    assert!(coarse < 1e-5, "{coarse:e}");
    assert!(fine < 1e-6, "{fine:e}");
}

#[test]
fn among_solids_a_run_resumed_from_a_checkpoint_has_the_bits_of_the_whole_run() {
    for set in [&[][..], &[FINE]] {
        let model = Model::new(room(&[set, &["time.end=0.45"]].concat())).unwrap();
        let mut checkpoints: Vec<Checkpoint> = Vec::new();
        let whole = simulate(&model, Watch(|s: &Sample<'_>| checkpoints.push(s.checkpoint()))).unwrap();
        let middle = checkpoints[checkpoints.len() - 8].clone();
        assert!(middle.memory.contacts.iter().any(|pair| pair.phase > 2.0), "no face is remembered there");
        let mut last = None;
        let resumed = resume(&model, &middle, Watch(|s: &Sample<'_>| last = Some(s.checkpoint()))).unwrap();
        assert_eq!(last, checkpoints.pop());
        assert_eq!(resumed.energy.balance_error.to_bits(), whole.energy.balance_error.to_bits());
    }
}

#[test]
fn among_solids_runs_side_by_side_have_the_bits_of_runs_alone() {
    ends_alike_side_by_side(|i| {
        let bench = format!("solids.bench.half_width={}", 0.5 + 0.01 * f64::from(i));
        let speed = format!("initial_state.rates[1]={}", 0.5 + 0.05 * f64::from(i));
        Model::new(room(&[&bench, &speed, "time.end=0.42", "integrator.step=\"0.2 ms\""])).unwrap()
    });
}

#[test]
fn among_solids_twice_as_many_steps_allocate_no_more() {
    let run = |step: &str| {
        let model = Model::new(room(&[step, "time.end=0.4", "output.interval=0.4"])).unwrap();
        measure(|| drop(simulate(&model, ()).unwrap())).count_total
    };
    assert_eq!(run("integrator.step=\"0.4 ms\""), run("integrator.step=\"0.2 ms\""));
}

#[test]
fn a_head_that_comes_over_the_front_seat_is_held_off() {
    let setup = setup(include_str!("../../tests/data/hand/rear-seat-solids.toml"), &["time.end=0.16"]);
    let model = Model::new(setup).unwrap();
    let mut summarizer = Summarizer::new();
    simulate(&model, &mut summarizer).unwrap();
    let summary = summarizer.summary(None).unwrap();
    let head = |of: &str| summary.contacts.iter().any(|c| c.sphere == "head" && c.surface.starts_with(of));
    assert!(head("front_seat"), "{:?}", summary.contacts);
    assert!(summary.caveats.iter().all(|caveat| !caveat.name.starts_with("head")), "{:?}", summary.caveats);
}

#[test]
fn the_summary_names_the_solids_that_were_touched() {
    let model = Model::new(room(&["time.end=0.45"])).unwrap();
    let mut summarizer = Summarizer::new();
    simulate(&model, &mut summarizer).unwrap();
    let summary = summarizer.summary(None).unwrap();
    assert!(!summary.contacts.is_empty() && !summary.sphere_forces.is_empty());
    let is_solid = |name: &str| model.setup().solids.iter().any(|solid| solid.name == name);
    assert!(summary.contacts.iter().all(|contact| is_solid(&contact.surface)));
    assert!(summary.sphere_forces.iter().all(|peak| is_solid(&peak.surface)));
}
