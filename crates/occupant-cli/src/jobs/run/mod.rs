//! One run: the file that it writes, and the file that it resumes. The integration itself is the core's.

mod difference;
pub(crate) mod recording;
pub(crate) mod resume;
