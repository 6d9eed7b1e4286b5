//! Which room of the command may use which: each only those that stand before it.

use std::fs;
use std::path::{Path, PathBuf};

const ROOMS: [&str; 5] = ["base", "files", "pictures", "jobs", "commands"];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

#[test]
fn no_room_uses_one_that_stands_above_it() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (floor, room) in ROOMS.iter().enumerate() {
        for file in sources(&src.join(room)).iter().filter(|f| f.extension().is_some_and(|e| e == "rs")) {
            let text = fs::read_to_string(file).unwrap();
            for above in &ROOMS[floor + 1..] {
                assert!(!text.contains(&format!("crate::{above}")), "{} uses {above}", file.display());
            }
        }
    }
}

#[test]
fn there_is_no_other_room() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for entry in fs::read_dir(src).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(ROOMS.contains(&name.as_str()) || ["lib.rs", "main.rs"].contains(&name.as_str()), "{name}");
    }
}
