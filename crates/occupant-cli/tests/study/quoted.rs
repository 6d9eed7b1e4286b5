//! What can be quoted of a study: every number of a paragraph against the table of runs, limits, scenarios of worst runs.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{answer, done, err, figures, page, swept};

/// Forty random samples, of which some exceed a limit.
const STUDY: &str = r#"
title = "quoted"
seed = 3
design = { kind = "monte_carlo", samples = 40 }
set = { "time.end" = "60 ms", "output.interval" = "1 ms" }

[[parameters]]
name = "speed"
path = "path.delta_v"
range = { from = "20 km/h", to = "50 km/h" }

[[parameters]]
input = "direction"
"#;

/// A column of results.csv, in the order of the runs.
fn column(folder: &Path, name: &str) -> Vec<f64> {
    let table = fs::read_to_string(folder.join("out/results.csv")).expect("a table");
    let mut lines = table.lines();
    let heads: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let at = heads.iter().position(|head| *head == name).unwrap_or_else(|| panic!("no column {name}"));
    lines.filter_map(|line| line.split(',').nth(at)?.parse().ok()).collect()
}

fn json(folder: &Path, more: &[&str]) -> Value {
    let words = [&["study", "report", "out", "--force", "--json"], more].concat();
    serde_json::from_str(&done(folder, &words)).expect("JSON")
}

/// The statement of a figure.
fn statement<'a>(answer: &'a Value, figure: &str) -> &'a Value {
    let all = answer["figures"].as_array().expect("a list");
    all.iter().find(|f| f["figure"] == figure).unwrap_or_else(|| panic!("no {figure}"))
}

fn near(found: &Value, wanted: f64) {
    let found = found.as_f64().unwrap_or_else(|| panic!("{found} is no number"));
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1e-9), "{found}, not {wanted}");
}

#[test]
fn every_number_of_a_paragraph_is_that_of_the_runs() {
    let folder = swept(STUDY);
    let at = folder.path();
    let mut values = column(at, "chest.peak");
    values.sort_unstable_by(f64::total_cmp);
    assert_eq!(values.len(), 40);
    let limit = 20.0 * 9.80665;
    let over = values.iter().filter(|x| **x > limit).count();
    assert!((5..36).contains(&over), "{over}");
    let answer = json(at, &["--to", "chest.peak,hic15", "--limit", "chest.peak=20 g"]);
    let s = statement(&answer, "chest.peak");
    assert_eq!(s["runs"], 40);
    let quantile = |part: f64| s["quantiles"].as_array().unwrap().iter().find(|q| q["part"] == part).unwrap();
    // definition 7 by hand: place 39·0.025 = 0.975
    near(&quantile(0.025)["value"], values[0] * 0.025 + values[1] * 0.975);
    near(&quantile(0.5)["value"], 0.5 * (values[19] + values[20]));
    // 95 % interval of the median of 40 values: ranks 14 and 27 of the binomial distribution
    near(&quantile(0.5)["low"], values[13]);
    near(&quantile(0.5)["high"], values[26]);
    // 40 values bound the 2.5 % quantile from above alone: P(B ≥ 4) = 0.018, P(B ≥ 3) = 0.08
    assert_eq!((&quantile(0.025)["low"], &quantile(0.025)["needed"]), (&Value::Null, &146.into()));
    near(&quantile(0.025)["high"], values[3]);
    let found = &s["limits"][0];
    assert_eq!((&found["above"], &found["of"]), (&over.into(), &40.into()));
    let (n, z, p) = (40.0, 1.959963984540054_f64, over as f64 / 40.0);
    let centre = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt() / (1.0 + z * z / n);
    near(&found["low"], centre - half);
    near(&found["high"], centre + half);

    let paragraph = s["paragraph"].as_str().unwrap();
    let g = |x: f64| {
        let x = x / 9.80665;
        if x < 10.0 { format!("{x:.3} g") } else { format!("{x:.2} g") }
    };
    let p = |x: f64| if x < 0.1 { format!("{:.1}", 100.0 * x) } else { format!("{:.0}", 100.0 * x) };
    for words in [
        "chest.peak: ",
        "simulated case.toml for the study “quoted”: 40 runs (Monte Carlo, 40 independent samples, seed 3)",
        "speed (path.delta_v), uniform: 20 to 50 km/h",
        "direction (path.turn), normal: 0 ± 2.5°, cut to −7.5 to 7.5°, an offset [ready distribution; guess: ± 5°",
        "time.end = 60 ms",
        "No run is left out.",
        &format!(
            "The median of 40 runs is {} (95 % interval {} to {}).",
            g(0.5 * (values[19] + values[20])),
            g(values[13]),
            g(values[26])
        ),
        &format!("up to {}, lower end open", g(values[3])),
        "closed intervals from 146 runs on",
        &format!("{over} of 40 runs exceed 20.00 g (the limit asked for): probability {} %", p(over as f64 / 40.0)),
        &format!(
            "(95 % interval {} % to {} %, Wilson; for an interval of 10 percentage points",
            p(centre - half),
            p(centre + half)
        ),
        "Errors of the model and of the assumed inputs come on top.",
    ] {
        assert!(paragraph.contains(words), "{words}\n{paragraph}");
    }
    // limits of rules for the body stand with their dummy
    let hic = statement(&answer, "hic15");
    let most: Vec<f64> = hic["limits"].as_array().unwrap().iter().map(|l| l["most"].as_f64().unwrap()).collect();
    assert!(most.contains(&700.0), "{hic}");
    assert!(hic["paragraph"].as_str().unwrap().contains("exceed 700.0 ("), "{hic}");
    // page and terminal say the same words
    let html = fs::read_to_string(at.join("out/report.html")).unwrap();
    assert!(html.contains(paragraph), "{html}");
    assert!(html.contains("Histogram: chest.peak") && html.contains("Distribution: chest.peak"));
    let told =
        done(at, &["study", "report", "out", "--force", "--to", "chest.peak,hic15", "--limit", "chest.peak=20 g"]);
    assert!(told.contains(paragraph), "{told}");
    let counts = s["histogram"]["counts"].as_array().unwrap();
    assert_eq!(counts.iter().map(|c| c.as_u64().unwrap()).sum::<u64>(), 40);
    for wrong in ["chest.peak=30", "chest.peek=30 g", "chest.peak"] {
        let output = answer_of(at, wrong);
        assert!(output.contains("--limit"), "{output}");
    }
}

