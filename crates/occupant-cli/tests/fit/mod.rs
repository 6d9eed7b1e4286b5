//! Fits as sentences: planted numbers come back, what cannot be told is said, a killed fit ends at the same answer.

mod example;
mod killed;
mod recovered;
mod refused;
mod written;
mod wrong;

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::common::{self, answer, damage, done, err, occupant, spoken};

/// A fresh folder with a study and the case, whose occupant is the one with whom the bounds of these tests were
/// measured.
fn folder_with(study: &str) -> tempfile::TempDir {
    let folder = common::folder_with(study);
    let case = folder.path().join("case.toml");
    let text = fs::read_to_string(&case).unwrap();
    assert!(text.contains("[body]\npreset = \"male50\""), "{text}");
    fs::write(&case, text.replace("[body]\npreset = \"male50\"", "[body]\npreset = \"male50-1970\"")).unwrap();
    folder
}

/// The case up to the end of its belt loads.
const TIME: &str = "time.end=80 ms";

/// What is hidden in the tests: lap belt 90 kN/m instead of 70, torso slack 3.5 cm instead of 2.
const HIDDEN: [&str; 2] = ["belts.lap.k1=90 kN/m", "belts.torso.slack=3.5 cm"];

/// Two parameters to be found.
const STUDY: &str = r#"
title = "belts"
base = "case.toml"
seed = 5
set = { "time.end" = "80 ms" }

[[parameters]]
name = "lap"
path = "belts.lap.k1"
range = { from = "35 kN/m", to = "140 kN/m", scale = "log" }

[[parameters]]
name = "slack"
path = "belts.torso.slack"
range = { from = "0 cm", to = "6 cm" }

[fit]
filter = "CFC60"
from = "5 ms"
to = "75 ms"
budget = 160
"#;

/// Measures a run of the case with these changes into a table: belt forces and pelvis acceleration, each with
/// noise of `noise` of its largest value, the same for the same seed.
fn measure(folder: &Path, name: &str, changes: &[&str], noise: f64, seed: u64) {
    let mut run = vec!["run", "case.toml", "-o", "test.mcap", "--force", "--quiet", "--set", TIME];
    for change in changes {
        run.extend(["--set", change]);
    }
    done(folder, &run);
    let channels = "belt.lap.force,belt.torso.force,lower_torso.acceleration.x";
    let words = ["export", "test.mcap", "-o", "clean.csv", "--force", "--channels", channels];
    done(folder, &words);
    let text = fs::read_to_string(folder.join("clean.csv")).unwrap();
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    let head = lines.next().unwrap();
    let mut rows: Vec<Vec<f64>> = lines.map(|l| l.split(',').map(|c| c.parse().unwrap()).collect()).collect();
    let columns = rows[0].len();
    for column in 1..columns {
        let peak = rows.iter().map(|r| r[column].abs()).fold(0.0, f64::max);
        for (i, row) in rows.iter_mut().enumerate() {
            row[column] += noise * peak * normal(seed, (i * columns + column) as u64);
        }
    }
    let line = |row: &Vec<f64>| row.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let table: Vec<String> = rows.iter().map(line).collect();
    fs::write(folder.join(name), format!("{head}\n{}\n", table.join("\n"))).unwrap();
}

/// Nearly normal: the sum of twelve numbers of a small generator (SplitMix64).
fn normal(seed: u64, index: u64) -> f64 {
    let mut sum = -6.0;
    for k in 0..12 {
        let mut z = (seed << 32 ^ index << 4 ^ k).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        z = (z ^ z >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ z >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        sum += ((z ^ z >> 31) >> 11) as f64 / (1_u64 << 53) as f64;
    }
    sum
}

/// What a fit has found.
fn found(folder: &Path, out: &str) -> Value {
    let text = fs::read_to_string(folder.join(out).join("fit.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// A parameter of what was found.
fn parameter<'a>(found: &'a Value, name: &str) -> &'a Value {
    let all = found["parameters"].as_array().unwrap();
    all.iter().find(|p| p["name"] == name).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}
