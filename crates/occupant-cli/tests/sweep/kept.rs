//! Whole runs of chosen samples.

use std::fs;
use std::path::Path;

use super::{STUDY, column, done, folder_with, rows};

fn files(at: &Path) -> Vec<String> {
    let entries = fs::read_dir(at.join("runs")).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn chosen_runs_are_the_files_that_run_writes() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "out", "--keep", "5, 2", "--csv", "--quiet"]);
    let out = at.join("out");
    assert_eq!(files(&out), ["000002.mcap", "000005.mcap"]);
    // the file says with which changes its scenario is that of the sample
    let kept = fs::read(out.join("runs/000005.mcap")).unwrap();
    let summary = mcap::Summary::read(&kept).unwrap().unwrap();
    let mut indexes = summary.metadata_indexes.iter();
    let index = indexes.find(|i| i.name == "occupant.run").unwrap();
    let about = mcap::read::metadata(&kept, index).unwrap();
    let sets: Vec<&str> = about.metadata["overrides"].lines().collect();
    assert_eq!(sets.len(), 3, "{sets:?}");
    let mut words = vec!["run", "case.toml", "-o", "again.mcap", "--quiet"];
    sets.iter().for_each(|set| words.extend(["--set", set]));
    done(at, &words);
    let again = fs::read(at.join("again.mcap")).unwrap();
    assert!(kept == again, "the files differ");
    let speed = column(&rows(at, "out"), "input.speed")[5].clone();
    assert!(sets[2].starts_with(&format!("path.speed={speed}")), "{sets:?} {speed}");
    // one that was removed comes back, to the bit
    fs::remove_file(out.join("runs/000005.mcap")).unwrap();
    done(at, &["sweep", "study.toml", "-o", "out", "--keep", "5, 2", "--quiet"]);
    let back = fs::read(out.join("runs/000005.mcap")).unwrap();
    assert!(back == again, "the file that came back differs");
}

#[test]
fn the_worst_are_kept_of_a_sweep_and_of_merged_shards() {
    let folder = folder_with(&format!("keep = \"worst 3 by head.peak\"\n{STUDY}"));
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    let peaks = column(&rows(at, "whole"), "head.peak");
    let mut by_peak: Vec<(f64, usize)> = peaks.iter().enumerate().map(|(i, p)| (p.parse().unwrap(), i)).collect();
    by_peak.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut wanted: Vec<String> = by_peak[..3].iter().map(|(_, i)| format!("{i:06}.mcap")).collect();
    wanted.sort();
    assert_eq!(files(&at.join("whole")), wanted);
    for shard in ["1/2", "2/2"] {
        done(at, &["sweep", "study.toml", "-o", "out", "--shard", shard, "--quiet"]);
    }
    // the folder is enough to merge: study and scenario may be elsewhere
    fs::remove_file(at.join("case.toml")).unwrap();
    done(at, &["sweep", "merge", "out", "--quiet"]);
    assert_eq!(files(&at.join("out")), wanted);
    for name in &wanted {
        let file = |of: &str| fs::read(at.join(of).join("runs").join(name)).unwrap();
        assert!(file("out") == file("whole"), "{name}");
    }
}

#[test]
fn all_runs_are_kept_where_the_study_says_so() {
    let study = format!("keep = \"all\"\n{}", STUDY.replace("samples = 24", "samples = 4"));
    let folder = folder_with(&study);
    done(folder.path(), &["sweep", "study.toml", "-o", "out", "--quiet"]);
    assert_eq!(files(&folder.path().join("out")).len(), 4);
}
