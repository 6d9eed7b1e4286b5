//! The commands of a page run its rows again, to the last bit. They are words of a POSIX shell, which Windows lacks.
#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::Command;

use super::{done, figures, folder_with, page, swept};

/// The commands of a page, without those that stand there twice.
fn commands(page: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for part in page.split("<pre class=\"command\">").skip(1) {
        let text = part.split("</pre>").next().expect("an end");
        let marks = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
        let text = marks.iter().fold(text.to_owned(), |t, (a, b)| t.replace(a, b));
        if !found.contains(&text) {
            found.push(text);
        }
    }
    found
}

/// Runs a command of the page in the folder of the study, as a shell does.
fn shell(folder: &Path, command: &str) {
    let program = assert_cmd::cargo::cargo_bin!("occupant");
    let beside = program.parent().expect("a folder");
    let path = format!("{}:{}", beside.display(), std::env::var("PATH").expect("a path"));
    let output =
        Command::new("sh").args(["-c", command]).current_dir(folder).env("PATH", path).output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{command}: {said}");
}

/// Every command of the page gives all figures of its row; how many commands there were.
fn all_give_their_rows(folder: &Path) -> usize {
    let out = folder.join("out");
    let table = fs::read_to_string(out.join("results.csv")).expect("a table");
    let mut lines = table.lines();
    let names: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let rows: Vec<Vec<&str>> = lines.map(|l| l.split(',').collect()).collect();
    let commands = commands(&page(folder));
    for command in &commands {
        shell(&out, command);
        let file = command.rsplit(' ').next().expect("a file");
        let run: usize = file["sample-".len()..file.len() - ".mcap".len()].parse().expect("a number");
        let row = &rows[run];
        assert_eq!(row[0], run.to_string(), "the table stands in order");
        let mut compared = 0;
        for (name, value) in figures(&out.join(file)) {
            let at = names.iter().position(|n| *n == name);
            let cell = row[at.unwrap_or_else(|| panic!("no column {name}"))];
            let wanted: Option<f64> = cell.parse().ok();
            let (found, wanted) = (value.map(f64::to_bits), wanted.map(f64::to_bits));
            assert_eq!(found, wanted, "{name} of run {run}: {value:?}, the row has {cell}");
            compared += 1;
        }
        assert!(compared > 60, "{compared}");
    }
    commands.len()
}

#[test]
fn factors_offsets_words_and_shared_changes_come_again_to_the_bit() {
    let study = r#"
        title = "it's \"quoted\""
        seed = 5
        design = { kind = "monte_carlo", samples = 12 }
        set = { "time.end" = "25 ms", "belts.lap.slack" = "0.3 in" }
        [[parameters]]
        path = "joints.*.damping"
        apply = "factor"
        range = { from = 0.3, to = 3, scale = "log" }
        [[parameters]]
        name = "heels 'n' toes"
        path = "posture.heels[0]"
        apply = "offset"
        distribution = { kind = "normal", mean = 0, sd = 0.01 }
        [[parameters]]
        path = "path.shape"
        list = ["half_sine", "square"]
        [[parameters]]
        path = "path.speed"
        distribution = { kind = "triangular", from = "15 mph", mode = "20 mph", to = "25 mph" }
    "#;
    let folder = folder_with(study);
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet", "--set"];
    done(folder.path(), &[&words[..], &["path.duration=70 ms"]].concat());
    assert!(all_give_their_rows(folder.path()) >= 4);
}

#[test]
fn members_of_an_ensemble_come_again_to_the_bit() {
    let study = r#"
        seed = 2
        design = { kind = "full_factorial" }
        set = { "time.end" = "20 ms" }
        [[parameters]]
        path = "path.speed"
        list = ["18 mph", "22 mph"]
        [ensemble]
        members = 3
    "#;
    let folder = swept(study);
    assert!(all_give_their_rows(folder.path()) >= 2);
    let text = page(folder.path());
    assert!(text.contains("3 runs per sample"));
}

#[test]
fn a_table_of_motions_is_found_beside_the_copy_of_the_scenario() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    fs::create_dir(at.join("cases")).unwrap();
    for name in ["side-slope.toml", "side-slope-path.csv"] {
        fs::copy(scenarios.join(name), at.join("cases").join(name)).unwrap();
    }
    let study = r#"
        base = "cases/side-slope.toml"
        set = { "time.end" = "20 ms" }
        design.kind = "full_factorial"
        [[parameters]]
        path = "joints.*.damping"
        apply = "factor"
        list = [0.5, 1, 2]
    "#;
    fs::write(at.join("study.toml"), study).unwrap();
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet"];
    done(at, &words);
    // wherever the folder goes
    fs::create_dir(at.join("moved")).unwrap();
    fs::rename(at.join("out"), at.join("moved/out")).unwrap();
    fs::remove_dir_all(at.join("cases")).unwrap();
    assert!(all_give_their_rows(&at.join("moved")) >= 2);
}

#[test]
fn a_run_made_in_the_folder_of_a_study_does_it_no_harm() {
    let folder = swept(super::STUDY);
    let at = folder.path();
    let text = page(at);
    let first = commands(&text)[0].clone();
    shell(&at.join("out"), &first);
    // the sweep's own folder still continues being one
    done(at, &["sweep", "study.toml", "-o", "out", "--csv", "--quiet"]);
    done(at, &["study", "report", "out"]);
    assert_eq!(page(at), text);
}
