//! Force functions: a force over a deformation x ≥ 0, with a memory of the greatest x alone.
//!
//! One curve ([`Function`]) serves webbing, limiters, stops of joints and contact; contact adds other ways back, a spike, and
//! factors of speed ([`ForceDeflection`]). Tables that are no curves of force are `steps::Steps`.

pub(crate) mod cubic;
mod curve;
mod data;
mod deflection;
mod dissipation;
pub(crate) mod steps;

pub(crate) use cubic::Cubic;
pub use curve::FunctionLaw;
pub(crate) use data::Goes;
pub use data::{Beyond, ForceDeflection, Function, Shape, Unloading};
pub(crate) use deflection::DeflectionLaw;

#[cfg(test)]
mod tests;
