//! Shared pieces of the proofs.

#![allow(clippy::missing_panics_doc, reason = "a proof that fails panics")]

pub mod any_tree;
pub mod cart;
pub mod cases;
pub mod compartment;
pub mod core_side;
pub mod dropped;
pub mod free_run;
pub mod gas_bag;
pub mod golden;
pub mod measure;
pub mod mirror;
pub mod probe;
pub mod random;
pub mod reference;
pub mod rod;
pub mod room;
pub mod scene;
pub mod segment_motion;
pub mod space_state;
pub mod steps;
pub mod strap;

/// What the book shows of a measure of one's own compiles.
#[cfg(doctest)]
#[doc = include_str!("../../docs/guides/own-measure.md")]
struct OwnMeasure;
