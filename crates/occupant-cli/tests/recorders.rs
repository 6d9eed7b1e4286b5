//! Reports of event data recorders as they are: what stands in the scenario, or the words of the refusal. The reports of
//! `data/recorders` are invented, in the layouts of usual ones.

use std::fs;
use std::path::Path;

use crate::common::{answer, done, err, spoken};

/// A folder with all reports.
fn reports() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/recorders");
    for file in fs::read_dir(data).unwrap() {
        let file = file.unwrap();
        fs::copy(file.path(), folder.path().join(file.file_name())).unwrap();
    }
    folder
}

struct Found {
    /// What import said.
    said: String,
    scenario: String,
    path: String,
}

/// The files of an import, which `check` accepts.
fn imported(here: &Path, file: &str, flags: &[&str]) -> Found {
    let said = spoken(here, &[&["import", file, "-f", "-o", "x.toml"], flags].concat());
    done(here, &["check", "x.toml"]);
    let read = |name: &str| fs::read_to_string(here.join(name)).unwrap();
    Found { said, scenario: read("x.toml"), path: read("x-path.csv") }
}

impl Found {
    fn says(&self, words: &[&str]) -> &Self {
        for word in words {
            assert!(self.said.contains(word), "{word}\n{}", self.said);
        }
        self
    }

    fn has(&self, words: &[&str]) -> &Self {
        for word in words {
            assert!(self.scenario.contains(word), "{word}\n{}", self.scenario);
        }
        self
    }

    /// First and last row of the path.
    fn goes(&self, first: &str, last: &str) -> &Self {
        let lines: Vec<&str> = self.path.lines().collect();
        assert_eq!([lines[1], lines[lines.len() - 1]], [first, last], "{}", self.path);
        self
    }
}

fn refused(here: &Path, text: &str, flags: &[&str], words: &[&str]) {
    fs::write(here.join("r.csv"), text).unwrap();
    let found = answer(here, &[&["import", "r.csv", "-f"], flags].concat());
    assert_eq!(found.status.code(), Some(2), "{text}{}", err(&found));
    for word in words {
        assert!(err(&found).contains(word), "{word}\n{}", err(&found));
    }
    assert!(!here.join("r.toml").exists() && !here.join("r-path.csv").exists());
}

const WORN: &str = "belt = \"three_point\"";
const LOOSE: &str = "belt = \"none\"";

#[test]
fn a_report_with_all_its_blocks_becomes_a_scenario() {
    let folder = reports();
    let found = imported(folder.path(), "cdr.csv", &[]);
    found.goes("0,0,0", "0.15,-26.4,2.2").has(&[
        "speed = \"46.671 km/h\"",
        WORN,
        "[triggers.recorded_bag]           # recorder, line 17\nkind = \"time\"\nat = \"14 ms\"",
        "[bags.driver]\ntrigger = \"recorded_bag\"\ndelay = 0",
        "at = \"11 ms\"",
        "[retractors.driver.pretensioner]",
    ]);
    found.says(&[
        "`speed` is Speed, Vehicle Indicated at 0 s",
        "the driver's belt was fastened (line 11)",
        "the passenger's belt was not fastened",
        "fired at 14 ms (line 17)",
    ]);
    assert!(found.path.starts_with("t[s],dvx[MPH],dvy[MPH]\n"), "{}", found.path);
    // the bag opens when the recorder says so, in the run too
    let said = done(folder.path(), &["run", "x.toml", "--no-mcap", "--until", "40 ms"]);
    // it unfolds in 25 ms
    assert!(said.contains("100 39.0        1 "), "{said}");
}

#[test]
fn text_of_a_pdf_is_split_by_its_columns() {
    let folder = reports();
    let found = imported(folder.path(), "pdf.txt", &[]);
    found.goes("0,0,0", "0.12,-38,-6").has(&["speed = \"52 km/h\"", LOOSE, "at = \"16 ms\""]);
    assert!(found.said.contains("x.toml: an unbelted driver") && found.scenario.starts_with("# An unbelted driver"));
    // a blank between two lateral values, and a page in the midst
    found.says(&["gaps were filled linearly: dvy from 0.04 s to 0.06 s", "the event is 1"]);
    assert_eq!(found.path.lines().count(), 14);
}

