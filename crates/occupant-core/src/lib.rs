//! Occupant.
pub mod correlation;
pub mod measure;
pub mod signal;