fn answer_of(at: &Path, limit: &str) -> String {
    let output = answer(at, &["study", "report", "out", "--force", "--limit", limit]);
    assert_eq!(output.status.code(), Some(2), "{limit}");
    err(&output)
}

#[test]
fn worst_runs_are_scenario_files_that_give_their_row_to_the_bit() {
    let study = STUDY.replace("samples = 40", "samples = 6");
    let folder = swept(&study);
    let at = folder.path();
    let html = page(at);
    let runs = at.join("out/report-runs");
    let mut compared = 0;
    for entry in fs::read_dir(&runs).unwrap() {
        let file = entry.unwrap().path();
        let name = file.file_name().unwrap().to_str().unwrap().to_owned();
        let Some(number) = name.strip_prefix("run-").and_then(|n| n.strip_suffix(".toml")) else { continue };
        assert!(html.contains(&format!("occupant run report-runs/{name}")), "{name}");
        let words = ["run", &format!("out/report-runs/{name}"), "-o", "again.mcap", "--force", "--quiet"];
        done(at, &words);
        let all = figures(&at.join("again.mcap"));
        for figure in ["head.peak", "chest.peak", "hic15", "belts.lap.peak"] {
            let row = column(at, figure)[number.parse::<usize>().unwrap()];
            let found = all.iter().find(|(name, _)| name == figure).and_then(|(_, value)| *value).unwrap();
            assert_eq!(found.to_bits(), row.to_bits(), "{figure} of {name}");
            compared += 1;
        }
    }
    assert!(compared >= 12, "{compared}");
}

#[test]
fn designs_that_are_no_samples_have_no_probabilities() {
    let study = STUDY
        .replace("{ kind = \"monte_carlo\", samples = 40 }", "{ kind = \"full_factorial\" }")
        .replace("range = { from = \"20 km/h\", to = \"50 km/h\" }", "list = [\"20 km/h\", \"40 km/h\", \"50 km/h\"]")
        .replace("[[parameters]]\ninput = \"direction\"", "");
    let folder = swept(&study);
    let answer = json(folder.path(), &["--to", "hic15"]);
    let s = statement(&answer, "hic15");
    assert_eq!(s["quantiles"][0]["low"], Value::Null);
    let paragraph = s["paragraph"].as_str().unwrap();
    assert!(paragraph.contains("There are no intervals and no probabilities: a full factorial design"), "{paragraph}");
    assert!(!paragraph.contains("probability "), "{paragraph}");
}

#[test]
fn crossed_values_have_a_paragraph_each() {
    let study = STUDY.replace("samples = 40", "samples = 8")
        + "\n[[parameters]]\nname = \"mass\"\npath = \"belts.lap.slack\"\nlist = [\"0 mm\", \"30 mm\"]\ncrossed = true\n";
    let folder = swept(&study);
    let answer = json(folder.path(), &["--to", "hic15"]);
    let all: Vec<&Value> = answer["figures"].as_array().unwrap().iter().collect();
    assert_eq!(all.len(), 2);
    assert!(all.iter().all(|s| s["runs"] == 8 && s["case"].as_str().unwrap().starts_with("mass = ")), "{all:?}");
}
