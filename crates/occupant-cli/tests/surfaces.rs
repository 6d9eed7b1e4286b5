//! Surfaces fitted to records: a known surface comes back, its run reproduces the record, bad records are refused or told of.

use std::fs;
use std::path::Path;

use crate::common::{answer, done, err};

/// A name, its rows, their heading, whether a surface comes of them, and what is said.
type Case = (&'static str, Vec<[f64; 2]>, &'static str, bool, &'static str);

const G: f64 = 9.806_65;

/// A surface and an impactor, and how it is recorded.
#[derive(Clone)]
struct Drop {
    /// mm and N from (0, 0).
    points: Vec<[f64; 2]>,
    returned: f64,
    mass_kg: f64,
    speed_m_s: f64,
    gravity: f64,
    /// Of the peak.
    noise: f64,
    /// Samples every, s; contact at; end.
    times_s: [f64; 3],
    seed: u64,
}

fn bolster() -> Drop {
    Drop {
        points: vec![[0.0, 0.0], [15.0, 1500.0], [45.0, 3200.0], [80.0, 6800.0]],
        returned: 0.2,
        mass_kg: 6.8,
        speed_m_s: 5.2,
        gravity: 0.0,
        noise: 0.0,
        times_s: [1e-4, 0.01, 0.06],
        seed: 1,
    }
}

impl Drop {
    fn loading(&self, mm: f64) -> f64 {
        let pairs = self.points.windows(2);
        let line = |p: &[[f64; 2]]| p[0][1] + (p[1][1] - p[0][1]) * (mm - p[0][0]) / (p[1][0] - p[0][0]);
        let within = pairs.clone().find(|p| mm <= p[1][0]).or(pairs.last());
        if mm <= 0.0 { 0.0 } else { within.map_or(0.0, line) }
    }

    /// Times, s, and accelerations, g: steps of 1 µs, written for this test alone.
    fn record(&self) -> Vec<[f64; 2]> {
        let [every, contact, end] = self.times_s;
        let (mut x, mut v, mut most) = (0.0, self.speed_m_s, 0.0_f64);
        let (h, steps) = (1e-6, (every / 1e-6_f64).round() as usize);
        let quiet = (contact / every).round() as usize;
        let mut rows: Vec<[f64; 2]> = (0..quiet).map(|i| [i as f64 * every, 0.0]).collect();
        for i in quiet..(end / every).round() as usize {
            let force = |x: f64, most: f64| {
                self.loading(1e3 * (most - (most - x) / if x < most { self.returned } else { 1.0 }))
            };
            rows.push([i as f64 * every, force(x, most) / self.mass_kg / G]);
            for _ in 0..steps {
                most = most.max(x);
                v += h * (if x > 0.0 { self.gravity } else { 0.0 } - force(x, most) / self.mass_kg);
                x += h * v;
            }
        }
        let peak = rows.iter().map(|row| row[1]).fold(0.0, f64::max);
        let mut state = self.seed;
        rows.iter_mut().for_each(|row| row[1] += self.noise * peak * normal(&mut state));
        rows
    }
}

/// A normal number, as the sum of twelve.
fn normal(state: &mut u64) -> f64 {
    let mut unit = || {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..12).map(|_| unit()).sum::<f64>() - 6.0
}

fn write(folder: &Path, rows: &[[f64; 2]]) {
    let lines: String = rows.iter().map(|[t, a]| format!("{:.3},{a:.4}\n", 1e3 * t)).collect();
    fs::write(folder.join("drop.csv"), format!("t[ms],acceleration[g]\n{lines}")).expect("a record");
}

/// Numbers of a line of the file, whatever units stand behind.
fn numbers(text: &str, key: &str) -> Vec<f64> {
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix(&format!("{key} = ")))
        .unwrap_or_else(|| panic!("{key}: {text}"));
    line.split(|c: char| !(c.is_ascii_digit() || ".-e".contains(c))).filter_map(|word| word.parse().ok()).collect()
}

fn fitted(folder: &Path, drop: &Drop, more: &[&str]) -> String {
    write(folder, &drop.record());
    let [mass, speed] = [format!("{} kg", drop.mass_kg), format!("{} m/s", drop.speed_m_s)];
    let words = ["surface", "drop.csv", "--mass", &mass, "--speed", &speed, "-o", "s.toml", "-f"];
    done(folder, &[&words[..], more].concat());
    fs::read_to_string(folder.join("s.toml")).expect("a surface")
}

#[test]
fn a_known_surface_comes_back() {
    let here = tempfile::tempdir().expect("a folder");
    let drop = bolster();
    let text = fitted(here.path(), &drop, &[]);
    for (depth, force) in numbers(&text, "depth").iter().zip(numbers(&text, "force")) {
        let off = (force - drop.loading(*depth)).abs();
        assert!(off < 10.0, "{depth} mm: {force} N, off by {off} N"); // 5.0
    }
    let returned = numbers(&text, "returned")[0];
    assert!((returned - drop.returned).abs() < 0.0005, "{returned}"); // 0.0000
    let [peak, residual] = ["peak_ratio", "residual"].map(|key| numbers(&text, key)[0]);
    assert!((peak - 1.0).abs() < 0.001 && residual < 0.001, "{text}"); // 0.0000, 0.00023
}

