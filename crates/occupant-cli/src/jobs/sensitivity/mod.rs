//! Derivatives of a scenario's run: what was asked, what came of it, how it is told. Writes no file.

mod analysis;
mod answer;
mod history;
mod text;
mod units;

pub(crate) use analysis::{Analysis, Asked, Words, analyse, ask};
pub(crate) use answer::Answer;
pub(crate) use history::{about, histories};
pub(crate) use text::text;
