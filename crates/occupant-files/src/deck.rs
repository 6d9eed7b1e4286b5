//! A card deck in the place of a scenario: it is converted in memory.

use std::path::Path;

use cardio_legacy::{Conversion, ConvertOptions, Deck, ParseOptions, Plot};

use crate::base::{Failure, file_name};

/// A deck that was read as a scenario.
pub struct FromDeck {
    /// The scenario.
    pub toml: String,
    /// What was found in the deck and assumed.
    pub words: String,
    /// Whether its plot card asks for the standard plots.
    pub wants_plots: bool,
}

/// Whether a file that is named like no scenario holds a deck.
pub fn is_deck(bytes: &[u8]) -> bool {
    Deck::is_likely(bytes)
}

/// The scenario of the only deck of a file.
///
/// # Errors
/// What is wrong with the deck; several decks, of which one is to be chosen; a path that the deck takes from disk.
pub fn from_deck(path: &Path, bytes: &[u8]) -> Result<FromDeck, Failure> {
    let name = path.display().to_string();
    let options = ParseOptions { file: name.clone(), ..ParseOptions::default() };
    let (decks, diagnostics) = Deck::parse(bytes, &options);
    if diagnostics.has_errors() {
        return Err(Failure::CouldNotRun(format!("{diagnostics}\n{name}: nothing was run")));
    }
    let [deck] = &decks[..] else {
        let found = format!("{name} holds {} decks", decks.len());
        let help = format!("occupant convert {name} -o NAME.toml makes a scenario of each, to be run one by one");
        return Err(Failure::with_help(found, &help));
    };
    let options = ConvertOptions { deck_name: file_name(path), ..ConvertOptions::default() };
    let help = "occupant convert has options for such a deck, and writes a scenario to be run";
    let converted = deck.to_scenario(&options).map_err(|error| Failure::with_help(format!("{name}: {error}"), help));
    let Conversion { toml, report } = converted?;
    let found = if diagnostics.is_empty() { String::new() } else { format!("{diagnostics}\n\n") };
    let words = format!("{found}{name} is a card deck, converted in memory: {}\n{report}\n", deck.titles()[0]);
    Ok(FromDeck { toml, words, wants_plots: deck.plot() == Plot::Standard })
}
