//! `occupant run --ensemble`, and the ensembles of studies.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

fn scenario(name: &str) -> PathBuf {
    // the carts with numbers of their own, which tests keep
    let folder = if name.starts_with("cart-") { "../../tests/data/carts" } else { "../../scenarios" };
    Path::new(env!("CARGO_MANIFEST_DIR")).join(folder).join(name)
}

fn answer(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    command.current_dir(folder).args(words);
    command.output().expect("the command starts")
}

/// Runs a scenario's ensemble and gives its JSON.
fn ensemble(folder: &Path, name: &str, words: &[&str]) -> Value {
    let file = scenario(name);
    let mut all = vec!["run", file.to_str().expect("UTF-8"), "--no-mcap", "--json", "--ensemble"];
    all.extend(words);
    let output = answer(folder, &all);
    let code = output.status.code();
    assert_eq!(code, Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// By name.
fn named(list: &Value) -> BTreeMap<&str, &Value> {
    let list = list.as_array().expect("a list").iter();
    list.map(|v| (v["name"].as_str().expect("a name"), v)).collect()
}

#[test]
fn a_free_flight_is_stable_in_everything() {
    let folder = tempfile::tempdir().unwrap();
    let answer = ensemble(folder.path(), "free-fall.toml", &["12"]);
    let e = &answer["ensemble"];
    assert_eq!((&e["members"], &e["completed"]), (&12.into(), &12.into()));
    let figures = named(&e["figures"]);
    assert!(figures.len() > 30, "{}", figures.len());
    for (name, figure) in figures {
        assert_eq!(figure["verdict"], "stable", "{name}: {figure}");
    }
    for (name, channel) in named(&e["channels"]) {
        assert_eq!(channel["lost_at_s"], Value::Null, "{name}: {channel}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = |threads: &str| {
        let table = format!("bands{threads}.csv");
        let words = ["10", "--seed", "3", "--threads", threads, "--bands", &table, "--until", "60 ms"];
        let answer = ensemble(folder.path(), "cart-lap.toml", &words);
        let mut e = answer["ensemble"].clone();
        e["files"] = Value::Null;
        (e.to_string(), fs::read(folder.path().join(table)).unwrap())
    };
    let one = bytes("1");
    assert!(one.1.len() > 10_000);
    assert!(one == bytes("2"));
    assert!(one == bytes("5"));
}

#[test]
fn without_changes_all_members_are_the_run_itself() {
    let folder = tempfile::tempdir().unwrap();
    let none = ["posture=0 deg", "place=0 mm", "path=0 %", "stiffness=0 %"];
    let mut words = vec!["10", "--until", "60 ms"];
    for change in none {
        words.extend(["--change", change]);
    }
    let answer = ensemble(folder.path(), "cart-lap.toml", &words);
    for (name, f) in named(&answer["ensemble"]["figures"]) {
        assert_eq!(f["verdict"], "stable", "{name}");
        for part in ["least", "median", "greatest"] {
            assert_eq!(f[part], f["nominal"], "{name}");
        }
    }
    let head = &named(&answer["ensemble"]["figures"])["head.peak"]["nominal"];
    assert_eq!(head, &answer["accelerations"]["head"]["peak_m_s2"]);
}

#[test]
fn what_can_not_be_is_refused_before_anything_is_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("there.csv"), "mine").unwrap();
    let file = scenario("cart-lap.toml");
    let file = file.to_str().unwrap();
    let cases: [(&[&str], &str); 12] = [
        (&["--ensemble", "1"], "2.."),
        (&["--ensemble", "many"], "invalid value"),
        (&["--seed", "3"], "--ensemble"),
        (&["--ensemble", "10", "--threads", "0"], "invalid value"),
        (&["--ensemble", "10", "--change", "posture"], "it has no `=`"),
        (&["--ensemble", "10", "--change", "posture=2 mm"], "expected"),
        (&["--ensemble", "10", "--change", "belts=2 mm"], "unknown name `belts`"),
        (&["--ensemble", "10", "--change", "path=-1 %"], "out of range"),
        (&["--ensemble", "10", "--stable-within", "0"], "not above 0"),
        (&["--ensemble", "10", "--channels", "head.aceleration.x"], "head.acceleration.x"),
        (&["--ensemble", "10", "--bands", "bands.pdf"], "NAME.csv"),
        (&["--ensemble", "10", "--bands", "there.csv"], "--force"),
    ];
    for (words, expected) in cases {
        let mut all = vec!["run", file];
        all.extend(words);
        let output = answer(folder.path(), &all);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words:?}: {said}");
        assert!(said.contains(expected), "{words:?}: {said}");
    }
    let much = ["run", file, "--ensemble", "100000", "--channels", "*"];
    let output = answer(folder.path(), &much);
    assert!(String::from_utf8_lossy(&output.stderr).contains("GiB"));
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().flatten().collect();
    assert_eq!(left.len(), 1, "{left:?}");
    assert_eq!(fs::read(folder.path().join("there.csv")).unwrap(), b"mine");
}

