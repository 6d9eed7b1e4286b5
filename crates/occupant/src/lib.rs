//! People in a car during a crash or a violent manoeuvre: one crate to depend on.
//!
//! A case becomes a model, a model is run, a run gives results:
//!
//! ```
//! use occupant::prelude::*;
//!
//! # fn main() -> Result<(), Error> {
//! let mut case = Case::new("Drop", Occupant::male50());
//! let soil = case.material(Material::new("soil", BilinearSpring::linear(1e5, 0.3), 0.6)); // N/m, returned, friction
//! case.ground("ground", soil, 0.0); // height, m
//! case.standing_at([0.0, 0.0, 1.4]); // the upper end of the middle torso, m: the feet hang 0.3 m above the ground
//! case.ends_at(0.4); // s
//! let results = case.model()?.simulate()?;
//! assert!(results.measure(Hic15)? > 0.0);
//! assert_eq!(results.summary().contacts[0].surface, "ground");
//! # Ok(())
//! # }
//! ```
//!
//! - **A case** is built in code ([`Case::new`]) or read from TOML ([`Case::from_toml`], whose text [`Scenario`] can change).
//!   Ids are typed: a [`SurfaceId`] is no [`MaterialId`].
//! - **A run** goes to its end ([`Simulate::simulate`]) or is in your hands ([`Run`]): step, look, kick, save, clone. A vehicle that
//!   is not known beforehand is [told frame by frame](Run::push).
//! - **A force of your own** is a [`Force`]: plain numbers in, forces out.
//! - **Results** have measures by type ([`Hic15`]), figures and channels by name. A misspelt name is an [`Error`], never 0.
//!
//! Units are SI everywhere. Space axes are X′ forward, Y′ left, Z′ up; vehicle axes X forward, Y right, Z down.
//!
//! [`core`] is the simulator with everything that this page leaves out, [`scenario`] the text of cases, [`measures`] filters and
//! injury measures of any signal.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod case;
mod error;
mod ids;
mod measure;
mod motion;
mod occupant;
mod results;
mod text;

pub use case::Case;
pub use error::{Error, ErrorKind};
pub use ids::{BeltId, FrameId, MaterialId, SegmentId, SolidId, SphereId, SurfaceId};
pub use measure::*;
pub use occupant::{Occupant, Seat};
pub use results::{Log, Results, Simulate};
pub use text::Scenario;

pub use crash_measures as measures;
pub use occupant_core as core;
pub use occupant_core::forces::own::{Force, ForceChannel, Place, PointMotion, Pushes, Scene};
pub use occupant_core::model::Model;
pub use occupant_core::run::Run;
pub use occupant_scenario as scenario;

#[cfg(any(feature = "mcap", feature = "parquet"))]
pub use occupant_files as files;

/// The usual imports.
pub mod prelude {
    pub use crate::measure::*;
    pub use crate::{
        BeltId, Case, Error, ErrorKind, Force, ForceChannel, FrameId, Log, MaterialId, Model, Occupant, Place, Pushes,
        Results, Run, Scenario, Scene, Seat, SegmentId, Simulate, SolidId, SphereId, SurfaceId,
    };
    pub use nalgebra::{Point3, Vector3};
    pub use occupant_core::body::Sex;
    pub use occupant_core::forces::belt::Belt;
    pub use occupant_core::forces::contact::material::Material;
    pub use occupant_core::forces::contact::surface::{Frame, Outline};
    pub use occupant_core::forces::spring::BilinearSpring;
    pub use occupant_core::model::accuracy::Accuracy;
    pub use occupant_core::model::setup::Integrator;
    pub use occupant_core::results::outcome::Status;
    pub use occupant_core::results::recorder::Recorder;
    pub use occupant_core::vehicle::{PulseShape, Strength, VehicleInput, VehicleMotion, VehiclePath, VehicleState};
    pub use occupant_units::unit::Unit;
}

/// Compiles the example of the package's front page.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
