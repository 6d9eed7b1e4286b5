//! Time histories out of a run and into it: `export`, `plot`, `compare`.

mod compare;
mod export;
mod plot;
mod protocol;

use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::LazyLock;

use assert_cmd::Command;
use tempfile::TempDir;

/// A run with outputs 1 ms apart, and one with 0.25 ms.
struct Runs {
    folder: TempDir,
}

static RUNS: LazyLock<Runs> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a folder");
    let scenario = include_str!("../recording/short.toml");
    std::fs::write(folder.path().join("short.toml"), scenario).expect("a scenario");
    for (name, interval) in [("coarse.mcap", "1 ms"), ("fine.mcap", "0.25 ms")] {
        let set = format!("output.interval=\"{interval}\"");
        let words = ["run", "short.toml", "-q", "-o", name, "--set", &set];
        let output = answer(folder.path(), &words);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    }
    Runs { folder }
});

/// The run with outputs 1 ms apart.
fn coarse() -> PathBuf {
    RUNS.folder.path().join("coarse.mcap")
}

/// The run with outputs 0.25 ms apart.
fn fine() -> PathBuf {
    RUNS.folder.path().join("fine.mcap")
}

/// Runs the command with these words in a folder.
fn answer(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    command.current_dir(folder).args(words).output().expect("the command starts")
}

/// The same, which must succeed.
fn well(folder: &Path, words: &[&str]) -> Output {
    let output = answer(folder, words);
    assert_eq!(output.status.code(), Some(0), "{words:?}: {}", err(&output));
    output
}

/// The same, which must be refused; what it says.
fn refused(folder: &Path, words: &[&str]) -> String {
    let output = answer(folder, words);
    assert_eq!(output.status.code(), Some(2), "{words:?}: {}", err(&output));
    assert!(output.stdout.is_empty(), "{words:?}");
    err(&output)
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).expect("a text file")
}

/// Headings and columns of an exported table.
fn table(path: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = text(path);
    let mut lines = text.lines();
    let headings: Vec<String> = lines.next().expect("headings").split(',').map(str::to_owned).collect();
    let mut columns = vec![Vec::new(); headings.len()];
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), headings.len());
        for (column, cell) in columns.iter_mut().zip(cells) {
            column.push(cell.parse().expect("a number"));
        }
    }
    (headings, columns)
}

/// A column of a table.
fn column(path: &Path, heading: &str) -> Vec<f64> {
    let (headings, mut columns) = table(path);
    let at = headings.iter().position(|h| h == heading);
    columns.swap_remove(at.unwrap_or_else(|| panic!("no {heading} in {headings:?}")))
}
