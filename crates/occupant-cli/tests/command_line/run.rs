use std::process::Stdio;

use super::{answer, code, err, folder_with_case, json, occupant, out, row};

/// The rows of a sphere in the table of contacts: the last that begins with its name, and those without a name below.
fn rows_of<'t>(table: &'t str, sphere: &str) -> Vec<&'t str> {
    let lines: Vec<&str> = table.lines().collect();
    let named = |l: &&str| l.split_whitespace().next() == Some(sphere) && !l.contains("excursion");
    let first = lines.iter().rposition(named).unwrap();
    let more = lines[first + 1..].iter().take_while(|l| l.starts_with(' '));
    [lines[first]].into_iter().chain(more.copied()).collect()
}

#[test]
fn the_table_and_the_json_tell_the_same_numbers() {
    let folder = folder_with_case();
    let table = out(&answer(folder.path(), &["run", "case.toml", "--no-mcap"]));
    let output = answer(folder.path(), &["run", "case.toml", "--no-mcap", "--json"]);
    let json = json(&output);
    // marks of caveats stand behind numbers
    let table = table.replace('!', " ");
    assert_eq!((code(&output), err(&output)), (0, String::new()));
    assert_eq!(json["status"], "completed");
    for part in ["head", "chest", "pelvis"] {
        let a = &json["accelerations"][part];
        let cells = row(&table, part);
        assert_eq!(cells[1], format!("{:.1}", a["peak_g"].as_f64().unwrap()), "{table}");
        assert_eq!(cells[2], format!("{:.1}", 1e3 * a["peak_time_s"].as_f64().unwrap()));
        let held = a["three_ms_contiguous"]["level_g"].as_f64().unwrap();
        assert_eq!(cells[3], format!("{held:.1}"));
        let total = a["three_ms_cumulative"]["level_g"].as_f64().unwrap();
        assert_eq!(cells[5], format!("{total:.1}"));
    }
    for belt in json["belts"].as_array().unwrap() {
        let cells = row(&table, belt["belt"].as_str().unwrap());
        assert_eq!(cells[1], format!("{:.0}", belt["loop_force_n"].as_f64().unwrap()));
        assert_eq!(cells[2], format!("{:.1}", 1e3 * belt["time_s"].as_f64().unwrap()));
    }
    let (_, contacts) = table.split_once("\ncontact ").unwrap();
    let (contacts, _) = contacts.split_once("\n\n").unwrap();
    for first in json["first_contacts"].as_array().unwrap() {
        // "head" has a row among the accelerations too: the one below is meant
        let name = first["sphere"].as_str().unwrap();
        if !contacts.lines().any(|line| line.starts_with(name)) {
            // a part that did not strike anything, of which the table is silent
            assert!(first["contact"].is_null(), "{first}");
            continue;
        }
        let rows: Vec<&str> = rows_of(contacts, name);
        if let Some(contact) = first["contact"].as_object() {
            let told = [
                contact["surface"].as_str().unwrap().to_owned(),
                format!("{:.1}", 1e3 * contact["time_s"].as_f64().unwrap()),
                format!("{:.2}", contact["speed_m_s"].as_f64().unwrap()),
                format!("{:.2}", contact["closing_m_s"].as_f64().unwrap()),
            ];
            let has = |row: &&str| {
                let cells: Vec<&str> = row.split_whitespace().collect();
                cells.windows(4).any(|w| w == told)
            };
            assert!(rows.iter().any(has), "{told:?} in {rows:?}");
        } else {
            // what touched at the start, or nothing at all
            assert!(rows.iter().all(|r| r.contains("at start") || r.contains('–')), "{rows:?}");
        }
    }
    let solver = &json["solver"];
    assert!(table.contains(&format!("{} steps, {} evaluations", solver["steps"], solver["evaluations"])));
    assert!(table.contains(&format!("{:.1e}", json["energy"]["balance_error"].as_f64().unwrap())));
}

