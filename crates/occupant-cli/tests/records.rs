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
    let report =
        "Impact: frontal\nDriver belt: Buckled\n\nTime (ms),Delta-V longitudinal (km/h)\n0,0\n50,20\n100,41\n150,41\n";
    fs::write(here.join("report.csv"), report).unwrap();
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
    assert_eq!(run_page(folder.path(), page), 11);
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
        "note: curve 007, LAP BELT: Not installed, has no file: skipped",
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

/// Tables of programs that name no units: commas or blanks between cells, a number behind the headings of the second car.
#[test]
fn headings_tell_which_program_wrote_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let rec_tec = |gap: &str, vehicle: &str, end: &str| {
        let heads = ["Time", "XPos", "YPos", "ZPos", "Pitch", "Roll", "Yaw"].map(|head| head.to_owned());
        let mut text = heads.map(|head| if head == "Time" { head } else { head + vehicle }).join(gap) + end;
        for i in 0..5 {
            let t = f64::from(i) * 0.033;
            let cells = [t, 44.0 * t, 0.5, -1.25, 1.0, 2.0, 3.0].map(|x| format!("{x:.3}"));
            text += &(cells.join(gap) + end);
        }
        text
    };
    fs::write(here.join("SmacRT1C.csv"), rec_tec(",", "", "\n")).unwrap();
    fs::write(here.join("SmacRT2S.asc"), rec_tec("   ", "2", "\r\n")).unwrap();
    let heads = "t[s],x[ft],y[ft],z[ft],roll[deg],pitch[deg],yaw[deg]\n0,0,0.5,-1.25,2,1,3\n0.033,1.452,";
    for name in ["SmacRT1C.csv", "SmacRT2S.asc"] {
        let said = spoken(here, &["import", name]);
        for words in ["no units: feet and degrees are assumed", "y right and z down are assumed"] {
            assert!(said.contains(words), "{said}");
        }
        let stem = &name[..8];
        let path = fs::read_to_string(here.join(format!("{stem}-path.csv"))).unwrap();
        assert!(path.starts_with(heads), "{path}");
        let scenario = fs::read_to_string(here.join(format!("{stem}.toml"))).unwrap();
        assert!(!scenario.contains("z_up"), "{scenario}");
        assert!(done(here, &["check", &format!("{stem}.toml")]).contains("13.411 m/s at the start"));
    }
    let car = "Time;Car.Yaw [rad];Car.tx [m];Car.ty [m];Car.tz [m];Car.v;Car.Roll [rad];Car.Pitch [rad]\n\
               0;0.1;0;0;0.2;10;0;0\n0.1;0.1;1;0.1;0.2;10;0;0\n0.2;0.1;2;0.2;0.2;10;0;0\n";
    fs::write(here.join("car.csv"), car).unwrap();
    let said = spoken(here, &["import", "car.csv"]);
    assert!(said.contains("CarMaker"), "{said}");
    assert!(!spoken(here, &["import", "car.csv", "-f", "--cg", "2 m"]).contains("CarMaker"));
    let path = fs::read_to_string(here.join("car-path.csv")).unwrap();
    assert!(path.starts_with("t[s],x[m],y[m],z[m],roll[rad],pitch[rad],yaw[rad]\n0,0,0,0.2,0,0,0.1\n"), "{path}");
    assert!(fs::read_to_string(here.join("car.toml")).unwrap().contains("axes = \"z_up\""));
    fs::write(here.join("cut.csv"), rec_tec(",", "", "\n").replace("0.066,", "0.066,a")).unwrap();
    let found = answer(here, &["import", "cut.csv"]);
    assert!(err(&found).contains("cut.csv:4\n = expected numbers for time, xpos"), "{}", err(&found));
}

