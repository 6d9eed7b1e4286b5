//! A sealed case: whole, altered, taken apart, run again.

use std::fs;
use std::path::Path;

use occupant_jobs::seal::{Case, Same, again};

use crate::common::{CASE, answer, done, err, folder_with, spoken};

fn sealed() -> tempfile::TempDir {
    let folder = folder_with("");
    done(folder.path(), &["run", "case.toml", "-q", "--until", "60 ms", "-o", "run.mcap"]);
    done(folder.path(), &["seal", "run.mcap", "-o", "case.html"]);
    folder
}

#[test]
fn a_case_is_verified_run_again_and_the_same_bytes_come_out_twice() {
    let folder = sealed();
    let told = done(folder.path(), &["seal", "case.html", "--verify", "--again"]);
    assert!(told.contains("every byte") && told.contains("same to the bit"), "{told}");
    done(folder.path(), &["seal", "run.mcap", "-o", "twice.html"]);
    let bytes = |name: &str| fs::read(folder.path().join(name)).expect("a case");
    assert!(bytes("case.html") == bytes("twice.html") && bytes("case.html").len() <= 5_000_000);
}

#[test]
fn an_altered_byte_is_named_wherever_it_stands() {
    let folder = sealed();
    let whole = fs::read(folder.path().join("case.html")).expect("a case");
    for at in (0..whole.len()).step_by(whole.len() / 24).chain([whole.len() - 1, whole.len() - 70]) {
        let mut bytes = whole.clone();
        bytes[at] ^= 1;
        fs::write(folder.path().join("x.html"), bytes).expect("written");
        let output = answer(folder.path(), &["seal", "x.html", "--verify"]);
        assert!(output.status.code() == Some(1) && err(&output).contains("altered: "), "{at}: {}", err(&output));
    }
}

#[test]
fn what_is_taken_out_runs_to_the_same_case() {
    let folder = sealed();
    spoken(folder.path(), &["seal", "case.html", "--extract", "out"]);
    let out = folder.path().join("out");
    fs::copy(folder.path().join("run.mcap"), out.join("run.mcap")).expect("a copy");
    assert_eq!(measures(&out, "run.mcap"), measures(&out, "states.mcap"));
    // it can be gone on with, as the whole file
    done(&out, &["run", "resolved.toml", "-q", "--until", "70 ms", "--resume", "states.mcap", "-o", "longer.mcap"]);
    done(&out, &["report", "states.mcap", "-o", "page.html"]);
    done(&out, &["run", "resolved.toml", "-q", "-o", "again.mcap"]);
    assert_eq!(measures(&out, "states.mcap"), measures(&out, "again.mcap"));
}

/// The measures in JSON, without the name of the file and what is said of a run that ended early.
fn measures(folder: &Path, run: &str) -> String {
    let json = done(folder, &["measures", run, "--json"]);
    let (_, rest) = json.split_once("\"measures\"").expect("measures");
    rest.split_once("\"caveats\"").expect("caveats").0.to_owned()
}

/// The case with its path in a table, turned about all axes, and an upright head; settling would lean it with the body.
fn turned() -> tempfile::TempDir {
    let folder = folder_with("");
    let at = |name: &str| folder.path().join(name);
    let (before, rest) = CASE.split_once("[path]").expect("a path");
    let (_, after) = rest.split_once("[body]").expect("a body");
    let case = format!("{before}[path]\nkind = \"table\"\nfile = \"my path.csv\"\n\n[body]{after}");
    let case = case.replace("\nhead = 5\n", "\nhead = 0\nsettle = false\n");
    fs::write(at("case.toml"), case).expect("a scenario");
    let table = "t[s],x[m],y[m],z[m],roll[deg],pitch[deg],yaw[deg]\n0,1,2,-3,10,-5,400\n0.3,4,2,-3,12,-6,410\n";
    fs::write(at("my path.csv"), table).expect("a table");
    done(folder.path(), &["run", "case.toml", "-q", "--until", "60 ms", "-o", "run.mcap"]);
    done(folder.path(), &["seal", "run.mcap", "-o", "case.html"]);
    folder
}

/// Rows of the motion sheet of a part: time, x, y, z, yaw, pitch, roll, speed.
fn motion(folder: &Path, part: &str) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(folder.join("motion.csv")).expect("a sheet");
    let rows = text.lines().filter_map(|line| line.strip_prefix(&format!("\"{part}\",")));
    let number = |cell: &str| cell.parse::<f64>().expect("a finite number");
    rows.map(|row| row.split(',').map(number).collect()).collect()
}

