//! Several processes on one study.

use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

use super::{STUDY, answer, done, err, folder_with, occupant, rows};

#[test]
fn shards_merged_are_the_sweep_and_what_is_missing_is_named() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    done(at, &["sweep", "study.toml", "-o", "out", "--shard", "3/3"]);
    let slurm = occupant(at)
        .args(["sweep", "study.toml", "-o", "out"])
        .env("SLURM_ARRAY_TASK_ID", "4")
        .env("SLURM_ARRAY_TASK_COUNT", "3")
        .env("SLURM_ARRAY_TASK_MIN", "4")
        .output()
        .unwrap();
    assert_eq!(slurm.status.code(), Some(0), "{}", err(&slurm));
    assert!(err(&slurm).contains("shard 1/3, from SLURM_ARRAY_TASK_ID"), "{}", err(&slurm));
    let early = answer(at, &["sweep", "merge", "out"]);
    assert_eq!(early.status.code(), Some(1));
    let said = err(&early);
    assert!(said.contains("8 of 24 samples are missing: 8–15"), "{said}");
    assert!(said.contains("--range 8..16"), "{said}");
    assert!(!at.join("out/results.parquet").exists());
    // the same shard twice computes nothing the second time
    for _ in 0..2 {
        done(at, &["sweep", "study.toml", "-o", "out", "--shard", "2/3", "--quiet"]);
    }
    done(at, &["sweep", "merge", "out", "--csv"]);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
}

#[test]
fn shards_in_folders_of_their_own_are_merged_too() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    done(at, &["sweep", "study.toml", "-o", "a", "--shard", "1/2", "--quiet"]);
    done(at, &["sweep", "study.toml", "-o", "b", "--shard", "2/2", "--quiet"]);
    done(at, &["sweep", "merge", "a", "b", "-o", "table", "--csv"]);
    assert_eq!(rows(at, "table"), rows(at, "whole"));
    // the folder of the table is complete: it is reported, and merged again
    done(at, &["study", "report", "table"]);
    done(at, &["sweep", "merge", "a", "b", "-o", "table"]);
    // a table of something else is not replaced
    fs::create_dir(at.join("foreign")).unwrap();
    fs::write(at.join("foreign/results.parquet"), "years of work").unwrap();
    let again = answer(at, &["sweep", "merge", "a", "b", "-o", "foreign"]);
    assert_eq!(again.status.code(), Some(2));
    let said = err(&again);
    assert!(said.contains("results.parquet exists and does not belong to this sweep"), "{said}");
    let other = ["sweep", "study.toml", "-o", "c", "--shard", "2/2", "--set", "path.duration=70 ms"];
    done(at, &other);
    let mixed = answer(at, &["sweep", "merge", "a", "c"]);
    assert_eq!(mixed.status.code(), Some(2));
    assert!(err(&mixed).contains("--set: none → path.duration=70 ms"), "{}", err(&mixed));
}

#[test]
fn two_processes_do_not_compute_the_same_shard_at_once() {
    let study = STUDY.replace("30 ms", "100 s");
    let folder = folder_with(&study);
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--threads", "1"];
    let mut first = occupant(at).args(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while !at.join("out/journal/000000000-000000023.lock").exists() {
        assert!(first.try_wait().unwrap().is_none(), "the first one has ended");
        sleep(Duration::from_millis(5));
    }
    sleep(Duration::from_millis(200));
    for (more, doing) in [
        (&[][..], "the same study"),
        (&["--shard", "1/2"], "all samples of the study"),
        (&["--restart"], "the same study"),
    ] {
        let second = answer(at, &[&words[..], more].concat());
        assert_eq!(second.status.code(), Some(75), "{more:?}");
        let said = err(&second);
        assert!(said.contains(&format!("another process is working in out: it computes {doing}")), "{said}");
    }
    first.kill().unwrap();
    first.wait().unwrap();
    let short = ["--set", "time.end=20 ms", "--restart", "--quiet"];
    done(at, &[&words[..], &short].concat());
}
