//! `occupant view` and `occupant report` as a user calls them.

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;

const SHORT: &str = include_str!("recording/short.toml");

fn answer(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
    let output = command.current_dir(folder).args(words).output();
    output.expect("the command starts")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("an exit code")
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

/// A folder with the results of a short run whose title wants to be markup.
fn folder_with_run() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let hostile = "title = \"</script><script>alert(1)</script> & <b>\"";
    let lines = SHORT.lines().filter(|l| !l.starts_with("title"));
    let text = lines.fold(hostile.to_owned(), |all, line| all + "\n" + line);
    fs::write(folder.path().join("case.toml"), text).expect("written");
    let run = answer(folder.path(), &["run", "case.toml", "--quiet", "-o", "run.mcap"]);
    assert_eq!(code(&run), 0, "{}", err(&run));
    folder
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).expect("a text")
}

#[test]
fn a_strip_has_a_panel_for_each_time_and_view() {
    let folder = folder_with_run();
    let words = ["view", "run.mcap", "-o", "v.svg", "--times", "0,2,4 ms", "--views", "side,front"];
    let output = answer(folder.path(), &words);
    assert_eq!((code(&output), err(&output)), (0, "wrote v.svg\n".to_owned()));
    let svg = read(folder.path(), "v.svg");
    assert_eq!(svg.matches("<clipPath").count(), 6);
    for label in [">0 ms<", ">2 ms<", ">4 ms<", ">side<", ">front<", "from the right"] {
        assert!(svg.contains(label), "{label}");
    }
    assert!(!svg.contains(">top<"));
    assert!(svg.contains("&lt;/script&gt;") && !svg.contains("<script"));
    // the same file every time
    let again = answer(folder.path(), &[&words[..], &["--force"]].concat());
    assert_eq!(code(&again), 0, "{}", err(&again));
    assert_eq!(read(folder.path(), "v.svg"), svg);
}

#[test]
fn what_is_made_of_a_run_has_a_name_beside_it_and_is_told() {
    let folder = folder_with_run();
    for (words, name) in [
        (&["view", "run.mcap", "--times", "0"][..], "run-view.svg"),
        (&["plot", "run.mcap"], "run-plot.svg"),
        (&["report", "run.mcap"], "run.html"),
        (&["export", "run.mcap"], "run.csv"),
    ] {
        let output = answer(folder.path(), words);
        assert_eq!(code(&output), 0, "{}", err(&output));
        assert!(err(&output).contains("wrote ") && err(&output).ends_with(&format!("{name}\n")), "{}", err(&output));
        assert!(folder.path().join(name).exists(), "{name}");
        // nothing that is there is replaced, but an earlier report of the same
        let again = answer(folder.path(), words);
        let replaced = err(&again).contains("run.html, an earlier report of the same run");
        assert_eq!((code(&again), replaced), if name == "run.html" { (0, true) } else { (2, false) }, "{name}");
    }
    fs::copy(folder.path().join("run.mcap"), folder.path().join("other.mcap")).expect("a copy");
    for words in [&["report", "run.mcap", "-o", "run.html"][..], &["report", "run.mcap", "--against", "other.mcap"]] {
        assert_eq!(code(&answer(folder.path(), words)), 2, "{words:?}");
    }
    fs::write(folder.path().join("other.html"), "mine").expect("written");
    assert_eq!(code(&answer(folder.path(), &["report", "other.mcap"])), 2);
}

#[test]
fn a_strip_becomes_a_png_of_twice_its_size() {
    let folder = folder_with_run();
    for name in ["v.svg", "v.png"] {
        let output = answer(folder.path(), &["view", "run.mcap", "-o", name, "--times", "0"]);
        assert_eq!((code(&output), err(&output)), (0, format!("wrote {name}\n")));
    }
    let png = fs::read(folder.path().join("v.png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n"));
    let svg = read(folder.path(), "v.svg");
    let number = |from: &str| -> f64 {
        let rest = svg.split_once(from).expect("there").1;
        rest.split('"').next().expect("a value").parse().expect("a number")
    };
    let size = |at: usize| f64::from(u32::from_be_bytes(png[at..at + 4].try_into().expect("four")));
    assert!((size(16) - 2.0 * number("width=\"")).abs() <= 1.0);
    assert!((size(20) - 2.0 * number("height=\"")).abs() <= 1.0);
}

