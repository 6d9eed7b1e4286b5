//! Records of other programs: `occupant import`, and the commands of its page.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use crate::common::{answer, done, err, spoken};
#[cfg(unix)]
use crate::pages::run_page;

/// A half sine of 0.1 s.
fn pulse(t: f64) -> f64 {
    if (0.0..0.1).contains(&t) { (PI * t / 0.1).sin() } else { 0.0 }
}

fn rows(line: impl Fn(f64) -> String) -> String {
    (-20..150).map(|i| line(f64::from(i) * 1e-3)).collect()
}

/// A test in NHTSA's form: of a vehicle, one sensor of its dummy twice, one that was not there, a belt.
fn nhtsa(folder: &Path) {
    fs::create_dir(folder).unwrap();
    let curve = |number: u32, what: &str, unit: &str, redundant: &str, words: &str| {
        format!("1|{number}|{what}|SEC|{unit}|2800|M|D|1|1|0|-20|149|1000|AM|{redundant}|{words}\n")
    };
    let mut record =
        "# Source: made up\n----- EV5 -----\n----- TEST -----\nV5|A CAR \"X\" INTO A WALL|T|D\n----- VEHICLE -----\n"
            .to_owned();
    record += &format!("1|{}48.3|0\n----- INSTRUMENTATION -----\n", "0|".repeat(40));
    let curves = [
        ("AC|01|HDCG|XL", "G'S", "P", -40.0),
        ("AC|01|HDCG|XL", "G'S", "R", -39.0),
        ("LC|01|SHBT|NA", "NWT", "P", 5000.0),
        ("AC|NA|VECG|XG", "G'S", "P", -21.0),
        ("AC|NA|DSLF|XG", "G'S", "P", -22.0),
        ("AC|02|HDCG|XL", "G'S", "P", -35.0),
    ];
    for (number, (what, unit, redundant, size)) in (1..).zip(curves) {
        record += &curve(number, what, unit, redundant, "SOME WORDS");
        let lines = rows(|t| format!("{t:.6}\t{:.5}\n", size * pulse(t)));
        fs::write(folder.join(format!("v00001.{number:03}")), lines).unwrap();
    }
    record += &curve(7, "LC|01|LPBO|NA", "NWT", "P", "LAP BELT: Not installed");
    fs::write(folder.join("v00001.EV5"), record + "----- END -----\n").unwrap();
}

/// A folder with a record of each kind.
pub(crate) fn files() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    nhtsa(&here.join("v00001"));
    let vertex = |i: u32| {
        format!(
            "<Vertex time=\"{}\"><Position><WorldPosition x=\"{i}\" y=\"{}\" h=\"0.1\"/></Position></Vertex>\n",
            f64::from(i) / 10.0,
            i * i
        )
    };
    let vertices: String = (0..6).map(vertex).collect();
    let xosc = format!(
        "<OpenSCENARIO><ManeuverGroup><Actors><EntityRef entityRef=\"Ego\"/></Actors><Trajectory name=\"t\"><Shape><Polyline>\n\
         {vertices}</Polyline></Shape></Trajectory></ManeuverGroup></OpenSCENARIO>"
    );
    fs::write(here.join("ego.xosc"), xosc).unwrap();
    let mut log =
        "Version: 2, OpenDRIVE: a, 3DModel: b\ntime, id, name, x, y, z, h, p, r, speed, wheel_angle, wheel_rot\n"
            .to_owned();
    for i in 0..6 {
        for (id, name) in [(0, "Ego"), (1, "Target")] {
            log += &format!("{:.3}, {id}, {name}, {i}, {id}, 0, 0.01, 0, 0, 10, 0, 0\n", f64::from(i) / 10.0);
        }
    }
    fs::write(here.join("log.csv"), log).unwrap();
    let changes: String = (0..16).map(|i| format!("{};{},5\n", 10 * i, -3 * i)).collect();
    fs::write(here.join("recorder.csv"), format!("Time (ms);Delta-V longitudinal (km/h)\n{changes}")).unwrap();
    let clock = rows(|t| format!("{};10:00;{:.4};0\n", t * 1e3, -20.0 * pulse(t)));
    fs::write(here.join("clock.csv"), format!("zeit;clock;long;gier\n{clock}")).unwrap();
    folder
}

/// The commands of the page, one after the other, and what stands in its TOML.
#[cfg(unix)]
#[test]
fn the_commands_of_the_page_run() {
    let folder = files();
    let page = include_str!("../docs/records.md");
    assert_eq!(run_page(folder.path(), page), 9);
    let section = page.split("```toml\n").nth(1).unwrap().split("```").next().unwrap();
    let rec_tec = "Time,XPos,YPos,ZPos,Pitch,Roll,Yaw\n0,0,0,0,0,0,0\n1,10,0,0,0,0,10\n2,20,0,0,0,0,20\n";
    fs::write(folder.path().join("rec-tec.csv"), rec_tec).unwrap();
    let scenario = fs::read_to_string(folder.path().join("crash.toml")).unwrap();
    let (before, rest) = scenario.split_once("[path]").unwrap();
    let after = &rest[rest.find("\n[").unwrap()..];
    fs::write(folder.path().join("other.toml"), format!("{before}{section}{after}")).unwrap();
    done(folder.path(), &["check", "other.toml"]);
}

