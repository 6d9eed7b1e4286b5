//! Records of one known motion with one flaw each: the same figures, or a message with the option that mends it.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::common::{answer, done, err, spoken};

const G: f64 = 9.806_65;

/// A guardrail impact: g along x, y, z, deg/s about x, y, z, 2000 samples a second from 0.1 s before contact on.
fn motion(t: f64) -> [f64; 6] {
    let bump = |from: f64, length: f64| {
        let u = (t - from) / length;
        if (0.0..1.0).contains(&u) { (PI * u).sin().powi(2) } else { 0.0 }
    };
    let noise = |k: f64| 0.08 * (1234.5 * k * t + k).sin();
    [
        -7.1 * bump(0.0, 0.33) - 4.2 * bump(0.21, 0.08) + noise(1.0),
        -6.2 * bump(0.0, 0.27) - 9.3 * bump(0.2, 0.09) + noise(1.3),
        2.1 * bump(0.05, 0.12) + noise(1.7),
        63.0 * bump(0.03, 0.35),
        -33.0 * bump(0.05, 0.3),
        -92.0 * bump(0.02, 0.55),
    ]
}

const HEADINGS: &str = "t[s],ax[g],ay[g],az[g],wx[deg/s],wy[deg/s],wz[deg/s]";

/// The record with these headings; times and values changed before they are written.
fn table(headings: &str, change: impl Fn(f64, [f64; 6]) -> (f64, [f64; 6])) -> String {
    let line = |i: i32| {
        let t = f64::from(i) * 5e-4;
        let (t, values) = change(t, motion(t));
        format!("{t:.5},{}\n", values.map(|v| format!("{v:.5}")).join(","))
    };
    format!("{headings}\n{}", (-200..2200).map(line).collect::<String>())
}

fn measures(here: &Path, arguments: &[&str]) -> Value {
    serde_json::from_str::<Value>(&done(here, &[&["risk", "--json"], arguments].concat())).unwrap()["measures"].clone()
}

fn value(measures: &Value, key: &str) -> f64 {
    measures[key]["value"].as_f64().unwrap_or_else(|| panic!("no {key}"))
}

/// Every measure of one is that of the other.
#[track_caller]
fn same(expected: &Value, found: &Value, bound: f64) {
    for (key, measure) in expected.as_object().unwrap() {
        let (a, b) = (measure["value"].as_f64().unwrap(), found[key]["value"].as_f64().unwrap_or(f64::NAN));
        assert!((a - b).abs() <= 1e-6 + bound * a.abs(), "{key}: {a} {b}");
    }
}

