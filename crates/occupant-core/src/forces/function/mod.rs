//! Force functions: a force over a deformation x ≥ 0, with a memory of only the largest x.
//!
//! One curve ([`Function`]) is used for webbing, limiters, stops of joints and contact. Contact adds other ways of
//! unloading, a spike, and factors of speed ([`ForceDeflection`]). Tables that are not force curves are `steps::Steps`.

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