#[test]
fn a_scenario_is_drawn_as_it_starts() {
    let folder = folder_with_run();
    let words = ["view", "case.toml", "--set", "title=\"Seated\"", "--views", "side"];
    let output = answer(folder.path(), &words);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let seated = read(folder.path(), "case-view.svg");
    assert!(seated.contains(">Seated<") && seated.contains(">-10 ms<") && seated.contains("before a run"));
    // as the first output of its run
    let run = answer(folder.path(), &["view", "run.mcap", "--times", "-10 ms", "--views", "side"]);
    assert_eq!(code(&run), 0, "{}", err(&run));
    let body = |svg: &str| svg.split_once("<clipPath").unwrap().1.split_once("</svg>").unwrap().0.to_owned();
    let of_run = body(&read(folder.path(), "run-view.svg"));
    let [seated, of_run] = [body(&seated), of_run].map(|svg| svg.matches("<polygon").count());
    assert!(seated > 10 && seated == of_run, "{seated} {of_run}");
}

#[test]
fn a_film_has_a_frame_for_each_time() {
    let folder = folder_with_run();
    for (more, frames) in [(&["--times", "0,1,2 ms"][..], 3), (&["--slow-motion", "100", "--views", "top,front"], 99)] {
        let words = [&["view", "run.mcap", "-o", "film.gif", "--force"], more].concat();
        let output = answer(folder.path(), &words);
        assert_eq!((code(&output), err(&output)), (0, "wrote film.gif\n".to_owned()));
        let bytes = fs::read(folder.path().join("film.gif")).unwrap();
        let mut film = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
        let mut found = 0;
        while film.read_next_frame().unwrap().is_some() {
            found += 1;
        }
        assert_eq!(found, frames);
    }
    let output = answer(folder.path(), &["view", "run.mcap", "--each", "frames", "--times", "0,1,2 ms"]);
    assert_eq!((code(&output), err(&output)), (0, "wrote 3 frames into frames\n".to_owned()));
    let picture = |n: u32| fs::read(folder.path().join(format!("frames/000{n}.png"))).unwrap();
    assert!((1..=3).all(|n| picture(n).starts_with(b"\x89PNG")) && picture(1) != picture(3));
    assert_eq!(code(&answer(folder.path(), &["view", "run.mcap", "--each", "frames", "--times", "0,1,2 ms"])), 2);
}

/// One time gives one picture, several a sheet of three columns; each camera gives another picture, the same one twice.
#[test]
fn pictures_in_three_dimensions_have_their_size_and_camera() {
    let folder = folder_with_run();
    let camera = "eye = [2.5, 1.5, -0.8]\ntarget = [0.0, 0, -0.3]\nfield_of_view = 35\n";
    fs::write(folder.path().join("aside.toml"), camera).expect("written");
    let picture = |more: &[&str]| {
        let words = [&["view", "run.mcap", "--3d", "--size", "160x90", "-o", "v.png", "--force"], more].concat();
        let output = answer(folder.path(), &words);
        assert_eq!((code(&output), err(&output)), (0, "wrote v.png\n".to_owned()), "{more:?}");
        fs::read(folder.path().join("v.png")).unwrap()
    };
    let side = |png: &[u8], at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    let cameras = ["vehicle", "ground", "chase", "driver", "aside.toml"];
    let mut all: Vec<Vec<u8>> =
        cameras.iter().map(|camera| picture(&["--times", "1 ms", "--camera", camera])).collect();
    assert_eq!(all[0], picture(&["--times", "1 ms"]));
    assert_eq!([side(&all[0], 16), side(&all[0], 20)], [160, 90]);
    all.sort();
    all.dedup();
    assert_eq!(all.len(), cameras.len());
    let sheet = picture(&["--times", "0,1,2,3 ms"]);
    assert_eq!([side(&sheet, 16), side(&sheet, 20)], [480, 180]);
    let words =
        ["view", "run.mcap", "--3d", "--size", "160x90", "-o", "v.gif", "--slow-motion", "200", "--freeze", "1 ms"];
    assert_eq!(code(&answer(folder.path(), &words)), 0);
    let bytes = fs::read(folder.path().join("v.gif")).unwrap();
    let mut film = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let mut frames = 0;
    while film.read_next_frame().unwrap().is_some() {
        frames += 1;
    }
    // 50 frames at rest
    assert_eq!(frames, 198 + 50);
}

