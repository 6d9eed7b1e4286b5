//! Every command ends alike: 0 done, 1 it ran and broke off, 2 it could not run, 75 another process is at the same work.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::{answer, code, err, folder_with_case, out};

/// What each command can do in the folder, in an order in which one has what another has made, and what it cannot.
const COMMANDS: [[&str; 2]; 26] = [
    ["run case.toml -f -o run.mcap --set time.end=0.02", "run none.toml"],
    [
        "export run.mcap -f -o test.csv --channels lower_torso.acceleration.x",
        "export run.mcap -o e.csv --channels none",
    ],
    ["sweep study.toml -o sweep", "sweep none.toml"],
    ["study report sweep -f", "study report none"],
    ["fit study.toml --test test.csv -o fit", "fit study.toml --test none.csv -o none"],
    ["optimise study.toml -o optimum", "optimise none.toml"],
    ["import test.csv -f -o import.toml", "import none.csv"],
    ["check case.toml", "check none.toml"],
    ["drive driven.toml -f -o drive.csv", "drive case.toml"],
    ["new new.toml -f", "new none/new.toml"],
    ["explain path", "explain nowhere"],
    ["schema", "schema --of none"],
    ["channels head", "channels head --of none.mcap"],
    ["convert deck.dat -f -o deck.toml", "convert none.dat"],
    ["print run.mcap", "print none.mcap"],
    ["plot run.mcap -f", "plot run.mcap -o plot.none"],
    ["compare run.mcap test.csv", "compare run.mcap none.csv"],
    ["measures run.mcap", "measures run.mcap --dummy none"],
    ["view run.mcap -f", "view none.mcap"],
    ["report run.mcap -f", "report none.mcap"],
    ["seal run.mcap -f", "seal none.mcap"],
    ["risk case.toml", "risk none.csv"],
    [
        "sensitivity case.toml --to head.peak --of belts.lap.k1 --set time.end=0.005",
        "sensitivity case.toml --to none --of none",
    ],
    ["surface drop.csv --mass 6.8 --speed 6 --angle 30 -f -o bolster.toml", "surface none.csv --mass 6.8 --speed 6"],
    ["completions bash", "completions none"],
    ["man pages -f", "man case.toml"],
];

const STUDY: &str = "base = \"case.toml\"\nseed = 1\n[set]\n\"time.end\" = \"10 ms\"\n\
    [design]\nkind = \"latin_hypercube\"\nsamples = 3\n\
    [[parameters]]\npath = \"belts.lap.k1\"\nrange = { from = \"50 kN/m\", to = \"90 kN/m\" }\n\
    [fit]\nobjective = \"rms\"\nbudget = 8\n\
    [optimise]\nminimise = \"head.peak\"\nallow_caveats = [\"*\"]\nbudget = 8\n";

const DECK: &str = include_str!("../../../../scenarios/decks/driver-lap-torso.dat");

fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

#[test]
fn the_table_has_every_command() {
    let folder = folder_with_case();
    let help = out(&answer(folder.path(), &["--help"]));
    let section =
        help.split_once("\n\n").and_then(|(_, rest)| rest.split("Options:").next()).expect("a list of commands");
    let listed = section.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let mut listed: Vec<&str> =
        listed.filter_map(|line| line.split_whitespace().next()).filter(|name| *name != "help").collect();
    let mut known: Vec<&str> = COMMANDS.iter().map(|[good, _]| words(good)[0]).collect();
    listed.sort_unstable();
    known.sort_unstable();
    assert_eq!(listed, known);
}

/// The same with no room for a byte, on standard output or in a file.
#[cfg(target_os = "linux")]
fn without_room(folder: &Path, line: &str) -> Output {
    let program = assert_cmd::cargo::cargo_bin!("occupant").display();
    let script = format!("trap '' XFSZ; ulimit -f 0; exec {program} {line} > /dev/full");
    Command::new("sh").args(["-c", &script]).current_dir(folder).output().expect("a shell")
}

/// Files that have their final names.
fn files(folder: &Path, found: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.display().to_string();
        if path.is_dir() {
            files(&path, found);
        } else if !name.contains(".partial") && !name.ends_with(".lock") {
            found.insert(name, fs::read(&path).expect("a file"));
        }
    }
}

#[test]
#[cfg(target_os = "linux")]
fn every_command_ends_with_0_when_done_1_when_it_broke_off_and_2_when_it_could_not_run() {
    let folder = folder_with_case();
    fs::write(folder.path().join("study.toml"), STUDY).expect("a study");
    fs::write(folder.path().join("driven.toml"), include_str!("../../../../scenarios/templates/drive.toml"))
        .expect("a scenario");
    fs::write(folder.path().join("deck.dat"), DECK).expect("a deck");
    fs::write(folder.path().join("drop.csv"), include_str!("../../../../scenarios/surfaces/made-up-bolster.csv"))
        .expect("a record");
    for [good, bad] in COMMANDS {
        let output = answer(folder.path(), &words(good));
        assert_eq!(code(&output), 0, "{good}: {}", err(&output));
        let (mut before, mut after) = (BTreeMap::new(), BTreeMap::new());
        files(folder.path(), &mut before);
        let output = without_room(folder.path(), good);
        assert_eq!(code(&output), 1, "{good}: {}", err(&output));
        assert!(err(&output).contains("error: "), "{good}: {}", err(&output));
        let output = answer(folder.path(), &words(bad));
        assert_eq!((code(&output), out(&output)), (2, String::new()), "{bad}: {}", err(&output));
        assert!(err(&output).contains("error: "), "{bad}: {}", err(&output));
        files(folder.path(), &mut after);
        assert!(before == after, "{good}: a file was changed or left half written");
    }
}

#[test]
fn a_command_that_another_process_is_at_ends_with_75_and_does_its_work_later_or_waits() {
    let folder = folder_with_case();
    fs::write(folder.path().join("study.toml"), STUDY).expect("a study");
    let made = "run case.toml -f -o run.mcap --set time.end=0.02";
    for line in [made, "export run.mcap -f -o test.csv --channels lower_torso.acceleration.x"] {
        assert_eq!(code(&answer(folder.path(), &words(line))), 0, "{line}");
    }
    for (line, lock) in [
        ("sweep study.toml -o sweep", "sweep/work.lock"),
        ("sweep study.toml -o sweep --range 0..2", "sweep/work.lock"),
        ("sweep study.toml -o sweep --shard 2/3", "sweep/journal/000000001-000000001.lock"),
        ("sweep merge sweep", "sweep/table.lock"),
        ("fit study.toml --test test.csv -o fit", "fit/work.lock"),
        ("optimise study.toml -o optimum", "optimum/work.lock"),
    ] {
        let path = folder.path().join(lock);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        let held = fs::File::create(&path).expect("a lock");
        held.lock().expect("locks");
        let output = answer(folder.path(), &words(line));
        assert_eq!((code(&output), out(&output)), (75, String::new()), "{line}: {}", err(&output));
        assert!(err(&output).contains("error: another process is working in"), "{line}: {}", err(&output));
        let waits = [&words(line)[..], &["--wait"]].concat();
        let mut waiting = crate::common::occupant(folder.path())
            .args(waits)
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("a process");
        sleep(Duration::from_millis(700));
        assert!(waiting.try_wait().expect("a state").is_none(), "{line} does not wait");
        drop(held);
        let output = waiting.wait_with_output().expect("an end");
        assert_eq!(code(&output), 0, "{line}: {}", err(&output));
        assert!(err(&output).contains("waiting: another process is working in"), "{line}: {}", err(&output));
    }
}
