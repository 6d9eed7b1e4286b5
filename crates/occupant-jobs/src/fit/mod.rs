//! Fits: find the parameters, within their bounds, with which runs follow measured channels best.
//!
//! ```text
//! study + tests ─ Opening ─ Fitting ─ search ⇄ Evaluator (journal, threads, lanes) ─ FitResult ─ fit.json, fitted.toml, plots, history
//! ```
//!
//! The search requests values of whole generations; the evaluator runs those that the journal lacks. Both depend only
//! on study, tests and program, so a killed fit reaches the same answer when it is resumed.

mod accord;
mod candidates;
pub mod evaluator;
mod experiment;
pub mod fitting;
pub mod identified;
pub mod opening;
pub mod output;
mod plots;
pub mod progress;
pub mod report;
mod result;
mod scenario_text;
mod target;
mod verdict;

use accord::Accord;
use evaluator::{Evaluator, Record, WORST};
use experiment::{Correction, Experiment};
use fitting::{Fitting, Test};
use identified::{Answer, Near};
use output::FittedRuns;
use progress::Progress;
use result::{COMPENSATING, FitResult, IntervalEnd, ParameterEstimate};
use scenario_text::Fitted;
use target::{FAMILY, Target};
use verdict::Verdict;
