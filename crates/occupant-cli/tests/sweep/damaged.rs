//! Damage in a finished folder is noticed, said and repaired by computing again.

use std::fs;
use std::path::{Path, PathBuf};

use super::{STUDY, answer, done, err, folder_with, spoken};
use crate::common::damage;

/// The piece of the journal that stands first.
fn piece(at: &Path) -> PathBuf {
    let entries = fs::read_dir(at.join("out/journal")).unwrap().map(|e| e.unwrap().path());
    entries.filter(|p| p.extension().is_some_and(|e| e == "rows")).min().unwrap()
}

#[test]
fn every_damaged_file_of_a_finished_sweep_is_named_and_made_again() {
    let folder = folder_with(&STUDY.replace("samples = 24", "samples = 6"));
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--quiet"];
    let kept = ["--keep", "5, 2", "--csv"];
    done(at, &[&words[..], &kept].concat());
    assert_eq!(spoken(at, &words), "", "nothing is damaged");
    for name in ["runs/000005.mcap", "inputs/0-study.toml", "inputs/1-case.toml", "sweep.json", "columns.csv"] {
        let file = at.join("out").join(name);
        let whole = fs::read(&file).unwrap();
        for cut in [true, false] {
            damage(&file, cut);
            // runs and tables are asked for today, or not
            let asked = if cut { &kept[..] } else { &[] };
            let said = spoken(at, &[&words[..], asked].concat());
            assert!(said.starts_with("damaged: ") && said.contains(name), "{name}: {said}");
            assert_eq!(said.lines().count(), 1, "{said}");
            assert!(whole == fs::read(&file).unwrap(), "{name} is not as it was");
        }
    }
    for name in ["results.parquet", "results.csv"] {
        damage(&at.join("out").join(name), false);
        assert!(spoken(at, &words).contains(name), "{name}");
        assert_eq!(spoken(at, &words), "");
    }
    let listed = fs::read_to_string(at.join("out/SHA256SUMS")).unwrap();
    // two tables, their columns, two runs and at least one piece of the journal, each once
    assert!(listed.lines().count() >= 6 && listed.contains("  runs/000002.mcap\n"), "{listed}");
}

#[test]
fn a_changed_number_in_the_journal_is_not_believed() {
    let folder = folder_with(&STUDY.replace("samples = 24", "samples = 6"));
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet"];
    done(at, &words);
    let whole = super::rows(at, "out");
    let digit = |text: &str| {
        let at = text.rfind("\"wall_time_s\"").unwrap();
        let cells = text[..at].rfind(|c: char| ('1'..='8').contains(&c)).unwrap();
        format!("{}9{}", &text[..cells], &text[cells + 1..])
    };
    let text = fs::read_to_string(piece(at)).unwrap();
    fs::write(piece(at), digit(&text)).unwrap();
    // who only reads refuses it, and says what mends it
    let report = answer(at, &["study", "report", "out"]);
    assert_eq!(report.status.code(), Some(2));
    assert!(err(&report).contains(".rows was changed after it was written"), "{}", err(&report));
    assert!(err(&report).contains("the same `occupant sweep`"), "{}", err(&report));
    assert!(spoken(at, &words).contains(".rows was changed after it was written"));
    assert_eq!(super::rows(at, "out"), whole);
    // one that cannot be read at all is computed again as well, listed or not
    fs::remove_file(at.join("out/SHA256SUMS")).unwrap();
    let text = fs::read_to_string(piece(at)).unwrap();
    fs::write(piece(at), text.replacen("{\"index\"", "{\"indes\"", 1)).unwrap();
    assert!(spoken(at, &words).contains(".rows was changed after it was written"));
    assert_eq!(super::rows(at, "out"), whole);
    done(at, &["study", "report", "out"]);
}
