//! ISO-MME (ISO/TS 13499): channel codes, reading and writing of tests.
//!
//! It writes no folder itself and does not match signals to channels. A test is a folder: `NAME.mme` describes the
//! test, `Channel/NAME.chn` lists the channels, `Channel/NAME.001` and following contain one channel each. Layout and
//! codes from a public reader and its dictionary (RED 1.6.2); the standard was not read.

mod header;
mod read;
mod write;

pub use crate::channel_code::Code;
pub use header::text_of;
pub use read::read;
pub use write::{Labels, files};
