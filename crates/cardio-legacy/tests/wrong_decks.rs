//! Wrong decks, one fault each: what is found, where, and how gravely.

use crate::support::{driver, first_card, lines, parse, parse_as, punch, rules};
use cardio_legacy::{Diagnostic, Diagnostics, Rule, Severity, Strictness};

/// The errors of a deck, as (rule, line, variable).
fn errors(text: &str) -> Vec<(Rule, usize, String)> {
    of(text, Severity::Error)
}

fn warnings(text: &str) -> Vec<(Rule, usize, String)> {
    of(text, Severity::Warning)
}

fn of(text: &str, severity: Severity) -> Vec<(Rule, usize, String)> {
    let (decks, diagnostics) = parse(text);
    assert_eq!(decks.is_empty(), diagnostics.has_errors(), "a deck with an error is not handed out\n{diagnostics}");
    let key = |d: &Diagnostic| (d.rule, d.line.unwrap_or(0), d.variable.clone().unwrap_or_default());
    diagnostics.iter().filter(|d| d.severity == severity).map(key).collect()
}

/// The driver's deck with a text punched into a card: series by card number, how many cards behind its first one, column.
fn punched(ncard: &str, behind: usize, column: usize, text: &str) -> String {
    driver(|lines| {
        let at = first_card(lines, ncard) + behind;
        punch(&mut lines[at], column, text);
    })
}

fn found(rule: Rule, line: usize, variable: &str) -> (Rule, usize, String) {
    (rule, line, variable.to_owned())
}

#[test]
fn a_diagnostic_names_everything_a_person_needs() {
    let (_, diagnostics) = parse(&punched("11", 1, 11, "      6O.0"));
    let text = diagnostics.to_string();
    let expected = "\
error[not-a-number]: `      6O.0` is no number: `O` in column 18; damping of the upper back
  --> test.dat:58, card 11b, column 18, XJNUB
   |     2.9671      6O.0     .6109      800.     .5236        6.     .6981      800.
   |                  ^
   = expected: a number in F10.0, in in·lbf·s
   = remedy: punch the number again; look whether a neighbouring field has slipped into these columns
";
    assert!(text.contains(expected), "{text}");
}

#[test]
fn every_numeric_field_of_every_card_reports_what_is_no_number() {
    for name in crate::support::DECKS {
        let deck = &cardio_legacy::Deck::parse(crate::support::bytes(name), &Default::default()).0[0];
        for card in deck.cards() {
            let series = cardio_legacy::cards::series(card.id.series).expect("a series");
            let layout = series.cards.iter().find(|c| c.letter == card.id.letter).expect("a card");
            for field in layout.fields.iter().filter(|f| f.variable != "NCARD") {
                let line = card.line.expect("read from a file");
                let mut lines = lines(name);
                punch(&mut lines[line - 1], usize::from(field.columns.last), "?");
                let variable =
                    layout.name_of(field, card.id.number.filter(|_| !matches!(&*field.variable, "J" | "NSEG")));
                let found = errors(&lines.join("\n"));
                let named = found.iter().any(|(rule, at, v)| {
                    *rule == Rule::NotANumber && *at == line && (*v == variable || field.columns.first == 1)
                });
                assert!(named, "{name}, line {line}, {variable}: {found:?}");
            }
        }
    }
}

#[test]
fn all_problems_are_reported_at_once() {
    let text = driver(|lines| {
        punch(&mut lines[2], 21, "        x.");
        punch(&mut lines[5], 31, "          ");
        punch(&mut lines[18], 1, "       -4.");
        let at = first_card(lines, "13");
        punch(&mut lines[at], 1, "        4.");
    });
    assert_eq!(
        errors(&text),
        [
            found(Rule::NotANumber, 3, "DT"),
            found(Rule::Impossible, 6, "XM(1)"),
            found(Rule::Impossible, 19, "RS(1)"),
            found(Rule::Impossible, 114, "NOPBLT"),
        ]
    );
}

