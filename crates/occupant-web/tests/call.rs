//! Requests of the page, met natively by the function that the module for wasm32 calls.

use occupant_files::results::Results;
use occupant_web::{Answer, call};
use serde_json::{Value, json};

fn ask(request: &Value) -> (Value, Answer) {
    let answer = call(&request.to_string(), &[], &mut |_| ());
    (serde_json::from_str(&answer.json).unwrap(), answer)
}

/// A template as the page has it.
fn case(name: &str, set: &[&str]) -> Value {
    let (about, _) = ask(&json!({"do": "about"}));
    let found = about["templates"].as_array().unwrap().iter().find(|one| one["name"] == name).unwrap();
    json!({"name": format!("{name}.toml"), "text": found["text"], "set": set, "tables": {}})
}

/// The summary of the page is that of the file which it saves, read again and computed once more.
#[test]
fn a_run_is_that_of_its_file() {
    let case = case("sled", &["gravity=9.8"]);
    let set = case["set"].clone();
    let mut told = Vec::new();
    let answer = call(&json!({"do": "run", "case": case}).to_string(), &[], &mut |share| told.push(share));
    let ran: Value = serde_json::from_str(&answer.json).unwrap();
    assert!(ran["refused"].is_null(), "{}", ran["refused"]);
    assert!(told.first() == Some(&0.0) && (told.last().unwrap() - 1.0).abs() < 1e-9, "{told:?}");
    let (_, saved) = ask(&json!({"do": "save", "case": case}));
    let path = std::env::temp_dir().join(format!("occupant-web-{}.mcap", std::process::id()));
    std::fs::write(&path, &saved.bytes).unwrap();
    let results = Results::open(&path);
    let _ = std::fs::remove_file(&path);
    let summary = results.map_err(|e| e.words()).unwrap().summary().map_err(|e| e.words()).unwrap();
    let summary = serde_json::to_value(&summary).unwrap();
    for (key, value) in ran["summary"].as_object().unwrap() {
        assert_eq!(value, &summary[key], "{key}");
    }
    let opened = call(&json!({"do": "open", "name": "x.mcap"}).to_string(), &saved.bytes, &mut |_| ());
    let opened: Value = serde_json::from_str(&opened.json).unwrap();
    assert_eq!(opened["summary"], ran["summary"]);
    assert_eq!((&opened["case"]["text"], &opened["case"]["set"]), (&case["text"], &set));
    assert!(!ran["run"]["measures"].as_array().unwrap().is_empty());
}

#[test]
fn problems_stand_at_their_lines() {
    let mut case = case("driver", &[]);
    let text = case["text"].as_str().unwrap().replace("speed = \"50 km/h\"", "speed = \"50 kg\"");
    let line = text.lines().position(|line| line.starts_with("speed = ")).unwrap() + 1;
    case["text"] = text.into();
    let (checked, _) = ask(&json!({"do": "check", "case": case}));
    let problem = &checked["problems"][0];
    assert_eq!((&problem["line"], &problem["is_error"]), (&json!(line), &json!(true)), "{problem}");
    let (refused, _) = ask(&json!({"do": "run", "case": case}));
    assert_eq!(refused["refused"]["problems"][0]["line"], json!(line));
}

/// Changes written into the text keep its comments, and mean the same.
#[test]
fn changes_can_be_written_into_the_text() {
    let set = ["path.delta_v=40 km/h", "car.seats.driver.belt=\"none\"", "car.bags.driver=false", "path.peak=20 g"];
    let case = case("driver", &set);
    let (written, _) = ask(&json!({"do": "write", "case": case}));
    let text = written["text"].as_str().unwrap_or_else(|| panic!("{written}"));
    assert!(text.contains("peak = \"20 g\"") && !text.contains("\ndelta_v"), "{text}");
    assert!(text.starts_with("# A driver in a present-day car") && text.contains("# of the shoulder belt"));
    let unwritable = json!({"name": "a.toml", "text": case["text"], "set": ["joints.*.damping=2"], "tables": {}});
    let (refused, _) = ask(&json!({"do": "write", "case": unwritable}));
    assert!(refused["refused"].is_object() || refused["text"].is_string(), "{refused}");
}