#[test]
fn reports_are_read_in_five_languages() {
    let folder = reports();
    let here = folder.path();
    let german = imported(here, "german.csv", &[]);
    german.goes("0,0,0", "0.13,-41.2,3.3").has(&["speed = \"46.5 km/h\"", WORN, "at = \"18 ms\"", "at = \"12 ms\""]);
    german.says(&["was read as Windows-1252", "a value of 0 is added at 0 s", "passenger's belt was not fastened"]);
    let french = imported(here, "french.tsv", &[]);
    french.goes("0,0,0", "0.12,-33,-2").has(&["speed = \"63 km/h\"", LOOSE]).says(&["passenger's belt was fastened"]);
    let spanish = imported(here, "spanish.csv", &[]);
    spanish.goes("0,0,0", "0.14,0,0").has(&["speed = \"54 km/h\"", WORN, "at = \"15 ms\""]);
    assert!(
        spanish.path.starts_with("t[s],ax[g],ay[g]\n") && spanish.path.contains("\n0.056,-13.99,-1.4\n"),
        "{}",
        spanish.path
    );
    let japanese = imported(here, "japanese.csv", &[]);
    japanese.goes("0,0,0", "0.12,-29,4").has(&["speed = \"47 km/h\"", WORN, "at = \"17 ms\""]);
    let slowing = imported(here, "deceleration.txt", &[]);
    slowing
        .goes("0,0", "0.13,0")
        .has(&["speed = \"50 km/h\""])
        .says(&["is reversed: the report gives a loss of speed"]);
    assert!(slowing.path.contains("\n0.05,-12\n"), "{}", slowing.path);
}

#[test]
fn layouts_repeats_and_gaps_are_mended_aloud() {
    let folder = reports();
    let here = folder.path();
    imported(here, "across.csv", &[]).goes("0,0,0", "0.12,-27,5").says(&["gaps were filled linearly: dvy"]);
    imported(here, "side.txt", &[]).goes("0,0,0", "0.12,-12,21");
    imported(here, "interval.tsv", &[])
        .goes("0,0", "0.13,-31")
        .has(&["speed = \"48 km/h\""])
        .says(&["gives changes per interval: summed to -31 km/h"]);
    let found = imported(here, "repeats.csv", &[]);
    found.goes("0,0", "0.13,-35").says(&[
        "line 8 has no time: 50 is filled in",
        "repeated times are left out: line 6",
        "gaps were filled linearly: all from 0.07 s to 0.09 s",
        "13 of 15 times; the rest is skipped",
    ]);
    let rear = imported(here, "rear.csv", &[]);
    rear.goes("0,0", "0.12,11").has(&["speed = \"0 km/h\"", WORN, "driver = false"]);
    rear.says(&["count back from the crash: taken as negative", "did not fire (line 2)"]);
    // what stands behind the end of the event, and marks of missing values
    let rows = |tail: &str| {
        format!("Time (ms),Delta-V longitudinal (km/h)\n0,0\n10,-5\n20,-14\n30,-21\n40,-24\n50,-25\n{tail}")
    };
    for (tail, words) in [("60,0\n70,0\n", "2 zeros behind its end"), ("60,127\n70,127\n", "2 marks of missing values")]
    {
        fs::write(here.join("tail.csv"), rows(tail)).unwrap();
        imported(here, "tail.csv", &[]).goes("0,0", "0.05,-25").says(&[words]);
    }
    // a time that stands twice where the next is lacking
    let rows = "0,0\n10,-5\n10,-14\n30,-21\n40,-24\n50,-25\n";
    fs::write(here.join("twice.csv"), format!("Time (ms),Delta-V longitudinal (km/h)\n{rows}")).unwrap();
    let twice = imported(here, "twice.csv", &[]);
    assert!(twice.says(&["line 4 repeats the time 10: 20 is taken"]).path.contains("\n0.02,-14\n"), "{}", twice.path);
    // without a word for it, a curve that returns to 0 is one of changes per interval
    let rows = "0,0\n10,-1\n20,-3\n30,-6\n40,-7\n50,-6\n60,-3\n70,-1\n80,0\n";
    fs::write(here.join("bare.csv"), format!("Time (ms),Delta-V longitudinal (km/h)\n{rows}")).unwrap();
    imported(here, "bare.csv", &[]).goes("0,0", "0.08,-27").says(&["--delta-v cumulative takes it as it stands"]);
    imported(here, "bare.csv", &["--delta-v", "cumulative"]).goes("0,0", "0.08,0");
}

