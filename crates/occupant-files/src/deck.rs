//! A card deck in the place of a scenario: it is converted in memory.

use std::path::{Path, PathBuf};

use cardio_legacy::{CompartmentLayout, Conversion, ConvertOptions, Deck, ParseOptions, Plot};

use crate::base::{Failure, file_name, input_file};

/// A deck converted to a scenario.
#[derive(Clone, Debug)]
pub struct FromDeck {
    /// The scenario.
    pub toml: String,
    /// Conversion report.
    pub words: String,
    /// Whether its plot card asks for the standard plots.
    pub wants_plots: bool,
}

/// Whether a file without the extension of a scenario contains a deck.
pub fn is_deck(bytes: &[u8]) -> bool {
    Deck::is_likely(bytes)
}

/// File in a deck's folder with the compartment, which cards do not define.
const COMPARTMENT: &str = "compartment.toml";

/// Layout of a compartment: which surfaces the points of series 8 bound, and the position of the wheel.
///
/// # Errors
/// A file that cannot be read, or is no layout.
pub fn compartment(path: &Path) -> Result<CompartmentLayout, Failure> {
    let text = String::from_utf8(input_file::read(path)?)
        .map_err(|_| Failure::plain(format!("{} is not UTF-8 text", path.display())))?;
    CompartmentLayout::from_toml(&text).map_err(|reason| Failure::plain(format!("{}: {reason}", path.display())))
}

/// The compartment file in a deck's folder, if any.
pub fn compartment_beside(deck: &Path) -> Option<PathBuf> {
    let beside = deck.with_file_name(COMPARTMENT);
    (deck.is_file() && beside.is_file()).then_some(beside)
}

/// Reports the compartment of a conversion.
pub fn of_compartment(file: Option<&Path>) -> String {
    file.map_or(String::new(), |file| format!("its compartment comes from {}\n", file.display()))
}

/// The scenario of the only deck of a file, with the compartment file of its folder.
///
/// # Errors
/// Problems of the deck or its compartment; several decks, of which one is to be chosen; a path that the deck takes from disk.
pub fn from_deck(path: &Path, bytes: &[u8]) -> Result<FromDeck, Failure> {
    let name = path.display().to_string();
    let options = ParseOptions { file: name.clone(), ..ParseOptions::default() };
    let (decks, diagnostics) = Deck::parse(bytes, &options);
    if diagnostics.has_errors() {
        return Err(Failure::CouldNotRun(format!("{diagnostics}\n{name}: nothing was run")));
    }
    let [deck] = &decks[..] else {
        let found = format!("{name} contains {} decks", decks.len());
        let help =
            format!("convert each to a scenario with `occupant convert {name} -o NAME.toml`, and run them one by one");
        return Err(Failure::with_help(found, &help));
    };
    let beside = compartment_beside(path);
    let compartment = beside.as_deref().map(compartment).transpose()?;
    let options = ConvertOptions { deck_name: file_name(path), compartment, ..ConvertOptions::default() };
    let help = "`occupant convert` has options for such a deck; run the scenario that it writes";
    let converted = deck.to_scenario(&options).map_err(|error| Failure::with_help(format!("{name}: {error}"), help));
    let Conversion { toml, report } = converted?;
    let found = if diagnostics.is_empty() { String::new() } else { format!("{diagnostics}\n\n") };
    let words = format!(
        "{found}{name} is a card deck, converted in memory: {}\n{}{report}\n",
        deck.titles()[0],
        of_compartment(beside.as_deref())
    );
    Ok(FromDeck { toml, words, wants_plots: deck.plot() == Plot::Standard })
}
