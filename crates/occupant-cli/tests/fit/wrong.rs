//! Tests that are wrong: the fit says so, or finds by how much.

use super::*;

/// Writes a table again with every time and every value changed.
fn rewrite(file: &Path, change: impl Fn(usize, f64) -> f64) {
    let text = fs::read_to_string(file).unwrap();
    let (head, rows) = text.split_once('\n').unwrap();
    let cell = |(i, cell): (usize, &str)| change(i, cell.parse().unwrap()).to_string();
    let row = |row: &str| row.split(',').enumerate().map(cell).collect::<Vec<_>>().join(",");
    let rows: Vec<String> = rows.lines().map(row).collect();
    fs::write(file, format!("{head}\n{}\n", rows.join("\n"))).unwrap();
}

/// A study of the slack alone, with something more in its test.
fn slack_alone(of_test: &str) -> String {
    let (set, _) = STUDY.split_once("[[parameters]]").unwrap();
    let set = set.replace("\"80 ms\" }", "\"80 ms\", \"belts.lap.k1\" = \"90 kN/m\" }");
    let (_, slack) = STUDY.split_once("name = \"slack\"").unwrap();
    format!("{set}[[parameters]]\nname = \"slack\"{slack}[[fit.tests]]\n{of_test}\n")
        .replace("budget = 160", "budget = 90")
}

const FIT: [&str; 6] = ["fit", "study.toml", "--test", "test.csv", "-o", "out"];

/// The warnings but for what is to know of the figures of the fitted run.
fn of_tests(warnings: &Value) -> Vec<String> {
    let all = warnings.as_array().unwrap().iter().map(|w| w.as_str().unwrap().to_owned());
    all.filter(|warning| !warning.starts_with("fitted.toml: ")).collect()
}

#[test]
fn a_turned_sign_a_wrong_unit_and_a_late_clock_are_told() {
    let folder = folder_with(&slack_alone(""));
    let at = folder.path();
    measure(at, "right.csv", &HIDDEN, 0.02, 1);
    let told = |change: &dyn Fn(usize, f64) -> f64| -> Vec<String> {
        fs::copy(at.join("right.csv"), at.join("test.csv")).unwrap();
        rewrite(&at.join("test.csv"), change);
        done(at, &[&FIT[..], &["--restart", "--quiet"]].concat());
        let warnings = &found(at, "out")["warnings"];
        of_tests(warnings)
    };
    let of = |all: &[String], words: &str| all.iter().filter(|w| w.contains(words)).count();
    let right = told(&|_, x| x);
    assert_eq!(right, Vec::<String>::new());
    // columns: time, lap belt, torso belt, pelvis, in the order of the catalogue
    let turned = told(&|i, x| if i == 1 { -x } else { x });
    assert_eq!(of(&turned, "If the sign is wrong: map = [\"column=-"), 1, "{turned:?}");
    let kilo = told(&|i, x| if i == 2 { x / 1e3 } else { x });
    assert_eq!(of(&kilo, "check its unit, or set `gain`"), 1, "{kilo:?}");
    for late in [2e-3, -2e-3, 0.5e-3] {
        let told = told(&|i, x| if i == 0 { x + late } else { x });
        let word = if late > 0.0 { " late: " } else { " early: " };
        assert!(of(&told, word) >= 1, "{late}: {told:?}");
    }
}

#[test]
fn offset_and_gain_of_a_test_are_found_with_the_parameters() {
    let folder =
        folder_with(&slack_alone("offset = { from = \"-4 ms\", to = \"4 ms\" }\ngain = { from = 0.8, to = 1.25 }"));
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.0, 0);
    rewrite(&at.join("test.csv"), |i, x| if i == 0 { x + 2e-3 } else { 1.1 * x });
    let said = done(at, &FIT);
    let found = found(at, "out");
    for (name, planted, most) in [("slack", 0.035, 1e-4), ("test.offset", -2e-3, 1e-6), ("test.gain", 1.1, 1e-3)] {
        let error = (number(&parameter(&found, name)["value"]) - planted).abs();
        assert!(error < most, "{name}: {error:e}\n{said}");
    }
    assert_eq!(of_tests(&found["warnings"]), Vec::<String>::new(), "{said}");
    // they are of the test: nothing of them stands in the scenario
    let text = fs::read_to_string(at.join("out/fitted.toml")).unwrap();
    assert!(!text.contains("offset") && text.contains("slack"), "{text}");
    let wrong = slack_alone("offset = { from = \"4 ms\", to = \"4 ms\" }\ngain = { from = -1, to = 1 }");
    fs::write(at.join("study.toml"), wrong).unwrap();
    let output = answer(at, &FIT);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("of a gain both above 0"), "{}", err(&output));
}

#[test]
fn a_test_that_is_sampled_densely_is_compared_with_outputs_as_dense() {
    let folder = folder_with(&slack_alone(""));
    let at = folder.path();
    measure(at, "test.csv", &[HIDDEN[0], HIDDEN[1], "output.interval=0.1 ms"], 0.0, 0);
    let said = done(at, &FIT);
    let found = found(at, "out");
    // measured: 0.68 % with the outputs of the scenario, every 1 ms
    let error = (number(&parameter(&found, "slack")["value"]) / 0.035 - 1.0).abs();
    assert!(error < 1e-3, "{error}\n{said}");
    assert!(said.contains("outputs every 0.1 ms"), "{said}");
    let text = fs::read_to_string(at.join("out/fitted.toml")).unwrap();
    assert!(!text.contains("0.0001"), "the scenario keeps its own outputs: {text}");
}
