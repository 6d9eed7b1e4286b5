//! The step allocates nothing.

use allocation_counter::{AllocationInfo, measure};
use occupant_core::model::Model;
use occupant_core::model::setup::Integrator;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;
use occupant_tests::cart::lap;

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
    let (few, steps) = allocations(Integrator::Rk4 { step_s: 2e-4 });
    let (many, twice) = allocations(Integrator::Rk4 { step_s: 1e-4 });
    assert_eq!((steps, twice), (750, 1500));
    // the count is alive: the run itself allocates its buffers
    assert!(few.count_total > 0);
    assert_eq!((few.count_total, few.bytes_total), (many.count_total, many.bytes_total));
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
