//! Sweeps that are killed and resumed.

use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::{STUDY, computed, done, files, folder_with, killed, occupant, rows};

#[test]
fn killed_at_any_moment_it_goes_on_to_the_same_table_and_computes_no_sample_twice() {
    let study = STUDY.replace("samples = 24", "samples = 800");
    let folder = folder_with(&study);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet", "--threads", "2"];
    let mut kills = 0;
    // moments that differ from each other: some before the first sample, some far in
    for (round, pause_ms) in (0..).zip([3_u64, 10, 25, 40, 5, 60, 15, 30]) {
        let mut child = occupant(at).args(words).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let began = Instant::now();
        let before = computed(&at.join("out")).len();
        // half of the kills wait for new rows, so that all of them do not fall before the first
        while round % 2 == 1 && computed(&at.join("out")).len() < before + 5 && child.try_wait().unwrap().is_none() {
            assert!(began.elapsed() < Duration::from_secs(120), "no row was written");
            sleep(Duration::from_millis(5));
        }
        sleep(Duration::from_millis(pause_ms));
        // SIGKILL on Unix
        kills += u32::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(kills >= 4, "only {kills} of 8 kills came before the end");
    let kept = computed(&at.join("out"));
    done(at, &words);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
    assert!(kept.values().all(|n| *n == 1), "{kept:?}");
    assert_eq!(files(&at.join("out/journal"), "").len(), 0, "the table holds all rows, and nothing else a copy");
    assert!(kept.len() >= 10, "the kills left {} rows", kept.len());
}

#[test]
fn a_torn_row_is_cut_off_and_computed_again() {
    let folder = folder_with(&STUDY.replace("samples = 24", "samples = 200"));
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet"];
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    killed(at, &words);
    let piece = files(&at.join("out/journal"), ".rows").remove(0);
    let bytes = fs::read(&piece).unwrap();
    for cut in [1, bytes.len() / 2, bytes.len() - 3] {
        fs::write(&piece, &bytes[..bytes.len() - cut]).unwrap();
        done(at, &words);
        assert_eq!(rows(at, "out"), rows(at, "whole"), "cut by {cut}");
        ["results.parquet", "results.csv"].iter().for_each(|name| fs::remove_file(at.join("out").join(name)).unwrap());
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_with_its_reason_and_what_was_finished_stays() {
    let folder = folder_with(&STUDY.replace("samples = 24", "samples = 60"));
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    // a limit on the size of a file stands for a full disk: the journal cannot grow beyond it
    let binary = assert_cmd::cargo::cargo_bin!("occupant");
    let line =
        format!("trap '' XFSZ; ulimit -f 32; exec '{}' sweep study.toml -o out --csv --threads 2", binary.display());
    let limited = std::process::Command::new("bash")
        .args(["-c", &line])
        .current_dir(at)
        .env_remove("OCCUPANT_SHARD")
        .env_remove("SLURM_ARRAY_TASK_ID")
        .output()
        .unwrap();
    let said = super::err(&limited);
    assert_eq!(limited.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write") && said.contains("os error 27"), "{said}");
    assert!(said.contains("of 60 samples are finished and kept"), "{said}");
    let before = computed(&at.join("out"));
    assert!(!before.is_empty() && before.len() < 60, "{before:?}");
    done(at, &["sweep", "study.toml", "-o", "out", "--csv", "--quiet"]);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
}
