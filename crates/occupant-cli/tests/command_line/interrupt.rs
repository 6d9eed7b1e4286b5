//! Ctrl-C, where there are signals.
#![cfg(unix)]

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::folder_with_case;

#[test]
fn an_interrupted_run_leaves_a_readable_file_that_says_so() {
    let folder = folder_with_case();
    let child = Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
        .args(["run", "case.toml", "--set", "time.end=10000"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let partial = folder.path().join("case.partial.mcap");
    let patience = Instant::now();
    let size = || std::fs::metadata(&partial).map_or(0, |m| m.len());
    while size() < 100_000 {
        assert!(patience.elapsed() < Duration::from_secs(60), "nothing was written");
        std::thread::sleep(Duration::from_millis(20));
    }
    let signal = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(signal.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("partial"), "{said}");
    assert!(String::from_utf8(output.stdout).unwrap().contains("INTERRUPTED"));
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
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
        .args(["run", "case.toml", "--ensemble", "100000", "--channels", "head.acceleration.x"])
        .args(["--set", "time.end=50 ms", "--set", "output.interval=25 ms"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now();
    while !folder.path().join("case.mcap").exists() {
        assert!(patience.elapsed() < Duration::from_secs(60), "the run itself has no file");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(200));
    assert!(child.try_wait().unwrap().is_none(), "the ensemble was too quick");
    let signal = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(signal.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let (table, said) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(table.contains("HIC15") && table.contains("written          case.mcap"), "{table}");
    assert!(said.contains("the ensemble was interrupted after ") && said.contains(" of 99999 members"), "{said}");
    assert!(said.contains("= done: the run itself is in case.mcap"), "{said}");
}

#[test]
fn the_table_of_runs_that_are_done_stands_when_a_later_one_is_interrupted() {
    let folder = folder_with_case();
    let case = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    let start = case.find("[time]").unwrap();
    let long = case[start..].replacen("end = ", "end = 10000 # ", 1);
    std::fs::write(folder.path().join("long.toml"), format!("{}{long}", &case[..start])).unwrap();
    let child = Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
        .args(["run", "case.toml", "long.toml"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let patience = Instant::now();
    while std::fs::metadata(folder.path().join("long.partial.mcap")).map_or(0, |m| m.len()) < 100_000 {
        assert!(patience.elapsed() < Duration::from_secs(60), "nothing was written");
        std::thread::sleep(Duration::from_millis(20));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let (table, said) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(table.starts_with("1   case.toml\n") && table.contains("HIC15"), "{table}");
    assert!(said.contains("long.partial.mcap") && !said.contains("already registered"), "{said}");
}
