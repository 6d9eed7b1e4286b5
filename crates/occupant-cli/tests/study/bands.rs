//! `occupant study bands`.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::{answer, done, err, occupant, spoken, swept};
use crate::common::damage;

const STUDY: &str = r#"
    seed = 2
    design.kind = "full_factorial"
    set = { "time.end" = "60 ms", "output.interval" = "2 ms" }
    [[parameters]]
    path = "path.speed"
    list = ["18 mph", "22 mph", "26 mph"]
    [ensemble]
    members = 12
"#;

/// By channel: a value of a column for each time.
fn column(file: &Path, name: &str) -> BTreeMap<String, Vec<Option<f64>>> {
    let reader = SerializedFileReader::new(fs::File::open(file).unwrap()).unwrap();
    let mut found: BTreeMap<String, Vec<Option<f64>>> = BTreeMap::new();
    for row in reader.get_row_iter(None).unwrap() {
        let row = row.unwrap().into_columns();
        let at = |wanted: &str| &row.iter().find(|c| c.0 == wanted).unwrap().1;
        let Field::Str(channel) = at("channel") else { panic!("{row:?}") };
        let value = match at(name) {
            Field::Double(x) => Some(*x),
            Field::Long(n) => Some(*n as f64),
            Field::Null => None,
            other => panic!("{other:?}"),
        };
        found.entry(channel.clone()).or_default().push(value);
    }
    found
}

/// All files of bands, by name.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder.join("out/bands")).unwrap().map(Result::unwrap);
    let read = entries.map(|e| (e.file_name().into_string().unwrap(), fs::read(e.path()).unwrap()));
    read.collect()
}

#[test]
fn the_bands_of_a_sample_are_those_of_its_ensemble_alone() {
    let folder = swept(STUDY);
    let at = folder.path();
    done(at, &["study", "bands", "out", "--channels", "belt.*.force,head.acceleration.resultant"]);
    assert_eq!(files(at).keys().collect::<Vec<_>>(), ["000000.parquet", "000001.parquet", "000002.parquet"]);
    // the same ensemble, run by itself
    done(
        at,
        &[
            "run",
            "case.toml",
            "--no-mcap",
            "--quiet",
            "--ensemble",
            "12",
            "--seed",
            "2",
            "--set",
            "time.end=60 ms",
            "--set",
            "output.interval=2 ms",
            "--set",
            "path.speed=22 mph",
            "--channels",
            "belt.*.force,head.acceleration.resultant",
            "--bands",
            "alone.parquet",
        ],
    );
    let (ours, alone) = (at.join("out/bands/000001.parquet"), at.join("alone.parquet"));
    for name in ["time_s", "nominal", "q05", "q25", "median", "q75", "q95"] {
        let (found, wanted) = (column(&ours, name), column(&alone, name));
        assert_eq!(found.len(), 3);
        assert!(found["belt.lap.force"].len() > 20);
        assert_eq!(found, wanted, "{name}");
    }
    assert!(column(&ours, "members")["belt.lap.force"].iter().all(|n| *n == Some(12.0)));
    assert!(column(&ours, "sample")["belt.lap.force"].iter().all(|n| *n == Some(1.0)));
    // when the members part is the first time at which the middle 90 % is wider than the tolerance
    let (low, high) = (column(&ours, "q05"), column(&ours, "q95"));
    let (times, tolerance) = (column(&ours, "time_s"), column(&ours, "tolerance"));
    for (channel, lost) in column(&ours, "lost_at_s") {
        let wide =
            |i: &usize| high[&channel][*i].unwrap() - low[&channel][*i].unwrap() > tolerance[&channel][*i].unwrap();
        let first = (0..times[&channel].len()).find(wide).map(|i| times[&channel][i].unwrap());
        assert_eq!(lost[0], first, "{channel}");
    }
}

#[test]
fn what_was_killed_goes_on_to_the_same_files() {
    let folder = swept(STUDY);
    let at = folder.path();
    let words = ["study", "bands", "out", "--threads", "1", "--quiet"];
    done(at, &words);
    let whole = files(at);
    fs::remove_dir_all(at.join("out/bands")).unwrap();
    for _ in 0..3 {
        let mut process = occupant(at).args(words).spawn().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(60));
        process.kill().unwrap();
        process.wait().unwrap();
    }
    // as a process leaves it that was killed while it wrote
    fs::create_dir_all(at.join("out/bands")).unwrap();
    fs::write(at.join("out/bands/000002.partial.parquet"), b"PAR1").unwrap();
    fs::remove_file(at.join("out/bands/000002.parquet")).unwrap_or_default();
    done(at, &["study", "bands", "out", "--threads", "2", "--quiet"]);
    assert!(files(at) == whole, "the files differ");
    // nothing is left to do: nothing is said
    assert_eq!(spoken(at, &["study", "bands", "out"]), "");
}

#[test]
fn what_cannot_have_bands_is_refused() {
    let folder = swept(STUDY);
    let at = folder.path();
    let output = answer(at, &["study", "bands", "out", "--channels", "belt.lapp.force"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("did you mean `belt.lap.force`"), "{}", err(&output));
    assert!(!at.join("out/bands").exists());
    done(at, &["study", "bands", "out", "--channels", "belt.lap.force", "--quiet"]);
    let output = answer(at, &["study", "bands", "out", "--channels", "belt.torso.force"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("--force replaces them"), "{}", err(&output));
    done(at, &["study", "bands", "out", "--channels", "belt.torso.force", "--force", "--quiet"]);
    let plain = swept(super::STUDY);
    let output = answer(plain.path(), &["study", "bands", "out"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("has no ensemble"), "{}", err(&output));
}

#[test]
fn damaged_bands_are_named_and_made_again() {
    let folder = swept(STUDY);
    let at = folder.path();
    let words = ["study", "bands", "out", "--channels", "belt.*.force", "--quiet"];
    done(at, &words);
    let whole = files(at);
    for (name, cut) in [("000000.parquet", true), ("000001.parquet", false), ("000002.parquet", false)] {
        damage(&at.join("out/bands").join(name), cut);
    }
    let told = spoken(at, &words);
    assert_eq!(told.matches("damaged: ").count(), 3, "{told}");
    assert!(files(at) == whole, "the files differ");
    assert_eq!(spoken(at, &words), "");
}
