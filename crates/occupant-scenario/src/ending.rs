//! The ending of a run, by one rule for sweeps, ensembles, bands, fits and single runs.

use std::any::Any;

use crate::{Diagnostic, Diagnostics};
use occupant_core::results::outcome::{Outcome, RecordingFailed, Status};
use placed_text::Severity;

pub use occupant_core::results::energy::{Balance, EnergyCheck};

/// End of one of many runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// It reached its end time with its energy in balance to 10 %.
    Completed,
    /// It reached its end time, but its results mean nothing.
    OutOfBalance(EnergyCheck),
    /// The integration failed: when, where and why.
    Failed(String),
    /// Its scenario is invalid, so nothing was run: the reason, in one line.
    Refused(String),
    /// Its study leaves it out, so nothing was run: the reason.
    Excluded(String),
    /// The program panicked, which is a defect: its message.
    Broken(String),
}

impl Ending {
    /// The ending of a run with this outcome; none if it was interrupted.
    pub fn of(outcome: &Outcome) -> Option<Ending> {
        match &outcome.status {
            Status::Stopped => None,
            Status::Failed(error) => Some(Ending::Failed(error.to_string())),
            Status::Completed => Some(match outcome.energy.balance {
                Balance::Lost => Ending::OutOfBalance(outcome.energy),
                Balance::Kept | Balance::Doubtful => Ending::Completed,
            }),
        }
    }

    /// The ending of a run whose scenario has these problems.
    pub fn refused(problems: &Diagnostics) -> Ending {
        let errors = problems.iter().filter(|d| d.problem.severity == Severity::Error);
        let line = |Diagnostic { problem: p, .. }: &Diagnostic| {
            let at = if p.path.is_empty() { String::new() } else { format!("{}: ", p.path) };
            format!("{at}{}; expected {}", p.found, p.expected)
        };
        let lines: Vec<String> = errors.map(line).collect();
        Ending::Refused(lines.join(" | ").replace(['\n', '\r'], " "))
    }

    /// The ending of a run in which the program panicked.
    pub fn broken(panic: &(dyn Any + Send)) -> Ending {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
        Ending::Broken(format!("the program stopped: {}", text.unwrap_or("without a word")))
    }

    /// Why the run has no results; none if it has.
    pub fn reason(&self) -> Option<String> {
        match self {
            Ending::Completed => None,
            Ending::OutOfBalance(energy) => Some(format!("its energy balance is {}", energy.found())),
            Ending::Failed(reason) | Ending::Refused(reason) | Ending::Excluded(reason) | Ending::Broken(reason) => {
                Some(reason.clone())
            }
        }
    }
}

/// A run whose results could not be recorded.
#[derive(Debug, thiserror::Error)]
#[error("sample {index}: {}", with_causes(.source))]
pub struct Unrecorded {
    /// Its number.
    pub index: u64,
    /// Message of its recorder.
    pub source: RecordingFailed,
}

/// An error with its causes; the operating system's reason is last.
fn with_causes(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(deeper) = cause {
        let words = deeper.to_string();
        if !text.contains(&words) {
            text.push_str(&format!(": {words}"));
        }
        cause = deeper.source();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_a_result_only_at_its_end_time_and_in_balance() {
        let of = |status: Status, balance| {
            let energy = EnergyCheck {
                balance_error: 0.12,
                reference: "largest kinetic energy",
                reference_j: 1.0,
                greatest_kinetic_j: 1.0,
                balance,
            };
            let (time_s, effort) = (0.1, Default::default());
            Ending::of(&Outcome { status, time_s, effort, first_touches: Vec::new(), energy })
        };
        assert_eq!(of(Status::Completed, Balance::Doubtful), Some(Ending::Completed));
        assert_eq!(of(Status::Stopped, Balance::Lost), None);
        let off = of(Status::Completed, Balance::Lost).and_then(|ending| ending.reason());
        assert_eq!(off.as_deref(), Some("its energy balance is off by 12 % of the largest kinetic energy"));
    }
}
