//! Sampled signals: checks, resultants, integrals, averages, filters, resampling.
//!
//! A signal is a slice of values with one sample interval `dt_s`; sample `i` stands at time
//! `i·dt_s`, and every time a function returns counts from the first sample. Between samples a
//! signal is taken as the straight line through them, here and in [`crate::measure`], so integrals,
//! averages and crossings are those of that line and not of a staircase. Nothing here knows the
//! simulator: the same functions serve a run and a recorded test.

pub mod cfc;
pub mod error;
pub mod flaws;
pub mod integral;
pub mod low_pass;
pub mod moving_average;
pub mod resample;
pub mod resultant;
pub mod smooth;

mod check;

pub use cfc::{CfcFamily, ChannelClass, cfc_coefficients, filter_cfc};
pub(crate) use check::{require_positive, require_same_length, require_samples};
pub use check::{uniform_interval, whole_steps};
pub use error::SignalError;
pub use flaws::{Hole, Plateau, bridged, holes, is_sampled, plateau, resolution, rounding_noise, usual_interval};
pub use integral::{CumulativeIntegral, integrate};
pub use low_pass::{Continuation, LowPass};
pub use moving_average::{MovingAverage, WindowExtreme, moving_average};
pub use resample::{Interpolant, Interpolation, resample};
pub use resultant::{resultant, resultant2};
pub use smooth::smooth;

/// Standard acceleration of gravity, m/s²: the "g" of every criterion stated in g.
pub const STANDARD_GRAVITY_MPS2: f64 = 9.806_65;
