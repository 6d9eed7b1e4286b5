//! Sweeps as sentences: what a user types, what is killed, and what the table says afterwards.

mod constrained;
mod damaged;
mod design;
mod interrupted;
mod kept;
mod limits;
mod parts;
mod rated;
mod refused;
mod shards;
mod stored;
mod table;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::common::{answer, done, err, folder_with, occupant, spoken};

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

/// Starts a sweep and kills it after it has written some rows.
fn killed(at: &Path, words: &[&str]) {
    let mut child = occupant(at).args(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let began = Instant::now();
    while computed(&at.join("out")).len() < 5 {
        assert!(
            child.try_wait().unwrap().is_none() && began.elapsed() < Duration::from_secs(120),
            "no row was written"
        );
        sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Files of a folder with this ending.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().map(|entry| entry.unwrap().path());
    let mut files: Vec<PathBuf> = entries.filter(|path| path.to_string_lossy().ends_with(ending)).collect();
    files.sort();
    files
}

/// How often each sample stands in the journal, by the whole lines of its pieces.
fn computed(out: &Path) -> BTreeMap<u64, u32> {
    let mut times = BTreeMap::new();
    for piece in files(&out.join("journal"), ".rows") {
        // one that was removed meanwhile has become a part
        let text = fs::read_to_string(piece).unwrap_or_default();
        for line in text.split_inclusive('\n').skip(1).filter(|line| line.ends_with('\n')) {
            let row: serde_json::Value = serde_json::from_str(line).unwrap();
            *times.entry(row["is"]["index"].as_u64().unwrap()).or_default() += 1;
        }
    }
    times
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
