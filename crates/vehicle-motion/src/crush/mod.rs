//! Collisions: outlines that crush.

pub mod law;
pub(crate) mod outline;
pub(crate) mod touch;
