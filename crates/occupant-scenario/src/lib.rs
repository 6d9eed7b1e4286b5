//! Scenarios: what a person writes, read with places, checked, and turned into the core's plain data.
//!
//! ```text
//! text ─ Draft (overrides) ─ check ─ sections ─ Loaded ─ plain data ─ Setup ─ Model
//! ```
//!
//! - [`placed_text`]: TOML, JSON and CSV with places, and messages that point at them;
//! - `kind`: what a number can be, and how a written one becomes SI;
//! - `check`: every value of the tree against the schema of the sections; quantities become SI here, once;
//! - `sections`: one file for each concept: its keys, and the plain data they come to;
//! - `expand`, `overrides`, `places`: presets and groups written out, values put and found by path.
//!
//! What it never does: read files, print, or compute anything that a run computes.
//!
//! ```text
//! `path.speed = "20 mph"` ─ Value ─ 8.9408 m/s in the tree ─ Quantity ─ PulseDefinition
//! ```
//!
//! Problems never stop at the first: each stage reports everything it can find, with file, line and column.
//!
//! ```
//! use occupant_scenario::{Draft, Format};
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
//! # Ok::<(), occupant_scenario::Diagnostics>(())
//! ```

mod check;
mod draft;
mod expand;
pub mod kind;
mod loaded;
mod overrides;
mod people;
mod places;
mod presets;
mod sections;

pub use check::{check_words, schema::schema_of};
pub use draft::Draft;
pub use expand::rival_path;
pub use loaded::{Loaded, Resolver};
pub use placed_text::{Diagnostic, Diagnostics, Format};
pub use places::{Place, Wanted};
pub use presets::preset_body;
pub use sections::{
    Angle, FRACTION, Length, NOT_NEGATIVE, POSITIVE, Quantity, Ratio, RecordFile, Scenario, Time, read_record, schema,
};

#[cfg(test)]
mod tests;
