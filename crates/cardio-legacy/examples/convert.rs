//! Reads a card deck and prints its scenario: `cargo run -p cardio-legacy --example convert -- deck.dat [path.csv]`.
//! Diagnostics and the conversion's report go to standard error.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example that talks to a person")]

use std::error::Error;
use std::path::Path;

use cardio_legacy::{ConvertOptions, Deck, ParseOptions, PathSource};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("usage: convert deck.dat [path.csv]")?;
    let name = |file: &str| Path::new(file).file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let path = match arguments.next() {
        Some(csv) => Some(PathSource::Csv { name: name(&csv), text: std::fs::read_to_string(&csv)? }),
        None => None,
    };
    let options = ParseOptions { file: file.clone(), ..ParseOptions::default() };
    let (decks, diagnostics) = Deck::parse(std::fs::read(&file)?, &options);
    eprintln!("{diagnostics}");
    let deck = decks.first().ok_or("no deck can be used")?;
    let conversion = deck.to_scenario(&ConvertOptions { deck_name: name(&file), path, ..ConvertOptions::default() })?;
    eprintln!("{}", conversion.report);
    print!("{}", conversion.toml);
    Ok(())
}
