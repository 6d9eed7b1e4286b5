//! `occupant print` as sentences. Recorded numbers are decoded by the schemas in the file, not by the printer's tables.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use occupant_core::forces::contact::PASSED;
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_scenario::{Format, Scenario};
use prost_reflect::{DescriptorPool, DynamicMessage, ReflectMessage, Value};

/// Lap and torso belt, spheres that touch, in SI.
const SCENARIO: &str = include_str!("recording/short.toml");

fn occupant(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(assert_cmd::cargo::cargo_bin!("occupant"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("runs");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
}

/// A folder with `short.toml` and its `short.mcap`.
fn recorded() -> tempfile::TempDir {
    recorded_of(SCENARIO)
}

fn recorded_of(scenario: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("short.toml"), scenario).expect("written");
    let (code, _, said) = occupant(folder.path(), &["run", "short.toml", "-q"]);
    assert_eq!(code, 0, "{said}");
    folder
}

fn printed(folder: &Path, arguments: &[&str]) -> String {
    let (code, out, said) = occupant(folder, &[&["print"], arguments].concat());
    assert_eq!(code, 0, "{said}");
    out
}

fn pages(text: &str) -> Vec<&str> {
    assert!(text.ends_with('\u{c}'), "the last page has no form feed");
    text.split_terminator('\u{c}').collect()
}

/// The numbers of the row `name` in the table below `title` on the pages of output `output`.
fn row(text: &str, output: usize, title: &str, name: &str) -> Vec<f64> {
    let section = format!("OUTPUT {output}");
    let of_output = |p: &&&str| p.lines().nth(2).is_some_and(|l| l.ends_with(&section));
    let all = pages(text);
    let lines: Vec<&str> = all.iter().filter(of_output).flat_map(|p| p.lines()).collect();
    let from = lines.iter().position(|l| l.starts_with(title));
    let from = from.unwrap_or_else(|| panic!("no table {title} of output {output}"));
    let found = lines[from..].iter().find(|l| l.split_whitespace().any(|w| w == name));
    let words = found.unwrap_or_else(|| panic!("no row {name}")).split_whitespace();
    let after = words.skip_while(|w| *w != name);
    after.skip(1).map_while(|w| w.parse().ok()).collect()
}

/// The numbers below the heads of the energies of output `output`.
fn energies(text: &str, output: usize) -> Vec<f64> {
    let section = format!("OUTPUT {output}");
    let of_output = |p: &&&str| p.lines().nth(2).is_some_and(|l| l.ends_with(&section));
    let all = pages(text);
    let mut lines = all.iter().filter(of_output).flat_map(|p| p.lines()).skip_while(|l| !l.starts_with("ENERGY"));
    let numbers = lines.nth(2).expect("a row").split_whitespace();
    numbers.map(|word| word.parse().expect("a number")).collect()
}

/// A vector or a number of a recorded message.
fn value(folder: &Path, topic: &str, output: usize, field: &str) -> Vec<f64> {
    let bytes = fs::read(folder.join("short.mcap")).expect("recorded");
    let stream = mcap::MessageStream::new(&bytes).expect("an MCAP file");
    let own = stream.map(|m| m.expect("a message"));
    let message = own.filter(|m| m.channel.topic == topic).nth(output).expect("an output");
    let schema = message.channel.schema.as_ref().expect("a schema");
    let pool = DescriptorPool::decode(schema.data.as_ref()).expect("descriptors");
    let kind = pool.get_message_by_name(&schema.name).expect("its type");
    let content = DynamicMessage::decode(kind, message.data.as_ref()).expect("its content");
    match content.get_field_by_name(field).expect("the field").as_ref() {
        Value::F64(number) => vec![*number],
        Value::Message(vector) => {
            vector.descriptor().fields().map(|f| vector.get_field(&f).as_f64().expect("a number")).collect()
        }
        other => panic!("{other:?}"),
    }
}

/// Equal to the digits printed: half a unit of the last decimal.
fn assert_printed(printed: &[f64], recorded: &[f64], unit: f64, decimals: i32) {
    assert!(printed.len() >= recorded.len(), "{printed:?} {recorded:?}");
    for (p, r) in printed.iter().zip(recorded) {
        let off = (p - r / unit).abs();
        // small numbers have an exponent and four digits
        let room = 0.5001 * 10_f64.powi(-decimals);
        assert!(off <= room, "{printed:?} {recorded:?}");
    }
}

#[test]
fn every_page_has_the_titles_its_number_and_at_most_60_lines_of_132_columns() {
    let folder = recorded();
    let text = printed(folder.path(), &["short.mcap", "--interval", "10 ms"]);
    let pages = pages(&text);
    // five pages of echo at least, two a print time (0, 10, 20, 30 and the last, 39.5 ms), the last sheet
    assert!(pages.len() > 5 + 2 * 5, "{} pages", pages.len());
    for (i, page) in pages.iter().enumerate() {
        let lines: Vec<&str> = page.lines().collect();
        assert!(lines.len() <= 60, "page {} has {} lines", i + 1, lines.len());
        assert!(lines[0].starts_with("Short"), "{}", lines[0]);
        assert!(lines[0].ends_with(&format!("PAGE {:>4}", i + 1)), "{}", lines[0]);
        assert!(lines[1].starts_with("short.toml, occupant "), "{}", lines[1]);
        for line in lines {
            assert!(line.chars().count() <= 132, "{line}");
        }
    }
}

#[test]
fn the_echo_lists_solids_where_there_are_any() {
    let solid = "[solids]\nbar = { kind = \"capsule\", material = \"seat\", ends = [[0.6, 0, 0.1], [0.6, 0.5, 0.1]], \
        radius = 0.05 }\n";
    let folder = recorded_of(&format!("{SCENARIO}\n{solid}"));
    let text = printed(folder.path(), &["short.mcap", "--interval", "1"]);
    let line = text.lines().find(|line| line.starts_with(" 5 bar ")).expect("a line");
    for words in ["VEHICLE", "seat", "CAPSULE, RADIUS 0.0500", "0.6000"] {
        assert!(line.contains(words), "{line}");
    }
    assert!(!printed(recorded().path(), &["short.mcap", "--interval", "1"]).contains("SOLIDS"));
}

#[test]
fn the_echo_says_what_was_read_and_computed() {
    let folder = recorded();
    let text = printed(folder.path(), &["short.mcap", "--interval", "1"]);
    for words in [
        "RUNGE-KUTTA, FOURTH ORDER, STEP 0.00025 SEC",
        "TITLE          Short",
        "BODY male50-1970: SEGMENTS",
        "12  right_lower_leg",
        "17  left_foot",
        "11  left_knee",
        " 1 Front cushion",
        " 4 steering_wheel",
        "HALF SINE, DELTA-V 9.000 M/S, FROM 0.000000 TO 0.020000 SEC",
        "CUSHION         1 Front cushion",
        "\n\nCOMPUTED\nPELVIS         CENTER AT (",
        "GENERALIZED COORDINATES AT THE START",
        "SLACK 0.0050",
    ] {
        assert!(text.contains(words), "{words}\n{text}");
    }
    assert!(!text.contains("DIFFERS"), "the rebuilt model is the one that ran");
}

#[test]
fn printed_numbers_are_the_recorded_ones() {
    let folder = recorded();
    let text = printed(folder.path(), &["short.mcap"]);
    let of = |topic: &str, output, field: &str| value(folder.path(), topic, output, field);
    for output in [0, 17, 40] {
        let head = "/occupant/segment/head";
        let cells = row(&text, output, "1. END POINTS", "head");
        assert_printed(&cells, &of(head, output, "upper_end_vehicle_m"), 1.0, 4);
        assert_printed(&cells[3..], &of(head, output, "lower_end_vehicle_m"), 1.0, 4);
        let cells = row(&text, output, "2. ACCELERATION", "head");
        let total = of(head, output, "cg_acceleration_segment_m_s2");
        assert_printed(&cells, &total, 1.0, 2);
        let reads = of(head, output, "accelerometer_segment_m_s2");
        assert_printed(&cells[4..], &reads, 9.80665, 3);
        let cells = row(&text, output, "3, 4. ANGULAR", "head");
        let turn = of(head, output, "angular_acceleration_segment_rad_s2");
        assert_printed(&cells, &turn, 1.0, 2);
        let turn = of(head, output, "angular_velocity_segment_rad_s");
        assert_printed(&cells[3..], &turn, 1.0, 3);
        let stored = ["kinetic_j", "kinetic_relative_j", "gravity_j", "spine_j", "contacts_j", "belts_j"];
        let stored: Vec<f64> = stored.iter().flat_map(|field| of("/energy", output, field)).collect();
        assert_printed(&energies(&text, output), &stored, 1.0, 2);
        let cells = row(&text, output, "5. FORCE", "pelvis");
        let force = of("/occupant/sphere/pelvis", output, "contact_force_vehicle_n");
        assert_printed(&cells, &force, 1.0, 1);
        let cells = row(&text, output, "7. RESTRAINING", "lap");
        assert!(cells.is_empty(), "the belt's row names its sphere");
        let cells = row(&text, output, "7. RESTRAINING", "chest");
        let pull = of("/belt/torso", output, "loop_force_n");
        assert_printed(&cells, &pull, 1.0, 1);
        let force = of("/belt/torso", output, "restraining_force_vehicle_n");
        assert_printed(&cells[1..], &force, 1.0, 1);
    }
    let force = of("/occupant/sphere/pelvis", 17, "contact_force_resultant_n");
    assert!(force[0] > 100.0, "the pelvis sits: {force:?}");
}

#[test]
fn inches_and_pounds_come_with_the_scenario_or_on_request() {
    let folder = recorded();
    let text = printed(folder.path(), &["short.mcap", "--units", "in-lbf-s", "--interval", "1"]);
    assert!(text.contains("VEHICLE COORDINATES (IN)"));
    let cells = row(&text, 0, "1. END POINTS", "head");
    let end = value(folder.path(), "/occupant/segment/head", 0, "upper_end_vehicle_m");
    assert_printed(&cells, &end, 0.0254, 3);
    let cells = row(&text, 0, "5. FORCE", "pelvis");
    let force = value(folder.path(), "/occupant/sphere/pelvis", 0, "contact_force_vehicle_n");
    assert_printed(&cells, &force, 4.448_221_615_260_5, 2);
}

#[test]
fn the_last_sheet_lists_the_passed_pairs_of_the_run() {
    let folder = recorded();
    let text = printed(folder.path(), &["short.mcap", "--interval", "1"]);
    let pages = pages(&text);
    let last = pages.last().expect("a page");
    for words in [
        "THE RUN REACHED ITS END TIME",
        "PAIRS WITH NARRY(J,K) = 0",
        "GENERALIZED COORDINATES AT THE END",
        "END OF PRINTOUT",
    ] {
        assert!(last.contains(words), "{words}\n{last}");
    }
    assert!(!last.contains("PARTIAL"), "{last}");
    let (pairs, q1) = last_state();
    assert!(!pairs.is_empty(), "a scenario without passed pairs");
    let list = last.lines().skip_while(|l| !l.starts_with("PAIRS WITH NARRY"));
    let rows = list.skip(2).take_while(|l| !l.is_empty());
    let words: Vec<&str> = rows.flat_map(str::split_whitespace).collect();
    let count = words.iter().filter(|w| w.parse::<u32>().is_ok()).count();
    assert_eq!(count, 2 * pairs.len(), "{last}");
    for (sphere, surface) in pairs {
        assert!(words.join(" ").contains(&format!("{sphere} {surface}")), "{last}");
    }
    assert!(last.contains(&format!("{q1:.6}")), "{q1}: {last}");
}

/// Pairs (sphere number and name, surface number and name) that the run has passed at its end, and q1, by running it.
fn last_state() -> (Vec<(String, String)>, f64) {
    let no_files = |name: &str| Err(format!("{name}: no files"));
    let loaded = Scenario::from_text(SCENARIO, Format::Toml, "short.toml", &no_files);
    let (model, _) = loaded.expect("loads").model().expect("a model");
    let (mut passed, mut q1) = (Vec::new(), f64::NAN);
    let watch = Watch(|sample: &Sample<'_>| {
        passed.clear();
        q1 = sample.report_coordinates().unwrap().q[0];
        let contacts = &model.system().forces.contacts;
        for group in &contacts.groups {
            for at in group.pairs.clone() {
                if sample.history.memory.contacts[at].phase == PASSED {
                    for part in &contacts.pairs[at].parts {
                        passed.push((group.sphere, part.surface));
                    }
                }
            }
        }
    });
    simulate(&model, watch).expect("runs");
    let names = |(sphere, surface): (usize, usize)| {
        let sphere_name = &model.body().spheres[sphere].name;
        let surface_name = &model.setup().surfaces[surface].name;
        (format!("{} {sphere_name}", sphere + 1), format!("{} {surface_name}", surface + 1))
    };
    (passed.into_iter().map(names).collect(), q1)
}

