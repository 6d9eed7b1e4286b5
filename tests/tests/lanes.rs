//! Runs side by side: every recorder sees, to the bit, what it would see of its run alone.

use std::ops::ControlFlow;

use occupant_core::body::tti12;
use occupant_core::forces::Unlike;
use occupant_core::forces::contact::material::Memory;
use occupant_core::model::Model;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::results::outcome::{Outcome, Status};
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::batch::{Ended, Job, Kernel, simulate_many};
use occupant_core::run::simulate::attempt;
use occupant_scenario::{Format, Scenario};
use occupant_tests::cart::lap;
use occupant_tests::room::setup;

/// Everything in the outputs of a run as text, which shows every bit.
#[derive(Clone, Default)]
pub(crate) struct Texts {
    outputs: Vec<String>,
    /// The run stops after this output.
    pub(crate) stop_at: Option<usize>,
    /// The recorder breaks at this output.
    pub(crate) break_at: Option<usize>,
}

impl Recorder for Texts {
    fn record(&mut self, s: &Sample<'_>) -> Result<Flow, RecorderError> {
        if self.break_at == Some(s.index) {
            return Err("the disk is full".into());
        }
        let derived = (s.evaluation, s.actions, s.energy, s.vehicle);
        let text = format!("{:?} {derived:?} {:?}", s.checkpoint(), s.frames);
        self.outputs.push(text);
        Ok(match self.stop_at == Some(s.index) {
            true => Flow::Stop,
            false => Flow::Continue,
        })
    }
}

/// A run to be done: a setup, and what its recorder is told.
#[derive(Clone)]
pub(crate) struct Case {
    pub(crate) setup: Setup,
    pub(crate) texts: Texts,
}

/// What a run came to.
pub(crate) type Result_ = (Result<Outcome, String>, Vec<String>);

fn alone(case: &Case) -> Result_ {
    let model = Model::new(case.setup.clone()).unwrap();
    let mut texts = case.texts.clone();
    let outcome = attempt(&model, &mut texts);
    (outcome.map_err(|e| e.to_string()), texts.outputs)
}

/// The cases side by side, in their order, with the kernels that computed them.
fn together(kernel: Kernel, cases: &[Case]) -> Vec<(Result_, Kernel)> {
    let jobs = cases.iter().enumerate().map(|(tag, case)| Job {
        tag,
        model: Model::new(case.setup.clone()).unwrap(),
        recorder: case.texts.clone(),
    });
    let mut results: Vec<_> = cases.iter().map(|_| None).collect();
    simulate_many(kernel, jobs, |ended: Ended<usize, Texts>| {
        let outcome = ended.outcome.map_err(|e| e.to_string());
        let result = ((outcome, ended.recorder.outputs), ended.kernel);
        assert!(results[ended.tag].replace(result).is_none(), "ended twice");
        ControlFlow::Continue(())
    });
    results.into_iter().map(Option::unwrap).collect()
}

pub(crate) fn kernels() -> Vec<Kernel> {
    let all = [Kernel::Scalar, Kernel::Lanes4, Kernel::Lanes8];
    all.into_iter().filter(|k| k.is_available()).collect()
}

/// A cart with lap and torso belt, every number of it its own.
pub(crate) fn cart(i: usize) -> Case {
    cart_of(i, include_str!("../data/carts/cart-lap-torso.toml"))
}

fn cart_of(i: usize, text: &str) -> Case {
    let (speed, old) = (14.0 + 1.5 * i as f64, "speed = \"20 mph\"");
    assert!(text.contains(old));
    let text = text.replace(old, &format!("speed = \"{speed} mph\""));
    let none = |name: &str| Err(format!("no file beside the text: {name}"));
    let loaded = Scenario::from_text(&text, Format::Toml, "cart", &none);
    let mut setup = loaded.and_then(|s| s.build()).unwrap().0;
    let scale = 1.0 + 0.07 * i as f64;
    for material in &mut setup.materials {
        material.force.bilinear_mut().unwrap().k1_n_per_m *= scale;
        material.friction /= scale;
        if i.is_multiple_of(2) {
            material.memory = Memory::Retain;
        }
    }
    for belt in &mut setup.belts {
        belt.webbing.k1_n_per_m /= scale;
        belt.anchors_m[0].x += 0.004 * i as f64;
    }
    setup.joints.ball_mut(tti12::NECK).unwrap().damping_n_m_s *= scale;
    setup.joints.hinge_mut(tti12::LEFT_ELBOW).unwrap().damping_n_m_s *= scale;
    setup.integrator = Integrator::Rk4 { step_s: 3e-4 + 2e-5 * (i % 3) as f64 };
    setup.time.end_s = 0.09 + 0.011 * (i % 4) as f64;
    setup.time.output_s = 1e-3 * (1 + i % 3) as f64;
    let texts = Texts::default();
    Case { setup, texts }
}

