//! Eight samples of a sweep with every kernel that this processor has: their events alone, and with all that goes with a
//! sample: the scenario with its value, checked and built, the occupant seated, the run summed up.

use std::hint::black_box;
use std::ops::ControlFlow;

use criterion::{BatchSize, Criterion, SamplingMode};
use occupant_bench as scene;
use occupant_core::model::Model;
use occupant_core::results::recorder::Recorder;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::batch::{Job, Kernel, simulate_many};
use occupant_scenario::{Draft, Format};
use occupant_study::{Study, StudyText};

/// Samples side by side.
const COUNT: usize = 8;
/// Its base is the scene.
const STUDY: &str = include_str!("../peers/study.toml");

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    events(&mut criterion);
    samples(&mut criterion);
    criterion.final_summary();
}

fn kernels() -> impl Iterator<Item = Kernel> {
    let all = [Kernel::Scalar, Kernel::Lanes4, Kernel::Lanes8];
    all.into_iter().filter(|kernel| kernel.is_available())
}

fn events(criterion: &mut Criterion) {
    let models = scene::models(COUNT);
    let mut group = criterion.benchmark_group("eight events");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    for kernel in kernels() {
        group.bench_function(kernel.name(), |b| {
            let jobs = || models.clone();
            let run = |models: Vec<Model>| run(kernel, models.into_iter(), || ());
            b.iter_batched(jobs, run, BatchSize::PerIteration);
        });
    }
}

fn samples(criterion: &mut Criterion) {
    let study = study();
    let mut group = criterion.benchmark_group("eight samples of a study");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.bench_function("models alone", |b| {
        b.iter(|| (0..COUNT as u64).for_each(|index| _ = black_box(model(&study, index))));
    });
    for kernel in kernels() {
        group.bench_function(kernel.name(), |b| {
            let models = || (0..COUNT as u64).map(|index| model(&study, index));
            b.iter(|| run(kernel, models(), Summarizer::new));
        });
    }
}

fn study() -> Study {
    let base = Draft::read(scene::TEXT, Format::Toml, "car.toml").expect("the scene is valid");
    let text = StudyText::read(STUDY, Format::Toml, "study.toml").expect("the study is valid");
    text.bind(base, &[], &no_file).expect("the study is valid")
}

fn no_file(name: &str) -> Result<Vec<u8>, String> {
    Err(format!("{name}: the study has no file beside it"))
}

fn model(study: &Study, index: u64) -> Model {
    let draft = study.draft(index).expect("the sample is valid");
    let loaded = draft.load(&no_file).expect("the sample is valid");
    loaded.model().expect("the sample is valid").0
}

fn run<R: Recorder>(kernel: Kernel, models: impl Iterator<Item = Model>, recorder: impl Fn() -> R) {
    let jobs = models.map(|model| Job { tag: (), model, recorder: recorder() });
    simulate_many(kernel, jobs, |ended| {
        black_box(&ended.recorder);
        ended.outcome.expect("nothing is written");
        ControlFlow::Continue(())
    });
}