/// Every value that the page offers to move can be moved to both ends.
#[test]
fn knobs_can_be_moved() {
    for name in ["driver", "sensors", "neck"] {
        let (checked, _) = ask(&json!({"do": "check", "case": case(name, &[])}));
        for knob in checked["knobs"].as_array().unwrap() {
            let path = knob["path"].as_str().unwrap();
            let values: Vec<String> = match knob["kind"].as_str().unwrap() {
                "number" => {
                    ["from", "to"].map(|end| format!("{} {}", knob[end], knob["unit"].as_str().unwrap())).to_vec()
                }
                "direction" => vec!["[0, 1, 0]".to_owned()],
                "choice" => knob["names"].as_array().unwrap().iter().map(Value::to_string).collect(),
                _ => vec!["true".to_owned(), "false".to_owned()],
            };
            for value in values {
                let change = format!("{path}={}", value.trim());
                let (moved, _) = ask(&json!({"do": "check", "case": case(name, &[&change])}));
                let syntax = moved["problems"].as_array().unwrap().iter().find(|problem| {
                    // the path itself; what a change does to the rest of a scenario is told by the scenario
                    problem["is_error"] == true
                        && problem["source"].as_str().unwrap().starts_with("override of")
                        && problem["found"].as_str().unwrap().contains("unknown")
                });
                assert_eq!(syntax, None, "{name}: {change}");
            }
        }
    }
}

#[test]
fn a_study_is_sampled() {
    let study = "title = \"s\"\nbase = \"x.toml\"\nseed = 1\n[design]\nkind = \"latin_hypercube\"\nsamples = 5\n\
                 [[parameters]]\nname = \"duration\"\npath = \"path.duration\"\nrange = { from = \"80 ms\", to = \"120 ms\" }\n";
    let (planned, _) = ask(&json!({"do": "study", "case": case("driver", &[]), "study": study}));
    let samples = planned["samples"].as_array().unwrap();
    assert_eq!(samples.len(), 5);
    for sample in samples {
        let seconds = sample["values"][0].as_f64().unwrap();
        assert!((0.08..=0.12).contains(&seconds), "{seconds}");
        assert!(sample["set"][0].as_str().unwrap().starts_with("path.duration="), "{sample}");
    }
    let many = study.replace("samples = 5", "samples = 100000");
    let (refused, _) = ask(&json!({"do": "study", "case": case("driver", &[]), "study": many}));
    assert!(refused["refused"]["words"].as_str().unwrap().contains("at most 500"), "{refused}");
}

#[test]
fn nothing_that_is_asked_breaks_the_page() {
    for request in ["", "null", "[]", "{\"do\": 1}", "{\"do\": \"fly\"}", "{\"do\": \"run\"}", "\u{0}"] {
        let answer = call(request, &[], &mut |_| ());
        let told: Value = serde_json::from_str(&answer.json).unwrap();
        assert!(told["refused"]["words"].is_string(), "{request}: {}", answer.json);
    }
    let deep = format!("a = {}1{}", "[".repeat(5000), "]".repeat(5000));
    let texts = ["", "\u{feff}", "title = ", "[", &deep, "{", "{\"title\": 1e999}", "time = { end = 1e300 }"];
    for text in texts {
        for name in ["a.toml", "a.json", "", "/etc/passwd", "<b>"] {
            for set in [&[][..], &["=", "a", "a.b[9999999999].c=1", "title=null", "*.*=1"]] {
                for job in ["check", "run", "save", "measure"] {
                    let case = json!({"name": name, "text": text, "set": set, "tables": {"": "x"}});
                    let (told, answer) = ask(&json!({"do": job, "case": case}));
                    assert!(job == "check" || told["refused"].is_object(), "{job} of {text:.20}: {}", answer.json);
                }
            }
        }
    }
}

/// A recorder's report becomes a case that runs; one that leaves the side open says so.
#[test]
fn a_report_of_a_recorder_becomes_a_case() {
    let import = |name: &str, bytes: &[u8], struck: &[&str]| -> Value {
        let request = json!({"do": "import", "name": name, "struck": struck});
        serde_json::from_str(&call(&request.to_string(), bytes, &mut |_| ()).json).unwrap()
    };
    let report = include_bytes!("../../occupant-cli/tests/data/recorders/german.csv");
    let made = import("german.csv", report, &[]);
    assert!(made["refused"].is_null(), "{}", made["refused"]);
    assert!(made["notes"].as_array().is_some_and(|notes| !notes.is_empty()));
    let (checked, _) = ask(&json!({"do": "check", "case": made["case"]}));
    let problems = checked["problems"].as_array().unwrap();
    assert!(problems.iter().all(|problem| problem["is_error"] == false), "{problems:?}");
    let (ran, _) = ask(&json!({"do": "run", "case": made["case"], "channels": ["head.position.x"]}));
    assert_eq!(ran["run"]["plots"][0]["title"], "head.position.x", "{}", ran["refused"]);

    let open = b"speed at impact: 60 km/h\nt (ms),delta-v (km/h)\n0,0\n50,15\n100,30\n150,30\n";
    let words = |made: &Value| made["refused"]["words"].as_str().unwrap_or_default().to_owned();
    assert!(words(&import("open.csv", open, &[])).contains("--struck"), "{}", words(&import("open.csv", open, &[])));
    assert_eq!(words(&import("open.csv", open, &["front"])), "");
    assert!(words(&import("none.csv", b"a,b\n1,2\n3,4\n", &[])).contains("none.csv"));
}
