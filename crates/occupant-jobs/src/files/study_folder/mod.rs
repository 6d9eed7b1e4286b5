//! The folder of a sweep or a fit: manifest, copies of the inputs, the journal of finished runs, and their tables.
//!
//! This module runs nothing: jobs pass rows in and read them back. [`folder`] describes the folder, [`journal`] a file
//! of the journal.

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
