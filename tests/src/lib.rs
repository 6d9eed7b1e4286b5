//! Shared parts of the proofs: bodies and compartments built in code, prescribed motion, reference data.

pub mod cart;
pub mod cases;
pub mod measure;
pub mod probe;
