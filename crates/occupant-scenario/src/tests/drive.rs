//! `[drive]`: what it comes to, and what is wrong with it.

use std::time::Instant;

use super::{complaint, load, short_with};
use crate::{Draft, Drives, Format, Loaded};
use occupant_core::results::recorder::Watch;
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::simulate;
use occupant_core::vehicle::{PathCursor, VehiclePath};

/// The short scenario in a car that brakes in a straight line.
const BRAKES: &str = r#"kind = "drive"

[drive]
end = "2 s"
[drive.vehicles.car]
preset = "sedan"
start = { speed = "20 m/s" }
brake = { time = ["0.01 s", "0.05 s"], pedal = [0, 0.5] }

[drive.ground]
friction = 0.8
"#;

fn short(drive: &str) -> String {
    let pulse =
        "kind = \"pulse\"\nshape = \"half_sine\"\nspeed = \"30 km/h\"\ndelta_v = \"30 km/h\"\nduration = \"100 ms\"\n";
    short_with(pulse, drive)
}

fn driven(text: &str) -> Drives {
    load(text).unwrap_or_else(|e| panic!("{e}")).drives().unwrap_or_else(|e| panic!("{e}")).0.unwrap()
}

fn ditch() -> Loaded {
    let file = format!("{}/scenarios/ditch.toml", env!("CARGO_MANIFEST_DIR"));
    let draft = Draft::read(&std::fs::read_to_string(file).unwrap(), Format::Toml, "ditch.toml").unwrap();
    draft.load(&|name| Err(format!("no file {name}"))).unwrap_or_else(|e| panic!("{e}"))
}

/// Mass, centre of gravity and inertia carry the driver; the compartment stays where it is without him.
#[test]
fn the_load_is_that_of_the_people() {
    let drives = ditch().drives().unwrap().0.unwrap();
    let own = &drives.vehicles[0];
    let load_kg = own.car.mass_kg - own.unladen.mass_kg;
    // measured 79 kg of male50
    assert!((60.0..90.0).contains(&load_kg), "{load_kg}");
    // he sits a little behind and above the car's own centre of gravity
    assert!(own.origin_m.norm() > 1e-3 && own.origin_m.norm() < 0.05, "{:?}", own.origin_m);
    assert_eq!(own.origin_m.y, 0.0);
}

