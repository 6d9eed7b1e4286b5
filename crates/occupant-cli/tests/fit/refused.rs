//! What cannot be fitted, in words that say where and how to mend it.

use super::*;

fn refusal(at: &Path, words: &[&str]) -> String {
    let output = answer(at, words);
    assert_eq!(output.status.code(), Some(2), "{}", err(&output));
    assert!(output.stdout.is_empty());
    err(&output)
}

const FIT: [&str; 6] = ["fit", "study.toml", "--test", "test.csv", "-o", "out"];

#[test]
fn everything_that_is_wrong_is_told_at_once_with_its_place() {
    let study = STUDY.replace("[fit]", "[fit]\nchannels = [{ channel = \"belt.lap.forse\" }]");
    let folder = folder_with(&study.replace("belts.lap.k1", "belts.lab.k1"));
    let at = folder.path();
    fs::write(at.join("test.csv"), "time[s],belt.lap.force[N]\n0,1\n0.001,x\n").unwrap();
    let said = refusal(at, &FIT);
    for words in ["study.toml:9:8", "did you mean `lap`?", "test.csv:3", "`x`", "2 errors, nothing was run"] {
        assert!(said.contains(words), "{words} in\n{said}");
    }
    let folder = folder_with(&study);
    let at = folder.path();
    fs::write(at.join("test.csv"), "time[s],belt.lap.force[N]\n0,1\n0.1,2\n").unwrap();
    let said = refusal(at, &FIT);
    assert!(said.contains("there is no channel `belt.lap.forse`"), "{said}");
    assert!(said.contains("did you mean `belt.lap.force`?"), "{said}");
}

#[test]
fn wrong_words_of_the_fit_are_told_with_line_and_column() {
    let study = STUDY.replace("budget = 160", "budget = 0\nobjektive = \"rms\"\nobjective = \"best\"");
    let folder = folder_with(&study);
    let said = refusal(folder.path(), &FIT);
    for words in [
        "unknown key `objektive`",
        "did you mean `objective`?",
        "\"best\" is not a value of `objective`",
        "\"iso18571\", \"rms\" or \"peak_and_time\"",
        "a whole number of at least 1",
    ] {
        assert!(said.contains(words), "{words} in\n{said}");
    }
    let study = STUDY.replace("to = \"75 ms\"", "to = \"4 ms\"");
    let said = refusal(folder_with(&study).path(), &FIT);
    assert!(said.contains("`to` is not after `from`"), "{said}");
    let study = STUDY.replace("budget = 160", "budget = 99_000_000\nnear = -1");
    let said = refusal(folder_with(&study).path(), &FIT);
    assert!(said.contains("at most 10000000"), "{said}");
    assert!(said.contains("a number above 0") && said.contains("near = -1"), "{said}");
}

#[test]
fn a_parameter_without_ends_and_a_missing_test_are_told() {
    let list = "list = [\"60 kN/m\", \"90 kN/m\"]";
    let study = STUDY.replace("range = { from = \"35 kN/m\", to = \"140 kN/m\", scale = \"log\" }", list);
    let folder = folder_with(&study);
    let said = refusal(folder.path(), &FIT);
    assert!(said.contains("`lap` has no range to search"), "{said}");
    assert!(said.contains("a `range`, a `grid`, or a distribution"), "{said}");
    assert!(said.contains("test.csv cannot be read"), "{said}");
    let folder = folder_with(STUDY);
    let said = refusal(folder.path(), &["fit", "study.toml", "-o", "out"]);
    assert!(said.contains("there is no test to fit to") && said.contains("--test test.csv"), "{said}");
    let study = STUDY.replace("case.toml", "none.toml") + "[[fit.tests]]\nfile = \"gone.csv\"\n";
    let said = refusal(folder_with(&study).path(), &["fit", "study.toml", "-o", "out"]);
    let base = study.lines().position(|line| line.starts_with("base")).expect("it has one") + 1;
    assert!(said.contains("none.toml cannot be read") && said.contains(&format!("study.toml:{base}:")), "{said}");
    let file = study.lines().count();
    assert!(said.contains("gone.csv cannot be read") && said.contains(&format!("study.toml:{file}:")), "{said}");
}