#[test]
fn missing_cards_are_missed_where_they_should_be() {
    let without = |line: usize| driver(|lines| drop(lines.remove(line - 1)));
    assert_eq!(errors(&without(1))[0].0, Rule::MissingTitle);
    assert_eq!(errors(&without(3)), [found(Rule::SeriesMissing, 1, "")]);
    assert_eq!(errors(&without(4)), [found(Rule::SeriesMissing, 3, "")]);
    assert_eq!(errors(&without(8)), [found(Rule::IndexMissing, 5, "")]);
    assert_eq!(errors(&without(19)), [found(Rule::SeriesTooShort, 18, "")]);
    assert_eq!(errors(&without(70)), [found(Rule::CountDiffers, 62, "NVPOS")]);
    assert_eq!(errors(&without(117)), [found(Rule::NoTerminator, 117, "")]);
    assert_eq!(errors(&without(118)), [found(Rule::NoPlotCard, 118, "")]);
    assert_eq!(warnings(&without(119)), [found(Rule::NoFinalCard, 118, "")]);
    // The first card of series 7 gone: its radii belong to nothing.
    let found = errors(&without(18));
    assert_eq!(found.iter().map(|f| f.0).collect::<Vec<_>>(), [Rule::SeriesMissing, Rule::UnexpectedCard]);
}

#[test]
fn the_series_that_the_switches_ask_for_are_asked_for() {
    let (_, diagnostics) = parse(&punched("3", 0, 51, "        1."));
    let missing: Vec<_> = diagnostics.iter().filter(|d| d.severity == Severity::Error).map(|d| &d.message).collect();
    assert_eq!(missing.len(), 1, "{diagnostics}");
    assert!(missing[0].starts_with("series 6 ") && missing[0].contains("NPOS = 1"), "{}", missing[0]);
    assert_eq!(rules(&diagnostics, Severity::Note), [Rule::SeriesUnused, Rule::SeriesUnused]);
    assert_eq!(errors(&punched("3", 0, 51, "        2.")), [found(Rule::Impossible, 3, "NPOS")]);
    assert_eq!(errors(&punched("3", 0, 41, "      -51.")), [found(Rule::NotAWholeNumber, 3, "MREAD")]);
}

#[test]
fn doubled_surplus_and_unordered_cards_are_named() {
    let doubled = |line: usize| driver(|lines| lines.insert(line, lines[line - 1].clone()));
    assert_eq!(errors(&doubled(4)), [found(Rule::SeriesTwice, 5, "")]);
    assert_eq!(errors(&doubled(8)), [found(Rule::IndexTwice, 9, "NSEG")]);
    assert_eq!(errors(&doubled(21)), [found(Rule::UnexpectedCard, 22, "")]);
    assert_eq!(errors(&doubled(80))[0], found(Rule::CountDiffers, 62, "NVPOS"));
    let swapped = driver(|lines| {
        let series_4 = lines.remove(3);
        lines.insert(16, series_4);
    });
    assert_eq!(warnings(&swapped), [found(Rule::OutOfOrder, 17, "")]);
    assert_eq!(errors(&swapped), []);
    let shuffled = driver(|lines| lines[5..17].reverse());
    assert_eq!(errors(&shuffled), [], "segments come in any order");
    assert_eq!(warnings(&shuffled), []);
}

#[test]
fn segment_and_surface_numbers_are_judged() {
    assert_eq!(
        errors(&punched("5", 1, 1, " 2")),
        [found(Rule::IndexMissing, 5, ""), found(Rule::IndexTwice, 7, "NSEG")]
    );
    assert_eq!(errors(&punched("5", 1, 1, "13")), [found(Rule::IndexMissing, 5, ""), found(Rule::BadIndex, 6, "NSEG")]);
    assert_eq!(errors(&punched("9", 25, 1, "  "))[1], found(Rule::BadIndex, line_of("9") + 25, "J"));
    let left = punched("5", 1, 1, "1 ");
    assert_eq!(warnings(&left), [found(Rule::LeftJustified, 6, "NSEG")], "`1 ` in I2 is 10");
    assert_eq!(errors(&left).last(), Some(&found(Rule::IndexTwice, 15, "NSEG")));
}

