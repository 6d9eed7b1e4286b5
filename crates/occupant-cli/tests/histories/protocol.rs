//! `occupant compare --protocol`.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;

use super::{answer, coarse, err, refused, well};

/// Sensors of the far-side protocol in ISO-MME codes, and the head: unit and largest values of the axes.
const SENSORS: [(&str, &str, f64); 18] = [
    ("11HEAD0000WSAVXA", "rad/s", 20.0),
    ("11HEAD0000WSAVYA", "rad/s", 10.0),
    ("11HEAD0000WSAVZA", "rad/s", 10.0),
    ("11THSP0400WSACXA", "g", 5.0),
    ("11THSP0400WSACYA", "g", 20.0),
    ("11THSP0400WSACZA", "g", 5.0),
    ("11THSP1200WSACXA", "g", 5.0),
    ("11THSP1200WSACYA", "g", 20.0),
    ("11THSP1200WSACZA", "g", 5.0),
    ("11PELV0000WSACXA", "g", 5.0),
    ("11PELV0000WSACYA", "g", 20.0),
    ("11PELV0000WSACZA", "g", 5.0),
    ("14BPILLO0000ACXC", "g", 5.0),
    ("14BPILLO0000ACYC", "g", 20.0),
    ("14BPILLO0000ACZC", "g", 5.0),
    ("11SEBE0003B3FO0C", "kN", 3.0),
    ("11HEAD0000WSACYA", "g", 70.0),
    ("11HEAD0000WSACZA", "g", 1.0),
];

/// A table at 10 kHz of half sines of 100 ms; `change` gives a factor on a column, none leaves it out.
fn table(path: &Path, change: impl Fn(&str) -> Option<f64>) {
    let columns: Vec<_> =
        SENSORS.iter().filter_map(|(name, unit, most)| Some((name, unit, most * change(name)?))).collect();
    let mut text = "t[s]".to_owned();
    columns.iter().for_each(|(name, unit, _)| text += &format!(",{name}[{unit}]"));
    text += ",11HEAD0000WSACXA[g]";
    for i in 0..1500 {
        let t = f64::from(i) * 1e-4;
        let _ = write!(text, "\n{t}");
        let shape = if t < 0.1 { (PI * t / 0.1).sin() } else { 0.0 };
        columns.iter().for_each(|(_, _, most)| text += &format!(",{}", most * shape));
        text += &format!(",{}", 0.1 * shape);
    }
    std::fs::write(path, text).unwrap();
}

fn protocol(folder: &Path, words: &[&str]) -> Value {
    let words = [&["compare"], words, &["--json"]].concat();
    let told: Value = serde_json::from_slice(&well(folder, &words).stdout).unwrap();
    told["protocol"].clone()
}

fn sensor<'a>(told: &'a Value, name: &str) -> &'a Value {
    told["sensors"].as_array().unwrap().iter().find(|own| own["sensor"] == name).unwrap_or_else(|| panic!("{told:#}"))
}