#[test]
fn a_deck_is_printed_in_inches_with_its_cards_numbers_and_both_titles() {
    let folder = tempfile::tempdir().expect("a folder");
    let decks = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/decks");
    let deck = decks.join("driver-lap-torso.toml");
    let deck = deck.to_str().expect("UTF-8");
    let run = ["run", deck, "-q", "--set", "time.end='20 ms'", "-o", "d.mcap"];
    let (code, _, said) = occupant(folder.path(), &run);
    assert_eq!(code, 0, "{said}");
    let text = printed(folder.path(), &["d.mcap"]);
    for page in pages(&text) {
        let mut lines = page.lines();
        let title = lines.next().expect("a title");
        assert!(title.starts_with("DRIVER WITH LAP AND TORSO BELT, 20 MPH"), "{title}");
        assert_eq!(lines.next(), Some("COMPARTMENT AND BODY COMPOSED FROM PUBLISHED FIGURES"));
    }
    let punched = fs::read(decks.join("driver-lap-torso.dat")).expect("a deck");
    let cards = cardio_legacy::Deck::parse(punched, &Default::default()).0[0].write();
    let listed: Vec<&str> = text.lines().collect();
    for card in cards.lines() {
        // the final time was changed
        let card = card.replacen("        0.       0.2    0.0001", "        0.      0.02    0.0001", 1);
        assert!(listed.contains(&card.as_str()), "{card}");
    }
    assert!(text.contains("GRAVITY        386.04 IN/S2"), "as on the card");
    assert!(text.contains("CHANGED BY     --set time.end='20 ms'"));
    assert!(text.contains("END            0.02 SEC"), "the change is in the echo");
    assert!(text.contains("SURFACE NUMBERS ARE THOSE OF THE CARDS"));
    assert!(text.contains("25 steering_wheel"));
    assert!(!text.contains("DIFFERS"), "the rebuilt model is the one that ran");
    assert!(text.contains("PAIRS WITH NARRY(J,K) = 0: "));
}

