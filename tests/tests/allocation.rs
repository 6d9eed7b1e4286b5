//! The step allocates nothing.

use allocation_counter::{AllocationInfo, measure};
use occupant_core::forces::History;
use occupant_core::kernel::{Scratch, Situation};
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::motion::frame::Frames;
use occupant_core::motion::integrate::rk4;
use occupant_core::motion::layout::Freedom;
use occupant_core::motion::state::State;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::Run;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{VehicleInput, VehiclePath, VehicleState};
use occupant_tests::any_tree::{AnyTree, bare};
use occupant_tests::cart::lap;
use occupant_tests::random::Random;

/// Allocations of a run of the lap case over 0.15 s with two outputs.
fn allocations(integrator: Integrator) -> (AllocationInfo, u64) {
    let mut setup = lap(integrator);
    setup.time.end_s = 0.15;
    setup.time.output_s = 0.15;
    let model = Model::new(setup).unwrap();
    let mut steps = 0;
    let info = measure(|| steps = simulate(&model, ()).unwrap().effort.steps);
    (info, steps)
}

#[test]
fn twice_as_many_steps_of_rk4_allocate_no_more() {
    let (few, steps) = allocations(Integrator::Rk4 { step_s: 1e-4 });
    // readings are taken every 0.1 ms, or every longer step
    let (many, twice) = allocations(Integrator::Rk4 { step_s: 5e-5 });
    assert_eq!((steps, twice), (1500, 3000));
    // the count is alive: the run itself allocates its buffers
    assert!(few.count_total > 0);
    assert_eq!((few.count_total, few.bytes_total), (many.count_total, many.bytes_total));
}

#[test]
fn a_step_of_any_tree_allocates_nothing() {
    let mut random = Random::new(3);
    let tree = AnyTree::random(&mut random, 17, Freedom::Ball);
    let (state, (kernel, mut history)) = (tree.state(&mut random), bare(tree.skeleton()));
    let frames = Frames::still(0.0);
    let step = |history: &mut History<f64>| {
        let scratch = &mut Scratch::blank(&kernel);
        let rate = |_, s: &State<f64>, rate: &mut State<f64>| {
            kernel.rate_alone(scratch, Situation::accepted(s, &frames), history, &mut (), rate);
        };
        rk4::step(&state, 1e-4, rate)
    };
    let info = measure(|| assert!(step(&mut history) != state));
    assert_eq!(info.count_total, 0);
}

#[test]
fn twice_as_many_adaptive_steps_allocate_no_more() {
    let adaptive = |tolerance: f64| Integrator::Adaptive {
        relative: tolerance,
        absolute_m: tolerance,
        absolute_m_s: tolerance,
        min_step_s: 1e-10,
        max_step_s: 1e-3,
    };
    let (few, steps) = allocations(adaptive(1e-4));
    let (many, more) = allocations(adaptive(1e-7));
    assert!(more > 2 * steps, "{steps} {more}");
    assert_eq!((few.count_total, few.bytes_total), (many.count_total, many.bytes_total));
}

#[test]
fn more_outputs_allocate_no_more() {
    let run = |output_s: f64| {
        let mut setup = lap(Integrator::Rk4 { step_s: 1e-4 });
        setup.time.output_s = output_s;
        let model = Model::new(setup).unwrap();
        measure(|| drop(simulate(&model, ()).unwrap())).count_total
    };
    assert_eq!(run(0.05), run(0.001));
}

#[test]
fn a_summary_allocates_at_the_start_and_at_the_end_and_never_between() {
    let run = |output_s: f64, step_s: f64| {
        let mut setup = lap(Integrator::Rk4 { step_s });
        setup.time.output_s = output_s;
        let model = Model::new(setup).unwrap();
        let mut summarizer = Summarizer::new();
        let info = measure(|| drop(simulate(&model, &mut summarizer).unwrap()));
        assert!(summarizer.summary(None).is_some());
        info.count_total
    };
    let few = run(0.05, 2e-4);
    assert_eq!((run(0.001, 2e-4), run(0.001, 1e-4)), (few, few));
}

/// A vehicle that is told 1000 times a second for ever: from the second second on frames and looks leave nothing behind, and
/// take the same little, at once: 5 to 8 lists of 1.2 to 6 kB a frame.
#[test]
fn frames_that_are_told_leave_nothing_behind() {
    for integrator in [Integrator::Rk4 { step_s: 5e-4 }, Integrator::default()] {
        let mut setup = lap(integrator);
        setup.path = VehiclePath::live(VehicleState::default());
        setup.time.end_s = 10.0;
        let model = Model::new(setup).unwrap();
        let head = model.body().tree.segment(2);
        let (mut run, mut frame, mut looked) = (Run::new(&model), 0, 0.0);
        let mut frames = |count: u32| {
            measure(|| {
                for _ in 0..count {
                    frame += 1;
                    let until_s = 1e-3 * f64::from(frame);
                    run.push(until_s, &VehicleInput::acceleration([0.0, 2.0 * (3.0 * until_s).sin(), 0.0])).unwrap();
                    run.advance_to(until_s).unwrap();
                    looked += run.look(|sample| sample.cg_m(head).x).unwrap();
                }
            })
        };
        let warm_up = frames(1200);
        assert!(warm_up.count_total > 0);
        for _ in 0..3 {
            let after = frames(300);
            assert_eq!((after.count_current, after.bytes_current), (0, 0), "{after:?}");
            assert!(after.count_total <= 10 * 300 && after.bytes_max < 10_000, "{after:?}");
        }
        assert!(looked.is_finite());
    }
}
