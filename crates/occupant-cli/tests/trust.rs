//! What a run says of figures that are not to be trusted, and commands of files, names and words that are not what they seem.

use std::fs;

use crate::common::{CASE, answer, done, err, folder_with, spoken};

fn folder() -> tempfile::TempDir {
    folder_with("")
}

#[test]
fn a_step_too_long_for_its_own_time_scale_is_told_before_the_run_and_marks_every_figure() {
    let folder = folder();
    let coarse = ["run", "case.toml", "--no-mcap", "--set", "integrator.step=1 ms"];
    let output = answer(folder.path(), &coarse);
    let (said, told) = (err(&output), String::from_utf8_lossy(&output.stdout).into_owned());
    // 4.5 times the time scale of the lower back's damper
    assert!(said.contains("warning: the step of 1.0000 ms is too long for lower_back (damper)"), "{said}");
    assert!(told.contains("! the step of 1.0000 ms is 4.5 times the time scale of lower_back (damper)"), "{told}");
    let fine = done(folder.path(), &["run", "case.toml", "--no-mcap"]);
    assert!(!fine.contains("times the time scale"), "{fine}");
}

#[test]
fn figures_that_a_finer_run_has_otherwise_are_marked_where_they_stand() {
    let folder = folder();
    let words = ["run", "case.toml", "--no-mcap", "--set", "integrator.step=0.5 ms", "--estimate-error"];
    let told = done(folder.path(), &words);
    // 21 % of the femurs' duration; no figure of what is nothing in a plane motion
    assert!(told.contains("results are not determined: with rk4 at a quarter of the step"), "{told}");
    let json = done(folder.path(), &[&words[..], &["--json", "-q"]].concat());
    let answer: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let caveats = answer["caveats"].as_array().expect("a list");
    let caveat = caveats.iter().find(|caveat| caveat["name"] == "undetermined").expect("a caveat");
    let figures: Vec<&str> = caveat["figures"].as_array().expect("a list").iter().filter_map(|f| f.as_str()).collect();
    assert!(figures.contains(&"left_femur") && !figures.contains(&"head_excursion.right"), "{figures:?}");
}

#[test]
fn an_unbelted_body_with_nothing_ahead_is_warned_of() {
    let folder = folder();
    let open: Vec<String> =
        ["panel_face", "panel_top", "windshield"].iter().map(|s| format!("surfaces.{s}=null")).collect();
    let unbelted = ["check", "case.toml", "-q", "--set", "belts=null"];
    let sets: Vec<&str> = open.iter().flat_map(|set| ["--set", set.as_str()]).collect();
    let said = spoken(folder.path(), &[&unbelted[..], &sets].concat());
    assert!(said.contains("has no belt and nothing in front of it"), "{said}");
    for quiet in [&unbelted[..], &[&["check", "case.toml", "-q"], &sets[..]].concat()] {
        let said = spoken(folder.path(), quiet);
        assert!(!said.contains("nothing in front of it"), "{quiet:?}: {said}");
    }
}

#[test]
fn patterns_that_fit_nothing_are_noted_and_names_are_told_all_at_once() {
    let folder = folder();
    done(folder.path(), &["run", "case.toml", "--set", "time.end=20 ms", "-q", "-o", "x.mcap"]);
    let said =
        spoken(folder.path(), &["export", "x.mcap", "--channels", "head.acceleration.*,nothing.*", "-o", "x.csv"]);
    assert!(said.contains("no channel matches `nothing.*`") && said.contains("wrote 4 channels"), "{said}");
    let output =
        answer(folder.path(), &["export", "x.mcap", "--channels", "head.x,nothing,head.acceleration.x", "-o", "y.csv"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("there is no channel `head.x`, `nothing`"), "{}", err(&output));
    // a file is one whose channels are listed; a measure is no channel
    assert_eq!(done(folder.path(), &["channels", "x.mcap"]), done(folder.path(), &["channels", "--of", "x.mcap"]));
    let output = answer(folder.path(), &["channels", "HIC"]);
    assert!(output.status.code() == Some(2) && err(&output).contains("HIC15 is a measure"), "{}", err(&output));
    // what cannot have its class is left out with a note, what can is compared
    let output = answer(folder.path(), &["compare", "x.mcap", "x.mcap", "--filter", "j211"]);
    let said = err(&output) + &String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("too coarse for their SAE J211 classes: head.acceleration"), "{said}");
}

