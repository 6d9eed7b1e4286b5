//! Contact of spheres with bounded plane surfaces.

mod assembly;
pub mod encounter;
pub mod face;
pub mod flat_face;
pub mod history;
pub mod surface;
mod system;

pub use system::*;
