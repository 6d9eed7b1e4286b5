use std::f64::consts::PI;
use std::path::Path;

use super::{answer, code, err, folder_with_case, json, out};

/// A table at 10 kHz of half a sine of 40 ms from 10 ms on in each of these columns.
pub(super) fn table(path: &Path, columns: &[(&str, f64)]) {
    let mut text = String::from("t[ms]");
    columns.iter().for_each(|(heading, _)| text += &format!(",{heading}"));
    for i in 0..800 {
        let t = f64::from(i) * 1e-4 - 0.01;
        let shape = if (0.0..0.04).contains(&t) { (PI * t / 0.04).sin() } else { 0.0 };
        text += &format!("\n{:.1}", f64::from(i) * 0.1);
        columns.iter().for_each(|(_, peak)| text += &format!(",{}", peak * shape));
    }
    std::fs::write(path, text + "\n").unwrap();
}

/// The measures of a test by hand: HIC15 361, 40 mm of 229, VC = 1.3·A²π/(2·T·D_c), tibia 90/225 + 3.59/35.9.
#[test]
fn a_table_of_a_test_has_the_measures_of_what_it_reads() {
    let folder = folder_with_case();
    let columns = [
        ("head.acceleration.x[g]", -60.0),
        ("head.acceleration.y[g]", 0.0),
        ("head.acceleration.z[g]", 0.0),
        ("11CHST0000H3DSXC[mm]", -40.0),
        ("shin moment[N*m]", 90.0),
        ("left_tibia.upper.moment.x[N*m]", 0.0),
        ("left_tibia.upper.force.z[kN]", -3.59),
        // a resultant alone will do
        ("upper_torso.acceleration.resultant[g]", 30.0),
        ("11NECKUP00H3FOZA[kN]", 2.0),
        // another seat's
        ("13PELV0000H3ACRC[g]", 50.0),
    ];
    table(&folder.path().join("test.csv"), &columns);
    let map = ["--map", "shin moment=left_tibia.upper.moment.y"];
    let said = |words: &[&str]| answer(folder.path(), &[&["measures", "test.csv"], &map[..], words].concat());
    let told = json(&said(&["--json"]));
    let value = |name: &str| {
        let found = told["measures"].as_array().unwrap().iter().find(|m| m["name"] == name);
        found.unwrap_or_else(|| panic!("no {name} in {told:#}"))["value"].as_f64().unwrap()
    };
    let near =
        |name: &str, expected: f64| assert!((value(name) / expected - 1.0).abs() < 1e-4, "{name}: {}", value(name));
    near("hic15", 361.3591);
    near("chest_deflection", 0.040);
    near("chest_compression", 0.040 / 0.229);
    near("viscous_criterion", 1.3 * 0.0016 * PI / (2.0 * 0.04 * 0.229));
    near("left_tibia_index", 0.5);
    near("chest_peak", 30.0 * 9.80665);
    near("neck_tension", 2000.0);
    assert_eq!((&told["dummy"], told["signals"].as_array().unwrap().len()), (&"Hybrid III 50M".into(), 9));
    assert_eq!(told["covers_s"][0], 0.0);
    assert_eq!(json(&said(&["--json", "--shift", "-10 ms"]))["covers_s"][0], -0.01);
    let seat_3 = json(&said(&["--json", "--seat", "3"]));
    assert!(seat_3["signals"].as_array().unwrap().iter().any(|pair| pair[1] == "13PELV0000H3ACRC"), "{seat_3:#}");
    let text = out(&said(&[]));
    assert!(text.contains("chest.deflection: 11CHST0000H3DSXC") && text.contains("samples every 0.1 ms"), "{text}");
    // what it does not read is not there
    assert!(!text.contains("pelvis") && !text.contains("Nij") && !text.contains("rigid"), "{text}");
    assert_eq!(code(&said(&["--strict"])), 0);
    // 63 mm of FMVSS 208 are 40, 34 mm of Euro NCAP are not
    assert_eq!(code(&said(&["--strict", "--dummy", "hybrid-iii-5f"])), 1);
    let side = out(&said(&["--dummy", "worldsid-50m"]));
    assert!(side.contains("the WorldSID 50M has no such criterion") && !side.contains("FMVSS 208"), "{side}");
    assert!(out(&said(&["--filter", "j211"])).contains("filtered by"));
    let both = out(&answer(folder.path(), &[&["measures", "test.csv", "test.csv"], &map[..]].concat()));
    assert!(both.contains("\n2  test.csv, samples every 0.1 ms"), "{both}");
}

