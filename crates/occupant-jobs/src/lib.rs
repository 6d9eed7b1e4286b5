//! The jobs of the program: runs, sweeps, ensembles, fits, and the use of their results.
//!
//! A job takes its inputs as values and returns results and texts. It reads no command line and no terminal, so the
//! command, a notebook and a page can all use it. Its messages go to the `log`, its progress to the bar of the caller
//! ([`base::Show`]).
//!
//! Occupant risk from the motion of a car alone:
//!
//! ```
//! use occupant_jobs::risk::Report;
//! use occupant_scenario::{Format, Scenario};
//!
//! let text = r#"
//!     title = "Stop"
//!     time = { end = 0.3 }
//!     path = { kind = "pulse", shape = "square", speed = "50 km/h", delta_v = "50 km/h", duration = "100 ms" }
//!     body = { preset = "male50" }
//!     joints = { preset = "male50" }
//!     gravity = 0
//!
//!     [initial_state]
//!     q     = [0, 0, 2,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
//!     rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
//! "#;
//! let (setup, _) = Scenario::from_text(text, Format::Toml, "stop", &|file| Err(format!("no file {file}")))?.build()?;
//! let report = Report::of_run("stop", &setup, None).ok_or("a path that cannot be sampled")?;
//! let flail = report.risk.flail.expect("both accelerations are there");
//! assert!((flail.oiv_x_mps - 12.9).abs() < 0.1); // √(2 · 0.6 m · 138.9 m/s²)
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod base;
pub mod compare;
pub mod drive;
pub mod ensemble;
pub mod export;
pub mod extend;
pub mod files;
pub mod fit;
pub mod import;
pub mod instruments;
pub mod judged;
pub mod keys;
pub mod measures;
pub mod optimise;
pub mod plot;
pub mod print;
pub mod quoted;
pub mod rated;
pub mod report;
pub mod risk;
pub mod run;
pub mod seal;
pub mod search;
#[cfg(feature = "sensitivity")]
pub mod sensitivity;
pub mod study;
pub mod surface;
pub mod sweep;
pub mod templates;
pub mod view;
