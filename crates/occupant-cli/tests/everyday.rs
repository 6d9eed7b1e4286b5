//! What makes the program pleasant: tables that fit a terminal, standard input and output, words on what was written.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

use crate::common::{CASE, answer, done, err, folder_with, occupant, spoken};

const STUDY: &str = "title = \"s\"\nbase = \"case.toml\"\ndesign = { kind = \"latin_hypercube\", samples = 12 }\n\
    [set]\n\"time.end\" = \"20 ms\"\n\n[[parameters]]\nname = \"damping\"\npath = \"joints.neck.damping\"\n\
    range = { from = \"5 in lbf s/rad\", to = \"80 in lbf s/rad\", scale = \"log\" }\n\n\
    [[parameters]]\nname = \"speed\"\npath = \"path.speed\"\nrange = { from = \"15 mph\", to = \"25 mph\" }\n";

/// A word at the beginning of a line is the head of a list of facts, whose lines break where the terminal breaks them.
fn is_table(line: &str) -> bool {
    line.contains("   ")
        && ![
            "occupant",
            "vehicle",
            "run",
            "legs",
            "settled",
            "unsettled",
            "joints",
            "pelvis",
            "left knee",
            "head excursion",
            "energy balance",
            "integration",
            "written",
            "next",
            "samples",
            "computed",
            "seated on",
        ]
        .iter()
        .any(|head| line.starts_with(head) && line.len() > 80)
}

#[test]
fn tables_take_no_more_than_80_columns() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    let run = done(here, &["run", "case.toml", "--set", "time.end=60 ms"]);
    let tables = [
        done(here, &["check", "case.toml"]),
        done(here, &["measures", "case.mcap"]),
        done(here, &["channels", "--of", "case.toml", "head"]),
        done(here, &["sweep", "study.toml", "-o", "out"]),
        done(here, &["study", "report", "out"]),
        run,
    ];
    for text in &tables {
        for line in text.lines().filter(|line| is_table(line) && !line.starts_with("head.")) {
            assert!(line.chars().count() <= 80, "{} columns: {line}\n{text}", line.chars().count());
        }
    }
}

#[test]
fn a_limit_that_is_exceeded_is_red_where_there_are_colours() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    done(here, &["run", "case.toml", "-q"]);
    let shown = |colours: &[(&str, &str)]| {
        let mut command = occupant(here);
        command.args(["measures", "case.mcap", "--verdict"]).envs(colours.iter().copied());
        String::from_utf8(command.output().unwrap().stdout).unwrap()
    };
    let plain = shown(&[]);
    assert!(plain.contains("EXCEEDED") && !plain.contains('\u{1b}'), "{plain}");
    let red = "\u{1b}[1;31mEXCEEDED\u{1b}[0m";
    assert!(shown(&[("CLICOLOR_FORCE", "1")]).contains(red));
    assert!(!shown(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]).contains('\u{1b}'));
}

/// The command with a text on its standard input.
fn fed(folder: &Path, words: &[&str], text: &str) -> (i32, String, String) {
    let mut command = occupant(folder);
    let command = command.args(words).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // a command that refuses its words reads nothing
    let _ = child.stdin.take().unwrap().write_all(text.as_bytes());
    let output = child.wait_with_output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

#[test]
fn a_dash_is_standard_input_or_output() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let (code, table, _) = fed(here, &["check", "-"], CASE);
    assert!(code == 0 && table.contains("time scale"), "{table}");
    let (code, _, said) = fed(here, &["run", "-", "--set", "time.end=10 ms"], CASE);
    assert!(code == 2 && said.contains("-o FILE.mcap"), "{said}");
    let (code, _, said) = fed(here, &["run", "-", "-q", "-o", "x.mcap", "--set", "time.end=10 ms"], CASE);
    assert_eq!(code, 0, "{said}");
    let csv = done(here, &["export", "x.mcap", "--channels", "head.acceleration.x", "-o", "-"]);
    assert!(csv.starts_with("time[s],head.acceleration.x[m/s^2]\n"), "{csv}");
    let (code, rated, said) = fed(here, &["compare", "x.mcap", "-"], &csv);
    assert!(code == 0 && rated.contains("1 channel; mean of ISO/TS 18571 1.000"), "{rated}{said}");
    let (code, risk, said) = fed(here, &["risk", "-", "--cfc", "none"], "t[s],ax[g]\n0,0\n0.1,-1\n0.2,0\n");
    assert!(code == 0 && risk.contains("ORA"), "{risk}{said}");
    // a file that is called so is no standard input
    fs::write(
        here.join("s.toml"),
        CASE.replace("[path]", "[vehicles.b.path]\nkind = \"table\"\nfile = \"-\"\n\n[path]"),
    )
    .unwrap();
    let (code, _, said) = fed(here, &["check", "s.toml"], "t[s],x[m]\n0,0\n1,0\n");
    assert!(code == 2 && said.contains("`-` cannot be read"), "{said}");
}