#[test]
fn card_numbers_are_read_where_they_stand() {
    let moved = |from: usize, text: &str| driver(|lines| punch(&mut lines[first_card_by_line(from)], 71, text));
    assert_eq!(errors(&moved(18, "       7  ")), [], "the format I8 of series 7 ends in column 78");
    let ten = driver(|lines| {
        let at = first_card(lines, "10");
        punch(&mut lines[at], 71, "      10  ");
    });
    let (decks, diagnostics) = parse(&ten);
    assert_eq!(decks.len(), 1, "that of series 10, which I10 would read as 1000: {diagnostics}");
    assert_eq!(other_notes(&diagnostics), [Rule::CardNumberByFormat]);
    assert!(decks[0].differences(&parse(&driver(|_| {})).0[0]).is_empty());
    assert_eq!(errors(&moved(5, "5         ")), [found(Rule::CardNumber, 5, "NCARD")]);
    assert_eq!(errors(&moved(5, "          ")), [found(Rule::CardNumber, 5, "NCARD")]);
    assert_eq!(errors(&moved(5, "        77"))[0].0, Rule::SeriesMissing);
    let (decks, diagnostics) = parse_as(&moved(5, "          "), Strictness::Lenient);
    assert_eq!(decks.len(), 1, "{diagnostics}");
    assert_eq!(rules(&diagnostics, Severity::Warning), [Rule::CardNumber]);
}

fn first_card_by_line(line: usize) -> usize {
    line - 1
}

#[test]
fn lines_that_are_no_cards_are_named() {
    let long = driver(|lines| lines[3] = format!("{:80}SURPLUS", lines[3]));
    assert_eq!(warnings(&long), [found(Rule::LineTooLong, 4, "")]);
    let tab = driver(|lines| lines[4] = format!("    6.57\t{}", &format!("{:80}", lines[4])[16..]));
    assert_eq!(errors(&tab).first().map(|f| f.0), Some(Rule::Tab));
    let free = punched("4", 0, 45, "12.5");
    assert_eq!(warnings(&free), [found(Rule::NotBlank, 4, "")]);
    let behind = driver(|lines| lines.push("MORE".into()));
    assert_eq!(warnings(&behind), [found(Rule::AfterFinalCard, 120, "")]);
    let word = driver(|lines| lines[117] = "stan".into());
    assert_eq!(errors(&word), [found(Rule::UnknownWord, 118, "")]);
    let control = driver(|lines| lines[0].push('\u{7}'));
    assert_eq!(warnings(&control), [found(Rule::ControlCharacter, 1, "")]);
    let utf = driver(|lines| lines[0] = "Führer".into());
    assert_eq!(warnings(&utf), [found(Rule::LooksLikeUtf8, 1, "")]);
}

/// The notes besides that of the driver's two blank fields, SLACK(1) and SLACK(2), which has to be there once.
fn other_notes(diagnostics: &Diagnostics) -> Vec<Rule> {
    let mut notes = rules(diagnostics, Severity::Note);
    let before = notes.len();
    notes.retain(|rule| *rule != Rule::BlankIsZero);
    assert_eq!(before, notes.len() + 1, "{diagnostics}");
    notes
}

/// How many problems of each gravity a deck has.
fn counts(text: &str) -> [usize; 3] {
    let (_, found) = parse(text);
    [Severity::Error, Severity::Warning, Severity::Note].map(|severity| found.count(severity))
}

#[test]
fn what_is_wrong_alike_on_many_cards_is_said_once() {
    // the note counts the blank SLACK(1) and SLACK(2)
    assert_eq!(counts(&driver(|_| {})), [0, 0, 1]);
    // another machine's numbers behind all 119 cards
    let numbered = driver(|lines| lines.iter_mut().for_each(|line| *line = format!("{line:82}CDC 6600")));
    assert_eq!(counts(&numbered), [0, 0, 2]);
    let (decks, diagnostics) = parse(&numbered);
    assert_eq!(decks.len(), 1);
    assert_eq!(other_notes(&diagnostics), [Rule::BeyondTheCard]);
    // every zero punched as a point alone
    let points = driver(|lines| {
        for line in &mut lines[2..117] {
            *line = line.replace("        0.", "         .");
        }
    });
    let (decks, diagnostics) = parse(&points);
    assert_eq!(rules(&diagnostics, Severity::Warning), [Rule::LonePoint], "{diagnostics}");
    let of_zeros = &parse(&driver(|_| {})).0[0];
    assert!(decks[0].differences(of_zeros).is_empty());
}

