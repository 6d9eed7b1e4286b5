//! Runs a case again and compares the state at each output to the bit.

use std::path::Path;

use super::pack::Part;
use crate::base::Failure;
use occupant_core::model::Model;
use occupant_core::results::checkpoint::Checkpoint;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::attempt;
use occupant_files::mcap::{StoredRun, checkpoint::encoded};
use occupant_files::{base::sha256, scenario::stored};

/// Name of the part with a line for each output: its number, its time, and the SHA-256 of its states, stored values and
/// readings.
pub(super) const STATES: &str = "states.csv";
const HEAD: &str = "output,time_s,sha256";

/// Outcome of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Same {
    /// All outputs, this many, are the same to the bit.
    Yes(usize),
    /// The first difference.
    No(String),
}

/// The part of these outputs.
pub(super) fn states(checkpoints: &[Checkpoint]) -> Part {
    let lines: String = checkpoints.iter().map(|checkpoint| line(checkpoint) + "\n").collect();
    Part::new(STATES, format!("{HEAD}\n{lines}").into_bytes())
}

fn line(checkpoint: &Checkpoint) -> String {
    format!("{},{},{}", checkpoint.index, checkpoint.time_s, sha256(&encoded(checkpoint)))
}

/// Runs the scenario of a case with this program, and compares each output that the case lists.
///
/// # Errors
/// Parts without a scenario or without a list of outputs; a scenario that this program refuses; a run that cannot begin.
pub fn again(parts: &[Part]) -> Result<Same, Failure> {
    let mut run = StoredRun::default();
    run.attachments.extend(parts.iter().map(|part| (part.name.clone(), part.bytes.clone())));
    let listed = run.attachments.get(STATES).map(|bytes| String::from_utf8_lossy(bytes));
    let listed = listed.ok_or_else(|| Failure::plain(format!("the case has no part {STATES}")))?;
    let listed: Vec<&str> = listed.lines().skip(1).collect();
    let (_, model, _) = stored(Path::new("the case"), &run)?;
    compare(&listed, &model)
}

/// A run that was resumed begins at a later output; one that was cut off ends at an earlier one.
fn compare(listed: &[&str], model: &Model) -> Result<Same, Failure> {
    let first = listed.first().and_then(|line| line.split(',').next()?.parse::<usize>().ok());
    let first = first.ok_or_else(|| Failure::plain(format!("the part {STATES} lists no output")))?;
    let (mut seen, mut differs) = (0, None);
    let watch = Watch(|sample: &Sample<'_>| {
        let wanted = sample.index.checked_sub(first).and_then(|at| listed.get(at));
        if let (Some(wanted), None) = (wanted, differs) {
            seen += 1;
            differs = (line(&sample.checkpoint()) != *wanted).then_some(sample.time_s);
        }
    });
    attempt(model, watch).map_err(|e| Failure::plain(format!("the case cannot be run again: {e}")))?;
    Ok(match differs {
        Some(time_s) => Same::No(format!("the output at {:.3} ms differs", time_s * 1e3)),
        None if seen < listed.len() => Same::No(format!("it ends after {seen} of {} outputs", listed.len())),
        None => Same::Yes(seen),
    })
}