/// The drive has the same bits in threads, and six seconds of it take milliseconds.
#[test]
fn the_same_drive_has_the_same_bits_in_threads() {
    let loaded = ditch();
    let bits = || {
        let drives = loaded.drives().unwrap().0.unwrap();
        drives.outcome.rides[0].last().state.0.map(f64::to_bits)
    };
    let one = bits();
    let others: Vec<_> = std::thread::scope(|scope| {
        let started: Vec<_> = (0..3).map(|_| scope.spawn(bits)).collect();
        started.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(others.iter().all(|other| *other == one));
    let world = &loaded.drives().unwrap().0.unwrap().world;
    let begun = Instant::now();
    world.run(6.0).unwrap();
    // a bound against a change of order, not of speed: machines are shared
    assert!(begun.elapsed().as_secs_f64() < 2.0);
}

/// The occupant of a driven straight stop fares as in the table of its places.
#[test]
fn an_occupant_feels_the_drive_as_the_same_motion_told_otherwise() {
    let drives = driven(&short(BRAKES));
    let path = drives.path(0);
    let rows: Vec<String> = (0..=1000)
        .map(|i| {
            let t = f64::from(i) * 2e-4;
            let pose = path.attitude(t, &mut PathCursor::default());
            let (p, a) = (pose.position_m, pose.attitude);
            format!("[{t}, {}, {}, {}, {}, {}, {}]", p.x, p.y, p.z, a.roll_rad, a.pitch_rad, a.yaw_rad)
        })
        .collect();
    let columns = r#"["t[s]", "x[m]", "y[m]", "z[m]", "roll[rad]", "pitch[rad]", "yaw[rad]"]"#;
    let table = format!("kind = \"table\"\ncolumns = {columns}\nrows = [{}]\n", rows.join(",\n"));
    let ends = [short(BRAKES), short(&table)].map(|text| {
        let (model, _) = load(&text).unwrap().model().unwrap_or_else(|e| panic!("{e}"));
        let mut end = None;
        let watch = Watch(|sample: &Sample<'_>| end = Some(sample.state.t1()));
        simulate(&model, watch).unwrap();
        end.unwrap()
    });
    let gap = ends[0] - ends[1];
    let gap = (gap.x * gap.x + gap.y * gap.y + gap.z * gap.z).sqrt();
    // measured 5e-7; it falls with the interval, as the spline has no acceleration at its first time: 2.5e-6 m at 1 ms
    assert!(gap < 1e-6, "{gap}");
}

/// A path is the compartment's, not the laden centre of gravity's; its end is that of the drive.
#[test]
fn a_run_lies_within_the_drive() {
    let text = short(BRAKES).replace("end = \"2 s\"", "end = \"0.1 s\"");
    let found = match load(&text).and_then(|loaded| loaded.model()) {
        Ok(_) => String::new(),
        Err(problems) => problems.to_string(),
    };
    assert!(found.contains("a part of the drive, which lasts from 0 s to 0.1 s"), "{found}");
    let drives = driven(&short(BRAKES));
    assert!(matches!(drives.path(0), VehiclePath::Driven(_)));
}

/// He holds his speed against drag and rolling, and follows the speeds of a recorder.
#[test]
fn speeds_are_followed() {
    let hold = short(BRAKES)
        .replace("brake = { time = [\"0.01 s\", \"0.05 s\"], pedal = [0, 0.5] }", "hold_speed = \"20 m/s\"");
    let speed = |drives: &Drives| drives.outcome.rides[0].last().velocity_m_s.norm();
    let held = speed(&driven(&hold));
    // measured 19.9: rolling and drag over the time of the driver
    assert!((held - 20.0).abs() < 0.15, "{held}");
    let edr = hold.replace("hold_speed = \"20 m/s\"", "speed = { time = [0, 2], speed = [\"20 m/s\", \"12 m/s\"] }");
    let slowed = speed(&driven(&edr));
    assert!((slowed - 12.0).abs() < 0.3, "{slowed}");
}

/// Across a curb the right wheels start within it: the start is named.
#[test]
fn a_start_across_a_curb_is_refused() {
    let text = complaint(&short(&BRAKES.replace("friction = 0.8", "curbs = [{ right = 0.1, height = 0.15 }]")));
    for part in ["drive.vehicles.car.start", "its right front wheel is 0.17", "at most 0.055 m: move the start"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

/// A ditch by its slopes is the section of its corners: 3 m of shoulder, 1:4 down by 2 m, 3 m of bottom, 1:3 up by 3 m, level behind.
#[test]
fn a_ditch_is_the_section_of_its_slopes() {
    let ground = |keys: &str| driven(&short(&BRAKES.replace("friction = 0.8", keys))).world.ground.clone();
    let ditch = ground("ditch = { edge = 3, foreslope = 4, depth = 2, bottom = 3, backslope = 3, rise = 3 }");
    let section = ground("section = { right = [-2, 3, 11, 14, 23, 28], height = [0, 0, -2, -2, 1, 1] }");
    let bare = ground("ditch = { edge = 3, foreslope = 2, depth = 1 }");
    for right in [-50.0, 0.0, 4.0, 10.9, 12.0, 20.0, 60.0] {
        assert_eq!(ditch.height_m(0.0, right), section.height_m(0.0, right), "{right}");
        let expected = -((right - 3.0) / 2.0).clamp(0.0, 1.0);
        assert!((bare.height_m(0.0, right) - expected).abs() < 1e-12, "{right}");
    }
    let refused = short(&BRAKES.replace("friction = 0.8", "ditch = { edge = 3, foreslope = 0, depth = 2 }"));
    assert!(complaint(&refused).contains("out of range"));
    // a slope as height over length is steeper than any roadside
    for (slope, warns) in [("0.25", true), ("\"25 %\"", true), ("1", false), ("4", false)] {
        let ditch = format!("ditch = {{ edge = 3, foreslope = {slope}, depth = 2 }}");
        let loaded = load(&short(&BRAKES.replace("friction = 0.8", &ditch))).unwrap();
        let (_, warnings) = loaded.build().unwrap();
        let warnings = warnings.to_string();
        assert_eq!(warnings.contains("`foreslope = 4`"), warns, "{slope}: {warnings}");
    }
    let both = "ditch = { edge = 3, foreslope = 4, depth = 2 }\nsection = { right = [0, 1], height = [0, 0] }";
    assert!(!complaint(&short(&BRAKES.replace("friction = 0.8", both))).is_empty());
}

/// Ground along a line and from a grid is what the same cross-section along x is.
#[test]
fn a_line_and_a_grid_are_the_ground_they_describe() {
    // before the ramps, which begin at x = 0: across an edge no start is allowed
    let before = BRAKES.replace("start = { speed = \"20 m/s\" }", "start = { speed = \"20 m/s\", x = -60 }");
    let ground = |keys: &str| driven(&short(&before.replace("friction = 0.8", keys))).world.ground.clone();
    let ditch = "ditch = { edge = 3, foreslope = 4, depth = 2 }\ngrade = 0.02\n";
    let section = ground(ditch);
    let line = "line = { points = [[0, 0], [200, 0], [200, 200]], radius = 60 }\n";
    let road = ground(&format!("{ditch}{line}zones = [{{ name = \"soil\", right = [3, 20], friction = 0.5 }}]"));
    for (x, y) in [(-5.0, 1.0), (10.0, 5.0), (100.0, 12.0)] {
        assert!((road.height_m(x, y) - section.height_m(x, y)).abs() < 1e-9, "{x} {y}");
        assert_eq!(road.zone(x, y).is_some(), y >= 3.0);
    }
    // behind the bend the road runs along y, its right is at smaller x
    assert!(road.zone(195.0, 150.0).is_some() && road.zone(205.0, 150.0).is_none());
    let widening =
        "sections = [\n{ at = 0, right = [-5, 5], height = [0, 0] },\n{ at = 10, right = [-5, 5], height = [1, 0] }]";
    let widening = ground(widening);
    assert!((widening.height_m(5.0, -5.0) - 0.5).abs() < 1e-9 && widening.height_m(20.0, -5.0) == 1.0);
    let inline = ground("grid = { from = [0, -4], step = [2, 4], height = [[0, 0, 0], [0, \"10 cm\", 0]] }");
    // cells are cut from their first corner to the opposite one
    for (y, height_m) in [(-2.0, 0.05), (0.0, 0.05), (2.0, 0.0)] {
        assert!((inline.height_m(1.0, y) - height_m).abs() < 1e-12, "{y}: {}", inline.height_m(1.0, y));
    }
}

/// Heights come from a CSV file in any order and unit; what is missing, doubled or uneven is told.
#[test]
fn a_survey_is_read_from_a_file() {
    let text = short(&BRAKES.replace("friction = 0.8", "grid.file = \"hill.csv\""));
    let with = |csv: &str| {
        let draft = Draft::read(&text, Format::Toml, "a.toml").unwrap();
        draft.load(&|_| Ok(csv.as_bytes().to_vec())).and_then(|loaded| loaded.drives())
    };
    let sound = "x[m],y[m],height[cm]\n10,-1,0\n0,-1,0\n0,1,20\n10,1,20\n";
    let drives = with(sound).unwrap().0.unwrap();
    assert!((drives.world.ground.height_m(3.0, 0.0) - 0.1).abs() < 1e-12);
    let cases = [
        (sound.replace("10,1,20\n", ""), "3 points at 2 places of x and 2 of y"),
        (sound.replace("0,1,20\n10", "0,-1,0\n10"), "twice"),
        (format!("{sound}13,-1,0\n13,1,0\n"), "x = 10 m and next 13 m, 3.000 m apart"),
        (sound.replace("height", "z"), "unknown column `z`"),
        ("x[m],y[m],height[m]\n0,0,0\n".to_owned(), "at least 2 of each"),
        (sound.replace("10,1,20", "10,1,x"), "`x`"),
    ];
    for (csv, expected) in cases {
        let Err(problems) = with(&csv) else { panic!("{csv}") };
        assert!(problems.to_string().contains(expected), "{csv}\n{problems}");
    }
    let draft = Draft::read(&text, Format::Toml, "a.toml").unwrap();
    let problems = draft.load(&|_| Err("it is not there".to_owned())).unwrap_err().to_string();
    assert!(problems.contains("hill.csv") && problems.contains("drive.ground.grid"), "{problems}");
}

#[test]
fn mistakes_of_a_line_and_a_grid_are_told() {
    let cases = [
        ("line = { points = [[0, 0], [9, 0], [9, 9]] }", "no radius"),
        ("line = { points = [[0, 0], [9, 0], [9, 9]], radius = 30 }", "smaller radius"),
        ("line = { points = [[0, 0]] }", "at least two"),
        (
            "line = { points = [[0, 0], [99, 0], [99, 99]], radius = 6 }\nditch = { edge = 3, foreslope = 4, depth = 2 }",
            "inside of a bend",
        ),
        (
            "line = { points = [[0, 0], [9, 0]] }\ncurbs = [{ right = 3, height = 0.1 }]",
            "cross-section along the x axis",
        ),
        ("sections = [{ at = 0, right = [0, 5], height = [0] }]", "2 distances and 1 heights"),
        ("sections = [{ at = 0, right = [5, 0], height = [0, 0] }]", "not to the right"),
        ("grid = { from = [0, 0], step = [1, 1], height = [[0, 0], [0]] }", "same length"),
        ("grid = { from = [0, 0], step = [1, 1], height = [[0, 0]] }", "at least 2 by 2"),
        ("grid = { from = [0, 0], step = [1, 0], height = [[0, 0], [0, 0]] }", "out of range"),
        ("grid = { height = [[0, 0], [0, 0]] }", "from"),
        ("grid = { from = [0, 0], step = [1, 1], height = [] }", "at least 2 by 2"),
        ("grid = { from = [0, 0], step = [1, 1], height = [[0, 0], [0, 0]] }\ngrade = 0.1", "grade"),
        ("grid = {}", "file"),
    ];
    for (keys, expected) in cases {
        let text = complaint(&short(&BRAKES.replace("friction = 0.8", keys)));
        assert!(text.contains(expected) && text.contains("drive.ground"), "{keys}\n{text}");
    }
}

#[test]
fn mistakes_are_told_with_their_places() {
    let cases = [
        ("end = \"2 s\"", "end = \"0 s\"", "out of range"),
        ("preset = \"sedan\"", "preset = \"limousine\"", "limousine"),
        ("time = [\"0.01 s\", \"0.05 s\"]", "time = [\"0.4 s\", \"0.2 s\"]", "times that rise"),
        ("pedal = [0, 0.5]", "pedal = [0]", "2 times and 1 values"),
        (
            "preset = \"sedan\"",
            "preset = \"sedan\"\ncg_behind_front_axle = \"3 m\"",
            "between the axles, which are 2.7 m apart",
        ),
        ("preset = \"sedan\"", "preset = \"sedan\"\ninertia = [1000, 100, 100]", "the inertia is impossible"),
        (
            "friction = 0.8",
            "section = { right = [0, 5, 4], height = [0, 0, 0] }",
            "is not to the right of the previous one",
        ),
        ("friction = 0.8", "section = { right = [0, 5], height = [0] }", "2 distances and 1 heights"),
        ("friction = 0.8", "zones = [{ name = \"ice\", right = [3, 1], friction = 0.1 }]", "zone `ice`"),
        ("friction = 0.8", "curbs = [{ right = 1, height = 0.1, face = 95 }]", "a curb of 0.1 m"),
        ("kind = \"drive\"", "kind = \"drive\"\nvehicle = \"bus\"", "no vehicle of `drive` is named \"bus\""),
        (
            "[drive.ground]",
            "[vehicles.other]\npath = { kind = \"drive\" }\n[drive.ground]",
            "is the same vehicle of `drive`",
        ),
    ];
    for (old, new, expected) in cases {
        let text = short(BRAKES);
        assert!(text.contains(old), "{old}");
        let found = complaint(&text.replacen(old, new, 1));
        assert!(found.contains(expected) && found.contains("s.toml:"), "{new}: {found}");
    }
}
