//! The decks of the repository: read without a doubt, written and read again.

use crate::support::{DECKS, bytes, driver, lines, parse, parse_as, rules};
use cardio_legacy::{Deck, ParseOptions, Plot, Rule, Severity, Strictness, write_file};

fn only_deck(name: &str) -> Deck {
    let (decks, diagnostics) =
        Deck::parse(bytes(name), &ParseOptions { file: name.into(), strictness: Strictness::Strict });
    assert!(!diagnostics.has_errors(), "{diagnostics}");
    assert_eq!(decks.len(), 1, "{name}");
    decks.into_iter().next().expect("one deck")
}

#[test]
fn every_deck_passes_the_strict_reading() {
    for name in DECKS {
        only_deck(name);
    }
}

#[test]
fn numbers_are_found_by_the_names_of_the_report() {
    let deck = only_deck("driver-lap-torso.dat");
    for (name, value) in [
        ("TF", 0.2),
        ("VXVC", 352.0),
        ("XLE(3)", 13.71),
        ("ZIN(12)", 0.1420),
        ("RS(17)", 1.9),
        ("ZV(22)", 2.0),
        ("COFR(25)", 0.4),
        ("ALPHA1", -60.0),
        ("AGNK(2)", 2.3562),
        ("GR", 386.04),
        ("CALX(1)", 0.0),
        ("NVPOS", 51.0),
        ("SK1(2)", 250.0),
        ("P2(2,3)", 9.0),
    ] {
        assert_eq!(deck.value(name), Some(value), "{name}");
    }
    assert_eq!(deck.number("GR").map(|n| n.digits.as_str()), Some("386.04"));
    assert_eq!(deck.number("Q0(1)"), None);
    assert_eq!(deck.plot(), Plot::Standard);
    assert_eq!(deck.titles()[1], "COMPARTMENT AND BODY COMPOSED FROM PUBLISHED FIGURES");
    let (card, field) = deck.place_of("AGNLB").expect("a field");
    assert_eq!((card.id.to_string().as_str(), field.columns.first), ("11c", 1));
}

#[test]
fn a_deck_written_and_read_again_is_the_same_deck() {
    for name in DECKS {
        let deck = only_deck(name);
        let text = deck.write() + "FINI\n";
        let (again, diagnostics) = parse_as(&text, Strictness::Strict);
        assert!(!diagnostics.has_errors(), "{name}\n{diagnostics}");
        assert_eq!(again[0].differences(&deck), [], "{name}");
        assert_eq!(again[0].write() + "FINI\n", text, "{name}: the normalised form is its own normalised form");
    }
}

#[test]
fn blanks_are_counted_and_fields_of_the_other_belt_are_not() {
    let deck = only_deck("right-front-lap.dat");
    assert_eq!(deck.blank_fields(), ["VYVC", "VZVC"]);
    let (_, diagnostics) = parse(&lines("right-front-lap.dat").join("\n"));
    let note = diagnostics.iter().find(|d| d.rule == Rule::BlankIsZero).expect("counted");
    assert_eq!(note.severity, Severity::Note);
    assert!(note.message.starts_with("2 blank fields"), "{}", note.message);
}

#[test]
fn several_decks_in_a_file_are_several_runs() {
    let decks: Vec<Deck> = DECKS.into_iter().map(only_deck).collect();
    let (again, diagnostics) = Deck::parse(write_file(&decks), &ParseOptions::default());
    assert!(!diagnostics.has_errors(), "{diagnostics}");
    assert_eq!(again.len(), decks.len());
    for (left, right) in again.iter().zip(&decks) {
        assert_eq!(left.differences(right), []);
    }
}

#[test]
fn a_wrong_deck_does_not_take_the_next_one_with_it() {
    let wrong = driver(|lines| {
        lines.remove(20);
        lines.pop();
    });
    let text = wrong + &lines("left-rear-unbelted.dat").join("\n");
    let (decks, diagnostics) = parse(&text);
    assert!(diagnostics.has_errors());
    assert_eq!(decks.len(), 1, "{diagnostics}");
    assert_eq!(decks[0].value("NOPTSP"), Some(3.0));
}

