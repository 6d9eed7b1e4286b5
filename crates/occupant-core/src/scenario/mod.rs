//! Scenarios: what a person writes, read with places, checked, and turned into the core's plain data.

mod check;
pub mod diagnostic;
pub mod document;
mod json;
pub mod kind;
pub mod model;
mod nearest;
pub mod path_text;
pub mod quantity;
mod schema;
pub mod source;
mod toml_text;
pub mod unit;
mod view;

pub use diagnostic::{Diagnostic, Diagnostics};
pub use document::Format;
pub use model::Scenario;
pub use schema::schema;
