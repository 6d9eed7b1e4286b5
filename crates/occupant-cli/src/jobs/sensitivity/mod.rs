//! Derivatives of a scenario's run: the request, the analysis, its words, JSON and histories. Writes no file.

mod analysis;
mod answer;
mod history;
mod text;
mod units;

pub(crate) use analysis::{Words, analyse, ask};
pub(crate) use answer::answer;
pub(crate) use history::{about, histories};
pub(crate) use text::text;
