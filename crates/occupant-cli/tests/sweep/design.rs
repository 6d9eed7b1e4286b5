//! The samples of a study as a table, and a study of that table.

use std::fs;

use super::{STUDY, answer, column, done, err, folder_with, rows};

#[test]
fn a_study_of_the_table_of_a_study_has_its_samples_to_the_bit() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "out", "--csv", "--quiet"]);
    let wanted = rows(at, "out");
    for file in ["samples.parquet", "samples.csv"] {
        let said = done(at, &["sweep", "study.toml", "--design-only", file]);
        assert!(said.contains("24 samples"), "{said}");
        let study = STUDY.split("[[parameters]]").next().unwrap();
        let design = study.lines().find(|line| line.starts_with("design")).unwrap();
        let table = study.replace(design, &format!("design = {{ kind = \"table\", file = \"{file}\" }}"));
        let speed = "[[parameters]]\nname = \"speed\"\npath = \"path.speed\"\n";
        fs::write(at.join("table.toml"), format!("{table}\n{speed}")).unwrap();
        done(at, &["sweep", "table.toml", "-o", "again", "--csv", "--quiet", "--restart"]);
        let found = rows(at, "again");
        for name in ["input.speed", "input.joints.neck.damping", "head.peak"] {
            assert_eq!(column(&found, name), column(&wanted, name), "{file} {name}");
        }
    }
}

#[test]
fn a_table_of_samples_is_replaced_only_when_asked_and_nothing_is_run() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--design-only", "samples.csv"];
    done(at, &words);
    let text = fs::read_to_string(at.join("samples.csv")).unwrap();
    assert!(text.starts_with("joints.neck.damping[N·m·s/rad],speed[m/s]\n") && text.lines().count() == 25, "{text}");
    assert!(!at.join("out").exists());
    let said = err(&answer(at, &words));
    assert!(said.contains("--design-only samples.csv: the file exists") && said.contains("--restart"), "{said}");
    done(at, &[&words[..], &["--restart"]].concat());
    let other = ["sweep", "study.toml", "--design-only", "samples.txt"];
    let said = err(&answer(at, &other));
    assert!(said.contains("--design-only samples.txt: unknown") && said.contains(".csv, .parquet"), "{said}");
}
