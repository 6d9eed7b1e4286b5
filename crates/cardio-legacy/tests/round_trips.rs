//! Deck → scenario → deck with odd numbers in every field, and with cards cut short: a deck that converts comes back.

use crate::support::{DECKS, lines, path, punch};
use cardio_legacy::{ConvertOptions, Deck, ParseOptions, PathSource, Strictness};
use occupant_scenario::Format;
use occupant_scenario::Scenario;

/// Ten columns at the edges of what F10.0 holds and of what a scenario tells apart.
const ODD: [&str; 16] = [
    "          ",
    "        0.",
    "       -0.",
    "        1.",
    "       -1.",
    "7000000002",
    "-700000003",
    ".123456789",
    "1234567-20",
    "12345678+9",
    "  1.E-300 ",
    "   6.1E-79",
    "      1E70",
    "1         ",
    "99999.9999",
    " 0.1000000",
];

/// What became of a deck.
#[derive(Debug, PartialEq)]
enum Fate {
    /// The reader refused it, or no scenario says the same.
    Refused,
    /// It came back.
    CameBack,
}

/// Reads leniently, converts, brings back.
///
/// # Errors
/// In which fields the deck that came back differs, or why none came back.
fn round_trip(text: &str) -> Result<Fate, String> {
    let options = ParseOptions { file: "odd".into(), strictness: Strictness::Lenient };
    let csv_name = "driver-path-from-disk.csv";
    let csv = std::fs::read_to_string(path(csv_name)).expect("beside the deck");
    let (decks, _) = Deck::parse(text, &options);
    let mut fate = Fate::Refused;
    for deck in &decks {
        let options = ConvertOptions {
            path: Some(PathSource::Csv { name: csv_name.into(), text: csv.clone() }),
            ..ConvertOptions::default()
        };
        let Ok(conversion) = deck.to_scenario(&options) else {
            continue;
        };
        let resolver = |_: &str| Ok(csv.clone().into_bytes());
        let loaded =
            Scenario::from_text(&conversion.toml, Format::Toml, "odd", &resolver).map_err(|d| d.to_string())?;
        let back = Deck::from_scenario(&loaded, None).map_err(|e| e.to_string())?;
        let differences = back.deck.differences(&deck.normalised());
        if !differences.is_empty() {
            return Err(format!("{differences:?}"));
        }
        fate = Fate::CameBack;
    }
    Ok(fate)
}

/// The numeric lines of a deck: all but titles, plot card and final card.
fn numeric_lines(name: &str) -> std::ops::Range<usize> {
    2..lines(name).len() - 2
}

/// Round trips of all texts; the failures, and how many came back.
fn all(texts: impl Iterator<Item = (String, String)>) -> (Vec<String>, usize) {
    let (mut failures, mut returned) = (Vec::new(), 0);
    for (label, text) in texts {
        match round_trip(&text) {
            Ok(Fate::CameBack) => returned += 1,
            Ok(Fate::Refused) => {}
            Err(reason) => failures.push(format!("{label}: {reason}")),
        }
    }
    (failures, returned)
}

/// One odd number in each field of each card; `EVERY_ODD_NUMBER=1` takes all of them on all decks (some minutes).
#[test]
fn odd_numbers_come_back() {
    let every = std::env::var_os("EVERY_ODD_NUMBER").is_some();
    let decks = if every { &DECKS[..] } else { &DECKS[3..4] };
    let mut texts = Vec::new();
    for name in decks {
        for (at, column) in numeric_lines(name).flat_map(|at| (0..7).map(move |f| (at, f * 10 + 1))) {
            let rotating = (at * 7 + column / 10) % ODD.len();
            let chosen = if every { 0..ODD.len() } else { rotating..rotating + 1 };
            for odd in &ODD[chosen] {
                let mut lines = lines(name);
                punch(&mut lines[at], column, odd);
                let label = format!("{name}, line {}, column {column}, {odd}", at + 1);
                texts.push((label, lines.join("\n") + "\n"));
            }
        }
    }
    let (failures, returned) = all(texts.into_iter());
    assert_eq!(failures, [] as [String; 0]);
    assert!(returned > 100, "{returned}");
}

#[test]
fn cards_cut_short_come_back() {
    let every = std::env::var_os("EVERY_ODD_NUMBER").is_some();
    let mut texts = Vec::new();
    for name in if every { &DECKS[..] } else { &DECKS[..1] } {
        for at in numeric_lines(name) {
            for width in (10..70).step_by(if every { 10 } else { 30 }) {
                let mut lines = lines(name);
                let ncard = format!("{:80}", lines[at])[70..].to_owned();
                lines[at].truncate(width);
                punch(&mut lines[at], 71, &ncard);
                texts.push((format!("{name}, line {} cut at {width}", at + 1), lines.join("\n")));
            }
        }
    }
    let (failures, returned) = all(texts.into_iter());
    assert_eq!(failures, [] as [String; 0]);
    assert!(returned > 20, "{returned}");
}

/// A deck of the repository with texts punched into fields by their names.
fn with_fields(name: &str, fields: &[(&str, &str)]) -> String {
    let mut lines = lines(name);
    let (decks, _) = Deck::parse(lines.join("\n"), &ParseOptions::default());
    for (field, text) in fields {
        let (card, place) = decks[0].place_of(field).expect("a field of the deck");
        let line = &mut lines[card.line.expect("read from a file") - 1];
        punch(line, usize::from(place.columns.first), text);
    }
    lines.join("\n") + "\n"
}

#[test]
fn what_was_lost_once_comes_back() {
    let (driver, exact) = ("driver-lap-torso.dat", "driver-exact-state.dat");
    let (zero, blank) = ("        0.", "          ");
    let cases: [(&str, &[(&str, &str)]); 11] = [
        // Was rounded to 7000000000 (found by fuzzing).
        (driver, &[("ZV(12)", "7000000002")]),
        // Does not fit with its exponent behind one digit before the point.
        (driver, &[("VXVC", "1234567-20")]),
        // A stop without angles has no damping in a scenario.
        (driver, &[("AGNN", zero), ("AGSN", zero)]),
        (driver, &[("AGNK(1)", blank), ("AGSK(1)", blank), ("AGNK(2)", blank), ("AGSK(2)", blank)]),
        // In the middle of the car, or without wheel, y does not tell the seats of left and right apart.
        (driver, &[("SWP", zero)]),
        (driver, &[("SWP", "      -14."), ("DSW", zero)]),
        // Surfaces that are left out leave open which corner of their neighbours is which point.
        (exact, &[("STIF1(15)", zero), ("STIF2(15)", zero)]),
        (exact, &[("STIF1(13)", zero), ("STIF2(13)", zero)]),
        (exact, &[("STIF1(12)", zero), ("STIF2(12)", zero), ("STIF1(14)", zero), ("STIF2(14)", zero)]),
        // The normalised form leaves SLACK out, the notes kept it.
        (exact, &[("SLACK(1)", "      0.25")]),
        // The wheel's place rounds to more than a fixed bound.
        (driver, &[("XV(6)", "7000000002"), ("XV(7)", "7000000002"), ("XV(22)", "7000000002")]),
    ];
    for (deck, fields) in cases {
        let text = with_fields(deck, fields);
        assert_eq!(round_trip(&text), Ok(Fate::CameBack), "{fields:?}");
    }
    let titled = with_fields(driver, &[]).replacen("DRIVER", " D\\\"RIVER # = '''", 1);
    assert_eq!(round_trip(&titled), Ok(Fate::CameBack), "quotes in the title");
}
