//! What every room may lean on: how a command talks, text tables, units; and the base of the library of files.
//!
//! Knows no command, no job and no file format. What rooms use everywhere is named here once.

pub(crate) mod deliver;
pub(crate) mod interrupt;
pub(crate) mod progress;
pub(crate) mod talk;
pub(crate) mod text_table;
pub(crate) mod units;

pub(crate) use deliver::{deliver, deliver_and, said_and_opened};
pub(crate) use interrupt::{Interrupt, survive_long_files};
pub(crate) use occupant_files::base::*;
pub(crate) use talk::{json, note, print, print_file, say, written};
pub(crate) use units::{SYSTEMS, Told, Units, UnitsArg};