/// A study of the cart case, 60 ms, twelve members a sample.
fn study(folder: &Path, parameters: &str) {
    fs::copy(scenario("cart-lap.toml"), folder.join("cart.toml")).unwrap();
    let text = format!(
        "base = \"cart.toml\"\nseed = 3\nset = {{ \"time.end\" = \"60 ms\" }}\n\n[ensemble]\nmembers = 12\n{parameters}"
    );
    fs::write(folder.join("study.toml"), text).unwrap();
}

/// The rows of a CSV without quotes, by column.
fn rows(path: &Path) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(|l| l.split(',').map(str::to_owned).collect::<Vec<_>>());
    let head = lines.next().unwrap();
    lines.map(|l| head.iter().cloned().zip(l).collect()).collect()
}

#[test]
fn a_study_and_a_run_say_the_same_of_the_same_ensemble() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    study(path, "");
    let output = answer(path, &["sweep", "study.toml", "-o", "out", "--csv", "--threads", "2"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("ensemble.parquet") && said.contains("head.peak"), "{said}");
    let run = ensemble(path, "cart-lap.toml", &["12", "--seed", "3", "--until", "60 ms"]);
    let figures = named(&run["ensemble"]["figures"]);
    let table = rows(&path.join("out/ensemble.csv"));
    assert_eq!(table.len(), figures.len());
    for row in &table {
        let figure = figures[row["figure"].as_str()];
        assert_eq!((row["sample"].as_str(), row["failed"].as_str()), ("0", "0"));
        assert_eq!(row["verdict"], figure["verdict"].as_str().unwrap());
        for part in ["nominal", "q05", "median", "q95", "tolerance"] {
            // the reader of JSON rounds the last bit its own way
            let (a, b) = (row[part].parse::<f64>().ok(), figure[part].as_f64());
            let same =
                a.zip(b).map_or(a.is_none() && b.is_none(), |(a, b)| (a - b).abs() <= 4.0 * f64::EPSILON * a.abs());
            assert!(same, "{} {part}: {a:?} {b:?}", row["figure"]);
        }
    }
}

#[test]
fn every_sample_of_a_study_has_its_own_verdicts_and_failures() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    // the surfaces of the second sample are too stiff for the step
    let varied = "path = \"materials.*.k1\"\napply = \"factor\"\nlist = [1, 1e9, 1.1]\n";
    let design = "[design]\nkind = \"full_factorial\"\n\n[[parameters]]\n";
    study(path, &format!("\n{design}{varied}"));
    let output = answer(path, &["sweep", "study.toml", "-o", "out", "--csv"]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    let table = rows(&path.join("out/ensemble.csv"));
    let failed = |sample: &str| {
        let mut of = table.iter().filter(|r| r["sample"] == sample);
        of.next().map(|r| r["failed"].clone())
    };
    assert_eq!(failed("0").as_deref(), Some("0"));
    // all members failed: there is no figure to judge
    assert_eq!(failed("1"), None);
    assert_eq!(failed("2").as_deref(), Some("0"));
    assert!(said.contains("12 runs did not complete"), "{said}");
    // once more from the finished folder: the same bytes
    let bytes = fs::read(path.join("out/ensemble.csv")).unwrap();
    let merged = answer(path, &["sweep", "merge", "out", "--csv"]);
    assert_eq!(merged.status.code(), Some(0));
    assert_eq!(fs::read(path.join("out/ensemble.csv")).unwrap(), bytes);
}

