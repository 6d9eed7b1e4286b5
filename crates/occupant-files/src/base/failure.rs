//! How a command ends: done, or why it could not do its work. Each end has its exit code.

use std::fmt::Display;
use std::path::Path;

use occupant_scenario::ending::Unrecorded;

/// A command that ran to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Done {
    /// All is well: exit code 0.
    Well,
    /// It ran, and a check failed: exit code 1. The message has been written.
    Unwell,
}

impl From<()> for Done {
    /// Of a command that checks nothing.
    fn from((): ()) -> Self {
        Done::Well
    }
}

/// Why a command could not do its work.
#[derive(Debug)]
pub enum Failure {
    /// It could not run: exit code 2.
    CouldNotRun(String),
    /// It ran and broke off: exit code 1.
    BrokeOff(String),
}

impl Failure {
    /// Could not run, in the form of every message: what is wrong, and how to mend it.
    pub fn with_help(found: impl Into<String>, help: &str) -> Self {
        Failure::CouldNotRun(format!("error: {}\n = help: {help}", found.into()))
    }

    /// Could not run: the ending of an output names no kind of file that it can be.
    pub fn ending(output: &Path, endings: &str) -> Self {
        let name = output.display();
        Failure::with_help(format!("-o {name}: unknown file format"), &format!("use the extension {endings}"))
    }

    /// The same, and what was done before.
    pub fn with_done(self, done: &str) -> Self {
        let longer = |message| format!("{message}\n = done: {done}");
        match self {
            Failure::CouldNotRun(message) => Failure::CouldNotRun(longer(message)),
            Failure::BrokeOff(message) => Failure::BrokeOff(longer(message)),
        }
    }

    /// Its words.
    pub fn words(self) -> String {
        match self {
            Failure::CouldNotRun(words) | Failure::BrokeOff(words) => words,
        }
    }

    /// Ran and broke off.
    pub fn broke_off(reason: impl Display) -> Self {
        Failure::BrokeOff(format!("error: {reason}"))
    }

    /// Could not run.
    pub fn plain(found: impl Into<String>) -> Self {
        Failure::CouldNotRun(format!("error: {}", found.into()))
    }
}

impl From<Unrecorded> for Failure {
    fn from(error: Unrecorded) -> Self {
        Failure::broke_off(error)
    }
}
