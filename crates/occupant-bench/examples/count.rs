//! Runs one piece of the kernel a given number of times and measures nothing: what callgrind counts instructions of.
//!
//! `count NAME N`; without arguments it prints the names that this processor can run. `instructions.py` calls it
//! with two numbers and takes the difference, so that reading the scenario falls out.

use std::hint::black_box;
use std::ops::ControlFlow;

use occupant_bench::{self as scene, Instant, LIMITED_S, PRESSED_S, STEP_S, TOUCHING_S};
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::batch::{Job, Kernel, simulate_many};
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Draft, Format};
use occupant_study::StudyText;

/// A piece of work: calls that are counted.
type Work = fn(count: usize);

const WORKS: [(&str, Work); 25] = [
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
    ("evaluation_sled_person", |n| rates(n, Instant::full(&scene::sled(), LIMITED_S))),
    ("step_rk4", step),
    ("run_step_scalar", |n| run(Kernel::Scalar, 1, n)),
    ("run_step_lanes4", |n| run(Kernel::Lanes4, 4, n)),
    ("run_three_point", |n| runs(n, scene::belted)),
    ("run_air_bag", |n| runs(n, scene::bagged)),
    ("output_scalar", |n| outputs(Kernel::Scalar, 1, n)),
    ("output_lanes4", |n| outputs(Kernel::Lanes4, 4, n)),
    ("sample_cart", |n| samples(n, scene::TEXT, CART_STUDY)),
    ("sample_three_point", |n| samples(n, scene::BELTED, FOAM_STUDY)),
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

/// Whole runs of a scenario as it is shipped.
fn runs(count: usize, model: fn() -> Model) {
    let model = model();
    for _ in 0..count {
        black_box(simulate(&model, ()).expect("the scene can be run"));
    }
}

/// `side_by_side` runs of 50 ms with so many outputs, each summed up as the samples of a sweep are.
fn outputs(kernel: Kernel, side_by_side: usize, count: usize) {
    const END_S: f64 = 0.05;
    let often = |model: Model| {
        let mut setup: Setup = model.setup().clone();
        (setup.time.end_s, setup.time.output_s) = (END_S, END_S / count as f64);
        Model::new(setup).expect("the scene is valid")
    };
    let models = scene::models(side_by_side).into_iter().map(often);
    simulate_many(kernel, models.map(|model| Job { tag: (), model, recorder: Summarizer::new() }), |ended| {
        black_box(ended.outcome.expect("nothing is written"));
        ControlFlow::Continue(())
    });
}

/// The bench's study, with runs of 1 ms.
const CART_STUDY: &str = include_str!("../peers/study.toml");
/// A study of the driver in a three-point belt.
const FOAM_STUDY: &str = "title = \"foam\"\nbase = \"three-point.toml\"\nseed = 1\n\
    design = { kind = \"latin_hypercube\", samples = 1000 }\n\
    [[parameters]]\nname = \"foam\"\npath = \"materials.foam.k1\"\nrange = { from = 11000, to = 13000 }\n";

/// Samples of a study as a sweep computes them, from the base's text to the figures of a row, with runs of 1 ms.
fn samples(count: usize, base: &str, study: &str) {
    let none = |name: &str| Err(format!("{name}: the study has no file beside it"));
    let base = Draft::read(base, Format::Toml, "base.toml").expect("the scene is valid");
    let text = StudyText::read(study, Format::Toml, "study.toml").expect("the study is valid");
    let study = text.bind(base, &["time.end=1 ms".to_owned()], &none).expect("the study is valid");
    for index in 0..count as u64 {
        let draft = study.draft(index % study.len()).expect("the sample is valid");
        let (model, _) = draft.load(&none).and_then(|loaded| loaded.model()).expect("the sample is valid");
        let mut summarizer = Summarizer::new();
        simulate(&model, &mut summarizer).expect("nothing is written");
        black_box(summarizer.summary(None).expect("it has outputs").figures(&model));
    }
}
