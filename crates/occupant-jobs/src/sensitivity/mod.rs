//! Derivatives of a scenario's run: request, analysis, text, JSON and histories. Writes no file.

mod analysis;
mod answer;
mod history;
mod text;
mod units;

pub use analysis::{Words, analyse, ask};
pub use answer::answer;
pub use history::{about, histories};
pub use text::text;
