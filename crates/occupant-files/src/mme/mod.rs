//! ISO-MME (ISO/TS 13499): channel codes, reading and writing of tests.
//!
//! Writes no folder itself, and leaves what is measured to be matched elsewhere. A test is a folder: `NAME.mme` says what the test was, `Channel/NAME.chn` lists channels, `Channel/NAME.001` and on hold
//! one channel each. Layout and codes from a public reader and its dictionary (RED 1.6.2); the standard was not read.

mod header;
mod read;
mod write;

pub use crate::channel_code::Code;
pub use header::text_of;
pub use read::read;
pub use write::{Labels, files};
