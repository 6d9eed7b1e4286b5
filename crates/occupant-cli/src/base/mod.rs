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

pub(crate) use failure::{Done, Failure};
pub(crate) use interrupt::Interrupt;
pub(crate) use names::{ending, file_name, file_stem, program};
pub(crate) use output_file::{Existing, PartialFile, begun, partial_path, refuse_input, write_whole};
pub(crate) use sha256::sha256;
pub(crate) use talk::{json, note, say};
