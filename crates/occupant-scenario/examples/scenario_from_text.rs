//! A scenario from a text file: everything that is wrong with it at once, or the peaks of its run.
//!
//! ```text
//! cargo run -p occupant-scenario --example scenario_from_text -- scenarios/cart-lap.toml
//! ```
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::error::Error;
use std::path::Path;

use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Format, Scenario};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which scenario?")?;
    run(Path::new(&path))
}

pub(crate) fn run(path: &Path) -> Result<(), Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;

    // The crate reads no files: it asks for those that the scenario names, such as the table of a vehicle path.
    let beside = |name: &str| std::fs::read(path.with_file_name(name)).map_err(|e| e.to_string());
    let loaded = Scenario::from_text(&text, Format::Toml, &path.to_string_lossy(), &beside)?;
    let (model, warnings) = loaded.model()?;
    print!("{warnings}");

    let mut summarizer = Summarizer::new();
    simulate(&model, &mut summarizer)?;
    let summary = summarizer.summary(None).ok_or("the run did not end")?;
    print_peaks(&summary);
    Ok(())
}

fn print_peaks(summary: &Summary) {
    println!("{}", summary.title);
    let parts = [
        ("head", summary.accelerations.head),
        ("chest", summary.accelerations.chest),
        ("pelvis", summary.accelerations.pelvis),
    ];
    for (part, a) in parts {
        println!("  {part:7} peak {:5.1} g at {:5.1} ms", a.peak_g, 1e3 * a.peak_time_s);
    }
    for belt in ["lap", "torso"] {
        let force_n = summary.elements["belts"].number(belt, "loop_force_n").unwrap_or(0.0);
        println!("  {belt} belt pulls up to {:.1} kN", 1e-3 * force_n);
    }
    for contact in summary.contacts.iter().filter(|c| !c.at_start) {
        let (t_ms, speed) = (1e3 * contact.time_s, contact.closing_m_s);
        println!("  {} meets {} at {t_ms:.0} ms with {speed:.1} m/s", contact.sphere, contact.surface);
    }
    println!("  the energy balance is {}", summary.energy.found());
}