#[test]
fn names_in_what_comes_next_are_words_of_a_shell() {
    let folder = folder();
    let told = done(folder.path(), &["run", "case.toml", "--set", "time.end=20 ms", "-o", "my run.mcap"]);
    assert!(told.contains("occupant report 'my run.mcap'; occupant measures 'my run.mcap'"), "{told}");
    let said = spoken(folder.path(), &["new", "the case.toml"]);
    assert!(said.contains("occupant check 'the case.toml'"), "{said}");
}

#[test]
fn keys_are_found_by_what_people_call_them() {
    let folder = folder();
    for (word, key) in [
        ("airbag", "bags"),
        ("seatbelt", "belts"),
        ("seat belts", "belts"),
        ("intrusion", "car.intrusion"),
        ("PDOF", "path.direction"),
        ("Δv", "path.delta_v"),
        ("guardrail", "drive.barriers"),
        ("path.kind=sensors", "path.kind   (kind = \"sensors\")"),
    ] {
        let told = done(folder.path(), &["explain", word]);
        assert!(told.starts_with(key), "{word}: {told}");
    }
    for (word, where_it_is) in [("ejection", "explain ground"), ("submarining", "explain wing"), ("HIC", "measures")] {
        let output = answer(folder.path(), &["explain", word]);
        let said = err(&output);
        assert!(output.status.code() == Some(2) && said.contains("is a result, not a key"), "{said}");
        assert!(said.contains(where_it_is), "{said}");
    }
}

#[test]
fn several_occupants_are_refused_an_endless_run_as_one_is() {
    let folder = folder();
    fs::write(folder.path().join("two.toml"), include_str!("../../../tests/data/hand/side-by-side.toml"))
        .expect("written");
    done(folder.path(), &["run", "two.toml", "--set", "time.end=5 ms", "-q", "-o", "two.mcap"]);
    for (interval, said) in [("1e-300 s", "readings"), ("1e300 s", "no longer than the run")] {
        let output = answer(folder.path(), &["measures", "two.mcap", "--interval", interval]);
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).contains(said), "{}", err(&output));
    }
    let output = answer(folder.path(), &["run", "case.toml", "--no-mcap", "--set", "output.interval=1e300"]);
    assert!(output.status.code() == Some(2) && err(&output).contains("no longer than the run"), "{}", err(&output));
}

#[test]
fn a_title_of_64_kilobytes_is_drawn_in_seconds() {
    let folder = folder();
    let long = CASE.replace("Driver, 50 km/h frontal, lap and torso belt", &"long ".repeat(13_000));
    fs::write(folder.path().join("long.toml"), long).expect("written");
    done(folder.path(), &["run", "long.toml", "--set", "time.end=5 ms", "-q", "-o", "long.mcap"]);
    let begun = std::time::Instant::now();
    done(folder.path(), &["plot", "long.mcap", "-o", "long.svg"]);
    // over a minute before
    assert!(begun.elapsed().as_secs() < 20, "{:?}", begun.elapsed());
}

#[cfg(unix)]
#[test]
fn a_file_beyond_the_limit_of_the_process_is_a_write_that_fails() {
    let folder = folder();
    let binary = assert_cmd::cargo::cargo_bin!("occupant");
    let script = format!("ulimit -f 100; exec '{}' run case.toml -q -o x.mcap", binary.display());
    let output = std::process::Command::new("sh").current_dir(folder.path()).args(["-c", &script]).output();
    let output = output.expect("a shell");
    // no signal ends it
    assert!(output.status.code().is_some_and(|code| code == 1 || code == 2), "{:?}", output.status);
    assert!(err(&output).contains("x.") && err(&output).contains("error: "), "{}", err(&output));
}

/// The caveats of `measures --json`, by name.
fn caveats(folder: &std::path::Path, file: &str) -> (serde_json::Value, Vec<String>) {
    let answer: serde_json::Value = serde_json::from_str(&done(folder, &["measures", file, "--json"])).expect("JSON");
    let names = answer["caveats"].as_array().expect("a list").iter();
    let names = names.map(|caveat| caveat["name"].as_str().expect("a name").to_owned()).collect();
    (answer, names)
}

