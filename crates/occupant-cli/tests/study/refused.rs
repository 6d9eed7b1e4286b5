//! What a report refuses, in words that help.

use std::fs;

use super::{STUDY, answer, done, err, spoken, swept};

#[test]
fn an_earlier_report_is_replaced_and_other_files_only_by_force() {
    let folder = swept(STUDY);
    let at = folder.path();
    done(at, &["study", "report", "out"]);
    let before = fs::read(at.join("out/report.html")).unwrap();
    let said = spoken(at, &["study", "report", "out"]);
    assert!(said.contains("an earlier report of this study (use -o to keep it)"), "{said}");
    // the same rows give the same page
    assert!(before == fs::read(at.join("out/report.html")).unwrap());
    // nor under a name that was asked for, nor a page of somebody else
    let named = ["study", "report", "out", "-o", "out/report.html"];
    let changed = String::from_utf8(before).unwrap().replacen("Report of the study", "Notes on the study", 1);
    for words in [&named[..], &["study", "report", "out"]] {
        let output = answer(at, words);
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).contains("replace it with --force"), "{}", err(&output));
        fs::write(at.join("out/report.html"), &changed).unwrap();
    }
    done(at, &["study", "report", "out", "--force"]);
    // a table alone is in the way, too
    fs::remove_file(at.join("out/report.html")).unwrap();
    let output = answer(at, &["study", "report", "out"]);
    assert!(err(&output).contains("report.parquet exists"), "{}", err(&output));
    assert!(!at.join("out/report.html").exists());
}

#[test]
fn the_tables_of_the_sweep_are_safe() {
    let folder = swept(STUDY);
    let at = folder.path();
    let before = fs::read(at.join("out/results.parquet")).unwrap();
    for name in ["out/results.html", "out/../out/results.html"] {
        let output = answer(at, &["study", "report", "out", "-o", name, "--force"]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(err(&output).contains("is a table of the sweep"), "{}", err(&output));
    }
    assert!(before == fs::read(at.join("out/results.parquet")).unwrap());
    let output = answer(at, &["study", "report", "out", "-o", "page.pdf"]);
    assert!(err(&output).contains("use the extension .html"), "{}", err(&output));
}

#[test]
fn what_is_no_study_is_told_from_one() {
    let folder = swept(STUDY);
    let at = folder.path();
    fs::create_dir(at.join("empty")).unwrap();
    for name in ["empty", "nowhere"] {
        let output = answer(at, &["study", "report", name]);
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).contains("does not contain a sweep"), "{}", err(&output));
    }
    let output = answer(at, &["study", "report", "study.toml"]);
    assert_eq!(output.status.code(), Some(2), "{}", err(&output));
    // a copy that somebody changed
    let copy = at.join("out/inputs/0-study.toml");
    let text = fs::read_to_string(&copy).unwrap();
    fs::write(&copy, text.replace("seed = 3", "seed = 4")).unwrap();
    let output = answer(at, &["study", "report", "out"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("was changed"), "{}", err(&output));
}

#[test]
fn a_figure_that_is_none_is_told_with_the_nearest() {
    let folder = swept(STUDY);
    let at = folder.path();
    let output = answer(at, &["study", "report", "out", "--to", "head.peak,hic51"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("did you mean `hic15`"), "{}", err(&output));
    let output = answer(at, &["study", "report", "out", "--to", "zzzzzzzzzz"]);
    assert!(err(&output).contains("the results are"), "{}", err(&output));
    assert!(!at.join("out/report.html").exists() && !at.join("out/report.parquet").exists());
    let output = answer(at, &["study"]);
    assert_eq!(output.status.code(), Some(2));
}
