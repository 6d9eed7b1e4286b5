//! `occupant sensitivity` from outside.

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// A folder with the short scenario.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let scenario = include_str!("recording/short.toml");
    std::fs::write(folder.path().join("short.toml"), scenario).expect("a scenario");
    folder
}

/// Runs the command with these words in a folder.
fn answer(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    let command = command.current_dir(folder).args(words);
    command.output().expect("the command starts")
}

/// The same, which must succeed; what it prints.
fn well(folder: &Path, words: &[&str]) -> String {
    let output = answer(folder, words);
    assert_eq!(output.status.code(), Some(0), "{words:?}: {}", err(&output));
    String::from_utf8(output.stdout).expect("UTF-8")
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

/// The columns of a CSV table by heading.
fn column(path: &Path, heading: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(path).expect("a table");
    let mut lines = text.lines();
    let headings: Vec<&str> = lines.next().expect("headings").split(',').collect();
    let at = headings.iter().position(|h| *h == heading);
    let at = at.unwrap_or_else(|| panic!("no {heading} in {headings:?}"));
    let cell = |line: &str| line.split(',').nth(at).expect("a cell").parse();
    lines.map(|line| cell(line).expect("a number")).collect()
}

#[test]
fn the_answer_holds_derivatives_secants_and_events() {
    let folder = folder();
    let words = [
        "sensitivity",
        "short.toml",
        "--to",
        "belts.lap.peak,chest.peak",
        "--of",
        "belts.lap.k1, belts.lap.slack",
        "--of",
        "joints.*.damping",
        "--json",
    ];
    let answer: Value = serde_json::from_str(&well(folder.path(), &words)).expect("JSON");
    let rows = answer["sensitivities"].as_array().expect("rows");
    assert_eq!(rows.len(), 6);
    let first = &rows[0];
    assert_eq!(first["measure"], "belts.lap.peak");
    assert_eq!(first["parameter"], "belts.lap.k1");
    assert_eq!(first["unit"], "N/(N/m)");
    assert_eq!(first["verdict"], "holds");
    let derivative = first["derivative"].as_f64().expect("a derivative");
    let value = answer["measures"][0]["value"].as_f64().expect("a value");
    let relative = first["relative"].as_f64().expect("relative");
    // Measured: equal to the last digit.
    assert!((relative - derivative * 70000.0 / value).abs() < 1e-12);
    let change = &first["changes"][0];
    assert_eq!(change["part"], 2e-3);
    for side in ["secant_below", "secant_above"] {
        let secant = change[side].as_f64().expect("a secant");
        assert!((secant / derivative - 1.0).abs() < 0.02, "{secant} {derivative}");
    }
    // nothing is relative to a slack of nothing
    assert_eq!(rows[1]["parameter"], "belts.lap.slack");
    assert!(rows[1]["relative"].is_null());
    // a factor on all joints
    assert_eq!(answer["parameters"][2]["value"], 1.0);
    assert_eq!(answer["parameters"][2]["unit"], "1");
    assert_eq!(rows[2]["unit"], "N");
    let events = answer["events"].as_array().expect("events");
    let tightens = |e: &&Value| e["what"] == "belt lap tightens" && e["change"] == "kink";
    assert!(events.iter().any(|e| tightens(&e)), "{events:?}");
    assert!(answer["cost"]["ratio"].as_f64().expect("a ratio") > 1.0);
}

#[test]
fn the_text_is_a_table_and_what_limits_it() {
    let folder = folder();
    let words = ["sensitivity", "short.toml", "--to", "belts.*.peak", "--of", "belts.lap.k1"];
    let text = well(folder.path(), &words);
    for part in [
        "belts.lap.peak",
        "belts.torso.peak",
        "N/(N/m)",
        "up to ±",
        "the motion is not smooth at",
        "belt lap tightens",
        "to the last bit",
    ] {
        assert!(text.contains(part), "no {part} in\n{text}");
    }
}

#[test]
fn channels_are_written_with_their_derivatives() {
    let folder = folder();
    let here = folder.path();
    let words = |output: &'static str| {
        [
            "sensitivity",
            "short.toml",
            "--of",
            "belts.lap.k1,posture.head",
            "--channels",
            "belt.lap.force,head.acceleration.*",
            "-o",
            output,
        ]
    };
    well(here, &words("out.csv"));
    let table = here.join("out.csv");
    let metadata = std::fs::read_to_string(here.join("out.csv-metadata.json")).expect("metadata");
    let metadata: Value = serde_json::from_str(&metadata).expect("JSON");
    let columns = metadata["tableSchema"]["columns"].as_array().expect("columns");
    assert_eq!(columns[2]["name"], "d(belt.lap.force)/d(belts.lap.k1)");
    assert_eq!(columns[2]["unit"], "N/(N/m)");
    assert_eq!(columns[3]["unit"], "N/rad");

    // the channel is that of the run, and its derivative what two runs beside it say
    let force = |k1: &str, name: &str| {
        let set = format!("belts.lap.k1={k1}");
        let file = format!("{name}.mcap");
        well(here, &["run", "short.toml", "-q", "--set", &set, "-o", &file]);
        let csv = format!("{name}.csv");
        well(here, &["export", &file, "--channels", "belt.lap.force", "-o", &csv]);
        column(&here.join(csv), "belt.lap.force[N]")
    };
    let plain = force("70000", "plain");
    assert_eq!(column(&table, "belt.lap.force[N]"), plain);
    let (below, above) = (force("69993", "below"), force("70007", "above"));
    let slopes = column(&table, "d(belt.lap.force)/d(belts.lap.k1)[N/(N/m)]");
    let greatest = slopes.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    assert!(greatest > 0.0);
    for (i, slope) in slopes.iter().enumerate() {
        let expected = (above[i] - below[i]) / 14.0;
        assert!((slope - expected).abs() < 1e-4 * greatest, "{i} {slope} {expected}");
    }

    // names that are taken stay, unless replacing them is asked for
    let told = refused(here, &words("out.csv"));
    assert!(told.contains("out.csv exists"), "{told}");
    let forced: Vec<&str> = words("out.csv").into_iter().chain(["--force"]).collect();
    well(here, &forced);
    well(here, &words("out.parquet"));
    let bytes = std::fs::read(here.join("out.parquet")).expect("a table");
    assert!(bytes.starts_with(b"PAR1"));
    let partial = std::fs::read_dir(here).expect("a folder");
    let left = partial.filter_map(Result::ok).map(|e| e.file_name());
    assert!(!left.into_iter().any(|n| n.to_string_lossy().contains("partial")));
}