#[test]
fn a_sweep_is_rehearsed_without_a_file() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    let told = done(here, &["sweep", "study.toml", "--dry-run"]);
    for words in
        ["12 of", "for each sample", "12 tried, spread over the study", "nothing was written", "damping", "speed"]
    {
        assert!(told.contains(words), "{told}");
    }
    assert_eq!(fs::read_dir(here).unwrap().count(), 2, "the scenario and the study");
}

#[test]
fn a_sweep_has_a_folder_of_its_own_and_says_what_comes_next() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    let told = done(here, &["sweep", "study.toml"]);
    assert!(told.contains("next       occupant study report study"), "{told}");
    assert!(told.contains("least") && told.contains("head.peak"), "{told}");
    let matrix = done(here, &["study", "report", "study"]);
    assert!(matrix.starts_with("rank correlations (−1 to 1); †") && matrix.contains("speed"), "{matrix}");
    let page = fs::read_to_string(here.join("study/report.html")).unwrap();
    assert!(page.contains("What matters for which result") && page.contains("<summary>Pictures"));
    let refused = answer(here, &["sweep", "case"]);
    assert!(err(&refused).contains("error"), "{}", err(&refused));
}

#[test]
fn a_run_says_what_comes_next() {
    let folder = folder_with(STUDY);
    let table = done(folder.path(), &["run", "case.toml", "--set", "time.end=10 ms"]);
    assert!(table.contains("next             occupant report case.mcap; occupant measures case.mcap"), "{table}");
}

#[test]
fn a_study_in_place_of_a_scenario_is_told_apart() {
    let folder = folder_with(STUDY);
    for command in ["run", "check"] {
        let said = err(&answer(folder.path(), &[command, "study.toml"]));
        assert!(
            said.starts_with("error: study.toml is a study") && said.contains("occupant sweep study.toml"),
            "{said}"
        );
    }
    let said = err(&answer(folder.path(), &["sweep", "case.toml"]));
    assert!(said.starts_with("error: case.toml is a scenario, not a study") && said.contains("occupant run"), "{said}");
    fs::write(folder.path().join("case.mcap"), "x").unwrap();
    let said = err(&answer(folder.path(), &["run", "case.mcap"]));
    assert!(said.starts_with("error: case.mcap holds the results of a run"), "{said}");
}

#[test]
fn several_scenarios_are_one_table() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    fs::write(here.join("other.toml"), CASE).unwrap();
    let table = done(here, &["run", "case.toml", "other.toml", "--set", "time.end=30 ms", "-q"]);
    assert!(table.starts_with("1   case.toml\n2   other.toml\n") && table.contains("HIC15"), "{table}");
    assert!(here.join("case.mcap").exists() && here.join("other.mcap").exists());
    assert!(err(&answer(here, &["run", "case.toml", "other.toml", "-o", "x.mcap"])).contains("FILE.html"));
}

#[test]
fn axes_of_sae_j211_are_those_of_segments_turned() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    done(here, &["run", "case.toml", "-q", "--set", "time.end=10 ms"]);
    let channels = "head.acceleration.x,head.acceleration.z,neck.force.z,vehicle.acceleration.z";
    let last = |axes: &str| -> Vec<f64> {
        done(here, &["export", "case.mcap", "-f", "-o", "a.csv", "--channels", channels, "--axes", axes]);
        let text = fs::read_to_string(here.join("a.csv")).unwrap();
        text.lines().last().unwrap().split(',').map(|cell| cell.parse().unwrap()).collect()
    };
    let (own, turned) = (last("segment"), last("j211"));
    assert!(own[2] != 0.0);
    assert_eq!([own[1], -own[2], own[3], own[4]], turned[1..]);
    assert!(fs::read_to_string(here.join("a.csv-metadata.json")).unwrap().contains("segment (SAE J211)"));
    done(here, &["plot", "case.mcap", "--axes", "j211", "--channel", "head.acceleration.z", "-o", "z.svg"]);
    assert!(fs::read_to_string(here.join("z.svg")).unwrap().contains("segment (SAE J211) axes"));
}

/// The JSON of a scene, and the numbers behind it.
fn scene(bytes: &[u8]) -> (serde_json::Value, Vec<u8>) {
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], number(4), number(8)), (&b"glTF"[..], 2, bytes.len()));
    let (length, kind) = (number(12), &bytes[16..20]);
    assert_eq!(kind, b"JSON");
    let rest = 20 + length;
    assert_eq!((&bytes[rest + 4..rest + 8], number(rest) + rest + 8), (&b"BIN\0"[..], bytes.len()));
    (serde_json::from_slice(&bytes[20..rest]).unwrap(), bytes[rest + 8..].to_vec())
}

