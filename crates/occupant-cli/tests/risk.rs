//! `occupant risk` as sentences: closed forms and vectors through the command itself, and what it refuses.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

use crate::common::{CASE, done};

fn occupant(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

/// A file of constant channels, `rate` samples a second over 0.2 s.
fn steady(folder: &Path, header: &str, values: &str, rate: usize) {
    let lines = (0..=rate / 5).map(|i| format!("{:.6},{values}\n", i as f64 / rate as f64));
    let text = format!("t[s],{header}\n{}", lines.collect::<String>());
    fs::write(folder.join("a.csv"), text).expect("written");
}

fn json(folder: &Path, arguments: &[&str]) -> Value {
    let (code, out, said) = occupant(folder, &[&["risk", "--json"], arguments].concat());
    assert_eq!(code, 0, "{said}");
    serde_json::from_str(&out).expect("JSON")
}

fn value(report: &Value, key: &str) -> f64 {
    let value = &report["measures"][key]["value"];
    value.as_f64().unwrap_or_else(|| panic!("no {key} in {report:#}"))
}

#[track_caller]
fn assert_near(found: f64, expected: f64, bound: f64) {
    assert!((found - expected).abs() < bound, "found {found}, expected {expected}");
}

const G: f64 = 9.806_65;

#[test]
fn steady_accelerations_give_the_closed_forms() {
    let folder = folder();
    steady(folder.path(), "ax[g],ay[g],az[g],wx[deg/s],wy[deg/s],wz[deg/s]", "-10,5,0,0,0,0", 10_000);
    let report = json(folder.path(), &["a.csv"]);
    let of = |key| value(&report, key);
    assert_near(of("oiv_x_m_s"), 10.8480, 5e-5);
    assert_near(of("oiv_y_m_s"), 5.4240, 5e-5);
    assert_near(of("ora_x_m_s2") / G, -10.0, 1e-8);
    assert_near(of("ora_y_m_s2") / G, 5.0, 1e-8);
    assert_near(of("thiv_m_s") * 3.6, 3.6 * (1.25 * 1.2 * 10.0 * G).sqrt(), 1e-4);
    assert_near(of("phd_m_s2") / G, 125f64.sqrt(), 1e-8);
    let asi = ((10.0f64 / 12.0).powi(2) + (5.0f64 / 9.0).powi(2)).sqrt();
    assert_near(of("asi_1998"), asi, 1e-8);
    assert_near(of("asi_2010"), asi, 1e-8);
    assert_near(of("max_50ms_x_m_s2") / G, -10.0, 1e-8);
    assert_near(of("max_50ms_y_m_s2") / G, 5.0, 1e-8);
    assert_near(of("final_velocity_change_x_m_s"), -2.0 * G, 1e-8);
    assert_near(of("olc_m_s2") / G, 600.0 / 47.0, 1e-7);
    let when = report["measures"]["oiv_x_m_s"]["when_s"][0].as_f64().unwrap();
    assert_near(when, 0.110_619, 1e-6);
    assert_eq!(report["left_out"], serde_json::json!([]));
}

#[test]
fn lateral_impact_first_and_units_of_choice() {
    let folder = folder();
    steady(folder.path(), "ay[m/s^2],ax[ft/s^2]", "78.4532,-160.8702", 10_000);
    let report = json(folder.path(), &["a.csv", "--cfc", "none"]);
    assert_near(value(&report, "oiv_x_m_s"), 4.288_06, 1e-5);
    assert_near(value(&report, "oiv_y_m_s"), 6.860_90, 1e-5);
}

#[test]
fn the_yawing_vectors_of_thiv() {
    let folder = folder();
    steady(folder.path(), "ax[g],ay[g],yaw_rate[deg/s]", "-8,6,100", 100_000);
    let thiv = |arguments: &[&str]| {
        value(&json(folder.path(), &[&["a.csv", "--cfc", "none"], arguments].concat()), "thiv_m_s") * 3.6
    };
    assert_near(thiv(&[]), 33.396_092, 1e-5);
    assert_near(thiv(&["--head-start", "30 cm"]), 32.053_305, 1e-5);
}

#[test]
fn distances_first_contact_and_gravity_are_options() {
    let folder = folder();
    steady(folder.path(), "ax[g],ay[g],az[g]", "-10,0,-1", 10_000);
    let report =
        json(folder.path(), &["a.csv", "--flail-x", "0.3 m", "--start", "50 ms", "--to", "0.19", "--gravity-included"]);
    let met_s = (0.6 / (10.0 * G)).sqrt();
    assert_near(value(&report, "oiv_x_m_s"), 10.0 * G * met_s, 1e-6);
    let when = report["measures"]["oiv_x_m_s"]["when_s"][0].as_f64().unwrap();
    assert_near(when, 0.05 + met_s, 1e-6);
    assert_near(value(&report, "max_50ms_z_m_s2"), 0.0, 1e-9);
    assert_near(report["record"]["end_s"].as_f64().unwrap(), 0.19, 1e-9);
    // the former name of --to
    let former = json(folder.path(), &["a.csv", "--end", "0.19"]);
    assert_near(former["record"]["end_s"].as_f64().unwrap(), 0.19, 1e-9);
}

#[test]
fn axes_that_point_up_are_turned() {
    let folder = folder();
    steady(folder.path(), "ax[g],ay[g],az[g]", "0,5,-2", 10_000);
    let report = json(folder.path(), &["a.csv", "--z-up"]);
    assert_near(value(&report, "max_50ms_y_m_s2") / G, -5.0, 1e-8);
    assert_near(value(&report, "max_50ms_z_m_s2") / G, 2.0, 1e-8);
}

#[test]
fn missing_channels_leave_measures_out_with_the_reason() {
    let folder = folder();
    steady(folder.path(), "ax[g],ay[g]", "-10,0", 10_000);
    let (code, out, _) = occupant(folder.path(), &["risk", "a.csv"]);
    assert_eq!(code, 0);
    for line in [
        "  THIV and PHD: needs wz, which the record does not have",
        "  ASI (EN 1317-1:1998): needs az, which the record does not have",
        "  max yaw: needs wz, which the record does not have",
    ] {
        assert!(out.contains(line), "{line}\n{out}");
    }
    assert!(out.contains("OIV x") && out.contains("10.85") && out.contains("35.6"), "{out}");
}

#[test]
fn rules_judge_with_margin_and_origin() {
    let folder = folder();
    steady(folder.path(), "ax[g],ay[g],az[g],wz[deg/s]", "-14,0,0,0", 10_000);
    let (code, out, said) = occupant(folder.path(), &["risk", "a.csv", "--rule", "mash"]);
    assert_eq!(code, 1);
    assert!(said.contains("beyond the limit: MASH 2016 OIV x"), "{said}");
    // √(2·14 g·0.6 m) = 12.84 m/s, 0.64 beyond 12.2
    let line = out.lines().find(|l| l.contains("maximum") && l.contains("OIV x")).unwrap();
    for word in ["MASH 2016", "12.20¹", "12.84", "-0.64", "FAIL"] {
        assert!(line.contains(word), "{word}: {line}");
    }
    assert!(out.contains("¹ limit from a source that quotes the rule"), "{out}");
    assert!(!out.contains("NCHRP"), "{out}");
    assert!(out.contains("MASH 2016: AASHTO, Manual for Assessing Safety Hardware, 2nd edition, 2016"), "{out}");
    // without a rule all are shown, and none decides
    let (code, out, _) = occupant(folder.path(), &["risk", "a.csv"]);
    assert_eq!(code, 0);
    for document in ["NCHRP Report 350, TRB, 1993", "EN 1317-2:2010", "EN 1317-3:2010", "EN 12767:2007"] {
        assert!(out.contains(document), "{document}: {out}");
    }
    assert!(out.contains("NCHRP 350") && out.contains("EN 1317-1:2010"), "{out}");
    let (code, _, _) = occupant(folder.path(), &["risk", "a.csv", "--rule", "en1317-1998"]);
    assert_eq!(code, 1, "a THIV of 46 km/h");
}

#[test]
fn a_file_with_errors_gives_all_of_them_with_their_places() {
    let folder = folder();
    fs::write(folder.path().join("a.csv"), "t[s],ax[kg],q[g]\n0,1,2\n0.1,x,2\n").unwrap();
    let (code, out, said) = occupant(folder.path(), &["risk", "a.csv"]);
    assert_eq!((code, out.as_str()), (2, ""));
    assert!(said.contains("error: `x`\n --> a.csv:3:5"), "{said}");
    fs::write(folder.path().join("a.csv"), "t[s],ax[kg],q[g]\n0,1,2\n0.1,1,2\n").unwrap();
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv"]);
    assert!(code == 2 && said.contains("a.csv:1: `kg` is not a unit for ax"), "{said}");
    // what is no motion of the vehicle is named
    fs::write(folder.path().join("a.csv"), "t[s],ax[g],q[g]\n0,1,2\n0.1,1,2\n").unwrap();
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv", "--cfc", "none"]);
    assert!(code == 0 && said.contains("note: not used: q"), "{said}");
    fs::write(folder.path().join("a.csv"), "t[s],ax[g]\n0,1\n0.1,1\n0.1,1\n0.05,1\n").unwrap();
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv"]);
    assert_eq!(code, 2);
    assert!(said.contains("a.csv:4") && said.contains("a.csv:5"), "{said}");
    fs::write(folder.path().join("a.csv"), [0xff, 0xfe, 0x00]).unwrap();
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv"]);
    assert!(code == 2 && said.contains("neither UTF-8 nor UTF-16"), "{said}");
}

#[test]
fn uneven_and_coarse_samples_are_refused_with_a_remedy() {
    let folder = folder();
    let lines = (0..=200).map(|i| format!("{},-10,0\n", if i == 70 { 70.4 } else { f64::from(i) }));
    let text = format!("t[ms],ax[g],ay[g]\n{}", lines.collect::<String>());
    fs::write(folder.path().join("a.csv"), text).unwrap();
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv"]);
    assert_eq!(code, 2);
    assert!(said.contains("sample 71 is at") && said.contains("--interval"), "{said}");
    let report = json(folder.path(), &["a.csv", "--interval", "0.1 ms"]);
    assert_near(value(&report, "oiv_x_m_s"), 10.8480, 5e-5);

    steady(folder.path(), "ax[g],ay[g]", "-10,0", 500);
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv"]);
    assert_eq!(code, 2);
    assert!(said.contains("half the sample rate, 250 Hz") && said.contains("--filter CFC60"), "{said}");
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv", "--cfc", "60"]);
    assert!(code == 0 && said.contains("less than ten times the class"), "{code} {said}");

    steady(folder.path(), "ax[g],ay[g]", "-10,0", 200);
    let (_, _, said) = occupant(folder.path(), &["risk", "a.csv"]);
    assert!(said.contains("the sample rate is too low for any class; use --filter none"), "{said}");
}

#[test]
fn gravity_that_seems_to_be_in_a_record_or_not_is_told() {
    let folder = folder();
    for (az, flags, words) in [
        ("-1", &[][..], "use --gravity-included"),
        ("1", &[], "use --axes z_up"),
        ("0", &["--gravity-included"], "leave --gravity-included out"),
        ("-1", &["--gravity-included"], ""),
        ("0", &[], ""),
    ] {
        steady(folder.path(), "ax[g],az[g]", &format!("-10,{az}"), 10_000);
        let (code, _, said) = occupant(folder.path(), &[&["risk", "a.csv"], flags].concat());
        assert_eq!((code, said.contains("az begins at")), (0, !words.is_empty()), "{said}");
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn sensors_away_from_the_centre_need_their_rates() {
    let folder = folder();
    // a steady spin of 2 rad/s: at 1.5 m ahead, 6 m/s² towards the c.g.
    steady(folder.path(), "ax[m/s^2],ay[m/s^2],az[m/s^2],wx[rad/s],wy[rad/s],wz[rad/s]", "-6,0,0,0,0,2", 10_000);
    let report = json(folder.path(), &["a.csv", "--offset", "1.5,0,0"]);
    assert_near(value(&report, "max_50ms_x_m_s2"), 0.0, 1e-8);
    assert_near(value(&report, "max_yaw_rad"), 0.4, 1e-9);
    steady(folder.path(), "ax[m/s^2],wz[rad/s]", "-6,2", 10_000);
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv", "--offset", "1.5,0,0"]);
    assert!(code == 2 && said.contains("wx, wy are missing"), "{said}");
    let (code, _, said) = occupant(folder.path(), &["risk", "a.csv", "--offset", "1.5,0"]);
    assert!(code == 2 && said.contains("found 2 lengths, expected 3"), "{said}");
}

const SCENARIO: &str = include_str!("recording/short.toml");

#[test]
fn a_scenario_and_its_results_give_the_same() {
    let folder = folder();
    fs::write(folder.path().join("short.toml"), SCENARIO).unwrap();
    let (code, _, said) = occupant(folder.path(), &["run", "short.toml", "-q"]);
    assert_eq!(code, 0, "{said}");
    let (scenario, run) = (json(folder.path(), &["short.toml"]), json(folder.path(), &["short.mcap"]));
    assert_eq!(scenario["measures"], run["measures"]);
    assert!(value(&scenario, "final_velocity_change_x_m_s") < 0.0);
    assert_eq!(scenario["source"], "path of a scenario, sampled");
    for arguments in [
        &["risk", "short.mcap", "--set", "time.end=1"][..],
        &["risk", "short.toml", "--z-up"],
        &["risk", "short.toml", "--interval", "1e-12"],
        &["risk", "short.toml", "--interval", "-1"],
        &["risk", "short.toml", "--interval", "1 m"],
        &["risk", "short.toml", "--start", "5"],
        &["risk", "none.csv"],
    ] {
        let (code, out, said) = occupant(folder.path(), arguments);
        assert!(code == 2 && out.is_empty() && said.starts_with("error: "), "{arguments:?} {said}");
    }
}

#[test]
fn a_pulse_has_the_velocity_change_that_the_scenario_says() {
    let folder = folder();
    fs::write(folder.path().join("cart.toml"), include_str!("../../../tests/data/carts/cart-lap.toml")).unwrap();
    let report = json(folder.path(), &["cart.toml"]);
    // 20 mph; the filter and trapezoids at 0.1 ms leave 1.2e-5
    assert_near(value(&report, "final_velocity_change_x_m_s"), -8.9408, 1e-4);
    assert_near(value(&report, "max_velocity_change_y_m_s"), 0.0, 1e-9);
    assert_near(value(&report, "max_roll_rad"), 0.0, 1e-12);
}

/// All of the page but its head and its origin stands folded on the page of the run, once for runs that share a motion; a vehicle that
/// is at rest has nothing to say.
#[test]
fn the_page_of_a_run_has_what_risk_says_of_its_vehicle() {
    let folder = folder();
    fs::write(folder.path().join("case.toml"), CASE).expect("written");
    done(folder.path(), &["run", "case.toml", "-o", "a.mcap"]);
    done(folder.path(), &["run", "case.toml", "--set", "joints.*.damping=2", "-o", "b.mcap"]);
    done(folder.path(), &["run", "case.toml", "--set", "path={ kind = \"fixed\" }", "-o", "still.mcap"]);
    let page = |words: &[&str]| {
        done(folder.path(), &[words, &["-f", "--units", "si", "-o", "page.html"]].concat());
        fs::read_to_string(folder.path().join("page.html")).expect("a page")
    };
    let risk = page(&["risk", "a.mcap"]);
    let from = risk.find("<h2>Measures").expect("measures");
    let to = risk.find("<h2>Source").expect("an origin");
    assert!(risk[from..to].contains("MASH 2016") && risk[from..to].contains("PHD"));
    let both = page(&["report", "a.mcap", "b.mcap"]);
    assert!(both.contains(&risk[from..to]));
    assert_eq!(both.matches("<summary>Motion of").count(), 1);
    assert!(!page(&["report", "still.mcap"]).contains("Motion of"));
}

/// The class or level of a rule, by steady accelerations of 0.2 s.
#[test]
fn classes_and_levels_are_the_best_whose_bounds_are_all_kept() {
    let folder = folder();
    let judged = |x: f64, y: f64, z: f64, rule: &str, flags: &[&str]| {
        steady(folder.path(), "ax[g],ay[g],az[g],wx[deg/s],wy[deg/s],wz[deg/s]", &format!("{x},{y},{z},0,0,0"), 10_000);
        let report = json(folder.path(), &[&["a.csv"], flags].concat());
        let classes = report["classes"].as_array().unwrap();
        let found = classes.iter().find(|c| c["rule"] == rule).unwrap_or_else(|| panic!("no {rule}"));
        found["class"].as_str().map_or_else(|| found["by"].as_str().unwrap().to_owned(), str::to_owned)
    };
    let class = |x, y, z, rule| judged(x, y, z, rule, &[]);
    // THIV √(2·0.6 m·a): 24.7 km/h at 4 g, 39.1 at 10 g; ASI of z alone is z/10
    let en1317 = |x, y, z| class(x, y, z, "EN 1317-1:2010");
    assert_eq!(en1317(-4.0, 0.0, 0.0), "class A");
    assert_eq!(en1317(-4.0, 0.0, 12.0), "class B");
    assert_eq!(en1317(-4.0, 0.0, 18.0), "class C");
    assert_eq!(en1317(-4.0, 0.0, 20.0), "beyond ASI (2010) 2.03 of 1.90");
    assert_eq!(en1317(-10.0, 0.0, 0.0), "beyond THIV 39.1 of 33.0 km/h");
    assert_eq!(class(-10.0, 0.0, 0.0, "EN 1317-3 (cushion, head on)"), "class A");
    assert_eq!(class(-10.0, 0.0, 0.0, "EN 1317-3 (cushion, side)"), "beyond THIV 39.1 of 33.0 km/h");
    // PHD, of the edition of 1998 alone
    assert_eq!(class(-4.0, 0.0, 0.0, "EN 1317-1:1998"), "class A");
    let en12767 = |x, y, z| class(x, y, z, "EN 12767 (50 to 100 km/h)");
    // √(2·0.1 m·4.7 g) = 10.9 km/h
    let near = judged(-4.7, 0.0, 0.0, "EN 12767 (50 to 100 km/h)", &["--flail-x", "0.1 m"]);
    assert_eq!(near, "level NE 3");
    assert_eq!(en12767(-4.0, 0.0, 0.0), "levels HE 3, LE 3, NE 2");
    assert_eq!(en12767(-6.0, 0.0, 0.0), "levels HE 2, LE 2, NE 1");
    assert_eq!(en12767(-6.0, 0.0, 11.5), "levels HE 1, LE 1");
    assert_eq!(en12767(-10.0, 0.0, 14.0), "beyond ASI (1998) 1.63 of 1.40");
    assert_eq!(class(-4.0, 0.0, 0.0, "EN 12767 (35 km/h)"), "all levels but NE 3");
    // a bound that could not be looked at
    steady(folder.path(), "ax[g],ay[g],az[g]", "-4,0,0", 10_000);
    let out = occupant(folder.path(), &["risk", "a.csv", "--rule", "en1317-2010"]).1;
    assert!(out.contains("unknown: THIV was not measured"), "{out}");
}