#[test]
fn signals_that_do_not_fit_the_run_are_told() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let table = |column: &str, from: f64| {
        let row = |i: i32| format!("{},{}\n", from + f64::from(i) * 1e-3, i);
        let rows: String = (0..100).map(row).collect();
        fs::write(at.join("test.csv"), format!("time[s],{column}\n{rows}")).unwrap();
    };
    table("chest[g]", 0.0);
    let said = refusal(at, &FIT);
    assert!(said.contains("no signal of test.csv matches a channel"), "{said}");
    let mapped = [&FIT[..], &["--map", "chest=belt.lap.force"]].concat();
    assert!(refusal(at, &mapped).contains("chest is in g, but belt.lap.force in N"));
    table("belt.lap.force[N]", 5.0);
    let said = refusal(at, &FIT);
    assert!(said.contains("no common time") && said.contains("belt.lap.force of test.csv"), "{said}");
    // a class that the outputs are too sparse for
    let study = STUDY.replace("CFC60", "CFC1000");
    fs::write(at.join("study.toml"), study).unwrap();
    table("belt.lap.force[N]", 0.0);
    let said = refusal(at, &FIT);
    assert!(said.contains("CFC 1000 needs more than"), "{said}");
}

#[test]
fn a_fit_in_which_nothing_runs_says_why() {
    // damping beyond any stable step
    let study = STUDY
        .replace("belts.lap.k1", "joints.neck.damping")
        .replace("from = \"35 kN/m\", to = \"140 kN/m\"", "from = \"1e5 N m s/rad\", to = \"1e6 N m s/rad\"")
        .replace("budget = 160", "budget = 16");
    let folder = folder_with(&study);
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.0, 0);
    let output = answer(at, &FIT);
    let said = err(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("none of 17 candidates could be run"), "{said}");
    assert!(said.contains("narrow the parameter ranges"), "{said}");
}

#[test]
fn runs_that_are_out_of_balance_count_as_worst_and_the_fit_says_so() {
    let study = |set: &str, parameter: &str| {
        let set = format!("set = {{ \"time.end\" = \"80 ms\", {set} }}");
        let fit = "from = \"10 ms\"\nto = \"70 ms\"\nbudget = 16";
        format!("base = \"case.toml\"\n{set}\n[[parameters]]\n{parameter}\n[fit]\n{fit}\n")
    };
    // steps of 3 to 4 ms: measured 15 to 33 % of the kinetic energy
    let steps = "path = \"integrator.step\"\nrange = { from = \"0.5 ms\", to = \"4 ms\" }";
    let folder = folder_with(&study("\"output.interval\" = \"4 ms\"", steps));
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.0, 0);
    let said = done(at, &FIT);
    let evaluations = &found(at, "out")["evaluations"];
    assert!(number(&evaluations["failed"]) >= 1.0, "{said}");
    let reason = evaluations["reason"].as_str().unwrap_or_default();
    assert!(reason.starts_with("its energy balance is off by"), "{reason}");
    assert!(said.contains(&format!("candidates could not be run and rank worst; the first one: {reason}")), "{said}");
    // steps of 5 ms: measured 46 to 67 % whatever the belt
    let belt = "path = \"belts.lap.k1\"\nrange = { from = \"70 kN/m\", to = \"140 kN/m\" }";
    fs::write(at.join("study.toml"), study("\"output.interval\" = \"5 ms\", \"integrator.step\" = \"5 ms\"", belt))
        .unwrap();
    let output = answer(at, &[&FIT[..], &["--restart"]].concat());
    let said = err(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("none of 17 candidates could be run; the last one: its energy balance is off by"), "{said}");
    assert!(!at.join("out/fit.json").exists());
}

#[test]
fn a_study_with_a_fit_alone_is_no_sweep_and_says_what_it_is() {
    let folder = folder_with(STUDY);
    let said = refusal(folder.path(), &["sweep", "study.toml", "-o", "out"]);
    assert!(said.contains("`occupant fit`"), "{said}");
}
