//! The rating of a study: the same numbers as by hand, from one process, from parts, again and again.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{answer, done, err, files, folder_with};

/// Two short runs of one occupant each.
const STUDY: &str = r#"
base = "case.toml"
keep = "all"
design.kind = "full_factorial"

[set]
"time.end" = "30 ms"

[[parameters]]
name = "speed"
path = "path.speed"
list = ["20 mph", "25 mph"]

[rating]
name = "un-r137"
places = ["front passenger", "driver"]
"#;

const SWEEP: [&str; 4] = ["sweep", "study.toml", "-o", "out"];

fn read(at: &Path, name: &str) -> Vec<u8> {
    fs::read(at.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The filled template and the answer of a folder, as bytes.
fn rating(at: &Path, out: &str) -> [Vec<u8>; 2] {
    ["rating.xlsx", "rating.json"].map(|name| read(&at.join(out), name))
}

fn json(at: &Path, name: &str) -> Value {
    serde_json::from_slice(&read(at, name)).unwrap()
}

/// Whether `SHA256SUMS` has the file as it is.
fn is_listed(at: &Path, name: &str) -> bool {
    let list = String::from_utf8(read(at, "out/SHA256SUMS")).unwrap();
    let sum = occupant_jobs::base::sha256(&read(at, &format!("out/{name}")));
    list.lines().any(|line| line == format!("{sum}  {name}"))
}

/// The rating of a folder's runs by hand.
fn by_hand(at: &Path, words: &[&str], filled: &str) -> String {
    let runs = files(&at.join("out/runs"), ".mcap");
    let runs: Vec<&str> = runs.iter().map(|run| run.to_str().unwrap()).collect();
    done(at, &[&["measures"], &runs[..], words, &["-o", filled, "--force"]].concat())
}

const PLACES: [&str; 6] = ["--rating", "un-r137", "--place", "front passenger", "--place", "driver"];

#[test]
fn one_command_rates_as_two_do_and_again() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let told = done(at, &SWEEP);
    let hand = by_hand(at, &PLACES, "filled.xlsx");
    assert!(read(at, "out/rating.xlsx") == read(at, "filled.xlsx"), "other bytes");
    let body = |text: &str| text.split("\nDriver, ").nth(1).unwrap().to_owned();
    assert_eq!(body(&told), body(&hand));
    assert!(told.contains("out/rating.xlsx, out/rating.json"), "{told}");
    assert!(["rating.xlsx", "rating.json"].iter().all(|name| is_listed(at, name)));
    let occupants = &json(at, "out/rating.json")["results"][0]["tests"][0]["occupants"];
    assert_eq!(occupants.as_array().unwrap().len(), 2);
    // the same command rates what is there, and makes a file again that is damaged or missing
    let before = rating(at, "out");
    fs::write(at.join("out/rating.xlsx"), "mine").unwrap();
    fs::remove_file(at.join("out/rating.json")).unwrap();
    let again = answer(at, &SWEEP);
    assert!(again.status.success(), "{}", err(&again));
    assert!(err(&again).contains("rating.xlsx was changed after it was written; it is made again"), "{}", err(&again));
    let words = String::from_utf8(again.stdout).unwrap();
    assert!(words.contains("0 samples in") && body(&words) == body(&told), "{words}");
    assert!(rating(at, "out") == before, "other bytes");
    assert!(["rating.xlsx", "rating.json"].iter().all(|name| is_listed(at, name)));
}

#[test]
fn another_rating_needs_no_other_run() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &SWEEP);
    let table = read(at, "out/results.parquet");
    let filled = "Seat position,Dummy,Body region,Criteria,Value\nDriver,Hybrid III 50M,Head,HIC36,123\n";
    fs::write(at.join("values.csv"), filled).unwrap();
    let other = STUDY.split("[rating]").next().unwrap().to_owned();
    let section = "[rating]\nname = \"un-r137\"\nplaces = [\"driver\"]\nvalues = \"values.csv\"\n";
    fs::write(at.join("study.toml"), format!("{other}{section}")).unwrap();
    let told = done(at, &SWEEP);
    assert!(told.contains("0 samples in"), "{told}");
    by_hand(at, &["--rating", "un-r137", "--place", "driver", "--values", "values.csv"], "filled.xlsx");
    assert!(read(at, "out/rating.xlsx") == read(at, "filled.xlsx"), "other bytes");
    assert_eq!(json(at, "out/rating.json")["results"].as_array().unwrap().len(), 2);
    // other values, then none: the copies in the folder follow, so that a merge rates in the same way
    for values in ["values = \"values.csv\"\n", ""] {
        fs::write(at.join("values.csv"), filled.replace("123", "99")).unwrap();
        fs::write(
            at.join("study.toml"),
            format!("{other}{}{values}", section.replace("values = \"values.csv\"\n", "")),
        )
        .unwrap();
        done(at, &SWEEP);
        let now = rating(at, "out");
        done(at, &["sweep", "merge", "out"]);
        assert!(rating(at, "out") == now, "other bytes");
    }
    assert!(read(at, "out/results.parquet") == table, "other bytes");
    // a study without a rating leaves none behind, whatever has become of its files
    fs::write(at.join("out/rating.xlsx"), "mine").unwrap();
    fs::write(at.join("study.toml"), other).unwrap();
    done(at, &SWEEP);
    assert!(!at.join("out/rating.xlsx").exists() && !at.join("out/rating.json").exists());
    assert!(!String::from_utf8(read(at, "out/SHA256SUMS")).unwrap().contains("rating"));
}

