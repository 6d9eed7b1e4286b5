//! Targets of parameters, and the values that arrive there.

use super::super::{StudyText, Value};
use super::{base, bind, no_files, study};
use occupant_core::body::Joint;
use occupant_core::body::tti12;
use occupant_core::forces::joint::{JointLaw, Joints};
use occupant_core::model::setup::Setup;
use occupant_scenario::Format;

fn setup(study: &super::Study, index: u64) -> Setup {
    let draft = study.draft(index).unwrap();
    let loaded = draft.load(&no_files).unwrap_or_else(|e| panic!("{e}"));
    loaded.build().unwrap_or_else(|e| panic!("{e}")).0
}

fn damping(joints: &Joints, joint: Joint) -> f64 {
    match joints[joint] {
        JointLaw::Ball(ball) => ball.damping_n_m_s,
        JointLaw::Hinge(hinge) => hinge.damping_n_m_s,
    }
}

/// A study of one parameter with the two values 1/3 and 3.
fn two(path: &str, more: &str, values: &str) -> super::Study {
    study(&format!(
        "design.kind = \"full_factorial\"
        [[parameters]]
        path = \"{path}\"
        {more}
        list = [{values}]"
    ))
}

#[test]
fn values_arrive_in_si_units_to_the_last_bit() {
    let kilonewton = two("belts.lap.k1", "", "\"123.456789 lbf/in\", 70000");
    let value = &kilonewton.sample(0)[0].value;
    let found = setup(&kilonewton, 0).belts[0].webbing.k1_n_per_m;
    assert_eq!(*value, Value::Number(found));
    assert!((found - 123.456_789 * 4.448_221_615_260_5 / 0.0254).abs() < 1e-9);
    assert_eq!(kilonewton.parameters[0].unit, "N/m");

    let angle = two("posture.head", "", "10, \"0.1 rad\"");
    assert_eq!(angle.parameters[0].unit, "rad");
    assert_eq!(angle.sample(1)[0].value, Value::Number(0.1));
    assert_eq!(angle.assignments(1)[0].text(), "0.1 rad");

    let inches = StudyText::read(
        "base = \"s.toml\"
        units = \"in-lbf-s\"
        design.kind = \"full_factorial\"
        [[parameters]]
        path = \"belts.lap.slack\"
        list = [1, \"1 cm\"]",
        Format::Toml,
        "study.toml",
    );
    let inches = inches.unwrap().bind(base(), &[], &no_files).unwrap();
    assert_eq!(inches.sample(0)[0].value, Value::Number(0.0254));
    assert_eq!(inches.sample(1)[0].value, Value::Number(0.01));
}

#[test]
fn a_factor_multiplies_what_presets_say_each_in_its_own_place() {
    let study = two("joints.*.damping", "apply = \"factor\"", "1, 0.5");
    assert_eq!(study.parameters[0].unit, "");
    assert_eq!(study.parameters[0].targets.len(), 11);
    let (plain, half) = (setup(&study, 0).joints, setup(&study, 1).joints);
    assert_eq!(damping(&half, tti12::NECK), 0.5 * damping(&plain, tti12::NECK));
    assert_eq!(damping(&half, tti12::LEFT_KNEE), 0.5 * damping(&plain, tti12::LEFT_KNEE));
    assert_ne!(damping(&plain, tti12::NECK), damping(&plain, tti12::LEFT_KNEE));
}

#[test]
fn an_offset_is_added() {
    let study = two("posture.head", "apply = \"offset\"", "\"-1 deg\", 2");
    let head = |i: u64| study.assignments(i)[0].value.clone();
    let deg = std::f64::consts::PI / 180.0;
    for (i, wanted) in [(0, 4.0), (1, 7.0)] {
        let Value::Number(x) = head(i) else { panic!() };
        assert!((x - wanted * deg).abs() < 1e-15);
    }
}

#[test]
fn a_word_for_a_group_stands_for_what_it_changes() {
    let study = two("joints.knees.damping", "apply = \"factor\"", "2, 3");
    let paths: Vec<&str> = study.parameters[0].targets.iter().map(|t| t.path.as_str()).collect();
    assert_eq!(paths, ["joints.right_knee.damping", "joints.left_knee.damping"]);
    let all = two("joints.all.damping", "", "2, 3");
    assert_eq!(all.parameters[0].targets.len(), 11);
    let thighs = two("body.segments.thighs.mass", "", "9, 10");
    assert_eq!(setup(&thighs, 0).body.segments[8].mass_kg, 9.0);
    assert_eq!(setup(&thighs, 1).body.segments[9].mass_kg, 10.0);
}

#[test]
fn what_the_scenario_does_not_say_yet_can_be_varied() {
    let study = two("belts.lap.mu1", "", "0.1, 0.2");
    assert_eq!(study.parameters[0].targets[0].base, Value::Base);
    let draft = study.draft(1).unwrap();
    assert!(draft.load(&no_files).unwrap().build().is_ok());
}

#[test]
fn one_parameter_may_act_at_several_places_and_another_after_it() {
    let study = study(
        "design.kind = \"full_factorial\"
        [[parameters]]
        name = \"anchor height\"
        paths = [\"belts.lap.anchors[0][2]\", \"belts.lap.anchors[1][2]\"]
        list = [\"20 cm\", \"25 cm\"]
        [[parameters]]
        name = \"raised\"
        path = \"belts.lap.anchors[0][2]\"
        apply = \"offset\"
        list = [0, \"1 cm\"]",
    );
    let heights = |i: u64| setup(&study, i).belts[0].anchors_m.map(|a| a.z);
    assert_eq!(heights(0), [0.2, 0.2]);
    assert_eq!(heights(3), [0.26, 0.25]);
    assert_eq!(study.sample(3)[1].value, Value::Number(0.01));
}

#[test]
fn names_of_materials_and_shapes_can_be_varied() {
    let study = two("path.shape", "", "\"square\", \"haversine\"");
    assert_eq!(study.assignments(0)[0].text(), "\"square\"");
    setup(&study, 1);
    let materials = two("surfaces.*.material", "", "\"foam\", \"foam\"");
    setup(&materials, 1);
}

#[test]
fn set_and_overrides_change_the_base_of_all_runs() {
    let text = "base = \"short.toml\"
        set = { \"time.end\" = \"80 ms\", \"posture.head\" = 6 }
        design = { kind = \"monte_carlo\", samples = 3 }
        [[parameters]]
        path = \"belts.lap.slack\"
        range = { from = 0, to = 0.05 }";
    let text = StudyText::read(text, Format::Toml, "study.toml").unwrap();
    let by_hand = ["posture.head=7".to_owned()];
    let study = text.bind(base(), &by_hand, &no_files).unwrap();
    let setup = setup(&study, 2);
    assert_eq!(setup.time.end_s, 0.08);
    let head = study.base.places("posture.head").unwrap()[0].si.unwrap();
    assert!((head - 7_f64.to_radians()).abs() < 1e-15);
    // what is varied cannot be given by hand, too
    let by_hand = ["belts.*.slack=1 cm".to_owned()];
    let text = text.bind(base(), &by_hand, &no_files);
    // the wildcard leads nowhere: the scenario does not say the slack
    assert!(text.unwrap_err().to_string().contains("this scenario has no"));
}

#[test]
fn a_value_given_by_hand_and_varied_is_told() {
    let text = "base = \"short.toml\"
        design = { kind = \"monte_carlo\", samples = 3 }
        [[parameters]]
        path = \"belts.lap.slack\"
        range = { from = 0, to = 0.05 }";
    let text = StudyText::read(text, Format::Toml, "study.toml").unwrap();
    let problems = text.bind(base(), &["belts.lap.slack=1 cm".to_owned()], &no_files);
    let words = problems.unwrap_err().to_string();
    assert!(words.contains("`belts.lap.slack` is overridden and also varied"), "{words}");
}

#[test]
fn json_says_the_same_as_toml() {
    let toml = bind(
        "seed = 3
        design = { kind = \"latin_hypercube\", samples = 9 }
        [[parameters]]
        path = \"belts.lap.slack\"
        range = { from = 0, to = \"5 cm\" }",
    );
    let json = r#"{ "base": "short.toml", "seed": 3,
        "design": { "kind": "latin_hypercube", "samples": 9 },
        "parameters": [{ "path": "belts.lap.slack", "range": { "from": 0, "to": "5 cm" } }] }"#;
    let json = StudyText::read_bytes(json.as_bytes(), None, "study.json").unwrap();
    let json = json.bind(base(), &[], &no_files).unwrap();
    assert_eq!(toml.unwrap().sample(4), json.sample(4));
}

/// The scenario gives the pulse by its change of speed; a study of its peak takes that away.
#[test]
fn a_peak_replaces_a_change_of_speed() {
    let study = two("path.peak", "", "\"10 g\", \"20 g\"");
    assert_eq!(study.parameters[0].targets[0].base, Value::Base);
    for (i, g) in [(0, 10.0), (1, 20.0)] {
        let occupant_core::vehicle::VehiclePath::Pulse(pulse) = setup(&study, i).path else {
            panic!();
        };
        let peak = pulse.peak_deceleration_m_s2();
        assert!((peak / (g * 9.806_65) - 1.0).abs() < 1e-15, "{peak}");
    }
}