#[test]
fn intervals_hold_the_truth_about_as_often_as_they_say() {
    let here = tempfile::tempdir().expect("a folder");
    let (mut held, mut all, mut held_back) = (0, 0, 0);
    for seed in 0..8 {
        let drop = Drop { noise: 0.02, seed: 7919 * seed + 3, ..bolster() };
        let text = fitted(here.path(), &drop, &[]);
        let ends = text.split("[intervals]").nth(1).expect("intervals");
        let (depths, force) = (numbers(&text, "depth"), numbers(ends, "force"));
        for (depth, ends) in depths.iter().zip(force.chunks(2)).skip(1) {
            let truth = drop.loading(*depth);
            held += usize::from(ends[0] <= truth && truth <= ends[1]);
            all += 1;
        }
        let ends = numbers(ends, "returned");
        held_back += usize::from(ends[0] <= drop.returned && drop.returned <= ends[1]);
    }
    // all of them, and 7
    assert!(10 * held >= 8 * all && held_back >= 6, "forces {held} of {all}, returned {held_back} of 8");
}

#[test]
fn an_independent_impactor_on_the_fitted_surface_makes_the_record() {
    let here = tempfile::tempdir().expect("a folder");
    let drop = Drop { gravity: G, noise: 0.01, ..bolster() };
    let text = fitted(here.path(), &drop, &["--down"]);
    let points = numbers(&text, "depth").into_iter().zip(numbers(&text, "force")).map(|(x, f)| [x, f]).collect();
    let again = Drop { points, returned: numbers(&text, "returned")[0], noise: 0.0, ..drop.clone() };
    let (own, truth) = (again.record(), Drop { noise: 0.0, ..drop }.record());
    let peak = |rows: &[[f64; 2]]| rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    let squares: f64 = own.iter().zip(&truth).map(|(a, b)| (a[1] - b[1]).powi(2)).sum();
    let off = (squares / own.len() as f64).sqrt() / peak(&truth);
    let ratio = peak(&own) / peak(&truth);
    assert!(off < 0.008 && (ratio - 1.0).abs() < 0.004, "off by {off}, peaks {ratio}"); // 0.0038, 0.0015
}

#[test]
fn a_head_on_the_fitted_surface_falls_as_in_the_record() {
    let here = tempfile::tempdir().expect("a folder");
    let path = here.path();
    let scenario = include_str!("../../../scenarios/head-drop.toml");
    // its centre of mass in the middle of the sphere: a mass without rotation
    let scenario = scenario.replace("pitch = -118", "pitch = -180").replace("end = \"10 ms\"", "end = \"6 ms\"");
    fs::write(path.join("drop.toml"), &scenario).expect("a scenario");
    let force = |run: &str| {
        done(path, &["run", &format!("{run}.toml"), "-q", "-f"]);
        done(
            path,
            &[
                "export",
                &format!("{run}.mcap"),
                "--channels",
                "sphere.head.force.resultant",
                "-o",
                &format!("{run}.csv"),
                "-f",
            ],
        );
        let text = fs::read_to_string(path.join(format!("{run}.csv"))).expect("a table");
        let row = |line: &str| line.split(',').nth(1).and_then(|cell| cell.parse::<f64>().ok());
        text.lines().filter_map(row).collect::<Vec<f64>>()
    };
    let measured = force("drop");
    done(path, &["surface", "drop.csv", "--mass", "4.54 kg", "--height", "376 mm", "-o", "plate.toml"]);
    let own = "plate = { file = \"plate.toml\", friction = 0.4 }";
    fs::write(path.join("again.toml"), scenario.replace("plate = { library = \"head_dummy\" }", own))
        .expect("a scenario");
    let again = force("again");
    let peak = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let squares: f64 = measured.iter().zip(&again).map(|(a, b)| (a - b).powi(2)).sum();
    let off = (squares / measured.len() as f64).sqrt() / peak(&measured);
    let ratio = peak(&again) / peak(&measured);
    assert!((ratio - 1.0).abs() < 0.001 && off < 0.001, "{ratio} {off}"); // 1.00027, 0.00018
    // the results hold the surface: they are read without the file
    fs::remove_file(path.join("plate.toml")).expect("a file");
    done(path, &["measures", "again.mcap"]);
}