#[test]
fn everything_that_is_wrong_is_told_at_once() {
    let folder = folder();
    let here = folder.path();
    let words = [
        "sensitivity",
        "short.toml",
        "--to",
        "belts.lap.pek,head.peak_time,solver.steps",
        "--of",
        "belts.lap.k3,surfaces.floor.material,joints.nek.damping",
        "--channels",
        "head.aceleration.x",
        "-o",
        "out.csv",
    ];
    let told = refused(here, &words);
    for part in [
        "did you mean `belts.lap.peak`?",
        "`head.peak_time` has no derivative",
        "`solver.steps` has no derivative",
        "`belts.lap` has nothing named `k3`",
        "is a text",
        "did you mean `neck`?",
        "did you mean `head.acceleration.x`?",
        "7 errors, nothing was computed",
    ] {
        assert!(told.contains(part), "no {part} in\n{told}");
    }
    assert!(!here.join("out.csv").exists());
    assert!(!here.join("out.partial.csv").exists());
}

#[test]
fn what_cannot_be_derived_is_refused_with_its_reason() {
    let folder = folder();
    let here = folder.path();
    let asked = |to: &str, of: &str, more: &[&str]| {
        let mut words = vec!["sensitivity", "short.toml", "--to", to, "--of", of];
        words.extend(more);
        refused(here, &words)
    };
    let told = asked("chest.peak", "time.end", &[]);
    assert!(told.contains("changes the times"), "{told}");
    let told = asked("chest.peak", "belts.lap.delta_b", &[]);
    assert!(told.contains("no value in this scenario"), "{told}");
    // a run of 1.5 ms has no level held for 3 ms
    let short = ["--set", "time.end=-0.0085"];
    let told = asked("head.three_ms_contiguous", "belts.lap.k1", &short);
    assert!(told.contains("no value in this run"), "{told}");
    let told = asked("chest.peak", "belts.lap.k1", &["-o", "out.txt", "--channels", "*"]);
    assert!(told.contains("unknown file format"), "{told}");
    let told = asked("chest.peak", "belts.lap.k1", &["-o", "short.toml"]);
    assert!(told.contains("--channel "), "{told}");
    let told = refused(here, &["sensitivity", "none.toml", "--to", "hic15", "--of", "gravity"]);
    assert!(told.contains("none.toml"), "{told}");
}
