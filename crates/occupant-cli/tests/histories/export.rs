//! `occupant export`.

use std::fs::File;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

use super::{coarse, column, fine, refused, table, text, well};

#[test]
fn a_table_has_all_channels_and_says_what_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    well(folder.path(), &["export", run, "-o", "all.csv"]);
    let (headings, columns) = table(&folder.path().join("all.csv"));
    assert_eq!(headings[0], "time[s]");
    assert!(headings.len() > 300, "{}", headings.len());
    // from −10 ms to 29.5 ms, the end included
    assert_eq!(columns[0].len(), 41);
    assert_eq!((columns[0][0], columns[0][1], columns[0][40]), (-0.01, -0.009, 0.0295));
    let about: serde_json::Value = serde_json::from_str(&text(&folder.path().join("all.csv-metadata.json"))).unwrap();
    assert_eq!(about["url"], "all.csv");
    let described = about["tableSchema"]["columns"].as_array().unwrap();
    assert_eq!(described.len(), headings.len());
    for (one, heading) in described.iter().zip(&headings) {
        assert_eq!(one["titles"].as_str(), Some(heading.as_str()));
    }
    let head = described.iter().find(|c| c["name"] == "head.acceleration.z").unwrap();
    assert_eq!((head["unit"].as_str(), head["frame"].as_str()), (Some("m/s^2"), Some("segment")));
}

#[test]
fn units_are_those_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    let channels = ["--channels", "head.acceleration.x,belt.*.force"];
    for (name, units) in [("si.csv", "si"), ("g.csv", "g"), ("in.csv", "in-lbf-s")] {
        let words = ["export", run, "-o", name, "--units", units];
        well(folder.path(), &[&words[..], &channels[..]].concat());
    }
    let at = |file: &str, heading: &str| column(&folder.path().join(file), heading);
    let si = at("si.csv", "head.acceleration.x[m/s^2]");
    let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * b.abs().max(1e-9), "{a} {b}");
    for (g, si) in at("g.csv", "head.acceleration.x[g]").iter().zip(&si) {
        close(g * 9.80665, *si);
    }
    for (inch, si) in at("in.csv", "head.acceleration.x[in/s^2]").iter().zip(&si) {
        close(inch * 0.0254, *si);
    }
    let (headings, _) = table(&folder.path().join("in.csv"));
    assert!(headings.iter().any(|h| h.starts_with("belt.") && h.ends_with(".force[lbf]")), "{headings:?}");
}

#[test]
fn parquet_holds_the_same_numbers_with_their_metadata() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    let channels = "head.acceleration.*,energy.balance";
    well(folder.path(), &["export", run, "-o", "a.csv", "--channels", channels]);
    well(folder.path(), &["export", run, "-o", "a.parquet", "--channels", channels]);
    let file = SerializedFileReader::new(File::open(folder.path().join("a.parquet")).unwrap()).unwrap();
    let about = file.metadata().file_metadata().key_value_metadata().unwrap();
    let about = about.iter().find(|kv| kv.key == "occupant").unwrap();
    let about: serde_json::Value = serde_json::from_str(about.value.as_ref().unwrap()).unwrap();
    assert_eq!(about["columns"][1]["name"], "head.acceleration.x");
    assert_eq!(about["columns"][1]["unit"], "m/s^2");
    assert_eq!(about["columns"][1]["filter"], "none");
    let (_, columns) = table(&folder.path().join("a.csv"));
    let mut rows = 0;
    for (i, row) in file.get_row_iter(None).unwrap().enumerate() {
        let row = row.unwrap();
        for (c, column) in columns.iter().enumerate().skip(1) {
            assert_eq!(row.get_double(c).unwrap(), column[i]);
        }
        rows += 1;
    }
    assert_eq!(rows, 41);
}

#[test]
fn a_filtered_resultant_is_that_of_filtered_components() {
    let folder = tempfile::tempdir().unwrap();
    let run = fine();
    let run = run.to_str().unwrap();
    let words = ["export", run, "-o", "f.csv", "--filter", "CFC180", "--channels", "head.acceleration.*"];
    well(folder.path(), &words);
    let at = |name: &str| column(&folder.path().join("f.csv"), &format!("head.acceleration.{name}[m/s^2]"));
    let (x, y, z, r) = (at("x"), at("y"), at("z"), at("resultant"));
    for i in 0..x.len() {
        let sum = (x[i] * x[i] + y[i] * y[i] + z[i] * z[i]).sqrt();
        assert!((sum - r[i]).abs() <= 1e-12 * r[i], "{sum} {}", r[i]);
    }
    let about = text(&folder.path().join("f.csv-metadata.json"));
    assert!(about.contains("\"filter\": \"CFC 180\"") && about.contains("ISO 6487"), "{about}");
}