#[test]
fn figures_that_cannot_be_trusted_say_so_wherever_they_stand() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/carts/cart-lap-torso.toml");
    let said = |words: &[&str]| {
        let output = answer(folder.path(), words);
        assert_eq!(code(&output), 0, "{}", err(&output));
        output
    };
    let neck = "neck beyond its stop: 119° at 131.7 ms, the stop ends at 60°; do not quote neck results";
    let table = out(&said(&["run", scenario, "-o", "a.mcap"]));
    assert!(table.contains(&format!("! {neck}\n")), "{table}");
    assert!(row(&table, "Nij")[1].ends_with('!') && !row(&table, "HIC15")[1].ends_with('!'), "{table}");
    let measures = json(&said(&["measures", "a.mcap", "--json"]));
    assert_eq!(
        (&measures["caveats"][0]["name"], &measures["caveats"][0]["text"]),
        (&"neck_beyond_stop".into(), &neck.into())
    );
    let measured = out(&said(&["measures", "a.mcap"]));
    assert!(measured.contains(&format!("! {neck}\n")));
    let risk = |from: &str| {
        measured
            .lines()
            .filter(|l| l.contains("AIS3+ ") && l.contains(from) && !l.contains(':'))
            .all(|l| l.ends_with('!'))
    };
    assert!(risk("Nij") && !risk("HIC15"), "a risk is no better than its measure: {measured}");
    said(&["report", "a.mcap", "-o", "a.html"]);
    assert!(std::fs::read_to_string(folder.path().join("a.html")).unwrap().contains(neck));
    let printed = out(&said(&["print", "a.mcap"]));
    assert!(printed.contains("*** neck beyond its stop: 119°"), "{}", &printed[printed.len() - 4000..]);
    // a filter has readings at 10 kHz, from the same motion
    let filtered = said(&["measures", "a.mcap", "--filter", "sae-j211"]);
    assert!(!err(&filtered).contains("run again"), "{}", err(&filtered));
    let filtered = out(&filtered);
    assert!(filtered.contains("readings every 0.1 ms") && !filtered.contains("too coarse"), "{filtered}");
    let value = |table: &str| row(table, "HIC15")[1].trim_end_matches('!').parse::<f64>().unwrap();
    let again = out(&said(&["measures", "a.mcap", "--interval", "0.1 ms"]));
    let closer = out(&said(&["run", scenario, "--no-mcap", "--set", "output.interval=\"0.1 ms\""]));
    assert_eq!(value(&again), value(&closer), "{again}");
    assert!((value(&filtered) / value(&again) - 1.0).abs() < 0.05, "{filtered}");
    // the file has these readings; with fewer, the figure is another one, and the answer says what they are worth
    assert_eq!(value(&again), value(&measured));
    let fewer = said(&["measures", "a.mcap", "--interval", "1 ms"]);
    assert!(err(&fewer).contains("with samples every 1 ms; the file has one every 0.1 ms"), "{}", err(&fewer));
    let fewer = out(&fewer);
    assert!(fewer.contains("! readings every 1 ms are too coarse for "), "{fewer}");
    // measured: 146.7 of 146.8
    assert!((value(&fewer) / value(&measured) - 1.0).abs() < 2e-3, "{fewer}");
    let other = out(&said(&["measures", "a.mcap", "--dummy", "hybrid-iii-5f"]));
    // side by side: the same run twice has the same figures twice, each as its own table has it
    let both = out(&said(&["measures", "a.mcap", "a.mcap"]));
    let row = |text: &str| text.lines().find(|line| line.starts_with("HIC15 ")).unwrap().to_owned();
    let value = row(&measured).split_whitespace().nth(1).unwrap().to_owned();
    assert_eq!(row(&both).split_whitespace().filter(|word| word.trim_end_matches('>') == value).count(), 2, "{both}");
    assert!(both.contains("\n2  a.mcap: "), "{both}");
    let list = json(&said(&["measures", "a.mcap", "a.mcap", "--json"]));
    assert_eq!((list.as_array().map(Vec::len), &list[1]), (Some(2), &measures));
    assert!(other.contains("! limits and risks are for a Hybrid III 5F of 49 kg"), "{other}");
    let check = out(&said(&["check", scenario]));
    assert!(check.contains("set posture.settle = true"), "{check}");
}

