//! Bodies whose segments are as heavy as tables of people disagree.

use occupant_core::body::{Body, SegmentProperties};

use super::super::{Study, Value};
use super::{complaint, numbers, study};

const SAMPLED: &str = "seed = 3
    design = { kind = \"latin_hypercube\", samples = 40 }
    parameters = [{ segments = \"15 %\" }]";

fn named<'b>(body: &'b Body, segment: &str) -> &'b SegmentProperties {
    let at = body.tree.segments().find(|s| body.tree[*s].name == segment).unwrap();
    body.segment(at)
}

/// Mass, I_x and I_z of a segment of the body that a run has.
fn heavy(study: &Study, index: u64, segment: &str) -> [f64; 3] {
    let setup = study.draft(index).unwrap().load(&super::no_files).unwrap().build().unwrap().0;
    let found = named(&setup.body, segment);
    [found.mass_kg, found.inertia_kg_m2.x, found.inertia_kg_m2.z]
}

#[test]
fn each_segment_is_a_parameter_and_left_and_right_are_one() {
    let study = study(SAMPLED);
    let names: Vec<&str> = study.parameters.iter().map(|p| p.name.as_str()).collect();
    let limbs = ["upper_arm", "forearm", "thigh", "lower_leg"];
    let trunk = ["middle_torso", "upper_torso", "head", "lower_torso"];
    assert_eq!(names, [trunk, limbs].concat().iter().map(|name| format!("segments.{name}")).collect::<Vec<_>>());
    let nominal = super::base().load(&super::no_files).unwrap().build().unwrap().0.body;
    for index in 0..3 {
        for (name, factor) in trunk.iter().chain(&limbs).zip(numbers(&study, index)) {
            assert!((0.85..=1.15).contains(&factor), "{name}: {factor}");
            let sides = if trunk.contains(name) { vec![String::new()] } else { vec!["left_".into(), "right_".into()] };
            for segment in sides.iter().map(|side| format!("{side}{name}")) {
                let was = named(&nominal, &segment);
                let base = [was.mass_kg, was.inertia_kg_m2.x, was.inertia_kg_m2.z];
                for (found, base) in heavy(&study, index, &segment).iter().zip(base) {
                    assert!((found / base / factor - 1.0).abs() < 1e-14, "{segment}");
                }
            }
        }
    }
    // evenly spread over ±15 %: a Latin hypercube has one sample in each fortieth
    for parameter in 0..names.len() {
        let mut all: Vec<f64> = (0..40).map(|index| numbers(&study, index)[parameter]).collect();
        all.sort_by(f64::total_cmp);
        assert!((0..40).all(|i| (0.0..=1.0).contains(&((all[i] - 0.85) / 0.3 * 40.0 - i as f64))), "{all:?}");
    }
}

#[test]
fn members_of_an_ensemble_have_other_segments_of_the_same_shape() {
    let study = study("ensemble = { members = 5, segments = \"15 %\" }");
    let nominal = heavy(&study, 0, "left_thigh");
    for index in 1..5 {
        let found = heavy(&study, index, "left_thigh");
        let factor = found[0] / nominal[0];
        assert!(factor != 1.0 && (factor - 1.0).abs() <= 0.15, "{factor}");
        assert!((1..3).all(|i| (found[i] / nominal[i] / factor - 1.0).abs() < 1e-14), "{found:?}");
        assert_eq!(found, heavy(&study, index, "right_thigh"));
        assert!(study.assignments(index).iter().all(|a| a.path.starts_with("body.segments.")));
        assert!(study.assignments(index).iter().all(|a| matches!(a.value, Value::Number(_))));
    }
}

#[test]
fn segments_beside_another_size_or_other_words_are_refused() {
    let size = "[[parameters]]\npath = \"body.preset\"\nlist = [\"male50\", \"male95\"]\n";
    let sampled = SAMPLED.replace("parameters = [{ segments = \"15 %\" }]", "");
    for study in [
        format!("{sampled}\n{size}[[parameters]]\nsegments = 0.15"),
        format!("{sampled}\n{size}[ensemble]\nmembers = 2\nsegments = 0.15"),
    ] {
        let said = complaint(&study);
        assert!(said.contains("`body.preset` is varied") && said.contains("a body of fixed size"), "{said}");
    }
    for (words, said) in [
        ("segments = 0.15, path = \"body.mass\"", "`path`"),
        ("segments = 0.15, name = \"masses\"", "`name`"),
        ("segments = 0.15, grid = { from = 0.9, to = 1.1, steps = 3 }", "`grid`"),
        ("segments = 1.5", "1.5"),
    ] {
        let found = complaint(&SAMPLED.replace("segments = \"15 %\"", words));
        assert!(found.contains(said), "{words}: {found}");
    }
}

#[test]
fn people_of_several_presets_are_one_study() {
    let study = study(
        "design.kind = \"full_factorial\"\nparameters = [{ path = \"body.preset\", list = [\"female05\", \"male95\"] }]",
    );
    let mass_kg = |index| study.draft(index).unwrap().load(&super::no_files).unwrap().build().unwrap().0.body.mass_kg();
    assert!((mass_kg(0) - 46.27).abs() < 1e-6 && (mass_kg(1) - 97.52).abs() < 1e-6);
    let wrong =
        complaint("design.kind = \"full_factorial\"\nparameters = [{ path = \"body.preset\", list = [\"male51\"] }]");
    assert!(wrong.contains("male51"), "{wrong}");
}
