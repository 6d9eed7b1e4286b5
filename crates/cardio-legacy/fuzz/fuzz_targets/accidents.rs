//! A good deck after accidents with its cards: read, converted, brought back.
#![no_main]

use arbitrary::Arbitrary;
use cardio_legacy::{ConvertOptions, Deck, ParseOptions, PathSource, Strictness};
use libfuzzer_sys::fuzz_target;
use occupant_scenario::{Format, Scenario};

/// The last takes its path from [`PATH`].
const DECKS: [&[u8]; 6] = [
    include_bytes!("../../../../scenarios/decks/driver-lap-torso.dat"),
    include_bytes!("../../../../scenarios/decks/driver-exact-state-extended.dat"),
    include_bytes!("../../../../scenarios/decks/right-front-lap.dat"),
    include_bytes!("../../../../scenarios/decks/left-rear-unbelted.dat"),
    include_bytes!("../../../../scenarios/decks/driver-exact-state.dat"),
    include_bytes!("../../../../scenarios/decks/driver-path-from-disk.dat"),
];
const PATH: &str = include_str!("../../../../scenarios/decks/driver-path-from-disk.csv");

#[derive(Arbitrary, Debug)]
struct Case {
    deck: u8,
    accidents: Vec<Accident>,
}

#[derive(Arbitrary, Debug)]
enum Accident {
    Lost(u8),
    Doubled(u8),
    Swapped(u8, u8),
    Cut(u8, u8),
    Shifted(u8, u8),
    Punched(u8, u8, u8),
    Field(u8, u8, [u8; 10]),
    /// A number in ten columns: line, field, digits, exponent, notation.
    Number(u8, u8, i32, i8, u8),
    /// A field takes over what stands in another one: line and field, line and field.
    Copied(u8, u8, u8, u8),
}

fuzz_target!(|case: Case| {
    let deck = DECKS[usize::from(case.deck) % DECKS.len()];
    let mut lines: Vec<Vec<u8>> = deck.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
    for accident in case.accidents.into_iter().take(8) {
        happen(&mut lines, accident);
    }
    let (decks, diagnostics) = Deck::parse(
        lines.join(&b'\n'),
        &ParseOptions {
            file: "fuzz".into(),
            strictness: Strictness::Lenient,
        },
    );
    let _ = diagnostics.to_string();
    decks.iter().for_each(comes_back);
});

/// What a deck's scenario says is what the deck said.
fn comes_back(deck: &Deck) {
    let path = PathSource::Csv {
        name: "path.csv".into(),
        text: PATH.into(),
    };
    let Ok(conversion) = deck.to_scenario(&ConvertOptions {
        path: Some(path),
        ..ConvertOptions::default()
    }) else {
        return;
    };
    let beside = |_: &str| Ok(PATH.as_bytes().to_vec());
    let loaded = Scenario::from_text(&conversion.toml, Format::Toml, "fuzz", &beside)
        .expect("checked before");
    let back = Deck::from_scenario(&loaded, None)
        .unwrap_or_else(|reason| panic!("a converted deck fits on cards: {reason}"));
    assert_eq!(back.deck.differences(&deck.normalised()), []);
}

fn happen(lines: &mut Vec<Vec<u8>>, accident: Accident) {
    let count = lines.len().max(1);
    let place = |n: u8| usize::from(n) % count;
    match accident {
        Accident::Lost(at) if !lines.is_empty() => drop(lines.remove(place(at))),
        Accident::Doubled(at) => {
            lines.insert(place(at), lines.get(place(at)).cloned().unwrap_or_default())
        }
        Accident::Swapped(a, b) if !lines.is_empty() => lines.swap(place(a), place(b)),
        Accident::Cut(at, column) => lines
            .get_mut(place(at))
            .into_iter()
            .for_each(|l| l.truncate(column.into())),
        Accident::Shifted(at, column) => {
            if let Some(line) = lines.get_mut(place(at)) {
                line.insert(usize::from(column).min(line.len()), b' ');
            }
        }
        Accident::Punched(at, column, byte) => overpunch(lines.get_mut(place(at)), column, &[byte]),
        Accident::Field(at, field, bytes) => {
            overpunch(lines.get_mut(place(at)), field % 8 * 10, &bytes)
        }
        Accident::Number(at, field, digits, exponent, notation) => {
            let text = number(digits, exponent, notation);
            overpunch(lines.get_mut(place(at)), field % 7 * 10, text.as_bytes());
        }
        Accident::Copied(from, field, to, other) => {
            let start = usize::from(field % 7) * 10;
            let text: Vec<u8> = lines
                .get(place(from))
                .into_iter()
                .flatten()
                .skip(start)
                .take(10)
                .copied()
                .collect();
            overpunch(lines.get_mut(place(to)), other % 7 * 10, &text);
        }
        Accident::Lost(_) | Accident::Swapped(..) => {}
    }
}

/// A number in ten columns, as far as it fits.
fn number(digits: i32, exponent: i8, notation: u8) -> String {
    let text = match notation % 5 {
        0 => format!(
            "{}",
            f64::from(digits) * 10f64.powi(i32::from(exponent % 8))
        ),
        1 => format!("{digits}E{exponent}"),
        2 => format!("{digits}{exponent:+}"),
        3 => format!(".{}D{exponent}", digits.unsigned_abs()),
        _ => format!("{digits}"),
    };
    format!("{text:>10.10}")
}

fn overpunch(line: Option<&mut Vec<u8>>, column: u8, bytes: &[u8]) {
    let Some(line) = line else { return };
    let end = usize::from(column) + bytes.len();
    line.resize(line.len().max(end), b' ');
    line[usize::from(column)..end].copy_from_slice(bytes);
}