/// The same histories: 1 for each sensor. Without T12: open. An axis reversed: its score by its weight, 20 of 40.
#[test]
fn far_side_asks_six_sensors_and_two_criteria() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    table(&here.join("test.csv"), |_| Some(1.0));
    table(&here.join("same.csv"), |_| Some(1.0));
    let far = ["--protocol", "far-side"];
    let told = protocol(here, &[&["same.csv", "test.csv"], &far[..]].concat());
    assert_eq!(told["valid"], true, "{told:#}");
    assert_eq!(told["sensors"].as_array().unwrap().len(), 6);
    assert!(
        told["sensors"]
            .as_array()
            .unwrap()
            .iter()
            .all(|own| own["score"].as_f64().is_some_and(|s| (s - 1.0).abs() < 1e-9))
    );
    let head = &told["criteria"][1];
    assert!((head["limit"].as_f64(), head["difference"].as_f64()) == (Some(80.0), Some(0.0)), "{head}");
    let text =
        String::from_utf8(well(here, &[&["compare", "same.csv", "test.csv"], &far[..]].concat()).stdout).unwrap();
    assert!(text.contains("Model valid") && text.contains("version 1.0, June 2023"), "{text}");

    table(&here.join("less.csv"), |name| (!name.contains("THSP12")).then_some(1.0));
    let told = protocol(here, &[&["less.csv", "test.csv"], &far[..]].concat());
    assert!(told["valid"].is_null() && sensor(&told, "T12 acceleration")["passed"].is_null());
    assert!(sensor(&told, "T12 acceleration")["remark"].as_str().unwrap().starts_with("missing"));
    let strict = [&["compare", "less.csv", "test.csv", "--strict"], &far[..]].concat();
    assert_eq!(answer(here, &strict).status.code(), Some(1));

    table(&here.join("turned.csv"), |name| Some(if name.ends_with("AVXA") { -1.0 } else { 1.0 }));
    let told = protocol(here, &[&["turned.csv", "test.csv"], &far[..]].concat());
    let own = sensor(&told, "head angular velocity");
    let axis = &own["channels"][0];
    assert_eq!(axis["weight"].as_f64(), Some(0.5));
    let expected = 0.5 * axis["score"].as_f64().unwrap() + 0.5;
    assert!((own["score"].as_f64().unwrap() - expected).abs() < 1e-9 && axis["score"].as_f64().unwrap() < 0.5);
}

/// 3 ms of 70 g over 80 g are 87.4 %; of 44 g 55 %: 32 % apart. 35 g in the test are below half of the limit.
#[test]
fn criteria_of_half_their_limit_may_not_lie_apart() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let only = |factor: f64| move |name: &str| Some(if name.contains("HEAD0000WSAC") { factor } else { 1.0 });
    for (name, factor) in [("whole.csv", 1.0), ("part.csv", 44.0 / 70.0), ("half.csv", 0.5)] {
        table(&here.join(name), only(factor));
    }
    let told = |computed: &str, test: &str| protocol(here, &[computed, test, "--protocol", "far-side"]);
    let head = |told: &Value| told["criteria"][1].clone();
    let apart = told("part.csv", "whole.csv");
    let difference = head(&apart)["difference"].as_f64().unwrap();
    assert!(
        (difference - 0.325).abs() < 0.01 && head(&apart)["passed"] == false && apart["valid"] == false,
        "{apart:#}"
    );
    let small = told("whole.csv", "half.csv");
    assert!(
        head(&small)["passed"] == true && head(&small)["remark"].as_str().unwrap().contains("below half"),
        "{small:#}"
    );
}

/// A run has no T4 and no T12: what stands in says so, and the rest is missing.
#[test]
fn a_run_says_what_stands_in_and_what_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    let told = protocol(folder.path(), &[run, run, "--protocol", "far-side", "--channel", "*.acceleration.*"]);
    assert!(told["valid"].is_null(), "{told:#}");
    assert!(sensor(&told, "T4 acceleration")["remark"].as_str().unwrap().contains("stands in for T4"), "{told:#}");
    assert!(sensor(&told, "head angular velocity")["remark"].as_str().unwrap().starts_with("missing"));
    let told = protocol(folder.path(), &[run, run, "--protocol", "frontal"]);
    assert!(told["source"].as_str().unwrap().contains("not at hand"));
    let criteria: Vec<&str> =
        told["criteria"].as_array().unwrap().iter().filter_map(|own| own["criterion"].as_str()).collect();
    assert!(criteria.contains(&"HIC15") && criteria.contains(&"Fz,tension"), "{criteria:?}");
    let said = refused(folder.path(), &["compare", run, run, "--strict"]);
    assert!(said.contains("--protocol"), "{said}");
    let none = answer(folder.path(), &["compare", run, run, "--protocol", "rear"]);
    assert!(none.status.code() == Some(2) && err(&none).contains("far-side"));
}
