//! End of a command: success, or the reason of its failure. Each has its exit code.

use std::fmt::Display;
use std::path::Path;

use occupant_scenario::ending::Unrecorded;

/// Outcome of a completed command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// Success: exit code 0.
    Well,
    /// A check failed: exit code 1. The message has been printed.
    Unwell,
}

impl From<()> for Done {
    /// Outcome of a command without checks.
    fn from((): ()) -> Self {
        Done::Well
    }
}

/// Reason why a command failed.
#[derive(Debug)]
pub enum Failure {
    /// It could not start: exit code 2.
    CouldNotRun(String),
    /// It was aborted: exit code 1.
    BrokeOff(String),
    /// Another process is at the same work: exit code 75, `EX_TEMPFAIL` of sysexits.h. The same command succeeds later.
    Busy(String),
}

impl Failure {
    /// Could not start; the usual message: what is wrong, and how to correct it.
    pub fn with_help(found: impl Into<String>, help: &str) -> Self {
        Failure::CouldNotRun(format!("error: {}\n = help: {help}", found.into()))
    }

    /// Could not start: the extension of an output is not one of `endings`.
    pub fn ending(output: &Path, endings: &str) -> Self {
        let name = output.display();
        Failure::with_help(format!("-o {name}: unknown file format"), &format!("use the extension {endings}"))
    }

    /// The same with a note on what was done before.
    pub fn with_done(self, done: &str) -> Self {
        let longer = |message| format!("{message}\n = done: {done}");
        match self {
            Failure::CouldNotRun(message) => Failure::CouldNotRun(longer(message)),
            Failure::BrokeOff(message) => Failure::BrokeOff(longer(message)),
            Failure::Busy(message) => Failure::Busy(longer(message)),
        }
    }

    /// Its message.
    pub fn words(self) -> String {
        match self {
            Failure::CouldNotRun(words) | Failure::BrokeOff(words) | Failure::Busy(words) => words,
        }
    }

    /// Aborted while running.
    pub fn broke_off(reason: impl Display) -> Self {
        Failure::BrokeOff(format!("error: {reason}"))
    }

    /// Could not start.
    pub fn plain(found: impl Into<String>) -> Self {
        Failure::CouldNotRun(format!("error: {}", found.into()))
    }
}

impl From<Unrecorded> for Failure {
    fn from(error: Unrecorded) -> Self {
        Failure::broke_off(error)
    }
}
