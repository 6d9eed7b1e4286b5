//! Derivatives of a scenario's run: what was asked, what came of it, how it is told.

mod analysis;
mod answer;
mod history;
mod text;
mod units;

pub use analysis::{Analysis, Asked, Words, analyse, ask};
pub use answer::Answer;
pub use history::{about, histories};
pub use text::text;
