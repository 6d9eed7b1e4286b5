use super::{answer, code, err, folder_with_case, out};

/// Changes the case by replacing words, and runs it.
fn after(change: &[(&str, &str)]) -> (i32, String) {
    let folder = folder_with_case();
    let file = folder.path().join("case.toml");
    let mut text = std::fs::read_to_string(&file).unwrap();
    for (old, new) in change {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    std::fs::write(&file, text).unwrap();
    let output = answer(folder.path(), &["run", "case.toml"]);
    assert_eq!(out(&output), "");
    assert!(!folder.path().join("case.mcap").exists());
    assert!(!folder.path().join("case.partial.mcap").exists());
    (code(&output), err(&output))
}

#[test]
fn a_scenario_that_is_not_there_is_named() {
    let folder = folder_with_case();
    let output = answer(folder.path(), &["run", "cases.toml"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("cases.toml"));
    assert!(err(&output).contains("occupant new"));
}

#[test]
fn words_that_are_not_toml_are_shown_with_their_place() {
    let (code, said) = after(&[("end = 0.2 ", "end = = 0.2 ")]);
    assert_eq!(code, 2);
    assert!(said.contains("case.toml:"), "{said}");
    assert!(said.contains("end = = 0.2"), "{said}");
}

#[test]
fn every_problem_is_told_at_once_with_the_nearest_name() {
    let (code, said) = after(&[
        ("preset = \"male50\"", "prest = \"male50\""),
        ("speed = \"50 km/h\"", "speed = \"50 kg\""),
        ("end = 0.2 ", "end = true "),
        ("heels = [0.69, 0.33]", "heels = [0.69]"),
    ]);
    assert_eq!(code, 2);
    for words in ["did you mean `preset`", "50 kg", "true", "heels", "errors, nothing was run"] {
        assert!(said.contains(words), "{words} is missing in\n{said}");
    }
}

#[test]
fn a_reference_to_nothing_is_told() {
    let (code, said) = after(&[("cushion = \"cushion\"", "cushion = \"cushon\"")]);
    assert_eq!(code, 2);
    assert!(said.contains("cushon"), "{said}");
}

#[test]
fn physics_that_cannot_be_is_told_with_its_place() {
    let (code, said) = after(&[("heels = [0.69, 0.33]", "heels = [2.69, 0.33]")]);
    assert_eq!(code, 2);
    assert!(said.contains("out of reach"), "{said}");
    assert!(said.contains("case.toml:"), "{said}");
}

#[test]
fn a_change_that_leads_nowhere_is_told() {
    let folder = folder_with_case();
    for change in ["path.sped=3", "no equals sign", "joints.nek.damping=2", "surfaces.*.colour=3"] {
        let output = answer(folder.path(), &["run", "case.toml", "--set", change]);
        assert_eq!(code(&output), 2, "{change}");
        assert!(err(&output).contains("error"), "{}", err(&output));
    }
}

#[test]
fn bytes_that_are_not_text_are_refused() {
    let folder = folder_with_case();
    std::fs::write(folder.path().join("case.toml"), [0x66, 0xff, 0x00]).unwrap();
    let output = answer(folder.path(), &["check", "case.toml"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("UTF-8"), "{}", err(&output));
}