/// Units that stand in the headings, or below them, are those of the path.
#[test]
fn headings_of_known_programs_tell_their_units() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let imported = |name: &str, text: &str| {
        fs::write(here.join(name), text).unwrap();
        let said = spoken(here, &["import", name, "-f"]);
        let stem = name.split('.').next().unwrap();
        assert!(done(here, &["check", &format!("{stem}.toml")]).contains("10.000 m/s at the start"), "{text}");
        (said, fs::read_to_string(here.join(format!("{stem}-path.csv"))).unwrap())
    };
    let heads = "Time[ms],XPos[m],YPos[m],ZPos[m],Pitch (rad),Roll (rad),Yaw (rad)\n";
    let (said, path) =
        imported("metric.csv", &format!("{heads}0,0,0,0,0,0,0.1\n100,1,0,0,0,0,0.1\n200,2,0,0,0,0,0.1\n"));
    assert!(path.starts_with("t[s],x[m],y[m],z[m],roll[rad],pitch[rad],yaw[rad]\n0,0,0,0,0,0,0.1\n0.1,1,"), "{path}");
    assert!(!said.contains("feet") && said.contains("z down"), "{said}");
    let below =
        "Time;XPos;YPos;ZPos;Pitch;Roll;Yaw\ns;m;m;m;deg;deg;deg\n0,0;0;0;0;0;0;1\n0,1;1;0;0;0;0;1\n0,2;2;0;0;0;0;1\n";
    let (said, path) = imported("below.csv", below);
    assert!(
        path.starts_with("t[s],x[m],y[m],z[m],roll[deg],pitch[deg],yaw[deg]\n") && !said.contains("feet"),
        "{said}{path}"
    );
    let car = "Time Car.tx[km] Car.ty Car.tz Car.Yaw [deg] Car.Pitch Car.Roll\n0 0 0 0 5 0 0\n0.1 0.001 0 0 5 0 0\n0.2 0.002 0 0 5 0 0\n";
    let (_, path) = imported("car.csv", car);
    assert!(path.starts_with("t[s],x[km],y[m],z[m],roll[rad],pitch[rad],yaw[deg]\n0,0,0,0,0,0,5\n"), "{path}");
    for (heading, odd) in [("XPos[m]", "XPos[kg]"), ("Time[ms]", "Time[m]"), ("Yaw (rad)", "Yaw (turnips)")] {
        fs::write(here.join("odd.csv"), heads.replace(heading, odd) + "0,0,0,0,0,0,0\n100,1,0,0,0,0,0\n").unwrap();
        let found = answer(here, &["import", "odd.csv"]);
        assert_eq!(found.status.code(), Some(2));
        assert!(err(&found).contains(&format!("as the unit of `{odd}`\n --> odd.csv:1\n")), "{}", err(&found));
    }
}

/// A channel that may be the longitudinal motion is never omitted without a message.
#[test]
fn a_path_without_forward_motion_names_what_was_left_out() {
    let folder = files();
    let here = folder.path();
    let rows = "0,0,0\n50,-15,1\n100,-29,3\n";
    let path = || fs::read_to_string(here.join("edr-path.csv")).unwrap();
    for heading in ["Longitudinal Crash Pulse Delta-V (mph)", "SDM Recorded Vehicle Velocity Change (MPH)"] {
        fs::write(here.join("edr.csv"), format!("Time (ms),{heading},Lateral Delta-V (mph)\n{rows}")).unwrap();
        let said = spoken(here, &["import", "edr.csv", "-f", "--speed", "40 mph"]);
        assert!(path().contains("dvx[") && path().contains("dvy["), "{heading}: {}", path());
        assert!(!said.contains("no motion along x"), "{said}");
    }
    fs::write(here.join("edr.csv"), format!("Time (ms),Mystery (mph),Lateral Delta-V (mph)\n{rows}")).unwrap();
    let said = spoken(here, &["import", "edr.csv", "-f", "--speed", "40 mph"]);
    assert!(said.contains("the path has no motion along x") && said.contains("`Mystery`"), "{said}");
    let refused = answer(here, &["import", "edr.csv", "-f", "--speed", "40"]);
    let said = err(&refused);
    assert!(said.contains("--speed: `40` has no unit") && said.contains("'50 km/h'"), "{said}");
}

#[test]
fn the_vehicle_that_is_asked_for_is_imported() {
    let folder = files();
    let here = folder.path();
    let text = "Time,XPos,YPos,ZPos,Pitch,Roll,Yaw,XPos2,YPos2,ZPos2,Pitch2,Roll2,Yaw2\n\
                0,0,0,0,0,0,0,90,0,0,0,0,9\n1,10,0,0,0,0,0,80,0,0,0,0,9\n2,20,0,0,0,0,0,70,0,0,0,0,9\n";
    fs::write(here.join("two.csv"), text).unwrap();
    let path = || fs::read_to_string(here.join("two-path.csv")).unwrap();
    let said = spoken(here, &["import", "two.csv"]);
    assert!(said.contains("the path is that of vehicle 1; choose another with --vehicle: 1, 2"), "{said}");
    assert!(path().contains("\n1,10,0,"), "{}", path());
    let said = spoken(here, &["import", "two.csv", "-f", "--vehicle", "2"]);
    assert!(path().contains("\n1,80,0,0,0,0,9\n") && !said.contains("choose another"), "{said}{}", path());
    for (file, expected) in [
        ("two.csv", "no vehicle 3\n --> two.csv\n = expected `1` or `2`"),
        ("recorder.csv", "no vehicle 3"),
        ("ego.xosc", "no vehicle 3"),
    ] {
        let found = answer(here, &["import", file, "-f", "--vehicle", "3"]);
        assert!(found.status.code() == Some(2) && err(&found).contains(expected), "{}", err(&found));
    }
}

