//! Records as laboratories have them: encodings, headings, holes, axes, rounding, zero errors; what is found is said with its remedy.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::common::{answer, done, err, spoken};

const G: f64 = 9.806_65;

/// A guardrail impact of 1.2 s, 2000 samples a second, from 50 ms before contact on; along x, y, z in g, about z in deg/s.
fn motion(t: f64) -> [f64; 4] {
    let bump = |from: f64, length: f64| {
        let u = (t - from) / length;
        if (0.0..1.0).contains(&u) { (std::f64::consts::PI * u).sin().powi(2) } else { 0.0 }
    };
    let noise = |k: f64| 0.15 * (1234.5 * k * t + k).sin();
    [
        -7.5 * bump(0.0, 0.32) - 3.0 * bump(0.3, 0.5) + noise(1.0),
        -6.0 * bump(0.0, 0.26) - 9.0 * bump(0.2, 0.09) + noise(1.3),
        2.0 * bump(0.05, 0.12) + noise(1.7),
        -95.0 * bump(0.02, 0.55),
    ]
}

fn times() -> impl Iterator<Item = f64> {
    (-100..2400).map(|i| f64::from(i) * 5e-4)
}

/// The record with these headings and this line for each time.
fn table(headings: &str, line: impl Fn(f64, [f64; 4]) -> Option<String>) -> String {
    let lines = times().filter_map(|t| line(t, motion(t)));
    format!("{headings}\n{}", lines.collect::<String>())
}

fn plain(t: f64, [x, y, z, r]: [f64; 4]) -> Option<String> {
    Some(format!("{t:.4},{x:.5},{y:.5},{z:.5},{r:.5}\n"))
}

const HEADINGS: &str = "t[s],ax[g],ay[g],az[g],wz[deg/s]";

fn measures(here: &Path, arguments: &[&str]) -> Value {
    let out = done(here, &[&["risk", "--json"], arguments].concat());
    serde_json::from_str::<Value>(&out).unwrap()
}

fn value(report: &Value, key: &str) -> f64 {
    report["measures"][key]["value"].as_f64().unwrap_or_else(|| panic!("no {key}"))
}

/// One motion in nine files gives one report.
#[test]
fn the_same_motion_is_read_from_every_laboratory() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("plain.csv"), table(HEADINGS, plain)).unwrap();
    let expected = measures(here, &["plain.csv", "--start", "0"])["measures"].clone();
    let german = |t: f64, [x, y, z, r]: [f64; 4]| {
        Some(format!("{:.1};{x:.5};{y:.5};{z:.5};{r:.5}\r\n", 1e3 * t).replace('.', ","))
    };
    let latin: Vec<u8> = table("Zeit [ms];L\u{e4}ngsbeschl. [g];Querbeschl. [g];az [g];Gierrate [\u{b0}/s]\r", german)
        .chars()
        .map(|c| c as u8)
        .collect();
    let wide: Vec<u8> = format!(
        "\u{feff}{}",
        table("TIME (MSEC)\tCG Ax (G)\tCG Ay (G)\tCG Az (G)\tYAW RATE (DEG/SEC)", |t, m| {
            plain(1e3 * t, m).map(|line| line.replace(',', "\t"))
        })
    )
    .encode_utf16()
    .flat_map(u16::to_le_bytes)
    .collect();
    let preamble = format!(
        "Test,469467-3-1\nVehicle,2270P\nSample rate,2000\n\n{}",
        table("Time (s),CG X (g),CG Y (g),CG Z (g),Yaw (deg/s)", plain)
    );
    let codes =
        table("t[s],10VEHCCG0000ACXD[g],10VEHCCG0000ACYD[g],10VEHCCG0000ACZD[g],10VEHCCG0000AVZD[deg/s]", plain);
    let up = table(HEADINGS, |t, [x, y, z, r]| plain(t, [x, -y, -z, -r]));
    let words = table(&format!("{HEADINGS},trigger,channel 9 (V)"), |t, m| {
        plain(t, m).map(|line| line.replace('\n', ",off,N/A\n"))
    });
    for (name, bytes, flags) in [
        ("latin.csv", latin, &[][..]),
        ("wide.txt", wide, &[]),
        ("preamble.csv", preamble.into_bytes(), &[]),
        ("codes.csv", codes.into_bytes(), &[]),
        ("up.csv", up.into_bytes(), &["--axes", "z_up"]),
        ("words.csv", words.into_bytes(), &[]),
        ("mirror.csv", table(HEADINGS, plain).into_bytes(), &["--columns", "t[s],ax[g],ay[g],az[g],wz[deg/s]"]),
    ] {
        fs::write(here.join(name), bytes).unwrap();
        let found = measures(here, &[&[name, "--start", "0"], flags].concat())["measures"].clone();
        for (key, measure) in expected.as_object().unwrap() {
            let (a, b) = (measure["value"].as_f64().unwrap(), found[key]["value"].as_f64().unwrap_or(f64::NAN));
            assert!((a - b).abs() <= 1e-9 + 1e-6 * a.abs(), "{name} {key}: {a} {b}");
        }
    }
    let said = spoken(here, &["risk", "words.csv", "--start", "0"]);
    assert!(said.contains("the column `trigger` contains text: skipped"), "{said}");
    assert!(spoken(here, &["risk", "latin.csv", "--start", "0"]).contains("read as Windows-1252"));
    // an ISO-MME test in its folder
    fs::create_dir_all(here.join("T1/Channel")).unwrap();
    fs::write(here.join("T1/T1.mme"), "Title :made up\n").unwrap();
    for (i, (code, unit, factor)) in
        [("ACX", "m/(s*s)", G), ("ACY", "m/(s*s)", G), ("ACZ", "m/(s*s)", G), ("AVZ", "rad/s", 1f64.to_radians())]
            .iter()
            .enumerate()
    {
        let head = format!(
            "Channel code :10VEHCCG0000{code}0\nUnit :{unit}\nReference channel :implicit\nSampling interval :0.0005\nTime of first sample :-0.05\n"
        );
        let values: String = times().map(|t| format!("{:.7}\n", motion(t)[i] * factor)).collect();
        fs::write(here.join(format!("T1/Channel/T1.{:03}", i + 1)), head + &values).unwrap();
    }
    let found = measures(here, &["T1", "--start", "0"]);
    let oiv = (value(&found, "oiv_y_m_s"), expected["oiv_y_m_s"]["value"].as_f64().unwrap());
    assert!((oiv.0 - oiv.1).abs() < 1e-4, "{oiv:?}");
}

