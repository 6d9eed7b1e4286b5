//! The groups of results (the report's "Output", items 1 to 7, and what we add).
//!
//! Field names end in their unit; the word before it names the axes: `vehicle`, `segment`, `space`, or `path` for the
//! report's vehicle-space axes (forward, right, down).

mod belt;
mod checkpoint;
mod energy;
mod instruments;
mod joint_load;
mod joints;
mod report_coordinates;
mod segment;
mod solver;
mod sphere;
mod vehicle;

pub use belt::BELT;
pub use checkpoint::CHECKPOINT;
pub use energy::ENERGY;
pub use instruments::INSTRUMENTS;
pub use joint_load::JOINT_LOAD;
pub use joints::JOINTS;
pub use report_coordinates::REPORT_COORDINATES;
pub use segment::SEGMENT;
pub use solver::SOLVER;
pub use sphere::SPHERE;
pub use vehicle::VEHICLE;

use super::column::Group;

/// All groups.
pub const ALL: [&Group; 11] = [
    &VEHICLE,
    &SEGMENT,
    &SPHERE,
    &BELT,
    &JOINTS,
    &JOINT_LOAD,
    &INSTRUMENTS,
    &ENERGY,
    &SOLVER,
    &REPORT_COORDINATES,
    &CHECKPOINT,
];
