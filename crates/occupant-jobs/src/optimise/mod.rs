//! Optimisations: find the parameters, within their bounds, with which a measure is smallest and limits are kept.
//!
//! ```text
//! study ─ Optimising (scenario, Measures) ─ search ⇄ Evaluator ─ Optimum ─ optimum.json, best.toml, history, page
//! ```
//!
//! A candidate is run with its numbers as they would be written, rounded to six digits: the figures quoted are those of the
//! scenario that is left behind, to the last bit.

mod measures;
pub mod optimising;
pub mod output;
mod page;
pub mod result;
pub mod searched;
pub mod text;

pub use measures::Measures;
pub use optimising::Optimising;
pub use result::Optimum;
pub use searched::search;