#[test]
fn import_takes_the_whole_record_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("plain.csv"), table(HEADINGS, plain)).unwrap();
    let said = spoken(here, &["import", "plain.csv", "--speed", "100 km/h", "-o", "i.toml"]);
    assert!(
        said.contains("2500 times from -0.05 s to 1.1995 s") && said.contains("from 0 s to 1.1995 s (--from"),
        "{said}"
    );
    let [whole, path] = [measures(here, &["plain.csv", "--start", "0"]), measures(here, &["i.toml"])];
    for key in ["ora_y_m_s2", "max_yaw_rad"] {
        // the path is filtered by CFC 60 before: measured 1.4 % apart
        assert!((value(&whole, key) / value(&path, key) - 1.0).abs() < 0.03, "{key}");
    }
    let said = spoken(
        here,
        &["import", "plain.csv", "--speed", "100 km/h", "-f", "-o", "i.toml", "--from", "-20 ms", "--to", "800 ms"],
    );
    assert!(said.contains("from 0 s to 0.8 s (--from"), "{said}");
}

#[test]
fn holes_are_refused_and_bridged_only_if_asked() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let cut = table(HEADINGS, |t, m| if (0.09..0.17).contains(&t) { None } else { plain(t, m) });
    let blank = table(HEADINGS, |t, m| {
        let line = plain(t, m)?;
        Some(if (0.1..0.1021).contains(&t) { format!("{t:.4},,{}", line.splitn(3, ',').nth(2)?) } else { line })
    });
    for (name, text, length) in [("cut.csv", cut, "80.5 ms"), ("blank.csv", blank, "3 ms")] {
        fs::write(here.join(name), text).unwrap();
        for command in [
            &["risk", name, "--start", "0"][..],
            &["risk", name, "--start", "0", "--interval", "0.1 ms"],
            &["import", name, "-o", "b.toml"],
        ] {
            let refused = answer(here, command);
            assert_eq!(refused.status.code(), Some(2), "{command:?}");
            assert!(
                err(&refused).contains("samples are missing")
                    && err(&refused).contains(&format!("--bridge '{length}'")),
                "{}",
                err(&refused)
            );
        }
        let said = spoken(here, &["risk", name, "--start", "0", "--bridge", length]);
        assert!(said.contains("gaps were filled linearly") && said.contains(length), "{said}");
    }
    assert_eq!(answer(here, &["risk", "cut.csv", "--bridge", "10 ms"]).status.code(), Some(2));
}

