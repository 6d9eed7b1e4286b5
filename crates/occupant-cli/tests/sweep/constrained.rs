//! Studies whose constraints leave out some samples.

use std::fs;

use super::*;

fn constrained(constraint: &str) -> String {
    let second = "[[parameters]]\nname = \"other\"\npath = \"joints.upper_back.damping\"\nrange = { from = \"10 in lbf s/rad\", to = \"40 in lbf s/rad\" }";
    STUDY.replace("path = \"joints.neck.damping\"", "name = \"neck\"\npath = \"joints.neck.damping\"")
        + &format!("{second}\n[[constraints]]\nname = \"neck first\"\n{constraint}\n")
}

const NECK_FIRST: &str = "sum = { neck = 1, other = -1 }\nmin = 0";

/// A row each for those left out, without figures, at once; the others are those of the study without a constraint; parts as one.
#[test]
fn excluded_samples_are_rows_without_a_run_and_all_others_are_as_before() {
    let text = constrained(NECK_FIRST);
    let folder = folder_with(&text);
    let at = folder.path();
    fs::write(at.join("free.toml"), text.split("[[constraints]]").next().unwrap()).unwrap();
    let told = done(at, &["sweep", "study.toml", "-o", "out", "--csv", "--threads", "2", "--keep", "all"]);
    done(at, &["sweep", "free.toml", "-o", "free", "--csv"]);
    let (within, free) = (rows(at, "out"), rows(at, "free"));
    let [neck, other] = ["input.neck", "input.other"].map(|name| column(&within, name));
    let [status, reason, hic] = ["status", "reason", "hic15"].map(|name| column(&within, name));
    let mut excluded = 0;
    for i in 0..24 {
        let breaks = neck[i].parse::<f64>().unwrap() < other[i].parse::<f64>().unwrap();
        assert_eq!(status[i], if breaks { "excluded" } else { "completed" }, "{i}");
        assert_eq!(hic[i].is_empty(), breaks);
        match breaks {
            true => assert_eq!(reason[i], "the sum of constraint `neck first` is below 0 N·m·s/rad"),
            false => assert_eq!(within[i + 1], free[i + 1]),
        }
        excluded += usize::from(breaks);
    }
    assert!((4..20).contains(&excluded), "{excluded}");
    assert!(told.contains(&format!("{} completed, {excluded} excluded by constraints", 24 - excluded)), "{told}");
    assert_eq!(files(&at.join("out/runs"), ".mcap").len(), 24 - excluded);
    for shard in ["1/3", "2/3", "3/3"] {
        done(at, &["sweep", "study.toml", "-o", "parts", "--shard", shard]);
    }
    let status = done(at, &["sweep", "status", "parts"]);
    assert!(status.contains("24 of 24") && status.contains(&format!("{excluded} excluded")), "{status}");
    assert_eq!(done(at, &["sweep", "status", "parts", "--failed"]), "");
    done(at, &["sweep", "merge", "parts", "--csv"]);
    assert_eq!(rows(at, "parts"), within);
    // the report is of those that were run alone
    let said = done(at, &["study", "report", "out"]);
    assert!(said.contains(&format!("{} runs", 24 - excluded)) && said.contains("left out by constraints"), "{said}");
    let page = fs::read_to_string(at.join("out/report.html")).unwrap();
    assert!(!page.contains("lack this result") && page.contains("excluded by constraints"));
}

#[test]
fn a_preview_and_the_list_of_samples_know_which_stay() {
    let folder = folder_with(&constrained(NECK_FIRST));
    let at = folder.path();
    let told = done(at, &["sweep", "study.toml", "--dry-run"]);
    let stay: usize = told
        .lines()
        .find(|line| line.contains("samples stay"))
        .map_or(0, |line| line.split_whitespace().find_map(|word| word.parse().ok()).unwrap());
    assert!((4..20).contains(&stay), "{told}");
    let told = done(at, &["sweep", "study.toml", "--design-only", "design.csv"]);
    assert!(told.contains(&format!("{stay} samples; {} break a constraint", 24 - stay)), "{told}");
    assert_eq!(fs::read_to_string(at.join("design.csv")).unwrap().lines().count(), 1 + stay);
    let none = folder_with(&constrained("sum = { neck = 1 }\nmax = \"1 in lbf s/rad\""));
    let said = err(&answer(none.path(), &["sweep", "study.toml", "-o", "out"]));
    assert!(said.contains("no point of the ranges keeps all of them") && !none.path().join("out").exists(), "{said}");
}
