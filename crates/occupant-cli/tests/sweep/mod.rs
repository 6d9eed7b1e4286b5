//! Sweeps as sentences: what a user types, what is killed, and what the table says afterwards.

mod interrupted;
mod kept;
mod refused;
mod shards;
mod table;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A short case on the cart, without time for the first contact to take long.
const STUDY: &str = r#"
title = "damping and speed"
base = "case.toml"
seed = 3
design = { kind = "latin_hypercube", samples = 24 }

[set]
"time.end" = "30 ms"

[[parameters]]
path = "joints.neck.damping"
range = { from = "10 in lbf s/rad", to = "40 in lbf s/rad" }

[[parameters]]
name = "speed"
path = "path.speed"
range = { from = "15 mph", to = "25 mph" }
"#;

/// The command, in a folder, without what the surroundings say of shards.
fn occupant(folder: &Path) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    command.current_dir(folder);
    for name in ["OCCUPANT_SHARD", "SLURM_ARRAY_TASK_ID"] {
        command.env_remove(name);
    }
    command
}

/// Runs the command with these words.
fn answer(folder: &Path, words: &[&str]) -> Output {
    let output = occupant(folder).args(words).output();
    output.expect("the command starts")
}

/// The same, and it does its work.
fn done(folder: &Path, words: &[&str]) -> String {
    let output = answer(folder, words);
    assert_eq!(output.status.code(), Some(0), "{words:?}: {}", err(&output));
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A fresh folder with the starter scenario as case.toml and the study.
fn folder_with(study: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    done(folder.path(), &["new", "case.toml"]);
    fs::write(folder.path().join("study.toml"), study).expect("a study");
    folder
}

/// The table as CSV, line by line, without wall time and kernel, which stand last.
fn rows(folder: &Path, name: &str) -> Vec<String> {
    let path = folder.join(name).join("results.csv");
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let same = |line: &str| {
        let (rest, _kernel) = line.rsplit_once(',').expect("columns");
        let (rest, _wall_time) = rest.rsplit_once(',').expect("columns");
        rest.to_owned()
    };
    text.lines().map(same).collect()
}

/// Values of one column.
fn column(rows: &[String], name: &str) -> Vec<String> {
    let at = rows[0].split(',').position(|n| n == name);
    let at = at.unwrap_or_else(|| panic!("no column {name} in {}", rows[0]));
    let value = |row: &String| cells(row).into_iter().nth(at).unwrap_or_default();
    rows[1..].iter().map(value).collect()
}

/// Cells of a line of CSV; a comma between quotes parts nothing.
fn cells(row: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for c in row.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells.last_mut().unwrap().push(c),
        }
    }
    cells
}
