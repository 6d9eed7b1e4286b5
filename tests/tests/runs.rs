//! Runs: the same bits every time, failures that say when, where and why, and what they leave behind.

use std::thread;

use occupant_core::body::tti12;
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::outcome::{Outcome, Status, StepError};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError, Watch};
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::attempt;
use occupant_tests::cart::lap;

/// Every bit of state, forces and energies at every output of a run.
fn fingerprint(model: &Model) -> Vec<u64> {
    let mut bits = Vec::new();
    let outcome = attempt(
        model,
        Watch(|s: &Sample<'_>| {
            let q = s.report_coordinates().unwrap();
            bits.extend(q.q.iter().chain(&q.rates).map(|x| x.to_bits()));
            bits.extend(s.actions.contacts.iter().map(|t| t.normal_force.to_bits()));
            bits.extend(s.actions.belts.iter().map(|b| b.loop_force.to_bits()));
            bits.push(s.energy.balance_j.to_bits());
        }),
    )
    .unwrap();
    bits.push(outcome.effort.evaluations);
    bits
}

fn adaptive(tolerance: f64, min_step_s: f64) -> Integrator {
    Integrator::Adaptive {
        relative: tolerance,
        absolute_m: tolerance,
        absolute_m_s: tolerance,
        min_step_s,
        max_step_s: 1e-3,
    }
}

#[test]
fn a_run_gives_the_same_bits_again_and_from_a_model_made_anew() {
    for integrator in [Integrator::Rk4 { step_s: 2e-4 }, adaptive(1e-4, 1e-9)] {
        let model = Model::new(lap(integrator)).unwrap();
        let first = fingerprint(&model);
        assert!(first.len() > 10_000);
        assert!(first == fingerprint(&model));
        assert!(first == fingerprint(&Model::new(lap(integrator)).unwrap()));
    }
}

#[test]
fn several_threads_that_share_a_model_get_the_same_bits() {
    let model = Model::new(lap(Integrator::Rk4 { step_s: 2e-4 })).unwrap();
    let alone = fingerprint(&model);
    let together: Vec<Vec<u64>> = thread::scope(|scope| {
        let runs: Vec<_> = (0..4).map(|_| scope.spawn(|| fingerprint(&model))).collect();
        runs.into_iter().map(|run| run.join().unwrap()).collect()
    });
    assert!(together.iter().all(|bits| *bits == alone));
}

/// The lap case with materials and joints so stiff that a step of 1 ms cannot follow.
fn far_too_stiff() -> Setup {
    let mut setup = lap(Integrator::Rk4 { step_s: 1e-3 });
    for material in &mut setup.materials {
        let spring = material.force.bilinear_mut().unwrap();
        spring.k1_n_per_m *= 1e6;
        spring.k2_n_per_m *= 1e6;
    }
    setup.joints.ball_mut(tti12::NECK).unwrap().damping_n_m_s = 1e4;
    setup
}

/// A recorder that keeps times and what the end tells.
#[derive(Default)]
struct Diary {
    times: Vec<f64>,
    ended: Option<Outcome>,
}

impl Recorder for Diary {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.times.push(sample.time_s);
        Ok(Flow::Continue)
    }

    fn end(&mut self, outcome: &Outcome) -> Result<(), RecorderError> {
        self.ended = Some(outcome.clone());
        Ok(())
    }
}

#[test]
fn a_step_far_too_long_for_its_springs_ends_the_run_with_time_step_and_component() {
    let model = Model::new(far_too_stiff()).unwrap();
    let mut diary = Diary::default();
    let outcome = attempt(&model, &mut diary).unwrap();
    let Status::Failed(ref error @ StepError::NotFinite { time_s, step_s, ref component }) = outcome.status else {
        panic!("{:?}", outcome.status);
    };
    assert!(time_s > 0.0 && time_s < 0.2);
    assert!((step_s - 1e-3).abs() < 1e-12);
    assert!(!component.is_empty());
    let text = error.to_string();
    for part in [&format!("t = {time_s:.6} s"), component, "no longer finite"] {
        assert!(text.contains(part), "{part} in {text}");
    }
    // what was recorded before stands, and the recorder is told
    assert!(!diary.times.is_empty());
    assert!(diary.times.iter().all(|&t| t <= time_s));
    assert_eq!(outcome.time_s, time_s);
    // its energy is judged up to its last output
    assert!(outcome.energy.balance_error > 0.0 && outcome.energy.reference_j > 1.0, "{:?}", outcome.energy);
    assert_eq!(diary.ended, Some(outcome));
}

#[test]
fn an_error_control_that_asks_for_less_than_the_smallest_step_ends_the_run() {
    let model = Model::new(lap(adaptive(1e-9, 5e-4))).unwrap();
    let outcome = attempt(&model, ()).unwrap();
    let Status::Failed(StepError::StepTooSmall { time_s, step_s, min_step_s, error }) = outcome.status else {
        panic!("{:?}", outcome.status);
    };
    assert!(step_s < min_step_s && error > 1.0);
    assert_eq!((min_step_s, time_s), (5e-4, outcome.time_s));
}

/// Stops at the tenth output.
struct Stopper;

impl Recorder for Stopper {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        Ok(if sample.index < 10 { Flow::Continue } else { Flow::Stop })
    }
}

#[test]
fn a_recorder_can_stop_a_run_and_an_error_of_it_is_the_runs() {
    let model = Model::new(lap(Integrator::Rk4 { step_s: 5e-4 })).unwrap();
    let outcome = attempt(&model, Stopper).unwrap();
    assert_eq!(outcome.status, Status::Stopped);
    assert!((outcome.time_s - 0.010).abs() < 1e-12);

    struct FullDisk;
    impl Recorder for FullDisk {
        fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
            if sample.index == 3 {
                Err("the disk is full")?;
            }
            Ok(Flow::Continue)
        }
    }
    let error = attempt(&model, FullDisk).unwrap_err();
    assert!((error.time_s - 0.003).abs() < 1e-12);
    assert!(error.to_string().contains("the disk is full"));
}

#[test]
fn a_summary_of_the_lap_case_says_what_touches_what_and_in_which_order() {
    let model = Model::new(lap(Integrator::Rk4 { step_s: 1e-4 })).unwrap();
    let outcome = attempt(&model, ()).unwrap();
    let touched = |sphere: &str, surface: &str| {
        outcome.first_touches.iter().position(|t| {
            model.body().spheres[t.sphere].name == sphere && model.setup().surfaces[t.surface].name == surface
        })
    };
    let at = |sphere, surface| {
        let i = touched(sphere, surface).unwrap_or_else(|| panic!("{sphere} on {surface}"));
        outcome.first_touches[i]
    };
    assert_eq!(at("pelvis", "cushion").time_s, 0.0);
    let head = at("head", "wheel");
    // a jackknife: the head meets the wheel after the pulse has nearly ended, at several metres per second
    assert!(head.time_s > 0.06 && head.time_s < 0.15, "{head:?}");
    assert!(head.closing_m_s > 3.0, "{head:?}");
    let times: Vec<f64> = outcome.first_touches.iter().map(|t| t.time_s).collect();
    assert!(times.is_sorted());
}