#[test]
fn a_run_that_fails_marks_every_figure_and_judges_its_energy_as_far_as_it_came() {
    let folder = tempfile::tempdir().unwrap();
    let said = |words: &[&str], exit: i32| {
        let output = answer(folder.path(), words);
        assert_eq!(code(&output), exit, "{}", err(&output));
        output
    };
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/carts/cart-lap-torso.toml");
    let stiff = ["materials.*.k1=1e8", "integrator={kind=\"rk4\", step=\"1 ms\"}", "time.end=\"100 ms\""];
    let mut words = vec!["run", scenario, "-f", "-o", "a.mcap"];
    words.extend(stiff.iter().flat_map(|change| ["--set", change]));
    let table = out(&said(&words, 1));
    words.push("--json");
    let ran = json(&said(&words, 1));
    let caveat = &ran["caveats"][0];
    assert_eq!((&caveat["name"], &caveat["figures"]), (&"run_failed".into(), &serde_json::json!(["*"])));
    let why = caveat["text"].as_str().unwrap();
    assert!(why.starts_with("the run failed: all results are up to "), "{why}");
    assert!(ran["energy"]["balance_error"].as_f64().is_some_and(|error| error > 0.0), "{}", ran["energy"]);
    // the same of the file that it left
    let measured = json(&said(&["measures", "a.partial.mcap", "--json"], 0));
    assert_eq!(measured["caveats"], ran["caveats"]);
    let measures = out(&said(&["measures", "a.partial.mcap"], 0));
    assert!(table.contains(&format!("! {why}\n")) && measures.contains(&format!("! {why}\n")), "{table}{measures}");
    // a number of a table stands with its mark; only limits and margins are none of the run
    let unmarked =
        |row: &&str| row.split_whitespace().skip(1).filter(|cell| is_figure(cell)).any(|cell| !cell.ends_with('!'));
    for name in ["head", "chest", "pelvis", "lap", "torso"] {
        let rows = rows_of(&table, name);
        assert!(!rows.is_empty() && !rows.iter().any(unmarked), "{rows:?}");
    }
    assert!(row(&table, "energy")[3].ends_with('!') && row(&table, "HIC15")[1].ends_with('!'), "{table}");
    said(&["report", "a.partial.mcap", "-o", "a.html"], 0);
    let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
    assert!(page.contains("\"caveats\":[0") && !page.contains("\"caveats\":[]"));
    let printed = out(&said(&["print", "a.partial.mcap"], 0));
    assert!(printed.contains(&format!("*** {why}")), "{}", &printed[printed.len() - 4000..]);
}

/// Whether a cell of a table begins like a number.
fn is_figure(cell: &str) -> bool {
    cell.starts_with(|c: char| c.is_ascii_digit())
}

#[test]
fn a_run_keeps_its_energy_balance() {
    let folder = folder_with_case();
    let output = answer(folder.path(), &["run", "case.toml", "--no-mcap", "--json"]);
    let error = json(&output)["energy"]["balance_error"].as_f64().unwrap();
    // measured: 2e-6
    assert!(error < 1e-3, "{error}");
}