#[test]
fn wrong_cameras_are_answered() {
    let folder = folder_with_run();
    let camera = |text: &str| fs::write(folder.path().join("c.toml"), text).expect("written");
    let refused = |more: &[&str], said: &str| {
        let output = answer(folder.path(), &[&["view", "run.mcap", "-o", "v.png"], more].concat());
        assert_eq!(code(&output), 2, "{more:?}");
        assert!(err(&output).contains(said), "{more:?}: {}", err(&output));
    };
    refused(&["--3d", "--camera", "grund"], "is `ground` meant?");
    refused(&["--3d", "--camera", "none.toml"], "cannot be read");
    refused(&["--3d", "--freeze", "1 ms"], "this is a picture");
    let output = answer(folder.path(), &["view", "run.mcap", "-o", "v.gif", "--freeze", "5 s"]);
    assert!(code(&output) == 2 && err(&output).contains("--freeze 5000 ms is outside the run"), "{}", err(&output));
    refused(&["--3d", "--size", "0x90"], "16 to 8192");
    refused(&["--3d", "--size", "big"], "such as 1920x1080");
    refused(&["--3d", "--views", "top"], "cannot be used with");
    refused(&["--camera", "ground"], "--3d");
    for (text, said) in [
        ("eye = [1, 2, 3]\ntarget = [1, 2, 3]", "its own eye"),
        ("eye = [nan, 2, 3]\ntarget = [1, 2, 3]", "three numbers"),
        ("eye = [1, 2]\ntarget = [1, 2, 3]", "three numbers"),
        ("target = [1, 2, 3]", "`eye` is no place"),
        ("eye = [1, 2, 3]\ntarget = [1, 2, 0]\nfield_of_view = 0", "from 1 to 170"),
        ("eye = [1, 2, 3]\ntarget = [1, 2, 0]\nframe = \"moon\"", "\"vehicle\" or \"space\""),
        ("eye = [1, 2, 3]\ntarget = [1, 2, 0]\nzoom = 3", "`zoom` is no key"),
    ] {
        camera(text);
        refused(&["--3d", "--camera", "c.toml"], said);
        refused(&["--3d", "--camera", "c.toml"], "c.toml");
    }
    let output = answer(folder.path(), &["view", "run.mcap", "--3d", "-o", "v.svg"]);
    assert!(code(&output) == 2 && err(&output).contains("made of pixels"), "{}", err(&output));
    let output = answer(folder.path(), &["view", "case.toml", "--3d", "-o", "v.png"]);
    assert!(code(&output) == 2 && err(&output).contains("--3d needs a run"), "{}", err(&output));
}