#[test]
fn parts_are_rated_when_they_are_merged() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &SWEEP);
    let whole = rating(at, "out");
    for (out, shard) in [("a", "1/2"), ("b", "2/2"), ("both", "1/2"), ("both", "2/2")] {
        let told = done(at, &["sweep", "study.toml", "-o", out, "--shard", shard]);
        assert!(!told.contains("Driver") && !at.join(out).join("rating.xlsx").exists(), "{told}");
    }
    // the folder is enough to merge
    let case = read(at, "case.toml");
    ["case.toml", "study.toml"].iter().for_each(|name| fs::remove_file(at.join(name)).unwrap());
    let told = done(at, &["sweep", "merge", "both"]);
    assert!(told.contains("Driver, Hybrid III 50M: "), "{told}");
    assert!(rating(at, "both") == whole, "other bytes");
    // runs stay in the folders of their processes; one that is nowhere is made again
    done(at, &["sweep", "merge", "a", "b", "-o", "table"]);
    assert_eq!(files(&at.join("table/runs"), ".mcap"), [] as [&Path; 0]);
    fs::remove_file(at.join("b/runs/000001.mcap")).unwrap();
    fs::write(at.join("a/runs/000000.mcap"), "changed").unwrap();
    done(at, &["sweep", "merge", "a", "b", "-o", "table"]);
    assert_eq!(files(&at.join("table/runs"), ".mcap").len(), 2);
    assert!(rating(at, "table") == whole, "other bytes");
    // another rating is that of the merge once all folders have it
    fs::write(at.join("case.toml"), case).unwrap();
    fs::write(at.join("study.toml"), STUDY.replace("[\"front passenger\", \"driver\"]", "[\"driver\"]")).unwrap();
    done(at, &["sweep", "study.toml", "-o", "a", "--shard", "1/2"]);
    let mixed = answer(at, &["sweep", "merge", "a", "b", "-o", "table"]);
    assert_eq!(mixed.status.code(), Some(2));
    assert!(err(&mixed).contains("a and b contain parts of different sweeps"), "{}", err(&mixed));
    assert!(err(&mixed).contains("study.toml, line 16: `places = [\"driver\"]`"), "{}", err(&mixed));
    done(at, &["sweep", "study.toml", "-o", "b", "--shard", "2/2"]);
    done(at, &["sweep", "merge", "a", "b", "-o", "table"]);
    assert_eq!(json(at, "table/rating.json")["results"].as_array().unwrap().len(), 2);
}

