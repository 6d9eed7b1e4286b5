//! Which room of a crate may use which: each only those that stand before it, so that there are no circles.
//!
//! Rooms are the folders and files directly under a crate's `src`. Read from the sources as text: `crate::ROOM` outside
//! comments and test modules.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Crates with their rooms from the lowest to the highest.
const ROOMS: [(&str, &[&str]); 11] = [
    ("occupant-units", &["trig", "unit"]),
    ("crash-measures", &["signal", "correlation", "measure", "injury", "rating"]),
    (
        "vehicle-motion",
        &[
            "tyre",
            "body",
            "ground",
            "barrier",
            "car",
            "presets",
            "driver",
            "crush",
            "state",
            "chassis",
            "slider",
            "rail",
            "hull",
            "impulse",
            "integrate",
            "ride",
            "vehicle",
            "world",
            "run",
            "marks",
            "path",
        ],
    ),
    (
        "placed-text",
        &[
            "encoding",
            "nearest",
            "shown",
            "problem",
            "source",
            "diagnostic",
            "node",
            "path",
            "reader",
            "csv",
            "json",
            "toml",
            "document",
        ],
    ),
    (
        "occupant-core",
        &["quantity", "body", "vehicle", "motion", "forces", "kernel", "model", "results", "run", "diagnosis"],
    ),
    (
        "cardio-legacy",
        &[
            "rule",
            "punched",
            "fortran",
            "cards",
            "deck",
            "compartment",
            "notes",
            "diagnostics",
            "check",
            "read",
            "write",
            "convert",
            "back",
            "print",
        ],
    ),
    (
        "occupant-files",
        &[
            "base",
            "channel_code",
            "signals",
            "trouble",
            "book",
            "table",
            "mcap",
            "deck",
            "scenario",
            "steps",
            "part",
            "results",
            "history",
            "export",
            "mme",
            "measured",
        ],
    ),
    ("occupant-pictures", &["font", "svg", "format", "body", "mesh", "view", "plot", "gltf", "film", "scene", "html"]),
    (
        "occupant-jobs",
        &[
            "base",
            "files",
            "instruments",
            "compare",
            "templates",
            "import",
            "export",
            "plot",
            "view",
            "print",
            "risk",
            "judged",
            "measures",
            "rated",
            "keys",
            "report",
            "run",
            "extend",
            "drive",
            "quoted",
            "ensemble",
            "sensitivity",
            "sweep",
            "study",
            "seal",
            "surface",
            "search",
            "fit",
            "optimise",
        ],
    ),
    ("occupant-cli", &["base", "commands"]),
    ("occupant-web", &["knobs", "case", "import", "run", "study", "abi"]),
];

/// Crates that a crate of the workspace may depend on, outside its tests.
const CRATES: [(&str, &[&str]); 14] = [
    ("placed-text", &[]),
    ("occupant-units", &["placed-text"]),
    ("crash-measures", &["occupant-units"]),
    ("vehicle-motion", &[]),
    ("occupant-core", &["placed-text", "occupant-units", "crash-measures", "vehicle-motion"]),
    ("occupant-scenario", &["placed-text", "occupant-units", "crash-measures", "vehicle-motion", "occupant-core"]),
    ("occupant-study", &["placed-text", "occupant-units", "crash-measures", "occupant-core", "occupant-scenario"]),
    ("cardio-legacy", &["occupant-units", "occupant-core", "occupant-scenario"]),
    (
        "occupant-files",
        &["placed-text", "occupant-units", "crash-measures", "occupant-core", "occupant-scenario", "cardio-legacy"],
    ),
    (
        "occupant",
        &["placed-text", "occupant-units", "crash-measures", "occupant-core", "occupant-scenario", "occupant-files"],
    ),
    ("occupant-pictures", &["placed-text", "occupant-units", "occupant-core", "occupant-files"]),
    (
        "occupant-jobs",
        &[
            "placed-text",
            "occupant-units",
            "crash-measures",
            "vehicle-motion",
            "occupant-core",
            "occupant-scenario",
            "occupant-study",
            "cardio-legacy",
            "occupant-files",
            "occupant-pictures",
        ],
    ),
    (
        "occupant-web",
        &[
            "placed-text",
            "occupant-units",
            "occupant-core",
            "occupant-scenario",
            "occupant-study",
            "occupant-files",
            "occupant-jobs",
        ],
    ),
    (
        "occupant-cli",
        &[
            "placed-text",
            "occupant-units",
            "crash-measures",
            "vehicle-motion",
            "occupant-core",
            "occupant-scenario",
            "occupant-study",
            "cardio-legacy",
            "occupant-files",
            "occupant-pictures",
            "occupant-jobs",
        ],
    ),
];

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates")
}

