//! Measures of injury and of occupant risk, from signals alone.
//!
//! Every function takes samples in SI with one interval, assumes the channel filtered as its page
//! says (see [`crate::signal`]), and returns a value with its unit in the name and the time where it
//! stands, counted from the first sample. Formulas were collected from open sources that cite the
//! standards; the standards themselves were not at hand, so nothing here claims to be their text.
//!
//! What a rigid thorax cannot give (rib deflection, viscous criterion) is not computed from a run.

pub mod hic;
pub mod three_ms;

pub use hic::{Hic, HicWindow, hic};
pub use three_ms::{
    ThreeMs, clip_contiguous, clip_cumulative, three_ms_contiguous, three_ms_cumulative,
};
