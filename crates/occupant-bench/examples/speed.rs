//! How long one derivative evaluation, one step and one event take on this machine, one thread.
//!
//! `cargo run --release -p occupant-bench --example speed` prints nanoseconds: the least of many medians of short batches, taken in turn, so
//! that a disturbed moment spoils no figure and all figures alike. Instructions are counted with the example `count`.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant as Clock;

use occupant_bench::{self as scene, Instant, TOUCHING_S};
use occupant_core::model::Model;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::batch::{Job, Kernel, simulate_many};
use occupant_core::run::simulate::simulate;

/// Rounds over all figures.
const ROUNDS: usize = 200;
/// Calls of a batch, whose mean is one sample; nine samples make a median.
const CALLS: usize = 50;

/// Runs of a sweep, and sweeps with each kernel.
const SWEEP: usize = 8;
const SWEEPS: usize = 12;

type Work<'a> = (&'static str, Box<dyn FnMut() + 'a>);

fn main() {
    let model = scene::model();
    let mut works = works(&model);
    let mut best = vec![f64::INFINITY; works.len()];
    for _ in 0..ROUNDS {
        for ((_, call), best) in works.iter_mut().zip(&mut best) {
            *best = best.min(median_ns(call));
        }
    }
    report("pairs", model.system().forces.contacts.pairs.len() as f64);
    report("touches", Instant::full(&model, TOUCHING_S).touches() as f64);
    for ((name, _), best) in works.iter().zip(best) {
        report(name, best);
    }
    report("event_ms", event_ms(&model));
    for (kernel, ms) in sweep_ms() {
        report(&format!("sweep_{kernel}_event_ms"), ms);
    }
}

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn report(name: &str, value: f64) {
    println!("{name} {value:.1}");
}

/// Everything that is timed, by name.
fn works(model: &Model) -> Vec<Work<'static>> {
    let full = Instant::full(model, TOUCHING_S);
    let held = full.held();
    let loads = scene::no_loads();
    let (bare, mut committed, mut within) = (full.clone(), full.clone(), full.clone());
    let bare_step = full.clone();
    let (mut held_step, mut held_within, mut step) = (held.clone(), held, full);
    let mut list: Vec<Work<'static>> = vec![
        (
            "bare",
            Box::new(move || {
                black_box(black_box(&bare).bare(black_box(&loads)));
            }),
        ),
        (
            "held",
            Box::new(move || {
                black_box(black_box(&mut held_within).rate());
            }),
        ),
        (
            "full",
            Box::new(move || {
                black_box(black_box(&mut within).rate());
            }),
        ),
        (
            "full_commit",
            Box::new(move || {
                black_box(black_box(&mut committed).commit());
            }),
        ),
        (
            "bare_step",
            Box::new(move || {
                black_box(black_box(&bare_step).bare_step(black_box(&loads)));
            }),
        ),
        (
            "held_step",
            Box::new(move || {
                black_box(black_box(&mut held_step).step());
            }),
        ),
        (
            "step",
            Box::new(move || {
                black_box(black_box(&mut step).step());
            }),
        ),
    ];
    list.extend(three_point());
    list
}

/// With a belt over several nodes and without it: within a step, and where one begins.
fn three_point() -> Vec<Work<'static>> {
    let belted = Instant::full(&scene::belted(), scene::LIMITED_S);
    let within = |mut now: Instant| -> Box<dyn FnMut()> {
        Box::new(move || {
            black_box(black_box(&mut now).rate());
        })
    };
    // a commit of the same time as the last would change nothing
    let start = |mut now: Instant| -> Box<dyn FnMut()> {
        Box::new(move || {
            now.frames.time += 1e-9;
            black_box(black_box(&mut now).commit());
        })
    };
    vec![
        ("three_point", within(belted.clone())),
        ("three_point_left_out", within(belted.unbelted())),
        ("three_point_step_start", start(belted.clone())),
        ("three_point_left_out_step_start", start(belted.unbelted())),
    ]
}

/// Median of nine batches, ns a call.
fn median_ns(call: &mut impl FnMut()) -> f64 {
    let mut samples: [f64; 9] = std::array::from_fn(|_| {
        let clock = Clock::now();
        for _ in 0..CALLS {
            call();
        }
        clock.elapsed().as_nanos() as f64 / CALLS as f64
    });
    samples.sort_by(f64::total_cmp);
    samples[4]
}

/// A run of a sweep with each kernel, ms: the shortest of several sweeps, the kernels in turn.
fn sweep_ms() -> Vec<(Kernel, f64)> {
    let models = scene::models(SWEEP);
    let all = [Kernel::Scalar, Kernel::Lanes4, Kernel::Lanes8];
    let kernels = all.into_iter().filter(|kernel| kernel.is_available());
    let mut best: Vec<_> = kernels.map(|kernel| (kernel, f64::INFINITY)).collect();
    for _ in 0..SWEEPS {
        for (kernel, best) in &mut best {
            let jobs: Vec<_> = models.iter().map(job).collect();
            let clock = Clock::now();
            simulate_many(*kernel, jobs, |ended| {
                black_box(ended.outcome.expect("nothing is written"));
                ControlFlow::Continue(())
            });
            *best = best.min(clock.elapsed().as_secs_f64() * 1e3 / SWEEP as f64);
        }
    }
    best
}

fn job(model: &Model) -> Job<(), ()> {
    Job { tag: (), model: model.clone(), recorder: () }
}

/// A whole run, ms: the shortest time of each output interval among twenty runs, summed up.
fn event_ms(model: &Model) -> f64 {
    let mut least = vec![f64::INFINITY; model.output_count()];
    for _ in 0..20 {
        let mut clock = Clock::now();
        let watch = Watch(|sample: &Sample<'_>| {
            let ms = clock.elapsed().as_secs_f64() * 1e3;
            least[sample.index] = least[sample.index].min(ms);
            clock = Clock::now();
        });
        black_box(simulate(model, watch).expect("nothing is written"));
    }
    least.iter().filter(|ms| ms.is_finite()).sum()
}
