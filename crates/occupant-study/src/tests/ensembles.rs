//! Ensembles: small changes of the same sample.

use super::super::{Study, Tolerances, Value};
use super::{base, complaint, study};

const PULSE: &str = "design = { kind = \"monte_carlo\", samples = 5 }
    [[parameters]]
    path = \"materials.foam.k1\"
    range = { from = 8000, to = 9000 }
    [ensemble]
    members = 4
    posture = 0.5
    place = \"2 mm\"
    path = \"1 %\"
    stiffness = \"2 %\"
    perturbations = [{ path = \"materials.foam.friction\", factor = 0.1 }]";

fn number(value: &Value) -> f64 {
    match value {
        Value::Number(x) => *x,
        other => panic!("{other:?}"),
    }
}

fn put(study: &Study, index: u64, path: &str) -> Option<f64> {
    let found = study.assignments(index).into_iter().find(|a| a.path == path);
    found.map(|a| number(&a.value))
}

#[test]
fn member_0_is_the_sample_itself_and_the_others_stay_within_the_tolerances() {
    let study = study(PULSE);
    assert_eq!((study.len(), study.samples(), study.members()), (20, 5, 4));
    assert_eq!(study.sample_and_member(11), (2, 3));
    let head = 5_f64.to_radians();
    for index in 0..20 {
        let (sample, member) = study.sample_and_member(index);
        let k1 = number(&study.sample(index)[0].value);
        assert_eq!(study.sample(index), study.sample(sample * 4));
        let put = |path: &str| put(&study, index, path);
        let stiffness = put("materials.foam.k1").unwrap();
        if member == 0 {
            assert_eq!(study.assignments(index).len(), 1);
            assert_eq!(stiffness, k1);
            continue;
        }
        // the change acts on the sample's value, not on the base's
        assert!(stiffness != k1 && (stiffness / k1 - 1.0).abs() <= 0.02);
        let turned = put("posture.head").unwrap() - head;
        assert!(turned != 0.0 && turned.abs() <= 0.5_f64.to_radians());
        assert!((put("posture.heels[0]").unwrap() - 0.69).abs() <= 0.002);
        assert!((put("path.delta_v").unwrap() / (30.0 / 3.6) - 1.0).abs() <= 0.01);
        assert!((put("materials.foam.friction").unwrap() / 0.8 - 1.0).abs() <= 0.1);
        assert!(study.draft(index).unwrap().load(&super::no_files).unwrap().build().is_ok());
    }
}

#[test]
fn members_are_changed_alike_in_all_samples() {
    let study = study(PULSE);
    let friction = |index| put(&study, index, "materials.foam.friction");
    assert_eq!(friction(1), friction(5));
    assert_ne!(friction(1), friction(2));
}

#[test]
fn an_ensemble_needs_no_parameters_and_a_larger_one_begins_with_the_smaller() {
    let plain = study("ensemble.members = 32");
    assert_eq!((plain.len(), plain.samples()), (32, 1));
    let standard = |members| Study::of_ensemble(base(), "short.toml", members, 0, &Tolerances::default());
    assert_eq!(plain.assignments(31), standard(32).assignments(31));
    assert_eq!(standard(32).assignments(7), standard(64).assignments(7));
    // six angles, two of the heels, the pulse, a material, a belt
    assert_eq!(plain.assignments(1).len(), 11);
}

/// A change is anywhere within its tolerance: mean 0, variance a third of its square.
#[test]
fn changes_are_even_within_their_tolerance() {
    let n = 20_000;
    let study = Study::of_ensemble(base(), "short.toml", n, 1, &Tolerances::default());
    let ways: Vec<f64> =
        (1..n).map(|i| (put(&study, i, "path.delta_v").unwrap() / (30.0 / 3.6) - 1.0) / 0.01).collect();
    let mean = ways.iter().sum::<f64>() / ways.len() as f64;
    let square = ways.iter().map(|w| w * w).sum::<f64>() / ways.len() as f64;
    // standard errors 0.004 and 0.002; measured: 0.0014 and 0.0016
    assert!(mean.abs() < 0.016, "{mean}");
    assert!((square - 1.0 / 3.0).abs() < 0.009, "{square}");
}

#[test]
fn a_tolerance_without_a_place_is_told() {
    let words = complaint(
        "set = { path = \"x\" }
        ensemble = { members = 8, path = 0.01 }",
    );
    assert!(!words.is_empty());
    let fixed = super::StudyText::read(
        "base = \"f.toml\"\nensemble = { members = 8, path = 0.01 }",
        occupant_scenario::Format::Toml,
        "study.toml",
    );
    let free_fall = include_str!("../../scenarios/free-fall.toml");
    let draft = occupant_scenario::Draft::read(free_fall, occupant_scenario::Format::Toml, "f.toml");
    let words = fixed.unwrap().bind(draft.unwrap(), &[], &super::no_files).unwrap_err().to_string();
    assert_eq!(
        words,
        "error: the base scenario has nothing that `path` could change
 --> study.toml:2:34
  |
2 | ensemble = { members = 8, path = 0.01 }
  |                                  ^^^^
  = in: ensemble.path
  = expected: a path that moves: a pulse with `peak` or `delta_v`, a table or a record"
    );
}

/// The members of a study of the peak change the peak, not the change of speed that it has taken away.
#[test]
fn members_change_the_peak_where_a_parameter_gives_it() {
    let study = study(
        "design.kind = \"one_at_a_time\"
        [[parameters]]
        path = \"path.peak\"
        list = [\"10 g\", \"20 g\"]
        [ensemble]
        members = 3
        path = \"1 %\"",
    );
    assert_eq!(study.len(), 9);
    // the base scenario itself, by its change of speed
    assert!(put(&study, 1, "path.delta_v").is_some() && put(&study, 1, "path.peak").is_none());
    assert!(put(&study, 4, "path.delta_v").is_none());
    let part = put(&study, 4, "path.peak").unwrap() / (10.0 * 9.806_65);
    assert!(part != 1.0 && (part - 1.0).abs() <= 0.01, "{part}");
    for index in 0..9 {
        assert!(study.draft(index).unwrap().load(&super::no_files).unwrap().build().is_ok());
    }
}
