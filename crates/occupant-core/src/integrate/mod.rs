//! Integrators: they know a rate of change, and nothing of bodies, contacts or belts.

pub mod dormand_prince;
pub mod rk4;
