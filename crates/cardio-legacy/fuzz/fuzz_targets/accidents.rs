//! A good deck after accidents with its cards: read, converted, brought back.
#![no_main]

use arbitrary::Arbitrary;
use cardio_legacy::{ConvertOptions, Deck, ParseOptions, Strictness};
use libfuzzer_sys::fuzz_target;
use occupant_core::scenario::Scenario;
use occupant_core::scenario::document::Format;

const DECK: &[u8] = include_bytes!("../../examples/driver.dat");

#[derive(Arbitrary, Debug)]
enum Accident {
    Lost(u8),
    Doubled(u8),
    Swapped(u8, u8),
    Cut(u8, u8),
    Shifted(u8, u8),
    Punched(u8, u8, u8),
    Field(u8, u8, [u8; 10]),
}

fuzz_target!(|accidents: Vec<Accident>| {
    let mut lines: Vec<Vec<u8>> = DECK.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
    for accident in accidents.into_iter().take(8) {
        happen(&mut lines, accident);
    }
    let (decks, _) = Deck::parse(lines.join(&b'\n'), &ParseOptions { file: "fuzz".into(), strictness: Strictness::Lenient });
    for deck in &decks {
        let Ok(conversion) = deck.to_scenario(&ConvertOptions::default()) else { continue };
        let nothing = |name: &str| Err(format!("no file {name}"));
        let loaded = Scenario::from_text(&conversion.toml, Format::Toml, "fuzz", &nothing).expect("checked before");
        let back = Deck::from_scenario(&loaded, None).expect("a converted deck fits on cards");
        assert_eq!(back.deck.differences(&deck.normalised()), []);
    }
});

fn happen(lines: &mut Vec<Vec<u8>>, accident: Accident) {
    let count = lines.len().max(1);
    let place = |n: u8| usize::from(n) % count;
    match accident {
        Accident::Lost(at) if !lines.is_empty() => drop(lines.remove(place(at))),
        Accident::Doubled(at) => lines.insert(place(at), lines.get(place(at)).cloned().unwrap_or_default()),
        Accident::Swapped(a, b) if !lines.is_empty() => lines.swap(place(a), place(b)),
        Accident::Cut(at, column) => lines.get_mut(place(at)).into_iter().for_each(|l| l.truncate(column.into())),
        Accident::Shifted(at, column) => {
            for line in lines.get_mut(place(at)) {
                line.insert(usize::from(column).min(line.len()), b' ');
            }
        }
        Accident::Punched(at, column, byte) => overpunch(lines.get_mut(place(at)), column, &[byte]),
        Accident::Field(at, field, bytes) => overpunch(lines.get_mut(place(at)), field % 8 * 10, &bytes),
        Accident::Lost(_) | Accident::Swapped(..) => {}
    }
}

fn overpunch(line: Option<&mut Vec<u8>>, column: u8, bytes: &[u8]) {
    let Some(line) = line else { return };
    let end = usize::from(column) + bytes.len();
    line.resize(line.len().max(end), b' ');
    line[usize::from(column)..end].copy_from_slice(bytes);
}