/// Points of a three-point belt, in the order of its webbing: retractor, above and below the chest, inner and outer lap.
#[test]
fn an_iso_mme_test_has_the_webbing_the_bag_and_the_column() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/airbag-driver.toml");
    let short = ["--set", "time.end='20 ms'", "-o", "a.mcap", "-q"];
    well(folder.path(), &[&["run", scenario][..], &short].concat());
    well(folder.path(), &["export", "a.mcap", "-o", "T1.mme", "--interval", "1 ms"]);
    let list = std::fs::read_to_string(folder.path().join("T1/Channel/T1.chn")).unwrap();
    for (code, channel) in [
        ("11SEBE0000B1FO00", "strap.driver.reel_d_ring.force"),
        ("11SEBE0000B3FO00", "strap.driver.d_ring_shoulder.force"),
        ("11SEBE0000B4FO00", "strap.driver.shoulder_buckle.force"),
        ("11SEBE0000B5FO00", "strap.driver.buckle_right_wing.force"),
        ("11SEBE0000B6FO00", "strap.driver.left_wing_sill.force"),
        ("11AIRB000000PR00", "bag.driver.pressure"),
        ("11STCO000000DSX0", "column.column.stroke"),
        ("11STCO000000FOX0", "column.column.force"),
    ] {
        assert!(list.contains(&format!("{code} / {channel}\n")), "{code} {channel}: {list}");
    }
    assert!(!list.contains("right_wing_left_wing"));
    // and is paired with them again
    let told = well(folder.path(), &["compare", "a.mcap", "T1", "--channel", "strap.*.force,bag.*.pressure,column.*"]);
    let told = String::from_utf8(told.stdout).unwrap();
    for channel in ["d_ring_shoulder.force", "left_wing_sill.force", "bag.driver.pressure", "column.column.stroke"] {
        assert!(told.contains(channel), "{channel}: {told}");
    }
}

/// Of two occupants nothing says whose a belt is: none has a code, and no code stands twice.
#[test]
fn an_iso_mme_test_of_two_has_no_code_twice() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/studies/euro-ncap-cases/car.toml");
    well(folder.path(), &["run", scenario, "--set", "time.end='10 ms'", "-o", "a.mcap", "-q"]);
    well(folder.path(), &["export", "a.mcap", "-o", "T1.mme", "--interval", "1 ms"]);
    let list = std::fs::read_to_string(folder.path().join("T1/Channel/T1.chn")).unwrap();
    assert!(!list.contains("SEBE") && !list.contains("AIRB") && list.contains("10VEHCCG0000ACX0"), "{list}");
}

#[test]
fn an_iso_mme_test_has_codes_units_and_j211_signs() {
    let folder = tempfile::tempdir().unwrap();
    let run = fine();
    let run = run.to_str().unwrap();
    let all = ["export", run, "-o", "T1.mme", "--filter", "CFC180"];
    let said = super::err(&well(folder.path(), &all));
    assert!(said.contains("T1.mme") && said.contains("without an ISO-MME code"), "{said}");
    let words = ["export", run, "-o", "t.csv", "--filter", "CFC180", "--channels", "head.acceleration.*"];
    well(folder.path(), &words);
    let chn = text(&folder.path().join("T1/Channel/T1.chn"));
    for code in ["10VEHCCG0000ACXC", "11HEADCG0000ACZC", "11NECKUP0000FOZC", "11SEBE0000B6FO0C", "11FEMRLE0000FOZC"] {
        assert!(chn.contains(code), "{code} in\n{chn}");
    }
    let line = chn.lines().find(|l| l.contains("11HEADCG0000ACZC")).unwrap();
    let number = line.trim_start_matches("Name of channel ").split_whitespace().next().unwrap();
    let file = text(&folder.path().join(format!("T1/Channel/T1.{number}")));
    assert!(file.contains("Channel frequency class     :180\n") && file.contains(":m/(s*s)\n"), "{file}");
    let theirs: Vec<f64> = file.lines().filter_map(|l| l.parse().ok()).collect();
    let ours = column(&folder.path().join("t.csv"), "head.acceleration.z[m/s^2]");
    assert_eq!(theirs.len(), ours.len());
    // Z up becomes Z down
    let peak = ours.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    assert!(peak > 1.0);
    for (theirs, ours) in theirs.iter().zip(&ours) {
        assert!((theirs + ours).abs() <= 1e-15 * peak, "{theirs} {ours}");
    }
    // all comes back as it was, signs included
    let words = ["compare", run, "T1", "--filter", "CFC180", "--json"];
    let answer: serde_json::Value = serde_json::from_slice(&well(folder.path(), &words).stdout).unwrap();
    let pairs = answer["pairs"].as_array().unwrap();
    assert!(pairs.len() > 20, "{}", pairs.len());
    let head = pairs.iter().find(|p| p["channel"] == "head.acceleration.z").unwrap();
    // the test is filtered twice, hence not 1 (0.9986)
    assert!(head["iso18571"]["overall"].as_f64().unwrap() > 0.97, "{head}");
    // a second time only by force, and never over a folder that holds something else
    assert!(refused(folder.path(), &all).contains("T1 exists"));
    well(folder.path(), &[&all[..], &["--force"]].concat());
    std::fs::write(folder.path().join("T1/mine.txt"), "").unwrap();
    assert!(refused(folder.path(), &[&all[..], &["--force"]].concat()).contains("mine.txt"));
}

