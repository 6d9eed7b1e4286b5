//! Integrators: they know a rate of change, and nothing of bodies, contacts or belts.

pub mod bogacki_shampine;
pub mod rk4;
