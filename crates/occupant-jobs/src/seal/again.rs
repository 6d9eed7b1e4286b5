//! Runs a case again and compares each output to the bit.

use crate::base::Failure;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::attempt;
use occupant_files::results::Results;

/// Outcome of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Same {
    /// All outputs, this many, are the same to the bit.
    Yes(usize),
    /// The first difference.
    No(String),
}

/// Runs the stored scenario with this program, and compares states, memories and readings at each stored output.
///
/// # Errors
/// A run that cannot begin.
pub fn again(results: &Results) -> Result<Same, Failure> {
    let (mut seen, mut first) = (0, None);
    attempt(
        &results.model,
        Watch(|sample: &Sample<'_>| {
            if let (Some(stored), None) = (results.checkpoints.get(sample.index), first) {
                seen += 1;
                first = (*stored != sample.checkpoint()).then_some(sample.time_s);
            }
        }),
    )
    .map_err(|e| Failure::plain(format!("the case cannot be run again: {e}")))?;
    let all = results.checkpoints.len();
    Ok(match first {
        Some(time_s) => Same::No(format!("the output at {:.3} ms differs", time_s * 1e3)),
        None if seen < all => Same::No(format!("it ends after {seen} of {all} outputs")),
        None => Same::Yes(all),
    })
}
