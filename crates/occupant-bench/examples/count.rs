//! Runs one piece of the kernel a given number of times and measures nothing: what callgrind counts instructions of.
//!
//! `count NAME N`; without arguments it prints the names that this processor can run. `instructions.py` calls it
//! with two numbers and takes the difference, so that reading the scenario falls out.

use std::hint::black_box;
use std::ops::ControlFlow;

use occupant_bench::{self as scene, Instant, LIMITED_S, PRESSED_S, STEP_S, TOUCHING_S};
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::run::batch::{Job, Kernel, simulate_many};

/// A piece of work: calls that are counted.
type Work = fn(count: usize);

const WORKS: [(&str, Work); 18] = [
    ("evaluation_bare", bare),
    ("evaluation_joints_and_belts", held),
    ("evaluation_full_within_step", |n| rates(n, instant())),
    ("evaluation_full_step_start", |n| commits(n, instant())),
    ("evaluation_three_point", |n| rates(n, Instant::full(&scene::belted(), LIMITED_S))),
    ("evaluation_three_point_step_start", |n| commits(n, Instant::full(&scene::belted(), LIMITED_S))),
    ("evaluation_three_point_left_out", |n| rates(n, Instant::full(&scene::belted(), LIMITED_S).unbelted())),
    ("evaluation_air_bag", |n| rates(n, Instant::full(&scene::bagged(), PRESSED_S))),
    ("evaluation_air_bag_step_start", |n| commits(n, Instant::full(&scene::bagged(), PRESSED_S))),
    ("evaluation_air_bag_left_out", |n| rates(n, Instant::full(&scene::bagged(), PRESSED_S).without_bags())),
    ("evaluation_column", |n| rates(n, Instant::full(&scene::stroking(), PRESSED_S))),
    ("evaluation_solids_12_within_step", |n| rates(n, among_solids(&[]))),
    ("evaluation_solids_12_step_start", |n| commits(n, among_solids(&[]))),
    ("evaluation_solids_17_full_within_step", |n| rates(n, among_solids(&FULL_17))),
    ("evaluation_solids_17_full_step_start", |n| commits(n, among_solids(&FULL_17))),
    ("step_rk4", step),
    ("run_step_scalar", |n| run(Kernel::Scalar, 1, n)),
    ("run_step_lanes4", |n| run(Kernel::Lanes4, 4, n)),
];

#[allow(clippy::print_stdout, reason = "an example prints its result")]
fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, count] = &arguments[..] else {
        for (name, _) in WORKS {
            // all others are compiled for AVX2 where the processor has it
            if name == "evaluation_bare" || Kernel::Lanes4.is_available() {
                println!("{name}");
            }
        }
        return;
    };
    let (_, work) = WORKS.iter().find(|work| work.0 == name).expect("one of the names");
    work(count.parse().expect("a number of calls"));
}

fn bare(count: usize) {
    let (now, loads) = (instant(), scene::no_loads());
    for _ in 0..count {
        black_box(black_box(&now).bare(black_box(&loads)));
    }
}

fn held(count: usize) {
    let model = scene::model();
    let mut now = Instant::full(&model, TOUCHING_S).held();
    for _ in 0..count {
        black_box(black_box(&mut now).rate());
    }
}

fn rates(count: usize, mut now: Instant) {
    for _ in 0..count {
        black_box(black_box(&mut now).rate());
    }
}

fn commits(count: usize, mut now: Instant) {
    for _ in 0..count {
        black_box(black_box(&mut now).commit());
    }
}

fn step(count: usize) {
    let mut now = instant();
    for _ in 0..count {
        black_box(black_box(&mut now).step());
    }
}

fn instant() -> Instant {
    Instant::full(&scene::model(), TOUCHING_S)
}

/// 17 segments with a full set of spheres.
const FULL_17: [&str; 2] = ["body.segment_count=17", "body.sphere_set=full"];

fn among_solids(set: &[&str]) -> Instant {
    Instant::full(&scene::model_among_solids(set), TOUCHING_S)
}

/// `side_by_side` whole runs of `steps` steps with everything that goes with a step: path, outputs, touches noted.
fn run(kernel: Kernel, side_by_side: usize, steps: usize) {
    let shortened = |model: Model| {
        let mut setup: Setup = model.setup().clone();
        setup.time.end_s = setup.time.start_s + steps as f64 * STEP_S;
        Model::new(setup).expect("the scene is valid")
    };
    let models = scene::models(side_by_side).into_iter().map(shortened);
    let job = |model| Job { tag: (), model, recorder: () };
    simulate_many(kernel, models.map(job), |ended| {
        black_box(ended.outcome.expect("nothing is written"));
        ControlFlow::Continue(())
    });
}
