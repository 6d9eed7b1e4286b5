//! `occupant plot`.

use super::{coarse, err, fine, refused, text, well};

const TITLES: [&str; 14] = [
    "Head acceleration X, ahead",
    "Head acceleration Z, up",
    "Head acceleration resultant",
    "Chest acceleration X, ahead",
    "Chest acceleration Z, up",
    "Chest acceleration resultant",
    "Pelvis acceleration X, ahead",
    "Pelvis acceleration Z, up",
    "Pelvis acceleration resultant",
    "Contact force on head, chest and knees",
    "Belt loads",
    "Spine angles",
    "Energy",
    "Vehicle acceleration",
];

#[test]
fn a_sheet_has_the_fourteen_plots() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    well(folder.path(), &["plot", run, "-o", "plots.svg"]);
    let svg = text(&folder.path().join("plots.svg"));
    for title in TITLES {
        assert!(svg.contains(&format!(">{title}</text>")), "{title}");
    }
    assert_eq!(svg.matches(">time, ms</text>").count(), 14);
    assert_eq!(svg.matches(">acceleration, g</text>").count(), 10);
    assert!(svg.contains("Short") && svg.contains("not filtered"));
    well(folder.path(), &["plot", run, "-o", "plots.png", "--pixels", "0.5"]);
    let png = std::fs::read(folder.path().join("plots.png")).unwrap();
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    well(folder.path(), &["plot", run, "--each", "single"]);
    assert_eq!(std::fs::read_dir(folder.path().join("single")).unwrap().count(), 14);
    assert!(folder.path().join("single/11-belt-loads.svg").exists());
}

#[test]
fn runs_tests_and_limits_lie_over_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (coarse(), fine());
    let (a, b) = (a.to_str().unwrap(), b.to_str().unwrap());
    let channel = "head.acceleration.resultant";
    std::fs::write(folder.path().join("lab.csv"), "t[ms],head[g]\n-5,1\n0,1\n10,3\n20,NaN\n29,2\n").unwrap();
    let map = format!("head={channel}");
    let limit = format!("{channel}=80 g");
    let words =
        ["plot", a, b, "-o", "p.svg", "--channel", channel, "--test", "lab.csv", "--map", &map, "--limit", &limit];
    well(folder.path(), &words);
    let svg = text(&folder.path().join("p.svg"));
    for label in
        [">coarse</text>", ">fine</text>", ">test: head (lab.csv)</text>", ">limit 80 g</text>", ">2 runs</text>"]
    {
        assert!(svg.contains(label), "{label}");
    }
    // the limit is in the range of the axis
    assert!(svg.contains(">80</text>"));
    // the lone point behind the gap is a dot
    assert_eq!(svg.matches("<circle").count(), 1);
}

#[test]
fn a_channel_may_lie_across() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    let words = ["plot", run, "-o", "p.svg", "--channel", "belt.*.force", "--x", "head.position.x", "--units", "si"];
    well(folder.path(), &words);
    let svg = text(&folder.path().join("p.svg"));
    assert!(svg.contains(">head.position.x, m</text>") && svg.contains(">force, N</text>"));
}

#[test]
fn what_cannot_be_plotted_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    for (words, expected) in [
        (vec!["plot", run, "-o", "p.pdf"], ".svg or .png"),
        (vec!["plot", run, "-o", "p.svg", "--channel", "head.*"], "one plot has one axis"),
        (vec!["plot", run, "-o", "p.svg", "--channel", "hed.acceleration.x"], "did you mean"),
        (vec!["plot", run, "-o", "p.svg", "--limit", "neck.force.z=4 kN"], "no plot shows"),
        (vec!["plot", run, "-o", "p.svg", "--limit", "head.acceleration.x=4 kN"], "not a unit of this channel"),
        (vec!["plot", run, "-o", "p.svg", "--from", "20 ms", "--to", "10 ms"], "not before"),
        (vec!["plot", run, "-o", "p.svg", "--test", "none.csv"], "none.csv cannot be read"),
        (vec!["plot", run, "-o", "p.svg", "--filter", "CFC1000"], "CFC 1000 needs"),
    ] {
        let said = refused(folder.path(), &words);
        assert!(said.contains(expected), "{words:?}: {said}");
    }
    assert!(!folder.path().join("p.svg").exists());
}

#[test]
fn every_occupant_and_every_vehicle_has_its_plots() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/hand/two-vehicles.toml");
    well(folder.path(), &["run", scenario, "-q", "-o", "two.mcap", "--until", "120 ms"]);
    let said = well(folder.path(), &["plot", "two.mcap", "--each", "single"]);
    let files: Vec<String> = std::fs::read_dir(folder.path().join("single"))
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    // thirteen of each driver, one of each car, none of them empty
    assert_eq!(files.len(), 28, "{}", err(&said));
    for file in &files {
        let svg = text(&folder.path().join("single").join(file));
        assert!(svg.contains("<path") || svg.contains("<polyline"), "{file} is empty");
        assert!(!svg.contains("none in this scenario"), "{file}");
    }
    for name in ["01-heavy-head-acceleration-x-ahead.svg", "28-acceleration-of-the-vehicle-light.svg"] {
        assert!(files.iter().any(|file| file == name), "{name}: {files:?}");
    }
}

#[test]
fn both_names_of_the_channels_option_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let run = coarse();
    let run = run.to_str().unwrap();
    for option in ["--channel", "--channels"] {
        well(folder.path(), &["plot", run, "-f", "-o", "p.svg", option, "head.acceleration.x"]);
        well(folder.path(), &["export", run, "-f", "-o", "p.csv", option, "head.acceleration.x"]);
    }
}
