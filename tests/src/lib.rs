//! Shared pieces of the proofs.

pub mod compartment;
pub mod core_side;
pub mod free_run;
pub mod golden;
pub mod mirror;
pub mod random;
pub mod reference;
pub mod scene;
pub mod segment_motion;
pub mod space_state;
