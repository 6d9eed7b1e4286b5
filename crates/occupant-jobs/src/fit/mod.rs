//! Fits: find the parameters, within their bounds, with which runs follow measured channels best.
//!
//! ```text
//! study + tests ─ Opening ─ Fitting ─ search ⇄ Evaluator (journal, threads, lanes) ─ FitResult ─ fit.json, fitted.toml, plots, history
//! ```
//!
//! The search requests values of whole generations; the evaluator runs those that the journal lacks. Both depend only
//! on study, tests and program, so a killed fit reaches the same answer when it is resumed.

mod accord;
pub mod experiment;
pub mod fitting;
pub mod identified;
pub mod opening;
pub mod output;
mod plots;
pub mod report;
mod result;
pub mod scenario_text;
mod target;
pub mod verdict;

use accord::Accord;
use experiment::{Correction, Experiment};
use fitting::{Fitting, Test};
use identified::{Answer, Near};
use output::FittedRuns;
use result::{COMPENSATING, IntervalEnd, ParameterEstimate};
use scenario_text::Fitted;
use target::{FAMILY, Target};
use verdict::Verdict;

use crate::base::Failure;
use crate::files::study_folder::Folder;
use crate::search::{Evaluator, Objective, Record, WORST, Work, in_folder};

pub use result::FitResult;

/// Fits in a folder.
///
/// # Errors
/// As [`in_folder`].
pub fn fit(of: &Fitting, folder: &Folder, work: &Work<'_>) -> Result<FitResult, Failure> {
    in_folder(
        (of, &of.texts),
        (of.fit.budget, "fitting into one folder"),
        folder,
        work,
        |evaluator| identified::search(of, evaluator),
        |answer, records, sums| output::Output { fitting: of, folder, sums }.write(answer, records),
    )
}