#[test]
fn bad_records_are_refused_or_told_of() {
    let here = tempfile::tempdir().expect("a folder");
    let path = here.path();
    let rows = bolster().record();
    let peak = rows.iter().map(|row| row[1]).fold(0.0, f64::max);
    let with = |change: &dyn Fn([f64; 2]) -> [f64; 2]| rows.iter().map(|row| change(*row)).collect::<Vec<_>>();
    let ask = |rows: &[[f64; 2]], heading: &str| {
        write(path, rows);
        let text = fs::read_to_string(path.join("drop.csv")).expect("a record");
        fs::write(path.join("drop.csv"), text.replace("t[ms],acceleration[g]", heading)).expect("a record");
        let words = ["surface", "drop.csv", "--mass", "6.8 kg", "--speed", "5.2 m/s", "-o", "s.toml", "-f"];
        let output = answer(path, &words);
        let said = String::from_utf8_lossy(&output.stdout).into_owned() + &err(&output);
        (output.status.code() == Some(0), said.split_whitespace().collect::<Vec<_>>().join(" "))
    };
    const USUAL: &str = "t[ms],acceleration[g]";
    let back = rows.iter().position(|row| row[1] == peak).expect("a peak");
    let cases: [Case; 11] = [
        ("no contact", with(&|[t, _]| [t, 0.0]), USUAL, false, "no contact"),
        ("wrong sign", with(&|[t, a]| [t, -a]), USUAL, true, "its sign was turned"),
        ("both signs", with(&|[t, a]| [t, if t > 0.04 { -30.0 } else { a }]), USUAL, false, "both signs"),
        ("gravity in it", with(&|[t, a]| [t, a - 1.0]), USUAL, true, "taken as zero"),
        ("no rebound", rows[..=back].to_vec(), USUAL, true, "not measured"),
        ("half the mass", with(&|[t, a]| [t, 0.5 * a]), USUAL, false, "not stop"),
        ("saturated", with(&|[t, a]| [t, a.min(0.8 * peak)]), USUAL, true, "saturated"),
        ("second impact", with(&|[t, a]| [t, if t > 0.05 { 10.0 } else { a }]), USUAL, true, "second impact"),
        ("no unit", rows.clone(), "t[ms],acceleration", false, "no unit"),
        (
            "times that go back",
            with(&|[t, a]| [if t > 0.02 { t - 0.01 } else { t }, a]),
            USUAL,
            false,
            "times that increase",
        ),
        ("nothing known", rows.clone(), "t[ms],x[mm]", false, "no force and no acceleration"),
    ];
    for (name, rows, heading, is_done, expected) in cases {
        let (did, said) = ask(&rows, heading);
        assert!(did == is_done && said.contains(expected), "{name}: {did} {said}");
    }
}

#[test]
fn a_surface_file_is_checked_and_what_was_not_measured_is_asked_for() {
    let here = tempfile::tempdir().expect("a folder");
    let path = here.path();
    let scenario = include_str!("../../../scenarios/head-drop.toml");
    let own = "plate = { file = \"s.toml\" }";
    fs::write(path.join("case.toml"), scenario.replace("plate = { library = \"head_dummy\" }", own))
        .expect("a scenario");
    let good = "title = \"a\"\n[material]\ndepth = [\"0 mm\", \"9 mm\"]\nforce = [0, 30000]\nreturned = 0.2\nfriction = 0.3\n[measured]\nloading = \"measured\"\nunloading = \"measured\"\nfriction = \"made_up\"\n[provenance]\nsource = \"x\"\n";
    let ask = |text: Option<&str>, more: &[&str]| {
        let file = path.join("s.toml");
        let _ = fs::remove_file(&file);
        text.iter().for_each(|text| fs::write(&file, text).expect("a surface"));
        err(&answer(path, &[&["check", "case.toml"][..], more].concat()))
    };
    assert!(!ask(Some(good), &[]).contains("error"));
    let unsaid = good.replace("friction = 0.3\n", "").replace("friction = \"made_up\"", "friction = \"not_measured\"");
    assert!(!ask(Some(&unsaid), &["--set", "materials.plate.friction=0.4"]).contains("error"));
    for (text, expected) in [
        (None, "`s.toml` cannot be read"),
        (Some(unsaid), "the friction of s.toml was not measured"),
        (Some(good.replace("returned = 0.2\n", "")), "no way back in `material`"),
        (Some(good.replace("source", "sources")), "did you mean `source`?"),
        (Some(good.replace("30000", "\"30 kg\"")), "s.toml:4:17"),
        (Some(good.replace("loading = \"measured\"", "loading = \"guessed\"")), "\"guessed\" is not a value"),
        (Some(good.replace("friction = 0.3", "file = \"s.toml\"")), "refers to another"),
        (Some(good.replace("30000", "-3")), "s.toml"),
        (Some("title = ".to_owned()), "s.toml:1"),
    ] {
        let said = ask(text.as_deref(), &[]);
        assert!(said.contains(expected), "{expected}: {said}");
    }
    assert!(ask(Some(good), &["--set", "materials.plate.library=\"dash_s10\""]).contains("together"));
}
