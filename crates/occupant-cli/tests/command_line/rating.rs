//! `occupant measures --rating`.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::measures::table;
use super::{answer, code, err, folder_with_case, json, out};

/// Values of the driver in the full width test, in the layout of the template: places stand once.
const VALUES: &str = "Loadcase,Seat position,Dummy,Body region,Criteria,HPL,LPL,Value\n\
    FWDB-35,Driver,HIII-05,Head & Neck,Ares,,80,90\n\
    ,,,,HIC15,500,700,600\n\
    ,,,,Ares-3ms,72,80,70\n\
    ,,,,\"Fx,shear\",1.2,2,0\n\
    ,,,,\"Fz,tension\",1.7,2.6,0\n\
    ,,,,\"My,extension\",36,49,0\n\
    ,,,Chest & Abdomen,Dchest compression,18,34,20\n\
    ,,,,Viscous Criterion,0.5,1,n/a\n\
    ,,,\"Knee, Femur & Pelvis\",\"Ffemur, left\",2.6,6.2,4\n";

const FULL_WIDTH: &str = "euro-ncap-2026-full-width";

fn rate(folder: &Path, words: &[&str]) -> Value {
    let output = answer(folder, &[&["measures"], words, &["--json"]].concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    json(&output)
}

fn first(told: &Value) -> &Value {
    &told["results"][0]["tests"][0]["occupants"][0]
}

/// HIC15 600 is worth 40 % of 1.25 points; a chest without VC and knees without most of theirs stay open.
#[test]
fn values_of_a_table_are_rated_alone() {
    let folder = folder_with_case();
    let here = folder.path();
    std::fs::write(here.join("values.csv"), VALUES).unwrap();
    let words = ["--rating", FULL_WIDTH, "--values", "values.csv"];
    let told = rate(here, &words);
    let driver = first(&told);
    let regions: Vec<[f64; 2]> = driver["regions"]
        .as_array()
        .unwrap()
        .iter()
        .map(|region| ["now", "best"].map(|end| region["result"][end].as_f64().unwrap()))
        .collect();
    assert_eq!(regions, [[0.5, 0.5], [0.0, 1.0], [0.0, 0.5], [0.0, 1.25]]);
    assert_eq!((driver["result"]["now"].as_f64(), driver["result"]["best"].as_f64()), (Some(0.5), Some(3.25)));
    assert_eq!((&driver["capped"], &told["results"][0]["tests"][0]["result"]), (&Value::from(false), &Value::Null));
    let viscous = &driver["regions"][1]["criteria"][1];
    assert_eq!((&viscous["value"], &viscous["remark"]), (&Value::Null, &Value::from("no value given")));
    let text = out(&answer(here, &[&["measures"][..], &words].concat()));
    assert!(text.contains("FWDB-35, Driver, HIII-05: 0.500 of 5 points; 3.250 of 5 points with blanks"), "{text}");
    assert!(text.contains("version 5.4.9") && text.contains("Apache-2.0"), "{text}");
    // semicolons and decimal commas; a cap takes all
    let other = VALUES.replace("\"Fx,shear\"", "Fx+shear").replace("\"Fz,tension\"", "Fz+tension");
    let other = other.replace("\"My,extension\"", "My+extension").replace("\"Knee, Femur", "Knee+ Femur");
    let other = other.replace("\"Ffemur, left\"", "Ffemur+ left").replace("Pelvis\"", "Pelvis");
    let other = other.replace(',', ";").replace('+', ",").replace(";20\n", ";34,0\n");
    std::fs::write(here.join("other.csv"), other).unwrap();
    let capped = rate(here, &["--rating", FULL_WIDTH, "--values", "other.csv"]);
    assert_eq!((&first(&capped)["capped"], first(&capped)["result"]["best"].as_f64()), (&Value::from(true), Some(0.0)));
    let strict = ["measures", "--rating", FULL_WIDTH, "--values", "other.csv", "--strict"];
    assert_eq!(code(&answer(here, &strict)), 1);
}

/// Answers on the car and colours of the far side, and a parameter of another rating.
const FAR_SIDE: &str = "Input parameter,Value\nCountermeasure?,Yes\nTorso angle,25\n\
    Red line >125 mm outboard of the orange line,no\n\
    Loadcase,Seat position,Dummy,Body region,Criteria,Value\n\
    Main-Pole,Driver,WorldSID-50,Head,Ares,70.5\n\
    ,,,,Farside excursion,orange\n\
    Robustness-Pole75high,Driver,WorldSID-50,Head,Farside excursion,Red\n\
    Robustness-Pole90,Driver,WorldSID-50,Head,Farside excursion,Green\n";

/// Orange with a countermeasure is worth 75 % of 2 points; red is next to it, green is not.
#[test]
fn colours_of_the_far_side_are_words() {
    let folder = folder_with_case();
    let here = folder.path();
    let far_side = ["--rating", "euro-ncap-2026-far-side", "--values"];
    let points = |file: &str| -> Vec<f64> {
        let told = rate(here, &[&far_side[..], &[file]].concat());
        let seats = told["results"][0]["tests"][0]["occupants"].as_array().unwrap().clone();
        seats.iter().map(|seat| seat["result"]["now"].as_f64().unwrap()).collect()
    };
    std::fs::write(here.join("far.csv"), FAR_SIDE).unwrap();
    assert_eq!(points("far.csv"), [1.5, 2.0, 0.0]);
    let told = rate(here, &[&far_side[..], &["far.csv"]].concat());
    let colour = &first(&told)["regions"][0]["criteria"][3];
    assert_eq!((&colour["value"], &colour["word"], &colour["worth"]), (&2.0.into(), &"Orange".into(), &75.0.into()));
    for name in ["filled.csv", "filled.xlsx"] {
        let words = [&["measures"], &far_side[..], &["far.csv", "-o", name]].concat();
        let output = answer(here, &words);
        let text = out(&output);
        assert!(code(&output) == 0 && text.contains("Orange") && text.contains("near the colour of"), "{text}");
        assert_eq!(points(name), [1.5, 2.0, 0.0], "{name}");
    }
    let filled = std::fs::read_to_string(here.join("filled.csv")).unwrap();
    assert!(["Ares,70.5,", "Farside excursion,Orange,", "Countermeasure?,Yes,"].iter().all(|row| filled.contains(row)));
    for (from, to, found) in [
        ("orange\n", "oragne\n", "did you mean `Orange`?"),
        ("orange\n", "2\n", "the colour `2`"),
        (",Yes\n", ",perhaps\n", "yes, no, or nothing"),
        (",Yes\n", ",7\n", "yes, no, or nothing"),
        ("Torso angle,25", "countermeasure,No", "`Countermeasure?` a second time"),
    ] {
        std::fs::write(here.join("wrong.csv"), FAR_SIDE.replacen(from, to, 1)).unwrap();
        let output = answer(here, &[&["measures"], &far_side[..], &["wrong.csv"]].concat());
        assert!(code(&output) == 2 && err(&output).contains(found), "{found}: {}", err(&output));
    }
    // answers alone are no test
    std::fs::write(here.join("alone.csv"), FAR_SIDE.split_inclusive('\n').take(2).collect::<String>()).unwrap();
    let alone = answer(here, &[&["measures"], &far_side[..], &["alone.csv"]].concat());
    assert!(code(&alone) == 2 && err(&alone).contains("has no value"), "{}", err(&alone));
}

#[test]
fn wrong_values_are_pointed_at() {
    let folder = folder_with_case();
    let here = folder.path();
    let refused = |text: &str, words: &[&str]| {
        std::fs::write(here.join("values.csv"), text).unwrap();
        let output = answer(here, &[&["measures", "--rating", FULL_WIDTH, "--values", "values.csv"], words].concat());
        assert_eq!(code(&output), 2, "{}", out(&output));
        err(&output)
    };
    for (from, to, found) in [
        (",HIC15,", ",HIC16,", "did you mean `HIC15`?"),
        (",HIC15,", ",Ares,", "`Ares` a second time"),
        (",Value\n", ",Wert\n", "no column `Value`"),
        ("Head & Neck", "Hals", "the region `Hals`"),
        ("FWDB-35", "FWDB-99", "no occupant is `FWDB-99, Driver, HIII-05`"),
        (",600\n", ",inf\n", "a finite number"),
        (",600\n", ",six\n", "`six`"),
        ("\"Fx,shear\"", "Fx,shear", "the criterion `Fx`"),
    ] {
        let said = refused(&VALUES.replacen(from, to, 1), &[]);
        assert!(said.contains(found) && (said.contains("values.csv:") || found.contains("column")), "{from}: {said}");
    }
    assert!(refused("", &[]).contains("an empty table"));
    assert!(refused(VALUES.lines().next().unwrap(), &[]).contains("has no value"));
    assert!(refused(VALUES, &["--place", "driver"]).contains("values name their occupants"));
    let seats = VALUES.replace("FWDB-35,Driver", ",");
    assert!(refused(&seats, &[]).contains("several occupants are `HIII-05`"));
    let unknown = answer(here, &["measures", "run.mcap", "--rating", "euro-ncap-2027"]);
    assert!(code(&unknown) == 2 && err(&unknown).contains("euro-ncap-2026-full-width"));
    assert_eq!(code(&answer(here, &["measures", "--rating", FULL_WIDTH])), 2);
    assert_eq!(code(&answer(here, &["measures", "run.mcap", "--place", "driver"])), 2);
}

/// A person in a car: all that is measured is rated, the rest is blank with its reason, and words say what he is not.
#[test]
fn a_run_is_rated_as_far_as_it_measures() {
    let folder = folder_with_case();
    let here = folder.path();
    let run = answer(here, &["run", "case.toml", "-o", "run.mcap", "--set", "time.end=0.12", "-q"]);
    assert_eq!(code(&run), 0, "{}", err(&run));
    let told = rate(here, &["run.mcap", "--rating", "us-ncap-frontal"]);
    let result = &told["results"][0];
    let notes = result["notes"].to_string();
    assert!(notes.contains("a person's body") && notes.contains("Frontal impact"), "{notes}");
    let driver = first(&told);
    assert_eq!(driver["dummy"], "Hybrid III 50M");
    let chest = &driver["regions"][2]["criteria"][0];
    assert!(chest["value"].is_null() && chest["remark"].as_str().unwrap().contains("rigid"), "{chest}");
    let measures = rate(here, &["run.mcap"]);
    let hic = measures["measures"].as_array().unwrap().iter().find(|m| m["name"] == "hic15").unwrap();
    assert_eq!(driver["regions"][0]["criteria"][0]["value"], hic["value"]);
    let risk = hic["risks"].as_array().unwrap().iter().find(|risk| risk["injury"] == "head AIS3+").unwrap();
    let rated = driver["regions"][0]["result"]["now"].as_f64().unwrap();
    assert!((rated - risk["probability"].as_f64().unwrap()).abs() < 1e-12);
    // no dummy of its size in this test: the first, with a word; and chosen by place
    let wrong = rate(here, &["run.mcap", "--rating", FULL_WIDTH]);
    assert_eq!((&first(&wrong)["seat"], &first(&wrong)["dummy"]), (&Value::from("Driver"), &Value::from("HIII-05")));
    assert!(wrong["results"][0]["notes"].to_string().contains("the dummy of the protocol is the HIII-05"));
    let placed = rate(here, &["run.mcap", "--rating", FULL_WIDTH, "--place", "front passenger"]);
    assert_eq!(first(&placed)["dummy"], "THOR-50");
    let none = answer(here, &["measures", "run.mcap", "--rating", FULL_WIDTH, "--place", "roof"]);
    assert!(code(&none) == 2 && err(&none).contains("FWDB-35, Behind Passenger, HIII-05"), "{}", err(&none));
    let side = rate(here, &["run.mcap", "--rating", "un-r95"]);
    assert!(
        side["results"][0]["notes"].to_string().contains("the run is a frontal impact, the rating is of a side impact")
    );
    assert_eq!(first(&side)["result"]["now"], 0.0);
    // a colour is no measure; an answer for all cases is given once
    std::fs::write(here.join("car.csv"), "Body region,Criteria,Value\nHead,Countermeasure?,yes\n").unwrap();
    let far = ["run.mcap", "--rating", "euro-ncap-2026-far-side", "--place", "main-pole", "--values", "car.csv"];
    let far = rate(here, &far);
    let head = &first(&far)["regions"][0]["criteria"];
    assert!(head[0]["value"].is_number() && head[3]["remark"].as_str().unwrap().contains("lines of the car"), "{head}");
    assert_eq!((&head[4]["word"], &far["results"][0]["sum"]), (&"Yes".into(), &Value::Null));
    // two runs, and values beside measures
    let belt = "Body region,Criteria,Value\nChest & Abdomen,Shoulder belt load,7\n";
    std::fs::write(here.join("belt.csv"), belt).unwrap();
    let with =
        rate(here, &["run.mcap", "--rating", "euro-ncap-2026-sled", "--place", "sled-mid", "--values", "belt.csv"]);
    let load = &first(&with)["regions"][1]["criteria"][2];
    assert_eq!((&load["value"], &load["deducted"]), (&Value::from(7.0), &Value::from(40.0)));
    let words = ["run.mcap", "run.mcap", "--rating", "euro-ncap-2026-sled", "--place", "sled-mid driver"];
    let two = rate(here, &words);
    assert_eq!(two["results"].as_array().unwrap().len(), 2);
    assert!(first(&two)["result"]["best"].as_f64() > first(&two)["result"]["now"].as_f64());
    let text = out(&answer(here, &[&["measures"][..], &words[1..]].concat()));
    assert!(text.contains("Sled-Mid, Driver, HIII-50:") && text.contains("blank, "), "{text}");
}

/// Each body at its own place: one result with the sum of the test, written in the layout of the template and read
/// again.
#[test]
fn bodies_are_rated_together_and_fill_the_template() {
    let folder = folder_with_case();
    let here = folder.path();
    let run = answer(here, &["run", "case.toml", "-o", "run.mcap", "-q"]);
    assert_eq!(code(&run), 0, "{}", err(&run));
    // a step that is too long marks every figure
    let coarse =
        ["run", "case.toml", "-o", "coarse.mcap", "--set", "time.end=0.12", "--set", "integrator.step=1 ms", "-q"];
    assert!(code(&answer(here, &coarse)) < 2 && here.join("coarse.mcap").exists());
    let rating = ["--rating", "euro-ncap-full-width", "-o", "filled.csv"];
    let both = ["run.mcap", "coarse.mcap", "--place", "driver", "--place", "rear passenger"];
    let told = rate(here, &[&both[..], &rating].concat());
    assert_eq!(told["results"].as_array().unwrap().len(), 1);
    let test = &told["results"][0]["tests"][0];
    let seats = test["occupants"].as_array().unwrap();
    let heads = [0, 1].map(|seat: usize| seats[seat]["regions"][0]["doubtful"].as_bool().unwrap());
    assert_eq!((heads, &seats[1]["doubtful"]), ([false, true], &Value::from(true)));
    let sum: f64 = seats.iter().map(|seat| seat["result"]["now"].as_f64().unwrap()).sum();
    assert!((test["result"]["now"].as_f64().unwrap() - 0.25 * sum).abs() < 1e-12 && test["result"]["of"] == 8.0);
    let text = out(&answer(here, &[&["measures"], &both[..], &rating[..2]].concat()));
    assert!(text.contains("Rear Passenger, HIII-05: ! ") && text.contains("full width, 50 km/h: "), "{text}");
    // the file has all criteria, and its values are rated alike
    let again = rate(here, &["--rating", "euro-ncap-full-width", "--values", "filled.csv"]);
    assert_eq!(again["results"][0]["tests"][0]["result"], test["result"]);
    // a workbook too, and sheets of other tests between
    let book = [&["measures"], &both[..], &rating[..2], &["-o", "filled.xlsx"]].concat();
    assert_eq!(code(&answer(here, &book)), 0);
    let filled = std::fs::read_to_string(here.join("filled.csv")).unwrap();
    let other = format!("Other\n{}\nPole,Driver,WorldSID,Head,HIC15,9,,\nOwn\n", filled.lines().next().unwrap());
    std::fs::write(here.join("sheets.csv"), other + &filled).unwrap();
    for name in ["filled.xlsx", "sheets.csv"] {
        let again = rate(here, &["--rating", "euro-ncap-full-width", "--values", name]);
        assert_eq!(again["results"][0]["tests"][0]["result"], test["result"], "{name}");
    }
    let words = [&["measures"], &both[..], &rating].concat();
    assert!(code(&answer(here, &words)) != 0, "the file is there already");
    for (places, found) in [
        (&["driver", "driver"][..], "two bodies are Driver, HIII-05"),
        (&["driver", "hiii-05"], "2 occupants have this name"),
        (&["driver", "driver", "driver"], "2 bodies, but --place 3 times"),
    ] {
        let places: Vec<&str> = places.iter().flat_map(|place| ["--place", place]).collect();
        let output = answer(here, &[&["measures", "run.mcap", "run.mcap"], &rating[..2], &places].concat());
        assert!(code(&output) == 2 && err(&output).contains(found), "{found}: {}", err(&output));
    }
}

/// A test in a table: HIC15 361 of a half sine of 60 g, 40 mm, both femurs.
#[test]
fn a_test_is_rated_as_a_run_is() {
    let folder = folder_with_case();
    let here = folder.path();
    let columns =
        [("head.acceleration.resultant[g]", 60.0), ("chest.deflection[mm]", 40.0), ("left_femur.axial[kN]", -5.0)];
    table(&here.join("test.csv"), &columns);
    let told = rate(here, &["test.csv", "--rating", "fmvss-208"]);
    let own = first(&told);
    let words = |region: usize| own["regions"][region]["result"]["words"].as_str().unwrap().to_owned();
    assert_eq!([words(0), words(1), words(2), words(3)], ["met", "open", "open", "open"]);
    assert!((own["regions"][0]["criteria"][0]["value"].as_f64().unwrap() - 361.36).abs() < 0.01);
    assert_eq!(own["regions"][2]["criteria"][1]["scale"], "≤ 63");
    let female = rate(here, &["test.csv", "--rating", "euro-ncap-full-width", "--dummy", "hybrid-iii-5f"]);
    // 40 mm are beyond the cap of 34 mm
    let seats = female["results"][0]["tests"][0]["occupants"].as_array().unwrap();
    assert!(seats.len() == 2 && seats.iter().all(|seat| seat["capped"] == true));
    assert_eq!(code(&answer(here, &["measures", "test.csv", "--rating", "fmvss-208", "--strict"])), 0);
}

/// The calculator of Euro NCAP, where it is installed; `official_ratings.py OCCUPANT 1000` is the whole proof.
#[test]
#[allow(clippy::print_stderr, reason = "says that it is skipped")]
fn points_equal_those_of_the_official_calculator() {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/official_ratings.py");
    let program = assert_cmd::cargo::cargo_bin!("occupant");
    let Ok(output) = Command::new("python3").arg(script).arg(program).arg("5").output() else {
        eprintln!("skipped: no python3");
        return;
    };
    eprintln!("{}", out(&output));
    assert!(output.status.success(), "{}{}", out(&output), err(&output));
}

/// The two sled and three virtual cases: one sweep runs and rates ten bodies, as `measures` rates its runs.
#[test]
fn the_shipped_cases_fill_the_template() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let study = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/studies/euro-ncap-cases/cases.toml");
    let swept = answer(here, &["sweep", study, "-o", "out"]);
    assert_eq!(code(&swept), 0, "{}", err(&swept));
    let runs: Vec<String> = (0..5).map(|run| format!("out/runs/00000{run}.mcap")).collect();
    let written: toml_edit::DocumentMut = std::fs::read_to_string(study).unwrap().parse().unwrap();
    let places = written["rating"]["places"].as_array().unwrap();
    assert_eq!(places.len(), 10);
    let runs = runs.iter().map(String::as_str);
    let places = places.iter().flat_map(|place| ["--place", place.as_str().unwrap()]);
    let words: Vec<&str> = runs.chain(["--rating", "euro-ncap-2026-sled", "-o", "filled.xlsx"]).chain(places).collect();
    let mut told = rate(here, &words);
    let mut own: Value = serde_json::from_slice(&std::fs::read(here.join("out/rating.json")).unwrap()).unwrap();
    assert_eq!(own["results"][0]["tests"], told["results"][0]["tests"]);
    for answer in [&mut told, &mut own] {
        // the folder's own names its runs relative to it, and notes are in its units
        answer["results"] = Value::Null;
    }
    assert_eq!(own, told);
    let [ours, by_hand] = ["out/rating.xlsx", "filled.xlsx"].map(|name| std::fs::read(here.join(name)).unwrap());
    assert!(ours == by_hand, "other bytes");
    let again = rate(here, &["--rating", "euro-ncap-2026-sled", "--values", "out/rating.xlsx"]);
    let test = &again["results"][0]["tests"][0];
    assert_eq!(test["occupants"].as_array().unwrap().len(), 10);
    let [now, best] = ["now", "best"].map(|end| test["result"][end].as_f64().unwrap());
    assert!(0.0 < now && now < best && best <= 10.0, "{now} {best}");
    assert!(out(&swept).contains(test["result"]["words"].as_str().unwrap()), "{}", out(&swept));
}
