//! Sweeps as sentences: what a user types, what is killed, and what the table says afterwards.

mod damaged;
mod design;
mod interrupted;
mod kept;
mod refused;
mod shards;
mod table;

use std::fs;
use std::path::Path;

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
