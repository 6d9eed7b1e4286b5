//! The vehicle's path: series 12, or a file where MREAD ≠ 0.

use super::ConversionError;
use super::writer::{Writer, quoted};
use crate::card::Card;
use crate::columns::Columns;
use crate::deck::Deck;
use crate::field::read_real;

/// The columns of a station on cards of series 12, with their units.
const CARD_COLUMNS: [&str; 7] = ["t[s]", "x[in]", "y[in]", "z[in]", "roll[deg]", "pitch[deg]", "yaw[deg]"];

/// Where the path of a deck with MREAD ≠ 0 comes from. The vehicle program's own layout on disk is not documented.
#[derive(Debug, Clone, PartialEq)]
pub enum PathSource {
    /// A CSV file whose first line names columns and units: `t[s],x[in],y[in],z[in],roll[deg],pitch[deg],yaw[deg]`, in any
    /// order. The scenario refers to the file by its name.
    Csv {
        /// Name of the file as the scenario shall call it.
        name: String,
        /// Its text.
        text: String,
    },
    /// A file of plain numbers, separated by commas or blanks, with its columns and units declared beside it.
    Columns {
        /// Name and unit of each column, such as `t[ms]`.
        columns: Vec<String>,
        /// Its text.
        text: String,
    },
    /// Cards of series 12b, one a station.
    Cards {
        /// Their text.
        text: String,
    },
}

/// A path that is ready to be written.
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
        let digits = |card: &crate::deck::DeckCard| card.numbers.iter().map(|n| n.digits.clone()).collect();
        let rows = deck.cards_of(12, 'b').map(digits).collect();
        return Ok(Path::Rows {
            columns: card_columns(),
            rows,
            from: "Series 12, cards b: CALT, CALX, CALY, CALZ, CALPH, CALTH, CALPS",
        });
    }
    let wanted = stations as usize;
    match source.ok_or(ConversionError::PathNeeded { stations })? {
        PathSource::Csv { name, text } => beside(name, text, wanted),
        PathSource::Columns { columns, text } => {
            let rows = plain_rows(text, columns.len())?;
            Ok(Path::Rows {
                columns: columns.clone(),
                rows: first(rows, wanted)?,
                from: "The path file, columns as declared",
            })
        }
        PathSource::Cards { text } => {
            let rows = card_rows(text)?;
            Ok(Path::Rows {
                columns: card_columns(),
                rows: first(rows, wanted)?,
                from: "The path file, in the card format of series 12",
            })
        }
    }
}

fn card_columns() -> Vec<String> {
    CARD_COLUMNS.map(str::to_owned).to_vec()
}

/// A CSV file that holds just the stations that MREAD counts stays a file; otherwise its first ones are written out.
fn beside(name: &str, text: &str, wanted: usize) -> Result<Path, ConversionError> {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    let header = lines.next().unwrap_or_default().trim_start_matches('\u{feff}');
    if !header.contains('[') {
        return Err(ConversionError::Path(format!(
            "its first line, `{header}`, names no columns with units such as t[s],x[in]; declare the columns otherwise"
        )));
    }
    let columns: Vec<String> = header.split(',').map(|c| c.trim().to_owned()).collect();
    let rows = plain_rows(&lines.clone().collect::<Vec<_>>().join("\n"), columns.len())?;
    if rows.len() == wanted {
        return Ok(Path::Beside { name: name.to_owned(), text: text.to_owned() });
    }
    Ok(Path::Rows {
        columns,
        rows: first(rows, wanted)?,
        from: "The path file: the first stations, as many as MREAD says",
    })
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
    let lines =
        text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.trim_start().starts_with('#'));
    lines
        .map(|(at, line)| {
            plain_row(line, columns).map_err(|reason| ConversionError::Path(format!("line {}: {reason}", at + 1)))
        })
        .collect()
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
    let cards = text.lines().enumerate().map(|(at, line)| Card::new(at + 1, line.as_bytes())).filter(|c| !c.is_blank());
    cards.map(|card| card_row(&card)).collect()
}

fn card_row(card: &Card) -> Result<Vec<String>, ConversionError> {
    (0..7)
        .map(|place| {
            let columns = Columns::new(place * 10 + 1, place * 10 + 10);
            let reading = read_real(card.field(columns));
            let refused = |_| {
                ConversionError::Path(format!(
                    "line {}, {columns}: `{}` is no number in F10.0",
                    card.line,
                    card.text_of(columns)
                ))
            };
            reading.map(|r| r.digits).map_err(refused)
        })
        .collect()
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

    /// The text of the file beside the scenario.
    pub(super) fn beside(&self) -> Option<&str> {
        match self {
            Self::Beside { text, .. } => Some(text),
            Self::Rows { .. } => None,
        }
    }
}