#[test]
fn members_part_when_chest_and_head_strike_the_wheel() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let files = ["--bands", "b.parquet", "--bands", "b.svg", "--bands", "b.png"];
    let words = [&["32", "--seed", "1"], &files[..]].concat();
    let answer = ensemble(path, "cart-lap.toml", &words);
    let verdict = |figure: &str| named(&answer["ensemble"]["figures"])[figure]["verdict"].clone();
    assert_eq!(verdict("hic15"), "not_stable"); // measured: 1863 to 2649
    assert_eq!(verdict("contacts.chest.peak"), "not_stable"); // 2880 to 4834 N
    assert_eq!(verdict("head_excursion.forward"), "stable"); // 718 to 732 mm
    let channels = named(&answer["ensemble"]["channels"]);
    let lost = |name: &str| channels[name]["lost_at_s"].as_f64();
    // the chest arrives after 90 ms, the head after 102 ms; measured: 98, 99, 107 ms
    for (name, from, to) in [
        ("belt.lap.force", 0.0905, 0.105),
        ("sphere.chest.force.resultant", 0.0905, 0.105),
        ("sphere.head.force.resultant", 0.102, 0.112),
    ] {
        let lost = lost(name).unwrap_or(f64::NAN);
        assert!(lost > from && lost < to, "{name}: {lost}");
    }
    // the changes place the head some millimetres to the side: that is no growth
    assert_ne!(lost("sphere.head.position.y"), Some(0.0));
    let bytes = |name: &str| fs::read(path.join(name)).unwrap();
    assert_eq!(&bytes("b.parquet")[..4], b"PAR1");
    assert_eq!(&bytes("b.png")[1..4], b"PNG");
    let svg = String::from_utf8(bytes("b.svg")).unwrap();
    assert!(svg.contains(">belt.lap.force</text>") && svg.contains("90 % of the runs"));
    assert!(!svg.contains("NaN"));
}

#[test]
fn the_table_marks_what_is_not_stable() {
    let folder = tempfile::tempdir().unwrap();
    let file = scenario("cart-lap.toml");
    let words = ["run", file.to_str().unwrap(), "--no-mcap", "--ensemble"];
    let table = |members: &str| {
        let output = answer(folder.path(), &[&words[..], &[members, "--seed", "1"]].concat());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = table("16");
    let hic = text.lines().find(|l| l.starts_with("HIC15")).unwrap();
    // of readings every 0.1 ms; outputs every 1 ms made 2485.0 of it
    assert!(hic.contains("2508.9 *"), "{text}");
    // figures that are not to be quoted either carry both marks: the forearms went through the cushion
    let hand = text.lines().find(|l| l.starts_with("left_hand")).unwrap();
    assert!(hand.contains("408!*"), "{text}");
    let excursion = text.lines().find(|l| l.starts_with("head excursion")).unwrap();
    assert!(excursion.contains("forward 28.6 in at"), "{text}");
    assert!(text.contains("* NOT STABLE under small changes"), "{text}");
    // nine have no verdict, and nothing carries a star
    let few = table("9");
    assert!(few.contains("too few members") && !few.contains('*'), "{few}");
}

#[test]
fn an_ensemble_can_be_quoted() {
    let folder = tempfile::tempdir().unwrap();
    let words = ["20", "--until", "30 ms", "--vary", "friction", "--limit", "head.peak=1 g"];
    let answer_of =
        |threads: &str| ensemble(folder.path(), "cart-lap.toml", &[&words[..], &["--threads", threads]].concat());
    let answer = answer_of("1");
    let e = &answer["ensemble"];
    assert_eq!(e["quotes"], answer_of("3")["ensemble"]["quotes"]);
    let quotes = e["quotes"].as_array().unwrap();
    let head = quotes.iter().find(|q| q["figure"] == "head.peak").unwrap();
    // the unchanged run is not counted
    assert_eq!((&head["runs"], &head["limits"][0]["of"]), (&19.into(), &19.into()));
    assert_eq!(&head["unchanged"], &named(&e["figures"])["head.peak"]["nominal"]);
    let paragraph = head["paragraph"].as_str().unwrap();
    for words in [
        "19 runs with random changes (seed 0)",
        "1 % of the pulse",
        "friction (",
        "a factor [ready distribution; guess]",
    ] {
        assert!(paragraph.contains(words), "{words}: {paragraph}");
    }
}

/// A name that no result has is told, with the one meant, before any member is run: a hundred thousand would take hours.
#[test]
fn what_cannot_be_quoted_is_refused_before_the_members_are_run() {
    let folder = tempfile::tempdir().unwrap();
    let file = scenario("cart-lap.toml");
    let run = ["run", file.to_str().unwrap(), "--no-mcap", "--until", "5 ms", "--ensemble", "100000"];
    for (words, found, help) in [
        (["--quote", "hic51"], "--quote hic51: there is no such result", "did you mean `hic15`?"),
        (["--limit", "hic51=700"], "--limit hic51: there is no such result", "did you mean `hic15`?"),
        (["--limit", "head.peak=80"], "`80` has no unit", "write the unit after the number"),
    ] {
        let output = answer(folder.path(), &[&run[..], &words].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains(found) && said.contains(help), "{words:?}: {said}");
    }
}
