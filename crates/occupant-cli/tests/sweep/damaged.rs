//! Damage in a finished folder is noticed, said and repaired by computing again.

use std::fs;

use super::{STUDY, answer, done, err, files, folder_with, killed, rows, spoken};
use crate::common::damage;

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
    // two tables, their columns and two runs, each once
    assert!(listed.lines().count() == 5 && listed.contains("  runs/000002.mcap\n"), "{listed}");
}

#[test]
fn a_changed_number_in_the_journal_is_not_believed() {
    let folder = folder_with(&STUDY.replace("samples = 24", "samples = 200"));
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet"];
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    killed(at, &words);
    let piece = files(&at.join("out/journal"), ".rows").remove(0);
    let text = fs::read_to_string(&piece).unwrap();
    let end = text.find("\"wall_time_s\"").unwrap();
    let digit = text[..end].rfind(|c: char| ('1'..='8').contains(&c)).unwrap();
    fs::write(&piece, format!("{}9{}", &text[..digit], &text[digit + 1..])).unwrap();
    // who only reads refuses it, and says what mends it
    let report = answer(at, &["study", "report", "out"]);
    assert_eq!(report.status.code(), Some(2));
    assert!(err(&report).contains(".rows has a row of another sweep in line 2"), "{}", err(&report));
    assert!(err(&report).contains("the same `occupant sweep`"), "{}", err(&report));
    let said = spoken(at, &words);
    assert!(said.contains(".rows was changed after it was written"), "{said}");
    assert_eq!(rows(at, "out"), rows(at, "whole"));
    done(at, &["study", "report", "out"]);
}

#[test]
fn a_damaged_part_is_named_by_who_reads_it_and_made_again_by_its_own_command() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    let first = ["sweep", "study.toml", "-o", "out", "--shard", "1/2", "--quiet", "--keep", "5, 2"];
    done(at, &first);
    done(at, &["sweep", "study.toml", "-o", "out", "--shard", "2/2", "--quiet"]);
    let part = at.join("out/parts/000000000-000000011.parquet");
    for cut in [true, false] {
        damage(&part, cut);
        for words in [&["sweep", "merge", "out"][..], &["study", "report", "out"], &["export", "out", "-o", "t.csv"]] {
            let refused = answer(at, words);
            assert_eq!(refused.status.code(), Some(2), "{words:?}");
            let said = err(&refused);
            assert!(said.contains("000000000-000000011.parquet was changed after it was written"), "{said}");
        }
        // the neighbour does not care
        assert_eq!(spoken(at, &["sweep", "study.toml", "-o", "out", "--shard", "2/2", "--quiet"]), "");
        let said = spoken(at, &first);
        assert!(said.starts_with("damaged: ") && said.contains("000000000-000000011.parquet"), "{said}");
        assert_eq!(spoken(at, &first), "");
    }
    // whole runs are hashed in the part that kept them
    let run = at.join("out/runs/000005.mcap");
    let whole = fs::read(&run).unwrap();
    assert!(!at.join("out/SHA256SUMS").exists());
    damage(&run, false);
    assert!(spoken(at, &first).contains("runs/000005.mcap"));
    assert!(whole == fs::read(&run).unwrap(), "another run");
    done(at, &["sweep", "merge", "out", "--csv"]);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
    let listed = fs::read_to_string(at.join("out/SHA256SUMS")).unwrap();
    assert!(listed.contains("  runs/000005.mcap\n"), "{listed}");
    // a damaged table is made again from the parts
    damage(&at.join("out/results.parquet"), false);
    let said = spoken(at, &["sweep", "merge", "out", "--csv"]);
    assert!(said.contains("results.parquet"), "{said}");
    done(at, &["study", "report", "out"]);
}