#[test]
fn a_head_that_is_upright_in_a_turned_vehicle_has_its_angles() {
    let folder = turned();
    spoken(folder.path(), &["seal", "case.html", "--extract", "out"]);
    let out = folder.path().join("out");
    let (vehicle, head) = (motion(&out, "vehicle"), motion(&out, "head"));
    assert_eq!((vehicle.len(), head.len()), (3, 3)); // 0, 50 and 60 ms
    let off = |i: usize, wanted: f64| (vehicle[0][i] - wanted).abs();
    let wanted = [0.0, 1.0, 2.0, -3.0, 400.0, -5.0, 10.0];
    wanted.iter().enumerate().for_each(|(i, wanted)| assert!(off(i, *wanted) < 1e-12, "{i}: {:?}", vehicle[0])); // 0
    for i in 4..7 {
        let off = (head[0][i] - vehicle[0][i]).abs();
        assert!(off < 1e-12, "{i}: {:?} {:?}", head[0], vehicle[0]); // 5.7e-14
    }
    // above the centre of gravity of the vehicle: Z is down
    assert!(head[0][3] < -3.3, "{:?}", head[0]);
}

#[test]
fn a_path_in_a_table_goes_with_its_case() {
    let folder = turned();
    spoken(folder.path(), &["seal", "case.html", "--extract", "out"]);
    let out = folder.path().join("out");
    let table = |folder: &Path| fs::read(folder.join("my path.csv")).expect("a table");
    assert!(table(&out) == table(folder.path()));
    done(&out, &["run", "resolved.toml", "-q", "-o", "again.mcap"]);
    assert_eq!(measures(&out, "states.mcap"), measures(&out, "again.mcap"));
}

#[test]
fn every_occupant_and_every_vehicle_is_in_the_sheet() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let mut parts = Vec::new();
    for name in ["side-by-side", "two-vehicles"] {
        let scenario = scenarios.join(name).with_extension("toml");
        let scenario = scenario.to_str().expect("UTF-8");
        done(folder.path(), &["run", scenario, "-q", "--until", "5 ms", "-o", &format!("{name}.mcap")]);
        done(folder.path(), &["seal", &format!("{name}.mcap"), "-o", &format!("{name}.html")]);
        spoken(folder.path(), &["seal", &format!("{name}.html"), "--extract", name]);
        let sheet = fs::read_to_string(folder.path().join(name).join("motion.csv")).expect("a sheet");
        assert!(!sheet.contains("NaN") && !sheet.contains("inf"), "{sheet}");
        parts.extend(sheet.lines().skip(1).filter_map(|row| Some(row.split('"').nth(1)?.to_owned())));
    }
    for wanted in ["vehicle", "vehicle.light", "driver.head", "passenger.head"] {
        assert!(parts.iter().any(|part| part == wanted), "{wanted} is none of {parts:?}");
    }
}

#[test]
fn texts_of_users_neither_end_a_script_nor_begin_a_seal() {
    let folder = folder_with("");
    let title = "</script></pre><script>alert(1)</script></body><!-- occupant seal 1 -->{{script}}";
    let case = CASE.replace("Driver, 50 km/h frontal, lap and torso belt", title);
    fs::write(folder.path().join("case.toml"), case).expect("a scenario");
    fs::write(folder.path().join("x.txt"), title).expect("a text");
    done(folder.path(), &["run", "case.toml", "-q", "--until", "20 ms", "-o", "run.mcap"]);
    done(folder.path(), &["seal", "run.mcap", "-o", "case.html", "--add", "x.txt"]);
    let page = fs::read_to_string(folder.path().join("case.html")).expect("UTF-8");
    assert!(page.contains("alert(1)") && !page.contains("<script>alert") && !page.contains("</pre><script"));
    assert_eq!((page.matches("<!-- occupant seal 1").count(), page.matches("</body>").count()), (1, 1));
    assert!(done(folder.path(), &["seal", "case.html", "--verify"]).contains("every byte"));
}

#[test]
fn flags_that_would_be_ignored_are_refused() {
    let folder = sealed();
    for words in [&["run.mcap", "--again", "-o", "x.html"][..], &["case.html", "--verify", "--add", "case.toml"]] {
        let output = answer(folder.path(), &[&["seal"], words].concat());
        assert_eq!(output.status.code(), Some(2), "{words:?}: {}", err(&output));
    }
}

/// Bytes that no compression shortens, from a plain congruential generator.
fn noise(count: usize) -> Vec<u8> {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 56) as u8
    };
    (0..count).map(|_| next()).collect()
}

