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

use crate::base::Failure;
use crate::files::study_folder::Folder;
use crate::search::{Work, in_folder};

/// Optimises in a folder.
///
/// # Errors
/// As [`in_folder`].
pub fn optimise(of: &Optimising, folder: &Folder, work: &Work<'_>) -> Result<Optimum, Failure> {
    in_folder(
        (of, &of.texts),
        (of.optimise.budget, "optimising into one folder"),
        folder,
        work,
        |evaluator| search(of, evaluator),
        |answer, records, sums| output::write(of, (folder, sums), answer, records),
    )
}
