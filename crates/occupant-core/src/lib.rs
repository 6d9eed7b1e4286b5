//! Occupant.

pub mod belt;
pub mod body;
pub mod joint;
pub mod material;
pub mod path;
pub mod problem;
pub mod report_coordinates;
pub mod scenario;
pub mod seating;
pub mod setup;
pub mod surface;
mod trig;