#[test]
fn an_event_is_chosen_and_signs_are_turned_with_one_flag() {
    let folder = reports();
    let here = folder.path();
    let several = answer(here, &["import", "events.csv", "-f"]);
    assert!(
        several.status.code() == Some(2) && err(&several).contains("choose one with --event: `1`, `2`"),
        "{}",
        err(&several)
    );
    imported(here, "events.csv", &["--event", "2"])
        .goes("0,0", "0.12,-30")
        .has(&["speed = \"32 km/h\""])
        .says(&["what belongs to other events is left out: 1"]);
    imported(here, "events.csv", &["--event", "1"]).goes("0,0", "0.12,-8").has(&["speed = \"40 km/h\""]);
    let none = answer(here, &["import", "events.csv", "-f", "--event", "3"]);
    assert!(none.status.code() == Some(2) && err(&none).contains("one of `1`, `2`"), "{}", err(&none));
    let found = imported(here, "magnitudes.csv", &[]);
    found.goes("0,0", "0.13,-24.5").says(&["`impact: frontal` in line 1", "--struck rear takes them as a gain"]);
    imported(here, "magnitudes.csv", &["--struck", "rear"]).goes("0,0", "0.13,24.5");
    imported(here, "side.txt", &["--struck", "right,front"]).goes("0,0,0", "0.12,-12,-21");
}

/// Columns that the user names are taken, and the rest of the report with them.
#[test]
fn named_columns_keep_the_rest_of_the_report() {
    let folder = reports();
    let found = imported(folder.path(), "cdr.csv", &["--columns", "t[ms],dvx[km/h],-"]);
    found.goes("0,0", "0.15,-26.4").has(&["speed = \"46.671 km/h\"", WORN, "at = \"14 ms\""]);
}

/// A workbook of stored parts, with texts shared, in line, and a truth value.
fn workbook(rows: &[&[&str]]) -> Vec<u8> {
    let cell = |(i, text): (usize, &&str)| {
        let place = char::from(b'A' + u8::try_from(i).unwrap());
        match (text.parse::<f64>(), *text) {
            (_, "") => String::new(),
            (_, "TRUE") => format!("<c r=\"{place}1\" t=\"b\"><v>1</v></c>"),
            (Ok(_), _) => format!("<c r=\"{place}1\"><v>{text}</v></c>"),
            (Err(_), "shared") => format!("<c r=\"{place}1\" t=\"s\"><v>0</v></c>"),
            _ => format!("<c r=\"{place}1\" t=\"inlineStr\"><is><t>{}</t></is></c>", text.replace('&', "&amp;")),
        }
    };
    let row = |cells: &&[&str]| format!("<row>{}</row>", cells.iter().enumerate().map(cell).collect::<String>());
    let sheet = format!(
        "<worksheet xmlns=\"x\"><sheetData>{}</sheetData></worksheet>",
        rows.iter().map(row).collect::<String>()
    );
    let shared = "<sst xmlns=\"x\"><si><r><t>Delta-V longi</t></r><r><t>tudinal (km/h)</t></r></si></sst>".to_owned();
    let parts = [("xl/sharedStrings.xml", shared), ("xl/worksheets/sheet1.xml", sheet)];
    let (mut bytes, mut list) = (Vec::new(), Vec::new());
    for (name, text) in &parts {
        let sizes = [&u32::try_from(text.len()).unwrap().to_le_bytes()[..]; 2].concat();
        let length = [&u16::try_from(name.len()).unwrap().to_le_bytes()[..], &[0; 2]].concat();
        let common = [&[20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0][..], &sizes, &length].concat();
        let at = u32::try_from(bytes.len()).unwrap().to_le_bytes();
        list.extend([b"PK\x01\x02\x14\0", &common[..], &[0; 10], &at, name.as_bytes()].concat());
        bytes.extend([b"PK\x03\x04", &common[..], name.as_bytes(), text.as_bytes()].concat());
    }
    let (at, size) = (u32::try_from(bytes.len()).unwrap(), u32::try_from(list.len()).unwrap());
    bytes.extend(list);
    bytes.extend([b"PK\x05\x06\0\0\0\0\x02\0\x02\0", &size.to_le_bytes()[..], &at.to_le_bytes(), &[0; 2]].concat());
    bytes
}

