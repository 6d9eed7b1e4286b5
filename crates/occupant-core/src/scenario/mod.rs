//! Scenarios: what a person writes, read with places, checked, and turned into the core's plain data.
//!
//! ```text
//! text ─ Draft (overrides) ─ check against the schema ─ Loaded ─ build ─ Setup
//! ```

mod build;
mod check;
pub mod diagnostic;
pub mod document;
mod draft;
mod expand;
mod json;
pub mod kind;
mod loaded;
pub mod model;
mod nearest;
mod number_table;
mod overrides;
pub mod path_text;
pub mod quantity;
mod schema;
pub mod source;
mod toml_text;
pub mod unit;
mod view;

pub use diagnostic::{Diagnostic, Diagnostics};
pub use document::Format;
pub use draft::Draft;
pub use loaded::{Loaded, Resolver};
pub use model::Scenario;
pub use schema::schema;

#[cfg(test)]
mod tests;
