use super::{answer, code, err, folder_with_case, out};

#[test]
fn a_starter_scenario_runs_as_it_is() {
    let folder = folder_with_case();
    let check = answer(folder.path(), &["check", "case.toml"]);
    assert_eq!((code(&check), err(&check)), (0, String::new()));
    let run = answer(folder.path(), &["run", "case.toml"]);
    assert_eq!((code(&run), err(&run)), (0, String::new()));
    assert!(folder.path().join("case.mcap").exists());
    assert!(!folder.path().join("case.partial.mcap").exists());
}

#[test]
fn a_file_that_exists_is_left_alone_unless_forced() {
    let folder = folder_with_case();
    let file = folder.path().join("case.toml");
    std::fs::write(&file, "mine").unwrap();
    let again = answer(folder.path(), &["new", "case.toml"]);
    assert_eq!(code(&again), 2);
    assert!(err(&again).contains("--force"), "{}", err(&again));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(code(&answer(folder.path(), &["new", "case.toml", "--force"])), 0);
    assert!(std::fs::read_to_string(&file).unwrap().contains("[path]"));
}

#[test]
fn the_ending_is_added_and_no_other_is_taken() {
    let folder = folder_with_case();
    let named = answer(folder.path(), &["new", "other"]);
    assert_eq!((code(&named), out(&named)), (0, String::new()));
    assert!(err(&named).contains("occupant run other.toml"));
    assert!(folder.path().join("other.toml").exists());
    assert_eq!(code(&answer(folder.path(), &["new", "other.json"])), 2);
    assert_eq!(code(&answer(folder.path(), &["new", "no/such/folder.toml"])), 2);
}