#[test]
fn a_workbook_is_a_report_too() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let rows: [&[&str]; 9] = [
        &["Report of a recorder"],
        &["Safety belt fastened, driver", "TRUE"],
        &["Speed at impact (km/h)", "44"],
        &["Time (ms)", "shared", "Brake"],
        &["0", "0", "On"],
        &["10", "-4.5", "On"],
        &["20", "-15"],
        &["30", "-21.25", "Off"],
        &["40", "-22"],
    ];
    fs::write(here.join("book.xlsx"), workbook(&rows)).unwrap();
    imported(here, "book.xlsx", &[]).goes("0,0", "0.04,-22").has(&["speed = \"44 km/h\"", WORN]);
    let whole = workbook(&rows);
    for cut in (0..whole.len()).step_by(97) {
        fs::write(here.join("cut.xlsx"), &whole[..cut]).unwrap();
        assert_eq!(answer(here, &["import", "cut.xlsx", "-f"]).status.code(), Some(2), "{cut}");
    }
    fs::write(here.join("report.pdf"), b"%PDF-1.7\n%\xe2\xe3\n").unwrap();
    let pdf = answer(here, &["import", "report.pdf"]);
    assert!(err(&pdf).contains("copy its text into a file NAME.txt"), "{}", err(&pdf));
}

/// Rows of a pulse that rises to a velocity change.
fn pulse(heading: &str, change: f64) -> String {
    let row = |i: u32| format!("{},{:.1}\n", 10 * i, change * (f64::from(i.min(10)) / 10.0));
    format!("Time (ms),{heading}\n{}\n", (0..15).map(row).collect::<String>())
}

fn speeds(from: f64, to: f64) -> String {
    let row = |i: u32| {
        format!(
            "{:.1},{:.1},{}\n",
            0.5 * f64::from(i) - 2.0,
            from + (to - from) * f64::from(i) / 4.0,
            if to < from { "On" } else { "Off" }
        )
    };
    format!("Time (s),Vehicle speed (km/h),Service brake\n{}\n", (0..5).map(row).collect::<String>())
}

