//! The runs side by side in lanes of an array, which every processor has.

use super::*;
use crate::forces::History;
use crate::kernel::Situation;
use crate::model::setup::{Integrator, Setup};
use crate::motion::integrate::rk4::{Stage, Stages};
use crate::motion::lanes::Plain;
use crate::results::recorder::Watch;
use crate::results::sample::Sample;
use crate::run::simulate::simulate;
use crate::tests::case_in_code::{cart, stop_from};
use crate::tests::three_point;
use crate::vehicle::PathCursor;

fn model(mph: f64) -> Model {
    stopped(cart().unwrap(), mph)
}

/// The case with another speed, with a slightly later end for each mph.
fn stopped(mut setup: Setup, mph: f64) -> Model {
    setup.path = stop_from(0.447_04 * mph).unwrap();
    setup.time.end_s = 0.05 + 1e-3 * mph;
    Model::new(setup).unwrap()
}

/// A recorder that keeps every output as text, to the bit.
fn keep(texts: &mut Vec<String>) -> impl Recorder + use<'_> {
    Watch(|s: &Sample<'_>| texts.push(format!("{:?} {:?}", s.checkpoint(), s.evaluation)))
}

#[test]
fn carts_in_an_array_of_lanes_have_the_bits_of_each_alone() {
    have_the_bits_of_each_alone([12.0, 16.0, 20.0, 24.0, 28.0].map(model).into());
}

#[test]
fn so_have_bodies_that_are_swept_as_any_tree() {
    let any = |mph: f64| model(mph).without_closed_forms();
    have_the_bits_of_each_alone([12.0, 20.0, 28.0, 16.0].map(any).into());
}

/// Retractors lock, pretensioners fire and stall, belts rub and slide at different times in each lane.
#[test]
fn so_have_belts_over_several_nodes() {
    let belted = |mph: f64| {
        let mut setup = cart().unwrap();
        setup.belts.clear();
        setup.chains.push(three_point(&setup.body, 1.0 / mph));
        stopped(setup, mph)
    };
    have_the_bits_of_each_alone([25.0, 30.0, 35.0, 40.0].map(belted).into());
}

/// The same under error control: steps, switches and kinks differ between runs.
#[test]
fn so_have_runs_under_error_control() {
    let belted = |mph: f64| {
        let mut setup = cart().unwrap();
        setup.belts.clear();
        setup.chains.push(three_point(&setup.body, 1.0 / mph));
        let relative = 1e-6 * mph;
        setup.integrator = Integrator::Adaptive {
            relative,
            absolute_m: 0.1 * relative,
            absolute_m_s: relative,
            min_step_s: 1e-9,
            max_step_s: 2e-3,
        };
        stopped(setup, mph)
    };
    have_the_bits_of_each_alone([25.0, 30.0, 35.0, 40.0, 28.0].map(belted).into());
}

/// A cart whose commits look at all pairs of spheres and faces moves as one whose commits skip those that are far away.
#[test]
fn pairs_that_are_skipped_change_nothing() {
    let model = model(20.0);
    let (system, start, h) = (model.system(), model.start(), 1e-4);
    let run = |looks: bool| {
        let mut history = History::new(&system.forces, start.history.memory.clone());
        let (mut state, mut stages, mut cursor) =
            (start.state, Stages::new(start.state.shape()), PathCursor::default());
        for step in 0..700 {
            if looks {
                history.look_again();
            }
            let time_s = h * f64::from(step);
            state = *stages.step(&state, h, |stage, state, rate| {
                let at_s = time_s + 0.5 * h * f64::from(stage as u8);
                let frames = model.frames(at_s, time_s + 0.5 * h, &mut cursor);
                let situation = Situation { state, frames: &frames, accepted: stage == Stage::Start };
                *rate = system.rate(situation, &mut history, &mut ());
            });
        }
        format!("{state:?} {:?}", history.memory)
    };
    let [skips, looks] = [false, true].map(run);
    assert!(skips == looks && skips != format!("{:?} {:?}", start.state, start.history.memory));
}

#[test]
fn bodies_with_closed_forms_and_without_do_not_run_side_by_side() {
    let (closed, any) = (model(20.0), model(20.0).without_closed_forms());
    assert!(closed.system().zip(closed.system(), |x, _| x).is_ok());
    let refused = closed.system().zip(any.system(), |x, _| x).map(|_| ());
    assert_eq!(refused, Err(crate::kernel::OTHER_TREE));
}

/// A run of another structure, first or between, is the only one that is computed alone.
#[test]
fn an_odd_run_does_not_make_those_after_it_run_alone() {
    let odd = || model(18.0).without_closed_forms();
    let all = |first: Option<Model>, between: Option<Model>| {
        let like = |mph: f64| model(mph);
        let few = [12.0, 16.0, 20.0].map(like).into_iter();
        first.into_iter().chain(few).chain(between).chain([24.0, 28.0].map(like)).collect::<Vec<_>>()
    };
    assert_eq!(have_the_bits_of_each_alone(all(None, None)), 0);
    assert_eq!(have_the_bits_of_each_alone(all(Some(odd()), None)), 0);
    assert_eq!(have_the_bits_of_each_alone(all(None, Some(odd()))), 1);
}

/// Returns how many did not fit the others.
fn have_the_bits_of_each_alone(models: Vec<Model>) -> usize {
    let mut texts = vec![Vec::new(); models.len()];
    let jobs = models.iter().zip(&mut texts).map(|(model, texts)| Job {
        tag: model.setup().time.end_s,
        model: model.clone(),
        recorder: keep(texts),
    });
    let (mut outcomes, mut alone) = (Vec::new(), 0);
    let on_end = |ended: Ended<f64, _>| {
        alone += usize::from(ended.kernel == Kernel::Scalar);
        outcomes.push((ended.tag, ended.outcome.unwrap()));
        ControlFlow::Continue(())
    };
    let mut jobs = JobList { jobs, on_end, under_way: (0..3).map(|_| None).collect(), nobody: () };
    let flow = Group::<Plain<3>>::new(Kernel::Lanes4).run_all(&mut jobs);
    drop(jobs);
    assert!(flow.is_continue());
    assert_eq!(outcomes.len(), models.len());
    for (model, found) in models.iter().zip(&texts) {
        let mut expected = Vec::new();
        let outcome = simulate(model, keep(&mut expected)).unwrap();
        assert!(*found == expected);
        assert!(outcome.first_touches.len() > 5);
        let end_s = model.setup().time.end_s;
        assert!(outcomes.contains(&(end_s, outcome)));
    }
    alone
}
