//! Exact local sensitivities: how a run changes when a number of its scenario changes a little.
//!
//! The run is computed once more in dual numbers ([`occupant_core::motion::dual`]): every operation of the derivative
//! kernel and of the integrator carries derivatives along, so the derivative of the motion is exact to rounding and no
//! step size is chosen. The values have the bits of the plain run, whose steps it uses. A step that ends at an event
//! follows it when a parameter shifts it (`clock`); the choice of all other steps is not differentiated.
//!
//! ```text
//! scenario numbers ─ differences, extrapolated ─ constants and start ─ dual numbers ─ outputs ─ differences ─ figures
//! ```
//!
//! Before and after the motion there are closed functions: the constants of a model ([`Built`]), and the figures and
//! channels computed from outputs ([`measures`]). Their slopes are extrapolated differences; the difference of two
//! extrapolations is reported with each.
//!
//! A derivative describes an infinitely small change. Contacts that begin and end, springs that unload, belts that
//! tighten, stops of joints ([`events`]) limit its range; finite changes, run in full ([`finite`], [`verdict`]),
//! determine it.

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
