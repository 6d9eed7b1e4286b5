//! Calls that no sane program makes, in tables: nothing panics, nothing hangs, nothing gives nonsense without a word.

mod calls;
mod further;
mod numbers;
mod setups;
mod steps;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use occupant_core::model::Model;
use occupant_core::model::setup::Setup;
use occupant_scenario::{Format, Scenario};

/// The setup of a shipped case, whose text is given.
fn setup(text: &str) -> Setup {
    let none = |name: &str| Err(format!("no file {name}"));
    Scenario::from_text(text, Format::Toml, "case", &none).unwrap().build().unwrap().0
}

fn cart() -> Setup {
    setup(include_str!("../../../scenarios/cart-lap-torso.toml"))
}

/// What a call came to.
#[derive(Debug, PartialEq)]
enum Came {
    /// An error or a refusal, in words.
    Refused(String),
    /// Some answer.
    Answered,
}

/// What `call` comes to; whatever it does, it must come back soon and must not panic.
fn came(name: &str, call: impl FnOnce() -> Result<(), String>) -> Result<Came, String> {
    let began = Instant::now();
    let done = catch_unwind(AssertUnwindSafe(call));
    let spent = began.elapsed();
    if spent > Duration::from_secs(20) {
        return Err(format!("{name}: took {spent:?}"));
    }
    match done {
        Err(_) => Err(format!("{name}: panicked")),
        Ok(Err(words)) if words.trim().is_empty() => Err(format!("{name}: refused without a word")),
        Ok(Err(words)) => Ok(Came::Refused(words)),
        Ok(Ok(())) => Ok(Came::Answered),
    }
}

/// Whether a model is made of a setup.
fn model(setup: Setup) -> Result<(), String> {
    Model::new(setup).map(|_| ()).map_err(|problems| problems.to_string())
}

/// Fails with all that went wrong.
fn report(failures: &[String]) {
    assert!(failures.is_empty(), "{} of these:\n{}", failures.len(), failures.join("\n"));
}
