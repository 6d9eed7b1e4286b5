//! What `integrator.accuracy` promises: how far heads and peaks are from the solution, with other materials than those shipped.

use nalgebra::Point3;
use occupant_core::forces::contact::material::Force;
use occupant_core::model::Model;
use occupant_core::model::accuracy::Accuracy;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::outcome::Status;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_tests::measure::assert_below;
use occupant_tests::room::setup;

const SHORT: [(&str, &str); 4] = [
    ("three-point", include_str!("../../tests/data/hand/three-point.toml")),
    ("airbag-driver", include_str!("../../tests/data/hand/airbag-driver.toml")),
    ("sled-person", include_str!("../../scenarios/sled-person.toml")),
    ("sled-17-segments", include_str!("../../scenarios/sled-17-segments.toml")),
];
const LONG: (&str, &str) = ("rollover-quarter-turn", include_str!("../../scenarios/rollover-quarter-turn.toml"));

/// The scenario with all materials `factor` times as stiff.
fn variant(text: &str, factor: f64) -> Setup {
    let mut setup = setup(text, &["output.interval=\"1 ms\""]);
    for material in &mut setup.materials {
        match &mut material.force {
            Force::Bilinear(spring) => {
                spring.k1_n_per_m *= factor;
                spring.k2_n_per_m *= factor;
            }
            Force::Deflection(law) => law.loading.points.iter_mut().for_each(|point| point[1] *= factor),
        }
    }
    setup
}

/// The head's path, m, the peak of its acceleration, m/s², and evaluations.
fn run(setup: &Setup, integrator: Integrator) -> (Vec<Point3<f64>>, f64, f64) {
    let model = Model::new(Setup { integrator, ..setup.clone() }).unwrap();
    let head = model.body().tree.landmarks().head.unwrap();
    let (mut path, mut peak) = (Vec::new(), 0.0_f64);
    let watch = Watch(|s: &Sample<'_>| {
        path.push(s.cg_m(head));
        peak = peak.max(s.specific_force_m_s2(head).norm());
    });
    let outcome = simulate(&model, watch).unwrap();
    assert_eq!(outcome.status, Status::Completed);
    (path, peak, outcome.effort.evaluations as f64)
}

/// Distance of the head's path, mm, error of the peak, %, and evaluations, at an accuracy; against a run at these tolerances.
fn errors(setup: &Setup, exact: &(Vec<Point3<f64>>, f64, f64), accuracy: Accuracy) -> [f64; 3] {
    let (path, peak, evaluations) = run(setup, accuracy.integrator(setup.time.end_s - setup.time.start_s));
    assert_eq!(path.len(), exact.0.len());
    let off_m = path.iter().zip(&exact.0).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    [1e3 * off_m, 100.0 * (peak / exact.1 - 1.0).abs(), evaluations]
}

fn tolerances(relative: f64) -> Integrator {
    Integrator::Adaptive {
        relative,
        absolute_m: 0.1 * relative,
        absolute_m_s: 10.0 * relative,
        min_step_s: 1e-13,
        max_step_s: 2e-3,
    }
}

#[test]
fn survey_and_engineering_keep_their_promise_with_other_materials() {
    for (name, text) in SHORT {
        for factor in [0.94, 1.0, 1.06] {
            let setup = variant(text, factor);
            let exact = run(&setup, tolerances(1e-9));
            let [survey, engineering] =
                [Accuracy::Survey, Accuracy::Engineering].map(|accuracy| errors(&setup, &exact, accuracy));
            assert_below(&format!("{name}, {factor}: survey, mm"), survey[0], 1.0);
            assert_below(&format!("{name}, {factor}: survey, %"), survey[1], 0.5);
            assert_below(&format!("{name}, {factor}: engineering, mm"), engineering[0], 0.1);
            assert_below(&format!("{name}, {factor}: engineering, %"), engineering[1], 0.1);
            assert!(survey[2] < engineering[2], "{name}: {} and {} evaluations", survey[2], engineering[2]);
        }
    }
}

#[test]
fn a_long_rollover_is_within_a_tenth_of_a_millimetre_too() {
    let setup = variant(LONG.1, 1.03);
    let exact = run(&setup, tolerances(1e-10));
    let found = errors(&setup, &exact, Accuracy::Engineering);
    assert_below(&format!("{}: engineering, mm", LONG.0), found[0], 0.1);
    assert_below(&format!("{}: engineering, %", LONG.0), found[1], 0.1);
}

#[test]
fn reference_is_a_thousand_times_as_near() {
    let setup = variant(SHORT[0].1, 0.97);
    let exact = run(&setup, tolerances(1e-12));
    let found = errors(&setup, &exact, Accuracy::Reference);
    assert_below("three-point: reference, mm", found[0], 1e-4);
    assert_below("three-point: reference, %", found[1], 1e-4);
}
