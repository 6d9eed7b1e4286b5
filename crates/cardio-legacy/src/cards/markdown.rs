//! The tables as text, for `docs/cards.md`.

use std::fmt::Write as _;

use super::{CardId, CardLayout, Repeat, SERIES};

/// All tables as Markdown: one section per series, one row per field.
pub fn tables_as_markdown() -> String {
    let mut text = String::new();
    for series in SERIES.iter() {
        let _ = writeln!(text, "## Series {}: {}\n", series.number, series.title);
        for card in &series.cards {
            let id = CardId { series: series.number, letter: card.letter, number: None };
            let _ = writeln!(text, "Card {id}, format {}{}\n", card.format, repeat_in_words(card));
            let _ = writeln!(text, "| columns | variable | unit | what |\n|---|---|---|---|");
            for field in &card.fields {
                let columns = field.columns.to_string();
                let columns = columns.trim_start_matches(|c: char| c.is_alphabetic() || c == ' ');
                let _ =
                    writeln!(text, "| {columns} | {} | {} | {} |", field.variable, field.unit.symbol, field.meaning);
            }
            text.push('\n');
        }
    }
    text.truncate(text.trim_end().len());
    text.push('\n');
    text
}

fn repeat_in_words(card: &CardLayout) -> String {
    match card.repeat {
        Repeat::Once => String::new(),
        Repeat::Each { count } => format!(", {count} cards in any order"),
        Repeat::Counted => ", as many cards as the first card says".to_owned(),
    }
}
