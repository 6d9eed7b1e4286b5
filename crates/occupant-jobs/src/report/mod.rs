//! The report of a run: one HTML file that shows the motion, the time histories and the numbers, and needs no network.
//!
//! The page is drawn by JavaScript (`assets/viewer`, bundled with its libraries). Here the data are gathered from the
//! run's samples and put into it.

mod array;
mod curves;
mod data;
mod ground;
mod measures;
mod motion;
mod page;
mod provenance;
mod ride_down;
mod vehicles;

use crate::base::{Failure, Units, program};
use occupant_files::results::Results;

pub use data::{PageRecorder, Report, Run, Source, subject};

/// Largest number of runs on a page: each has its own colour.
pub const MOST_RUNS: usize = 4;

/// The page of a run, or of several side by side, with plots of these channels before the others.
///
/// # Errors
/// A name or pattern that fits no channel.
pub fn page(runs: &[Results], channels: &[String], units: Units) -> Result<String, Failure> {
    page_judged(runs, channels, units, false)
}

/// The same, with `verdicts` on people too.
///
/// # Errors
/// A name or pattern that fits no channel.
pub fn page_judged(runs: &[Results], channels: &[String], units: Units, verdicts: bool) -> Result<String, Failure> {
    let vehicles = vehicles::vehicles(runs, units);
    let runs = runs.iter().map(|run| Run::judged(run, channels, units, verdicts)).collect::<Result<_, _>>()?;
    page::fill(&Report { program: program(), runs }, vehicles)
}
