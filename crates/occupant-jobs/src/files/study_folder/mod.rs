//! The folder of a sweep or a fit: manifest, copies of what was read, the journal of finished runs, the tables made of it.
//!
//! Runs nothing: jobs hand rows in and read them back. What a folder holds stands in [`folder`], what a piece of the journal
//! is in [`journal`].

pub mod checksums;
pub mod finished;
pub mod folder;
pub mod journal;
pub mod manifest;
pub mod problem;
pub mod row;
pub mod shard;
pub mod table;
pub mod texts;

pub use checksums::Checksums;
pub use finished::Finished;
pub use folder::{Folder, Held, SWEEP};
pub use journal::{Journal, JournalWriter};
pub use manifest::{Column, Manifest, Role, Text};
pub use problem::Problem;
pub use row::{Row, Status};
pub use shard::Shard;
pub use table::StudyTable;
pub use texts::{NamedBy, Texts};