/// What follows of a mistake in every line is not told beside it.
#[test]
fn one_mistake_in_every_line_is_told_as_one() {
    let tabs = driver(|lines| lines.iter_mut().for_each(|line| *line = line.replace("          ", "\t")));
    let said = parse(&tabs).1.to_string();
    assert!(said.contains("44 lines contain tabs") && said.contains("error[tab]"), "{said}");
    assert!(!said.contains("series-missing") && !said.contains("unexpected-card"), "{said}");
    let numbered = driver(|lines| {
        lines.iter_mut().enumerate().for_each(|(i, line)| *line = format!("{line:<72.72}{:08}", 10 * (i + 1)));
    });
    let said = parse(&numbered).1.to_string();
    assert!(said.contains("columns 73–80 hold sequence numbers"), "{said}");
}

#[test]
fn a_decimal_point_that_slipped_is_doubted() {
    for (ncard, behind, column, text, variable) in [
        ("5", 0, 1, "      65.7", "XLS"),
        ("5", 0, 1, "      .657", "XLS"),
        ("5", 0, 11, "      33.5", "XLH"),
        ("5", 1, 11, "      92.0", "XLE(1)"),
        ("8", 1, 1, "      400.", "XV(1)"),
        ("8", 0, 1, "      290.", "VCW"),
        ("8", 0, 31, "      150.", "DSW"),
    ] {
        let found = warnings(&punched(ncard, behind, column, text));
        assert!(found.iter().any(|(rule, _, v)| *rule == Rule::Unlikely && v == variable), "{variable}: {found:?}");
    }
}

/// A text as an IBM 360 wrote it on tape.
fn ebcdic(text: &str) -> Vec<u8> {
    let letters = |first: u8, at: char, from: char| first + (at as u8 - from as u8);
    let code = |letter: char| match letter {
        ' ' => 0x40,
        '.' => 0x4b,
        '-' => 0x60,
        '+' => 0x4e,
        ',' => 0x6b,
        '/' => 0x61,
        '0'..='9' => letters(0xf0, letter, '0'),
        'A'..='I' => letters(0xc1, letter, 'A'),
        'J'..='R' => letters(0xd1, letter, 'J'),
        'S'..='Z' => letters(0xe2, letter, 'S'),
        '\n' => 0x15,
        other => panic!("no card has {other}"),
    };
    text.to_ascii_uppercase().chars().map(code).collect()
}

#[test]
fn decks_from_tapes_and_mainframes_are_read() {
    let plain = driver(|_| {}).to_ascii_uppercase();
    let records: String = plain.lines().map(|line| format!("{line:80}")).collect();
    let read = |bytes: &[u8]| cardio_legacy::Deck::parse(bytes, &Default::default());
    let expected = &parse(&plain).0[0];
    for (bytes, rules_found) in [
        (records.clone().into_bytes(), vec![Rule::NoLineEnds]),
        (format!("{records}\r\n").into_bytes(), vec![Rule::NoLineEnds]),
        (ebcdic(&plain), vec![Rule::Ebcdic]),
        (ebcdic(&records), vec![Rule::Ebcdic, Rule::NoLineEnds]),
    ] {
        let (decks, diagnostics) = read(&bytes);
        assert_eq!(other_notes(&diagnostics), rules_found, "{diagnostics}");
        assert!(!diagnostics.has_errors(), "{diagnostics}");
        assert!(decks[0].differences(expected).is_empty());
        assert_eq!(decks[0].titles(), expected.titles());
    }
    // a mistake is on its card
    let mut wrong = records.into_bytes();
    wrong[2 * 80 + 12] = b'?';
    let (_, diagnostics) = read(&wrong);
    assert_eq!(diagnostics.iter().find(|d| d.severity == Severity::Error).and_then(|d| d.line), Some(3));
}