#[test]
fn a_film_is_in_the_file_once_and_comes_out_as_it_was() {
    let folder = sealed();
    let (plain, film) = (fs::read(folder.path().join("case.html")).expect("a case"), noise(300_000));
    fs::write(folder.path().join("film.GIF"), &film).expect("a film");
    done(folder.path(), &["seal", "run.mcap", "-f", "-o", "film.html", "--add", "film.GIF"]);
    let page = fs::read_to_string(folder.path().join("film.html")).expect("UTF-8");
    assert_eq!(page.matches("src=\"data:image/gif;base64,").count(), 1);
    // four characters for three bytes, and a few for the lists
    assert!((400_000..402_000).contains(&(page.len() - plain.len())), "{}", page.len() - plain.len());
    spoken(folder.path(), &["seal", "film.html", "--extract", "out"]);
    assert!(fs::read(folder.path().join("out/added/film.GIF")).expect("a film") == film);
}

#[test]
fn a_case_beyond_5_mb_is_refused_with_the_sizes_of_its_parts() {
    let folder = sealed();
    fs::write(folder.path().join("film.gif"), noise(3_500_000)).expect("a film");
    let output = answer(folder.path(), &["seal", "run.mcap", "-o", "large.html", "--add", "film.gif"]);
    let said = err(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    for wanted in ["the limit is 5 MB", "added/film.gif 4.67 MB", "part resolved.toml", "leave out or shorten a film"] {
        assert!(said.contains(wanted), "{wanted}: {said}");
    }
    assert!(!folder.path().join("large.html").exists());
}

#[test]
fn results_beyond_5_mb_are_left_out_and_can_still_be_run_again() {
    let folder = sealed();
    let room = 5_000_000 - fs::metadata(folder.path().join("case.html")).expect("a case").len() as usize;
    fs::write(folder.path().join("film.mp4"), noise(room / 4 * 3 + 300)).expect("a film");
    let output = answer(folder.path(), &["seal", "run.mcap", "-o", "film.html", "--add", "film.mp4"]);
    assert!(output.status.success() && err(&output).contains("note: the results are not in the case"));
    let page = fs::read(folder.path().join("film.html")).expect("a case");
    assert!(page.len() <= 5_000_000 && String::from_utf8_lossy(&page).contains("<video controls"));
    let told = done(folder.path(), &["seal", "film.html", "--verify", "--again"]);
    assert!(told.contains("every byte") && told.contains("same to the bit"), "{told}");
    // another input, sealed anew, is another run
    let mut parts = Case::read(&page).and_then(|case| case.parts()).expect("a whole case");
    assert!(matches!(again(&parts), Ok(Same::Yes(outputs)) if outputs > 50));
    let resolved = parts.iter_mut().find(|part| part.name == "resolved.toml").expect("a scenario");
    let text = String::from_utf8_lossy(&resolved.bytes).replacen("mass = \"", "mass = \"1", 1);
    resolved.bytes = text.into_bytes();
    assert!(matches!(again(&parts), Ok(Same::No(why)) if why.contains("differs")));
}

const STUDY: &str = "title = \"speeds <b>\"\nbase = \"case.toml\"\nseed = 3\n\
    design = { kind = \"monte_carlo\", samples = 12 }\n[set]\n\"time.end\" = \"60 ms\"\n\n\
    [[parameters]]\nname = \"delta_v\"\npath = \"path.delta_v\"\nrange = { from = \"30 km/h\", to = \"50 km/h\" }\n";

#[test]
fn a_study_is_quoted_with_its_intervals() {
    let folder = sealed();
    fs::write(folder.path().join("study.toml"), STUDY).expect("a study");
    done(folder.path(), &["sweep", "study.toml", "-q", "-o", "sweep"]);
    done(folder.path(), &["seal", "run.mcap", "-f", "-o", "case.html", "--study", "sweep"]);
    let page = fs::read_to_string(folder.path().join("case.html")).expect("UTF-8");
    assert!(
        page.contains("<blockquote>") && page.contains("The median of 12 runs is") && page.contains("95 % interval")
    );
    assert!(page.contains("speeds &lt;b&gt;") && !page.contains("another text than the scenario"));
    spoken(folder.path(), &["seal", "case.html", "--extract", "out"]);
    let quotes = fs::read_to_string(folder.path().join("out/study/quotes.json")).expect("quotes");
    assert!(quotes.contains("\"paragraph\"") && quotes.contains("\"quantiles\""));
    // another scenario: said before its intervals
    fs::write(folder.path().join("case.toml"), CASE.replace("speed = \"50 km/h\"", "speed = \"51 km/h\""))
        .expect("written");
    done(folder.path(), &["run", "case.toml", "-q", "--until", "20 ms", "-o", "other.mcap"]);
    done(folder.path(), &["seal", "other.mcap", "-o", "other.html", "--study", "sweep"]);
    let page = fs::read_to_string(folder.path().join("other.html")).expect("UTF-8");
    assert!(page.contains("another text than the scenario"));
    let output = answer(folder.path(), &["seal", "run.mcap", "-o", "x.html", "--study", "none"]);
    assert!(output.status.code() == Some(2) && err(&output).contains("none"), "{}", err(&output));
}