#[test]
fn wrong_words_for_a_view_are_answered() {
    let folder = folder_with_run();
    let cases: [(&[&str], &str); 10] = [
        (&["view", "run.mcap", "-o", "v.pdf"], "use the extension .svg, .png, .gif or .mp4"),
        (&["view", "run.mcap", "-o", "v.svg", "--times", "9 s"], "outputs cover"),
        (&["view", "run.mcap", "-o", "v.svg", "--times", "soon"], "is not a time"),
        (&["view", "run.mcap", "-o", "v.svg", "--views", "back"], "possible values"),
        (&["view", "case.toml", "-o", "v.gif"], "a film needs a run"),
        (&["view", "case.toml", "-o", "v.svg", "--times", "0"], "--times needs a run"),
        (&["view", "case.toml", "-o", "v.svg", "--set", "path.speed=1 N"], "path.speed"),
        (&["view", "run.mcap", "-o", "v.svg", "--set", "path.speed=1"], "this is a run"),
        (&["view", "run.mcap", "-o", "v.gif", "--slow-motion", "1e4"], "at most 3000 are possible"),
        (&["view", "none.mcap", "-o", "v.svg"], "cannot be read"),
    ];
    for (words, said) in cases {
        let output = answer(folder.path(), words);
        assert_eq!(code(&output), 2, "{words:?}");
        assert!(err(&output).contains(said), "{words:?}: {}", err(&output));
        assert!(!folder.path().join("v.svg").exists());
    }
}

#[test]
fn nothing_is_replaced_unasked() {
    let folder = folder_with_run();
    fs::write(folder.path().join("v.svg"), "mine").expect("written");
    fs::write(folder.path().join("r.html"), "mine").expect("written");
    for (command, name) in [("view", "v.svg"), ("report", "r.html")] {
        let output = answer(folder.path(), &[command, "run.mcap", "-o", name]);
        assert_eq!(code(&output), 2);
        assert!(err(&output).contains("exists; replace it with --force"));
        assert_eq!(read(folder.path(), name), "mine");
        let forced = answer(folder.path(), &[command, "run.mcap", "-o", name, "--force"]);
        assert_eq!(code(&forced), 0, "{}", err(&forced));
        assert_ne!(read(folder.path(), name), "mine");
    }
}

#[test]
fn a_report_is_one_file_whose_data_stay_data() {
    let folder = folder_with_run();
    let output = answer(folder.path(), &["report", "run.mcap", "-o", "r.html"]);
    assert_eq!((code(&output), err(&output)), (0, "wrote r.html\n".to_owned()));
    let html = read(folder.path(), "r.html");
    // the program of the page, the data and the licences: three elements, whatever the title says
    assert_eq!(html.matches("</script>").count(), 3);
    assert!(html.contains("Leon Sorokin") && html.contains("three.js authors"));
    assert!(html.contains("<title>&lt;/script&gt;"));
    let data = html.split_once("id=\"report-data\">").expect("data").1;
    let data = data.split_once("</script>").expect("an end").0;
    let data: serde_json::Value = serde_json::from_str(data).expect("JSON");
    let run = &data["runs"][0];
    assert_eq!(run["title"], "</script><script>alert(1)</script> & <b>");
    assert_eq!(run["segments"].as_array().expect("a list").len(), 12);
    assert!(run["measures"].as_array().expect("a list").len() > 10);
    assert!(run["scenario"].as_str().expect("a text").contains("[body"));
    for source in ["src=\"", "href=\"", "@import", "url(http"] {
        assert!(!html.contains(source), "{source}");
    }
}

/// Moments and angles of joints stood there as forces in kN.
#[test]
fn peaks_of_all_elements_have_their_own_units() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/hand/three-point.toml");
    let words = ["run", scenario, "--json", "-o", "run.mcap", "--set", "time.end=90 ms"];
    let run = answer(folder.path(), &words);
    let summary: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
    assert_eq!(code(&answer(folder.path(), &["report", "run.mcap"])), 0);
    let html = read(folder.path(), "run.html");
    let data = html.split_once("id=\"report-data\">").and_then(|(_, rest)| rest.split_once("</script>"));
    let data: serde_json::Value = serde_json::from_str(data.expect("data").0).expect("JSON");
    let measures = data["runs"][0]["measures"].as_array().expect("a list");
    let row =
        |name: &str| measures.iter().find(|m| m["name"] == name).unwrap_or_else(|| panic!("{name}: {measures:?}"));
    let neck =
        summary["joints"].as_array().expect("joints").iter().find(|joint| joint["joint"] == "neck").expect("a neck");
    let moment = row("Joint neck, stop moment");
    assert_eq!((&moment["unit"], &moment["value"]), (&"N·m".into(), &neck["stop_peak_n_m"]));
    assert_eq!(row("Joint neck, beyond limit")["unit"], "°");
    assert_eq!(row("Strap driver.buckle_sill, force")["unit"], "kN");
    // what was never reached has no row
    assert!(measures.iter().all(|m| m["group"] != "Loads" || !m["time_s"].is_null()));
}