/// A pulse of no speed is refused, so its body is blank, and the other is rated.
#[test]
fn a_body_without_a_run_is_blank() {
    let folder = folder_with(&STUDY.replace("20 mph", "0 mph"));
    let at = folder.path();
    let output = answer(at, &SWEEP);
    assert!(output.status.success(), "{}", err(&output));
    assert!(err(&output).contains("runs/000000.mcap: sample 0 refused: "), "{}", err(&output));
    let told = json(at, "out/rating.json");
    let occupants = told["results"][0]["tests"][0]["occupants"].as_array().unwrap();
    let values = |own: &Value| {
        let criteria = own["regions"].as_array().unwrap().iter().flat_map(|region| region["criteria"].as_array());
        criteria.flatten().filter(|criterion| !criterion["value"].is_null()).count()
    };
    let seat = |name: &str| values(occupants.iter().find(|own| own["seat"] == name).unwrap());
    assert!(seat("Front Passenger") == 0 && seat("Driver") > 0, "{told}");
    // without a place for each body it is left out, and said
    let alone = STUDY.replace("20 mph", "0 mph").replace("places = [\"front passenger\", \"driver\"]\n", "");
    fs::write(at.join("study.toml"), alone).unwrap();
    let output = answer(at, &SWEEP);
    assert!(err(&output).contains("note: sample 0 refused: "), "{}", err(&output));
    assert_eq!(json(at, "out/rating.json")["results"].as_array().unwrap().len(), 1);
}

/// With its place, what was found and what was expected, before anything runs.
#[test]
fn wrong_ratings_are_refused() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let places = "places = [\"front passenger\", \"driver\"]";
    let cases: [(&str, &str, &[&str]); 9] = [
        ("un-r137", "un-r138", &["study.toml:15:8", "did you mean \"un-r137\"?"]),
        ("keep = \"all\"\n", "", &["rating", "no `keep`", "write keep = \"all\""]),
        ("\"all\"", "[0, 1]", &["study.toml:3:8", "not all runs are kept", "write keep = \"all\""]),
        ("\"driver\"", "\"pilot\"", &["study.toml:16:30", "\"pilot\": no occupant of un-r137", "a part of one of"]),
        ("\"driver\"", "\"hybrid iii\"", &["rating.places[1]", "2 occupants have this name", "one of Driver"]),
        ("\"driver\"", "\"passenger\"", &["rating.places[1]", "two bodies are Front Passenger"]),
        ("\"25 mph\"", "\"25 mph\", \"30 mph\"", &["study.toml:16:10", "2 places, but 3 runs with one occupant each"]),
        (places, "places = [\"pilot\"]", &["rating.places[0]", "no occupant of un-r137"]),
        (places, "values = \"none.csv\"", &["rating.values", "none.csv cannot be read"]),
    ];
    for (old, new, parts) in cases {
        assert!(STUDY.contains(old), "{old}");
        fs::write(at.join("study.toml"), STUDY.replace(old, new)).unwrap();
        for more in [&[][..], &["--dry-run"], &["--shard", "1/2"]] {
            let output = answer(at, &[&SWEEP, more].concat());
            assert_eq!(output.status.code(), Some(2), "{old} → {new}: {}", err(&output));
            let said = err(&output);
            assert!(parts.iter().all(|part| said.contains(part)), "{old} → {new}: {said}");
        }
    }
    fs::write(at.join("study.toml"), STUDY).unwrap();
    let output = answer(at, &[&SWEEP[..], &["--keep", "none"]].concat());
    assert!(err(&output).contains("--keep none: the [rating]"), "{}", err(&output));
    assert!(!at.join("out").exists());
    assert!(done(at, &[&SWEEP[..], &["--dry-run"]].concat()).contains("un-r137, 2 bodies together"));
}

#[test]
fn more_than_twenty_bodies_are_one_table_with_the_least_and_the_most() {
    let grid = "grid = { from = \"20 mph\", to = \"25 mph\", steps = 21 }";
    let one = STUDY.replace("\"front passenger\", ", "").replace("30 ms", "10 ms");
    let folder = folder_with(&one.replace("list = [\"20 mph\", \"25 mph\"]", grid));
    let at = folder.path();
    let told = done(at, &SWEEP);
    let (_, table) = told.split_once("21 bodies; rating.xlsx and rating.json have each\n").expect("a summary");
    assert!(table.contains("Driver") && table.contains("runs/") && table.lines().count() < 8, "{table}");
    assert_eq!(json(at, "out/rating.json")["results"].as_array().map(Vec::len), Some(21));
}