#[test]
fn each_flaw_of_a_record_is_said_with_its_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let all = |factor: [f64; 6]| move |t: f64, m: [f64; 6]| (t, std::array::from_fn(|i| factor[i] * m[i]));
    let plain = all([1.0; 6]);
    let radians = 1f64.to_radians();
    for (name, text, words) in [
        ("plain", table(HEADINGS, plain), ""),
        (
            "rates in deg/s under rad/s",
            table(&HEADINGS.replace("deg/s", "rad/s"), plain),
            "times a second: if it is in deg/s",
        ),
        (
            "rates in rad/s under deg/s",
            table(HEADINGS, all([1.0, 1.0, 1.0, radians, radians, radians])),
            "no rate exceeds 1.6 deg/s (mean of 10 ms): if rates are in rad/s, use --columns, such as 'wx[rad/s]'",
        ),
        (
            "g under m/s^2",
            table(&HEADINGS.replace("[g]", "[m/s^2]"), all([1.0, 1.6, 1.0, 1.0, 1.0, 1.0])),
            "g (mean of 10 ms): if they are in g, use --columns, such as 'ax[g]'",
        ),
        (
            "x to the back",
            table(HEADINGS, all([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])),
            "If x points backwards, reverse its sign",
        ),
        (
            "whole g",
            table(HEADINGS, |t, m| (t, [m[0].round(), m[1].round(), m[2].round(), m[3], m[4], m[5]])),
            "ax, ay, az are rounded to 1 g: anything below 0.5 g is lost; `occupant risk --sensor-error offset='0.5 g'`",
        ),
    ] {
        fs::write(here.join("a.csv"), text).unwrap();
        let said = spoken(here, &["risk", "a.csv", "--start", "0"]);
        let doubts = ["if it is in", "they are in", "rates are in", "points backwards", "are rounded"]
            .iter()
            .filter(|w| said.contains(**w));
        assert_eq!(doubts.count() > 0, !words.is_empty(), "{name}: {said}");
        assert!(said.contains(words), "{name}: {said}");
    }
    // what they did not say, times in milliseconds taken for seconds, is refused
    fs::write(here.join("a.csv"), table(&HEADINGS.replace("t[s]", "Time"), |t, m| (1e3 * t, m))).unwrap();
    let refused = answer(here, &["risk", "a.csv", "--filter", "none"]);
    assert!(refused.status.code() == Some(2) && err(&refused).contains("such as `t[ms]`"), "{}", err(&refused));
    // one slip of a digit, of accelerations and of places
    let slipped = |t: f64, mut m: [f64; 6]| {
        m[0] += if (t - 0.5).abs() < 1e-6 { 90.0 } else { 0.0 };
        (t, m)
    };
    fs::write(here.join("a.csv"), table(HEADINGS, slipped)).unwrap();
    let said = spoken(here, &["risk", "a.csv", "--start", "0"]);
    assert!(said.contains("ax jumps in one row, at 0.5 s to 90.") && said.matches("jumps").count() == 1, "{said}");
    let places = |time_slip: f64, slip: f64| {
        let line = |i: i32| {
            let t = 0.01 * f64::from(i);
            let [late, far] = [time_slip, slip].map(|size| if i == 40 { size } else { 0.0 });
            format!("{:.4},{:.5}\n", t + late, 20.0 * t - 30.0 * t * t * t + far)
        };
        format!("t[s],x[m]\n{}", (0..100).map(line).collect::<String>())
    };
    for (text, words) in [
        (places(0.0, 0.01), "x jumps in one row, at 0.4 s to 6.09 m. If it is a mistake"),
        (places(0.003, 0.0), "the time 0.403 s does not fit the others"),
        (places(0.0, 0.0), ""),
    ] {
        fs::write(here.join("a.csv"), text).unwrap();
        let said = spoken(here, &["risk", "a.csv", "--filter", "none"]);
        assert!(
            said.contains(words) && ["mistake", "fit the others"].iter().any(|w| said.contains(w)) != words.is_empty(),
            "{said}"
        );
    }
    // many wrong cells are a few messages
    fs::write(here.join("a.csv"), table(HEADINGS, |t, m| (t, m)).replace("0,", "0x,")).unwrap();
    let said = err(&answer(here, &["risk", "a.csv"]));
    assert!(said.lines().count() < 45 && said.contains("more errors, not shown"), "{} {said}", said.lines().count());
    // angles without places
    fs::write(here.join("a.csv"), "t[s],Q1 [m],Yaw [deg]\n0,0,0\n0.1,2,1\n0.2,4,2\n0.3,6,3\n").unwrap();
    let said = spoken(here, &["risk", "a.csv", "--filter", "none"]);
    assert!(
        said.contains("there is no column x or y, so the vehicle turns on the spot. Name them with --columns"),
        "{said}"
    );
}

/// Line ends of old Macs, exponents of Fortran, and headings on every page of a printout.
#[test]
fn tables_of_old_programs_are_read_alike() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let text = table(HEADINGS, |t, m| (t, m));
    fs::write(here.join("plain.csv"), &text).unwrap();
    let expected = measures(here, &["plain.csv", "--start", "0"]);
    let fortran = |line: &str| {
        let cells = line
            .split(',')
            .map(|cell| cell.parse::<f64>().map_or(cell.to_owned(), |v| format!("{v:.8E}").replace('E', "D")));
        cells.collect::<Vec<_>>().join(",") + "\n"
    };
    let page = |(i, line): (usize, &str)| match i % 55 {
        0 if i > 0 => format!("1\n ANALYSIS OF BARRIER IMPACT, PAGE {}\n{HEADINGS}\n{line}\n", 1 + i / 55),
        _ => format!("{line}\n"),
    };
    for (name, text) in [
        ("mac.csv", text.replace('\n', "\r")),
        ("fortran.csv", text.lines().map(fortran).collect()),
        ("pages.csv", format!("{HEADINGS}\n{}", text.lines().skip(1).enumerate().map(page).collect::<String>())),
    ] {
        fs::write(here.join(name), text).unwrap();
        same(&expected, &measures(here, &[name, "--start", "0"]), 1e-6);
    }
    // a second case of the same headings, whose times begin anew, is another table: the longer one is read, with a note
    let second = table(HEADINGS, |t, m| (t, m)).lines().take(900).map(|line| format!("{line}\n")).collect::<String>();
    fs::write(here.join("two.csv"), format!("{text}CASE 2\n{second}")).unwrap();
    same(&expected, &measures(here, &["two.csv", "--start", "0"]), 1e-9);
    assert!(spoken(here, &["risk", "two.csv", "--start", "0"]).contains("the table ends before line 2402"));
    // one message for a file that is no text
    let wide: Vec<u8> =
        std::iter::once('\u{feff}').chain(text.chars()).flat_map(|c| (c as u32).to_le_bytes()).collect();
    fs::write(here.join("wide.csv"), wide).unwrap();
    let refused = err(&answer(here, &["risk", "wide.csv"]));
    assert!(refused.contains("UTF-32") && refused.matches("error").count() == 1, "{refused}");
}