#[test]
fn units_that_look_wrong_are_doubted() {
    let cases = [
        ("11", 4, 31, "      32.2", "GR"),
        ("11", 4, 31, "      9.81", "GR"),
        ("11", 0, 11, "       60.", "AGSN"),
        ("4", 0, 1, "      20.0", "VXVC"),
        ("4", 0, 1, "    29.333", "VXVC"),
        ("8", 0, 1, "       2.4", "VCW"),
        ("5", 1, 31, "       5.1", "XM(1)"),
    ];
    for (ncard, behind, column, text, variable) in cases {
        let found = warnings(&punched(ncard, behind, column, text));
        let doubted = found.iter().any(|(rule, _, v)| *rule == Rule::LooksLikeOtherUnit && v == variable);
        assert!(doubted, "{variable} = {text}: {found:?}");
        let (decks, _) = parse_as(&punched(ncard, behind, column, text), Strictness::Strict);
        assert!(decks.is_empty(), "strict reading refuses what it doubts");
    }
    let radians = punched("10", 0, 11, "       .26       .31       .09       .35       .61     -1.05");
    assert_eq!(warnings(&radians), [found(Rule::LooksLikeOtherUnit, 52, "GAMA1")].map(|f| (f.0, line_of("10"), f.2)));
}

fn line_of(ncard: &str) -> usize {
    first_card(&lines("driver-lap-torso.dat"), ncard) + 1
}

#[test]
fn contradictions_are_found() {
    let equality = punched("8", 4, 71, "      3.00");
    assert_eq!(warnings(&equality).len(), 0, "point 16 is in no equality");
    let equality = punched("8", 4, 11, "      13.5");
    assert_eq!(warnings(&equality), [found(Rule::CompartmentEquality, line_of("8") + 4, "ZV(13)")]);
    assert_eq!(errors(&punched("5", 1, 21, "      3.25")), [found(Rule::Impossible, line_of("5") + 1, "RHO(1)")]);
    assert_eq!(errors(&punched("5", 1, 61, "     .2489")), [found(Rule::Impossible, line_of("5") + 1, "ZIN(1)")]);
    assert_eq!(errors(&punched("9", 4, 41, "       30.")), [found(Rule::Impossible, line_of("9") + 4, "AMU1(4)")]);
    assert_eq!(warnings(&punched("9", 1, 21, "      200.")), [found(Rule::Unlikely, line_of("9") + 1, "STIF2(1)")]);
    assert_eq!(warnings(&punched("13", 2, 11, "       20.")), [found(Rule::Unlikely, line_of("13") + 2, "SK2(1)")]);
    assert_eq!(errors(&punched("3", 0, 11, "       .26")), [found(Rule::PathTooShort, 113, "CALT(51)")]);
    assert_eq!(errors(&punched("12", 2, 1, "        0.")), [found(Rule::Impossible, line_of("12") + 2, "CALT(2)")]);
    assert_eq!(errors(&punched("11", 0, 31, "    1.1000")), [found(Rule::Impossible, line_of("11"), "AGNN")]);
}

#[test]
fn counts_must_count() {
    for text in ["          ", "       2.5", "       -3.", "     1.E30"] {
        let found = errors(&punched("12", 0, 1, text));
        assert!(found.iter().any(|f| matches!(f.0, Rule::NotAWholeNumber | Rule::CountDiffers)), "{text}: {found:?}");
    }
    assert_eq!(errors(&punched("12", 0, 1, "       52.")), [found(Rule::CountDiffers, line_of("12"), "NVPOS")]);
}