fn carts(count: usize) -> Vec<Case> {
    (0..count).map(cart).collect()
}

pub(crate) fn compare(cases: &[Case], kernel: Kernel) -> Vec<(Result_, Kernel)> {
    let results = together(kernel, cases);
    for (i, (case, (result, _))) in cases.iter().zip(&results).enumerate() {
        let expected = alone(case);
        let of = cases.len();
        // by their words: a balance that is not known equals nothing
        let [own, other] = [&result.0, &expected.0].map(|outcome| format!("{outcome:?}"));
        assert_eq!(own, other, "outcome {i} of {of}, {kernel}");
        assert!(result.1 == expected.1, "outputs of {i} of {of}, {kernel}");
    }
    results
}

#[test]
fn carts_side_by_side_have_the_bits_of_each_alone() {
    for kernel in kernels() {
        for count in [1, 2, 3, 4, 5, 9] {
            let results = compare(&carts(count), kernel);
            for ((outcome, _), used) in results {
                let outcome = outcome.unwrap();
                assert_eq!(outcome.status, Status::Completed);
                assert!(outcome.first_touches.len() > 5);
                assert_eq!(used, kernel);
            }
        }
    }
}

#[test]
fn elastic_limits_side_by_side_have_the_bits_of_each_alone() {
    let text = include_str!("../data/carts/cart-lap-torso.toml");
    let text = text.replace("[joints]\npreset = \"male50\"", "[joints]\npreset = \"gebod\"");
    // numbers of the limits, too, are each run's own
    let own = |i: usize| {
        let neck = format!("neck.limit.angle = {}\nneck.friction.torque = {}", 20 + 5 * i, i + 1);
        let table = "torque = { angles = [0, 10, 20], moments = [0, 20, 90], returned = 0.5 }";
        let limit =
            format!("hips.limit = {{ azimuths = [0, 90, 180, 270], angles = [{}, 60, 70, 70], {table} }}", 80 - i);
        text.replace("preset = \"gebod\"", &format!("preset = \"gebod\"\n{neck}\n{limit}"))
    };
    let cases: Vec<Case> = (0..5).map(|i| cart_of(i, &own(i))).collect();
    assert!(cases.iter().all(|case| case.setup.joints.has_limits()));
    for kernel in kernels() {
        let results = compare(&cases, kernel);
        assert!(results.iter().all(|((outcome, _), used)| outcome.is_ok() && *used == kernel));
    }
}

/// Locks that open at different times, one that slips, and muscles that act at different times with reflexes that are late.
#[test]
fn locks_and_muscles_side_by_side_have_the_bits_of_each_alone() {
    let text = include_str!("../data/carts/cart-lap-torso.toml");
    let own = |i: usize| {
        let locks = format!(
            "elbows.lock = {{ until = \"{} N m\", relock_below = {} }}\nneck.lock = {{ until = \"{} N m\", slips = true }}",
            5 + 5 * i,
            i + 1,
            10 + i
        );
        let muscle = format!("trigger = \"go\", rise = 0.02, until = 0.15, stiffness = {}, damping = {i}", 20 * i)
            + &format!(", reflex = {{ stiffness = {}, damping = 1, delay = \"{} ms\" }}", 10 * i, 20 + i);
        let more = format!("[triggers]\ngo = {{ kind = \"time\", at = 0.0{i} }}\n[muscles]\nhips = {{ {muscle} }}\n");
        text.replace("[joints]\npreset = \"male50\"", &format!("[joints]\npreset = \"gebod\"\n{locks}")) + &more
    };
    let cases: Vec<Case> = (0..5).map(|i| cart_of(i, &own(i))).collect();
    for kernel in kernels() {
        let results = compare(&cases, kernel);
        assert!(results.iter().all(|((outcome, _), used)| outcome.is_ok() && *used == kernel));
    }
}