#[test]
fn a_zero_error_is_said_and_taken_away() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("plain.csv"), table(HEADINGS, plain)).unwrap();
    fs::write(here.join("bias.csv"), table(HEADINGS, |t, [x, y, z, r]| plain(t, [x + 0.15, y - 0.2, z, r + 2.0])))
        .unwrap();
    let said = spoken(here, &["risk", "bias.csv", "--start", "0"]);
    assert!(said.contains("remove it with --baseline '50 ms'") && said.contains("ax 0.1"), "{said}");
    let [sound, bias, mended] = [&["plain.csv"][..], &["bias.csv"], &["bias.csv", "--baseline", "50 ms"]]
        .map(|flags| measures(here, &[flags, &["--start", "0"]].concat()));
    let off = |report: &Value| (value(report, "oiv_x_m_s") / value(&sound, "oiv_x_m_s") - 1.0).abs();
    assert!(off(&bias) > 0.02 && off(&mended) < 0.005, "{} {}", off(&bias), off(&mended));
    spoken(here, &["import", "bias.csv", "--speed", "90 km/h", "--baseline", "50 ms", "-o", "i.toml"]);
    assert!(fs::read_to_string(here.join("i.toml")).unwrap().contains("baseline = \"50 ms\""));
    done(here, &["check", "i.toml"]);
}

/// Printouts of HVOSM, and a table rounded to a millimetre, whose rounding is said, filtered and measured.
#[test]
fn tables_of_places_are_read_with_their_angles_and_filtered() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let rows = |line: &dyn Fn(f64) -> String, dt: f64| {
        (0..=(2.0 / dt) as u32).map(|i| line(f64::from(i) * dt)).collect::<String>()
    };
    let hvosm = rows(
        &|t| {
            format!(
                " {t:9.4} {:9.4} {:9.4} {:9.4} {:8.4} {:8.4} {:8.4}\n",
                800.0 * t,
                40.0 * t * t,
                0.0,
                12.0 * t,
                3.0 * t,
                20.0 * t
            )
        },
        0.02,
    );
    fs::write(here.join("hvosm.txt"), format!("   TIME         X         Y         Z       PHI     THETA       PSI\n    SEC        IN        IN        IN       DEG       DEG       DEG\n{hvosm}")).unwrap();
    let said = spoken(here, &["import", "hvosm.txt"]);
    assert!(said.contains("axes are taken as x forward, y right, z down"), "{said}");
    let path = fs::read_to_string(here.join("hvosm-path.csv")).unwrap();
    assert!(
        path.starts_with("t[s],x[IN],y[IN],z[IN],roll[DEG],pitch[DEG],yaw[DEG]\n0,0,0,0,0,0,0\n0.02,16,"),
        "{path}"
    );
    assert!(done(here, &["check", "hvosm.toml"]).contains("20.320 m/s at the start"));
    spoken(here, &["import", "hvosm.txt", "-f", "--axes", "z_up"]);
    assert!(fs::read_to_string(here.join("hvosm.toml")).unwrap().contains("axes = \"z_up\""));
    // 2 g sideways for the half of a second, rounded as a printout
    let place = |t: f64| {
        let (a, u) = (2.0 * G, (t - 0.5).clamp(0.0, 0.5));
        a * (0.5 * u * u - (1.0 - (8.0 * std::f64::consts::PI * u / 2.0).cos()) / 16.0 / std::f64::consts::PI.powi(2))
            / 2.0
            + if t > 1.0 { 0.25 * a * (t - 1.0) } else { 0.0 }
    };
    fs::write(
        here.join("p.csv"),
        format!("t[s],x[m],y[m]\n{}", rows(&|t| format!("{t:.3},{:.3},{:.3}\n", 20.0 * t, place(t)), 0.01)),
    )
    .unwrap();
    fs::write(
        here.join("fine.csv"),
        format!("t[s],x[m],y[m]\n{}", rows(&|t| format!("{t:.3},{:.9},{:.9}\n", 20.0 * t, place(t)), 0.01)),
    )
    .unwrap();
    let said = spoken(here, &["import", "p.csv"]);
    assert!(said.contains("is rounded to 0.001 m every 10 ms") && said.contains("--filter '"), "{said}");
    let ora = |flags: &[&str]| value(&measures(here, flags), "ora_y_m_s2") / G;
    let (raw, mended, fine) = (ora(&["p.csv"]), ora(&["p.csv", "--filter", "10 Hz"]), ora(&["fine.csv"]));
    assert!((raw - fine).abs() > 0.1 && (mended - fine).abs() < 0.08, "{raw} {mended} {fine}");
    let said = spoken(here, &["import", "p.csv", "-f", "--filter", "10 Hz"]);
    assert!(said.contains("positions are smoothed above 10 Hz; with 15 Hz, accelerations along"), "{said}");
    // a scenario's own table that is not filtered says so too
    let said = spoken(here, &["risk", "p.toml", "--set", "path.filter=null"]);
    assert!(said.contains("is rounded to 0.001 m every 10 ms") && said.contains("--set path.filter='"), "{said}");
    assert!(!spoken(here, &["risk", "p.toml"]).contains("rounded"));
    let path = ora(&["p.toml"]);
    assert!((path - mended).abs() < 0.02, "{path} {mended}");
}