/// What each of several occupants' instruments show has a plot that says whose; the page's numbers are in the units asked for.
#[test]
fn each_occupant_has_plots_in_the_units_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenario = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/hand/side-by-side.toml");
    let run = answer(folder.path(), &["run", scenario, "--quiet", "-o", "run.mcap", "--set", "time.end=5 ms"]);
    assert_eq!(code(&run), 0, "{}", err(&run));
    assert_eq!(code(&answer(folder.path(), &["report", "run.mcap", "--units", "in-lbf-s"])), 0);
    let html = read(folder.path(), "run.html");
    let data = html.split_once("id=\"report-data\">").and_then(|(_, rest)| rest.split_once("</script>"));
    let data: serde_json::Value = serde_json::from_str(data.expect("data").0).expect("JSON");
    let run = &data["runs"][0];
    let plots = run["plots"].as_array().expect("a list");
    for (of, curves) in [("Resultant acceleration", 3), ("Neck force on the head", 3), ("Femur axial force", 2)] {
        for name in ["driver", "passenger"] {
            let plot = plots.iter().find(|plot| plot["title"] == format!("{of}, {name}"));
            let plot = plot.unwrap_or_else(|| panic!("{of} {name}"));
            let found = plot["curves"].as_array().expect("a list");
            assert_eq!(found.len(), curves);
            let is_own = |curve: &serde_json::Value| curve["meaning"].as_str().unwrap().starts_with(name);
            assert!(found.iter().all(is_own), "{of} {name}");
        }
    }
    assert_eq!([&run["force_unit"][1], &run["speed_unit"][1]], ["lbf", "mph"]);
    let facts = run["facts"].as_str().expect("a text");
    assert!(facts.contains(" lb") && !facts.contains(" kg"), "{facts}");
}

#[test]
fn a_report_plots_the_channels_that_were_chosen_first() {
    let folder = folder_with_run();
    let report = |channels: &str| answer(folder.path(), &["report", "run.mcap", "--channel", channels]);
    let output = report("head.acceleration.*,head.position.x");
    assert_eq!(code(&output), 0, "{}", err(&output));
    let html = read(folder.path(), "run.html");
    let data = html.split_once("id=\"report-data\">").and_then(|(_, rest)| rest.split_once("</script>"));
    let data: serde_json::Value = serde_json::from_str(data.expect("data").0).expect("JSON");
    let plots = data["runs"][0]["plots"].as_array().expect("plots");
    let heads = plots[..2].iter().map(|plot| (plot["title"].as_str(), plot["unit"].as_str()));
    let expected = [(Some("head.acceleration.x and 3 more"), Some("m/s²")), (Some("head.position.x"), Some("m"))];
    assert_eq!(heads.collect::<Vec<_>>(), expected);
    assert_eq!(plots[0]["curves"].as_array().map(Vec::len), Some(4));
    let output = report("hed.position.x");
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("there is no channel `hed.position.x`"), "{}", err(&output));
}

