//! Decks for the tests: those of `scenarios/decks`, read and cut to pieces.

use std::path::PathBuf;

use cardio_legacy::{Deck, Diagnostics, ParseOptions, Rule, Severity, Strictness};

pub const DECKS: [&str; 6] = [
    "driver-lap-torso.dat",
    "right-front-lap.dat",
    "left-rear-unbelted.dat",
    "driver-exact-state.dat",
    "driver-path-from-disk.dat",
    "driver-exact-state-extended.dat",
];

pub fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/decks").join(name)
}

pub fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(path(name)).expect("a deck of the repository")
}

pub fn lines(name: &str) -> Vec<String> {
    String::from_utf8(bytes(name)).expect("ASCII").lines().map(str::to_owned).collect()
}

pub fn parse(text: &str) -> (Vec<Deck>, Diagnostics) {
    parse_as(text, Strictness::Default)
}

pub fn parse_as(text: &str, strictness: Strictness) -> (Vec<Deck>, Diagnostics) {
    Deck::parse(text, &ParseOptions { file: "test.dat".into(), strictness })
}

/// The deck of the driver with lap and torso belt, changed line by line.
pub fn driver(change: impl FnOnce(&mut Vec<String>)) -> String {
    let mut lines = lines("driver-lap-torso.dat");
    change(&mut lines);
    lines.join("\n") + "\n"
}

/// Replaces columns `first`… of a line (from 1) by a text.
pub fn punch(line: &mut String, first: usize, text: &str) {
    let mut columns: Vec<char> = format!("{line:80}").chars().collect();
    for (offset, letter) in text.chars().enumerate() {
        columns[first - 1 + offset] = letter;
    }
    *line = columns.into_iter().collect::<String>().trim_end().to_owned();
}

/// Line index of the first card of a series, by its card number.
pub fn first_card(lines: &[String], ncard: &str) -> usize {
    lines.iter().position(|line| format!("{line:80}")[70..].trim() == ncard).expect("the series is there")
}

pub fn rules(diagnostics: &Diagnostics, severity: Severity) -> Vec<Rule> {
    diagnostics.iter().filter(|d| d.severity == severity).map(|d| d.rule).collect()
}
