use super::{answer, code, err, folder_with_case};

#[test]
fn a_file_that_exists_is_not_written_over() {
    let folder = folder_with_case();
    let file = folder.path().join("case.mcap");
    std::fs::write(&file, "mine").unwrap();
    let output = answer(folder.path(), &["run", "case.toml"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("--force"), "{}", err(&output));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(code(&answer(folder.path(), &["run", "case.toml", "--force"])), 0);
    assert!(std::fs::metadata(&file).unwrap().len() > 10_000);
}

#[test]
fn what_an_interrupted_run_left_is_not_written_over() {
    let folder = folder_with_case();
    let partial = folder.path().join("case.partial.mcap");
    std::fs::write(&partial, "half").unwrap();
    let output = answer(folder.path(), &["run", "case.toml"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("case.partial.mcap"), "{}", err(&output));
    assert_eq!(std::fs::read_to_string(&partial).unwrap(), "half");
    assert_eq!(code(&answer(folder.path(), &["run", "case.toml", "-f"])), 0);
    assert!(!partial.exists());
}

#[test]
fn the_same_scenario_gives_the_same_bytes() {
    let folder = folder_with_case();
    for name in ["a.mcap", "b.mcap"] {
        assert_eq!(code(&answer(folder.path(), &["run", "case.toml", "-q", "-o", name])), 0);
    }
    let bytes = |name| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("a.mcap") == bytes("b.mcap"));
}

#[test]
fn a_folder_that_is_not_there_is_named() {
    let folder = folder_with_case();
    let output = answer(folder.path(), &["run", "case.toml", "-o", "no/such/run.mcap"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("no/such/run.partial.mcap"), "{}", err(&output));
}
