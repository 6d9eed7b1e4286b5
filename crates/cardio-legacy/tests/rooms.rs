//! Which room of the crate may use which: those before it in this list. So there is no circle.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of `src`, each with all that it uses.
const ROOMS: [(&str, &[&str]); 13] = [
    ("rule", &[]),
    ("punched", &[]),
    ("fortran", &[]),
    ("cards", &["rule", "punched"]),
    ("deck", &["cards"]),
    ("compartment", &["deck"]),
    ("notes", &["cards", "deck"]),
    ("diagnostics", &["rule", "punched", "cards", "deck"]),
    ("check", &["rule", "cards", "deck", "compartment", "diagnostics"]),
    ("read", &["rule", "punched", "fortran", "cards", "deck", "diagnostics", "check"]),
    ("write", &["cards", "deck"]),
    ("convert", &["punched", "fortran", "cards", "deck", "compartment", "notes"]),
    ("back", &["punched", "fortran", "cards", "deck", "compartment", "notes", "write"]),
];

fn sources(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).expect("a folder of the crate");
    entries.flat_map(|entry| sources(&entry.expect("an entry").path())).collect()
}

/// The rooms that a source names behind `crate::`, its tests left out.
fn used(source: &str) -> Vec<String> {
    let code = source.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let behind = lines.flat_map(|line| line.split("crate::").skip(1));
    behind.map(|text| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()).collect()
}

#[test]
fn a_room_uses_only_those_that_it_may() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (at, (room, allowed)) in ROOMS.iter().enumerate() {
        assert!(allowed.iter().all(|a| ROOMS[..at].iter().any(|(before, _)| before == a)), "{room} closes a circle");
        let file = src.join(format!("{room}.rs"));
        let files = sources(&if file.exists() { file } else { src.join(room) });
        let mut found: Vec<String> = Vec::new();
        for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "rs")) {
            let uses = used(&fs::read_to_string(file).expect("text")).into_iter().filter(|name| name != room);
            for name in uses {
                assert!(allowed.contains(&name.as_str()), "{} uses {name}", file.display());
                found.push(name);
            }
        }
        for name in *allowed {
            assert!(found.iter().any(|f| f == name), "{room} uses {name} no longer");
        }
    }
    let entries = fs::read_dir(&src).expect("the sources").count();
    assert_eq!(entries, ROOMS.len() + 2, "a room is missing in this list (besides it: lib.rs, compartment.toml)");
}