fn name(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Source files below `path`, those of tests left out.
fn sources(path: &Path, found: &mut Vec<PathBuf>) {
    if path.is_dir() {
        let mut entries: Vec<_> = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()).collect();
        entries.sort();
        entries.iter().filter(|entry| name(entry) != "tests").for_each(|entry| sources(entry, found));
    } else if path.extension().is_some_and(|e| e == "rs") {
        found.push(path.to_owned());
    }
}

/// First words after `crate::` in `text`, also those of a list in braces.
fn uses(text: &str) -> BTreeSet<String> {
    let word = |s: &str| s.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut found = BTreeSet::new();
    for (at, _) in text.match_indices("crate::") {
        let rest = &text[at + "crate::".len()..];
        if text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '$') {
            continue;
        }
        match rest.strip_prefix('{') {
            None => drop(found.insert(word(rest))),
            Some(list) => {
                let (mut depth, mut first) = (0, true);
                for (i, c) in list.char_indices() {
                    if first {
                        found.insert(word(&list[i..]));
                    }
                    first = c == ',' && depth == 0;
                    match c {
                        '{' => depth += 1,
                        '}' if depth == 0 => break,
                        '}' => depth -= 1,
                        _ => {}
                    }
                }
            }
        }
    }
    found
}

/// The code of a file: no comments, and nothing from its test module on.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let text = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default().to_owned();
    text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

