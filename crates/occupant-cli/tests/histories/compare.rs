//! `occupant compare`.

use std::f64::consts::PI;
use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;

use super::{answer, coarse, column, err, fine, refused, well};

/// Writes t[s],a and a function at 10 kHz.
fn signal(folder: &Path, name: &str, samples: usize, value: impl Fn(f64) -> f64) {
    let mut text = "t[s],a[g]\n".to_owned();
    for i in 0..samples {
        let t = i as f64 * 1e-4;
        let _ = writeln!(text, "{t},{}", value(t));
    }
    std::fs::write(folder.join(name), text).unwrap();
}

fn rated(folder: &Path, words: &[&str]) -> Value {
    let words = [&["compare"], words, &["--json"]].concat();
    serde_json::from_slice(&well(folder, &words).stdout).unwrap()
}

fn close(value: &Value, expected: f64, bound: f64) {
    let found = value.as_f64().unwrap_or_else(|| panic!("{value} is no number"));
    assert!((found - expected).abs() < bound, "{found} instead of {expected}");
}

/// The vectors that the open-source OpenVT implementation of ISO/TS 18571 gives, through the command.
#[test]
fn iso_18571_scores_are_those_of_another_implementation() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    signal(here, "m.csv", 1500, |t| (20.0 * t).sin());
    signal(here, "c.csv", 1500, |t| 1.3 * (20.0 * t).sin());
    let scores = |answer: &Value, [r, z, p, m, s]: [f64; 5]| {
        let iso = &answer["pairs"][0]["iso18571"];
        for (name, expected) in [("overall", r), ("corridor", z), ("phase", p), ("magnitude", m), ("slope", s)] {
            close(&iso[name], expected, 1e-6);
        }
    };
    let answer = rated(here, &["c.csv", "m.csv"]);
    assert_eq!(answer["pairs"][0]["samples"], 1500);
    scores(&answer, [0.713_086_3, 0.477_862_7, 1.0, 0.759_706_0, 0.85]);
    let half_sine = |t: f64| match t {
        t if (0.0..=0.08).contains(&t) => 50.0 * (PI * t / 0.08).sin(),
        _ => 0.0,
    };
    signal(here, "m2.csv", 1000, half_sine);
    signal(here, "c2.csv", 1000, |t| 0.9 * half_sine(t - 0.003));
    let answer = rated(here, &["c2.csv", "m2.csv"]);
    scores(&answer, [0.885_605_9, 0.838_555_9, 0.85, 0.950_917_9, 0.95]);
    close(&answer["pairs"][0]["iso18571"]["lag_s"], 0.003, 1e-9);
    // a pair of files without headings
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crash-measures/tests/data");
    let [computed, reference] = ["computed", "reference"].map(|n| data.join(format!("iso18571_{n}.csv")));
    let answer = rated(here, &[computed.to_str().unwrap(), reference.to_str().unwrap()]);
    scores(&answer, [0.830_957_7, 0.652_890_7, 0.941_666_7, 0.950_654_0, 0.956_686_5]);
}

#[test]
fn sprague_geers_and_anova_are_closed_forms() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // two whole periods
    let sine = |t: f64, lag: f64| (2.0 * PI * (10.0 * t - lag)).sin();
    signal(here, "m.csv", 2000, |t| sine(t, 0.0));
    signal(here, "larger.csv", 2000, |t| 1.3 * sine(t, 0.0));
    signal(here, "late.csv", 2000, |t| 1.2 * sine(t, 0.1));
    let of = |file: &str| rated(here, &[file, "m.csv"])["pairs"][0].clone();
    let larger = of("larger.csv");
    close(&larger["sprague_geers"]["magnitude"], 0.3, 1e-9);
    close(&larger["sprague_geers"]["phase"], 0.0, 1e-7);
    close(&larger["anova"]["mean"], 0.0, 1e-9);
    // 0.3/√2, over n − 1
    close(&larger["anova"]["standard_deviation"], 0.3 * (1000.0_f64 / 1999.0).sqrt(), 1e-9);
    let late = of("late.csv");
    close(&late["sprague_geers"]["magnitude"], 0.2, 1e-9);
    close(&late["sprague_geers"]["phase"], 0.2, 1e-7);
    close(&late["sprague_geers"]["combined"], 0.08_f64.sqrt(), 1e-7);
    assert_eq!(late["sprague_geers"]["within_40_percent"], true);
}

#[test]
fn a_run_against_its_own_export_is_perfect_whatever_the_units() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    let channels = "head.acceleration.resultant,vehicle.acceleration.x";
    well(folder.path(), &["export", run, "-o", "own.csv", "--units", "g", "--channels", channels]);
    let answer = rated(folder.path(), &[run, "own.csv"]);
    let pairs = answer["pairs"].as_array().unwrap();
    assert_eq!(pairs.len(), 2);
    for pair in pairs {
        close(&pair["iso18571"]["overall"], 1.0, 1e-9);
        close(&pair["cora"]["overall"], 1.0, 1e-9);
        close(&pair["sprague_geers"]["magnitude"], 0.0, 1e-12);
        close(&pair["anova"]["standard_deviation"], 0.0, 1e-12);
        close(&pair["from_s"], -0.01, 1e-12);
    }
    assert_eq!(answer["measured"]["file"], "own.csv");
    // as a table, with the runs' names
    let text = String::from_utf8(well(folder.path(), &["compare", run, "own.csv"]).stdout).unwrap();
    for words in ["ISO/TS 18571", "1.000 excellent", "CORA", "Sprague–Geers", "ANOVA", "10 kHz"] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
}