#[test]
fn a_count_too_large_is_named_however_far_it_reaches() {
    // 110 pairs; the card 1000, the plot card and FINI stand behind them
    for count in ["111.", "112.", "113.", "114.", "500."] {
        let text = extended(|lines| {
            let at = first_card(lines, "14");
            punch(&mut lines[at], 1, &format!("{count:>10}"));
        });
        assert_eq!(errors(&text), [found(Rule::CountDiffers, 123, "NOCRD")], "{count}");
        let (_, diagnostics) = parse(&text);
        assert!(diagnostics.to_string().contains("as many cards as NOCRD says"), "{diagnostics}");
        let (decks, diagnostics) = parse_as(&text, Strictness::Lenient);
        assert_eq!(decks.len(), 1, "{diagnostics}");
        assert_eq!(decks[0].value("NOCRD"), Some(110.0));
    }
}

#[test]
fn the_card_number_10_that_i10_reads_as_1000_is_that_of_its_own_format() {
    let text = punched("10", 0, 71, "      10  ");
    assert_eq!(errors(&text), []);
    let (decks, diagnostics) = parse(&text);
    assert_eq!(other_notes(&diagnostics), [Rule::CardNumberByFormat], "{diagnostics}");
    assert_eq!(decks[0].value("GAMA1"), Some(15.0));
    // a 10 elsewhere is misplaced
    let text = punched("10", 0, 71, "     10   ");
    assert_eq!(errors(&text), [found(Rule::CardNumber, line_of("10"), "NCARD")]);
    let (_, diagnostics) = parse(&text);
    let said = diagnostics.to_string();
    assert!(said.contains("the card number reads as 10000") && said.contains("10 ending in column 80"), "{said}");
    let (decks, diagnostics) = parse_as(&text, Strictness::Lenient);
    assert_eq!(decks.len(), 1, "{diagnostics}");
    assert_eq!(decks[0].value("GAMA1"), Some(15.0));
}

#[test]
fn the_occupant_begins_with_the_velocity_that_the_vehicle_has_at_t1() {
    assert_eq!(warnings(&punched("4", 0, 1, "        0.        0.      352.")), [found(Rule::Inconsistent, 4, "VZVC")]);
    assert_eq!(warnings(&punched("4", 0, 11, "       99.")), [found(Rule::Inconsistent, 4, "VYVC")]);
    // At 0.06 s the half sine has slowed the vehicle down to 60.22 in/s.
    let later = |speed: &str| {
        driver(|lines| {
            punch(&mut lines[2], 1, "       .06");
            punch(&mut lines[3], 1, speed);
        })
    };
    assert_eq!(warnings(&later("      352.")), [found(Rule::Inconsistent, 4, "VXVC")]);
    let (_, diagnostics) = parse(&later("      352."));
    let vehicle = "the vehicle has (";
    let said = diagnostics.to_string();
    let speed: f64 = said.split_once(vehicle).and_then(|(_, rest)| rest.split(',').next()?.parse().ok()).expect(&said);
    assert!((30.0..80.0).contains(&speed), "{said}");
    assert_eq!(warnings(&later(&format!("{speed:>10}"))), []);
}

#[test]
fn a_small_fini_ends_the_file() {
    let small = driver(|lines| lines[118] = "fini".into());
    for strictness in [Strictness::Default, Strictness::Lenient] {
        let (decks, diagnostics) = parse_as(&small, strictness);
        assert_eq!(decks.len(), 1, "{diagnostics}");
        assert_eq!(rules(&diagnostics, Severity::Warning), [Rule::NoFinalCard]);
    }
}

#[test]
fn what_stands_in_place_of_fini_begins_no_deck() {
    for wrong in [" FINI", "FIN", "END"] {
        let deck = driver(|lines| lines[118] = wrong.into());
        for strictness in [Strictness::Default, Strictness::Lenient] {
            let (decks, diagnostics) = parse_as(&deck, strictness);
            assert_eq!(decks.len(), 1, "{diagnostics}");
            assert_eq!(errors(&deck), []);
            assert_eq!(warnings(&deck), [found(Rule::NoFinalCard, 119, "")]);
        }
    }
}

#[test]
fn a_blank_card_before_the_titles_is_shown_where_it_stands() {
    let blank = driver(|lines| lines.insert(0, String::new()));
    assert_eq!(errors(&blank), [found(Rule::UnexpectedCard, 1, "")]);
    let between = driver(|lines| lines.insert(2, "A THIRD TITLE".into()));
    assert_eq!(errors(&between), [found(Rule::UnexpectedCard, 3, "")]);
}