#[test]
fn rooms_use_only_rooms_below_them() {
    let mut wrong = Vec::new();
    for (krate, rooms) in ROOMS {
        let src = crates().join(krate).join("src");
        for entry in fs::read_dir(&src).unwrap().map(|entry| entry.unwrap().path()) {
            let room = name(&entry);
            if ["lib", "main", "tests"].contains(&room.as_str()) {
                continue;
            }
            let Some(height) = rooms.iter().position(|r| *r == room) else {
                wrong.push(format!("{krate}: the room `{room}` is not in the list of this test"));
                continue;
            };
            let mut files = Vec::new();
            sources(&entry, &mut files);
            for file in files {
                let above = uses(&code(&file)).into_iter().filter(|used| rooms[height + 1..].contains(&used.as_str()));
                wrong
                    .extend(above.map(|used| format!("{} uses `{used}`, which stands above `{room}`", file.display())));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn crates_depend_only_on_crates_below_them() {
    for (krate, below) in CRATES {
        let manifest = fs::read_to_string(crates().join(krate).join("Cargo.toml")).unwrap();
        let own = manifest.split("[dev-dependencies]").next().unwrap_or_default();
        for (other, _) in CRATES {
            let depends = own.lines().any(|line| {
                line.starts_with(&format!("{other}.workspace")) || line.starts_with(&format!("{other} = "))
            });
            assert!(!depends || below.contains(&other), "{krate} depends on {other}");
        }
    }
}

#[test]
fn the_core_reads_no_files_prints_nothing_and_starts_no_threads() {
    for krate in
        ["placed-text", "occupant-units", "crash-measures", "occupant-core", "occupant-scenario", "cardio-legacy"]
    {
        let mut files = Vec::new();
        sources(&crates().join(krate).join("src"), &mut files);
        for file in files {
            let code = code(&file);
            for forbidden in ["std::fs", "std::thread", "println!", "eprintln!", "std::process"] {
                assert!(!code.contains(forbidden), "{} uses {forbidden}", file.display());
            }
        }
    }
}

#[test]
fn the_scanner_sees_what_is_there() {
    let text = "use crate::run::Run;\nuse crate::{model::Model, results::{a, b}, forces};\nlet x = $crate::no; occupant_crate::no;";
    let found: Vec<_> = uses(text).into_iter().filter(|word| !word.is_empty()).collect();
    assert_eq!(found, ["forces", "model", "results", "run"]);
}

/// A page in a browser and Python need files, pictures and jobs, and have no terminal.
#[test]
fn files_pictures_and_jobs_talk_to_nobody() {
    for krate in ["occupant-files", "occupant-pictures", "occupant-jobs"] {
        let mut files = Vec::new();
        sources(&crates().join(krate).join("src"), &mut files);
        for file in files {
            let code = code(&file);
            for forbidden in ["println!", "eprintln!", "stdout()", "stderr()", "process::exit"] {
                assert!(!code.contains(forbidden), "{} uses {forbidden}", file.display());
            }
        }
    }
}

/// What computes needs no format: only `schema` and `documents`, which texts ask for, bring JSON, TOML and schemas.
#[test]
fn what_computes_depends_on_no_format() {
    for krate in ["vehicle-motion", "occupant-units", "crash-measures", "occupant-core", "placed-text"] {
        let manifest = fs::read_to_string(crates().join(krate).join("Cargo.toml")).unwrap();
        let after = manifest.split("[dependencies]").nth(1).unwrap_or_default();
        let own = after.split("[dev-dependencies]").next().unwrap_or_default();
        for format in ["toml", "serde_json", "jsonc-parser", "schemars"] {
            let needs = |line: &str| line.split(['.', ' ']).next() == Some(format) && !line.contains("optional = true");
            assert!(!own.lines().any(needs), "{krate} needs {format}");
        }
        assert!(!own.contains("documents") && !own.contains("\"schema\""), "{krate} asks for formats");
    }
}

/// Files of tests are modules of one binary: one that no binary names would never run.
#[test]
fn every_file_of_tests_belongs_to_a_binary() {
    for folder in ["tests/tests", "crates/occupant-cli/tests", "crates/cardio-legacy/tests"] {
        let folder = crates().join("..").join(folder);
        let main = fs::read_to_string(folder.join("main.rs")).unwrap();
        let own = |stem: &str| ["main", "allocation"].contains(&stem);
        for path in fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
            let is_rust = path.extension().is_some_and(|e| e == "rs") || path.join("mod.rs").exists();
            let stem = name(&path);
            if is_rust && !own(&stem) {
                assert!(main.lines().any(|line| line == format!("mod {stem};")), "{}", path.display());
            }
        }
    }
}

/// The lint tables of a manifest, line by line, under the names `rust` and `clippy`.
fn lints(manifest: &str, prefix: &str) -> Vec<String> {
    let text = fs::read_to_string(crates().join("..").join(manifest)).expect(manifest);
    let tables = text.split("\n[").filter_map(|table| table.strip_prefix(prefix));
    let lines = tables.flat_map(|table| table.lines().filter(|line| !line.is_empty() && !line.starts_with('#')));
    lines.map(str::to_owned).collect()
}

#[test]
fn the_python_module_has_the_lints_of_the_workspace() {
    let workspace = lints("Cargo.toml", "workspace.lints.");
    assert!(workspace.len() > 8, "{workspace:?}");
    assert_eq!(lints("crates/occupant-py/Cargo.toml", "lints."), workspace);
}
