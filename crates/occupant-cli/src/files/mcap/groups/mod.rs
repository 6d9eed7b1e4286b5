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

pub(crate) use belt::BELT;
pub(crate) use checkpoint::CHECKPOINT;
pub(crate) use energy::ENERGY;
pub(crate) use instruments::INSTRUMENTS;
pub(crate) use joint_load::JOINT_LOAD;
pub(crate) use joints::JOINTS;
pub(crate) use report_coordinates::REPORT_COORDINATES;
pub(crate) use segment::SEGMENT;
pub(crate) use solver::SOLVER;
pub(crate) use sphere::SPHERE;
pub(crate) use vehicle::VEHICLE;

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
