//! Parts of a study that many processes compute without a look at each other.

use std::fs::{self, File};
use std::process::{Child, Stdio};
use std::thread::sleep;
use std::time::Duration;

use parquet::file::reader::{FileReader, SerializedFileReader};

use super::{STUDY, answer, done, err, files, folder_with, killed, occupant, rows, spoken};
use crate::common::damage;

/// A study of which the first samples stay as they are when there are more.
fn sobol(samples: u64) -> String {
    let design = format!("{{ kind = \"sobol\", samples = {samples} }}");
    STUDY.replace("{ kind = \"latin_hypercube\", samples = 24 }", &design)
}

#[test]
fn a_part_is_a_parquet_file_whose_rows_are_those_of_the_whole_table() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    for range in ["0..5", "5-16", "17..24"] {
        done(at, &["sweep", "study.toml", "-o", "out", "--range", range, "--quiet"]);
    }
    let parts = files(&at.join("out/parts"), "");
    let name = |path: &std::path::PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    let names = ["000000000-000000004.parquet", "000000005-000000016.parquet", "000000017-000000023.parquet"];
    assert_eq!(parts.iter().map(name).collect::<Vec<_>>(), names);
    let schema = |path: &std::path::PathBuf| {
        let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
        let about = reader.metadata().file_metadata();
        let keys: Vec<String> = about.key_value_metadata().unwrap().iter().map(|entry| entry.key.clone()).collect();
        (format!("{:?}", about.schema()), keys)
    };
    let whole = schema(&at.join("whole/results.parquet"));
    assert_eq!(whole.1, ["occupant.sweep", "occupant.units", "occupant.part"]);
    assert!(parts.iter().all(|part| schema(part) == whole), "another schema");
    assert_eq!(files(&at.join("out/journal"), "").len(), 0, "a finished range leaves its part alone");
    assert_eq!(done(at, &["sweep", "status", "out", "--missing"]), "");
    // without a merge
    done(at, &["study", "report", "out"]);
    done(at, &["export", "out", "-o", "exported.csv"]);
    done(at, &["sweep", "merge", "out", "--csv"]);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
    // nor with its parts
    fs::remove_dir_all(at.join("out/parts")).unwrap();
    done(at, &["study", "report", "out"]);
    done(at, &["sweep", "merge", "out", "--csv"]);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
}

#[test]
fn files_of_neighbours_are_not_opened() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "out", "--range", "0..4", "--quiet"]);
    // whoever opened one of them would end here
    for neighbour in 1..6 {
        let stem = format!("{:09}-{:09}", 4 * neighbour, 4 * neighbour + 3);
        fs::write(at.join(format!("out/parts/{stem}.parquet")), "garbage").unwrap();
        fs::write(at.join(format!("out/journal/{stem}.000000.rows")), "garbage\n").unwrap();
        fs::create_dir(at.join(format!("out/journal/{stem}.sums"))).unwrap();
        fs::create_dir(at.join(format!("out/journal/{stem}.lock"))).unwrap();
    }
    fs::write(at.join("out/results.parquet"), "garbage").unwrap();
    fs::write(at.join("out/SHA256SUMS"), "garbage\n").unwrap();
    // overlaps the first, and the second
    assert_eq!(spoken(at, &["sweep", "study.toml", "-o", "out", "--range", "2..6", "--quiet"]), "");
    assert_eq!(files(&at.join("out/parts"), ".parquet").len(), 7);
    let refused = answer(at, &["sweep", "merge", "out"]);
    assert_eq!(refused.status.code(), Some(2), "{}", err(&refused));
    // each command makes its own good
    for neighbour in 1..6 {
        let stem = format!("{:09}-{:09}", 4 * neighbour, 4 * neighbour + 3);
        let locks = ["sums", "lock"].map(|ending| at.join(format!("out/journal/{stem}.{ending}")));
        locks.iter().for_each(|path| fs::remove_dir(path).unwrap());
        let range = format!("{}-{}", 4 * neighbour, 4 * neighbour + 3);
        let said = spoken(at, &["sweep", "study.toml", "-o", "out", "--range", &range, "--quiet"]);
        assert_eq!(said.lines().filter(|line| line.starts_with("damaged: ")).count(), 2, "{said}");
    }
    fs::remove_file(at.join("out/results.parquet")).unwrap();
    done(at, &["sweep", "merge", "out", "--csv", "--quiet"]);
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
}

#[test]
fn a_killed_worker_is_followed_by_another_and_gaps_are_finished_by_their_ranges() {
    let folder = folder_with(&STUDY.replace("samples = 24", "samples = 200"));
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    let shard = |part: &'static str| ["sweep", "study.toml", "-o", "out", "--quiet", "--threads", "1", "--shard", part];
    killed(at, &shard("1/2"));
    killed(at, &shard("1/2"));
    done(at, &["sweep", "study.toml", "-o", "out", "--quiet", "--range", "120..180"]);
    let said = done(at, &["sweep", "status", "out"]);
    assert!(said.contains("of 200 samples") && said.contains("to go on one thread"), "{said}");
    let missing = done(at, &["sweep", "status", "out", "--missing"]);
    assert!(missing.lines().count() >= 2, "{missing}");
    for range in missing.lines() {
        done(at, &["sweep", "study.toml", "-o", "out", "--quiet", "--range", range]);
    }
    // what the killed worker has left is read beside the parts
    assert_eq!(done(at, &["sweep", "status", "out", "--missing"]), "");
    done(at, &["sweep", "merge", "out", "--csv", "--quiet"]);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
    assert_eq!(files(&at.join("out/journal"), "").len(), 0, "the table holds all rows");
}

