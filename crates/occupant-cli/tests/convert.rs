//! `occupant convert` as sentences.

use std::path::{Path, PathBuf};

use assert_cmd::Command;

fn decks() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/decks")
}

fn convert(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
        .current_dir(folder)
        .arg("convert")
        .args(arguments)
        .output()
        .expect("runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_deck_becomes_the_committed_scenario_and_comes_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = decks().join("driver-lap-torso.dat");
    let (code, out, said) =
        convert(folder.path(), &[deck.to_str().expect("UTF-8"), "-o", "case.toml", "--report", "case.txt"]);
    assert_eq!((code, out.as_str()), (0, ""), "{said}");
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect(name);
    let committed = std::fs::read_to_string(decks().join("driver-lap-torso.toml")).expect("committed");
    assert_eq!(read("case.toml"), committed);
    assert!(said.contains("Assumptions") && read("case.txt").contains("Assumptions"), "{said}");
    let (code, _, said) = convert(folder.path(), &["case.toml", "-o", "case.dat"]);
    assert_eq!(code, 0, "{said}");
    let (code, out, said) = convert(folder.path(), &["case.dat", "-q"]);
    assert_eq!(code, 0, "{said}");
    assert_eq!(out.replace("case.dat", "driver-lap-torso.dat"), committed, "deck, scenario, deck, scenario");
}

/// No card places the wheel: who knows better has it in `compartment.toml` beside his decks, and all that reads them takes it.
#[test]
fn a_deck_stands_in_the_compartment_beside_it() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["unbelted.dat", "compartment.toml"] {
        std::fs::copy(decks().join("report").join(name), folder.path().join(name)).expect(name);
    }
    let committed = std::fs::read_to_string(decks().join("report/unbelted.toml")).expect("committed");
    let (code, out, said) = convert(folder.path(), &["unbelted.dat"]);
    assert_eq!((code, &out), (0, &committed), "{said}");
    assert!(said.contains("its compartment comes from compartment.toml"), "{said}");
    let run = |words: &[&str]| {
        let output =
            Command::new(assert_cmd::cargo::cargo_bin!("occupant")).current_dir(folder.path()).args(words).output();
        let output = output.expect("runs");
        String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned()
    };
    let said = run(&["check", "unbelted.dat"]);
    assert!(said.contains("its compartment comes from compartment.toml"), "{said}");
    std::fs::write(folder.path().join("converted.toml"), out).expect("written");
    let peak = |name: &str| {
        let said = run(&["run", name, "--json", "--no-mcap", "-q"]);
        let json = &said[said.find('{').expect("JSON")..];
        let summary: serde_json::Value = serde_json::from_str(json).expect("JSON");
        summary["accelerations"]["head"]["peak_g"].as_f64().expect("a peak")
    };
    // measured: with the built-in wheel 90.4 g
    assert_eq!(peak("unbelted.dat"), peak("converted.toml"));
    // a file that is none is an error, not the built-in one
    std::fs::write(folder.path().join("compartment.toml"), "roof = 1").expect("written");
    let (code, _, said) = convert(folder.path(), &["unbelted.dat"]);
    assert!(code == 2 && said.contains("compartment.toml"), "{said}");
}

#[test]
fn nothing_is_overwritten_without_force() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = decks().join("right-front-lap.dat");
    let deck = deck.to_str().expect("UTF-8");
    assert_eq!(convert(folder.path(), &[deck, "-o", "a.toml"]).0, 0);
    let (code, _, said) = convert(folder.path(), &[deck, "-o", "a.toml"]);
    assert_eq!(code, 2);
    assert!(said.contains("a.toml exists") && said.contains("--force"), "{said}");
    assert_eq!(convert(folder.path(), &[deck, "-o", "a.toml", "--force"]).0, 0);
}

#[test]
fn a_wrong_deck_is_refused_with_all_its_problems() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(decks().join("driver-lap-torso.dat")).expect("a deck");
    let wrong = text.replacen("     .0001", "     .0O01", 1).replacen("      13.71", "     -13.71", 1);
    std::fs::write(folder.path().join("wrong.dat"), wrong).expect("written");
    let (code, out, said) = convert(folder.path(), &["wrong.dat", "-o", "wrong.toml"]);
    assert_eq!((code, out.as_str()), (2, ""));
    assert!(said.contains("wrong.dat:3, card 3, column 28, DT"), "{said}");
    assert!(said.contains("wrong.dat:8, card 5b no. 3, columns 11–20, XLE(3)"), "{said}");
    assert!(!folder.path().join("wrong.toml").exists());
}

