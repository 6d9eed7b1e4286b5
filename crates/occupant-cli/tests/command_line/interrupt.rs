//! Ctrl-C, where there are signals.
#![cfg(unix)]

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::folder_with_case;

/// What a command in `folder` leaves on standard output and standard error if it is interrupted as soon as it `is_on_its_way`.
fn interrupted(folder: &Path, args: &[&str], is_on_its_way: impl Fn() -> bool) -> [String; 2] {
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
        .args(args)
        .current_dir(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now();
    while !is_on_its_way() {
        assert!(patience.elapsed() < Duration::from_secs(60), "it does not get on its way");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(200));
    assert!(child.try_wait().unwrap().is_none(), "it was too quick");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap())
}

/// Whether so much of a result is written that a run is under way.
fn has_grown(partial: &Path) -> bool {
    std::fs::metadata(partial).is_ok_and(|m| m.len() >= 100_000)
}

#[test]
fn an_interrupted_run_leaves_a_readable_file_that_says_so() {
    let folder = folder_with_case();
    let partial = folder.path().join("case.partial.mcap");
    let args = ["run", "case.toml", "--set", "time.end=10000"];
    let [table, said] = interrupted(folder.path(), &args, || has_grown(&partial));
    assert!(said.contains("partial"), "{said}");
    assert!(table.contains("INTERRUPTED"));
    assert!(!folder.path().join("case.mcap").exists());

    let bytes = std::fs::read(&partial).unwrap();
    let messages = mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap).count();
    assert!(messages > 100, "{messages}");
    let summary = mcap::Summary::read(&bytes).unwrap().expect("a summary");
    let index = summary.metadata_indexes.iter().find(|i| i.name == "occupant.result");
    let record = mcap::read::metadata(&bytes, index.expect("a result")).unwrap();
    assert_eq!(record.metadata["status"], "stopped");
}

#[test]
fn an_interrupted_ensemble_leaves_the_run_itself_and_its_table() {
    let folder = folder_with_case();
    let args = ["run", "case.toml", "--ensemble", "100000", "--channels", "head.acceleration.x"];
    let set = ["--set", "time.end=50 ms", "--set", "output.interval=25 ms"];
    let [table, said] =
        interrupted(folder.path(), &[&args[..], &set].concat(), || folder.path().join("case.mcap").exists());
    assert!(table.contains("HIC15") && table.contains("written          case.mcap"), "{table}");
    assert!(said.contains("the ensemble was interrupted after ") && said.contains(" of 99999 runs"), "{said}");
    assert!(said.contains("= done: the run itself is in case.mcap"), "{said}");
}

#[test]
fn the_table_of_runs_that_are_done_stands_when_a_later_one_is_interrupted() {
    let folder = folder_with_case();
    let case = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    let start = case.find("[time]").unwrap();
    let long = case[start..].replacen("end = ", "end = 10000 # ", 1);
    std::fs::write(folder.path().join("long.toml"), format!("{}{long}", &case[..start])).unwrap();
    let partial = folder.path().join("long.partial.mcap");
    let [table, said] = interrupted(folder.path(), &["run", "case.toml", "long.toml"], || has_grown(&partial));
    assert!(table.starts_with("1   case.toml\n") && table.contains("HIC15"), "{table}");
    assert!(said.contains("long.partial.mcap") && !said.contains("already registered"), "{said}");
}
