//! The folder of a sweep or a fit: manifest, copies of what was read, the journal of finished runs, the tables made of it.
//!
//! Runs nothing: jobs hand rows in and read them back. What a folder holds stands in [`folder`], what a piece of the journal
//! is in [`journal`].

pub(crate) mod checksums;
pub(crate) mod finished;
pub(crate) mod folder;
pub(crate) mod journal;
pub(crate) mod manifest;
pub(crate) mod problem;
pub(crate) mod row;
pub(crate) mod shard;
pub(crate) mod table;
pub(crate) mod texts;

pub(crate) use checksums::Checksums;
pub(crate) use finished::Finished;
pub(crate) use folder::{Folder, Held, SWEEP};
pub(crate) use journal::{Journal, JournalWriter};
pub(crate) use manifest::{Column, Manifest, Role, Text};
pub(crate) use problem::Problem;
pub(crate) use row::{Row, Status};
pub(crate) use shard::Shard;
pub(crate) use table::StudyTable;
pub(crate) use texts::{NamedBy, Texts};
