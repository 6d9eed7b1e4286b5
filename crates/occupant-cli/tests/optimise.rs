//! Optimisations as sentences: closed forms and grids are met, limits hold, caveats refuse, a killed search ends at the same
//! optimum.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

use serde_json::Value;

use crate::common::{answer, done, err, folder_with, occupant};

/// A body that keeps its 5 m/s while the car loses Δv in T = 40 ms: after t = 100 ms its head is Δv·(t − T/2) ahead.
const FREE: &str = r#"
title = "Nobody is held"
gravity = 0
time = { end = "100 ms" }
output = { interval = "1 ms" }
path = { kind = "pulse", shape = "square", speed = "5 m/s", delta_v = "2 m/s", duration = "40 ms" }
body = { preset = "male50-1970" }
joints = { preset = "male50" }
[initial_state]
q = [0, 0, 2,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
rates = [5, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
"#;

const OF_FREE: &str = r#"
base = "free.toml"
seed = 3
[[parameters]]
name = "dv"
path = "path.delta_v"
range = { from = "0.5 m/s", to = "4 m/s" }
[[parameters]]
name = "T"
path = "path.duration"
range = { from = "10 ms", to = "60 ms" }
[optimise]
budget = 160
"#;

/// A lap belt and a torso belt: the least head injury within limits of a belt force.
const BELTS: &str = r#"
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
[optimise]
minimise = "chest.three_ms_cumulative"
allow_caveats = ["*"]
budget = 120
"#;

fn found(folder: &Path, out: &str) -> Value {
    serde_json::from_str(&fs::read_to_string(folder.join(out).join("optimum.json")).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn free(study: &str) -> tempfile::TempDir {
    let folder = folder_with(study);
    fs::write(folder.path().join("free.toml"), FREE).unwrap();
    folder
}

/// All results but the clock's.
fn results(at: &Path, out: &str) -> Vec<String> {
    let read = |name: &str| fs::read_to_string(at.join(out).join(name)).unwrap();
    let without_clock = |line: &str| line.rsplitn(3, ',').last().unwrap().to_owned();
    let history: Vec<String> = read("history.csv").lines().map(without_clock).collect();
    vec![read("optimum.json"), read("best.toml"), read("report.html"), history.join("\n")]
}

#[test]
fn a_limit_is_met_where_the_closed_form_says() {
    let study = format!(
        "{OF_FREE}maximise = \"head_excursion.forward\"\n[[optimise.constraints]]\nmeasure = \"head_excursion.forward\"\nat_most = \"150 mm\"\n"
    );
    let folder = free(&study);
    let at = folder.path();
    let told = done(at, &["optimise", "study.toml", "-o", "out"]);
    assert!(told.contains("at most 150, active") && told.contains("maximised"), "{told}");
    let found = found(at, "out");
    let [dv, duration] = [0, 1].map(|i| number(&found["parameters"][i]["value"]));
    let ahead = dv * (0.1 - 0.5 * duration);
    assert!((0.1499..=0.15).contains(&ahead), "{ahead}");
    assert_eq!(found["is_allowed"], true);
    // what is written checks, and its run has the figures that are quoted, to the last bit
    done(at, &["check", "out/best.toml"]);
    fs::write(at.join("again.toml"), "base = \"out/best.toml\"\noutput.csv = true\n[ensemble]\nmembers = 2\n").unwrap();
    done(at, &["sweep", "again.toml", "-o", "again", "-q"]);
    let table = fs::read_to_string(at.join("again/results.csv")).unwrap();
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let place = lines.next().unwrap().iter().position(|name| *name == "head_excursion.forward").unwrap();
    let again: f64 = lines.next().unwrap()[place].parse().unwrap();
    assert_eq!(again.to_bits(), number(&found["constraints"][0]["after"]).to_bits());
    let page = fs::read_to_string(at.join("out/report.html")).unwrap();
    assert!(page.contains("Best runs") && page.contains("<svg") && !page.contains("<script"));
}

#[test]
fn several_goals_are_weighed_by_their_scales() {
    // 2·x/(0.1 m) within 0.2 m, less its square is not there: the bound of both parameters
    let study = format!(
        "{OF_FREE}[[optimise.goals]]\nminimise = \"head_excursion.forward\"\nper = \"50 mm\"\nweight = 2\n\
         [[optimise.goals]]\nmaximise = \"head_excursion.backward\"\nper = 1\n"
    );
    let folder = free(&study);
    let refused = answer(folder.path(), &["optimise", "study.toml", "-o", "out", "-q"]);
    assert!(err(&refused).contains("there is no measure `head_excursion.backward`"), "{}", err(&refused));
    let study = study.replace("head_excursion.backward", "head.peak");
    fs::write(folder.path().join("study.toml"), study).unwrap();
    let told = done(folder.path(), &["optimise", "study.toml", "-o", "out"]);
    let found = found(folder.path(), "out");
    // nothing touches the head: 2·(0.5 m/s · 70 ms)/(50 mm) = 1.4
    assert!((number(&found["goal"]["after"]) - 1.4).abs() < 1e-5, "{}", found["goal"]);
    assert_eq!([0, 1].map(|i| found["parameters"][i]["at_bound"].clone()), ["lower", "upper"]);
    assert!(told.contains("at its lower bound") && told.contains("weight 2, per 50"), "{told}");
}

#[test]
fn a_front_shows_what_one_goal_costs_of_the_other() {
    // the head goes ahead by Δv·(t − T/2), the body has ½mΔv²: for each Δv the longest pulse is best
    let study = OF_FREE.replace("budget = 160", "budget = 160\nfront = 6");
    let goals = "[[optimise.goals]]\nminimise = \"head_excursion.forward\"\nper = \"100 mm\"\n\
         [[optimise.goals]]\nmaximise = \"energy.greatest_kinetic\"\nper = \"100 J\"\n";
    let folder = free(&format!("{study}{goals}"));
    let told = done(folder.path(), &["optimise", "study.toml", "-o", "out"]);
    assert!(told.contains("front") && told.contains("candidates: report.html"), "{told}");
    let found = found(folder.path(), "out");
    let all: Vec<[f64; 3]> = found["front"]
        .as_array()
        .unwrap()
        .iter()
        .map(|c| [&c["values"][0], &c["measures"][0], &c["measures"][1]].map(number))
        .collect();
    assert!(all.len() >= 6, "{}", all.len());
    // mass of the body from any of them
    let mass = 2.0 * all[0][2] / (all[0][0] * all[0][0]);
    let close = |[dv, ahead, energy]: &&[f64; 3]| {
        *ahead < 1.03 * dv * 0.07 && (energy / (0.5 * mass * dv * dv) - 1.0).abs() < 1e-6
    };
    let close: Vec<&[f64; 3]> = all.iter().filter(close).collect();
    assert!(close.len() >= 6, "{} of {}: {all:?}", close.len(), all.len());
    let speeds = close.iter().fold([f64::INFINITY, 0.0_f64], |[low, high], [dv, ..]| [low.min(*dv), high.max(*dv)]);
    assert!(speeds[0] < 0.8 && speeds[1] > 3.7, "{speeds:?}");
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(page.contains("Front between the goals"));
}

#[test]
fn small_budgets_are_kept_and_what_they_leave_open_is_said() {
    let goals = "[[optimise.goals]]\nminimise = \"head_excursion.forward\"\nper = \"100 mm\"\n\
         [[optimise.goals]]\nmaximise = \"energy.greatest_kinetic\"\nper = \"100 J\"\n";
    for (budget, front) in [(5, 2), (10, 4), (20, 100), (24, 8), (60, 8)] {
        let study = OF_FREE.replace("budget = 160", &format!("budget = {budget}\nfront = {front}"));
        let folder = free(&format!("{study}{goals}"));
        done(folder.path(), &["optimise", "study.toml", "-o", "out", "-q"]);
        let all = found(folder.path(), "out")["candidates"]["all"].as_u64().unwrap();
        // with the base scenario; at least one generation is run
        assert!(all <= 1 + 16.max(budget), "{budget} {front}: {all}");
        let again = answer(folder.path(), &["optimise", "study.toml", "-o", "out"]);
        assert!(!err(&again).contains("damaged"), "{}", err(&again));
    }
    // the base scenario is the best there is
    let study = OF_FREE.replace("budget = 160", "budget = 5\nminimise = \"head_excursion.forward\"");
    let folder = free(&study);
    fs::write(folder.path().join("free.toml"), FREE.replace("2 m/s", "0.5 m/s").replace("40 ms", "60 ms")).unwrap();
    let told = done(folder.path(), &["optimise", "study.toml", "-o", "out"]);
    assert!(told.contains("no candidate is better than the base scenario"), "{told}");
}

#[test]
fn goals_of_any_size_and_both_sides_of_a_median_are_told_right() {
    let study = format!("{OF_FREE}[[optimise.goals]]\nminimise = \"head_excursion.forward\"\nper = 1e-10\n")
        .replace("160", "60");
    let folder = free(&study);
    done(folder.path(), &["optimise", "study.toml", "-o", "out", "-q"]);
    let told = found(folder.path(), "out");
    assert_eq!(number(&told["best"][0]["goal"]), number(&told["goal"]["after"]));
    let study = OF_FREE.replace(
        "budget = 160",
        "budget = 40\nquantile = 0.5\nminimise = \"head_excursion.forward\"\n\
         constraints = [{ measure = \"head_excursion.forward\", at_least = \"50 mm\" }]",
    );
    let folder = free(&format!("{study}[ensemble]\nmembers = 3\npath = \"2 %\"\n"));
    done(folder.path(), &["optimise", "study.toml", "-o", "out", "-q"]);
    let told = found(folder.path(), "out");
    assert_eq!(told["goals"][0]["measure"], told["constraints"][0]["measure"]);
}

#[test]
fn two_parameters_end_where_a_grid_does() {
    let folder = folder_with(BELTS);
    let at = folder.path();
    done(at, &["optimise", "study.toml", "-o", "out", "-q"]);
    let grid = BELTS.split("[optimise]").next().unwrap();
    let grid = grid.replace("range", "grid").replace("scale = \"log\"", "steps = 9, scale = \"log\"");
    let grid = grid.replace("to = \"6 cm\"", "to = \"6 cm\", steps = 9").replace("seed", "output.csv = true\nseed");
    fs::write(at.join("grid.toml"), format!("design.kind = \"full_factorial\"\n{grid}")).unwrap();
    done(at, &["sweep", "grid.toml", "-o", "grid", "-q"]);
    let table = fs::read_to_string(at.join("grid/results.csv")).unwrap();
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let heads = lines.next().unwrap();
    let place = |name: &str| heads.iter().position(|head| *head == name).unwrap();
    let columns = ["chest.three_ms_cumulative", "input.lap", "input.slack"].map(place);
    let rows = lines.map(|row| columns.map(|at| row[at].parse::<f64>().unwrap()));
    let least = rows.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap();
    let found = found(at, "out");
    let best = number(&found["goals"][0]["after"]);
    assert!(best <= least[0] && best > 0.97 * least[0], "{best} {least:?}");
    let value = |i: usize| number(&found["parameters"][i]["value"]);
    // within a step of the grid
    assert!((value(0) / least[1]).ln().abs() <= 4_f64.ln() / 8.0 + 1e-9, "{} {least:?}", value(0));
    assert!((value(1) - least[2]).abs() <= 0.0075 + 1e-9, "{} {least:?}", value(1));
}

#[test]
fn killed_or_with_other_threads_it_ends_at_the_same_optimum_bit_for_bit() {
    let limits = "[[optimise.constraints]]\nmeasure = \"pelvis.three_ms_cumulative\"\nat_most = \"35 g\"\n";
    let study = format!("{}{limits}", BELTS.replace("budget = 120", "budget = 48"));
    let folder = folder_with(&format!("{study}[ensemble]\nmembers = 3\npath = \"2 %\"\n"));
    let at = folder.path();
    let words = |out| ["optimise", "study.toml", "-o", out, "--quiet"];
    let whole = answer(at, &[&words("whole")[..], &["--threads", "1"]].concat()).status.code();
    for round in 0..6_u64 {
        let mut child = occupant(at)
            .args(words("out"))
            .args(["--threads", if round % 2 == 0 { "2" } else { "3" }])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        sleep(Duration::from_millis(60 + 170 * round));
        // SIGKILL on Unix
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert_eq!(answer(at, &[&words("out")[..], &["--kernel", "scalar"]].concat()).status.code(), whole);
    assert_eq!(results(at, "out"), results(at, "whole"));
    let found = found(at, "out");
    assert_eq!(found["goals"][0]["measure"], "chest.three_ms_cumulative.q95");
    assert_eq!((&found["members"], &found["quantile"]), (&3.into(), &0.95.into()));
}

#[test]
fn a_run_with_a_caveat_does_not_win_unless_it_is_allowed() {
    // the head is still being loaded when the run ends
    let study = BELTS.replace("allow_caveats = [\"*\"]\nbudget = 120", "budget = 16");
    let study = study.replace("chest.three_ms_cumulative", "hic15");
    let folder = folder_with(&study);
    let at = folder.path();
    let output = answer(at, &["optimise", "study.toml", "-o", "out"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(told.contains("have caveats, such as window_at_end") && told.contains("allow_caveats"), "{told}");
    let refused = found(at, "out");
    assert!(refused["is_allowed"] == false && number(&refused["candidates"]["with_caveats"]) > 16.0);
    let allowed = study.replace("[optimise]", "[optimise]\nallow_caveats = [\"other\", \"window*\"]");
    fs::write(at.join("study.toml"), allowed).unwrap();
    let told = done(at, &["optimise", "study.toml", "-o", "allowed"]);
    assert_eq!(found(at, "allowed")["is_allowed"], true);
    assert!(told.contains("caveat of the best run"), "{told}");
}

#[test]
fn limits_that_nothing_keeps_are_said() {
    let study = format!(
        "{OF_FREE}minimise = \"head_excursion.forward\"\n[[optimise.constraints]]\nmeasure = \"head_excursion.forward\"\nat_least = 3\n"
    );
    let folder = free(&study);
    let output = answer(folder.path(), &["optimise", "study.toml", "-o", "out"]);
    let told = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(told.contains("no candidate is within all limits") && told.contains("at least 3000, exceeded"), "{told}");
    // the nearest: 4 m/s in 10 ms
    assert!((number(&found(folder.path(), "out")["constraints"][0]["after"]) - 0.38).abs() < 2e-3);
}

#[test]
fn wrong_studies_are_refused_before_anything_is_run() {
    let minimise = format!("{OF_FREE}minimise = \"head_excursion.forward\"\n");
    let limit = |words: &str| format!("{minimise}[[optimise.constraints]]\nmeasure = \"hic15\"\n{words}\n");
    let cases = [
        (OF_FREE.to_owned(), "minimise"),
        (OF_FREE.split("[optimise]").next().unwrap().to_owned(), "has no [optimise]"),
        (format!("{minimise}maximise = \"hic15\"\n"), "maximise"),
        (OF_FREE.replace("budget = 160", "goals = []"), "goals"),
        (
            minimise.replace("head_excursion.forward", "head_excursion.forwards"),
            "did you mean `head_excursion.forward`?",
        ),
        (minimise.replace("head_excursion.forward", "wall_time_s"), "there is no measure `wall_time_s`"),
        (minimise.replace("budget = 160", "budget = 99999999999"), "at most 10000000"),
        (minimise.replace("budget = 160", "budget = 10000000"), "at most 10000000 runs"),
        (minimise.replace("budget = 160", "tolerance = 0.0"), "tolerance"),
        (minimise.replace("budget = 160", "front = 5"), "a front of 1 goals"),
        (minimise.replace("budget = 160", "front = 1"), "optimise.front"),
        (minimise.replace("budget = 160", "quantile = 0.9"), "without an ensemble"),
        (minimise.replace("head_excursion.forward", "hic15"), "no value of `hic15` to divide by"),
        (format!("{minimise}\n[ensemble]\nmembers = 1\n"), "members"),
        (limit("at_most = \"5 g\""), "is not the unit of"),
        (limit("at_most = \"five\""), "number"),
        (limit("at_most = 5\nat_least = 1"), "at_least"),
        (limit(""), "at_most"),
        (limit("at_most = inf"), "inf"),
        (
            format!("{}[[optimise.constraints]]\nmeasure = \"hic15\"\nat_most = 6\n", limit("at_most = 5")),
            "a second `at_most`",
        ),
        (
            format!("{}[[optimise.constraints]]\nmeasure = \"hic15\"\nat_least = 6\n", limit("at_most = 5")),
            "is above its `at_most`",
        ),
        (OF_FREE.replace("budget = 160", "goals = [{ minimise = \"hic15\", per = -1 }]"), "not above 0"),
        (OF_FREE.replace("budget = 160", "goals = [{ minimise = \"hic15\", per = \"1 m\" }]"), "is not the unit of"),
        (OF_FREE.replace("budget = 160", "goals = [{ minimise = \"hic15\", per = 1, weight = nan }]"), "weight"),
        (minimise.replace("range = { from = \"0.5 m/s\", to = \"4 m/s\" }", "list = [1, 2]"), "no range to search"),
        (minimise.replace("free.toml", "none.toml"), "none.toml cannot be read"),
    ];
    for (study, expected) in cases {
        let folder = free(&study);
        let refused = answer(folder.path(), &["optimise", "study.toml", "-o", "out"]);
        let said = err(&refused);
        assert_eq!(refused.status.code(), Some(2), "{study}\n{said}");
        assert!(said.contains(expected) && said.contains("study.toml"), "{expected}\n{said}\n{study}");
        assert!(!folder.path().join("out").exists(), "{study}");
    }
}

/// Δv at most half of the car's speed v: the head is (5 m/s − v)·t + Δv·(t − T/2) ahead, most at v = 2 m/s, Δv = 1 m/s, T = 10 ms.
#[test]
fn candidates_keep_the_constraints_between_parameters_and_the_optimum_lies_on_one() {
    let speed = "[[parameters]]\nname = \"v\"\npath = \"path.speed\"\nrange = { from = \"2 m/s\", to = \"6 m/s\" }\n";
    let constraint = "[[constraints]]\nsum = { dv = 1, v = -0.5 }\nmax = 0\n";
    let study = OF_FREE.replace("[optimise]", &format!("{speed}{constraint}[optimise]"));
    let folder = free(&(study + "maximise = \"head_excursion.forward\"\nallow_caveats = [\"*\"]\n"));
    let at = folder.path();
    let output = answer(at, &["optimise", "study.toml", "-o", "out"]);
    assert!(output.status.success(), "{}", err(&output));
    // the base, 2 m/s of 5, keeps it
    assert!(!err(&output).contains("breaks a constraint"), "{}", err(&output));
    let found = found(at, "out");
    let [dv, _, v] = [0, 1, 2].map(|i| number(&found["parameters"][i]["value"]));
    assert!((dv - 1.0).abs() < 0.02 && (v - 2.0).abs() < 0.02, "{dv} {v}");
    let history = fs::read_to_string(at.join("out/history.csv")).unwrap();
    let head: Vec<&str> = history.lines().next().unwrap().split(',').collect();
    let at = ["input.dv", "input.v"].map(|name| head.iter().position(|column| *column == name).unwrap());
    let mut on_edge = 0;
    for line in history.lines().skip(2) {
        let cells: Vec<&str> = line.split(',').collect();
        let [dv, v] = at.map(|at| cells[at].parse::<f64>().unwrap());
        assert!(dv <= 0.5 * v * (1.0 + 1e-8), "{line}");
        on_edge += usize::from(dv > 0.4999 * v);
    }
    assert!(on_edge > 10, "{on_edge}");
}