/// An engine that is hit late, a sill that rings, two that agree: the quiet one of those that agree, whatever the order.
#[test]
fn the_place_of_a_test_is_the_quiet_one_of_those_that_agree() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let heads = ["10ENGN000000ACX0", "10SILLLE0000ACX0", "10SILLRI0000ACX0", "10TUNN000000ACX0"]
        .map(|code| format!("{code}[g]"));
    let line = |i: u32| {
        let t = f64::from(i) * 1e-4;
        let pulse = if t < 0.1 { -25.0 * (PI * t / 0.1).sin() } else { 0.0 };
        let ring = |size: f64, hertz: f64| size * (2.0 * PI * hertz * t).sin();
        let all = [
            1.4 * pulse + ring(20.0, 90.0),
            pulse + ring(15.0, 180.0),
            pulse + ring(2.0, 70.0),
            1.02 * pulse + ring(5.0, 110.0),
        ];
        format!("{t:.4},{}\n", all.map(|a| format!("{a:.4}")).join(","))
    };
    fs::write(here.join("a.csv"), format!("t[s],{}\n{}", heads.join(","), (0..1500).map(line).collect::<String>()))
        .unwrap();
    let said = spoken(here, &["risk", "a.csv"]);
    assert!(
        said.contains("the path is that of SILLRI, which has the least ringing of the 3 of 4 locations with a forward delta-v of -56 km/h ± 10 %"),
        "{said}"
    );
    assert!(said.contains("disagree on its forward delta-v, km/h: ENGN -76.2"), "{said}");
    same(&measures(here, &["a.csv", "--at", "SILLRI"]), &measures(here, &["a.csv"]), 0.0);
    // ∫ of the half sine: 2/π · 25 g · 0.1 s
    let change = value(&measures(here, &["a.csv"]), "final_velocity_change_x_m_s");
    assert!((change / (-5.0 / PI * G) - 1.0).abs() < 1e-2, "{change}");
}

/// A recorder's speed before the crash is the speed of the path.
#[test]
fn the_speed_that_a_recorder_tells_is_used() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let before = "-1000,72,\n-500,70,\n0,68.4,0\n";
    let crash: String = (1..=15).map(|i| format!("{},,{:.1}\n", 10 * i, -2.4 * f64::from(i))).collect();
    fs::write(
        here.join("edr.csv"),
        format!("Time (ms),Vehicle speed (km/h),Delta-V longitudinal (km/h)\n{before}{crash}"),
    )
    .unwrap();
    let said = spoken(here, &["import", "edr.csv"]);
    assert!(said.contains("`speed` is Vehicle speed at 0 s, 68.4 km/h; change it with --speed"), "{said}");
    assert!(done(here, &["check", "edr.toml"]).contains("19.000 m/s at the start"));
    let said = spoken(here, &["import", "edr.csv", "-f", "--speed", "50 km/h"]);
    assert!(!said.contains("68.4") && done(here, &["check", "edr.toml"]).contains("13.889 m/s at the start"), "{said}");
}