#[test]
fn reports_that_contradict_themselves_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let x = "Delta-V longitudinal (km/h)";
    let driving = speeds(62.0, 41.0);
    let both = |a: &str, b: &str| format!("{a}\n{b}\n{}", pulse(x, -28.0));
    let accelerations: String = (0..15)
        .map(|i| format!("{},{:.1},{}\n", 10 * i, -2.8 * f64::from(i.min(10)), if i < 10 { 8 } else { 0 }))
        .collect();
    let cases: [(String, &[&str]); 21] = [
        (
            driving.clone() + &pulse(x, 34.0),
            &[
                "a gain of 34 km/h, as in a rear impact, of a vehicle that drives 41 km/h before",
                "--struck front, rear",
            ],
        ),
        (
            format!("Time (ms),{x},Longitudinal acceleration (g)\n{accelerations}"),
            &["sums to", "`Delta-V longitudinal` is -28 km/h"],
        ),
        (speeds(16.0, 14.0) + &pulse(x, -46.0), &["leaves the vehicle at 32 km/h backwards", "--struck front"]),
        (
            format!("Event Record 1\n{driving}Event Record 2\n{}", pulse(x, -30.0)),
            &["the speeds are those of event 1, the crash pulse is that of event 2", "--event '2'"],
        ),
        (pulse("Delta-V longitudinal (g)", -9.0), &["`g` as the unit of `Delta-V longitudinal`", "a unit of velocity"]),
        (pulse("Longitudinal acceleration (mph)", -9.0), &["`mph` as the unit of", "a unit of acceleration"]),
        (
            "Time (ms),\"Delta-V, longitudinal (MPH [km/h])\"\n0,0 [0]\n10,-5 [-8]\n20,-12 [-12]\n".to_owned(),
            &["the two units disagree"],
        ),
        (pulse(x, -310.0), &["a velocity change of -310 km/h", "correct the unit"]),
        (
            format!("Impact type: rear-end collision\n{}", pulse(x, -28.0)),
            &["a loss of 28 km/h, as in a frontal impact, but `impact type: rear-end collision`"],
        ),
        (
            format!("Maximum Delta-V, Longitudinal (km/h): -55\n{}", pulse(x, -28.0)),
            &["the largest velocity change is -55 km/h here and -28 km/h"],
        ),
        (
            format!("Maximum Delta-V, Longitudinal (km/h): -28\n{}", pulse(x, 28.0)),
            &["the largest velocity change is -28 km/h here and 28 km/h", "--struck"],
        ),
        (
            both("Safety belt status, driver: Buckled", "Driver belt: Unbuckled"),
            &["the driver's belt is not fastened here and fastened in line 1"],
        ),
        (
            both("Driver front airbag deployed: No", "Driver front airbag deployment time: 15 ms"),
            &["bag fired, in line 1 it did not fire"],
        ),
        (
            both("Event type: Non-Deployment Event", "Driver front airbag deployment time: 15 ms"),
            &["bag fired, in line 1 it did not fire"],
        ),
        (
            format!("Crash type: rear impact\nFrontal air bag deployment, driver: 15 ms\n{}", pulse(x, 28.0)),
            &["rear impact", "the front air bag fired (line 2)"],
        ),
        (pulse(x, -28.0).replace("\n30,", "\n20,-9.9\n30,"), &["the time 20 has other values here than in line 4"]),
        (
            "Time (ms),Cumulative Delta-V longitudinal (km/h)\n0,0\n10,-1\n20,-3\n30,-6\n40,-7\n50,-6\n60,-3\n70,-1\n80,0\n".to_owned(),
            &["is called cumulative but returns to 0 km/h", "--delta-v cumulative or --delta-v interval"],
        ),
        (
            format!("Impact: left side\n{}", pulse("Delta-V lateral (km/h)", -22.0)),
            &["`impact: left side` in line 1, but the vehicle is pushed to the left"],
        ),
        (
            format!("Speed at impact: 25 km/h\n{}{}", speeds(80.0, 78.0), pulse(x, -20.0)),
            &["the speed at impact is 25 km/h here, and Vehicle speed 78 km/h at 0 s"],
        ),
        (both("VIN: 1ZZAB5SX9F7000001", "VIN: 2YYCD6TY0G8000002"), &["two vehicles"]),
        (
            both("Positive values mean a loss of speed", "Signs as in SAE J1698"),
            &["another meaning of positive numbers than in line 1"],
        ),
    ];
    for (text, words) in &cases {
        refused(here, text, &[], words);
    }
    for (text, words) in [
        (
            pulse(x, -28.0).replace("(ms)", "(s)"),
            &["a crash pulse `Delta-V longitudinal` of 140 s", "unit of time"][..],
        ),
        (pulse(x, -28.0).replace("(ms)", "(us)"), &["between two rows", "at most 300 g"]),
        (pulse(x, -28.0).replace("\n0,-0.0", "\n0,-12"), &["is already -12 km/h at 0 s", "--delta-v interval"]),
        (format!("Driver airbag deployment time: 15 s\n{}", pulse(x, -28.0)), &["fires 15 s after time zero"]),
    ] {
        refused(here, &text, &[], words);
    }
    // what the user says settles it
    fs::write(here.join("pushed.csv"), speeds(16.0, 14.0) + &pulse(x, -46.0)).unwrap();
    imported(here, "pushed.csv", &["--struck", "front"]).goes("0,0", "0.14,-46").says(&["moves backwards"]);
    fs::write(here.join("sign.csv"), driving + &pulse(x, 34.0)).unwrap();
    imported(here, "sign.csv", &["--struck", "front"]).goes("0,0", "0.14,-34").has(&["speed = \"41 km/h\""]);
    imported(here, "sign.csv", &["--struck", "rear"]).goes("0,0", "0.14,34");
}
