//! Going on from what a run has left.

use std::path::Path;

use occupant_cli::mcap::StoredRun;
use occupant_core::results::checkpoint::Checkpoint;

use super::{answer, code, err, folder_with_case, json};

/// Runs the case with these words; it must do.
fn run(folder: &Path, words: &[&str]) {
    let words = [&["run", "case.toml", "-q"], words].concat();
    let output = answer(folder, &words);
    assert_eq!(code(&output), 0, "{}", err(&output));
}

/// All messages of a file: topic, ns, content. The log is apart: it is written at the end.
fn messages(file: &Path) -> Vec<(String, u64, Vec<u8>)> {
    let bytes = std::fs::read(file).unwrap();
    let all = mcap::MessageStream::new(&bytes).unwrap();
    all.map(Result::unwrap)
        .filter(|m| m.channel.topic != "/log")
        .map(|m| (m.channel.topic.clone(), m.log_time, m.data.into_owned()))
        .filter(|m| !m.0.starts_with("/scene") && m.0 != "/tf")
        .collect()
}

fn stored(file: &Path) -> StoredRun {
    StoredRun::read(&std::fs::read(file).unwrap()).unwrap()
}

fn last(file: &Path) -> Checkpoint {
    stored(file).checkpoints.last().unwrap().clone()
}

const ADAPTIVE: &str = r#"integrator={kind="adaptive"}"#;

#[test]
fn a_run_in_two_parts_is_the_run_in_one() {
    for integrator in [r#"integrator.step="0.2 ms""#, ADAPTIVE] {
        let folder = folder_with_case();
        let at = |name: &str| folder.path().join(name);
        let set = ["--set", integrator];
        run(folder.path(), &[&set[..], &["-o", "whole.mcap"]].concat());
        run(folder.path(), &[&set[..], &["--until", "60 ms", "-o", "first.mcap"]].concat());
        let resumed = ["--resume", "first.mcap", "-o", "rest.mcap"];
        run(folder.path(), &[&set[..], &resumed].concat());
        let first = last(&at("first.mcap"));
        assert_eq!(first.time_s, 0.06);
        let (whole, rest) = (stored(&at("whole.mcap")), stored(&at("rest.mcap")));
        assert!(first == whole.checkpoints[first.index]);
        assert!(rest.checkpoints == whole.checkpoints);
        let [expected, found] = ["whole.mcap", "rest.mcap"].map(|name| messages(&at(name)));
        assert!(expected.len() > 1000);
        assert!(found == expected);
        assert_eq!(rest.result, whole.result);
        assert_eq!((rest.flaw(), rest.ending()), (None, whole.ending()));
        assert_eq!(rest.run["resumed_from"], "first.mcap");
        assert_eq!(rest.run["resumed_at_s"], "0.06");
        assert_eq!(rest.run["resumed_output"], first.index.to_string());
    }
}

#[test]
fn the_summary_of_a_resumed_run_is_that_of_the_whole() {
    let folder = folder_with_case();
    let summary = |words: &[&str]| {
        let words = [&["run", "case.toml", "--json"], words].concat();
        let mut answer = json(&answer(folder.path(), &words));
        let object = answer.as_object_mut().unwrap();
        for changing in ["file", "overrides", "resumed"] {
            object.remove(changing);
        }
        object["solver"].as_object_mut().unwrap().remove("wall_time_s");
        answer
    };
    let whole = summary(&["-o", "whole.mcap"]);
    run(folder.path(), &["--until", "0.0604", "-o", "first.mcap"]);
    // the end lies between two outputs: the run continues from the one before
    assert_eq!(summary(&["--resume", "first.mcap", "-o", "rest.mcap"]), whole);
    let rest = stored(&folder.path().join("rest.mcap"));
    assert_eq!(rest.run["resumed_at_s"], "0.06");
    assert!(last(&folder.path().join("rest.mcap")) == last(&folder.path().join("whole.mcap")));
}

