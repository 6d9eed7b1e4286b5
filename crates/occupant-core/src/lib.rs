//! Simulator of a car's occupant in a crash or a violent manoeuvre.
//!
//! The model is that of Texas Transportation Institute Research Report 140-2 (R. D. Young, 1970): a body of 12 rigid
//! segments with 31 degrees of freedom, 17 contact spheres, plane surfaces of a compartment, lap and torso belts, joint
//! dampers with stops and spinal springs, carried along by any three-dimensional path of the vehicle. The theory manual
//! (`docs/theory/` beside this crate's sources) holds every equation with its number, and every decision that is ours.
//!
//! This crate reads no files, prints nothing and does not panic on user data. Results do not depend on the number of
//! threads: one [`model::Model`] may be shared by all of them.
//!
//! # A run
//!
//! A [`scenario::Scenario`] is a TOML or JSON text; it becomes a [`setup::Setup`] (plain SI data) and that a
//! [`model::Model`] (checked, immutable). [`simulate::simulate`] runs it and hands every output time to a
//! [`recorder::Recorder`], which takes what it wants of the [`sample::Sample`].
//!
//! ```
//! use occupant_core::body::tti12::HEAD;
//! use occupant_core::results::recorder::Watch;
//! use occupant_core::results::sample::Sample;
//! use occupant_core::scenario::{Format, Scenario};
//! use occupant_core::run::simulate::{Status, simulate};
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
//!     drop_m = 2.0 - sample.state.t1.z;
//!     reading_m_s2 = sample.specific_force_m_s2(HEAD).norm();
//! }))?;
//!
//! assert_eq!(outcome.status, Status::Completed);
//! assert!((drop_m - 0.5 * 9.80665 * 0.5_f64.powi(2)).abs() < 1e-9); // g t²/2
//! assert!(reading_m_s2 < 1e-9); // an accelerometer reads nothing in free fall
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Notation
//!
//! | name | means |
//! |---|---|
//! | `_m`, `_m_s2`, `_rad`, `_n`, `_n_m`, `_j`, `_s`, … | SI unit of a number; there are no others inside the crate |
//! | space | X′ forward, Y′ left, Z′ up; gravity along −Z′ |
//! | segment axes | X ahead, Y to the occupant's left, Z up when standing upright; origin at the centre of gravity |
//! | vehicle axes | X_v forward, Y_v right, Z_v down; origin at the vehicle's centre of gravity |
//! | vehicle-space | X′_v forward, Y′_v right, Z′_v down, fixed; where the vehicle's path is given |
//! | T1 | upper end of the middle torso, the reference point of the body |
//! | lower end | the end that is lower when standing upright: the distal end of a limb |
//! | Eq. *n*, Fig. *n* | equation or figure of the report |
//!
//! # Where things are
//!
//! - what a run is made of, as plain data: [`body`], [`joint`], [`material`], [`surface`], [`belt`], [`path`], [`seating`],
//!   [`setup`]; as text: [`scenario`];
//! - before the first step: [`model`], [`compartment`], [`seat`], [`settle`];
//! - every step: [`kernel`] (the rate of change of the state), [`integrate`], [`simulate`];
//! - results: [`sample`], [`energy`], [`reaction`], [`report_coordinates`], [`channel`], [`recorder`], [`summary`];
//! - to go on with a run: [`checkpoint`];
//! - many runs: [`study`]; what a run changes by when a number changes: [`sensitivity`];
//! - of any time history: [`signal`], [`measure`], [`correlation`].

pub mod body;
pub mod diagnosis;
pub mod forces;
pub mod kernel;
pub mod model;
pub mod motion;
pub mod problem;
pub mod quantity;
pub mod results;
pub mod run;
pub mod scenario;
pub mod vehicle;
