//! The theory manual cannot rot: its files, names, links and equation numbers are checked against the source.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Last equation of the report.
const LAST_EQUATION: usize = 127;

fn core() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/occupant-core")
}

/// Where a file that the manual names may stand.
fn source_folders() -> [PathBuf; 5] {
    ["occupant-core", "occupant-units", "crash-measures", "occupant-scenario", "occupant-study"]
        .map(|name| Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates").join(name).join("src"))
}

/// The file of this name, in the first crate that has it.
fn source_file(name: &str) -> Option<PathBuf> {
    source_folders().into_iter().map(|folder| folder.join(name)).find(|path| path.is_file())
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Name and text of every chapter.
fn chapters() -> Vec<(String, String)> {
    let folder = core().join("docs/theory");
    let mut found: Vec<_> = fs::read_dir(&folder)
        .expect("the manual's folder")
        .map(|entry| entry.expect("a folder entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .map(|path| {
            let name = path.file_name().expect("a name").to_string_lossy();
            (name.into_owned(), read(&path))
        })
        .collect();
    found.sort();
    found
}

fn chapter(name: &str) -> String {
    read(&core().join("docs/theory").join(name))
}

/// What stands between backticks in `text`, blocks of code apart.
fn quoted(text: &str) -> Vec<&str> {
    let outside_blocks = text.split("```").step_by(2);
    outside_blocks.flat_map(|part| part.lines()).flat_map(|line| line.split('`').skip(1).step_by(2)).collect()
}

/// Rows of all tables of `text`, cell by cell.
fn table_rows(text: &str) -> Vec<Vec<&str>> {
    text.lines()
        .filter(|line| line.starts_with("| "))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect()
}

/// The equation number in a first cell; none for other words.
fn equation(cell: &str) -> Option<usize> {
    cell.parse().ok()
}

/// Numbers of the equations that comments of `source` cite at its lines, as (61), (6a) or Eq. 61. Its head cites nothing.
fn cited(source: &str) -> BTreeSet<usize> {
    let lines = source.lines().filter(|line| !line.trim_start().starts_with("//!"));
    let comments = lines.filter_map(|line| Some(line.split_once("//")?.1));
    let in_comment = |comment: &'_ str| -> Vec<usize> {
        let in_brackets = comment.split(" (").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
        let after_word =
            comment.split("Eq. ").skip(1).filter_map(|rest| rest.split(|c: char| !c.is_alphanumeric()).next());
        let numbers = in_brackets.chain(after_word).map(|n| n.trim_end_matches(|c: char| c.is_ascii_lowercase()));
        numbers.filter_map(equation).collect()
    };
    comments.flat_map(in_comment).collect()
}

/// True if a line of `source` declares `name`: an item, a field, a variant.
fn declares(source: &str, name: &str) -> bool {
    source.lines().any(|line| {
        let mut words = line.trim_start();
        if words.starts_with("//") {
            return false;
        }
        for prefix in ["pub(crate) ", "pub(super) ", "pub ", "const ", "static "] {
            words = words.strip_prefix(prefix).unwrap_or(words);
        }
        for keyword in ["fn ", "struct ", "enum ", "trait ", "type ", "mod "] {
            words = words.strip_prefix(keyword).unwrap_or(words);
        }
        let Some(rest) = words.strip_prefix(name) else {
            return false;
        };
        let end = rest.chars().next().unwrap_or(',');
        let ends_here = !end.is_alphanumeric() && end != '_' && end != '.';
        ends_here && !rest.starts_with("::")
    })
}

/// True if `name` is a Rust name or path such as `solve` or `State::hinge`.
fn is_rust_path(name: &str) -> bool {
    name.split("::").all(|part| {
        part.starts_with(|c: char| c.is_ascii_alphabetic())
            && part.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    })
}

#[test]
fn every_equation_of_the_report_has_its_line() {
    let index = chapter("equation-index.md");
    let mut times_named = [0; LAST_EQUATION + 1];
    for row in table_rows(&index) {
        // the figures have fewer columns
        if row.len() == 6
            && let Some(number) = equation(row[0])
        {
            assert!(number <= LAST_EQUATION, "the report has no Eq. {number}");
            times_named[number] += 1;
        }
    }
    for (number, times) in times_named.iter().enumerate().skip(1) {
        assert_eq!(*times, 1, "Eq. {number} stands in {times} lines of the index");
    }
}

#[test]
fn every_name_of_the_index_exists_in_its_file() {
    let index = chapter("equation-index.md");
    let mut checked = 0;
    for row in table_rows(&index) {
        if row.len() != 6 || ["Eq.", "No."].contains(&row[0]) || row[0].starts_with("---") {
            continue;
        }
        let files = quoted(row[5]);
        assert!(!files.is_empty(), "Eq. {} names no file", row[0]);
        let source: String =
            files.iter().map(|file| read(&source_file(file).unwrap_or_else(|| core().join(file)))).collect();
        let names = quoted(row[3]);
        assert!(!names.is_empty(), "Eq. {} names no Rust name", row[0]);
        for name in names {
            assert!(is_rust_path(name), "Eq. {}: `{name}` is no name", row[0]);
            for part in name.split("::") {
                assert!(declares(&source, part), "Eq. {}: `{name}` is not declared in {files:?}", row[0]);
                checked += 1;
            }
        }
    }
    // Measured: 405.
    assert!(checked > 100, "only {checked} names checked");
}

#[test]
fn every_equation_that_is_formed_stands_at_a_line_of_its_file() {
    let index = chapter("equation-index.md");
    let mut checked = 0;
    for row in table_rows(&index) {
        let Some(number) = equation(row[0]).filter(|_| row.len() == 6 && !row[1].contains("not formed")) else {
            continue;
        };
        let file = quoted(row[5])[0];
        let source = read(&core().join("src").join(file));
        assert!(cited(&source).contains(&number), "no line of `{file}` cites Eq. {number}, which is formed there");
        checked += 1;
    }
    // Measured: 100.
    assert!(checked >= 100, "only {checked} equations checked");
}

#[test]
fn every_source_file_that_the_manual_names_exists() {
    let mut checked = 0;
    for (name, text) in chapters() {
        for file in quoted(&text).into_iter().filter(|q| q.ends_with(".rs")) {
            assert!(source_file(file).is_some(), "{name} names `{file}`, which is not there");
            checked += 1;
        }
    }
    // Measured: 225.
    assert!(checked > 100, "only {checked} files checked");
}

#[test]
fn every_rust_path_that_the_manual_names_exists() {
    let mut source = String::new();
    source_folders().iter().for_each(|folder| append_sources(folder, &mut source));
    for (name, text) in chapters() {
        let paths = quoted(&text).into_iter().filter(|q| q.contains("::") && is_rust_path(q));
        for path in paths {
            for part in path.split("::") {
                assert!(declares(&source, part), "{name} names `{path}`, which is not declared anywhere");
            }
        }
    }
}

fn append_sources(folder: &Path, source: &mut String) {
    for entry in fs::read_dir(folder).expect("a source folder") {
        let path = entry.expect("a folder entry").path();
        if path.is_dir() {
            append_sources(&path, source);
        } else if path.extension().is_some_and(|e| e == "rs") {
            source.push_str(&read(&path));
        }
    }
}

#[test]
fn every_link_between_chapters_leads_somewhere() {
    let names: Vec<String> = chapters().into_iter().map(|(name, _)| name).collect();
    for (name, text) in chapters() {
        for part in text.split("](").skip(1) {
            let target = part.split(')').next().unwrap_or_default();
            let file = target.split('#').next().unwrap_or_default();
            assert!(names.iter().any(|n| n == file), "{name} links to {target}, which is not there");
        }
    }
    let contents = chapter("README.md");
    for name in names.iter().filter(|n| *n != "README.md") {
        assert!(contents.contains(&format!("]({name})")), "{name} is not in the table of contents");
    }
}

#[test]
fn the_guard_itself_can_fail() {
    let source = "pub struct State<S> {\n    /// A\n    pub hinge: [S; 4],\n}\n// fn gone() {}\nfn solve<S>() {}\n";
    assert!(declares(source, "State") && declares(source, "hinge") && declares(source, "solve"));
    assert!(!declares(source, "gone") && !declares(source, "hing") && !declares(source, "absent"));
    let lines = "//! (1)\n// β (61a), (71)\nlet x = f(2); // Eq. 99: 3 (4×4)\n";
    assert_eq!(cited(lines), BTreeSet::from([61, 71, 99]));
    assert_eq!((equation("7"), equation("27–38"), equation("III")), (Some(7), None, None));
}
