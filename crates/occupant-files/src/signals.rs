//! Measured signals with the units of their files.

use std::path::PathBuf;

use occupant_units::unit::{Dimension, Scale, parse_heading};

use super::channel_code::Code;

/// All signals of a file or test.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The file.
    pub path: PathBuf,
    /// SHA-256 of the file, or of the test's channel files in sequence.
    pub sha256: String,
    /// The signals in the file's order.
    pub signals: Vec<Signal>,
    /// Assumptions made in reading it.
    pub notes: Vec<String>,
}

/// A measured signal.
#[derive(Clone, Debug)]
pub struct Signal {
    /// Column heading, or ISO-MME channel code; `2` for the second column of a table without headings.
    pub name: String,
    /// ISO-MME code.
    pub code: Option<Code>,
    /// Unit as written; none if the file gives none.
    pub unit: Option<String>,
    /// Its size and dimension; none also for an unknown unit.
    pub scale: Option<Scale>,
    /// Times, s, increasing.
    pub time_s: Vec<f64>,
    /// Values in the file's unit, NaN where missing.
    pub values: Vec<f64>,
    /// Its position, for messages.
    pub place: String,
}

/// A finite number, parsed.
pub(super) fn finite(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|value| value.is_finite())
}

/// Size and dimension of a unit as written; `-` and `1` are plain numbers.
pub fn scale_of(unit: &str) -> Option<Scale> {
    match unit.trim() {
        "-" | "1" | "–" => Some(Scale { dimension: Default::default(), factor: 1.0 }),
        unit => parse_heading(unit).ok(),
    }
}

/// Seconds per unit; none if it is no unit of time.
pub fn seconds_in(unit: &str) -> Option<f64> {
    let scale = parse_heading(unit).ok()?;
    (scale.dimension == Dimension::new(0, 0, 1, 0)).then_some(scale.factor)
}
