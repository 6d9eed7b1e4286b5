//! What comes before the first step: a scenario read and checked, an occupant seated, a model made.

use std::hint::black_box;

use criterion::{BatchSize, Criterion};
use occupant_bench as scene;
use occupant_core::model::Model;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    criterion.bench_function("scenario from text", |b| b.iter(|| black_box(scene::load())));
    let loaded = scene::load();
    criterion.bench_function("setup from scenario", |b| b.iter(|| loaded.build()));
    let (setup, _) = loaded.build().expect("the scene is valid");
    criterion.bench_function("model from setup, with seating", |b| {
        b.iter_batched(|| setup.clone(), Model::new, BatchSize::SmallInput);
    });
    criterion.final_summary();
}