#[test]
fn a_report_against_another_run_holds_both() {
    let folder = folder_with_run();
    let words = ["report", "run.mcap", "-o", "r.html", "--against", "run.mcap"];
    let output = answer(folder.path(), &words);
    assert_eq!((code(&output), err(&output)), (0, "wrote r.html\n".to_owned()));
    assert_eq!(read(folder.path(), "r.html").matches("\"poses\":").count(), 2);
    for (words, said) in [
        (&["report", "run.mcap", "-o", "r.txt"][..], "use the extension .html"),
        (&["report", "run.mcap", "-o", "x.html", "--against", "case.toml"], "is a scenario or a study"),
    ] {
        let output = answer(folder.path(), words);
        assert_eq!(code(&output), 2, "{words:?}");
        assert!(err(&output).contains(said), "{words:?}: {}", err(&output));
    }
}

#[test]
fn what_a_run_that_broke_off_has_left_can_be_drawn() {
    let folder = folder_with_run();
    let bytes = fs::read(folder.path().join("run.mcap")).expect("results");
    // a run that is cut off has no record of its result
    let name = b"occupant.result";
    let end = bytes.windows(name.len()).position(|w| w == name);
    let cut = &bytes[..end.expect("a result") - 20];
    fs::write(folder.path().join("cut.mcap"), cut).expect("written");
    for (command, name) in [("view", "v.svg"), ("report", "r.html")] {
        let output = answer(folder.path(), &[command, "cut.mcap", "-o", name]);
        let said = err(&output);
        assert_eq!(code(&output), 0, "{said}");
        assert!(said.contains("did not complete"), "{said}");
        assert!(read(folder.path(), name).contains("did not complete"));
    }
}

/// A prism has four sides and two ends: six polygons more, and a contact with it finds its name behind the surfaces.
#[test]
fn solids_are_drawn_in_views_and_on_the_page() {
    let folder = folder_with_run();
    let solid = "[solids]\nblock = { kind = \"prism\", material = \"seat\", \
        profile = [[0.6, 0], [0.8, 0], [0.8, 0.2], [0.6, 0.2]], half_width = 0.3 }\n";
    fs::write(folder.path().join("solid.toml"), format!("{SHORT}\n{solid}")).expect("written");
    let run = answer(folder.path(), &["run", "solid.toml", "--quiet", "-o", "solid.mcap"]);
    assert_eq!(code(&run), 0, "{}", err(&run));
    let drawn = |run: &str| {
        let (svg, html) = (run.replace("mcap", "svg"), run.replace("mcap", "html"));
        for words in [&["view", run, "-o", &svg, "--times", "0", "--views", "side"][..], &["report", run, "-o", &html]]
        {
            let output = answer(folder.path(), words);
            assert_eq!(code(&output), 0, "{}", err(&output));
        }
        let html = read(folder.path(), &html);
        let data = html.split_once("id=\"report-data\">").and_then(|(_, rest)| rest.split_once("</script>"));
        let data: serde_json::Value = serde_json::from_str(data.expect("data").0).expect("JSON");
        let surfaces = data["runs"][0]["surfaces"].as_array().expect("a list").clone();
        (read(folder.path(), &svg).matches("#5b6770").count(), surfaces)
    };
    let ((without, surfaces), (with, sides)) = (drawn("run.mcap"), drawn("solid.mcap"));
    assert_eq!((with - without, sides.len() - surfaces.len()), (6, 6));
    assert_eq!(sides[..surfaces.len()], surfaces);
    assert_eq!((&sides[surfaces.len()]["name"], &sides[surfaces.len()]["bounded"]), (&"block".into(), &true.into()));
}

