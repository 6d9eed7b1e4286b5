//! Commands within the fuzzer's process, in a folder of its own.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// Scenario that runs in a moment: two outputs.
pub const SCENARIO: &str = include_str!("../tests/case.toml");
/// What makes it short.
const SHORT: &str = "[set]\n\"time.end\" = \"2 ms\"\n\"output.interval\" = \"1 ms\"\n";

/// The head of a study of it.
pub fn study(rest: &str) -> String {
    format!("base = \"case.toml\"\nseed = 1\n{SHORT}{rest}")
}

/// Makes an empty folder, with the scenario in it, the one that commands work in.
pub fn folder() -> PathBuf {
    let folder = env::temp_dir().join(format!("occupant-fuzz-{}", std::process::id()));
    let _not_there = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for temporary files");
    env::set_current_dir(&folder).expect("it was made");
    write("case.toml", SCENARIO.as_bytes());
    folder
}

/// Writes a file of that folder.
pub fn write(name: impl AsRef<Path>, bytes: &[u8]) {
    fs::write(name, bytes).expect("room in the folder for temporary files");
}

/// Gives commands, as one would type them. What they answer is theirs; a panic is a finding.
pub fn give(lines: &[&str]) {
    for line in lines {
        let words = ["occupant"].into_iter().chain(line.split(' ')).map(Into::into);
        let _exit_code = occupant_cli::answer(words);
    }
}
