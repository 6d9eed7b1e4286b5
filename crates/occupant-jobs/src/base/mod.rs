//! Shared tools of all jobs: messages, progress, interruption, text tables, units, and the base of the library of
//! files.

pub mod describe;
pub mod interrupt;
pub mod progress;
pub mod shown;
pub mod talk;
pub mod text_table;
pub mod units;

pub use interrupt::Interrupt;
pub use occupant_files::base::*;
pub use progress::Show;
pub use talk::{json, note, say};
pub use units::{Told, Units};
