//! Decks as editors, tapes and packers leave them: the right deck, or few messages.

use cardio_legacy::{Deck, Diagnostics, Rule, Severity};

use crate::support::{driver, parse, rules};

fn read(bytes: &[u8]) -> (Vec<Deck>, Diagnostics) {
    Deck::parse(bytes, &Default::default())
}

#[test]
fn decks_in_utf_16_and_with_filled_blocks_are_read() {
    let plain = driver(|_| {});
    let expected = &parse(&plain).0[0];
    let wide = |mark: [u8; 2], bytes: fn(u16) -> [u8; 2]| {
        [mark.to_vec(), plain.encode_utf16().flat_map(bytes).collect()].concat()
    };
    let filled = [plain.as_bytes(), &[0; 3000]].concat();
    for bytes in [wide([0xff, 0xfe], u16::to_le_bytes), wide([0xfe, 0xff], u16::to_be_bytes), filled] {
        let (decks, diagnostics) = read(&bytes);
        assert!(!diagnostics.has_errors(), "{diagnostics}");
        assert!(decks[0].differences(expected).is_empty());
    }
}

/// Packed files, records with their lengths, noise: one error.
#[test]
fn what_holds_no_cards_is_one_error() {
    let plain = driver(|_| {});
    let records: Vec<u8> =
        plain.lines().flat_map(|line| [&[0, 84, 0, 0][..], format!("{line:80}").as_bytes()].concat()).collect();
    let noise: Vec<u8> = (0..5000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    for bytes in [records, noise] {
        let (decks, diagnostics) = read(&bytes);
        assert!(decks.is_empty());
        assert_eq!(rules(&diagnostics, Severity::Error), [Rule::NotCards], "{diagnostics}");
    }
}

/// One slip in all lines, such as tabs for blanks, is not told line by line; the count is whole.
#[test]
fn of_one_kind_of_problem_a_few_are_shown() {
    let tabs = driver(|lines| lines.iter_mut().for_each(|line| *line = line.replace("        ", "\t")));
    let (_, diagnostics) = parse(&tabs);
    let words = diagnostics.to_string();
    let errors = diagnostics.count(Severity::Error);
    // 197 errors, 800 lines of text before
    assert!(errors > 150 && words.lines().count() < 150, "{errors}, {} lines", words.lines().count());
    assert!(words.contains(&format!("{errors} errors")) && words.contains(" more of the kind [tab]"), "{words}");
}