#[test]
fn an_exact_state_is_echoed_with_the_digits_of_its_cards() {
    let folder = tempfile::tempdir().expect("a folder");
    let decks = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/decks");
    let text = fs::read_to_string(decks.join("driver-exact-state.toml")).expect("committed");
    let text = text.replacen("-5.283158, 14", "-5.28315849, 14", 1).replacen("\"36.4436 in\"", "\"36.44361 in\"", 1);
    fs::write(folder.path().join("short.toml"), text).expect("written");
    let run = ["run", "short.toml", "-q", "--until", "0.002"];
    let (code, _, said) = occupant(folder.path(), &run);
    assert_eq!(code, 0, "{said}");
    let text = printed(folder.path(), &["short.mcap", "--interval", "1"]);
    let start = text.split("GENERALIZED COORDINATES AT THE START").nth(1).expect("coordinates");
    for digits in ["-5.28315849", "-0.261799", "-0.349066"] {
        assert!(start.lines().take(14).any(|line| line.contains(digits)), "{digits}: {start}");
    }
    assert!(text.contains("lap: UNSTRETCHED LENGTH 36.44361 IN"), "{text}");
    assert!(text.contains("UNSTRETCHED LENGTH OF THE BELT lap: 36.443610 IN"));
}

#[test]
fn print_times_that_are_no_outputs_are_said_to_be_uneven() {
    let folder = recorded();
    let said =
        |every: &str| occupant(folder.path(), &["print", "short.mcap", "-o", "p.txt", "-f", "--interval", every]).2;
    assert_eq!(said("2 ms"), "wrote p.txt\n");
    assert!(said("2.5 ms").contains("note: the print interval, 0.0025 s, is no multiple"), "{}", said("2.5 ms"));
}