#[test]
fn what_a_killed_run_left_can_be_resumed() {
    let folder = folder_with_case();
    let at = |name: &str| folder.path().join(name);
    run(folder.path(), &["-o", "whole.mcap"]);
    let bytes = std::fs::read(at("whole.mcap")).unwrap();
    let whole = stored(&at("whole.mcap"));
    let mut reached = Vec::new();
    for part in [5, 7] {
        let cut = &bytes[..bytes.len() * part / 10];
        std::fs::write(at("cut.partial.mcap"), cut).unwrap();
        let left = stored(&at("cut.partial.mcap"));
        assert!(left.result.is_none());
        let from = left.checkpoints.last().unwrap().index;
        assert!(left.checkpoints == whole.checkpoints[..=from]);
        let words = ["--resume", "cut.partial.mcap", "-f", "-o", "rest.mcap"];
        run(folder.path(), &words);
        assert!(stored(&at("rest.mcap")).checkpoints == whole.checkpoints);
        reached.push(from);
    }
    // a chunk is closed every 50 outputs
    assert!(reached.iter().all(|at| (at + 1).is_multiple_of(50)), "{reached:?}");
    // a resumed run can be resumed in its turn
    let bytes = std::fs::read(at("rest.mcap")).unwrap();
    std::fs::write(at("again.mcap"), &bytes[..bytes.len() * 9 / 10]).unwrap();
    run(folder.path(), &["--resume", "again.mcap", "-o", "third.mcap"]);
    assert!(last(&at("third.mcap")) == *whole.checkpoints.last().unwrap());
}

#[test]
fn a_damaged_chunk_gives_no_checkpoint() {
    let folder = folder_with_case();
    run(folder.path(), &["-o", "whole.mcap"]);
    let mut bytes = std::fs::read(folder.path().join("whole.mcap")).unwrap();
    let sound = StoredRun::read(&bytes).unwrap().checkpoints.len();
    let middle = bytes.len() * 6 / 10;
    bytes[middle] ^= 0x10;
    let left = StoredRun::read(&bytes).map_or(0, |s| s.checkpoints.len());
    // 50 outputs a chunk; the whole ones behind it are read
    assert_eq!(sound - left, 50, "{left} of {sound}");
}

#[test]
fn what_cannot_be_resumed_is_refused_in_words() {
    let folder = folder_with_case();
    run(folder.path(), &["--until", "0.06", "-o", "first.mcap"]);
    std::fs::write(folder.path().join("text.mcap"), "no results").unwrap();
    let bytes = std::fs::read(folder.path().join("first.mcap")).unwrap();
    std::fs::write(folder.path().join("short.mcap"), &bytes[..20_000]).unwrap();
    let cases: [(&[&str], &str); 8] = [
        (&["--resume", "none.mcap"], "cannot be read"),
        (&["--resume", "text.mcap"], "not an MCAP file"),
        (&["--resume", "short.mcap"], "has no checkpoint"),
        (&["--resume", "first.mcap", "--until", "0.05"], "reaches t = 0.06 s"),
        (&["--resume", "first.mcap", "--until", "0.06"], "--until"),
        (&["--resume", "first.mcap", "--until", "soon"], "soon"),
        (&["--resume", "first.mcap", "--set", "output.interval=\"2 ms\""], "output.interval: "),
        (&["--resume", "first.mcap", "-f", "-o", "first.mcap"], "would overwrite"),
    ];
    for (words, expected) in cases {
        let words = [&["run", "case.toml"], words].concat();
        let output = answer(folder.path(), &words);
        assert_eq!(code(&output), 2, "{words:?}");
        assert!(err(&output).contains(expected), "{words:?}: {}", err(&output));
    }
    assert!(std::fs::read(folder.path().join("first.mcap")).unwrap() == bytes);
    assert!(!folder.path().join("case.resumed.mcap").exists());
    assert!(!folder.path().join("case.resumed.partial.mcap").exists());
}

#[test]
fn words_about_a_scenario_may_change_before_it_is_resumed() {
    let folder = folder_with_case();
    run(folder.path(), &["--until", "0.06", "-o", "first.mcap"]);
    run(folder.path(), &["--resume", "first.mcap", "--set", "title=Another title"]);
    assert!(folder.path().join("case.resumed.mcap").exists());
}
