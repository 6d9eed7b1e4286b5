//! What every room may lean on: how a command ends and talks, how files come to their names, text
//! tables, what is shown by default.
//!
//! Knows no command, no job and no file format.

pub(crate) mod customary;
pub(crate) mod failure;
pub(crate) mod input_file;
pub(crate) mod interrupt;
pub(crate) mod names;
pub(crate) mod output_file;
pub(crate) mod progress;
pub(crate) mod sha256;
pub(crate) mod talk;
pub(crate) mod text_table;