#[test]
fn a_path_beside_the_scenario_travels_with_the_results() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenarios = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/roads");
    for name in ["side-slope.toml", "side-slope-path.csv"] {
        fs::copy(scenarios.join(name), folder.path().join(name)).expect("copied");
    }
    let run = ["run", "side-slope.toml", "-q", "--set", "time.end='20 ms'"];
    let (code, _, said) = occupant(folder.path(), &run);
    assert_eq!(code, 0, "{said}");
    // the file alone is enough
    fs::remove_file(folder.path().join("side-slope-path.csv")).expect("removed");
    let text = printed(folder.path(), &["side-slope.mcap", "--interval", "10 ms"]);
    assert!(text.contains("STATIONS, NATURAL SPLINES BETWEEN THEM"), "{text}");
    assert!(text.contains("PAIRS WITH NARRY(J,K) = 0: "));
}

#[test]
fn a_record_of_sensors_travels_with_the_results_and_is_printed_and_gone_on_with() {
    let folder = tempfile::tempdir().expect("a folder");
    let scenarios = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/roads");
    for name in ["side-slope-sensors.toml", "side-slope-sensors.csv"] {
        fs::copy(scenarios.join(name), folder.path().join(name)).expect("copied");
    }
    let scenario = "side-slope-sensors.toml";
    let (code, out, said) = occupant(folder.path(), &["check", scenario]);
    assert_eq!(code, 0, "{said}");
    assert!(out.contains("sensors"), "{out}");
    let run = ["run", scenario, "-q", "-o", "run.mcap", "--set", "time.end='20 ms'"];
    let (code, _, said) = occupant(folder.path(), &run);
    assert_eq!(code, 0, "{said}");
    fs::remove_file(folder.path().join("side-slope-sensors.csv")).expect("removed");
    let text = printed(folder.path(), &["run.mcap", "--interval", "10 ms"]);
    for words in [
        "RECORDED MOTION, INTEGRATED",
        "GRAVITY        IN THE ACCELERATIONS",
        "481 SAMPLES AS READ (A IN G, W IN DEG/SEC, DV IN IN/S)",
    ] {
        assert!(text.contains(words), "{words}");
    }
}