#[test]
fn a_test_of_nhtsa_becomes_a_path_a_scenario_and_curves() {
    let folder = files();
    let here = folder.path();
    let said = spoken(here, &["import", "v00001", "-o", "crash.toml"]);
    for words in [
        "note: curve 007, LAP BELT: Not installed, has no file: left out",
        "wrote crash-path.csv: accelerations and rates of the centre of gravity, 170 times",
        "wrote crash.toml",
        "wrote crash-curves.csv: 5 signals",
        "next: occupant run crash.toml\n      occupant compare crash.mcap crash-curves.csv",
    ] {
        assert!(said.contains(words), "{said}");
    }
    let read = |name: &str| fs::read_to_string(here.join(name)).unwrap();
    assert!(read("crash-path.csv").starts_with("t[s],ax[g]\n-0.02,0\n"), "{}", read("crash-path.csv"));
    let heads = "t[s],11HEADCG0000ACX0[g],01_HDCG_XL_AC_redundant[g],11SEBE0000B3FO00[N],NA_DSLF_XG_AC[g],13HEADCG0000ACX0[g]\n";
    assert!(read("crash-curves.csv").starts_with(heads), "{}", read("crash-curves.csv"));
    let scenario = read("crash.toml");
    assert!(
        scenario.contains("title = 'A CAR \"X\" INTO A WALL'") && scenario.contains("speed = \"48.3 km/h\""),
        "{scenario}"
    );
    assert!(scenario.contains("start = \"0 ms\"") && scenario.contains("gravity = \"removed\""), "{scenario}");
    done(here, &["run", "crash.toml", "--quiet", "--set", "time.end=0.12"]);
    // the folder itself is a test too, and its signals are those of the table
    let rated = |test: &str, seat: &str| done(here, &["compare", "crash.mcap", test, "--seat", seat, "--json"]);
    for seat in ["1", "3"] {
        let pairs = |test: &str| {
            let answer: serde_json::Value = serde_json::from_str(&rated(test, seat)).unwrap();
            let pairs = answer["pairs"].as_array().unwrap().clone();
            pairs.iter().map(|p| (p["channel"].clone(), p["iso18571"]["overall"].clone())).collect::<Vec<_>>()
        };
        let table = pairs("crash-curves.csv");
        assert!(!table.is_empty() && table.iter().all(|pair| pairs("v00001").contains(pair)), "{table:?}");
    }
    let refused = answer(here, &["import", "v00001", "-o", "crash.toml"]);
    assert!(err(&refused).contains("--force"), "{}", err(&refused));
}

#[test]
fn trajectories_and_recorders_become_paths() {
    let folder = files();
    let here = folder.path();
    spoken(here, &["import", "ego.xosc", "--cg", "1.3 m"]);
    let read = |name: &str| fs::read_to_string(here.join(name)).unwrap();
    assert!(
        read("ego-path.csv")
            .starts_with("t[s],x[m],y[m],z[m],roll[rad],pitch[rad],yaw[rad]\n0,0,0,0,0,0,0.1\n0.1,1,1,")
    );
    assert!(read("ego.toml").contains("axes = \"z_up\"") && read("ego.toml").contains("offset = [\"-1.3 m\", 0, 0]"));
    spoken(here, &["import", "log.csv", "--object", "Target", "-o", "target.toml"]);
    assert!(read("target-path.csv").contains("\n0.5,5,1,0,0,0,0.01\n"), "{}", read("target-path.csv"));
    spoken(here, &["import", "recorder.csv", "--speed", "45 km/h", "-f"]);
    assert!(
        read("recorder-path.csv").contains("t[s],dvx[km/h]\n0,0.5\n")
            || read("recorder-path.csv").contains("\n0.01,-3.5\n")
    );
    assert!(read("recorder.toml").contains("speed = \"45 km/h\""));
    done(here, &["run", "recorder.toml", "--quiet", "--until", "20 ms", "--no-mcap"]);
}

#[test]
fn what_is_wrong_with_a_record_is_said_with_its_place() {
    let folder = files();
    let here = folder.path();
    fs::write(here.join("v00001/v00001.003"), "0.0\t1\n0.1\tx\n").unwrap();
    let record = fs::read_to_string(here.join("v00001/v00001.EV5")).unwrap();
    fs::create_dir(here.join("v00002")).unwrap();
    fs::write(here.join("v00002/v00002.EV5"), record.replace("1|2|AC", "1|../2|AC")).unwrap();
    fs::write(here.join("nurbs.xosc"), "<a>\n<Trajectory name=\"t\"><Shape><Nurbs/></Shape></Trajectory></a>").unwrap();
    fs::write(here.join("odd.csv"), "t[s],ax,b[N]\n0,1,2\n1,1,2\n").unwrap();
    for (words, expected) in [
        (vec!["import", "v00001"], "v00001.003:2\n = expected a time and a value"),
        (vec!["import", "v00002"], "a curve numbered `../2`"),
        (vec!["import", "v00001", "--vehicle", "2"], "no curve of vehicle 2"),
        (vec!["import", "log.csv"], "2 objects\n --> log.csv\n = expected `Ego` or `Target`"),
        (vec!["import", "log.csv", "--object", "Nobody"], "no object `Nobody`"),
        (vec!["import", "nurbs.xosc"], "a Nurbs\n --> nurbs.xosc:2"),
        (vec!["import", "odd.csv"], "ax has no unit that is known"),
        (vec!["import", "ego.xosc", "--at", "SILL"], "no such place of the vehicle"),
        (vec!["import", "ego.xosc", "--cg", "-1"], "--cg"),
        (vec!["import", "none.csv"], "none.csv"),
    ] {
        let found = answer(here, &words);
        assert_eq!(found.status.code(), Some(2), "{words:?}");
        assert!(err(&found).contains(expected), "{}", err(&found));
    }
}
