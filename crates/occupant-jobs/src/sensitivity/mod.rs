//! Derivatives of a scenario's run: the request, the analysis, its words, JSON and histories. Writes no file.

mod analysis;
mod answer;
mod history;
mod text;
mod units;

pub use analysis::{Words, analyse, ask};
pub use answer::answer;
pub use history::{about, histories};
pub use text::text;
