use super::{answer, code, err, folder_with_case, json, out, row};

#[test]
fn it_shows_what_will_be_simulated() {
    let folder = folder_with_case();
    let output = answer(folder.path(), &["check", "case.toml"]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let text = out(&output);
    assert!(!text.contains("5–95 % range") && text.contains("add --all"), "{text}");
    for words in ["31 degrees of freedom", "12 segments", "sinks", "touches at", "fastest time scale"] {
        assert!(text.contains(words), "{words} is missing in\n{text}");
    }
    assert_eq!(row(&text, "lap")[1], "pelvis");
    assert!(!folder.path().join("case.mcap").exists(), "check runs nothing");
}

#[test]
fn its_json_tells_the_same() {
    let folder = folder_with_case();
    let text = out(&answer(folder.path(), &["check", "case.toml"]));
    let json = json(&answer(folder.path(), &["check", "case.toml", "--json"]));
    assert!(text.contains(&format!("{:.2} kg", json["body"]["mass_kg"].as_f64().unwrap())));
    for belt in json["belts"].as_array().unwrap() {
        let cells = row(&text, belt["belt"].as_str().unwrap());
        assert_eq!(cells[2], format!("{:.4}", belt["length_m"].as_f64().unwrap()));
    }
    let number = json["step_by_time_scale"].as_f64().unwrap();
    assert!(text.contains(&format!("{number:.3}")));
}

#[test]
fn it_says_how_far_people_differ_and_whose_lengths_are_weak() {
    let folder = folder_with_case();
    let check = |set: &str| out(&answer(folder.path(), &["check", "case.toml", "--all", "--set", set]));
    let text = check("body.segments.head.length=0.25 m");
    let numbers: Vec<f64> = row(&text, "left_thigh")[2..].iter().filter_map(|cell| cell.parse().ok()).collect();
    let [length_m, least_m, most_m] = numbers[..] else { panic!("{numbers:?}") };
    assert!(
        (1.0 - least_m / length_m - 0.1154).abs() < 5e-4 && (most_m / length_m - 1.1154).abs() < 5e-4,
        "{numbers:?}"
    );
    assert_eq!(row(&text, "head")[2..], ["0.2500", "–"], "a length of one's own has no band");
    assert!(!text.contains("child"));
    let child = check("body.preset=child06");
    assert!(child.contains("a child's segment lengths") && !child.contains("5–95 % range"), "{child}");
    let json = json(&answer(folder.path(), &["check", "case.toml", "--json"]));
    let thigh = json["body"]["segments"].as_array().unwrap().iter().find(|s| s["segment"] == "left_thigh").unwrap();
    assert!((thigh["length_band_m"][0].as_f64().unwrap() - least_m).abs() < 1e-4, "{thigh}");
}

#[test]
fn a_step_that_is_too_long_fails_the_check() {
    let folder = folder_with_case();
    let words = ["check", "case.toml", "-q", "--set", "integrator.step=20 ms"];
    let output = answer(folder.path(), &words);
    assert_eq!((code(&output), out(&output)), (1, String::new()));
    assert!(err(&output).contains("too long"), "{}", err(&output));
    assert!(err(&output).contains("integrator.step"), "{}", err(&output));
}

#[test]
fn the_adaptive_integrator_needs_no_such_check() {
    let folder = folder_with_case();
    let words = ["check", "case.toml", "--set", "integrator={kind=\"adaptive\"}"];
    let output = answer(folder.path(), &words);
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(out(&output).contains("the error control chooses the step"));
}