#[test]
fn plots_of_data_that_go_to_no_disk_are_doubted() {
    let undrawn = punched("3", 0, 61, "        1.");
    assert_eq!(warnings(&undrawn), [found(Rule::Inconsistent, 3, "NDISK")]);
    let report = parse(&undrawn).0[0].to_scenario(&Default::default()).expect("converts").report.to_string();
    assert!(
        !report.contains("plots were drawn") && report.contains("NDISK = 1 (card 3) kept off the disk"),
        "{report}"
    );
    let none = driver(|lines| {
        punch(&mut lines[2], 61, "        1.");
        lines[117] = "NONE".into();
    });
    assert_eq!(warnings(&none), []);
}

#[test]
fn no_deck_at_all_is_an_error() {
    for text in ["", "\n\n\n", "FINI\n", "   \r\n"] {
        let (decks, diagnostics): (_, Diagnostics) = parse(text);
        assert!(decks.is_empty());
        assert_eq!(rules(&diagnostics, Severity::Error), [Rule::EmptyFile], "{text:?}");
    }
}

/// The deck that extends a run, after a change to its lines.
fn extended(change: impl FnOnce(&mut Vec<String>)) -> String {
    let mut lines = lines("driver-exact-state-extended.dat");
    change(&mut lines);
    lines.join("\n") + "\n"
}

#[test]
fn a_passed_pair_whose_surface_is_left_out_is_named() {
    assert_eq!(warnings(&extended(|_| {})), []);
    let no_wheel = extended(|lines| {
        let at = first_card(lines, "8");
        punch(&mut lines[at], 31, "        0.");
    });
    let pairs_with_wheel: Vec<_> = no_wheel
        .lines()
        .enumerate()
        .filter(|(_, line)| line.len() < 12 && line.get(2..4) == Some("25"))
        .map(|(at, _)| at + 1)
        .collect();
    assert!(pairs_with_wheel.len() > 1, "{pairs_with_wheel:?}");
    let named = |severity| {
        let (_, diagnostics) = parse_as(&no_wheel, severity);
        let unused = diagnostics.iter().filter(|d| d.rule == Rule::PassedPairUnused);
        let shown: Vec<_> = unused.map(|d| (d.severity, d.line.unwrap_or_default())).collect();
        shown
    };
    let expected = |severity| pairs_with_wheel.iter().map(|line| (severity, *line)).collect();
    let warned: Vec<_> = expected(Severity::Warning);
    assert_eq!(named(Strictness::Default), warned);
    assert_eq!(named(Strictness::Lenient), warned);
    let refused: Vec<_> = expected(Severity::Error);
    assert_eq!(named(Strictness::Strict), refused);
    let (decks, diagnostics) = parse(&no_wheel);
    let text = diagnostics.to_string();
    let message = "the pair has no effect: surface 25, steering_wheel, has no diameter and is left out";
    assert!(text.contains(message), "{text}");
    let conversion = decks[0].to_scenario(&Default::default()).expect("converts");
    let said = conversion
        .report
        .ignored
        .iter()
        .filter(|text| text.starts_with("series 14, pair of sphere") && text.contains("has no diameter"));
    assert_eq!(said.count(), pairs_with_wheel.len());
}

#[test]
fn passed_pairs_of_a_seated_occupant_are_noted() {
    let series_14 = {
        let lines = lines("driver-exact-state-extended.dat");
        let at = first_card(&lines, "14");
        let mut cards = lines[at..at + 2].to_vec();
        punch(&mut cards[0], 1, "        1.");
        cards
    };
    let text = driver(|lines| {
        let at = first_card(lines, "1000");
        lines.splice(at..at, series_14);
    });
    let (decks, diagnostics) = parse(&text);
    assert_eq!(decks.len(), 1, "{diagnostics}");
    let notes = rules(&diagnostics, Severity::Note);
    assert!(notes.contains(&Rule::SeriesUnused), "{diagnostics}");
}