/// A sphere that no limb reaches looks like a thing of its own: toes did, of legs without feet.
#[test]
fn no_sphere_of_a_body_floats_beside_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let cart = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/cart-unbelted.toml");
    for view in ["side", "top", "front"] {
        let output = answer(folder.path(), &["view", cart, "-f", "-o", "sits.svg", "--views", view]);
        assert_eq!(code(&output), 0, "{}", err(&output));
        let svg = read(folder.path(), "sits.svg");
        let groups = |opening: &str| -> Vec<String> {
            let parts = svg.split(opening).skip(1).map(|rest| rest.split("</g>").next().unwrap_or_default().to_owned());
            parts.collect()
        };
        let body = &groups("<g stroke=\"#2b2f36\" stroke-width=\"0.7\" stroke-linejoin=\"round\">")[0];
        let spheres = &groups("<g fill=\"none\" stroke=\"#2b2f36\" stroke-opacity=\"0.45\"")[0];
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let attribute = |element: &str, name: &str| {
            element.split_once(&format!(" {name}=\"")).and_then(|(_, rest)| rest.split('"').next()).map(str::to_owned)
        };
        let polygons: Vec<Vec<[f64; 2]>> = body
            .split("<polygon")
            .filter_map(|element| attribute(element, "points"))
            .map(|points| {
                points.split(' ').filter_map(|p| p.split_once(',')).map(|(x, y)| [number(x), number(y)]).collect()
            })
            .collect();
        let circles: Vec<[f64; 3]> = spheres
            .split("<circle")
            .map(|element| {
                ["cx", "cy", "r"].map(|name| attribute(element, name)).map(|v| number(&v.unwrap_or("0".into())))
            })
            .filter(|[.., radius]| *radius > 0.0)
            .collect();
        assert!(circles.len() > 30 && polygons.len() > 20, "{} and {}", circles.len(), polygons.len());
        // polygons are convex: inside is always on the same side
        let holds = |polygon: &Vec<[f64; 2]>, c: &[f64; 2]| {
            let sides = (0..polygon.len()).map(|i| {
                let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            });
            let sides: Vec<f64> = sides.collect();
            sides.iter().all(|s| *s > -0.5) || sides.iter().all(|s| *s < 0.5)
        };
        // its middle or a place of its edge
        let meets = |[x, y, r]: &[f64; 3]| {
            let edge = (0..16).map(|i| (f64::from(i) * std::f64::consts::TAU / 16.0).sin_cos());
            let mut places = edge.map(|(sin, cos)| [x + r * cos, y + r * sin]).chain([[*x, *y]]);
            places.any(|place| polygons.iter().any(|polygon| holds(polygon, &place)))
        };
        let alone: Vec<_> = circles.iter().filter(|circle| !meets(circle)).collect();
        assert!(alone.is_empty(), "{view}: {alone:?}");
    }
}

/// The largest of −∫F dx over the outputs of a run, J: of a belt's force on the body, and of the sphere in it in the vehicle.
fn work_on_belt(folder: &Path, run: &str, belt: &str, sphere: &str) -> f64 {
    let channels = format!("belt.{belt}.body_force.*,sphere.{sphere}.position.*");
    let output = answer(folder, &["export", run, "-f", "-o", "belt.csv", "--channel", &channels]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let csv = read(folder, "belt.csv");
    let mut lines = csv.lines();
    let headings: Vec<&str> = lines.next().expect("headings").split(',').collect();
    let place = |name: &str| headings.iter().position(|h| h.split('[').next() == Some(name)).expect("a column");
    let axes = |stem: &str| ["x", "y", "z"].map(|axis| place(&format!("{stem}.{axis}")));
    let (force, way) = (axes(&format!("belt.{belt}.body_force")), axes(&format!("sphere.{sphere}.position")));
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect()).collect();
    let (mut work_j, mut greatest_j) = (0.0_f64, 0.0);
    for pair in rows.windows(2) {
        let along = |(f, x): (&usize, &usize)| 0.5 * (pair[0][*f] + pair[1][*f]) * (pair[1][*x] - pair[0][*x]);
        work_j -= force.iter().zip(&way).map(along).sum::<f64>();
        greatest_j = work_j.max(greatest_j);
    }
    greatest_j
}

