//! Raw bytes as a deck: never a panic; what is handed out can be written and read again.
#![no_main]

use cardio_legacy::{Deck, ParseOptions, Strictness, write_file};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for strictness in [Strictness::Strict, Strictness::Default, Strictness::Lenient] {
        let (decks, diagnostics) = Deck::parse(
            bytes,
            &ParseOptions {
                file: "fuzz".into(),
                strictness,
            },
        );
        let _ = diagnostics.to_string();
        assert!(!decks.is_empty() || diagnostics.has_errors());
        for deck in &decks {
            let (again, diagnostics) = Deck::parse(
                write_file(std::slice::from_ref(deck)),
                &ParseOptions::default(),
            );
            assert!(!diagnostics.has_errors(), "{diagnostics}");
            assert_eq!(again[0].differences(deck), []);
        }
    }
});