/// A car that spins on, written between −180° and 180°, by a program that is known and by one that is not.
#[test]
fn angles_that_wrap_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    for heads in ["Time,XPos,YPos,ZPos,Pitch,Roll,Yaw", "t[s],x[ft],y[ft],z[ft],pitch[deg],roll[deg],yaw[deg]"] {
        let yaws = [100.0, 140.0, 179.5, -141.0, -100.0, -60.0, 0.0, 60.0, 120.0, 179.0, -160.0];
        let line = |(i, yaw): (usize, &f64)| format!("{:.1},{i},0,0,1,-2,{yaw}\n", i as f64 / 10.0);
        let lines: String = yaws.iter().enumerate().map(line).collect();
        fs::write(here.join("spin.csv"), format!("{heads}\n{lines}")).unwrap();
        let said = spoken(here, &["import", "spin.csv", "-f"]);
        assert!(said.contains("yaw jumped by more than half a turn: full turns were added"), "{said}");
        let path = fs::read_to_string(here.join("spin-path.csv")).unwrap();
        let last = |line: &str| line.rsplit(',').next().unwrap().parse::<f64>().unwrap();
        let found: Vec<f64> = path.lines().skip(1).map(last).collect();
        let whole = [100.0, 140.0, 179.5, 219.0, 260.0, 300.0, 360.0, 420.0, 480.0, 539.0, 560.0];
        assert!(found.len() == 11 && found.iter().zip(whole).all(|(a, b)| (a - b).abs() < 1e-9), "{path}");
        assert!(path.lines().nth(4).unwrap().contains(",-2,1,"), "{path}");
        done(here, &["check", "spin.toml"]);
    }
}