#[test]
fn a_scene_moves_as_the_run_does() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    done(here, &["run", "case.toml", "-q", "--set", "time.end=50 ms"]);
    assert!(spoken(here, &["export", "case.mcap", "-o", "case.glb"]).contains("wrote case.glb"));
    let (text, numbers) = scene(&fs::read(here.join("case.glb")).unwrap());
    let list = |key: &str| text[key].as_array().unwrap().clone();
    assert_eq!(text["buffers"][0]["byteLength"], numbers.len());
    for accessor in list("accessors") {
        let size = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 4,
            "VEC3" => 12,
            _ => 16,
        };
        let view = &text["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        assert_eq!(view["byteLength"].as_u64().unwrap(), size * accessor["count"].as_u64().unwrap());
    }
    // Y is up: who sits has the head above the pelvis
    let nodes = list("nodes");
    let pose = |name: &str| {
        let node = nodes.iter().find(|node| node["name"] == name).unwrap();
        let numbers =
            |key: &str| -> Vec<f64> { node[key].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect() };
        let (t, q) = (numbers("translation"), numbers("rotation"));
        let turn = nalgebra::Quaternion::new(q[3], q[0], q[1], q[2]);
        let turn = nalgebra::UnitQuaternion::from_quaternion(turn);
        nalgebra::Isometry3::from_parts(nalgebra::Translation3::new(t[0], t[1], t[2]), turn)
    };
    let place = |name: &str| (pose("space") * pose("vehicle") * pose(name)).translation.vector;
    let above = place("head") - place("lower_torso");
    assert!(above.y > 0.4 && above.z.abs() < 0.5, "{above}");
    let ahead = place("left_lower_leg") - place("lower_torso");
    assert!(ahead.z > 0.2 && ahead.x > 0.0, "{ahead}");
    // the head's way in the vehicle is the channel's
    let head = list("nodes").iter().position(|node| node["name"] == "head").unwrap();
    let animation = &list("animations")[0];
    let channel = animation["channels"].as_array().unwrap().iter();
    let channel =
        channel.clone().find(|c| c["target"]["node"] == head && c["target"]["path"] == "translation").unwrap();
    let sampler = &animation["samplers"][channel["sampler"].as_u64().unwrap() as usize];
    let output = &text["accessors"][sampler["output"].as_u64().unwrap() as usize];
    let view = &text["bufferViews"][output["bufferView"].as_u64().unwrap() as usize];
    let at = view["byteOffset"].as_u64().unwrap() as usize + view["byteLength"].as_u64().unwrap() as usize - 12;
    let last_x = f32::from_le_bytes(numbers[at..at + 4].try_into().unwrap());
    done(here, &["export", "case.mcap", "--channels", "head.position.x", "-o", "x.csv"]);
    let csv = fs::read_to_string(here.join("x.csv")).unwrap();
    let expected: f64 = csv.lines().last().unwrap().split(',').nth(1).unwrap().parse().unwrap();
    assert!((f64::from(last_x) - expected).abs() < 1e-5, "{last_x} and {expected}");
    assert!(err(&answer(here, &["export", "case.mcap", "-o", "y.glb", "--channels", "head.*"])).contains("--channel "));
}

/// The number in so many-th place behind the beginning of a line.
fn told(text: &str, line: &str, place: usize) -> f64 {
    let found = text.lines().find(|own| own.starts_with(line)).unwrap_or_else(|| panic!("no {line} in\n{text}"));
    let word = found[line.len()..].split_whitespace().nth(place).unwrap();
    word.trim_end_matches(['!', '*']).parse().unwrap_or_else(|_| panic!("{word} in {found}"))
}

