//! Every command that a page shows runs, in the order of its page; what is named between the lines exists.
#![cfg(unix)]

use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::common::{CASE, answer, done, err};
use crate::records;

/// Pages whose commands need what is not part of the repository, and why.
const LEFT_OUT: [(&str, &str); 1] = [("docs/validation.md", "curves of tests of people, which others publish")];
/// Commands in all pages; fewer means that some are no longer found.
const AT_LEAST: usize = 40;

const STUDY: &str = "base = \"case.toml\"\ndesign = { kind = \"latin_hypercube\", samples = 12 }\n\
    set = { \"time.end\" = \"60 ms\" }\nfit = { budget = 30, channels = [{ channel = \"head.acceleration.x\" }] }\n\
    [[parameters]]\nname = \"damping\"\npath = \"joints.neck.damping\"\n\
    range = { from = \"5 in lbf s/rad\", to = \"80 in lbf s/rad\", scale = \"log\" }\n";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().expect("the repository")
}

/// All pages below a folder, without those of builds, packages and fuzzing.
fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        let is_ours = !name.starts_with('.') && !["target", "node_modules", "fuzz"].contains(&name.as_str());
        if path.is_dir() && !path.is_symlink() && is_ours {
            pages(&path, found);
        } else if name.ends_with(".md") {
            found.push(path);
        }
    }
}

/// The commands of a page's blocks, without the words beside them.
fn commands(page: &str) -> Vec<&str> {
    let blocks = page.split("```").skip(1).step_by(2);
    let lines = blocks.flat_map(str::lines).filter(|line| line.starts_with("occupant "));
    lines.map(|line| line.split("  ").next().unwrap_or(line).trim_end()).collect()
}

/// Commands named in the text, up to what stands for something else.
fn named(page: &str) -> impl Iterator<Item = &str> {
    let text = page.split("```").step_by(2);
    text.flat_map(|text| text.split('`').skip(1).step_by(2)).filter(|code| code.starts_with("occupant "))
}

/// Runs the commands of a page as a shell does, and says how many there are.
pub(crate) fn run_page(folder: &Path, page: &str) -> usize {
    let program = assert_cmd::cargo::cargo_bin!("occupant");
    let path = std::env::var("PATH").expect("a path");
    let path = format!("{}:{path}", program.parent().expect("a folder").display());
    let commands = commands(page);
    for line in &commands {
        let output =
            without_shards(Command::new("sh").args(["-c", line])).current_dir(folder).env("PATH", &path).output();
        let output = output.expect("a shell");
        assert_eq!(output.status.code(), Some(0), "{line}\n{}", err(&output));
    }
    commands.len()
}

/// Without what the surroundings say of shards.
fn without_shards(command: &mut Command) -> &mut Command {
    command.env_remove("OCCUPANT_SHARD").env_remove("SLURM_ARRAY_TASK_ID")
}

/// A folder with what pages speak of: scenarios, runs, tests, a study, a deck.
fn folder() -> tempfile::TempDir {
    let folder = records::files();
    let here = folder.path();
    let scenarios = root().join("scenarios");
    symlink(&scenarios, here.join("scenarios")).expect("a link");
    for name in ["cart-lap.toml", "cart-lap-torso.toml"] {
        fs::copy(scenarios.join(name), here.join(name)).expect("a scenario");
    }
    for name in ["case.toml", "a.toml", "b.toml", "scenario.toml"] {
        fs::write(here.join(name), CASE).expect("a scenario");
    }
    fs::write(here.join("study.toml"), STUDY).expect("a study");
    let pulse = |i: u32| if i < 200 { -10.0 * (std::f64::consts::PI * f64::from(i) / 200.0).sin() } else { 0.0 };
    let rows: String = (0..1000).map(|i| format!("{:.4},{:.5},0\n", f64::from(i) * 5e-4, pulse(i))).collect();
    fs::write(here.join("accelerations.csv"), format!("t[s],ax[g],ay[g]\n{rows}")).expect("a table");
    let decks = fs::read_dir(scenarios.join("decks")).expect("decks").flatten().map(|deck| deck.path());
    let deck = decks.filter(|path| path.extension().is_some_and(|e| e == "dat")).min().expect("a deck");
    fs::copy(deck, here.join("deck.dat")).expect("a deck");
    for name in ["run.mcap", "other.mcap"] {
        done(here, &["run", "case.toml", "-q", "--set", "time.end=110 ms", "-o", name]);
    }
    done(here, &["export", "run.mcap", "--channels", "head.acceleration.*", "-o", "test.csv"]);
    fs::rename(here.join("v00001"), here.join("v10146")).expect("a test");
    folder
}

#[test]
fn every_command_of_every_page_runs() {
    let mut found = Vec::new();
    pages(&root(), &mut found);
    assert!(found.len() > 30, "{found:?}");
    let mut count = 0;
    for path in &found {
        let page = fs::read_to_string(path).expect("a page");
        let name = path.strip_prefix(root()).expect("below").display().to_string();
        // that page's own test runs them
        if commands(&page).is_empty() || name.ends_with("records.md") || LEFT_OUT.iter().any(|(page, _)| *page == name)
        {
            continue;
        }
        count += run_page(folder().path(), &page);
    }
    assert!(count >= AT_LEAST, "{count} commands");
}

#[test]
fn every_command_that_a_page_names_exists() {
    let mut found = Vec::new();
    pages(&root(), &mut found);
    let here = tempfile::tempdir().expect("a folder");
    let mut wrong = Vec::new();
    let mut seen = BTreeSet::new();
    for path in &found {
        let page = fs::read_to_string(path).expect("a page");
        for code in named(&page).chain(commands(&page)) {
            let words: Vec<&str> = code.split_whitespace().skip(1).collect();
            let depth = if matches!(words[..], ["study", _, ..] | ["sweep", "merge" | "status", ..]) { 2 } else { 1 };
            let command: Vec<&str> = words.iter().take(depth).copied().chain(["--help"]).collect();
            if command[0].starts_with('-') || !command[0].chars().all(char::is_lowercase) {
                continue;
            }
            let output = answer(here.path(), &command);
            let help = String::from_utf8_lossy(&output.stdout).into_owned();
            let flags = words.iter().filter_map(|word| word.strip_prefix("--")).map(|word| {
                word.split(|c: char| !c.is_ascii_lowercase() && c != '-' && !c.is_ascii_digit()).next().unwrap_or(word)
            });
            let unknown: Vec<&str> = flags.filter(|flag| !help.contains(&format!("--{flag}"))).collect();
            if output.status.code() != Some(0) || !unknown.is_empty() {
                wrong.push(format!("{}: `{code}` {unknown:?}", path.display()));
            }
            seen.insert(command.join(" "));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(seen.len() > 20, "{seen:?}");
}
