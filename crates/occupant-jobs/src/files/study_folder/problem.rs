//! Problems of a folder of results.

use std::io::{self, ErrorKind};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::finished::ranges_text;
use super::folder::Holds;
use crate::base::{Failure, FileProblem};

/// Largest number of ranges named.
const SHOWN: usize = 20;

/// A problem of a result folder, with its remedy if known.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// A file that cannot be written.
    #[error(transparent)]
    File(#[from] FileProblem),
    /// The path exists and is no result folder.
    #[error("{} exists and does not belong to this sweep\n = help: choose a new folder or an empty one", .path.display())]
    Exists {
        /// The file.
        path: PathBuf,
    },
    /// The folder has files, but none of ours.
    #[error("{} contains files that do not belong to a {}\n = help: choose a new folder or an empty one", .folder.display(), .holds.word)]
    NotOurs {
        /// The folder.
        folder: PathBuf,
        /// Its kind.
        holds: &'static Holds,
    },
    /// The folder belongs to another sweep or version; a line per difference.
    #[error(
        "{} contains another {} (there → here):\n   {}\n = help: choose another folder, or start again with --restart, which removes the old results",
        .folder.display(), .holds.word, .differences.join("\n   ")
    )]
    Differs {
        /// The folder.
        folder: PathBuf,
        /// Its kind.
        holds: &'static Holds,
        /// The differences, as text.
        differences: Vec<String>,
    },
    /// A file of the folder is invalid.
    #[error(
        "{} {found}\n = help: run the same `occupant sweep` or `occupant fit` command again to repair it, or remove it", .path.display()
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What was found.
        found: String,
    },
    /// A result file was damaged and has not been recomputed.
    #[error(
        "{} was changed after it was written, and was not repaired\n = help: remove the file, or start again with --restart", .path.display()
    )]
    Unmended {
        /// The file.
        path: PathBuf,
    },
    /// Another process is working in the folder.
    #[error("another process is working in {}: it {doing}\n = help: wait for it (--wait does), or choose another folder", .folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// Its work.
        doing: String,
    },
    /// An object store that does not do what is asked.
    #[error("{address}: {found}\n = help: {}", mend(found.kind()))]
    Store {
        /// Its address.
        address: String,
        /// What it says.
        found: io::Error,
    },
    /// Samples are unfinished.
    #[error(
        "{} of {samples} samples are missing: {}\n = help: run the same `occupant sweep` command again to resume, or with --range {}",
        missing(.gaps), ranges_text(.gaps, SHOWN), .gaps.first().map_or(String::new(), |gap| format!("{}..{}", gap.start, gap.end))
    )]
    Incomplete {
        /// Missing runs.
        gaps: Vec<Range<u64>>,
        /// Number of samples expected.
        samples: u64,
    },
    /// Two results of one sample disagree.
    #[error(
        "sample {index} has one result in {} and another in {}\n = help: the results come from programs or machines that do not agree; start again with --restart", .first.display(), .second.display()
    )]
    Disagree {
        /// Number of the sample.
        index: u64,
        /// One of the files.
        first: PathBuf,
        /// The other.
        second: PathBuf,
    },
}

impl Problem {
    /// An operating system error during an operation on a file.
    pub fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Problem {
        let path = path.to_owned();
        move |source| Problem::File(FileProblem::Io { doing, path, source })
    }
}

/// What helps against what a store has said.
fn mend(of: ErrorKind) -> &'static str {
    match of {
        ErrorKind::InvalidInput => "make the bucket, or correct its name; nothing of it is there",
        ErrorKind::InvalidData => "look at the endpoint of the environment: what answers there is no store of a sweep",
        ErrorKind::PermissionDenied => {
            "look at the keys of the environment, such as AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, AWS_SESSION_TOKEN, and their rights to read, list and write"
        }
        _ => {
            "look at address, network, and endpoint and region of the environment (AWS_ENDPOINT, AWS_REGION; AWS_ALLOW_HTTP=true for http); a slow line needs AWS_TIMEOUT=10m or smaller ranges. What is finished is kept: give the same command again"
        }
    }
}

fn missing(gaps: &[Range<u64>]) -> u64 {
    gaps.iter().map(|gap| gap.end - gap.start).sum()
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        let message = format!("error: {problem}");
        match problem {
            Problem::Incomplete { .. } | Problem::Unmended { .. } | Problem::Store { .. } => Failure::BrokeOff(message),
            Problem::Busy { .. } => Failure::Busy(message),
            Problem::File(file) if file.broke_off() => Failure::BrokeOff(message),
            _ => Failure::CouldNotRun(message),
        }
    }
}