#[test]
fn a_busy_range_has_an_exit_code_of_its_own_and_can_be_waited_for() {
    let folder = folder_with(&STUDY.replace("30 ms", "10 s"));
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--threads", "1", "--range", "0..2"];
    let start = |words: &[&str]| -> Child {
        occupant(at).args(words).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    let mut first = start(&words);
    while !at.join("out/journal/000000000-000000001.lock").exists() {
        assert!(first.try_wait().unwrap().is_none(), "the first one has ended");
        sleep(Duration::from_millis(5));
    }
    sleep(Duration::from_millis(200));
    let second = answer(at, &words);
    assert_eq!(second.status.code(), Some(75));
    assert!(err(&second).contains("it computes samples 0 to 1") && err(&second).contains("--wait"), "{}", err(&second));
    // all samples are claimed alone
    assert_eq!(answer(at, &words[..6]).status.code(), Some(75));
    let mut waiting = start(&[&words[..], &["--wait"]].concat());
    sleep(Duration::from_millis(500));
    assert!(waiting.try_wait().unwrap().is_none(), "it does not wait");
    first.kill().unwrap();
    first.wait().unwrap();
    // it goes on where the other has stopped
    let ended = waiting.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(0), "{}", err(&ended));
    assert!(err(&ended).contains("waiting: another process is working in out"), "{}", err(&ended));
    assert_eq!(files(&at.join("out/parts"), "").len(), 1);
    // neighbours are not in its way
    let other = ["--set", "time.end=20 ms", "--quiet"];
    done(at, &[&["sweep", "study.toml", "-o", "b", "--range", "0..12", "--wait"][..], &other].concat());
}

#[test]
fn more_samples_go_on_from_those_that_are_there() {
    let folder = folder_with(&sobol(8));
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--csv"];
    done(at, &[&words[..], &["--quiet"]].concat());
    done(at, &["sweep", "study.toml", "-o", "apart", "--shard", "1/2", "--quiet"]);
    fs::write(at.join("study.toml"), sobol(16)).unwrap();
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    let said = spoken(at, &words);
    assert!(said.contains("resuming: 8 of 16 samples are finished"), "{said}");
    assert_eq!(rows(at, "out"), rows(at, "whole"));
    done(at, &["study", "report", "out"]);
    // the same of parts
    for range in ["4..10", "10..16"] {
        done(at, &["sweep", "study.toml", "-o", "apart", "--range", range, "--quiet"]);
    }
    done(at, &["sweep", "merge", "apart", "--csv", "--quiet"]);
    assert_eq!(rows(at, "apart"), rows(at, "whole"));
    // fewer are another study
    fs::write(at.join("study.toml"), sobol(8)).unwrap();
    let fewer = answer(at, &words);
    assert_eq!(fewer.status.code(), Some(2));
    assert!(err(&fewer).contains("samples: 16 → 8 (the folder already has more)"), "{}", err(&fewer));
}

#[test]
fn a_table_of_samples_may_get_more_lines_and_no_others() {
    let table = "{ kind = \"table\", file = \"samples.csv\" }";
    let study = STUDY.replace("{ kind = \"latin_hypercube\", samples = 24 }", table);
    let head = study.split("[[parameters]]").next().unwrap();
    let folder = folder_with(head);
    let at = folder.path();
    let write = |text: &str| fs::write(at.join("samples.csv"), text).unwrap();
    write("path.speed[mph]\n15\n20\n");
    let words = ["sweep", "study.toml", "-o", "out", "--csv", "--quiet"];
    done(at, &words);
    write("path.speed[mph]\n15\n20\n25\n");
    done(at, &words);
    done(at, &["sweep", "study.toml", "-o", "whole", "--csv", "--quiet"]);
    assert_eq!(rows(at, "out"), rows(at, "whole"));
    for other in ["path.speed[mph]\n15\n21\n25\n", "path.speed[mph]\n15\n20\n255\n26\n", "path.speed[mph]\n15\n20\n"] {
        write(other);
        let refused = answer(at, &words);
        assert_eq!(refused.status.code(), Some(2), "{other}");
        assert!(err(&refused).contains("samples.csv, line "), "{other}: {}", err(&refused));
    }
}

#[test]
fn another_build_of_the_program_is_refused_with_the_difference() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--range", "0..3", "--quiet"];
    done(at, &words);
    let path = at.join("out/sweep.json");
    let manifest: serde_json::Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    let build = manifest["build"].as_str().unwrap();
    assert!(build.len() >= 16, "{build}");
    // as another build would have written it, with its part
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replace(build, "0123456789abcdef")).unwrap();
    fs::remove_dir_all(at.join("out/parts")).unwrap();
    let refused = answer(at, &words);
    assert_eq!(refused.status.code(), Some(2));
    let said = err(&refused);
    assert!(said.contains(&format!("build of the program: 0123456789abcdef → {build}")), "{said}");
    assert!(said.contains("--restart"), "{said}");
}

#[test]
fn a_part_that_a_kill_has_left_half_written_is_written_again() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--range", "0..3", "--quiet"];
    done(at, &words);
    let part = at.join("out/parts/000000000-000000002.parquet");
    let whole = fs::read(&part).unwrap();
    for name in ["000000000-000000002.parquet", "000000000-000000002.partial.parquet"] {
        fs::write(at.join("out/journal").join(name), &whole[..100]).unwrap();
    }
    damage(&part, true);
    done(at, &words);
    // the damaged one is not among those that are read as one table
    assert_eq!(files(&at.join("out/journal"), ""), [at.join("out/journal/000000000-000000002.damaged")]);
    assert_eq!(files(&at.join("out/parts"), ""), [part]);
    done(at, &["sweep", "status", "out"]);
}
