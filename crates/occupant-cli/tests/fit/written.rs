//! What a fit leaves behind.

use super::*;

#[test]
fn the_fitted_scenario_keeps_its_authors_words_and_runs_to_the_score_that_is_told() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.03, 1);
    let said = done(at, &["fit", "study.toml", "--test", "test.csv", "-o", "out"]);
    let text = fs::read_to_string(at.join("out/fitted.toml")).unwrap();
    let original = fs::read_to_string(at.join("case.toml")).unwrap();
    // comments and order stay; only the changed lines, the provenance and the head differ
    let kept = original.lines().filter(|l| text.lines().any(|t| t == *l)).count();
    let lines = original.lines().count();
    assert!(lines - kept <= 4, "{kept} of {lines} lines kept:\n{text}");
    let line = |start: &str| text.lines().find(|l| l.starts_with(start)).unwrap();
    assert!(line("k1 = ").ends_with(" kN/m\""), "{text}");
    assert!(line("end = ").contains("80 ms"), "{text}");
    let provenance = line("\"belts.lap.k1\" = ");
    for words in ["study.toml (SHA-256", "test.csv (SHA-256", "rms score", "interval", "kN/m"] {
        assert!(provenance.contains(words), "{words} in {provenance}");
    }
    let found = found(at, "out");
    assert!(provenance.contains(&found["tests"][0]["sha256"].as_str().unwrap()[..16]));
    // the rms of ours is not among the ratings of `compare`; that of ISO 18571 is
    let study = STUDY.replace("[fit]", "[fit]\nobjective = \"iso18571\"");
    fs::write(at.join("iso.toml"), study).unwrap();
    done(at, &["fit", "iso.toml", "--test", "test.csv", "-o", "iso", "--quiet"]);
    done(at, &["run", "iso/fitted.toml", "-o", "fitted.mcap", "--quiet"]);
    let words = ["compare", "fitted.mcap", "test.csv", "--filter", "CFC60", "--from", "5 ms"];
    let compared = done(at, &[&words[..], &["--to", "75 ms", "--json"]].concat());
    let compared: Value = serde_json::from_str(&compared).unwrap();
    let iso = super::found(at, "iso");
    for pair in compared["pairs"].as_array().unwrap() {
        let all = iso["score"]["channels"].as_array().unwrap();
        let ours = all.iter().find(|c| c["channel"] == pair["channel"]).unwrap();
        let theirs = 1.0 - number(&pair["iso18571"]["overall"]);
        // both were read from JSON, which costs the last bit
        let difference = number(&ours["after"]) - theirs;
        assert!(difference.abs() < 1e-15, "{difference:e} {pair}");
    }
    assert!(said.contains("identified"), "{said}");
}

#[test]
fn a_scenario_that_only_a_preset_holds_is_written_where_it_belongs() {
    let study = STUDY.replace("belts.lap.k1", "joints.neck.damping").replace(
        "from = \"35 kN/m\", to = \"140 kN/m\", scale = \"log\"",
        "from = \"0.5 N m s/rad\", to = \"8 N m s/rad\", scale = \"log\"",
    );
    let folder = folder_with(&study.replace("budget = 160", "budget = 32"));
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN[1..], 0.03, 1);
    done(at, &["fit", "study.toml", "--test", "test.csv", "-o", "out", "--quiet"]);
    let text = fs::read_to_string(at.join("out/fitted.toml")).unwrap();
    assert!(text.contains("damping = "), "{text}");
    assert!(text.contains("# where the numbers come from"), "{text}");
    done(at, &["check", "out/fitted.toml", "--quiet"]);
}

#[test]
fn history_and_plots_show_every_candidate_and_every_channel() {
    let folder = folder_with(&STUDY.replace("budget = 160", "budget = 48"));
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.03, 1);
    let output = answer(at, &["fit", "study.toml", "--test", "test.csv", "-o", "out", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let found = found(at, "out");
    assert_eq!(printed, found);
    // without a terminal the score is told in lines
    let said = err(&output);
    assert!(said.contains("base scenario: score"), "{said}");
    assert!(said.contains("descent 1, generation 1: score"), "{said}");
    let history = fs::read_to_string(at.join("out/history.csv")).unwrap();
    let mut lines = history.lines();
    let head = lines.next().unwrap();
    for column in ["stage", "generation", "input.lap", "score", "best", "test.belt.lap.force"] {
        assert!(head.split(',').any(|c| c == column), "{column} in {head}");
    }
    assert_eq!(lines.count() as u64, found["evaluations"]["all"].as_u64().unwrap());
    assert_eq!(found["evaluations"]["search"], 48);
    assert!(at.join("out/history.parquet").is_file());
    let svg = fs::read_to_string(at.join("out/plots/test.svg")).unwrap();
    for words in ["belt.lap.force", "lower_torso.acceleration.x", "fitted", "before", "test: "] {
        assert!(svg.contains(words), "{words}");
    }
}