#[test]
fn a_signal_with_holes_is_left_out_and_said_to_be() {
    let folder = folder_with_case();
    let file = folder.path().join("test.csv");
    table(&file, &[("head.acceleration.resultant[g]", 60.0), ("chest.deflection[mm]", 40.0)]);
    let text = std::fs::read_to_string(&file).unwrap();
    let holed: String = text
        .lines()
        .enumerate()
        .map(|(i, line)| match i {
            // the line of 0.7 ms
            8 => line.rsplit_once(',').unwrap().0.to_owned() + ",NaN\n",
            _ => line.to_owned() + "\n",
        })
        .collect();
    std::fs::write(&file, holed).unwrap();
    let output = answer(folder.path(), &["measures", "test.csv"]);
    assert!(err(&output).contains("1 of its 800 values are missing, the first at 0.7 ms"), "{}", err(&output));
    assert!(out(&output).contains("HIC15") && !out(&output).contains("chest deflection"), "{}", out(&output));
}

#[test]
fn what_a_test_cannot_give_is_refused_with_its_mend() {
    let folder = folder_with_case();
    let file = folder.path().join("test.csv");
    table(&file, &[("thing[g]", 1.0)]);
    let uneven = "t[ms],head.acceleration.resultant[g]\n0,1\n1,2\n2,3\n5,4\n6,4\n";
    std::fs::write(folder.path().join("uneven.csv"), uneven).unwrap();
    for (words, expected) in [
        (&["measures", "test.csv"][..], "no signal for any injury measure"),
        (&["measures", "test.csv", "--map", "thing=chest.deflexion"], "chest.upper_left.deflection"),
        (&["measures", "test.csv", "--map", "thing=chest.deflection"], "thing is in g"),
        (&["measures", "test.csv", "--map", "other=chest.deflection"], "no column `other`"),
        (&["measures", "test.csv", "--interval", "1 ms"], "cannot be run again"),
        (&["measures", "test.csv", "run.mcap"], "give only runs or only tests"),
        (&["measures", "none.csv"], "none.csv"),
        (&["measures", "uneven.csv"], "constant sample interval"),
    ] {
        let output = answer(folder.path(), words);
        assert_eq!(code(&output), 2, "{words:?}: {}", err(&output));
        assert!(err(&output).contains(expected), "{words:?}: {}", err(&output));
    }
}

/// Limits are made for dummies: a person's body gets no verdict, but a dummy's and one that is asked for.
#[test]
fn people_are_judged_only_if_asked() {
    let folder = folder_with_case();
    let run = |file: &str, set: &[&str]| {
        let words = [&["run", "case.toml", "--quiet", "-o", file], set].concat();
        assert_eq!(code(&answer(folder.path(), &words)), 0);
    };
    run("person.mcap", &[]);
    let said = |words: &[&str]| out(&answer(folder.path(), &[&["measures"], words].concat()));
    let (plain, asked) = (said(&["person.mcap"]), said(&["person.mcap", "--verdict"]));
    let is_judged =
        |text: &str| text.lines().any(|line| ["EXCEEDED", "% passed"].iter().any(|end| line.ends_with(end)));
    assert!(!is_judged(&plain) && plain.contains("a dummy, FMVSS 208"), "{plain}");
    assert!(is_judged(&asked) && !asked.contains("a dummy, FMVSS 208"), "{asked}");
    run("dummy.mcap", &["--set", "body.chest=\"dummy50\"", "--set", "time.end=60 ms"]);
    let dummy = said(&["dummy.mcap"]);
    assert!(is_judged(&dummy) && dummy.contains("FMVSS 208") && !dummy.contains("a dummy, FMVSS 208"), "{dummy}");
}

/// A blow from the side is judged by rules for the side, also for a body without ribs; a rollover by none of a test.
#[test]
fn rules_are_those_for_the_direction_of_the_impact() {
    let folder = folder_with_case();
    let said = |set: &[&str]| {
        let sets = set.iter().flat_map(|one| ["--set", one]);
        let words: Vec<&str> =
            ["run", "case.toml", "--quiet", "--force", "-o", "run.mcap"].into_iter().chain(sets).collect();
        let ran = answer(folder.path(), &words);
        assert_eq!(code(&ran), 0, "{}", err(&ran));
        let measures = answer(folder.path(), &["measures", "run.mcap", "--json"]);
        let told = json(&measures);
        let rules: Vec<String> = told["measures"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|m| m["limits"].as_array().unwrap())
            .map(|limit| limit["rule"].as_str().unwrap().to_owned())
            .collect();
        (told["notes"].to_string(), rules)
    };
    let (why, rules) = said(&["time.end=80 ms"]);
    assert!(why.contains("Frontal impact") && rules.iter().any(|rule| rule == "FMVSS 208"), "{why} {rules:?}");
    let (why, rules) = said(&["time.end=80 ms", "path.direction=[0, 1, 0]"]);
    assert!(why.contains("Side impact from the right"), "{why}");
    assert!(rules.iter().any(|rule| rule == "UN R95") && !rules.iter().any(|rule| rule == "FMVSS 208"), "{rules:?}");
}
