//! Scenarios: text that a person writes is read with positions, checked, and converted to the plain data of
//! [`occupant_core`].
//!
//! ```text
//! text ─ Draft (overrides) ─ check ─ sections ─ Loaded ─ plain data ─ Setup ─ Model
//! ```
//!
//! - [`placed_text`]: TOML, JSON and CSV with places, and messages that point at them;
//! - `kind`: what a number can be, and how a written one becomes SI;
//! - `check`: every value of the tree against the schema of the sections; quantities become SI here, once;
//! - `sections`: one file for each concept: its keys, and their conversion to plain data;
//! - `expand`, `overrides`, `places`: presets and groups written out, values set and found by path.
//!
//! It never reads files, prints, or computes anything that a run computes.
//!
//! ```text
//! `path.speed = "20 mph"` ─ Value ─ 8.9408 m/s in the tree ─ Quantity ─ PulseDefinition
//! ```
//!
//! A run from a text:
//!
//! ```
//! use occupant_core::body::tti12::HEAD;
//! use occupant_core::results::outcome::Status;
//! use occupant_core::results::recorder::Watch;
//! use occupant_core::results::sample::Sample;
//! use occupant_core::run::simulate::simulate;
//! use occupant_scenario::{Format, Scenario};
//!
//! // a standing body, let go two metres above the origin
//! let text = r#"
//!     title = "Free fall"
//!     time = { end = 0.5 }
//!     path = { kind = "fixed" }
//!     body = { preset = "male50" }
//!     joints = { preset = "male50" }
//!
//!     [initial_state]
//!     q     = [0, 0, 2,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
//!     rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
//! "#;
//! let no_files = |name: &str| Err(format!("{name}: there are no files here"));
//! let loaded = Scenario::from_text(text, Format::Toml, "free-fall", &no_files)?;
//! let (model, _warnings) = loaded.model()?;
//!
//! let (mut drop_m, mut reading_m_s2) = (0.0, f64::NAN);
//! let outcome = simulate(&model, Watch(|sample: &Sample<'_>| {
//!     drop_m = 2.0 - sample.state.t1().z;
//!     reading_m_s2 = sample.specific_force_m_s2(HEAD).norm();
//! }))?;
//!
//! assert_eq!(outcome.status, Status::Completed);
//! assert!((drop_m - 0.5 * 9.80665 * 0.5_f64.powi(2)).abs() < 1e-9); // g t²/2
//! assert!(reading_m_s2 < 1e-9); // an accelerometer reads nothing in free fall
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Problems never stop at the first: each stage reports everything it can find, with file, line and column.
//!
//! ```
//! use occupant_scenario::{Draft, Format};
//!
//! let text = r#"
//! title = "a scenario"
//! units = "in-lbf-s"
//! gravity = "9.81 m/s"
//! "#;
//! let mut draft = Draft::read(text, Format::Toml, "my.toml")?;
//! draft.set("time.end=200 ms")?;
//! let problems = draft.load(&|file| Err(format!("no file {file}"))).unwrap_err();
//! assert!(problems.to_string().starts_with(
//!     "error: `m/s` is not the unit of an acceleration
//!  --> my.toml:4:17"
//! ));
//! # Ok::<(), occupant_scenario::Diagnostics>(())
//! ```
//!
//! `examples/` beside this crate's sources are programs to start from; one that needs no text is in `occupant-core`:
//!
//! | example | shows |
//! |---|---|
//! | `scenario_from_text` | a scenario file, all its mistakes, the peaks of its run |
//! | `own_vehicle_path` | a program's own vehicle model as the path, an [`occupant_core::vehicle::VehicleMotion`] |
//! | `own_recorder` | a custom recorder, and a run that ends early |
//! | `sweep_with_rayon` | many runs on all cores |

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod car;
mod check;
mod draft;
mod dummies;
pub mod ending;
mod expand;
pub mod kind;
mod living;
mod loaded;
mod overrides;
mod passes;
mod people;
mod places;
mod presets;
mod ready;
mod sections;
mod surface_files;

pub use car::{Dimension, Size, Usual};
pub use check::{check_words, schema::schema_of};
pub use draft::{Draft, names_file};
pub use expand::rival_path;
pub use loaded::{Loaded, Resolver};
pub use placed_text::{Diagnostic, Diagnostics, Format};
pub use places::{Place, Wanted};
pub use presets::preset_body;
pub use sections::{
    Angle, Drawing, DrivenVehicle, Drives, FRACTION, Length, NOT_NEGATIVE, POSITIVE, Quantity, Ratio, RecordFile,
    Scenario, Solved, Time, column_in, column_named, drawings, folded, moving_rails, read_record, schema, speed_named,
    surface_schema,
};
pub use surface_files::check_surface;

#[cfg(test)]
mod tests;
