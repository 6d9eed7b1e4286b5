//! The report of a run: one HTML file that shows the motion, the time histories and the numbers, and needs no network.
//!
//! The page is drawn by JavaScript (`assets/viewer`, bundled with its libraries). Here the data are gathered from the
//! run's samples and put into it.

mod array;
mod curves;
mod data;
mod measures;
mod motion;
mod page;
mod provenance;

use crate::base::{Failure, Units, program};
use crate::files::results::Results;

pub(crate) use data::{Report, subject};

/// The page for a run, or for a run and another to compare it with.
///
/// # Errors
/// None for files that were opened.
pub(crate) fn page(run: &Results, against: Option<&Results>, units: Units) -> Result<String, Failure> {
    let runs = std::iter::once(run).chain(against).map(|run| data::Run::of(run, units)).collect::<Result<_, _>>()?;
    page::fill(&Report { program: program(), runs })
}
