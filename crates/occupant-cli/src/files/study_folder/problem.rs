//! What can go wrong with a folder of results.

use std::fmt;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::finished::ranges_text;
use super::folder::Holds;
use super::shard::Shard;

/// So many ranges or shards are named.
const SHOWN: usize = 20;

/// What can go wrong with a folder of results.
#[derive(Debug)]
pub(crate) enum Problem {
    /// The operating system refuses.
    Io {
        /// What was being done, e.g. `write`.
        doing: &'static str,
        path: PathBuf,
        /// Its reason.
        source: io::Error,
    },
    /// Results of something else are there.
    Exists {
        /// What is there.
        path: PathBuf,
    },
    /// There are files, but none of ours.
    NotOurs {
        folder: PathBuf,
        /// What was looked for.
        holds: Holds,
    },
    /// The folder holds something else, or the same of another version.
    Differs {
        folder: PathBuf,
        holds: Holds,
        /// What differs, a line each.
        differences: Vec<String>,
    },
    /// A file of the folder is not what it should be.
    Damaged {
        path: PathBuf,
        /// What is wrong with it.
        found: String,
    },
    /// Another process is at work.
    Busy { folder: PathBuf, doing: String },
    /// Samples are not finished.
    Incomplete {
        gaps: Vec<Range<u64>>,
        samples: u64,
        /// Shards that have begun and lack samples.
        shards: Vec<(Shard, u64)>,
    },
    /// Two results of one sample disagree.
    Disagree {
        index: u64,
        /// Where the one stands.
        first: PathBuf,
        /// Where the other stands.
        second: PathBuf,
    },
    /// The table cannot be written.
    Table { path: PathBuf, reason: String },
}

impl Problem {
    /// What the operating system said while something was done to a file.
    pub(crate) fn io(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Problem {
        let path = path.to_owned();
        move |source| Problem::Io { doing, path, source }
    }

    /// How to go on, where there is something to say.
    pub(crate) fn help(&self) -> Option<&'static str> {
        match self {
            Problem::Exists { .. } | Problem::NotOurs { .. } => Some("name a new folder, or an empty one"),
            Problem::Differs { .. } => Some(
                "name another folder, or compute everything anew with --restart, which removes the results that are there",
            ),
            Problem::Damaged { .. } => Some("remove the file: its samples are computed again by the same sweep"),
            Problem::Busy { .. } => Some("wait for it, or name another folder"),
            Problem::Incomplete { .. } => {
                Some("give the same command of `occupant sweep` again: it goes on from what is there")
            }
            Problem::Disagree { .. } => Some(
                "the results were computed by programs or machines that do not agree; compute them anew with --restart",
            ),
            Problem::Io { .. } | Problem::Table { .. } => None,
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Problem::Io { doing, path, source } => write!(f, "cannot {doing} {}: {source}", path.display()),
            Problem::Exists { path } => {
                write!(f, "{} exists and is not of this sweep", path.display())
            }
            Problem::NotOurs { folder, holds } => {
                let (folder, word) = (folder.display(), holds.word());
                write!(f, "{folder} holds files that are no {word}'s")
            }
            Problem::Differs { folder, holds, differences } => {
                let (folder, word) = (folder.display(), holds.word());
                write!(f, "{folder} holds another {word} (there → here):")?;
                differences.iter().try_for_each(|line| write!(f, "\n   {line}"))
            }
            Problem::Damaged { path, found } => write!(f, "{} {found}", path.display()),
            Problem::Busy { folder, doing } => {
                write!(f, "another process is at work in {}: it {doing}", folder.display())
            }
            Problem::Incomplete { gaps, samples, shards } => {
                let missing: u64 = gaps.iter().map(|g| g.end - g.start).sum();
                let which = ranges_text(gaps, SHOWN);
                write!(f, "{missing} of {samples} samples are missing: {which}")?;
                let lines = shards.iter().take(SHOWN);
                for (shard, missing) in lines {
                    write!(f, "\n   shard {shard}: {missing}")?;
                }
                match shards.len().checked_sub(SHOWN) {
                    Some(more) if more > 0 => write!(f, "\n   and {more} more shards"),
                    _ => Ok(()),
                }
            }
            Problem::Disagree { index, first, second } => {
                write!(f, "sample {index} has one result in {} and another in {}", first.display(), second.display())
            }
            Problem::Table { path, reason } => {
                write!(f, "{} cannot be written: {reason}", path.display())
            }
        }
    }
}

impl std::error::Error for Problem {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Problem::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}
