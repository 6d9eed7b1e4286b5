//! The tables of the cards agree with themselves, with the document, and with the compartment's data file.

use std::collections::HashSet;

use cardio_legacy::CompartmentLayout;
use cardio_legacy::cards::{Format, SERIES, tables_as_markdown};

#[test]
fn fields_follow_one_another_without_overlap() {
    for series in SERIES.iter() {
        for card in &series.cards {
            let mut next = 1;
            for field in &card.fields {
                assert!(field.columns.first >= next, "series {} {:?}: {}", series.number, card.letter, field.variable);
                assert!(field.columns.last <= 80 && field.columns.last >= field.columns.first);
                next = field.columns.last + 1;
            }
        }
    }
}

#[test]
fn every_number_has_a_name_of_its_own() {
    let mut names = HashSet::new();
    let mut numbers = 0;
    for series in SERIES.iter() {
        for card in &series.cards {
            for field in card.fields.iter().filter(|f| f.variable != "NCARD" && f.format != Format::Text) {
                assert!(
                    names.insert((&field.variable, format!("{:?}", card.repeat))),
                    "{} comes twice",
                    field.variable
                );
                numbers += 1;
            }
        }
    }
    // 3: 7, 4: 3, 5: 2 + 7, 6: 4 + 62, 7: 17, 8: 4 + 44, 9: 7, 10: 9, 11: 35, 12: 1 + 7, 13: 7 + 8 + 6, 14: 1 + 3
    assert_eq!(numbers, 234);
}

#[test]
fn series_have_as_many_cards_as_the_report_says() {
    let cards = |number: usize| SERIES[number - 1].cards_behind_first().map(|n| n + 1);
    let expected = [(5, 13), (6, 9), (7, 4), (8, 7), (9, 26), (10, 2), (11, 5), (13, 3), (15, 1), (16, 1)];
    for (number, count) in expected {
        assert_eq!(cards(number), Some(count), "series {number}");
    }
    assert_eq!(cards(12), None);
    assert_eq!(cards(14), None);
}

#[test]
fn the_document_holds_the_tables() {
    let document = include_str!("../docs/cards.md").replace("\r\n", "\n");
    assert!(document.ends_with(&tables_as_markdown()), "write the tables into docs/cards.md again");
}

#[test]
fn the_compartment_file_is_sound_and_its_faults_are_named() {
    CompartmentLayout::reconstruction().expect("the file that travels with the crate");
    let text = include_str!("../src/compartment.toml");
    for (from, to, message) in [
        ("number = 7\n", "number = 8\n", "each once"),
        ("edge = [5, 6]", "edge = [5, 23]", "there are 22"),
        ("edge = [5, 6]\n", "", "either an edge"),
        ("wall = \"-VCW\"", "wall = \"VXW\"", "VXW"),
        ("tilt_deg", "tilt", "tilt"),
    ] {
        let error = CompartmentLayout::from_toml(&text.replacen(from, to, 1)).expect_err(to);
        assert!(error.contains(message), "{error}");
    }
}
