//! Card decks of the 1970 occupant model: read, check, write, convert.
//!
//! Texas Transportation Institute Research Report 140-2 describes in its Appendix IV how its program was fed: sixteen
//! series of punched cards of 80 columns, and a final card. This crate reads such decks as the FORTRAN IV of an IBM
//! 360 read them, reports every problem at once with file, line, card, columns and remedy, and writes them back.
//!
//! ```
//! use cardio_legacy::{ConvertOptions, Deck, ParseOptions};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let bytes = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/driver.dat"))?;
//! // Read: every problem of the file is in the diagnostics; a deck with an error is not handed out.
//! let (decks, diagnostics) = Deck::parse(&bytes, &ParseOptions::default());
//! assert!(!diagnostics.has_errors(), "{diagnostics}");
//! let deck = &decks[0];
//! assert_eq!(deck.value("XLE(3)"), Some(13.71));
//!
//! // Convert: TOML as a person would have written it, and what was assumed.
//! let conversion = deck.to_scenario(&ConvertOptions::default())?;
//! assert!(conversion.toml.contains("head.length = \"13.71 in\""));
//! assert!(conversion.report.to_string().contains("steering wheel"));
//!
//! // Write: the normalised form.
//! assert!(deck.write().starts_with("DRIVER WITH LAP AND TORSO BELT"));
//! # Ok(())
//! # }
//! ```
//!
//! | type or module | what |
//! |---|---|
//! | [`Deck`] | the numbers of one run by the report's names: [`Deck::parse`], [`Deck::write`], [`Deck::to_scenario`], [`Deck::from_scenario`], [`Deck::extended`] |
//! | [`Diagnostics`], [`Rule`], [`Strictness`] | what is wrong, under which rule, how gravely |
//! | [`Conversion`], [`Report`] | a scenario made from a deck; what was assumed, not used, blank |
//! | [`FromScenario`], [`NoDeck`] | a deck made from a scenario; what does not fit on cards |
//! | [`cards`] | every field of every card as data: columns, unit, meaning |
//! | [`fortran`] | the field rules of FORTRAN IV |
//! | [`CompartmentLayout`] | which points bound which surface, from `compartment.toml` |
//!
//! The sources by room, each using only those before it (`tests/rooms.rs`): `rule`, `punched` (80 columns), `fortran`
//! (fields), `cards` (the table, a file for each series: what card 7 means stands in `cards/card_07_spheres.rs`), `deck`,
//! `compartment`, `notes`, `diagnostics`, `check`, `read`, `write`, `convert` (deck → scenario), `back` (scenario → deck), `print` (a run as the printout of 1970).
//!
//! # Rules that hold for any bytes
//!
//! Two fuzz targets (`fuzz/`, which says how to run them and what has been run) assert them; `tests/any_bytes.rs` and
//! `tests/round_trips.rs` assert them for a fixed set of bytes.
//!
//! 1. In every strictness, [`Deck::parse`] comes to an end without a panic, and its diagnostics can be printed.
//! 2. It hands out a deck, or its diagnostics hold an error, or both; it is never silent about a file without a deck.
//! 3. A deck that it hands out can be written. [`write_file`]'s cards are read again without an error, and the deck read from
//!    them has no [differences](Deck::differences) from the first one.
//! 4. [`Deck::to_scenario`] gives a scenario or an error. The scenario is accepted and built by the scenario format.
//! 5. [`Deck::from_scenario`] finds that such a scenario fits on cards, and gives a deck without differences from
//!    [`Deck::normalised`]: every number of every field that has an effect comes back as the same number.
//!
//! The crate reads no files and prints nothing. `docs/cards.md` holds the tables of all cards, the
//! decisions where the report is silent, and what becomes of each card in a scenario.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod back;
pub mod cards;
mod check;
mod compartment;
mod convert;
mod deck;
mod diagnostics;
pub mod fortran;
mod notes;
pub mod print;
mod punched;
mod read;
mod rule;
mod write;

pub use back::{FromScenario, NoDeck, RunEnd, passed_pairs, spine_rest};
pub use compartment::{CompartmentLayout, Corner, Face, Wall};
pub use convert::{Conversion, ConversionError, ConvertOptions, DeckSeating, PathSource, Report};
pub use deck::{Deck, DeckCard, Difference, Number, Plot};
pub use diagnostics::{Diagnostic, Diagnostics};
pub use punched::Columns;
pub use read::ParseOptions;
pub use rule::{Grade, Rule, Severity, Strictness};
pub use write::write_file;
