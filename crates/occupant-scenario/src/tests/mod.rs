//! Tests of the scenario format.

mod accuracy;
mod bags;
mod belts;
mod bodies;
mod car;
mod car_places;
mod carts;
mod caveats;
mod collide;
mod columns;
mod crowds;
mod devices;
mod drive;
mod limits;
mod markers;
mod materials;
mod meaning;
mod messages;
mod mount;
mod muscles;
mod overrides;
mod passes;
mod plates;
mod ready;
mod record_file;
mod rigs;
mod robustness;
mod round_trip;
mod schema;
mod sensors;
mod side_slope;
mod spheres;
mod tables;
mod trials;
mod units;

use super::{Diagnostics, Format, Loaded, Scenario};
use occupant_core::model::Model;
use occupant_core::model::setup::Setup;

/// The shortest useful scenario.
const SHORT: &str = include_str!("short.toml");

/// A resolver for scenarios that name no file.
fn no_files(name: &str) -> Result<Vec<u8>, String> {
    Err(format!("there is no file {name}"))
}

fn load(text: &str) -> Result<Loaded, Diagnostics> {
    Scenario::from_text(text, Format::Toml, "s.toml", &no_files)
}

fn build(text: &str) -> Setup {
    let loaded = load(text).unwrap_or_else(|e| panic!("{e}"));
    loaded.build().unwrap_or_else(|e| panic!("{e}")).0
}

/// Problems of a text, as a user reads it.
fn complaint(text: &str) -> String {
    match load(text).and_then(|l| l.build()) {
        Ok(_) => String::new(),
        Err(problems) => problems.to_string(),
    }
}

/// The short scenario with one piece of text replaced by another.
fn short_with(old: &str, new: &str) -> String {
    assert!(SHORT.contains(old), "{old}");
    SHORT.replacen(old, new, 1)
}

/// The model of a scenario text.
fn model_of(text: &str) -> Model {
    load(text).and_then(|loaded| loaded.model()).unwrap_or_else(|problems| panic!("{problems}")).0
}