#[test]
fn a_class_that_the_outputs_are_too_coarse_for_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    let said = refused(folder.path(), &["export", run, "-o", "a.csv", "--filter", "j211"]);
    assert!(said.contains("CFC 1000 needs more than") && said.contains("there are 1000 per second"), "{said}");
    assert!(said.contains("output.interval"), "{said}");
    assert!(!folder.path().join("a.csv").exists());
    // the outputs end off the grid: the last one cannot be filtered with the others
    let words = ["export", run, "-o", "a.csv", "--filter", "CFC60", "--channels", "belt.*.force"];
    let said = super::err(&well(folder.path(), &words));
    assert!(said.contains("0.0295 s") && said.contains("skipped"), "{said}");
}

#[test]
fn what_cannot_be_exported_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    for (words, expected) in [
        (vec!["export", run, "-o", "a.xls"], ".csv, .parquet, .xlsx, .mat, .mme or .glb"),
        (vec!["export", run, "-o", "a.csv", "--channels", "head.aceleration.x"], "did you mean `head.acceleration.x`"),
        (vec!["export", run, "-o", "a.csv", "--channels", "nose.*"], "there is no channel `nose.*`"),
        (vec!["export", run, "-o", "a.csv", "--interval", "0"], "above zero"),
        (vec!["export", run, "-o", "a.csv", "--interval", "1 kg"], "--interval"),
        (vec!["export", run, "-o", "a.csv", "--filter", "CFC90"], "CFC60"),
        (vec!["export", run, "-o", "a.mme", "--channels", "energy.*", "--interval", "1 ms"], "none of these channels"),
        (vec!["export", run, "-o", "a.mme"], "equally spaced"),
        (vec!["export", "none.mcap", "-o", "a.csv"], "cannot be read"),
    ] {
        let said = refused(folder.path(), &words);
        assert!(said.contains(expected), "{words:?}: {said}");
    }
    std::fs::write(folder.path().join("a.csv"), "mine").unwrap();
    let words = ["export", run, "-o", "a.csv", "--channels", "energy.*"];
    assert!(refused(folder.path(), &words).contains("a.csv exists"));
    assert_eq!(text(&folder.path().join("a.csv")), "mine");
    assert!(!folder.path().join("a.csv-metadata.json").exists());
}

/// What the files hold is read by other programs in `read_histories.py`.
#[test]
fn workbooks_and_mat_files_are_written_twice_alike() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    for ending in ["xlsx", "mat"] {
        let read = |name: &str| {
            let file = format!("{name}.{ending}");
            well(folder.path(), &["export", run, "-o", &file]);
            std::fs::read(folder.path().join(file)).unwrap()
        };
        let first = read("first");
        assert_eq!(first, read("second"));
        assert!(first.starts_with(if ending == "xlsx" { b"PK" } else { b"MA" }) && first.len() > 50_000);
        let message = refused(folder.path(), &["export", run, "-o", &format!("first.{ending}")]);
        assert!(message.contains("--force"), "{message}");
    }
}
