//! `occupant study report` as sentences: what stands on the page, what its commands give, what it refuses; and its analyses
//! on functions whose answers are known.

mod again;
mod bands;
mod known;
mod page;
mod refused;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use occupant_cli::results::Results;

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

/// The same, and it does its work; what it said on standard error.
fn done(folder: &Path, words: &[&str]) -> String {
    let output = answer(folder, words);
    assert_eq!(output.status.code(), Some(0), "{words:?}: {}", err(&output));
    err(&output)
}

fn err(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A fresh folder with the starter scenario as case.toml and a study of it, whose runs are short.
fn folder_with(study: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    done(folder.path(), &["new", "case.toml"]);
    let text = format!("base = \"case.toml\"\n{study}");
    fs::write(folder.path().join("study.toml"), text).expect("a study");
    folder
}

/// The same, swept into out/.
fn swept(study: &str) -> tempfile::TempDir {
    let folder = folder_with(study);
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet"];
    done(folder.path(), &words);
    folder
}

/// The page of out/.
fn page(folder: &Path) -> String {
    done(folder, &["study", "report", "out", "--force"]);
    fs::read_to_string(folder.join("out/report.html")).expect("a page")
}

/// All figures of a results file.
fn figures(file: &Path) -> Vec<(String, Option<f64>)> {
    let results = Results::open(file).unwrap_or_else(|e| panic!("{e:?}"));
    let summary = results.summary().unwrap_or_else(|e| panic!("{e:?}"));
    let figures = summary.figures(&results.model).into_iter();
    figures.map(|f| (f.name, f.value)).collect()
}

/// Two parameters, 24 samples.
const STUDY: &str = r#"
title = "damping <and> speed"
seed = 3
design = { kind = "latin_hypercube", samples = 24 }
set = { "time.end" = "30 ms" }

[[parameters]]
path = "joints.neck.damping"
range = { from = "10 in lbf s/rad", to = "40 in lbf s/rad" }

[[parameters]]
name = "speed"
path = "path.speed"
range = { from = "15 mph", to = "25 mph" }
"#;