#[test]
fn the_path_from_disk_is_asked_for_and_taken() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["driver-path-from-disk.dat", "driver-path-from-disk.csv"] {
        std::fs::copy(decks().join(name), folder.path().join(name)).expect("copied");
    }
    let (code, _, said) = convert(folder.path(), &["driver-path-from-disk.dat"]);
    assert_eq!(code, 2);
    assert!(said.contains("51 stations") && said.contains("--path"), "{said}");
    let arguments = ["driver-path-from-disk.dat", "--path", "driver-path-from-disk.csv", "-o", "case.toml"];
    assert_eq!(convert(folder.path(), &arguments).0, 0);
    let committed = std::fs::read_to_string(decks().join("driver-path-from-disk.toml")).expect("committed");
    assert_eq!(std::fs::read_to_string(folder.path().join("case.toml")).expect("written"), committed);
    let (code, out, said) =
        convert(folder.path(), &["driver-path-from-disk.dat", "--path", "driver-path-from-disk.csv"]);
    assert_eq!(code, 0, "{said}");
    assert!(out.contains("[0.005, 1.7544, 0, 0, 0, 0, 0]"), "written out where no folder is known");
}

#[test]
fn a_scenario_that_does_not_fit_says_why() {
    let folder = tempfile::tempdir().expect("a folder");
    let cart = decks().join("../../tests/data/carts/cart-lap-torso.toml");
    let (code, out, said) = convert(folder.path(), &[cart.to_str().expect("UTF-8")]);
    assert_eq!((code, out.as_str()), (2, ""));
    assert!(said.contains("does not fit on cards") && said.contains("path.kind"), "{said}");
}

#[test]
fn a_run_is_extended_by_cards() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = decks().join("driver-exact-state.dat");
    let deck = deck.to_str().expect("UTF-8");
    let (code, _, said) = convert(folder.path(), &[deck, "--extend", "0.25", "-o", "next.dat"]);
    assert_eq!(code, 0, "{said}");
    let (code, out, said) = convert(folder.path(), &["next.dat"]);
    assert_eq!(code, 0, "{said}");
    assert!(
        out.contains("start = \"0.2 s\"") && out.contains("end = \"0.25 s\"") && out.contains("passed = ["),
        "{out}"
    );
    assert_eq!(convert(folder.path(), &[deck, "--extend", "0.1"]).0, 2);
    let (code, out, said) = convert(folder.path(), &[deck, "--extend", "0.3"]);
    assert_eq!((code, out.as_str()), (2, ""), "no deck without a path to its end");
    assert!(said.contains("--extend 0.3 s is after the last station of the vehicle's path, 0.25 s"), "{said}");
}

#[test]
fn a_path_file_that_the_deck_does_not_ask_for_is_said_to_be_unused() {
    let folder = tempfile::tempdir().expect("a folder");
    let name = |file: &str| decks().join(file).to_str().expect("UTF-8").to_owned();
    let arguments = [&name("driver-lap-torso.dat"), "--path", &name("driver-path-from-disk.csv"), "-o", "case.toml"];
    let (code, _, said) = convert(folder.path(), &arguments);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("  - the path file: MREAD = 0 (card 3)"), "{said}");
}

#[test]
fn a_deck_goes_to_standard_output_in_the_bytes_of_a_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(decks().join("driver-lap-torso.toml")).expect("committed");
    let text = text.replacen("title = \"DRIVER", "title = \"FÄHRER —", 1);
    std::fs::write(folder.path().join("case.toml"), text).expect("written");
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    let output = command.current_dir(folder.path()).args(["convert", "case.toml"]).output().expect("runs");
    assert_eq!(output.stdout[..9], *b"F\xc4HRER ? ", "Latin-1");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("the title's `—` cannot be punched and became ?"), "{said}");
}

#[test]
fn several_decks_become_numbered_scenarios() {
    let folder = tempfile::tempdir().expect("a folder");
    let read = |name: &str| std::fs::read_to_string(decks().join(name)).expect("a deck");
    let both = read("driver-lap-torso.dat").replace("FINI\n", "") + &read("left-rear-unbelted.dat");
    std::fs::write(folder.path().join("both.dat"), both).expect("written");
    assert_eq!(convert(folder.path(), &["both.dat"]).0, 2);
    assert_eq!(convert(folder.path(), &["both.dat", "-o", "case.toml"]).0, 0);
    assert!(folder.path().join("case-1.toml").exists() && folder.path().join("case-2.toml").exists());
}

#[test]
fn a_recorded_run_is_extended_by_the_same_cards_as_the_deck() {
    let folder = tempfile::tempdir().expect("a folder");
    let name = |file: &str| decks().join(file).to_str().expect("UTF-8").to_owned();
    let run = Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
        .current_dir(folder.path())
        .args(["run", &name("driver-exact-state.toml"), "-q", "-o", "run.mcap"])
        .output()
        .expect("runs");
    assert_eq!(run.status.code(), Some(0));
    let deck = name("driver-exact-state.dat");
    let (code, by_deck, said) = convert(folder.path(), &[&deck, "--extend", "0.25"]);
    assert_eq!(code, 0, "{said}");
    let (code, by_run, said) = convert(folder.path(), &["run.mcap", "--extend", "0.25"]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("approximate"), "{said}");
    assert_eq!(by_run, by_deck);
    for (words, expected) in [
        (&["run.mcap"][..], "--extend TIME"),
        (&["run.mcap", "--extend", "0.1"], "not after the end"),
        (&["run.mcap", "--extend", "0.3"], "after the last station"),
    ] {
        let (code, _, said) = convert(folder.path(), words);
        assert!(code == 2 && said.contains(expected), "{said}");
    }
}

