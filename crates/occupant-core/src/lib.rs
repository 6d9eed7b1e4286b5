//! Occupant.
pub mod measure;
pub mod signal;
