//! Shared pieces of the proofs.

pub mod core_side;
pub mod free_run;
pub mod golden;
pub mod mirror;
pub mod random;
pub mod reference;
pub mod scene;
pub mod space_state;