#[test]
fn the_error_of_a_run_is_estimated_by_a_finer_one() {
    let folder = folder_with_case();
    let estimate = |step: &str| {
        let words = ["run", "case.toml", "--no-mcap", "--json", "--estimate-error", "--set", step];
        let output = answer(folder.path(), &words);
        assert_eq!(code(&output), 0, "{}", err(&output));
        json(&output)
    };
    let [coarse, fine] = ["integrator.step=0.4 ms", "integrator.step=0.1 ms"].map(estimate);
    let off = |json: &serde_json::Value| json["error_estimate"]["head_path_m"].as_f64().unwrap();
    // the coarse run's finer one is the fine run: its estimate is their difference
    let figure = |json: &serde_json::Value| json["accelerations"]["head"]["peak_m_s2"].as_f64().unwrap();
    let figures = coarse["error_estimate"]["figures"].as_array().unwrap();
    let peak = figures.iter().find(|f| f["name"] == "head.peak").unwrap();
    assert_eq!(peak["difference"].as_f64().unwrap(), figure(&coarse) - figure(&fine));
    assert!(off(&fine) > 0.0 && off(&fine) < off(&coarse), "{} {}", off(&fine), off(&coarse));
    let table = out(&answer(folder.path(), &["run", "case.toml", "--no-mcap", "--estimate-error"]));
    // the largest forces of the thighs are those of steps, and fall off within one
    let worst = "head path 0.019 mm; contacts.left_thigh.peak 0.3 %, contacts.right_thigh.peak 0.3 %, ";
    let worst = format!("integration error   {worst}contacts.left_hand.first_speed 0.2 %");
    assert!(table.contains(&worst), "{table}");
    assert!(table.contains("estimated from rk4 at a quarter of the step"), "{table}");
}

#[test]
fn values_are_changed_from_the_command_line() {
    let folder = folder_with_case();
    let run = |words: &[&str]| {
        let mut all = vec!["run", "case.toml", "--no-mcap", "--json"];
        all.extend(words);
        let output = answer(folder.path(), &all);
        assert_eq!(code(&output), 0, "{}", err(&output));
        json(&output)
    };
    let shorter = run(&["--set", "time.end=50 ms", "--set", "path.speed=20 mph", "--set", "path.delta_v='20 mph'"]);
    assert_eq!(shorter["reached_s"], 0.05);
    assert_eq!(shorter["overrides"].as_array().unwrap().len(), 3);
    let (as_it_is, slack) = (run(&[]), run(&["--set", "belts.*.slack='8 cm'"]));
    let head = |json: &serde_json::Value| json["head_excursion"]["forward_m"].as_f64().unwrap();
    assert!(head(&slack) > head(&as_it_is), "slack belts let the head go farther");
}

