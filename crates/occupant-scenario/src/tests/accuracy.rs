//! `[integrator]`: an accuracy, tolerances, and what they come to.

use super::super::{Draft, Format};
use super::{SHORT, complaint, no_files};
use occupant_core::model::accuracy::Accuracy;
use occupant_core::model::setup::Integrator;

/// The integrator of the short scenario with these assignments.
fn integrator(assignments: &[&str]) -> Integrator {
    let mut draft = Draft::read(SHORT, Format::Toml, "s.toml").unwrap();
    assignments.iter().for_each(|assignment| draft.set(assignment).unwrap());
    let built = draft.load(&no_files).and_then(|loaded| loaded.build());
    built.unwrap_or_else(|problems| panic!("{problems}")).0.integrator
}

fn relative(integrator: Integrator) -> f64 {
    match integrator {
        Integrator::Adaptive { relative, .. } => relative,
        Integrator::Rk4 { .. } => panic!("rk4"),
    }
}

#[test]
fn an_accuracy_chooses_the_tolerances_by_the_length_of_the_run() {
    let [survey, engineering, reference] =
        [Accuracy::Survey, Accuracy::Engineering, Accuracy::Reference].map(|one| one.integrator(0.15));
    assert_eq!(integrator(&[]), engineering);
    assert_eq!(integrator(&["integrator.kind=adaptive"]), engineering);
    assert_eq!(integrator(&["integrator.accuracy=engineering"]), engineering);
    assert_eq!(integrator(&["integrator.accuracy=survey"]), survey);
    assert_eq!(integrator(&["integrator={ kind = \"adaptive\", accuracy = \"reference\" }"]), reference);
    assert!(relative(survey) > relative(engineering) && relative(engineering) > relative(reference));
    let long = integrator(&["time.end=2"]);
    assert_eq!(long, Accuracy::Engineering.integrator(2.0));
    assert!(relative(long) < relative(engineering));
    // the length, not the end
    assert_eq!(integrator(&["time.end=2", "time.start=1.9"]), engineering);
}

#[test]
fn steps_may_be_bounded_beside_an_accuracy() {
    let Integrator::Adaptive { max_step_s, relative, .. } =
        integrator(&["integrator.accuracy=survey", "integrator.max_step=0.5 ms"])
    else {
        panic!("rk4")
    };
    assert_eq!((max_step_s, Some(relative)), (5e-4, Some(self::relative(Accuracy::Survey.integrator(0.15)))));
}

#[test]
fn a_tolerance_that_is_written_holds_and_the_others_are_those_of_the_tightest_default() {
    let written = integrator(&["integrator.kind=adaptive", "integrator.relative=1e-5"]);
    let tightest = Integrator::default();
    let Integrator::Adaptive { absolute_m, absolute_m_s, min_step_s, max_step_s, .. } = tightest else { panic!("rk4") };
    assert_eq!(written, Integrator::Adaptive { relative: 1e-5, absolute_m, absolute_m_s, min_step_s, max_step_s });
}

#[test]
fn an_accuracy_and_a_tolerance_together_are_refused_and_what_no_accuracy_is() {
    let with = |words: &str| complaint(&format!("{SHORT}\n[integrator]\n{words}\n"));
    for tolerance in ["relative = 1e-5", "absolute_length = 1e-5", "absolute_speed = 1e-5"] {
        let (key, _) = tolerance.split_once(' ').unwrap();
        let found = with(&format!("accuracy = \"survey\"\n{tolerance}"));
        assert!(found.contains(&format!("`accuracy` and `{key}` together")), "{found}");
        assert!(found.contains("only one of them") && found.contains("s.toml:"), "{found}");
    }
    let found = with("accuracy = \"survay\"");
    assert!(found.contains("\"survay\" is not a value of `accuracy`") && found.contains("did you mean"), "{found}");
    let found = with("kind = \"rk4\"\nstep = 1e-4\naccuracy = \"survey\"");
    assert!(found.contains("unknown key `accuracy`"), "{found}");
    let found = with("max_step = 1e-3");
    assert!(found.contains("has no key `kind`"), "{found}");
    assert!(with("accuracy = 3").contains("accuracy"), "{}", with("accuracy = 3"));
}
