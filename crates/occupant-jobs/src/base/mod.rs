//! What every job may lean on: what it says and shows, how it is stopped, text tables, units; and the base of the library of
//! files.

pub mod interrupt;
pub mod progress;
pub mod talk;
pub mod text_table;
pub mod units;

pub use interrupt::Interrupt;
pub use occupant_files::base::*;
pub use progress::Show;
pub use talk::{json, note, say};
pub use units::{Told, Units};
