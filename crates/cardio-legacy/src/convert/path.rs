//! The vehicle's path: series 12, or a file where MREAD ≠ 0.

use super::ConversionError;
use super::writer::{Writer, quoted};
use crate::cards::{Field, series};
use crate::deck::{Deck, DeckCard};
use crate::fortran::read_real;
use crate::punched::PunchedCard;

/// Source of the path for a deck with MREAD ≠ 0. The vehicle program's own file format is undocumented.
#[derive(Debug, Clone, PartialEq)]
pub enum PathSource {
    /// CSV file whose first line gives columns and units: `t[s],x[in],y[in],z[in],roll[deg],pitch[deg],yaw[deg]`, in
    /// any order. The scenario refers to the file by its name.
    Csv {
        /// Name of the file in the scenario.
        name: String,
        /// Its text.
        text: String,
    },
    /// File of plain numbers, separated by commas or blanks, with its columns and units given separately.
    Columns {
        /// Name and unit of each column, such as `t[ms]`.
        columns: Vec<String>,
        /// Its text.
        text: String,
    },
    /// Cards of series 12b, one per station.
    Cards {
        /// Their text.
        text: String,
    },
}

/// A path ready for output.
pub(super) enum Path {
    /// In the scenario itself.
    Rows { columns: Vec<String>, rows: Vec<Vec<String>>, from: &'static str },
    /// In a file beside it.
    Beside { name: String, text: String },
}

/// The path of a deck.
pub(super) fn read(deck: &Deck, source: Option<&PathSource>) -> Result<Path, ConversionError> {
    let stations = deck.value("MREAD").unwrap_or(0.0);
    if stations == 0.0 {
        let digits = |card: &DeckCard| card.numbers.iter().map(|n| n.digits.clone()).collect();
        let rows = deck.cards_of(12, 'b').map(digits).collect();
        let from = "Series 12, cards b: CALT, CALX, CALY, CALZ, CALPH, CALTH, CALPS";
        return Ok(Path::Rows { columns: card_columns(), rows, from });
    }
    let wanted = stations as usize;
    let (columns, rows, from) = match source.ok_or(ConversionError::PathNeeded { stations })? {
        PathSource::Csv { name, text } => {
            let (columns, rows) = csv(text)?;
            if rows.len() == wanted {
                return Ok(Path::Beside { name: name.clone(), text: text.clone() });
            }
            (columns, rows, "The path file: the first stations, as many as MREAD says")
        }
        PathSource::Columns { columns, text } => {
            (columns.clone(), plain_rows(text, columns.len())?, "The path file, columns as declared")
        }
        PathSource::Cards { text } => {
            (card_columns(), card_rows(text)?, "The path file, in the card format of series 12")
        }
    };
    Ok(Path::Rows { columns, rows: first(rows, wanted)?, from })
}

/// Fields of a station on cards of series 12.
fn station_fields() -> impl Iterator<Item = &'static Field> {
    series(12).and_then(|series| series.cards.get(1)).into_iter().flat_map(|card| &card.fields)
}

/// Name and unit of a column for each field of a station.
fn card_columns() -> Vec<String> {
    let name = |field: &'static Field| field.key.as_deref().and_then(|key| key.rsplit('.').next()).unwrap_or_default();
    station_fields().map(|field| format!("{}[{}]", name(field), field.unit.in_scenarios)).collect()
}

/// Columns and rows of a CSV file whose first line names the columns.
fn csv(text: &str) -> Result<(Vec<String>, Vec<Vec<String>>), ConversionError> {
    let mut lines = text.lines().filter(|line| !is_void(line));
    let header = lines.next().unwrap_or_default().trim_start_matches('\u{feff}');
    if !header.contains('[') {
        return Err(ConversionError::Path(format!(
            "its first line, `{header}`, names no columns with units such as t[s],x[in]; declare the columns otherwise"
        )));
    }
    let columns: Vec<String> = header.split(',').map(|c| c.trim().to_owned()).collect();
    let rows = plain_rows(&lines.collect::<Vec<_>>().join("\n"), columns.len())?;
    Ok((columns, rows))
}

/// Whether a line is blank or a comment.
fn is_void(line: &str) -> bool {
    line.trim().is_empty() || line.trim_start().starts_with('#')
}

/// The first `wanted` stations.
fn first(mut rows: Vec<Vec<String>>, wanted: usize) -> Result<Vec<Vec<String>>, ConversionError> {
    if rows.len() < wanted {
        let reason = format!("it has {} stations, MREAD on card 3 says {wanted}", rows.len());
        return Err(ConversionError::Path(reason));
    }
    rows.truncate(wanted);
    Ok(rows)
}

fn plain_rows(text: &str, columns: usize) -> Result<Vec<Vec<String>>, ConversionError> {
    let lines = text.lines().enumerate().filter(|(_, line)| !is_void(line));
    let numbered = |(at, line)| {
        plain_row(line, columns).map_err(|reason| ConversionError::Path(format!("line {}: {reason}", at + 1)))
    };
    lines.map(numbered).collect()
}

fn plain_row(line: &str, columns: usize) -> Result<Vec<String>, String> {
    let separator = |c: char| c == ',' || c == ';' || c.is_whitespace();
    let words: Vec<&str> = line.split(separator).filter(|w| !w.is_empty()).collect();
    if words.len() != columns {
        return Err(format!("{} numbers, expected {columns}", words.len()));
    }
    let number = |word: &&str| match word.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(format!("{value}")),
        _ => Err(format!("`{word}` is no number")),
    };
    words.iter().map(number).collect()
}

fn card_rows(text: &str) -> Result<Vec<Vec<String>>, ConversionError> {
    let cards = text.lines().enumerate().map(|(at, line)| PunchedCard::new(at + 1, line.as_bytes()));
    cards.filter(|card| !card.is_blank()).map(|card| card_row(&card)).collect()
}

fn card_row(card: &PunchedCard) -> Result<Vec<String>, ConversionError> {
    let digits = |columns| match read_real(card.field(columns)) {
        Ok(reading) => Ok(reading.digits),
        Err(_) => {
            let (line, text) = (card.line, card.text_of(columns));
            Err(ConversionError::Path(format!("line {line}, {columns}: `{text}` is no number in F10.0")))
        }
    };
    station_fields().map(|field| digits(field.columns)).collect()
}

impl Path {
    pub(super) fn write(&self, w: &mut Writer<'_>) {
        let stations = match self {
            Self::Rows { from, .. } => *from,
            Self::Beside { .. } => "The path file; MREAD on card 3 counts its stations",
        };
        w.table("path", &format!("{stations}.\nStraight lines between stations, as the report's POSVEH has them"));
        w.set("kind", "\"table\"");
        w.set("interpolation", "\"linear\"");
        match self {
            Self::Beside { name, .. } => w.set("file", &quoted(name)),
            Self::Rows { columns, rows, .. } => {
                let names: Vec<String> = columns.iter().map(|c| format!("\"{c}\"")).collect();
                w.set("columns", &format!("[{}]", names.join(", ")));
                let lines: String = rows.iter().map(|row| format!("    [{}],\n", row.join(", "))).collect();
                w.raw(&format!("rows = [\n{lines}]\n"));
            }
        }
        w.report.assumptions.push(
            "the vehicle's velocity is that of the interval between stations; the report moves the vehicle once a step, \
             this program at every stage of a step"
                .to_owned(),
        );
    }

    /// Text of the file beside the scenario.
    pub(super) fn beside(&self) -> Option<&str> {
        match self {
            Self::Beside { text, .. } => Some(text),
            Self::Rows { .. } => None,
        }
    }
}
