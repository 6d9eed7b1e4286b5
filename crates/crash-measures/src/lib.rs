//! Signals and measures of crash tests: channel filters, injury and occupant-risk measures with their limits, correlation
//! ratings. Knows no simulator: everything is computed from evenly sampled time histories in SI units.

pub mod correlation;
pub mod injury;
pub mod measure;
pub mod signal;
