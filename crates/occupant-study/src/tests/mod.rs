//! Tests of studies.

mod constraints;
mod designs;
mod ensembles;
mod fits;
mod inputs;
mod laws;
mod messages;
mod paths;
mod robustness;
mod screening;
mod segments;
mod tables;

use super::{Study, StudyText, Value};
use occupant_scenario::{Diagnostics, Draft, Format};

/// The shortest useful scenario.
const SHORT: &str = include_str!("short.toml");

fn no_files(name: &str) -> Result<Vec<u8>, String> {
    Err(format!("there is no file {name}"))
}

fn base() -> Draft {
    Draft::read(SHORT, Format::Toml, "short.toml").unwrap()
}

/// A study of the short scenario.
fn bind(text: &str) -> Result<Study, Diagnostics> {
    let text = format!("base = \"short.toml\"\n{text}");
    StudyText::read(&text, Format::Toml, "study.toml")?.bind(base(), &[], &no_files)
}

fn study(text: &str) -> Study {
    bind(text).unwrap_or_else(|e| panic!("{e}"))
}

/// Problems of a study, as a user reads it.
fn complaint(text: &str) -> String {
    bind(text).err().map_or(String::new(), |e| e.to_string())
}

/// The numbers of a sample.
fn numbers(study: &Study, index: u64) -> Vec<f64> {
    let settings = study.sample(index).into_iter();
    settings
        .map(|s| match s.value {
            Value::Number(x) => x,
            other => panic!("{other:?} is no number"),
        })
        .collect()
}

/// Two parameters in a range from 0 to 1, so that a number is its own probability, and a design.
fn unit_square(design: &str) -> Study {
    study(&format!(
        "seed = 7
        design = {design}
        [[parameters]]
        name = \"a\"
        path = \"materials.foam.friction\"
        range = {{ from = 0, to = 1 }}
        [[parameters]]
        name = \"b\"
        path = \"materials.foam.mu1\"
        range = {{ from = 0, to = 1 }}"
    ))
}
