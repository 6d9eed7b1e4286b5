//! A run of 40 ms with outputs every millisecond, first with nothing recorded, then as an MCAP file in memory: the
//! difference is what writing costs. The disk is not in it.

use std::collections::BTreeMap;
use std::io::Cursor;

use criterion::Criterion;
use occupant_cli::mcap::{About, Document, McapOptions, McapRecorder};
use occupant_core::model::Model;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Format, Scenario};

/// The tests' short run in a car, with belts.
const SCENARIO: &str = include_str!("../tests/recording/short.toml");

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let model = model();
    let mut group = criterion.benchmark_group("run of the recorder's tests");
    group.sample_size(20);
    group.bench_function("nothing recorded", |b| {
        b.iter(|| simulate(&model, Watch(|_: &Sample<'_>| {})));
    });
    group.bench_function("as MCAP in memory", |b| b.iter(|| write(&model)));
    group.finish();
    criterion.final_summary();
}

fn model() -> Model {
    let no_file = |name: &str| Err(format!("{name}: the scenario has no file beside it"));
    let loaded = Scenario::from_text(SCENARIO, Format::Toml, "short.toml", &no_file);
    let loaded = loaded.expect("the scenario is valid");
    loaded.model().expect("the scenario is valid").0
}

/// Bytes of the file.
fn write(model: &Model) -> usize {
    let scenario = Document {
        name: "short.toml".to_owned(),
        media_type: "application/toml".to_owned(),
        content: SCENARIO.as_bytes().to_vec(),
    };
    let about = About { program: "benchmark".to_owned(), scenario, resolved: None, notes: BTreeMap::new() };
    let file = Cursor::new(Vec::new());
    let recorder = McapRecorder::new(file, about, McapOptions::default());
    let mut recorder = recorder.expect("memory takes everything");
    simulate(model, &mut recorder).expect("memory takes everything");
    let file = recorder.into_inner().expect("memory takes everything");
    file.into_inner().len()
}
