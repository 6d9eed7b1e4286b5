//! Shared pieces of the proofs.