#[test]
fn line_ends_sequence_numbers_and_latin_1_are_no_trouble() {
    let changed = driver(|lines| {
        lines[0] = "F\u{fc}hrer".into();
        for (at, line) in lines.iter_mut().enumerate().filter(|(at, _)| (5..17).contains(at)) {
            *line = format!("{line:72}{:08}", at * 10);
        }
    });
    let latin: Vec<u8> = changed.replace('\n', "\r\n").chars().map(|c| c as u8).collect();
    let (decks, diagnostics) = Deck::parse(&latin, &ParseOptions { file: "x".into(), strictness: Strictness::Strict });
    assert!(diagnostics.iter().all(|d| d.rule == Rule::BlankIsZero), "{diagnostics}");
    assert_eq!(decks[0].titles()[0], "Führer");
    assert_eq!(decks[0].differences(&only_deck("driver-lap-torso.dat")).len(), 1, "the title only");
    assert!(write_file(&decks).starts_with(b"F\xfchrer\n"));
}

#[test]
fn a_series_that_is_not_needed_is_noted() {
    let mut lines = lines("driver-exact-state.dat");
    let velocity = crate::support::lines("driver-lap-torso.dat")[3].clone();
    lines.insert(3, velocity);
    let (decks, diagnostics) = parse_as(&lines.join("\n"), Strictness::Strict);
    assert_eq!(decks.len(), 1, "{diagnostics}");
    assert_eq!(rules(&diagnostics, Severity::Note), [Rule::SeriesUnused]);
}

/// Corners of a surface of the driver's deck in vehicle axes.
fn corners(number: u32) -> Vec<[f64; 3]> {
    let deck = only_deck("driver-lap-torso.dat");
    let layout = cardio_legacy::CompartmentLayout::reconstruction().expect("sound");
    let face = layout.faces(&deck).into_iter().find(|f| f.number == number).expect("a face");
    let value = |name: &str| deck.value(name).expect("a field");
    let place = |c: &cardio_legacy::Corner| {
        let width = value(c.wall.half_width);
        let y = if c.wall.is_left { -width } else { width };
        [value(&format!("XV({})", c.x_of)), y, value(&format!("ZV({})", c.z_of))]
    };
    face.corners.iter().map(place).collect()
}

#[test]
fn faces_turn_their_open_side_into_the_compartment() {
    // Normals by hand, from the points: (surface, direction into the open side).
    let open = [
        (1, [-1.0, 0.0, 1.0]),
        (3, [0.0, 0.0, 1.0]),
        (8, [-1.0, 0.0, 0.0]),
        (10, [-0.1, 0.0, 1.0]),
        (11, [-1.0, 0.0, -1.0]),
        (13, [0.0, 0.0, -1.0]),
        (14, [1.0, 0.0, -0.3]),
        (15, [-1.0, 0.0, 0.0]),
        (17, [1.0, 0.0, 0.0]),
        (20, [0.0, 0.0, -1.0]),
        (21, [0.0, 1.0, 0.0]),
        (23, [0.0, 1.0, 0.3]),
        (24, [0.0, -1.0, 0.3]),
    ];
    for (number, direction) in open {
        let c = corners(number);
        let edge = |a: usize, b: usize| [c[b][0] - c[a][0], c[b][1] - c[a][1], c[b][2] - c[a][2]];
        let (u, v) = (edge(0, 1), edge(1, 2));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let along: f64 = normal.iter().zip(direction).map(|(n, d)| n * d).sum();
        assert!(along > 0.0, "surface {number}: normal {normal:?}");
    }
}

#[test]
fn the_windshield_joins_body_width_and_roof_width() {
    let mut windshield = corners(1);
    windshield.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    assert_eq!(windshield, [[18.0, -23.0, -30.0], [18.0, 23.0, -30.0], [38.0, -29.0, -14.0], [38.0, 29.0, -14.0]]);
}

#[test]
fn the_example_s_deck_is_the_driver_s() {
    assert_eq!(include_bytes!("../examples/driver.dat").as_slice(), bytes("driver-lap-torso.dat"));
}
