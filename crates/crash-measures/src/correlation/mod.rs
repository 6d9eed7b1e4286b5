//! Agreement of a computed with a measured signal.
//!
//! Every rating takes the measured signal first (the reference) and the computed one second, equally
//! long and equally spaced, synchronised, filtered alike. None of the procedures' own texts was read:
//! the formulas come from open-source programs and manuals, as each file says.

pub mod anova;
pub mod cora;
pub mod iso18571;
pub mod sprague_geers;

mod shift;

pub use anova::{Anova, anova};
pub use cora::{Cora, CoraInterval, CoraSettings, cora};
pub use iso18571::{Iso18571, Iso18571Grade, iso18571};
pub use sprague_geers::{SpragueGeers, sprague_geers};

use crate::signal::{SignalError, require_same_length, require_samples};

/// Checks a pair of signals: equally long, at least `needed` samples, finite, a reference that is not
/// zero throughout.
///
/// # Errors
/// Histories of other lengths, fewer samples than are needed, an interval or samples that are no numbers.
pub fn require_pair(reference: &[f64], computed: &[f64], dt_s: f64, needed: usize) -> Result<(), SignalError> {
    require_samples("reference signal", reference, dt_s, needed)?;
    require_samples("computed signal", computed, dt_s, needed)?;
    require_same_length("computed signal", computed, reference)?;
    // squares of smaller values vanish
    if reference.iter().all(|m| m.abs() < 1e-100) {
        return Err(SignalError::NoContent { what: "reference signal" });
    }
    Ok(())
}
