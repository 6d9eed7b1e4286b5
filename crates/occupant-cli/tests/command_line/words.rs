use super::{answer, code, err, folder_with_case, json, out};

#[test]
fn the_schema_is_json_schema() {
    let folder = folder_with_case();
    let output = answer(folder.path(), &["schema"]);
    assert_eq!(code(&output), 0);
    let schema = json(&output);
    assert!(schema["$schema"].as_str().unwrap().contains("2020-12"));
    assert!(schema["properties"]["belts"].is_object());
}

#[test]
fn shells_get_their_completions() {
    let folder = folder_with_case();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let output = answer(folder.path(), &["completions", shell]);
        assert_eq!(code(&output), 0, "{shell}");
        assert!(out(&output).contains("check"), "{shell}");
    }
    let output = answer(folder.path(), &["completions", "cobol"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("zsh"), "{}", err(&output));
}

#[test]
fn version_and_help_are_results() {
    let folder = folder_with_case();
    let version = out(&answer(folder.path(), &["--version"]));
    assert_eq!(version, format!("occupant {}\n", env!("CARGO_PKG_VERSION")));
    let help = answer(folder.path(), &["--help"]);
    assert_eq!((code(&help), err(&help)), (0, String::new()));
    assert!(out(&help).contains("Exit codes"));
}

#[test]
fn words_that_mean_nothing_are_refused() {
    let folder = folder_with_case();
    for words in [&[][..], &["rnu"], &["run"], &["run", "case.toml", "--jsn"]] {
        assert_eq!(code(&answer(folder.path(), words)), 2, "{words:?}");
    }
}
