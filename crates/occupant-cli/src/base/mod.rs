//! What every room may lean on: how a command ends and talks, how files come to their names, text
//! tables, what is shown by default.
//!
//! Knows no command, no job and no file format. What rooms use everywhere is named here once.

pub(crate) mod choice;
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
pub(crate) mod units;

pub(crate) use choice::one_of;
pub(crate) use failure::{Done, Failure};
pub(crate) use interrupt::{Interrupt, survive_long_files};
pub(crate) use names::{by_ending, ending, escape, file_name, file_stem, is_page, program, quoted};
pub(crate) use output_file::{
    Existing, FileProblem, PartialFile, begun, deliver, deliver_and, is_at, partial_path, publish, refuse_input,
    remove_if_there, said_and_opened, with_word, write_whole,
};
pub(crate) use sha256::sha256;
pub(crate) use talk::{json, note, print, print_file, say, written};
pub(crate) use units::{SYSTEMS, Told, Units, UnitsArg};
