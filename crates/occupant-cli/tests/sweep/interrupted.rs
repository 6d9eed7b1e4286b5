//! Sweeps that are killed and resumed.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::{STUDY, done, folder_with, occupant, rows};

/// How often each sample stands in the journal, by the whole lines of its pieces.
fn computed(out: &Path) -> BTreeMap<u64, u32> {
    let mut times = BTreeMap::new();
    let Ok(pieces) = fs::read_dir(out.join("journal")) else {
        return times;
    };
    for piece in pieces {
        let path = piece.unwrap().path();
        if path.extension().is_none_or(|e| e != "rows") {
            continue;
        }
        let text = fs::read_to_string(path).unwrap();
        for line in text.split_inclusive('\n').skip(1).filter(|line| line.ends_with('\n')) {
            let row: serde_json::Value = serde_json::from_str(line).unwrap();
            *times.entry(row["is"]["index"].as_u64().unwrap()).or_default() += 1;
        }
    }
    times
}

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
    let times = computed(&at.join("out"));
    assert_eq!(times.len(), 800);
    assert!(times.values().all(|n| *n == 1), "{times:?}");
    assert!(kept.len() >= 10, "the kills left {} rows", kept.len());
}

#[test]
fn a_torn_row_is_cut_off_and_computed_again() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "out", "--csv", "--quiet"]);
    let whole = rows(at, "out");
    let journal = at.join("out/journal");
    let piece = fs::read_dir(&journal)
        .unwrap()
        .map(|e| e.unwrap().path())
        .find(|p| p.extension().is_some_and(|e| e == "rows"))
        .unwrap();
    let bytes = fs::read(&piece).unwrap();
    for cut in [1, bytes.len() / 2, bytes.len() - 3] {
        fs::write(&piece, &bytes[..bytes.len() - cut]).unwrap();
        done(at, &["sweep", "study.toml", "-o", "out", "--csv", "--quiet"]);
        assert_eq!(rows(at, "out"), whole, "cut by {cut}");
        // what the next round cuts is the first piece alone
        for entry in fs::read_dir(&journal).unwrap() {
            let path = entry.unwrap().path();
            if path != piece && path.extension().is_some_and(|e| e == "rows") {
                fs::remove_file(path).unwrap();
            }
        }
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
