//! Card decks of the 1970 occupant model: read, check, write, convert.
//!
//! Texas Transportation Institute Research Report 140-2 describes in its Appendix IV how its program was fed: sixteen
//! series of punched cards of 80 columns, and a final card. This crate reads such decks as the FORTRAN IV of an IBM
//! 360 read them, reports every problem at once with file, line, card, columns and remedy, and writes them back.
//!
//! ```
//! use cardio_legacy::{Deck, ParseOptions};
//!
//! let bytes = b"a title\nits second line\nFINI\n";
//! let (decks, diagnostics) = Deck::parse(bytes, &ParseOptions::default());
//! assert!(decks.is_empty());
//! assert!(diagnostics.has_errors());
//! println!("{diagnostics}");
//! ```
//!
//! | module or type | what |
//! |---|---|
//! | [`Deck`] | the numbers of one run by the report's names |
//! | [`Diagnostics`], [`Rule`], [`Strictness`] | what is wrong, under which rule, how gravely |
//! | [`layout`] | every field of every card as data |
//! | [`field`] | the field rules of FORTRAN IV |
//! | [`CompartmentLayout`] | which points bound which surface |
//!
//! The crate reads no files and prints nothing; no bytes make it panic.

mod back;
mod builder;
mod card;
mod card_number;
mod check;
mod columns;
mod compartment;
mod completeness;
mod convert;
mod deck;
mod diagnostic;
pub mod field;
mod field_reader;
mod kept;
pub mod layout;
mod reader;
mod rule;
mod series_reader;
mod write;

pub use back::{FromScenario, NoDeck, RunEnd, spine_rest};
pub use columns::Columns;
pub use compartment::{CompartmentLayout, Corner, Face, Wall, WheelLayout};
pub use convert::{Conversion, ConversionError, ConvertOptions, PathSource, Report};
pub use deck::{Deck, DeckCard, Difference, Number, ParseOptions, Plot};
pub use diagnostic::{Diagnostic, Diagnostics};
pub use rule::{Grade, Rule, Severity, Strictness};
pub use write::write_file;