/// The interval of 95 % against one of our own: the record's derivatives, found by runs of changed records, and draws of another generator.
#[test]
fn intervals_are_those_of_errors_of_the_sensors() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let with = |gain: [f64; 2], offset: [f64; 2]| {
        let changed = move |t, m: [f64; 6]| {
            (t, [m[0] * (1.0 + gain[0]) + offset[0], m[1] * (1.0 + gain[1]) + offset[1], m[2], m[3], m[4], m[5]])
        };
        fs::write(here.join("a.csv"), table(HEADINGS, changed)).unwrap();
        measures(here, &["a.csv", "--start", "0"])
    };
    let keys = ["oiv_x_m_s", "oiv_y_m_s"];
    let (gain, offset) = (0.02, 0.05);
    let bounds =
        [([gain, 0.0], [0.0; 2]), ([0.0, gain], [0.0; 2]), ([0.0; 2], [offset, 0.0]), ([0.0; 2], [0.0, offset])];
    let halves = bounds.map(|(g, o)| {
        let (up, down) = (with(g, o), with(g.map(|v| -v), o.map(|v| -v)));
        keys.map(|key| 0.5 * (value(&up, key) - value(&down, key)))
    });
    let mut state = 12_345_u64;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let draws: Vec<[f64; 4]> = (0..40_000).map(|_| std::array::from_fn(|_| draw())).collect();
    fs::write(here.join("a.csv"), table(HEADINGS, |t, m| (t, m))).unwrap();
    let found =
        measures(here, &["a.csv", "--start", "0", "--sensor-error", "gain=2 %", "--sensor-error", "offset=0.05 g"]);
    for (k, key) in keys.into_iter().enumerate() {
        let mut sums: Vec<f64> = draws.iter().map(|d| (0..4).map(|i| d[i] * halves[i][k]).sum()).collect();
        sums.sort_unstable_by(f64::total_cmp);
        let [low, high] = [0.025, 0.975].map(|part| value(&found, key) + sums[(part * sums.len() as f64) as usize]);
        let [a, b] = [0, 1].map(|i| found[key]["interval_95"][i].as_f64().unwrap());
        let width = high - low;
        assert!(((b - a) / width - 1.0).abs() < 0.1 && (a - low).abs() < 0.08 * width, "{key}: {a} {b}, {low} {high}");
    }
}

/// The second of two vehicles by its name; a record of half the strength.
#[test]
fn other_vehicles_and_strengths_are_judged() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let two = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/hand/two-vehicles.toml");
    let change =
        |flags: &[&str]| value(&measures(here, &[&[two][..], flags].concat()), "final_velocity_change_x_m_s") * 3.6;
    for (flags, expected) in [(&[][..], -23.0), (&["--vehicle", "vehicle"], -23.0), (&["--vehicle", "light"], -37.0)] {
        let found = change(flags);
        assert!((found - expected).abs() < 0.01, "{flags:?}: {found}");
    }
    let refused = answer(here, &["risk", two, "--vehicle", "heavy"]);
    assert!(
        refused.status.code() == Some(2) && err(&refused).contains("name `vehicle` or `light`"),
        "{}",
        err(&refused)
    );

    // without roll and pitch gravity is in no horizontal channel
    for (name, factor) in [("a.csv", 1.0), ("half.csv", 0.5)] {
        let level = |t, m: [f64; 6]| (t, [m[0], m[1], m[2], 0.0, 0.0, m[5]].map(|v| factor * v));
        fs::write(here.join(name), table(HEADINGS, level)).unwrap();
    }
    for name in ["a.csv", "half.csv"] {
        spoken(here, &["import", name, "--speed", "100 km/h"]);
    }
    let judged = |flags: &[&str]| -> Value {
        serde_json::from_str(&done(here, &[&["risk", "--json", "--filter", "none"], flags].concat())).unwrap()
    };
    let (scaled, half) = (judged(&["a.toml", "--set", "path.strength=0.5"]), judged(&["half.toml"]));
    same(&half["measures"], &scaled["measures"], 2e-3);
    let verdicts = |report: &Value| -> Vec<String> {
        report["limits"].as_array().unwrap().iter().map(|l| format!("{} {}", l["rule"], l["verdict"])).collect()
    };
    assert_eq!(verdicts(&half), verdicts(&scaled));
    assert_ne!(verdicts(&half), verdicts(&judged(&["a.toml"])));
}
