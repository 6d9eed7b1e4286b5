//! The command and a folder to use it in, for all subjects that work with studies.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// The command, in a folder, without what the surroundings say of shards.
pub(crate) fn occupant(folder: &Path) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    command.current_dir(folder);
    for name in ["OCCUPANT_SHARD", "SLURM_ARRAY_TASK_ID"] {
        command.env_remove(name);
    }
    command
}

/// Runs the command with these words.
pub(crate) fn answer(folder: &Path, words: &[&str]) -> Output {
    let output = occupant(folder).args(words).output();
    output.expect("the command starts")
}

/// The same, and it does its work: what it said on standard output and on standard error.
pub(crate) fn both(folder: &Path, words: &[&str]) -> [String; 2] {
    let output = answer(folder, words);
    assert_eq!(output.status.code(), Some(0), "{words:?}: {}", err(&output));
    let said = err(&output);
    [String::from_utf8(output.stdout).expect("UTF-8"), said]
}

/// It does its work; what it prints.
pub(crate) fn done(folder: &Path, words: &[&str]) -> String {
    both(folder, words)[0].clone()
}

/// It does its work; what it says on standard error.
pub(crate) fn spoken(folder: &Path, words: &[&str]) -> String {
    both(folder, words)[1].clone()
}

pub(crate) fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A driver among faces, quick to run: belted, 50 km/h into a stop.
pub(crate) const CASE: &str = include_str!("case.toml");

/// A fresh folder with [`CASE`] as case.toml and a study.
pub(crate) fn folder_with(study: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("case.toml"), CASE).expect("a scenario");
    fs::write(folder.path().join("study.toml"), study).expect("a study");
    folder
}

/// Turns over a bit in the middle of a file, or cuts it off there.
pub(crate) fn damage(file: &Path, cut: bool) {
    let mut bytes = fs::read(file).expect("a file");
    let middle = bytes.len() / 2;
    if cut {
        bytes.truncate(middle)
    } else {
        bytes[middle] ^= 1
    }
    fs::write(file, bytes).expect("a file");
}
