//! Text → scenario → text, TOML and JSON.

use super::super::{Draft, Format, Scenario};
use super::{SHORT, build, load, no_files};

#[test]
fn toml_comes_back_word_for_word_in_its_values() {
    let loaded = load(SHORT).unwrap();
    let text = loaded.scenario.to_toml().unwrap();
    let again = load(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert_eq!(again.scenario, loaded.scenario);
    assert_eq!(again.build().unwrap().0, loaded.build().unwrap().0);
    // Units and whole numbers stay as they were written.
    assert!(text.contains("k1 = \"70 kN/m\""), "{text}");
    assert!(text.contains("middle_torso = 15\n"), "{text}");
    // The order of surfaces is theirs, not the alphabet's.
    let place = |name: &str| text.find(&format!("[surfaces.{name}]")).unwrap();
    assert!(place("cushion") < place("back") && place("back") < place("floor"));
}

fn short_as_json() -> String {
    let tree: serde_json::Value = toml::from_str(&load(SHORT).unwrap().scenario.to_toml().unwrap()).unwrap();
    serde_json::to_string_pretty(&tree).unwrap()
}

#[test]
fn json_says_the_same_as_toml() {
    let json = short_as_json();
    assert_eq!(Format::of_text(&json), Format::Json);
    let loaded = Scenario::from_text(&json, Format::Json, "s.json", &no_files).unwrap();
    assert_eq!(loaded.scenario, load(SHORT).unwrap().scenario);
    assert_eq!(loaded.build().unwrap().0, build(SHORT));
}

#[test]
fn json_problems_have_their_places_too() {
    let json = short_as_json();
    let wrong = json.replace("\"70 kN/m\"", "\"70 kN\"").replace("\"mu1\": 0.5", "\"mu1\": null");
    let problems = Scenario::from_text(&wrong, Format::Json, "s.json", &no_files).unwrap_err();
    let lines: Vec<&str> = problems.iter().filter_map(|d| d.line.as_deref()).map(str::trim).collect();
    assert_eq!(lines, ["\"k1\": \"70 kN\"", "\"mu1\": null,"], "{problems}");
}

#[test]
fn the_explicit_form_builds_the_same() {
    let loaded = load(SHORT).unwrap();
    let text = loaded.explicit().to_toml().unwrap();
    let (mut again, _) = load(&text).unwrap_or_else(|e| panic!("{e}")).build().unwrap();
    let first = loaded.build().unwrap().0;
    assert_eq!(again.body.name, "own");
    again.body.name = first.body.name.clone();
    assert_eq!(again, first);
}

#[test]
fn overrides_show_in_the_written_scenario() {
    let mut draft = Draft::read(SHORT, Format::Toml, "s.toml").unwrap();
    draft.set("joints.neck.damping = \"20 in lbf s/rad\"").unwrap();
    let text = draft.load(&no_files).unwrap().scenario.to_toml().unwrap();
    assert!(text.contains("[joints.neck]\ndamping = \"20 in lbf s/rad\""), "{text}");
}