#[test]
fn units_are_those_of_the_scenario_or_those_asked_for() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    let si = done(here, &["run", "case.toml", "--set", "time.end=60 ms"]);
    let inches = |words: &[&str]| done(here, &[words, &["--units", "inch-pound"]].concat());
    let again = inches(&["run", "case.toml", "-f", "--set", "time.end=60 ms"]);
    assert!(again.contains("loop force, lbf") && !again.contains("depth, mm"), "{again}");
    let [n, lbf] = [&si, &again].map(|text| told(text, "lap ", 0));
    assert!(n > 100.0 && (n / 4.448_221_6 - lbf).abs() < 0.62, "{n} N, {lbf} lbf");
    let measures = ["measures", "case.mcap"];
    let [n, lbf] = [done(here, &measures), inches(&measures)].map(|text| told(&text, "neck tension", 0));
    assert!((n / 4.448_221_6 - lbf).abs() < 0.62, "{n} N, {lbf} lbf");
    let json = |words: &[&str]| done(here, &[words, &["--json"]].concat());
    assert_eq!(json(&measures), json(&["measures", "case.mcap", "--units", "in-lbf-s"]));
    let checked = inches(&["check", "case.toml", "--all"]);
    for words in ["31.069 mph at the start", "mass, lb", "length, in", "1.00000 g", "force, lbf"] {
        assert!(checked.contains(words), "{words}: {checked}");
    }
    done(here, &["sweep", "study.toml", "-o", "out"]);
    let sweep = inches(&["sweep", "study.toml", "-o", "again"]);
    assert!(sweep.contains(" lbf") && !sweep.contains(" N\n"), "{sweep}");
    inches(&["report", "case.mcap", "-o", "page.html"]);
    let page = fs::read_to_string(here.join("page.html")).unwrap();
    assert!(page.contains("\"unit\":\"lbf\"") && !page.contains("\"unit\":\"kN\""));
    for (words, speed, others) in [(&[][..], "km/h", "forward, mm"), (&["--units", "inch-pound"], "mph", "forward, in")]
    {
        done(here, &[&["study", "report", "out", "-f"], words].concat());
        let page = fs::read_to_string(here.join("out/report.html")).unwrap();
        assert!(page.contains(speed) && page.contains("head.peak, g") && page.contains(others), "{speed}, {others}");
    }
}

/// What a value has that a schema does not tell, by its path.
fn untold(all: &serde_json::Value, schema: &serde_json::Value, value: &serde_json::Value, at: &str) -> Vec<String> {
    let schema = match schema["$ref"].as_str() {
        Some(name) => &all["$defs"][name.rsplit('/').next().unwrap()],
        None => schema["anyOf"].get(0).filter(|_| !value.is_null()).unwrap_or(schema),
    };
    if let Some(name) = schema["$ref"].as_str() {
        return untold(all, &all["$defs"][name.rsplit('/').next().unwrap()], value, at);
    }
    let is = match value {
        serde_json::Value::Null => "null",
        serde_json::Value::Bool(_) => "boolean",
        serde_json::Value::Number(n) if n.is_f64() => "number",
        serde_json::Value::Number(_) => "integer",
        serde_json::Value::String(_) => "string",
        serde_json::Value::Array(_) => "array",
        serde_json::Value::Object(_) => "object",
    };
    let of = schema["type"].to_string();
    let fits = schema["type"].is_null() || of.contains(is) || (is == "integer" && of.contains("number"));
    let mut found = if fits { Vec::new() } else { vec![format!("{at} is {is} and not {of}")] };
    for (key, value) in value.as_object().into_iter().flatten() {
        let own = schema["properties"]
            .get(key)
            .or_else(|| schema["additionalProperties"].as_object().map(|_| &schema["additionalProperties"]));
        match own {
            Some(own) => found.extend(untold(all, own, value, &format!("{at}.{key}"))),
            None if schema["additionalProperties"] == true => {}
            None => found.push(format!("{at}.{key} has no words")),
        }
    }
    let items = value.as_array().into_iter().flatten();
    found.extend(items.flat_map(|item| untold(all, &schema["items"], item, &format!("{at}[]"))));
    found
}

#[test]
fn every_name_of_an_answer_is_in_its_schema() {
    let folder = folder_with(STUDY);
    let here = folder.path();
    done(here, &["run", "case.toml", "--set", "time.end=60 ms", "-q"]);
    done(here, &["export", "case.mcap", "-o", "test.csv", "--channels", "head.acceleration.*"]);
    for (of, words) in [
        ("run", &["run", "case.toml", "--no-mcap", "--set", "time.end=60 ms", "--estimate-error"][..]),
        ("check", &["check", "case.toml"]),
        ("check", &["check", "case.toml", "--set", "posture.settle=true"]),
        ("measures", &["measures", "case.mcap", "--filter", "sae-j211"]),
        ("measures", &["measures", "case.mcap", "case.mcap"]),
        ("rating", &["measures", "case.mcap", "--rating", "euro-ncap-2026-full-width"]),
        ("rating", &["measures", "test.csv", "--rating", "us-ncap-frontal"]),
        ("compare", &["compare", "case.mcap", "test.csv"]),
        ("compare", &["compare", "case.mcap", "test.csv", "--protocol", "far-side"]),
        ("risk", &["risk", "case.toml"]),
        (
            "sensitivity",
            &["sensitivity", "case.toml", "--to", "hic15", "--of", "joints.neck.damping", "--set", "time.end=30 ms"],
        ),
    ] {
        let json = |words: &[&str]| -> serde_json::Value { serde_json::from_str(&done(here, words)).unwrap() };
        let schema = json(&["schema", "--of", of]);
        let found = untold(&schema, &schema, &json(&[words, &["--json"]].concat()), of);
        assert!(found.is_empty(), "{found:#?}");
    }
}
