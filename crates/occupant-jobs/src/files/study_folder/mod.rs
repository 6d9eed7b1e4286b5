//! The folder of a sweep or a fit: manifest, copies of the inputs, the journal of finished runs, and their tables.
//!
//! This module runs nothing: jobs pass rows in and read them back. [`folder`] describes the folder, [`piece`] a file of the
//! journal, [`part`] one of the table, [`journal`] reads all of them.

pub mod block;
pub mod census;
pub mod checksums;
pub mod finished;
pub mod folder;
pub mod journal;
pub mod manifest;
pub mod part;
pub mod piece;
pub mod problem;
pub mod row;
pub mod shard;
mod stored;
pub mod table;
pub mod texts;
pub mod waiting;

pub use block::Block;
pub use census::Census;
pub use checksums::Checksums;
pub use finished::Finished;
pub use folder::{Folder, Held, SWEEP};
pub use journal::Journal;
pub use manifest::{Column, Manifest, Role, Text};
pub use part::{About, Part};
pub use piece::JournalWriter;
pub use problem::Problem;
pub use row::{Row, Status};
pub use shard::Shard;
pub use table::StudyTable;
pub use texts::{NamedBy, Texts};
pub use waiting::Waiting;