/// Bodies of 17 segments on a seat, and a head and neck of 15 on a rig: trees that are swept as any is.
#[test]
fn other_trees_side_by_side_have_the_bits_of_each_alone() {
    let [sled, rig] = [include_str!("../../scenarios/sled-17-segments.toml"), include_str!("../data/rig.toml")];
    for (text, end) in [(sled, "time.end=0.02"), (rig, "time.end=0.12")] {
        let case = |i: usize| Case {
            setup: setup(text, &[end, &format!("body.segments.head.mass={}", 4.0 + 0.1 * i as f64)]),
            texts: Texts::default(),
        };
        let cases: Vec<Case> = (0..5).map(case).collect();
        for kernel in kernels() {
            let results = compare(&cases, kernel);
            assert!(results.iter().all(|((outcome, _), used)| outcome.is_ok() && *used == kernel));
        }
    }
}

#[test]
fn a_run_that_fails_stops_or_breaks_leaves_its_neighbours_alone() {
    for kernel in kernels() {
        let mut cases = carts(9);
        // too stiff for the step: after 24 ms, and at once
        cases[1].setup.joints.ball_mut(tti12::RIGHT_SHOULDER).unwrap().damping_n_m_s = 1e3;
        cases[4].setup.joints.ball_mut(tti12::NECK).unwrap().damping_n_m_s = 1e4;
        cases[2].texts.stop_at = Some(31);
        cases[3].texts.stop_at = Some(0);
        cases[5].texts.break_at = Some(17);
        cases[6].texts.break_at = Some(0);
        let results = compare(&cases, kernel);
        let outcome = |i: usize| &results[i].0.0;
        let failed = |i: usize| matches!(outcome(i), Ok(o) if matches!(o.status, Status::Failed(_)));
        assert!(failed(1) && failed(4), "{:?} {:?}", outcome(1), outcome(4));
        let stopped = |i: usize| outcome(i).as_ref().unwrap().status == Status::Stopped;
        assert!(stopped(2) && stopped(3));
        assert!(outcome(5).is_err() && outcome(6).is_err());
    }
}

#[test]
fn a_model_of_another_structure_or_with_error_control_runs_alone() {
    let adaptive = Integrator::Adaptive {
        relative: 1e-3,
        absolute_m: 1e-4,
        absolute_m_s: 1e-3,
        min_step_s: 1e-9,
        max_step_s: 1e-3,
    };
    for kernel in kernels() {
        let mut cases = carts(5);
        cases[2].setup.belts.pop();
        cases[3].setup.integrator = adaptive;
        let results = compare(&cases, kernel);
        let used: Vec<_> = results.into_iter().map(|(_, kernel)| kernel).collect();
        let scalar = Kernel::Scalar;
        assert_eq!(used, [kernel, kernel, scalar, scalar, kernel]);
    }
}

#[test]
fn runs_of_another_structure_get_the_lanes_when_these_are_free() {
    let rk4 = Integrator::Rk4 { step_s: 4e-4 };
    for kernel in kernels() {
        let mut first = cart(0);
        first.texts.stop_at = Some(0);
        let lap = Case { setup: lap(rk4), texts: Texts::default() };
        let results = compare(&[first, lap.clone(), lap], kernel);
        assert!(results.iter().all(|(_, used)| *used == kernel));
    }
}

#[test]
fn jobs_are_taken_when_there_is_room_and_the_caller_may_break_off() {
    let mut taken = 0;
    let jobs = carts(12).into_iter().map(|case| {
        taken += 1;
        let (tag, recorder) = ((), case.texts);
        let model = Model::new(case.setup).unwrap();
        Job { tag, model, recorder }
    });
    let mut ended = 0;
    simulate_many(Kernel::best(), jobs, |_| {
        ended += 1;
        match ended < 2 {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    });
    assert_eq!(ended, 2);
    assert!(taken <= 9, "{taken} taken");
}

#[test]
fn what_keeps_models_apart_has_a_name() {
    let system = |change: &dyn Fn(&mut Setup)| {
        let mut setup = cart(0).setup;
        change(&mut setup);
        Model::new(setup).unwrap().system().clone()
    };
    let base = system(&|_| {});
    let unlike = |change: &dyn Fn(&mut Setup)| base.zip(&system(change), |a, _| a).err();
    assert_eq!(unlike(&|s| s.gravity_m_s2 = 9.0), None);
    let belts = unlike(&|s| s.belts.truncate(1));
    assert_eq!(belts, Some(Unlike("the belts differ or go round other spheres")));
    let springs = unlike(&|s| s.joints.ball_mut(tti12::UPPER_BACK).unwrap().spring = None);
    assert_eq!(springs, Some(Unlike("other joints have springs")));
    let fewer = unlike(&|s| s.surfaces.truncate(s.surfaces.len() - 1));
    assert_eq!(fewer, Some(Unlike("the spheres meet other surfaces")));
}
