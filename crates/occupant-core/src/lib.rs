//! Occupant.

pub mod path;
mod trig;
