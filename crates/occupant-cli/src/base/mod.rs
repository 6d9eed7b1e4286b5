//! Shared tools of all commands: output, interruption, progress, units; and the base of jobs.
//!
//! Knows no command and no file format. What commands use everywhere is named here once.

pub(crate) mod deliver;
pub(crate) mod interrupt;
pub(crate) mod progress;
pub(crate) mod talk;
pub(crate) mod units;

pub(crate) use deliver::{deliver, deliver_and, said_and_opened};
pub(crate) use interrupt::{listen, survive_long_files};
pub(crate) use occupant_jobs::base::*;
pub(crate) use talk::{hear_jobs, print, print_file, say, written};
pub(crate) use units::{SYSTEMS, UnitsArg};
