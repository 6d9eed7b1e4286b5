//! A sealed case: whole, altered, taken apart, run again.

use std::fs;

use crate::common::{answer, done, err, folder_with, spoken};

fn sealed() -> tempfile::TempDir {
    let folder = folder_with("");
    done(folder.path(), &["run", "case.toml", "-q", "--until", "60 ms", "-o", "run.mcap"]);
    done(folder.path(), &["seal", "run.mcap", "-o", "case.html"]);
    folder
}

#[test]
fn a_case_is_verified_run_again_and_the_same_bytes_come_out_twice() {
    let folder = sealed();
    let told = done(folder.path(), &["seal", "case.html", "--verify", "--again"]);
    assert!(told.contains("every byte") && told.contains("same to the bit"), "{told}");
    done(folder.path(), &["seal", "run.mcap", "-o", "twice.html"]);
    let bytes = |name: &str| fs::read(folder.path().join(name)).expect("a case");
    assert!(bytes("case.html") == bytes("twice.html") && bytes("case.html").len() <= 5_000_000);
}

#[test]
fn an_altered_byte_is_named_wherever_it_stands() {
    let folder = sealed();
    let whole = fs::read(folder.path().join("case.html")).expect("a case");
    for at in (0..whole.len()).step_by(whole.len() / 24).chain([whole.len() - 1, whole.len() - 70]) {
        let mut bytes = whole.clone();
        bytes[at] ^= 1;
        fs::write(folder.path().join("x.html"), bytes).expect("written");
        let output = answer(folder.path(), &["seal", "x.html", "--verify"]);
        assert!(output.status.code() == Some(1) && err(&output).contains("altered: "), "{at}: {}", err(&output));
    }
}

#[test]
fn what_is_taken_out_runs_to_the_same_case() {
    let folder = sealed();
    spoken(folder.path(), &["seal", "case.html", "--extract", "out"]);
    let out = folder.path().join("out");
    assert!(fs::read(out.join("run.mcap")).expect("a run") == fs::read(folder.path().join("run.mcap")).expect("a run"));
    done(&out, &["run", "resolved.toml", "-q", "-o", "again.mcap"]);
    let there = done(&out, &["measures", "run.mcap", "--json"]);
    assert_eq!(there, done(&out, &["measures", "again.mcap", "--json"]));
}
