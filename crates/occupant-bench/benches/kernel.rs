//! One derivative evaluation, one step, one event.

use std::hint::black_box;

use criterion::{Criterion, SamplingMode};
use occupant_bench::{self as scene, Instant, TOUCHING_S};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    evaluation(&mut criterion);
    step(&mut criterion);
    event(&mut criterion);
    criterion.final_summary();
}

fn evaluation(criterion: &mut Criterion) {
    let model = scene::model();
    let full = Instant::full(&model, TOUCHING_S);
    let mut group = criterion.benchmark_group("evaluation");
    let loads = scene::no_loads();
    group.bench_function("bare", |b| b.iter(|| full.bare(black_box(&loads))));
    let mut held = full.held();
    group.bench_function("joints and belts", |b| b.iter(|| _ = black_box(black_box(&mut held).rate())));
    let mut within = full.clone();
    group.bench_function("full, within a step", |b| {
        b.iter(|| _ = black_box(black_box(&mut within).rate()));
    });
    let mut start = full.clone();
    group.bench_function("full, start of a step", |b| {
        b.iter(|| _ = black_box(black_box(&mut start).commit()));
    });
}

fn step(criterion: &mut Criterion) {
    let mut now = Instant::full(&scene::model(), TOUCHING_S);
    criterion.bench_function("step of rk4", |b| b.iter(|| _ = black_box(black_box(&mut now).step())));
}

fn event(criterion: &mut Criterion) {
    let model = scene::model();
    let mut group = criterion.benchmark_group("event");
    group.sample_size(20).sampling_mode(SamplingMode::Flat);
    group.bench_function("0.25 s in steps of 0.1 ms", |b| {
        b.iter(|| simulate(&model, Watch(|s: &Sample<'_>| _ = black_box(s.time_s))));
    });
}
