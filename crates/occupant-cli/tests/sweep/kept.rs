//! Whole runs of chosen samples.

use std::fs;
use std::path::Path;

use super::{STUDY, column, done, folder_with, rows};

fn files(at: &Path) -> Vec<String> {
    let entries = fs::read_dir(at.join("runs")).unwrap();
    let mut names: Vec<String> = entries
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn chosen_runs_are_the_files_that_run_writes() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(
        at,
        &[
            "sweep",
            "study.toml",
            "-o",
            "out",
            "--keep",
            "5, 2",
            "--csv",
            "--quiet",
        ],
    );
    let out = at.join("out");
    assert_eq!(files(&out), ["000002.mcap", "000005.mcap"]);
    let table = rows(at, "out");
    let value = |name: &str| column(&table, name)[5].clone();
    let sets = [
        "time.end=\"30 ms\"".to_owned(),
        format!(
            "joints.neck.damping={} N m s/rad",
            value("input.joints.neck.damping")
        ),
        format!("path.speed={} m/s", value("input.speed")),
    ];
    let mut words = vec!["run", "case.toml", "-o", "again.mcap", "--quiet"];
    sets.iter().for_each(|set| words.extend(["--set", set]));
    done(at, &words);
    let again = fs::read(at.join("again.mcap")).unwrap();
    assert_eq!(fs::read(out.join("runs/000005.mcap")).unwrap(), again);
    // one that was removed comes back, to the bit
    fs::remove_file(out.join("runs/000005.mcap")).unwrap();
    done(
        at,
        &[
            "sweep",
            "study.toml",
            "-o",
            "out",
            "--keep",
            "5, 2",
            "--quiet",
        ],
    );
    assert_eq!(fs::read(out.join("runs/000005.mcap")).unwrap(), again);
}

#[test]
fn the_worst_are_kept_of_a_sweep_and_of_merged_shards() {
    let folder = folder_with(&format!("keep = \"worst 3 by head.peak\"\n{STUDY}"));
    let at = folder.path();
    done(
        at,
        &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"],
    );
    let peaks = column(&rows(at, "whole"), "head.peak");
    let mut by_peak: Vec<(f64, usize)> = peaks
        .iter()
        .enumerate()
        .map(|(i, p)| (p.parse().unwrap(), i))
        .collect();
    by_peak.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut wanted: Vec<String> = by_peak[..3]
        .iter()
        .map(|(_, i)| format!("{i:06}.mcap"))
        .collect();
    wanted.sort();
    assert_eq!(files(&at.join("whole")), wanted);
    for shard in ["1/2", "2/2"] {
        done(
            at,
            &[
                "sweep",
                "study.toml",
                "-o",
                "out",
                "--shard",
                shard,
                "--quiet",
            ],
        );
    }
    // the folder is enough to merge: study and scenario may be elsewhere
    fs::remove_file(at.join("case.toml")).unwrap();
    done(at, &["sweep", "merge", "out", "--quiet"]);
    assert_eq!(files(&at.join("out")), wanted);
    for name in &wanted {
        let file = |of: &str| fs::read(at.join(of).join("runs").join(name)).unwrap();
        assert_eq!(file("out"), file("whole"), "{name}");
    }
}

#[test]
fn all_runs_are_kept_where_the_study_says_so() {
    let study = format!(
        "keep = \"all\"\n{}",
        STUDY.replace("samples = 24", "samples = 4")
    );
    let folder = folder_with(&study);
    done(
        folder.path(),
        &["sweep", "study.toml", "-o", "out", "--quiet"],
    );
    assert_eq!(files(&folder.path().join("out")).len(), 4);
}
