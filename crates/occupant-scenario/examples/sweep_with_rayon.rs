//! One scenario at many speeds, on all cores. The rows are the same to the bit whatever the number of threads.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use occupant_core::results::summary::{Summarizer, Summary};
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Draft, Format};
use rayon::prelude::*;

type Failure = Box<dyn std::error::Error + Send + Sync>;

pub(crate) fn main() -> Result<(), Failure> {
    let base = Draft::read(include_str!("../scenarios/cart-lap-torso.toml"), Format::Toml, "cart")?;
    let speeds_mph: Vec<u32> = (10..=40).step_by(5).collect();
    let rows: Result<Vec<Summary>, Failure> = speeds_mph.par_iter().map(|mph| stop_from(&base, *mph)).collect();
    println!("stop from   head   chest   lap belt   torso belt");
    for (mph, row) in speeds_mph.iter().zip(rows?) {
        let (head, chest) = (row.accelerations.head.peak_g, row.accelerations.chest.peak_g);
        let force_n = |belt| row.elements["belts"].number(belt, "loop_force_n").unwrap_or(0.0);
        let [lap, torso] = ["lap", "torso"].map(|belt| 1e-3 * force_n(belt));
        println!("{mph:5} mph {head:5.0} g {chest:5.0} g {lap:7.1} kN {torso:9.1} kN");
    }
    Ok(())
}

fn stop_from(base: &Draft, mph: u32) -> Result<Summary, Failure> {
    let mut draft = base.clone();
    draft.set(&format!("path.speed={mph} mph"))?;
    draft.set(&format!("path.delta_v={mph} mph"))?;
    let (model, _) = draft.load(&|name| Err(format!("{name}: no files here")))?.model()?;
    let mut summarizer = Summarizer::new();
    simulate(&model, &mut summarizer)?;
    summarizer.summary(None).ok_or_else(|| "the run did not end".into())
}