#[test]
fn a_file_that_was_cut_off_prints_what_it_has_and_says_so() {
    let folder = recorded_of(&SCENARIO.replace("interval = \"1 ms\"", "interval = \"0.25 ms\""));
    let whole = fs::read(folder.path().join("short.mcap")).expect("recorded");
    let cut = folder.path().join("cut.mcap");
    fs::write(&cut, &whole[..whole.len() * 6 / 10]).expect("written");
    let (code, out, said) = occupant(folder.path(), &["print", "cut.mcap", "--interval", "5 ms"]);
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("is partial"), "{said}");
    let all = pages(&out);
    let last = all.last().expect("a page");
    assert!(last.contains("*** PARTIAL: THE FILE WAS CUT OFF"), "{last}");
    assert!(last.contains("OF 0.029500 SEC"), "{last}");
    assert!(last.contains("PAIRS WITH NARRY(J,K) = 0: "), "{last}");
    let times = out.matches("    OUTPUT ").count();
    let whole = printed(folder.path(), &["short.mcap", "--interval", "5 ms"]);
    let all_times = whole.matches("    OUTPUT ").count();
    assert!(0 < times && times < all_times, "{times} of {all_times}");
}

#[test]
fn files_that_cannot_be_printed_are_refused_in_words() {
    let folder = tempfile::tempdir().expect("a folder");
    let refused = |arguments: &[&str], words: &str| {
        let (code, out, said) = occupant(folder.path(), &[&["print"], arguments].concat());
        assert_eq!((code, out.as_str()), (2, ""), "{said}");
        assert!(said.contains(words), "{said}");
    };
    refused(&["none.mcap"], "none.mcap cannot be read");
    fs::write(folder.path().join("deck.dat"), "not a result").expect("written");
    refused(&["deck.dat"], "it is not an MCAP file");
    let mut empty = mcap::Writer::new(std::io::Cursor::new(Vec::new())).expect("a file");
    empty.finish().expect("finished");
    let bytes = empty.into_inner().into_inner();
    fs::write(folder.path().join("other.mcap"), bytes).expect("written");
    refused(&["other.mcap"], "not a result of `occupant run`");
    refused(&["deck.dat", "--interval", "3 kg"], "not a time");
    refused(&["deck.dat", "--interval", "-1"], "--interval");
}

