//! Simulator of a car's occupant in a crash or a violent manoeuvre.
//!
//! The model is that of Texas Transportation Institute Research Report 140-2 (R. D. Young, 1970): a body of 12 rigid
//! segments with 31 degrees of freedom, 17 contact spheres, plane surfaces of a compartment, lap and torso belts, joint
//! dampers with stops and spinal springs, in a vehicle that moves along any three-dimensional path. The theory manual
//! (`docs/theory/` beside this crate's sources) contains every equation with its number, and our decisions.
//!
//! This crate reads no files, prints nothing and does not panic on user data. Results do not depend on the number of
//! threads: all of them may share one [`model::Model`].
//!
//! # A run
//!
//! A run needs a [`model::setup::Setup`], plain SI data. It comes from code, or from the TOML or JSON of a scenario,
//! which the crate `occupant-scenario` reads; both have the same defaults. [`model::Model::new`] checks it and computes
//! the start; a model is immutable. [`run::simulate::simulate`] runs it and passes a [`results::sample::Sample`] at
//! every output time to a [`results::recorder::Recorder`], which takes what it needs.
//!
//! An occupant dropped onto the ground from a parked vehicle:
//!
//! ```
//! use nalgebra::{Point3, Vector3};
//! use occupant_core::body::Body;
//! use occupant_core::forces::contact::surface::{Facing, Frame, Outline, Surface};
//! use occupant_core::forces::contact::material::Material;
//! use occupant_core::forces::joint::Joints;
//! use occupant_core::forces::spring::BilinearSpring;
//! use occupant_core::model::{Model, seating::InitialPosture, setup::SetupBuilder};
//! use occupant_core::motion::report_coordinates::{DOF, ReportCoordinates};
//! use occupant_core::results::summary::Summarizer;
//! use occupant_core::run::simulate::simulate;
//! use occupant_core::vehicle::VehiclePath;
//!
//! let mut case = SetupBuilder::new("Drop", Body::male50(), Joints::male50());
//! let soil = case.material(Material::new("soil", BilinearSpring::linear(1e5, 0.3), 0.6)); // N/m, returned, friction
//! case.surface(Surface {
//!     name: "ground".into(),
//!     frame: Frame::Space,
//!     outline: Outline::Unbounded { point_m: Point3::origin(), axis: Vector3::z() },
//!     facing: Facing::Order,
//!     material: soil,
//!     spheres: None,
//! });
//!
//! let (mut q, rates) = ([0.0; DOF], [0.0; DOF]);
//! q[2] = 1.4; // height of T1, m: the feet hang 0.3 m above the ground
//! let standing = InitialPosture::Coordinates(Box::new(ReportCoordinates { q, rates }));
//! let model = Model::new(case.build(VehiclePath::parked(), standing, 0.4))?;
//!
//! let mut summarizer = Summarizer::new();
//! simulate(&model, &mut summarizer)?;
//! let summary = summarizer.summary(None).expect("the run has ended");
//! assert_eq!(summary.contacts[0].surface, "ground");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! To step a run yourself, or frame by frame, use a [`run::Run`]; for your own force a [`forces::own::Force`]. Programs
//! should depend on the crate `occupant`, which adds typed ids, one error and measures by type.
//!
//! `examples/case_in_code.rs` beside this crate's sources is a driver, a compartment, belts and a crash pulse without a
//! text. `occupant-scenario` has examples that start from a scenario: your own vehicle path (a
//! [`vehicle::VehicleMotion`]), your own recorder, many runs on all cores.
//!
//! # Notation
//!
//! | name | means |
//! |---|---|
//! | `_m`, `_m_s2`, `_rad`, `_n`, `_n_m`, `_j`, `_s`, … | SI unit of a number; there are no others inside the crate |
//! | space | X′ forward, Y′ left, Z′ up; gravity along −Z′ |
//! | segment axes | X forward, Y to the occupant's left, Z up when standing upright; origin at the centre of gravity |
//! | vehicle axes | X_v forward, Y_v right, Z_v down; origin at the vehicle's centre of gravity |
//! | vehicle-space | X′_v forward, Y′_v right, Z′_v down, fixed; where the vehicle's path is given |
//! | T1 | upper end of the middle torso, the reference point of the body |
//! | lower end | the end that is lower when standing upright: the distal end of a limb |
//! | Eq. *n*, Fig. *n* | equation or figure of the report |
//!
//! # Modules
//!
//! | module | contents |
//! |---|---|
//! | [`body`] | segments, joints, contact spheres: the occupant as data |
//! | [`vehicle`] | the vehicle's path: table, pulse, sensors, at rest, a program's own |
//! | [`forces`] | surfaces and contact, belts, joints: their data, laws and memory |
//! | [`motion`] | frames, state, kinematics, equations of motion, integrators; numbers as scalars, dual numbers and lanes |
//! | [`kernel`] | the rate of change of the state: motion and forces put together |
//! | [`model`] | [`model::setup`] and its builder; checks, seating, settling: everything before the first step |
//! | [`run`] | steps, output times, many runs side by side ([`run::batch`]) |
//! | [`results`] | samples, channels, reactions, energies, recorders, summaries, checkpoints to resume from |
//! | [`diagnosis`] | what will be simulated and whether the step suits it, before a run |
//!
//! Above this crate `occupant-scenario` has scenarios as text: units, presets, overrides, messages with line and
//! column; `occupant-study` has designs, searches and sensitivities of many runs, and the risk of a path alone; below
//! it `crash-measures` has filters and injury measures of any time history, and `placed-text` reads TOML, JSON and CSV
//! with positions and reports their mistakes.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod body;
pub mod diagnosis;
pub mod forces;
pub mod kernel;
pub mod model;
pub mod motion;
pub mod quantity;
pub mod results;
pub mod run;
pub mod vehicle;

#[cfg(test)]
extern crate self as occupant_core;
#[cfg(test)]
mod tests;

pub use placed_text::{Problem, Problems, Severity};