/// All sections that a record of NHTSA has, in the order and with the fields of its test reference guide (version 5); two sensors of one
/// name, one that fails on the way, one that was not there, barrier cells, line ends of Windows.
#[test]
fn a_whole_record_of_nhtsa_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().join("v99999ascii");
    fs::create_dir(&here).unwrap();
    let zeros = |n: usize| "0|".repeat(n);
    let vehicle = |number: u32, speed: &str, words: &str| {
        let about = "16|03|2018|M0|4S|VIN|4CIF|2.5|AF|1719|1514|2825|4896|1837|1246|UN|UNK|P|";
        let (before, damage) = (zeros(21), "0|0|DE|NA|NA|380|466|511|518|489|370|12FDEW2|1260|0|518");
        format!("{number}|{about}|{before}{speed}|{damage}|{}0|0|{words}\n", zeros(21))
    };
    let mut record = "# Source: made up\n# Date: <1/1/2020>\n----- EV5 -----\n----- TEST -----\n\
         V5|A CAR INTO A CAR|MADE UP|03/OCT/2017|X|C|R|NCA|VTV|CON|DRY|22|OTH|OTH|113.4|0|0|0|9|WORDS | AND MORE\n\
         ----- VEHICLE -----\n"
        .to_owned();
    record += &(vehicle(1, "57.09", "") + &vehicle(2, "0.0", "DPD1-6=CMM OF BUMPER"));
    record += "----- BARRIER -----\nR|LCB|0|0|CELLS\n----- OCCUPANT -----\n1|01|H3|0|M|0|0|H3|50|S/N 351|||312\n\
         ----- RESTRAINT -----\n1|01|1|3PT|BC|NA|\n----- INSTRUMENTATION -----\n";
    let curves = [
        (1, 1, "AC|01|HDCG|XL", "G'S", "AM|P", "HEAD X", Some(-40.0)),
        (1, 2, "AC|01|HDCG|XL", "G'S", "AM|R", "HEAD XR", Some(-41.0)),
        (1, 3, "LC|01|NEKU|XL", "NWM", "AM|P", "NECK MX", Some(7.0)),
        (1, 4, "LC|01|NEKU|XL", "NWT", "AM|P", "NECK FX", Some(300.0)),
        (1, 5, "LC|01|TBLU|ZL", "NWT", "AM|P", "TIBIA FZ", Some(900.0)),
        (1, 6, "LC|01|SHBT|NA", "NWT", "NO|P", "SHOULDER BELT: Not installed", None),
        (1, 10, "AC|NA|FLLR|XG", "G'S", "AM|P", "LEFT CROSSMEMBER X", Some(-36.0)),
        (1, 11, "AC|NA|FLLR|ZG", "G'S", "AM|P", "LEFT CROSSMEMBER Z", Some(4.0)),
        (1, 12, "AC|NA|ENGN|XG", "G'S", "AM|P", "TOP OF ENGINE X", Some(-60.0)),
        (1, 13, "AC|NA|ENGN|XG", "G'S", "CF|P", "BOTTOM OF ENGINE X: No valid data after 67ms", Some(-70.0)),
        (2, 14, "AC|NA|VECG|XG", "G'S", "AM|P", "THE OTHER CAR", Some(20.0)),
        (1, 100, "AV|01|HDCG|YL", "DPS", "AM|P", "HEAD RATE Y", Some(600.0)),
        (1, 101, "LC|NA|BR01|XG", "NWT", "AM|P", "BARRIER CELL", Some(1000.0)),
        (1, 102, "TP|NA|OTHR|NA", "CEN", "AM|P", "WARMTH", Some(21.0)),
    ];
    for (vehicle, number, what, unit, status, words, size) in curves {
        let maker = "MFG: X MODEL: Y, S/N: Z|11/AUG/2017|1200|4|57.09|-20|149|1000";
        record += &format!("{vehicle}|{number}|{what}|SEC|{unit}|2800|{maker}|{status}|{words}\n");
        if let Some(size) = size {
            let lines = rows(|t| {
                if number == 13 && t > 0.067 { String::new() } else { format!("{t:.6}\t{:.5}\r\n", size * pulse(t)) }
            });
            fs::write(here.join(format!("v99999.{number:03}")), lines).unwrap();
        }
    }
    record += "----- END -----\n";
    fs::write(here.join("v99999.EV5"), record.replace('\n', "\r\n")).unwrap();
    let said = spoken(folder.path(), &["import", "v99999ascii", "-o", "crash.toml"]);
    for words in [
        "note: curve 006, SHOULDER BELT: Not installed, has no file: skipped",
        "note: curve 013, BOTTOM OF ENGINE X: No valid data after 67ms, has the status CF",
        "note: locations on the vehicle disagree on its forward delta-v, km/h: FLLR -80.9, ENGN -134.8",
        "note: the path is that of FLLR, which has the least ringing; the locations do not agree on the delta-v; choose another with --at: FLLR, ENGN",
        "wrote crash-path.csv: accelerations at FLLR, 170 times",
        "wrote crash-curves.csv: 10 signals",
    ] {
        assert!(said.contains(words), "{said}");
    }
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("crash-path.csv").starts_with("t[s],ax[g],az[g]\n-0.02,0,0\n"), "{}", read("crash-path.csv"));
    assert!(
        read("crash.toml").contains("speed = \"57.09 km/h\"")
            && read("crash.toml").contains("title = \"A CAR INTO A CAR\"")
    );
    let curves = read("crash-curves.csv");
    let heads: Vec<&str> = curves.lines().next().unwrap().split(',').collect();
    for (i, head) in heads.iter().enumerate() {
        assert!(!heads[..i].contains(head), "{head} twice in {heads:?}");
    }
    for head in ["11HEADCG0000AVY0[deg/s]", "11NECKUP0000MOX0[N*m]", "11NECKUP0000FOX0[N]", "NA_BR01_XG_LC[N]"] {
        assert!(heads.contains(&head), "{heads:?}");
    }
    let peak = |head: &str| {
        let at = heads.iter().position(|own| *own == head).unwrap();
        let cells = curves.lines().skip(1).map(|line| line.split(',').nth(at).unwrap().parse::<f64>().unwrap_or(0.0));
        cells.fold(0.0_f64, |most, value| if value.abs() > most.abs() { value } else { most })
    };
    assert_eq!([peak("11HEADCG0000ACX0[g]"), peak("01_TBLU_ZL_LC[N]")], [-40.0, 900.0]);
    // the other car, and the folder read again as curves to compare with
    assert!(
        spoken(folder.path(), &["import", "v99999ascii", "--vehicle", "2", "-o", "other.toml"]).contains("170 times")
    );
    done(folder.path(), &["run", "crash.toml", "--quiet", "--set", "time.end=0.05"]);
    let first = |file: &str| done(folder.path(), &["compare", "crash.mcap", file]).lines().count();
    assert!(first("crash-curves.csv") > 5 && first("v99999ascii") > 5);
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
        (vec!["import", "odd.csv"], "ax has no known unit"),
        (vec!["import", "ego.xosc", "--at", "SILL"], "no forward accelerometer"),
        (vec!["import", "ego.xosc", "--cg", "-1"], "--cg"),
        (vec!["import", "none.csv"], "none.csv"),
    ] {
        let found = answer(here, &words);
        assert_eq!(found.status.code(), Some(2), "{words:?}");
        assert!(err(&found).contains(expected), "{}", err(&found));
    }
}
