//! Every kind of complaint, as a user reads it.

use super::super::Draft;
use super::{SHORT, complaint, load, short_with};

#[test]
fn each_kind_of_mistake_is_explained() {
    for (old, new, expected) in [
        (
            "end = \"150 ms\"",
            "ende = \"150 ms\"",
            "error: unknown key `ende`
 --> s.toml:3:6
  |
3 | time.ende = \"150 ms\"
  |      ^^^^
  = help: did you mean `end`?
  = in: time
  = expected: `start`, `end`, `stop_at_rest`, `max_evaluations` or `max_wall_time`",
        ),
        (
            "title = \"Sled, 30 km/h, lap belt\"",
            "units = \"inch\"",
            "error: \"inch\" is not a value of `units`
 --> s.toml:1:9
  |
1 | units = \"inch\"
  |         ^^^^^^
  = in: units
  = expected: \"si\" or \"in-lbf-s\"

error: the scenario has no key `title`
 --> s.toml
  = expected: title = a text in quotes",
        ),
        (
            "\"70 kN/m\"",
            "\"70 kN\"",
            "error: `kN` is not the unit of a stiffness
  --> s.toml:35:10
   |
35 | k1 = \"70 kN\"
   |          ^^
   = in: belts.lap.k1
   = expected: a stiffness: 8400, \"8.4 kN/m\", \"48 lbf/in\"",
        ),
        (
            "heels = [0.69, 0.33]",
            "heels = [0.69, 0.33, 1]",
            "error: a list of 3
  --> s.toml:30:9
   |
30 | heels = [0.69, 0.33, 1]
   |         ^^^^^^^^^^^^^^^
   = in: posture.heels
   = expected: a list of 2",
        ),
        (
            "head = 5",
            "head = true",
            "error: true or false instead of an angle
  --> s.toml:26:8
   |
26 | head = true
   |        ^^^^
   = in: posture.head
   = expected: an angle: 15, \"15 deg\", \"0.26 rad\"",
        ),
        (
            "mu1 = 0.5",
            "mu1 = 50",
            "error: `50` is out of range
  --> s.toml:38:33
   |
38 | foam = { k1 = \"8.4 kN/m\", mu1 = 50, friction = 0.8 }
   |                                 ^^
   = in: materials.foam.mu1
   = expected: a plain number of at most 1",
        ),
        (
            "kind = \"pulse\"",
            "kind = \"puls\"",
            "error: \"puls\" is not a value of `kind`
 --> s.toml:6:8
  |
6 | kind = \"puls\"
  |        ^^^^^^
  = help: did you mean \"pulse\"?
  = in: path.kind
  = expected: \"fixed\", \"pulse\", \"table\", \"sensors\" or \"drive\"",
        ),
        (
            "kind = \"pulse\"\n",
            "",
            "error: `path` has no key `kind`
 --> s.toml:5:1
  |
5 | [path]
  | ^^^^^^
  = in: path
  = expected: kind = \"fixed\", \"pulse\", \"table\", \"sensors\" or \"drive\"",
        ),
        (
            "half_width = 0.4",
            "half_width = nan",
            "error: `NaN` is not finite
  --> s.toml:43:77
   |
43 | floor = { material = \"foam\", edge = [[-0.2, 0.36], [1, 0.36]], half_width = nan }
   |                                                                             ^^^
   = in: surfaces.floor.half_width
   = expected: a finite number",
        ),
        (
            ", half_width = 0.4",
            "",
            "error: `edge` without `half_width`
  --> s.toml:43:30
   |
43 | floor = { material = \"foam\", edge = [[-0.2, 0.36], [1, 0.36]] }
   |                              ^^^^
   = in: surfaces.floor
   = expected: both or neither",
        ),
        (
            "edge = [[-0.2, 0.36], [1, 0.36]], half_width = 0.4",
            "inside = [0, 0, 0]",
            "error: `surfaces.floor` has none of `points`, `edge`, `disc`, `plane`
  --> s.toml:43:9
   |
43 | floor = { material = \"foam\", inside = [0, 0, 0] }
   |         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
   = in: surfaces.floor
   = expected: `points`, `edge`, `disc` or `plane`",
        ),
        (
            "[joints]\npreset = \"male50\"",
            "[joints]\nneck.damping = 1",
            "error: joint `right_shoulder` and 9 more have no damping
  --> s.toml:15:1
   |
15 | [joints]
   | ^^^^^^^^
   = in: joints.right_shoulder
   = expected: a damping for each joint
   = help: set joints.all.damping for all joints, or start from joints.preset = \"male50\"",
        ),
        (
            "\"pelvis\"",
            "\"plevis\"",
            "error: no sphere is named \"plevis\"
  --> s.toml:33:10
   |
33 | sphere = \"plevis\"
   |          ^^^^^^^^
   = help: did you mean \"pelvis\"?
   = in: belts.lap.sphere
   = expected: \"head\", \"chest\", \"pelvis\", \"right_shoulder\", \"left_shoulder\", \"right_elbow\", \"left_elbow\", \
             \"right_hand\", \"left_hand\", \"right_thigh\", \"left_thigh\", \"right_knee\", \"left_knee\", \"right_shin\", \
             \"left_shin\", \"right_foot\" or \"left_foot\"",
        ),
        (
            "inside = [0.1, 0, -0.3]",
            "",
            "error: the open sides of `surfaces.cushion` and 2 more are not given
  --> s.toml:41:11
   |
41 | cushion = { material = \"foam\", edge = [[-0.2, 0.1], [0.3, 0.05]], half_width = 0.25 }
   |           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
   = in: surfaces.cushion
   = expected: inside = [x, y, z], a point on the open side, or facing = \"order\"
   = help: a key `inside` at the top of the scenario applies to all surfaces of the vehicle",
        ),
        (
            "delta_v = \"30 km/h\"",
            "rise = 1",
            "error: this pulse shape does not use `rise`
 --> s.toml:9:8
  |
9 | rise = 1
  |        ^
  = in: path.rise
  = expected: this shape takes only peak, delta_v, duration

error: a pulse without `peak` or `delta_v`
 --> s.toml:5:1
  |
5 | [path]
  | ^^^^^^
  = in: path
  = expected: `peak`, the peak deceleration, or `delta_v`, the change of speed
  = help: delta_v equal to speed brings the vehicle to rest",
        ),
        (
            "title = \"Sled, 30 km/h, lap belt\"",
            "title = \"Sled",
            "error: invalid basic string
 --> s.toml:1:14
  |
1 | title = \"Sled
  |              ^
  = expected: `\"`",
        ),
    ] {
        assert_eq!(complaint(&short_with(old, new)), expected, "{new}");
    }
}

#[test]
fn problems_of_all_kinds_come_together() {
    let text = SHORT
        .replace("km/h\"\ndelta_v", "kmh2\"\ndelta_v")
        .replace("settle", "seetle")
        .replace("\"70 kN/m\"", "[]")
        .replace("friction = 0.8", "friction = -1");
    let lines: Vec<usize> = load(&text).unwrap_err().iter().map(|d| d.position.map_or(0, |p| p.line)).collect();
    // speed; seetle, which is no angle; k1; friction.
    assert_eq!(lines, [8, 31, 35, 38]);
}

#[test]
fn references_that_lead_nowhere_come_together() {
    let text = SHORT
        .replace("cushion = \"cushion\"", "cushion = \"cushoin\"")
        .replace("seat = \"sled\"", "seat = \"sledge\"")
        .replace("foam = {", "foan = {");
    let found = complaint(&text);
    for words in [
        "no surface is named \"cushoin\"",
        "no seat is named \"sledge\"",
        "no material is named \"foam\"",
        "did you mean \"foan\"?",
    ] {
        assert!(found.contains(words), "{found}");
    }
}

#[test]
fn problems_of_the_model_point_into_the_text() {
    let text = short_with("heels = [0.69, 0.33]", "heels = [2.7, 0.33]");
    let problems = load(&text).unwrap().model().err().unwrap().to_string();
    assert!(problems.starts_with("error: heels "), "{problems}");
    assert!(problems.contains("\n30 | heels = [2.7, 0.33]\n   |         ^^^^^^^^^^^\n"), "{problems}");
}

#[test]
fn names_and_numbers_of_several_bodies_are_looked_at_where_they_stand() {
    let abreast = include_str!("../../testdata/hand/side-by-side.toml");
    let ball = "[loose.ball]\nmass = 2\ninertia = [0.1, 0.01, 0.01]\nat = [9, 0, 0]\n";
    let refused = |text: &str| load(text).unwrap().model().err().unwrap().to_string();
    for name in ["a.b", "../x", "Driver", "fährer"] {
        let found = refused(&abreast.replace("[occupants.driver]", &format!("[occupants.\"{name}\"]")));
        assert!(found.contains(&format!("error: a body named {name:?}")) && found.contains("small letters"), "{found}");
    }
    let twice = refused(&(abreast.to_owned() + &ball.replace("ball", "driver").replace("0.1,", "0.01,")));
    assert!(twice.contains("a second body named \"driver\"") && twice.contains("in: loose.driver"), "{twice}");
    let heavy = refused(&(abreast.to_owned() + ball));
    assert!(heavy.contains("in: loose.ball.inertia"), "{heavy}");
    let fast = abreast.to_owned() + &ball.replace("0.1,", "0.01,") + "velocity = [-150, 0, 0]\n";
    let (_, warnings) = load(&fast).unwrap().model().unwrap();
    assert!(warnings.to_string().contains("150 m/s at the start"), "{warnings}");
}

#[test]
fn a_mistake_of_a_pair_is_reported_once() {
    let text = short_with(
        "[joints]\npreset = \"male50\"",
        "[joints]\npreset = \"male50\"\nelbows.stop = { begin = 1, full = 2, damping = 1 }",
    );
    let found = complaint(&text);
    assert_eq!(found.matches("`stop` of a hinge").count(), 1, "{found}");
}

#[test]
fn long_lines_are_shortened_around_the_words() {
    let long = format!("title = \"{}\", 3", "x".repeat(500));
    let found = complaint(&short_with("title = \"Sled, 30 km/h, lap belt\"", &long));
    let line = found.lines().nth(3).unwrap();
    assert!(line.starts_with("1 | …xxx"), "{found}");
    assert!(line.chars().count() < 140, "{found}");
    let caret = found.lines().nth(4).unwrap();
    assert_eq!(line.chars().nth(caret.chars().position(|c| c == '^').unwrap()), Some(','), "{found}");
}

#[test]
fn bytes_that_are_no_text_are_placed() {
    let bytes = [SHORT.as_bytes(), b"\xff\xfe"].concat();
    let found = Draft::read_bytes(&bytes, None, "s.toml").unwrap_err().to_string();
    assert_eq!(found, "error: byte 0xff in line 44 is not UTF-8\n --> s.toml\n  = expected: a text in UTF-8");
}

#[test]
fn names_that_lead_nowhere_are_told_beside_wrong_words() {
    let text = short_with("\"70 kN/m\"", "\"70 kN\"")
        .replace("seat = \"sled\"", "seat = \"sledge\"")
        .replace("cushion = \"cushion\"", "cushion = \"cushon\"")
        .replace("sphere = \"pelvis\"", "sphere = \"pelves\"")
        .replacen("material = \"foam\"", "material = \"fome\"", 1);
    let complaint = complaint(&text);
    for found in [
        "`kN` is not the unit of a stiffness",
        "no seat is named \"sledge\"",
        "no surface is named \"cushon\"",
        "no sphere is named \"pelves\"",
        "no material is named \"fome\"",
        "did you mean \"pelvis\"?",
    ] {
        assert!(complaint.contains(found), "{found} is not in\n{complaint}");
    }
    assert_eq!(complaint.matches("error:").count(), 5, "{complaint}");
}
