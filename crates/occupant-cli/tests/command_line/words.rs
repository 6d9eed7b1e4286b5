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
fn manual_pages_are_written_for_every_command() {
    let folder = folder_with_case();
    assert_eq!(code(&answer(folder.path(), &["man", "pages/man1"])), 0);
    let page = |name: &str| std::fs::read_to_string(folder.path().join("pages/man1").join(name)).unwrap();
    assert!(page("occupant.1").contains("sensitivity"));
    let run = page("occupant-run.1");
    assert!(run.starts_with(".ie") && run.contains("occupant\\-run") && run.contains("estimate"), "{run}");
    assert_eq!(code(&answer(folder.path(), &["man", "pages/man1"])), 2);
}

#[cfg(target_os = "linux")]
#[test]
fn what_was_written_is_opened() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder_with_case();
    let program = folder.path().join("xdg-open");
    std::fs::write(&program, "#!/bin/sh\necho \"$1\" > opened\n").unwrap();
    std::fs::set_permissions(&program, PermissionsExt::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", folder.path().display(), std::env::var("PATH").unwrap());
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    let output = command.args(["view", "case.toml", "--open"]).env("PATH", path).current_dir(folder.path()).output();
    assert_eq!(code(&output.unwrap()), 0);
    let opened = || std::fs::read_to_string(folder.path().join("opened")).ok();
    let found = (0..200).find_map(|_| {
        std::thread::sleep(std::time::Duration::from_millis(20));
        opened().filter(|text| !text.is_empty())
    });
    assert!(found.is_some_and(|text| text.trim_end().ends_with("case-view.svg")));
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

#[test]
fn words_that_are_refused_are_shown_escaped_and_shortened() {
    let folder = folder_with_case();
    let hostile = format!("\u{1b}[31m\u{202e}{}", "x".repeat(100_000));
    for words in
        [&["run", "case.toml", "--ensemble", &hostile][..], &["measures", "x.mcap", "--dummy", &hostile], &[&hostile]]
    {
        let output = answer(folder.path(), words);
        let said = err(&output);
        assert_eq!(code(&output), 2);
        assert!(said.len() < 2000 && said.contains("\\u202ex") && said.contains("--help"), "{said:.2000}");
        assert!(!said.contains(['\u{1b}', '\u{202e}']), "{said:?}");
    }
}

#[test]
fn pages_of_keys_are_what_the_command_writes() {
    let folder = folder_with_case();
    let docs = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    for of in ["scenario", "study"] {
        let page = out(&answer(folder.path(), &["explain", "--of", of, "--markdown"]));
        let file = docs.join(format!("keys-{of}.md"));
        let is_same = std::fs::read_to_string(&file).is_ok_and(|text| text == page);
        assert!(is_same, "write it anew: occupant explain --of {of} --markdown > {}", file.display());
    }
}

#[test]
fn keys_are_explained_wherever_they_stand() {
    let folder = folder_with_case();
    let told = |words: &[&str]| {
        let output = answer(folder.path(), &[&["explain"], words].concat());
        (code(&output), out(&output), err(&output))
    };
    let (exit, sections, _) = told(&[]);
    assert_eq!(exit, 0);
    assert!(sections.contains("  path: table\n      Motion of the vehicle. "), "{sections}");
    for path in ["path.delta_v", "delta_v"] {
        let (_, key, _) = told(&[path]);
        assert!(key.starts_with("path.delta_v   (kind = \"pulse\")\n") && key.contains("(in/s with units"), "{key}");
    }
    let (_, key, _) = told(&["belts.my-own.slack"]);
    assert!(key.starts_with("belts.NAME.slack\n"), "{key}");
    let (_, key, _) = told(&["shape"]);
    assert!(key.contains("\"half_sine\""), "{key}");
    let (_, kinds, _) = told(&["sensors"]);
    assert!(
        kinds.starts_with("path.kind   (kind = \"sensors\")\n") && kinds.contains("event data recorder"),
        "{kinds}"
    );
    let (exit, _, said) = told(&["path.kindd"]);
    assert!(exit == 2 && said.contains("did you mean `kind`?"), "{said}");
    let (_, key, _) = told(&["--of", "study", "parameters.path"]);
    assert!(key.starts_with("parameters[].path\n"), "{key}");
    // every key of both schemas has words
    for of in ["scenario", "study"] {
        let (_, page, _) = told(&["--of", of, "--markdown"]);
        let rows = page.lines().filter(|line| line.starts_with("| `"));
        let silent: Vec<&str> = rows.filter(|row| row.ends_with("|  |") && !row.contains("NAME")).collect();
        assert!(silent.is_empty(), "{silent:#?}");
    }
}
