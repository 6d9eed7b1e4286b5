//! The table: its columns, its files, the same bits for any number of threads.

use std::fs::{self, File};

use parquet::file::reader::{FileReader, SerializedFileReader};

use super::{STUDY, answer, column, done, err, folder_with, rows};

#[test]
fn a_sweep_writes_a_row_for_each_sample_the_same_for_any_number_of_threads() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let said = done(at, &["sweep", "study.toml", "-o", "one", "--threads", "1", "--csv"]);
    assert!(said.contains("24 completed"), "{said}");
    done(at, &["sweep", "study.toml", "-o", "three", "--threads", "3", "--csv", "--quiet"]);
    let one = rows(at, "one");
    assert_eq!(one.len(), 25);
    assert_eq!(one, rows(at, "three"));
    let counted: Vec<String> = (0..24).map(|i| i.to_string()).collect();
    assert_eq!(column(&one, "index"), counted);
    let speeds = column(&one, "input.speed");
    let m_s = |text: &String| text.parse::<f64>().unwrap();
    assert!(speeds.iter().map(m_s).all(|v| (6.7..11.2).contains(&v)), "{speeds:?}");
    let mut different = column(&one, "head.peak");
    different.dedup();
    assert_eq!(different.len(), 24, "the samples do differ");
    let units = fs::read_to_string(at.join("one/columns.csv")).unwrap();
    assert!(units.contains("head.peak,m/s²,figure"), "{units}");
    assert!(units.contains("input.speed,m/s,input"), "{units}");
}

#[test]
fn the_parquet_file_holds_the_rows_and_says_what_they_are_of() {
    let folder = folder_with(STUDY);
    done(folder.path(), &["sweep", "study.toml", "-o", "out"]);
    let file = File::open(folder.path().join("out/results.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let about = reader.metadata().file_metadata();
    assert_eq!(about.num_rows(), 24);
    let entries = about.key_value_metadata().unwrap();
    let entry = |key: &str| {
        let found = entries.iter().find(|e| e.key == key).unwrap();
        serde_json::from_str::<serde_json::Value>(found.value.as_ref().unwrap()).unwrap()
    };
    assert_eq!(entry("occupant.units")["belts.lap.peak"], "N");
    assert_eq!(entry("occupant.sweep")["samples"], 24);
    assert_eq!(entry("occupant.sweep")["title"], "damping and speed");
}

#[test]
fn one_row_is_what_run_says_of_the_same_scenario() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "out", "--csv", "--set", "path.duration=70 ms"]);
    let table = rows(at, "out");
    let value = |name: &str| column(&table, name)[5].clone();
    let sets = [
        "time.end=30 ms".to_owned(),
        "path.duration=70 ms".to_owned(),
        format!("joints.neck.damping={} N m s/rad", value("input.joints.neck.damping")),
        format!("path.speed={} m/s", value("input.speed")),
    ];
    let mut words = vec!["run", "case.toml", "--no-mcap", "--json", "--quiet"];
    sets.iter().for_each(|set| words.extend(["--set", set]));
    let run: serde_json::Value = serde_json::from_str(&done(at, &words)).unwrap();
    let number = |name: &str| value(name).parse::<f64>().unwrap();
    assert_eq!(run["accelerations"]["head"]["peak_m_s2"], number("head.peak"));
    assert_eq!(run["belts"][0]["loop_force_n"], number("belts.lap.peak"));
    assert_eq!(run["solver"]["evaluations"].as_f64(), Some(number("solver.evaluations")));
}

#[test]
fn a_sample_that_is_refused_or_fails_is_a_row_with_its_reason() {
    let study = r#"
        base = "case.toml"
        design.kind = "full_factorial"
        [set]
        "time.end" = "20 ms"
        [[parameters]]
        path = "time.start"
        list = [0.0, 0.5]
        [[parameters]]
        path = "integrator.min_step"
        list = [1e-8, 0.9e-3]
    "#;
    let folder = folder_with(study);
    let at = folder.path();
    let case = at.join("case.toml");
    let text = fs::read_to_string(&case).unwrap();
    // the case's own integrator goes
    let start = text.find("[integrator]").unwrap();
    let end = start + text[start..].find("\n\n").unwrap();
    let adaptive = "[integrator]\nkind = \"adaptive\"\nmin_step = 1e-8\nmax_step = 1e-3\n\
        relative = 1e-9\nabsolute_length = 1e-12\nabsolute_speed = 1e-10";
    fs::write(&case, format!("{}{adaptive}{}", &text[..start], &text[end..])).unwrap();
    let said = done(at, &["sweep", "study.toml", "-o", "out", "--csv"]);
    let table = rows(at, "out");
    assert_eq!(column(&table, "status"), ["completed", "failed", "refused", "refused"], "{said}");
    assert!(said.contains("1 completed, 1 failed, 2 refused"), "{said}");
    assert!(table[2].contains("the error control needs a step"), "{}", table[2]);
    assert!(table[3].contains("an end after the start"), "{}", table[3]);
    // a run that failed has the figures of its work and none else
    assert_eq!(column(&table, "head.peak")[1..], ["", "", ""]);
    assert!(!column(&table, "solver.evaluations")[1].is_empty());
}

#[test]
fn a_study_keeps_the_measures_that_it_names() {
    let folder = folder_with(&format!("{STUDY}\n[output]\nmeasures = [\"hic15\", \"head.*\"]\n"));
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "few", "--csv", "--quiet"]);
    let few = rows(at, "few");
    let names: Vec<&str> = few[0].split(',').collect();
    assert_eq!(&names[..3], ["index", "input.joints.neck.damping", "input.speed"]);
    let measures: Vec<&str> = names.iter().copied().filter(|n| !n.starts_with("input.")).collect();
    assert!(measures.contains(&"hic15") && measures.contains(&"head.peak"), "{names:?}");
    assert!(!names.iter().any(|n| n.starts_with("chest") || n.starts_with("solver")), "{names:?}");
    fs::write(at.join("all.toml"), STUDY).unwrap();
    done(at, &["sweep", "all.toml", "-o", "full", "--csv", "--quiet"]);
    let full = rows(at, "full");
    for name in ["hic15", "head.peak", "caveats", "status"] {
        assert_eq!(column(&few, name), column(&full, name), "{name}");
    }
    done(at, &["study", "report", "few"]);
    fs::write(at.join("study.toml"), format!("{STUDY}\n[output]\nmeasures = [\"hic16\"]\n")).unwrap();
    let said = err(&answer(at, &["sweep", "study.toml", "-o", "none"]));
    assert!(said.contains("output.measures: no measure is `hic16`") && said.contains("hic15"), "{said}");
}