#[test]
fn figures_of_a_part_of_a_run_are_marked_and_do_not_pass() {
    let folder = folder();
    let at = folder.path();
    let run = |words: &[&str]| done(at, &[&["run", "case.toml", "-q"], words].concat());
    run(&["--until", "60 ms", "-o", "first.mcap"]);
    run(&["--resume", "first.mcap", "-o", "rest.mcap"]);
    run(&["--set", "time.end=0.25", "-o", "longer.mcap"]);
    let (first, names) = caveats(at, "first.mcap");
    assert!(names.contains(&"part_of_a_run".to_owned()), "{names:?}");
    assert_eq!(first["covers_s"], serde_json::json!([0.0, 0.06]));
    let told = done(at, &["measures", "first.mcap"]);
    assert!(told.contains("! the run was ended at 60 ms by time.end=60 ms"), "{told}");
    done(at, &["report", "first.mcap", "--verdict", "-o", "first.html"]);
    let page = fs::read_to_string(at.join("first.html")).expect("a page");
    assert!(!page.contains(r#""verdict":"passed""#) && page.contains(r#""verdict":null"#));
    // a file that continues from it holds the whole run
    let (rest, names) = caveats(at, "rest.mcap");
    assert!(!names.contains(&"part_of_a_run".to_owned()), "{names:?}");
    assert_eq!(rest["covers_s"], serde_json::json!([0.0, 0.2]));
    done(at, &["report", "rest.mcap", "--verdict", "-o", "rest.html"]);
    assert!(fs::read_to_string(at.join("rest.html")).expect("a page").contains(r#""verdict":"passed""#));
    // a run beyond the scenario's own end is no part
    assert!(!caveats(at, "longer.mcap").1.contains(&"part_of_a_run".to_owned()));
}

#[test]
fn what_a_run_that_blew_up_has_left_can_be_read() {
    let folder = folder();
    fs::write(folder.path().join("cart.toml"), include_str!("../../../scenarios/cart-lap.toml")).expect("written");
    let stiff = ["seat", "floor", "dash"].map(|name| format!("materials.{name}.k1=4e8"));
    let sets: Vec<&str> = stiff.iter().flat_map(|set| ["--set", set.as_str()]).collect();
    let run = ["run", "cart.toml", "-q", "-o", "x.mcap", "--set", r#"integrator={kind="rk4",step="1 ms"}"#];
    let output = answer(folder.path(), &[&run[..], &sets].concat());
    assert!(err(&output).contains("no longer finite"), "{}", err(&output));
    let [told, said] = crate::common::both(folder.path(), &["measures", "x.partial.mcap"]);
    assert!(said.contains("did not complete") && told.contains("! the run failed"), "{said}{told}");
}

#[test]
fn readings_that_a_file_has_need_no_other_run() {
    let folder = folder();
    done(folder.path(), &["run", "case.toml", "-q", "-o", "x.mcap", "--until", "40 ms"]);
    let said = |interval| spoken(folder.path(), &["measures", "x.mcap", "--interval", interval]);
    assert!(!said("0.1 ms").contains("running the case again") && said("0.05 ms").contains("running the case again"));
}

#[test]
fn friction_that_is_too_stiff_for_the_step_marks_every_figure() {
    let folder = folder();
    let words = ["run", "case.toml", "-o", "x.mcap", "--set", "materials.seat.friction_speed=\"0.2 mm/s\""];
    let [told, said] = crate::common::both(folder.path(), &words);
    assert!(said.contains("friction is too stiff for the step"), "{said}");
    assert!(told.contains("! friction of") && told.contains("may chatter"), "{told}");
    assert!(caveats(folder.path(), "x.mcap").1.contains(&"friction_chatters".to_owned()));
}

#[test]
fn how_far_a_column_went_beyond_its_force_does_not_depend_on_the_outputs() {
    let folder = folder();
    fs::write(folder.path().join("c.toml"), include_str!("../../../tests/data/hand/column-driver.toml"))
        .expect("written");
    let beyond = |interval: &str| {
        let interval = format!("output.interval={interval}");
        let words = ["run", "c.toml", "--no-mcap", "--set", "belts.driver=null", "--set", &interval];
        let told = done(folder.path(), &words);
        told.lines().find(|line| line.contains("stroked")).expect("a caveat").to_owned()
    };
    assert_eq!(beyond("0.5 ms"), beyond("20 ms"));
}
