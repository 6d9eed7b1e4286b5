//! One run: the file it writes, and the file it goes on from.

mod difference;
pub(crate) mod recording;
pub(crate) mod resume;
