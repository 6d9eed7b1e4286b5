//! Scenarios: what a person writes, read with places, checked, and turned into the core's plain data.
//!
//! ```text
//! text ─ Draft (overrides) ─ check against the schema ─ Loaded ─ build ─ Setup ─ Model
//! ```
//!
//! Problems never stop at the first: each stage reports everything it can find, with file, line and column.
//!
//! ```
//! use occupant_core::scenario::{Draft, Format};
//!
//! let text = r#"
//! title = "a scenario"
//! units = "in-lbf-s"
//! gravity = "9.81 m/s"
//! "#;
//! let mut draft = Draft::read(text, Format::Toml, "my.toml")?;
//! draft.set("time.end=200 ms")?;
//! let problems = draft.load(&|file| Err(format!("no file {file}"))).unwrap_err();
//! assert!(problems.to_string().starts_with(
//!     "error: `m/s` is not the unit of an acceleration
//!  --> my.toml:4:17"
//! ));
//! # Ok::<(), occupant_core::scenario::Diagnostics>(())
//! ```

mod build;
pub mod check;
mod check_groups;
mod check_references;
pub mod csv_text;
pub mod diagnostic;
pub mod document;
pub mod draft;
pub mod expand;
mod json;
pub mod kind;
pub mod loaded;
pub mod model;
mod number_table;
mod overrides;
pub mod path_text;
pub mod place;
pub mod quantity;
mod record_file;
pub mod schema;
pub mod source;
mod toml_text;
pub mod unit;
pub mod unit_expression;
mod view;
mod written;

pub use diagnostic::{Diagnostic, Diagnostics};
pub use document::Format;
pub use draft::Draft;
pub use loaded::{Loaded, Resolver};
pub use model::Scenario;
pub use record_file::{RecordFile, read_record};
pub use schema::schema;

#[cfg(test)]
mod tests;
