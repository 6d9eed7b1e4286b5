//! Exact local sensitivities: how a run changes when a number of its scenario changes a little.
//!
//! The run is computed once more in dual numbers ([`occupant_core::motion::dual`]): every operation of the derivative kernel and
//! of the integrator carries derivatives along, so the derivative of the motion is exact to rounding and no step size is
//! chosen. The values are to the bit those of the plain run, on whose steps it goes. A step that ends at an event ends with it
//! when a parameter shifts it (`clock`); of all other steps the derivative of their choice is not taken.
//!
//! ```text
//! scenario numbers ─ differences, extrapolated ─ constants and start ─ dual numbers ─ outputs ─ differences ─ figures
//! ```
//!
//! Before and behind the motion stand closed functions: the constants that a model is built of ([`Built`]), and the
//! figures and channels that are made of outputs ([`measures`]). Their slopes are extrapolated differences, and how far
//! two extrapolations lie apart is reported with each.
//!
//! A derivative says what an infinitely small change does. Contacts that begin and end, springs that unload, belts that
//! tighten, stops of joints ([`events`]) limit how far that carries; finite changes, run in full ([`finite`], [`verdict`]), say how far.

mod built;
mod clock;
pub mod events;
pub mod finite;
mod ladder;
pub mod measures;
mod of_scenario;
mod parameter;
mod tangent;
mod trajectory;
mod trouble;
pub mod verdict;

pub use built::Built;
pub use ladder::Slope;
pub use of_scenario::parameter;
pub use parameter::{ModelAt, Parameter, fine_interval_s, size_of};
pub use trajectory::{Trajectory, follow, follow_watched};
pub use trouble::Trouble;