#[test]
fn an_interval_shorter_than_the_recorded_one_is_refused_and_files_are_kept() {
    let folder = recorded();
    let finer = ["print", "short.mcap", "--interval", "0.5 ms"];
    let (code, _, said) = occupant(folder.path(), &finer);
    assert_eq!(code, 2);
    assert!(said.contains("recorded every 0.001 s"), "{said}");
    let to_file = ["print", "short.mcap", "-o", "short.txt"];
    assert_eq!(occupant(folder.path(), &to_file).0, 0);
    let (code, _, said) = occupant(folder.path(), &to_file);
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("short.txt exists"), "{said}");
    let forced = [&to_file[..], &["--force"]].concat();
    assert_eq!(occupant(folder.path(), &forced).0, 0);
    let text = fs::read_to_string(folder.path().join("short.txt")).expect("written");
    assert_eq!(text, printed(folder.path(), &["short.mcap"]));
}

#[test]
fn any_body_and_every_occupant_and_vehicle_is_printed() {
    let scenarios = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/");
    for (file, words) in [
        ("sled-17-segments.toml", &["left_hand", "left_foot", "CARDS HAVE ROOM FOR THE REPORT'S BODY ALONE"][..]),
        (
            "../tests/data/hand/two-vehicles.toml",
            &["light.head", "heavy.lap", "VEHICLE LIGHT: POSITION", "TOTAL MASS", "VEHICLE LIGHT\n"][..],
        ),
        ("neck-pendulum.toml", &["head"][..]),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let scenario = format!("{scenarios}{file}");
        let (code, _, said) = occupant(folder.path(), &["run", &scenario, "-q", "-o", "run.mcap", "--until", "20 ms"]);
        assert_eq!(code, 0, "{file}: {said}");
        let text = printed(folder.path(), &["run.mcap", "--interval", "10 ms"]);
        for word in words {
            assert!(text.contains(word), "{file}: {word}");
        }
        for page in pages(&text) {
            assert!(
                page.lines().count() <= 60 && page.lines().all(|line| line.chars().count() <= 132),
                "{file}: {page}"
            );
        }
        assert!(!text.contains("NAN"), "{file}");
    }
}

#[test]
fn a_path_of_straight_lines_has_its_acceleration_in_print() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/decks/driver-lap-torso.dat");
    let (code, _, said) = occupant(folder.path(), &["run", deck, "-q", "-o", "run.mcap"]);
    assert_eq!(code, 0, "{said}");
    let text = printed(folder.path(), &["run.mcap", "--interval", "40 ms"]);
    let title = "FROM DIFFERENCES OF THE STATIONS";
    let at_40_ms = text.split("TIME 0.040000").nth(1).expect("a page");
    let line = at_40_ms.lines().find(|line| line.contains(title)).expect("a row");
    let x: f64 = line
        .split(title)
        .nth(1)
        .and_then(|rest| rest.split_whitespace().next())
        .and_then(|x| x.parse().ok())
        .expect("x");
    // 20 mph in a half sine of 0.08 s: 17.9 g at its middle
    assert!((x + 17.9).abs() < 0.3, "{line}");
}