#[test]
fn nothing_is_said_when_quiet() {
    let folder = folder_with_case();
    let output = answer(folder.path(), &["run", "case.toml", "-q"]);
    assert_eq!((code(&output), out(&output), err(&output)), (0, String::new(), String::new()));
    assert!(folder.path().join("case.mcap").exists());
    let output = answer(folder.path(), &["run", "case.toml", "-q", "--json", "--no-mcap"]);
    assert_eq!(json(&output)["status"], "completed");
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let folder = folder_with_case();
    for words in [&["run", "case.toml", "--no-mcap"][..], &["schema"], &["check", "case.toml"]] {
        let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
            .args(words)
            .current_dir(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        assert_eq!(child.wait().unwrap().code(), Some(0), "{words:?}");
    }
}

#[test]
fn a_table_beside_the_scenario_is_found_from_anywhere() {
    let folder = folder_with_case();
    let inner = folder.path().join("inner");
    std::fs::create_dir(&inner).unwrap();
    let text = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    let (before, rest) = text.split_once("[path]").unwrap();
    let (_, after) = rest.split_once("[body]").unwrap();
    let path = "[path]\nkind = \"table\"\nfile = \"path.csv\"\n\n[body]";
    std::fs::write(inner.join("case.toml"), format!("{before}{path}{after}")).unwrap();
    let csv = "t[s],x[m],y[m],z[m],roll[deg],pitch[deg],yaw[deg]\n0,0,0,0,0,0,0\n0.1,1,0,0,0,0,0\n0.2,2,0,0,0,0,0\n0.3,3,0,0,0,0,0\n";
    std::fs::write(inner.join("path.csv"), csv).unwrap();
    let output = answer(folder.path(), &["run", "inner/case.toml", "--no-mcap"]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    std::fs::remove_file(inner.join("path.csv")).unwrap();
    let output = answer(folder.path(), &["run", "inner/case.toml", "--no-mcap"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("path.csv"), "{}", err(&output));
}

#[test]
fn a_run_that_fails_says_when_and_why_and_leaves_what_it_has() {
    let folder = folder_with_case();
    let words = [
        "run",
        "case.toml",
        "--set",
        "integrator.step=5 ms",
        "--set",
        "output.interval=5 ms",
        "--set",
        "materials.*.k1=\"100 MN/m\"",
    ];
    let output = occupant(folder.path()).args(words).output().unwrap();
    assert_eq!(code(&output), 1);
    assert!(err(&output).contains("no longer finite"), "{}", err(&output));
    assert!(err(&output).contains("case.partial.mcap"), "{}", err(&output));
    assert!(out(&output).contains("FAILED"), "{}", out(&output));
    assert!(folder.path().join("case.partial.mcap").exists());
    assert!(!folder.path().join("case.mcap").exists());
}

/// Beyond 2.785, where the method of a fixed step ends, friction chatters and the energy balance shows it; not from 2 on.
/// Speeds of a run that has blown up ask for parts of steps that no clock can tell: it ends with a reason instead.
#[test]
fn a_run_that_blows_up_ends() {
    let folder = folder_with_case();
    let mut words = vec!["run", "case.toml", "--no-mcap"];
    for set in ["time.end='60 ms'", "integrator.step='1 ms'", "belts.lap.k1=4.5727e11", "belts.torso.slack=0.0279594"] {
        words.extend(["--set", set]);
    }
    let output = answer(folder.path(), &words);
    assert_eq!(code(&output), 1);
    assert!(err(&output).contains("is no longer finite"), "{}", err(&output));
}

#[test]
fn friction_is_too_stiff_where_the_energy_balance_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let ran = |name: &str, step: &str| {
        let scenario = format!("{}/../../scenarios/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let step = format!("integrator.step=\"{step}\"");
        let ran = json(&answer(folder.path(), &["run", &scenario, "--no-mcap", "--json", "-q", "--set", &step]));
        let greatest = ran["unstable_friction"].as_array().unwrap().iter().map(|f| f["number"].as_f64().unwrap());
        (greatest.fold(0.0, f64::max), ran["energy"]["balance_error"].as_f64().unwrap())
    };
    for (name, below, beyond) in [
        ("../tests/data/carts/cart-unbelted", "0.125 ms", "0.16 ms"),
        ("../tests/data/hand/rear-seat", "0.075 ms", "0.1 ms"),
    ] {
        let ((none, kept), (number, off)) = (ran(name, below), ran(name, beyond));
        // measured: 2.4e-6 and 3.3e-4, 1.2e-6 and 2.6e-4
        assert!(none == 0.0 && (2.785..4.0).contains(&number), "{name}: {none}, {number}");
        assert!(off > 30.0 * kept, "{name}: {kept}, {off}");
    }
    for name in
        ["../tests/data/carts/cart-unbelted", "../tests/data/hand/rear-seat", "../tests/data/hand/rear-seat-solids"]
    {
        let scenario = format!("{}/../../scenarios/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let said = err(&answer(folder.path(), &["run", &scenario, "--no-mcap"]));
        assert!(!said.contains("too stiff"), "{said}");
    }
}

/// What comes of a body that has left its vehicle is not determined by one run, and the energy balance does not show it.
#[test]
fn a_run_that_throws_someone_out_asks_for_a_second_one() {
    let folder = folder_with_case();
    let rider = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/thrown-rider.toml");
    let said = |words: &[&str]| out(&answer(folder.path(), &[&["run", "--no-mcap"], words].concat()));
    let thrown = said(&[rider, "--until", "0.4"]);
    assert!(thrown.contains("may be chance"), "{thrown}");
    // the verdict itself bears the mark
    let verdict = thrown.split_once("ejected ").expect("a verdict").1.lines().nth(1).expect("a part");
    assert!(verdict.contains('!'), "{verdict}");
    for known in [&[rider, "--until", "0.4", "--estimate-error"][..], &[rider, "--until", "0.05"], &["case.toml"]] {
        assert!(!said(known).contains("may be chance"), "{known:?}");
    }
}