#[test]
fn recorders_signs_units_and_beginnings_are_asked_for_or_said() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let rows = |sign: f64| {
        (1..=15).map(|i| format!("{},{:.1}\n", 10 * i, sign * 27.0 * (f64::from(i) / 15.0))).collect::<String>()
    };
    fs::write(
        here.join("loss.csv"),
        format!("CDR File Information\nVIN,1G1\n\nTime (msec),Delta-V longitudinal (MPH)\n{}", rows(-1.0)),
    )
    .unwrap();
    let said = spoken(here, &["import", "loss.csv", "--speed", "29 mph"]);
    assert!(
        said.contains("start at 0.01 s; a value of 0 is added at 0 s") && !said.contains("the vehicle gains"),
        "{said}"
    );
    done(here, &["check", "loss.toml"]);
    fs::write(here.join("gain.csv"), format!("Time (msec),Delta-V longitudinal (MPH)\n{}", rows(1.0))).unwrap();
    let said = spoken(here, &["import", "gain.csv"]);
    assert!(said.contains("gains 43.5 km/h") && said.contains("-dvx") && said.contains("--struck front"), "{said}");
    let asked = answer(here, &["import", "gain.csv", "--speed", "29 mph", "-f"]);
    assert!(asked.status.code() == Some(2) && err(&asked).contains("--struck front"), "{}", err(&asked));
    spoken(here, &["import", "gain.csv", "--speed", "29 mph", "-f", "--columns", "t[ms],-dvx[mph]"]);
    let table = |name: &str| fs::read_to_string(here.join(name)).unwrap().replace("MPH", "mph");
    assert_eq!(table("gain-path.csv"), table("loss-path.csv"));
    let said = spoken(here, &["import", "loss.csv", "--speed", "10 mph", "-f"]);
    assert!(said.contains("moves backwards at"), "{said}");
    for (name, text) in [
        ("bare.csv", "Time,DeltaV_X\n0,0\n10,-1\n20,-2\n"),
        ("none.csv", "0,0\n10,-1\n20,-2\n"),
        ("speed.csv", "Time (ms),Vehicle speed (km/h)\n0,5\n10,4\n20,3\n"),
    ] {
        fs::write(here.join(name), text).unwrap();
        let refused = answer(here, &["import", name]);
        assert!(refused.status.code() == Some(2) && err(&refused).contains("--columns"), "{}", err(&refused));
    }
}

#[test]
fn the_page_for_an_authority_has_measures_rules_intervals_and_histories() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // no file has such a name on Windows
    let (name, escaped) = if cfg!(windows) { ("a&b.csv", "a&amp;b.csv") } else { ("a<b>&.csv", "a&lt;b&gt;&amp;.csv") };
    fs::write(here.join(name), table(HEADINGS, plain)).unwrap();
    let command =
        ["risk", name, "--start", "0", "--sensor-error", "gain=2 %", "--sensor-error", "offset=0.05 g", "-o", "r.html"];
    let out = done(here, &command);
    let page = fs::read_to_string(here.join("r.html")).unwrap();
    for words in [
        "OIV x",
        "ORA y",
        "THIV",
        "PHD",
        "ASI (EN 1317-1:2010)",
        "max 50 ms average z",
        "EN 12767",
        "MASH 2016",
        "Monte Carlo",
        "SHA-256",
        escaped,
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(
        page.matches("<svg").count() >= 7
            && !page.contains("a<b>")
            && !page.contains("<script")
            && !page.contains("http-equiv=\"refresh")
    );
    assert!(!page.contains("src=") && !page.contains("href=\"http"));
    assert!(answer(here, &command).status.code() == Some(2), "an existing page");
    assert_eq!(done(here, &[&command[..], &["-f"]].concat()), out);
    assert_eq!(fs::read_to_string(here.join("r.html")).unwrap(), page);
    let report = measures(here, &command[1..8]);
    let oiv = &report["measures"]["oiv_x_m_s"];
    let [low, high] = [0, 1].map(|i| oiv["interval_95"][i].as_f64().unwrap());
    let middle = oiv["value"].as_f64().unwrap();
    // how wide it must be: `examined`
    assert!(low < middle && middle < high, "{low} {middle} {high}");
    assert!(done(here, &["risk", name, "--start", "0", "--units", "in-lbf-s"]).contains("ft/s"));
}
