//! Shared pieces of the proofs.

pub mod core_side;
pub mod golden;
pub mod random;
pub mod reference;
pub mod scene;
pub mod space_state;