fn occupant(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(assert_cmd::cargo::cargo_bin!("occupant")).current_dir(folder).args(arguments).output();
    let output = output.expect("runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_deck_is_run_as_a_scenario_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = std::fs::read(decks().join("driver-lap-torso.dat")).expect("a deck");
    std::fs::write(folder.path().join("d.dat"), &deck).expect("written");
    let (code, by_deck, said) = occupant(folder.path(), &["run", "d.dat"]);
    assert_eq!(code, 0, "{said}");
    for words in ["card deck, converted in memory", "Assumptions:", "XV(14), ZV(14)", "wrote d-plot.svg"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert!(folder.path().join("d-plot.svg").exists(), "the card STAN asks for plots");
    let scenario = decks().join("driver-lap-torso.toml");
    let scenario = scenario.to_str().expect("UTF-8");
    let (code, by_scenario, said) = occupant(folder.path(), &["run", scenario, "--no-mcap"]);
    assert_eq!(code, 0, "{said}");
    let figures =
        |text: &str| text.lines().take_while(|l| !l.starts_with("integration")).collect::<Vec<_>>().join("\n");
    assert_eq!(figures(&by_deck), figures(&by_scenario));
    // again, without a word of what is there; NONE draws nothing; records without line ends are as good
    let (code, out, said) = occupant(folder.path(), &["run", "d.dat", "-q"]);
    assert_eq!((code, out.as_str()), (0, ""), "{said}");
    let records: String =
        String::from_utf8(deck).expect("ASCII").lines().map(|l| format!("{:80}", l.replace("STAN", "NONE"))).collect();
    std::fs::write(folder.path().join("none.dat"), records).expect("written");
    let (code, out, said) = occupant(folder.path(), &["run", "none.dat"]);
    assert_eq!((code, figures(&out)), (0, figures(&by_deck)), "{said}");
    assert!(said.contains("cut into 119 cards") && !folder.path().join("none-plot.svg").exists(), "{said}");
    for words in [&["check", "d.dat"][..], &["view", "d.dat", "-o", "v.svg"], &["channels", "--of", "d.dat"]] {
        let (code, _, said) = occupant(folder.path(), words);
        assert_eq!(code, 0, "{words:?}: {said}");
    }
}

#[test]
fn decks_that_cannot_be_run_say_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let text = std::fs::read_to_string(decks().join("driver-lap-torso.dat")).expect("a deck");
    let (one, _) = text.split_once("FINI").expect("an end");
    std::fs::write(folder.path().join("two.dat"), format!("{one}{text}")).expect("written");
    std::fs::write(folder.path().join("wrong.dat"), text.replace("      352.", "      35?.")).expect("written");
    let disk = decks().join("driver-path-from-disk.dat");
    for (file, expected) in [
        ("two.dat", "contains 2 decks"),
        ("wrong.dat", "error[not-a-number]"),
        (disk.to_str().expect("UTF-8"), "`occupant convert` has options for such a deck"),
    ] {
        let (code, _, said) = occupant(folder.path(), &["run", file]);
        assert!(code == 2 && said.contains(expected), "{file}: {said}");
    }
}

#[test]
fn an_extension_by_cards_says_how_far_it_is_off() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = decks().join("driver-exact-state.dat");
    let deck = deck.to_str().expect("UTF-8");
    let (code, _, by_deck) = convert(folder.path(), &[deck, "--extend", "0.25", "-o", "next.dat"]);
    assert_eq!(code, 0, "{by_deck}");
    let (code, _, said) = occupant(folder.path(), &["run", &deck.replace(".dat", ".toml"), "-q", "-o", "run.mcap"]);
    assert_eq!(code, 0, "{said}");
    let (code, _, by_run) = convert(folder.path(), &["run.mcap", "--extend", "0.25", "-o", "same.dat"]);
    assert_eq!(code, 0, "{by_run}");
    for said in [&by_deck, &by_run] {
        let (_, figures) =
            said.split_once("From 0.200 s to 0.250 s, compared with the continued run: ").expect("figures");
        let off =
            figures.split_once("the head is up to ").and_then(|(_, rest)| rest.split_once(" mm off")).expect("mm");
        let off_mm: f64 = off.0.parse().expect("a number");
        // both begin where the run ended, and part from there on
        assert!((0.0..500.0).contains(&off_mm), "{off_mm}");
        assert!(
            figures.contains("belt lap ") && figures.contains("head ") && figures.contains(" g instead of "),
            "{figures}"
        );
    }
}
