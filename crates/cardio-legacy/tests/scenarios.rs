//! Decks as scenarios: the committed texts are in step, they run, and the way back gives the same deck.

mod support;

use cardio_legacy::{ConversionError, ConvertOptions, Deck, ParseOptions, PathSource};
use occupant_core::model::Model;
use occupant_core::scenario::document::Format;
use occupant_core::scenario::{Loaded, Scenario};
use occupant_core::simulate::{Status, simulate};
use support::{DECKS, bytes, path};

fn deck(name: &str) -> Deck {
    let (decks, diagnostics) = Deck::parse(bytes(name), &ParseOptions::default());
    decks
        .into_iter()
        .next()
        .unwrap_or_else(|| panic!("{name}\n{diagnostics}"))
}

fn options(name: &str) -> ConvertOptions {
    let csv = name.replace(".dat", ".csv");
    let text = std::fs::read_to_string(path(&csv)).ok();
    ConvertOptions {
        deck_name: name.into(),
        path: text.map(|text| PathSource::Csv { name: csv, text }),
        compartment: None,
    }
}

fn load(toml: &str) -> Loaded {
    let resolver = |name: &str| std::fs::read(path(name)).map_err(|e| e.to_string());
    Scenario::from_text(toml, Format::Toml, "test", &resolver).unwrap_or_else(|d| panic!("{d}"))
}

fn model(toml: &str) -> Model {
    load(toml).model().unwrap_or_else(|d| panic!("{d}")).0
}

#[test]
fn the_committed_scenarios_are_the_converted_decks() {
    for name in DECKS {
        let conversion = deck(name)
            .to_scenario(&options(name))
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let file = path(&name.replace(".dat", ".toml"));
        if std::env::var_os("WRITE_CONVERTED").is_some() {
            std::fs::write(&file, &conversion.toml).expect("written");
        }
        let committed = std::fs::read_to_string(&file).unwrap_or_default();
        assert!(
            committed == conversion.toml,
            "{} is not the conversion of {name}; write it again with WRITE_CONVERTED=1",
            file.display()
        );
    }
}

#[test]
fn every_converted_deck_runs_to_its_end() {
    for name in DECKS {
        let conversion = deck(name)
            .to_scenario(&options(name))
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let (model, warnings) = load(&conversion.toml)
            .model()
            .unwrap_or_else(|d| panic!("{name}\n{d}"));
        eprintln!("{name}\n{warnings}");
        let outcome = simulate(&model, ()).expect("records nothing");
        eprintln!(
            "{:?} {} {:?}",
            outcome.status, outcome.balance_error, outcome.effort
        );
        for t in outcome.first_touches.iter().take(20) {
            eprintln!(
                "{:?} {} {}",
                t,
                model.setup().surfaces[t.surface].name,
                model.setup().body.spheres[t.sphere].name
            );
        }
        assert_eq!(outcome.status, Status::Completed, "{name}");
    }
}

#[test]
fn deck_to_scenario_to_deck_is_the_same_deck() {
    for name in DECKS {
        let deck = deck(name);
        let conversion = deck
            .to_scenario(&options(name))
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        let back = Deck::from_scenario(&load(&conversion.toml), None)
            .unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(back.deck.differences(&deck), [], "{name}");
        assert_eq!(
            back.remarks
                .iter()
                .filter(|r| !r.starts_with("MREAD"))
                .count(),
            0,
            "{:?}",
            back.remarks
        );
        assert_eq!(
            back.deck.write(),
            deck.write(),
            "{name}: to the last column"
        );
    }
}
