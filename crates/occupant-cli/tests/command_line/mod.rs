//! The command line as sentences: what a user types and what comes back.

mod channels;
mod check;
mod exit_codes;
mod files;
mod interrupt;
mod measures;
mod new;
mod problems;
mod rating;
mod resume;
mod run;
mod windows;
mod words;

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;

/// The command, in a folder.
fn occupant(folder: &Path) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    command.current_dir(folder);
    command
}

/// Runs the command with these words.
fn answer(folder: &Path, words: &[&str]) -> Output {
    let output = occupant(folder).args(words).output();
    output.expect("the command starts")
}

/// A fresh folder with [`crate::common::CASE`] as case.toml.
fn folder_with_case() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("case.toml"), crate::common::CASE).expect("a scenario");
    folder
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("an exit code")
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

fn json(output: &Output) -> serde_json::Value {
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The cells of the table row that starts with `name`.
fn row(text: &str, name: &str) -> Vec<String> {
    let line = text.lines().find(|l| l.split_whitespace().next() == Some(name));
    let line = line.unwrap_or_else(|| panic!("no row {name} in\n{text}"));
    line.split_whitespace().map(str::to_owned).collect()
}
