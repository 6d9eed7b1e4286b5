//! Occupant.

pub mod belt;
pub mod body;
pub mod compartment;
pub mod diagnosis;
pub mod energy;
pub mod integrate;
pub mod joint;
pub mod kernel;
pub mod material;
pub mod measure;
pub mod model;
pub mod path;
pub mod problem;
pub mod recorder;
pub mod report_coordinates;
pub mod sample;
pub mod scenario;
pub mod seat;
pub mod seating;
pub mod settle;
pub mod setup;
pub mod signal;
pub mod simulate;
pub mod summary;
pub mod surface;
mod trig;
mod validate;
