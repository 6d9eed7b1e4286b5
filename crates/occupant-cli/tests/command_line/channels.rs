use std::fs;

use super::{answer, code, err, out};

#[test]
fn channels_are_found_by_words_of_their_names_and_meanings() {
    let folder = tempfile::tempdir().expect("a folder");
    let channels = |words: &[&str]| answer(folder.path(), &[&["channels"], words].concat());
    let all = out(&channels(&[]));
    let has = |list: &str, name: &str| list.lines().any(|line| line.split_whitespace().next() == Some(name));
    assert!(
        has(&all, "head.acceleration.{x,y,z,resultant}") && has(&all, "strap.driver.d_ring_shoulder.force"),
        "{all}"
    );
    let belts = out(&channels(&["Strap"]));
    assert!(
        has(&belts, "strap.driver.d_ring_shoulder.force") && !has(&belts, "head.acceleration.{x,y,z,resultant}"),
        "{belts}"
    );
    assert!(belts.lines().count() < all.lines().count());
    // of a scenario, and the same of its results
    fs::write(folder.path().join("case.toml"), include_str!("../recording/short.toml")).expect("written");
    let run = answer(folder.path(), &["run", "case.toml", "-q", "-o", "run.mcap", "--set", "time.end=0"]);
    assert_eq!(code(&run), 0, "{}", err(&run));
    let [scenario, results] = ["case.toml", "run.mcap"].map(|file| out(&channels(&["--of", file])));
    assert!(scenario == results && scenario.lines().count() > 100, "{scenario}");
    let several = out(&channels(&["chest deflection"]));
    assert!(has(&several, "chest.deflection") && !has(&several, "pelvis.acceleration.{x,y,z,resultant}"), "{several}");
    let none = channels(&["haed"]);
    assert_eq!(code(&none), 2);
    assert!(err(&none).contains("no channel has `haed`") && err(&none).contains("`head`"), "{}", err(&none));
}