#[test]
fn maps_choose_columns_units_signs_and_clocks() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    well(folder.path(), &["export", run, "-o", "own.csv", "--channels", "head.acceleration.z"]);
    let values = column(&folder.path().join("own.csv"), "head.acceleration.z[m/s^2]");
    let times = column(&folder.path().join("own.csv"), "time[s]");
    let mut text = "time (ms);down\n".to_owned();
    for (t, v) in times.iter().zip(&values) {
        let _ = writeln!(text, "{};{}", (t + 2.0) * 1e3, -v / 9.80665);
    }
    std::fs::write(folder.path().join("lab.csv"), text).unwrap();
    let map = ["--map", "down[g]=-head.acceleration.z", "--shift=-2"];
    let answer = rated(folder.path(), &[&[run, "lab.csv"], &map[..]].concat());
    close(&answer["pairs"][0]["iso18571"]["overall"], 1.0, 1e-9);
    let answer = rated(folder.path(), &[&[run, "lab.csv"], &map[..], &["--from", "0", "--to", "20 ms"]].concat());
    assert_eq!(answer["pairs"][0]["samples"], 201);
    let said = refused(folder.path(), &["compare", run, "lab.csv", "--map", "down[kN]=head.acceleration.z"]);
    assert!(said.contains("is in kN, but head.acceleration.z in m/s²"), "{said}");
    let said = refused(folder.path(), &["compare", run, "lab.csv", "--map", "up=head.acceleration.z"]);
    assert!(said.contains("no column `up`") && said.contains("it has down"), "{said}");
    let said = refused(folder.path(), &["compare", run, "lab.csv", "--map", "down[g]=head.z"]);
    assert!(said.contains("`head.z`"), "{said}");
    assert!(refused(folder.path(), &["compare", run, "lab.csv"]).contains("--map"));
}

#[test]
fn two_runs_are_compared_by_names() {
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (coarse(), fine());
    let answer = rated(folder.path(), &[a.to_str().unwrap(), b.to_str().unwrap()]);
    let pairs = answer["pairs"].as_array().unwrap();
    assert!(pairs.len() > 15, "{}", pairs.len());
    let head = pairs.iter().find(|p| p["channel"] == "head.acceleration.resultant").unwrap();
    // the same motion seen at two rates (0.996)
    assert!(head["iso18571"]["overall"].as_f64().unwrap() > 0.98, "{head}");
}

#[test]
fn broken_tests_are_refused_with_their_lines() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    for (content, expected) in [
        ("t[s],head.acceleration.x[g]\n0,1\n0.01,two\n", "bad.csv:3"),
        ("t[s],head.acceleration.x[furlong]\n0,1\n0.01,2\n", "`furlong`"),
        ("t[s],head.acceleration.x[kN]\n0,1\n0.01,2\n", "is in kN"),
        ("t[s],head.acceleration.x[g]\n5,1\n6,2\n", "no common time"),
        ("t[s],head.acceleration.x[g]\n0,1\n0.005,NaN\n0.01,2\n", "no value at 0.005 s"),
        ("", "empty table"),
    ] {
        std::fs::write(folder.path().join("bad.csv"), content).unwrap();
        let said = refused(folder.path(), &["compare", run, "bad.csv"]);
        assert!(said.contains(expected), "{said}");
    }
    let said = refused(folder.path(), &["compare", run, "."]);
    assert!(said.contains("without a .mme file"), "{said}");
    std::fs::write(folder.path().join("T.mme"), "Title :x\n").unwrap();
    let said = refused(folder.path(), &["compare", run, "T.mme"]);
    assert!(said.contains("no folder Channel"), "{said}");
}

#[test]
fn ratings_of_a_run_without_results_mean_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("short.toml"), include_str!("../recording/short.toml")).unwrap();
    // springs that are too stiff for the step: the energy balance is off by 36 %, or the integration fails at 2 ms
    for (stiffness, file, expected) in [
        ("materials.*.k1=2e7", "off.mcap", "its energy balance is off by"),
        ("materials.*.k1=1e9", "failed.partial.mcap", "no longer finite"),
    ] {
        let name = file.replace(".partial", "");
        let step = "integrator={kind=\"rk4\", step=\"1 ms\"}";
        let set = ["--set", stiffness, "--set", step, "--set", "time.start=0"];
        let ran = answer(here, &[&["run", "short.toml", "-q", "-o", &name][..], &set].concat());
        assert_eq!(ran.status.code(), Some(1), "{}", err(&ran));
        let output = answer(here, &["compare", file, file, "--channel", "vehicle.acceleration.x"]);
        let said = err(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains(expected) && said.contains("the ratings mean nothing"), "{said}");
        assert!(String::from_utf8(output.stdout).unwrap().contains("compared"), "{said}");
        // nor do its histories and pictures
        for words in [
            ["export", file, "-f", "-o", "x.csv"],
            ["plot", file, "-f", "-o", "x.svg"],
            ["view", file, "-f", "-o", "v.svg"],
        ] {
            let said = err(&answer(here, &words));
            assert!(said.contains(expected), "{words:?}: {said}");
        }
    }
    // one that fails before the pulse has no acceleration of the vehicle to rate
    let stiff = ["--set", "materials.*.k1=1e9", "--set", "integrator={kind=\"rk4\", step=\"1 ms\"}"];
    let ran = answer(here, &[&["run", "short.toml", "-q", "-o", "early.mcap"][..], &stiff].concat());
    assert_eq!(ran.status.code(), Some(1), "{}", err(&ran));
    let file = "early.partial.mcap";
    let said = refused(here, &["compare", file, file, "--channel", "vehicle.acceleration.x"]);
    assert!(said.contains("nothing can be rated: all selected channels are zero throughout in early"), "{said}");
    assert!(said.contains("no longer finite"), "{said}");
}
