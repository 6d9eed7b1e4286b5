//! A run: steps, output times, many runs side by side.
//!
//! [`simulate::simulate`] takes a model from its start to its end. With [`Run`] a program does the same itself: step to
//! a time, look, kick, change, save, continue, and give a vehicle's motion frame by frame ([`Run::push`]).

mod adaptive;
mod ahead;
mod bars;
pub mod batch;
mod changes;
mod corner;
mod course;
mod driving;
mod error;
mod fixed;
mod front;
mod impulse;
mod observers;
mod saved;
pub mod simulate;
mod switch;

pub(crate) use course::Course;
#[cfg(any(target_arch = "x86_64", test))]
pub(crate) use course::broken;
pub use driving::Run;
pub use error::RunError;
use fixed::Rear;
pub use fixed::{Step, Stretch};
use front::Front;
pub use switch::Jump;
use switch::Switches;
