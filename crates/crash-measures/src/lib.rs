//! Signals and measures of crash tests: channel filters, injury and occupant-risk measures with their limits, correlation
//! ratings. Knows no simulator: everything is computed from evenly sampled time histories in SI units.
//!
//! ```
//! use crash_measures::measure::hic::{HicWindow, hic};
//! use crash_measures::signal::{CfcFamily, ChannelClass, filter_cfc};
//!
//! // a half sine of 60 g over 30 ms, read at 10 kHz, m/s²
//! let dt_s = 1e-4;
//! let pulse = |t: f64| if t < 0.03 { 60.0 * 9.80665 * (t / 0.03 * std::f64::consts::PI).sin() } else { 0.0 };
//! let reading: Vec<f64> = (0..1000).map(|i| pulse(f64::from(i) * dt_s)).collect();
//!
//! let filtered = filter_cfc(&reading, dt_s, ChannelClass::Cfc1000, CfcFamily::SaeJ211)?;
//! let hic15 = hic(&filtered, dt_s, HicWindow::Ms15)?;
//! assert!((hic15.value - 322.0).abs() < 2.0); // 15 ms of (0.90 · 60 g)^2.5
//! assert!((hic15.start_s - 7.5e-3).abs() < 3e-4);
//!
//! // what cannot be is an error with words
//! assert!(hic(&[f64::NAN; 10], dt_s, HicWindow::Ms15).is_err());
//! # Ok::<(), crash_measures::signal::SignalError>(())
//! ```
//!
//! | room | holds |
//! |---|---|
//! | [`signal`] | filters by channel class, integrals, resultants, resampling |
//! | [`measure`] | HIC, 3 ms levels, Nij, chest, side, whiplash, legs, OIV, ORA, THIV, PHD, ASI, OLC; limits and risk curves |
//! | [`injury`] | all measures of an occupant from his instruments at once |
//! | [`rating`] | points, stars, grades and verdicts of crash tests from tables: Euro NCAP, US NCAP, IIHS, FMVSS, UN |
//! | [`correlation`] | ISO 18571, CORA, Sprague and Geers, ANOVA |

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod correlation;
pub mod injury;
pub mod measure;
pub mod rating;
pub mod signal;
