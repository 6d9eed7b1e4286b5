//! Fits: the parameters within their bounds with which runs follow measured channels best.
//!
//! ```text
//! study + tests ─ Fitting ─ search (core) ⇄ Evaluator (journal, threads, lanes) ─ Found ─ fit.json, fitted.toml, plots, history
//! ```
//!
//! The search asks for values of whole generations; the evaluator runs what the journal does not hold yet. As both depend on
//! nothing but study, tests and program, a fit that was killed goes on to the same answer.

pub mod candidates;
pub mod evaluator;
pub mod experiment;
pub mod failures;
pub mod fitting;
pub mod found;
pub mod identified;
pub mod output;
pub mod plots;
pub mod progress;
pub mod report;
pub mod scenario_text;
pub mod target;
pub mod verdict;
