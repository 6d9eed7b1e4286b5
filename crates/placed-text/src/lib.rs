//! Texts that inputs are made of: TOML and JSON as one tree whose values know their places, paths into it, lines of CSV,
//! and messages that point at the words they are about. Knows no key of any section and no simulator; reads no files, prints
//! nothing.
//!
//! Without the feature `documents` there are messages alone: what computes has problems to tell, and reads no text.
//!
//! ```
//! # #[cfg(feature = "documents")]
//! # fn main() -> Result<(), placed_text::Diagnostics> {
//! use placed_text::{Document, Format, Problem};
//!
//! let text = "title = \"Stop\"\nspeed = \"20 mhp\"\n";
//! let document = Document::read(text, Format::Toml, "my.toml")?;
//! assert_eq!(document.root.get("title").and_then(|title| title.as_str()), Some("Stop"));
//!
//! let problem = Problem::error("speed", "`mhp` is no unit", "a speed such as \"20 mph\"");
//! assert!(document.place(problem).to_string().contains("my.toml:2:9"));
//! # Ok(())
//! # }
//! # #[cfg(not(feature = "documents"))]
//! # fn main() {}
//! ```

#![cfg_attr(not(feature = "documents"), allow(dead_code, reason = "what messages of documents need"))]

#[cfg(feature = "documents")]
mod csv;
#[cfg(feature = "documents")]
mod diagnostic;
#[cfg(feature = "documents")]
mod document;
#[cfg(feature = "documents")]
mod encoding;
#[cfg(feature = "documents")]
mod json;
mod nearest;
#[cfg(feature = "documents")]
mod node;
#[cfg(feature = "documents")]
mod path;
mod problem;
#[cfg(feature = "documents")]
mod reader;
mod shown;
#[cfg(feature = "documents")]
mod source;
#[cfg(feature = "documents")]
mod toml;

#[cfg(feature = "documents")]
pub use csv::{CELL, Cell, MOST_CELLS, Separator, TextTable, is_missing, lines, name_and_unit};
#[cfg(feature = "documents")]
pub use diagnostic::{Diagnostic, Diagnostics};
#[cfg(feature = "documents")]
pub use document::{Document, refuse, table_text, text_of};
#[cfg(feature = "documents")]
pub use encoding::decoded;
pub use nearest::nearest;
#[cfg(feature = "documents")]
pub use node::{Entry, Format, Node, Table, Value, Written};
#[cfg(feature = "documents")]
pub use path::{Step, child, children, follow, locate, parse as parse_path, targets, to_text, with_step};
pub use problem::{Problem, Problems, Severity, with_key};
pub use shown::{number, plain, shortened, shown, trimmed, without_zeros};
#[cfg(feature = "documents")]
pub use source::{Position, SourceId, Sources, Span};
#[cfg(feature = "documents")]
pub use toml::parse_value;

/// Largest number of names shown from a long list.
const NAMES: usize = 40;

/// `"a", "b" or "c"`; the first of a long list.
pub fn one_of(names: &[&str], quote: char) -> String {
    match names {
        [] => "no key at all".to_owned(),
        [only] => format!("{quote}{only}{quote}"),
        [first @ .., last] if names.len() <= NAMES => format!("{} or {quote}{last}{quote}", quoted(first, quote)),
        _ => format!("{} or one of {} more", quoted(&names[..NAMES], quote), names.len() - NAMES),
    }
}

/// `"a", "b", "c"`.
pub fn quoted(names: &[&str], quote: char) -> String {
    let each: Vec<String> = names.iter().map(|n| format!("{quote}{n}{quote}")).collect();
    each.join(", ")
}

/// Start of a hint with a name.
const DID_YOU_MEAN: &str = "did you mean";

/// Hint with the most similar name to a misspelt one.
pub fn did_you_mean(word: &str, names: &[&str], quote: char) -> Option<String> {
    nearest(word, names.iter().copied()).map(|n| format!("{DID_YOU_MEAN} {quote}{n}{quote}?"))
}
