//! Fits that are killed and resumed.

use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

use super::*;

/// All results but the clock's: fit.json, fitted.toml, and the history without its last two columns.
fn results(at: &Path, out: &str) -> Vec<String> {
    let read = |name: &str| fs::read_to_string(at.join(out).join(name)).unwrap();
    let history = read("history.csv");
    let without_clock = |line: &str| {
        let (rest, _kernel) = line.rsplit_once(',').unwrap();
        rest.rsplit_once(',').unwrap().0.to_owned()
    };
    let history: Vec<String> = history.lines().map(without_clock).collect();
    vec![read("fit.json"), read("fitted.toml"), history.join("\n")]
}

/// Bytes of the journal's rows.
fn written(at: &Path) -> u64 {
    let Ok(pieces) = fs::read_dir(at.join("out/journal")) else {
        return 0;
    };
    pieces.map(|p| p.unwrap().metadata().unwrap().len()).sum()
}

#[test]
fn killed_at_any_moment_it_ends_at_the_same_answer_bit_for_bit() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.03, 1);
    let fit = |out| ["fit", "study.toml", "--test", "test.csv", "-o", out, "--quiet"];
    done(at, &fit("whole"));
    let mut kills = 0;
    for round in 0..8_u64 {
        let before = written(at);
        let mut child = occupant(at)
            .args(fit("out"))
            .args(["--threads", if round % 2 == 0 { "1" } else { "3" }])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // every other kill waits for new rows, and then some more time that differs
        while round % 2 == 1 && written(at) <= before + 500 && child.try_wait().unwrap().is_none() {
            sleep(Duration::from_millis(5));
        }
        sleep(Duration::from_millis(30 + 47 * round));
        kills += u32::from(child.try_wait().unwrap().is_none());
        // SIGKILL on Unix
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(kills >= 4, "only {kills} of 8 kills came before the end");
    assert!(written(at) > 1000);
    done(at, &fit("out"));
    assert_eq!(results(at, "out"), results(at, "whole"));
}

#[test]
fn the_answer_is_the_same_for_any_number_of_threads_and_every_kernel() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.03, 2);
    let fit = |out: &str, more: &[&str]| {
        let words = ["fit", "study.toml", "--test", "test.csv", "-o", out, "--quiet"];
        done(at, &[&words, more].concat());
        results(at, out)
    };
    let one = fit("one", &["--threads", "1"]);
    assert_eq!(one, fit("five", &["--threads", "5"]));
    assert_eq!(one, fit("scalar", &["--kernel", "scalar"]));
    // and another seed searches elsewhere
    let study = STUDY.replace("seed = 5", "seed = 6");
    fs::write(at.join("study.toml"), study).unwrap();
    assert_ne!(one, fit("other", &[]));
}

#[test]
fn another_test_or_study_in_the_same_folder_is_refused_with_what_differs() {
    let folder = folder_with(&STUDY.replace("budget = 160", "budget = 16"));
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.03, 1);
    let fit = ["fit", "study.toml", "--test", "test.csv", "-o", "out", "--quiet"];
    done(at, &fit);
    measure(at, "test.csv", &HIDDEN, 0.03, 2);
    let refused = answer(at, &fit);
    assert_eq!(refused.status.code(), Some(2));
    let said = err(&refused);
    assert!(said.contains("out contains another fit") && said.contains("test.csv, line 2"), "{said}");
    done(at, &[&fit[..], &["--restart"]].concat());
    // a sweep does not touch it
    let study = format!("{STUDY}\n[design]\nkind = \"monte_carlo\"\nsamples = 4\n");
    fs::write(at.join("sweep.toml"), study).unwrap();
    let refused = answer(at, &["sweep", "sweep.toml", "-o", "out"]);
    assert!(err(&refused).contains("do not belong to a sweep"), "{}", err(&refused));
}

#[test]
fn damage_in_a_finished_folder_is_named_and_made_again() {
    let folder = folder_with(&STUDY.replace("budget = 160", "budget = 16"));
    let at = folder.path();
    measure(at, "test.csv", &HIDDEN, 0.03, 1);
    let fit = ["fit", "study.toml", "--test", "test.csv", "-o", "out", "--quiet"];
    done(at, &fit);
    let whole = results(at, "out");
    for name in ["fit.json", "fitted.toml", "history.csv", "plots/test.svg", "search.json", "inputs/2-test.csv"] {
        damage(&at.join("out").join(name), true);
        let told = spoken(at, &fit);
        assert!(told.starts_with("damaged: ") && told.contains(name), "{name}: {told}");
        assert_eq!(results(at, "out"), whole, "{name}");
    }
    let pieces = fs::read_dir(at.join("out/journal")).unwrap().map(|entry| entry.unwrap().path());
    let piece = pieces.filter(|path| path.extension().is_some_and(|ending| ending == "rows")).min().unwrap();
    let text = fs::read_to_string(&piece).unwrap();
    let (before, score) = text.rsplit_once("],\"wall").unwrap();
    let (before, _) = before.split_at(before.len() - 1);
    fs::write(&piece, format!("{before}0],\"wall{score}")).unwrap();
    assert!(spoken(at, &fit).contains("rows was changed after it was written"));
    assert_eq!(results(at, "out"), whole);
    assert_eq!(spoken(at, &fit), "");
}