#[test]
fn three_runs_stand_abreast_with_ride_down_and_work() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let names = ["cart-unbelted", "cart-lap", "cart-lap-torso"];
    for name in names {
        let file = format!("{name}.toml");
        fs::copy(scenarios.join(&file), folder.path().join(&file)).expect("a copy");
    }
    let words = ["run", "cart-unbelted.toml", "cart-lap.toml", "cart-lap-torso.toml", "-o", "abreast.html"];
    let output = answer(folder.path(), &words);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let page = read(folder.path(), "abreast.html");
    let (_, data) = page.split_once("id=\"report-data\"").expect("data");
    let json = data.split_once('>').and_then(|(_, rest)| rest.split_once("</script>")).expect("an element").0;
    let report: serde_json::Value = serde_json::from_str(json).expect("JSON");
    let runs = report["runs"].as_array().expect("runs");
    assert_eq!(runs.len(), 3);
    let value = |run: usize, name: &str| {
        let rows = runs[run]["measures"].as_array().expect("measures");
        rows.iter().find(|row| row["name"] == name).and_then(|row| row["value"].as_f64())
    };
    let shares = [0, 1, 2].map(|run| value(run, "Kinetic energy ridden down").expect("a share"));
    // measured: 16.2, 16.9, 25.4 %
    assert!(shares[0] < shares[1] && shares[1] < shares[2] && shares[2] < 100.0, "{shares:?}");
    let chest = [0, 2].map(|run| value(run, "chest, ride-down distance").expect("a distance"));
    // measured: 0.12 and 2.94 in
    assert!(chest[0] < 0.5 && chest[1] > 2.5, "{chest:?}");
    assert_eq!(value(0, "Energy absorbed by belt lap"), None);
    assert!(value(1, "Energy absorbed by belt lap").expect("work") > 0.0);
    assert!(value(2, "Energy absorbed by belt torso").expect("work") > 0.0);
    assert!(value(0, "Energy absorbed by panel_lower_face").expect("work") > 0.0);
    // by themselves: what the body does on a belt is its force along the way of the sphere that it goes round
    for (belt, sphere) in [("lap", "pelvis"), ("torso", "chest")] {
        let own = value(2, &format!("Energy absorbed by belt {belt}")).expect("work");
        let j_per_in_lbf = 0.112_984_829;
        let work = work_on_belt(folder.path(), "cart-lap-torso.mcap", belt, sphere) / j_per_in_lbf;
        // measured: 371.3 for 371.9, 6706.9 for 6707.6 in·lbf
        assert!((own - work).abs() < 0.005 * work, "{belt}: {own} for {work}");
    }
    // the same of results, and not of five
    let all = ["report", "cart-unbelted.mcap", "cart-lap.mcap", "cart-lap-torso.mcap", "-o", "again.html"];
    assert_eq!(code(&answer(folder.path(), &all)), 0);
    let lap = "cart-lap.mcap";
    assert_eq!(code(&answer(folder.path(), &["report", lap, lap, lap, lap, "--against", lap])), 2);
    let bad = ["run", "cart-lap.toml", "cart-unbelted.toml", "-o", "x.mcap"];
    let output = answer(folder.path(), &bad);
    assert!(code(&output) == 2 && err(&output).contains("FILE.html"), "{}", err(&output));
}

#[test]
fn titles_say_what_was_changed() {
    let folder = folder_with_run();
    let words = ["run", "case.toml", "-q", "-f", "-o", "c.mcap", "--set", "belts.torso=null", "--set", "gravity=9.8"];
    let output = answer(folder.path(), &words);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let told = "with belts.torso = null and gravity = 9.8";
    for words in [&["report", "c.mcap", "-o", "c.html"][..], &["plot", "c.mcap", "-o", "c.svg"]] {
        assert_eq!(code(&answer(folder.path(), words)), 0);
        assert!(read(folder.path(), words[3]).contains(told), "{words:?}");
    }
    let own = ["run", "case.toml", "--no-mcap", "--set", "title=\"Mine\"", "--set", "gravity=9.8", "--json"];
    let output = answer(folder.path(), &own);
    assert!(String::from_utf8_lossy(&output.stdout).contains("\"title\": \"Mine\""));
}
