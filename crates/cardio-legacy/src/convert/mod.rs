//! Deck → scenario: the TOML text that a person would have written for the same case.
//!
//! Numbers keep the card's digits; comments say which card each block came from. What the cards leave open and this
//! crate decides stands in the [`Report`], and so does what a scenario has no place for; the latter is also written into
//! the scenario's notes (see [`crate::notes`]), so that the way back gives the same deck.

mod body;
mod compartment;
mod head;
mod joints;
mod motion;
mod path;
mod report;
mod writer;

use occupant_scenario::Format;
use occupant_scenario::{Diagnostics as ScenarioDiagnostics, Loaded, Scenario};
use thiserror::Error;

pub use path::PathSource;
pub use report::Report;

use crate::compartment::CompartmentLayout;
use crate::deck::Deck;
use writer::Writer;

/// Options of a conversion.
#[derive(Debug, Clone, PartialEq)]
pub struct ConvertOptions {
    /// Name of the deck, for the comment at the head of the scenario.
    pub deck_name: String,
    /// Vehicle path for a deck with MREAD ≠ 0.
    pub path: Option<PathSource>,
    /// Points that bound the surfaces, and position of the wheel; `None` for the built-in reconstruction.
    pub compartment: Option<CompartmentLayout>,
    /// Initial position of a body seated by the deck (NPOS = 0).
    pub seating: DeckSeating,
}

impl Default for ConvertOptions {
    fn default() -> Self {
        Self { deck_name: "deck".into(), path: None, compartment: None, seating: DeckSeating::default() }
    }
}

/// Initial position of a body seated by a deck. The report states only that the force–deformation properties of the
/// seat determine it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DeckSeating {
    /// Balanced: the rigid body, in the cards' posture, is placed such that all contacts carry its weight.
    #[default]
    Balanced,
    /// By the pelvis sphere alone, exactly in the cards' posture: forces of thighs, chest and feet remain unbalanced.
    Pelvis,
}

/// A scenario made from a deck.
#[derive(Debug, Clone, PartialEq)]
pub struct Conversion {
    /// The scenario, TOML.
    pub toml: String,
    /// Assumptions, omissions and counts.
    pub report: Report,
}

/// Reason why a deck cannot be converted to a scenario.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ConversionError {
    /// MREAD ≠ 0 without a path.
    #[error(
        "the deck takes {stations} stations of the vehicle's path from disk (MREAD on card 3), expected that path; give it \
         with --path file, as CSV or as cards of series 12"
    )]
    PathNeeded {
        /// Number of stations by MREAD.
        stations: f64,
    },
    /// The path file cannot be used.
    #[error("the path of the vehicle cannot be read: {0}")]
    Path(String),
    /// The compartment's data file cannot be used.
    #[error("the compartment's data file cannot be used: {0}")]
    Compartment(String),
    /// Missing field that the conversion needs.
    #[error("the deck has no field {0}, which the conversion needs")]
    MissingField(String),
    /// The resulting scenario is invalid: the deck's numbers contradict each other in a way that only the scenario
    /// check finds.
    #[error("the scenario made from the deck is refused:\n{0}")]
    Refused(Box<ScenarioDiagnostics>),
}

impl Deck {
    /// Scenario of this deck.
    ///
    /// # Errors
    /// A path that is missing or unreadable, a scenario that the format refuses.
    pub fn to_scenario(&self, options: &ConvertOptions) -> Result<Conversion, ConversionError> {
        let layout = CompartmentLayout::or_reconstruction(options.compartment.as_ref());
        let layout = layout.map_err(ConversionError::Compartment)?;
        let path = path::read(self, options.path.as_ref())?;
        let mut writer = Writer::new(self);
        if options.path.is_some() && self.value("MREAD") == Some(0.0) {
            let text = "the path file: MREAD = 0 (card 3) takes the vehicle's path from series 12";
            writer.report.ignored.push(text.to_owned());
        }
        head::write(&mut writer, options, &layout);
        path.write(&mut writer);
        body::write(&mut writer);
        joints::write(&mut writer);
        motion::write(&mut writer, &layout, options.seating);
        compartment::write(&mut writer, &layout);
        let mut conversion = writer.finish()?;
        let loaded = check(&conversion.toml, path.beside())?;
        if self.has_series(14) {
            conversion.report.ignored.extend(pairs_apart(&loaded));
        }
        Ok(conversion)
    }
}

/// Reads the text as the program will, so that no invalid scenario is returned.
fn check(toml: &str, beside: Option<&str>) -> Result<Loaded, ConversionError> {
    let resolver = |name: &str| match beside {
        Some(text) => Ok(text.as_bytes().to_vec()),
        None => Err(format!("there is no file {name}")),
    };
    let refused = |diagnostics| ConversionError::Refused(Box::new(diagnostics));
    let loaded = Scenario::from_text(toml, Format::Toml, "converted scenario", &resolver).map_err(refused)?;
    loaded.build().map_err(refused)?;
    Ok(loaded)
}

/// Pairs of series 14 that do not overlap at the start, as text; known only after placing the body.
fn pairs_apart(loaded: &Loaded) -> Option<String> {
    let (_, warnings) = loaded.model().ok()?;
    let apart = warnings.iter().find(|warning| warning.problem.path == "initial_state.passed")?;
    Some(format!("series 14, {}", apart.problem.found))
}
