//! Occupant.

pub mod belt;
pub mod body;
pub mod compartment;
pub mod energy;
pub mod integrate;
pub mod joint;
pub mod kernel;
pub mod material;
pub mod model;
pub mod path;
pub mod problem;
pub mod recorder;
pub mod report_coordinates;
<<<<<<< HEAD
pub mod scenario;
pub mod seating;
pub mod setup;
=======
pub mod sample;
pub mod seat;
pub mod seating;
pub mod settle;
pub mod setup;
pub mod simulate;
>>>>>>> main
pub mod surface;
mod trig;
mod validate;
