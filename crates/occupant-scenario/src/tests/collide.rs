//! `[drive]`: barriers, collisions, crush, and who sits within it.

use super::{build, complaint, load, short_with};
use crate::Drives;
use vehicle_motion::body::Reading;
use vehicle_motion::world::Partner;

/// The short scenario in a sedan that hits a wall at 15 m/s, 2 m ahead of its bumper.
fn wall() -> String {
    short(
        r#"kind = "drive"

[drive]
end = "0.3 s"
[drive.vehicles.car]
preset = "sedan"
start = { speed = "15 m/s" }

[drive.barriers.wall]
kind = "wall"
at = ["2.5 m", 0]
"#,
    )
}

fn short(drive: &str) -> String {
    let pulse =
        "kind = \"pulse\"\nshape = \"half_sine\"\nspeed = \"30 km/h\"\ndelta_v = \"30 km/h\"\nduration = \"100 ms\"\n";
    short_with(pulse, drive)
}

fn driven(text: &str) -> Drives {
    load(text).unwrap_or_else(|e| panic!("{e}")).drives().unwrap_or_else(|e| panic!("{e}")).0.unwrap()
}

/// Messages about a text, including warnings.
fn told(text: &str) -> String {
    match load(text).and_then(|loaded| loaded.build()) {
        Ok((_, warnings)) => warnings.to_string(),
        Err(problems) => problems.to_string(),
    }
}

fn replaced(text: &str, old: &str, new: &str) -> String {
    assert!(text.contains(old), "{old}");
    text.replacen(old, new, 1)
}

/// ½M v² = ½B x² W: x = v / 27.7 s⁻¹; who is carried makes it 1.2 of that, and the residual crush stays.
#[test]
fn the_crush_of_people_is_longer_at_the_same_damage() {
    let of = |text: &str| {
        let drives = driven(text);
        (
            drives.outcome.damage[0].dynamic_m,
            drives.outcome.damage[0].residual_m,
            drives.world.cars[0].car.body.crush.reading,
        )
    };
    let [(dynamic, stays, reading), (short, same, damage)] =
        [of(&wall()), of(&replaced(&wall(), "preset = \"sedan\"", "preset = \"sedan\"\ncrush.reading = \"residual\""))];
    assert_eq!((reading, damage), (Reading::Dynamic { longer: 0.2 }, Reading::Residual));
    // measured 1.1978; 3 % more than the closed form, as the wheels' spin is taken up, too; 1 mm
    assert!((dynamic / short - 1.2).abs() < 4e-3, "{dynamic} {short}");
    assert!((short * 27.7 / 15.0 - 1.0).abs() < 0.04, "{short}");
    assert!((stays - same).abs() < 2e-3, "{stays} {same}");
}

/// The front of a test that crushed it by half a metre at 56 km/h is that of the closed form.
#[test]
fn a_wall_test_gives_the_front() {
    let test = "preset = \"sedan\"\nmass = \"1500 kg\"\ncrush = { test = { speed = \"56 km/h\", depths = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5] } }";
    let drives = driven(&replaced(&wall(), "preset = \"sedan\"", test));
    let front = drives.world.cars[0].car.body.crush.front;
    // A and B of 1500 kg on 1.5 m are 59 259 and 711 111; this one is 1.82 m broad
    let narrower = 1.5 / 1.82;
    assert!((front.a_n_per_m / (59_259.0 * narrower) - 1.0).abs() < 1e-3, "{front:?}");
    assert!((front.b_n_per_m2 / (711_111.0 * narrower) - 1.0).abs() < 1e-3, "{front:?}");
    let given = "preset = \"sedan\"\ncrush = { front = { A = \"51 kN/m\", B = \"632 kN/m^2\" } }";
    let front = driven(&replaced(&wall(), "preset = \"sedan\"", given)).world.cars[0].car.body.crush.front;
    assert_eq!((front.a_n_per_m, front.b_n_per_m2), (51e3, 632e3));
}

const BARRIERS: [(&str, &str); 6] = [
    ("wall", "at = [3, 0]\npreset = \"concrete\""),
    ("pole", "at = [3, 0.2]\npreset = \"fmvss-214\""),
    ("block", "centre = [4, 0]\nlengths = [2, 2]\nyaw = 10"),
    ("rail", "line = [[-5, 2], [40, -4]]"),
    ("cushion", "at = [3, 0]\nwidth = 1\nlength = 3\nmass = 50\nstroke = [0, 3]\nforce = [\"80 kN\", \"80 kN\"]"),
    ("sign", "at = [3, 0]\ndiameter = \"0.1 m\"\nmass = 40\nstroke = [0, 0.5]\nforce = [\"40 kN\", \"40 kN\"]"),
];

/// Every kind of barrier takes speed from the car, and the energy balance closes.
#[test]
fn barriers_of_all_kinds_are_met() {
    let old = "kind = \"wall\"\nat = [\"2.5 m\", 0]\n";
    for (kind, keys) in BARRIERS {
        let drives = driven(&replaced(&wall(), old, &format!("kind = \"{kind}\"\n{keys}\n")));
        let outcome = &drives.outcome;
        assert_eq!(drives.barriers, [("wall".to_owned(), kind)]);
        assert!(outcome.contacts.iter().any(|contact| contact.partner == Partner::Barrier(0)), "{kind}");
        let lost_m_s = 15.0 - outcome.rides[0].last().velocity_m_s.norm();
        assert!(lost_m_s > 0.5, "{kind}: {lost_m_s}");
        assert!(outcome.balance.abs() < 1e-4, "{kind}: {}", outcome.balance);
        let moves =
            outcome.slides[0].most_m > 0.01 || outcome.rails.first().is_some_and(|rail| rail.deflection_m > 0.01);
        assert_eq!(moves, ["rail", "cushion", "sign"].contains(&kind), "{kind}");
    }
}

/// A block may be given by corners in either sense, or as a rectangle: the same bits but for rounding.
#[test]
fn corners_go_round_either_way() {
    let old = "kind = \"wall\"\nat = [\"2.5 m\", 0]\n";
    let end = |keys: &str| {
        let drives = driven(&replaced(&wall(), old, &format!("kind = \"block\"\n{keys}\n")));
        drives.outcome.rides[0].last().position_m.x
    };
    let one = end("corners = [[3, -1], [3, 1], [5, 1], [5, -1]]");
    assert_eq!(one, end("corners = [[5, -1], [5, 1], [3, 1], [3, -1]]"));
    assert!((one - end("centre = [4, 0]\nlengths = [2, 2]")).abs() < 1e-6);
}

/// Two cars head on: momentum is kept, and each has its own damage.
#[test]
fn two_cars_meet() {
    let other =
        "[drive.vehicles.other]\npreset = \"small\"\nstart = { x = 6, yaw = 180, speed = 15 }\n[drive.barriers.wall]";
    let text = replaced(&wall(), "at = [\"2.5 m\", 0]", "at = [40, 0]");
    let text = replaced(&text, "kind = \"drive\"\n", "kind = \"drive\"\nvehicle = \"car\"\n");
    let drives = driven(&replaced(&text, "[drive.barriers.wall]", other));
    let contact = &drives.outcome.contacts[0];
    assert_eq!((contact.car, contact.partner), (0, Partner::Car(1)));
    let [one, two] = contact.struck.map(|struck| struck.unwrap().by_contact_m_s.norm());
    let [m, n] = [0, 1].map(|i| drives.vehicles[i].car.mass_kg);
    assert!((m * one / (n * two) - 1.0).abs() < 1e-9, "{one} {two}");
    assert!(two > one && drives.outcome.damage.iter().all(|damage| damage.residual_m > 0.1));
    // an impulse in the place of crush leaves them whole
    let impact = "[[drive.impacts]]\nbetween = [\"car\", \"other\"]\nat = [3.07, 0]\nnormal = 0\n[drive.barriers.wall]";
    let text = replaced(&replaced(&text, "[drive.barriers.wall]", other), "[drive.barriers.wall]", impact);
    let drives = driven(&text);
    assert!(drives.outcome.damage.iter().all(|damage| damage.dynamic_m == 0.0));
    let [one, two] = drives.outcome.contacts[0].struck.map(|struck| struck.unwrap().by_contact_m_s.norm());
    // 30 m/s of approach, restitution 0.1
    assert!((one + two - 33.0).abs() < 0.1, "{one} {two}");
}

/// An impact that does not act is told with its place in the text, and one after the end is refused.
#[test]
fn an_impact_that_does_not_act_is_told() {
    let with = |impact: &str| {
        let impact = format!("[[drive.impacts]]\nbetween = [\"car\", \"wall\"]\n{impact}\n[drive.barriers.wall]");
        told(&replaced(&wall(), "[drive.barriers.wall]", &impact))
    };
    assert!(!with("normal = 0").contains("drive.impacts"), "{}", with("normal = 0"));
    for (impact, expected) in [
        ("normal = 90", "the impact between car and wall does not act: at 0.0"),
        (
            "normal = 0\nat = [50, 0]\ntime = 0.01",
            "m away from the outline of one of them; they pass through each other",
        ),
        ("normal = 0\ntime = 2", "2 s, and the drive ends at 0.3 s"),
    ] {
        let told = with(impact);
        assert!(told.contains(expected) && told.contains("drive.impacts[0]"), "{told}");
    }
}

/// A vehicle that leaves a grid of heights is told; one that stays on it is not.
#[test]
fn who_leaves_a_grid_is_told() {
    let with = |lengths: &str| {
        let grid = format!(
            "[drive.ground]\ngrid = {{ from = [-10, -10], step = [{lengths}], height = [[0, 0], [0, 0]] }}\n[drive.barriers.wall]"
        );
        told(&replaced(&replaced(&wall(), "[drive.barriers.wall]", &grid), "at = [\"2.5 m\", 0]", "at = [40, 0]"))
    };
    let leaves = with("12, 20");
    assert!(leaves.contains("a wheel of car leaves the surveyed ground at 0.0") && leaves.contains("x 2."), "{leaves}");
    assert!(!with("60, 20").contains("surveyed"), "{}", with("60, 20"));
}

/// Nothing moves a door in: who sits behind one that is pressed in is refused, until a panel is given.
#[test]
fn who_sits_within_the_crush_is_refused() {
    // a pole beside his chest
    let side = replaced(
        &wall(),
        "kind = \"wall\"\nat = [\"2.5 m\", 0]\n",
        "kind = \"pole\"\nat = [0.0, -1.3]\ndiameter = \"0.3 m\"\n",
    );
    let side = replaced(
        &side,
        "start = { speed = \"15 m/s\" }",
        "start = { speed = \"8 m/s\", sideslip = -90, wheels_stand = true }",
    );
    let side = replaced(&side, "back = \"back\"\n", "back = \"back\"\ny = -0.35\n");
    let found = told(&side);
    assert!(
        found.contains("the crush of car reaches") && found.contains("error") && found.contains("s.toml:"),
        "{found}"
    );
    // the other side of the car, and a run that ends before the crush
    let right = replaced(&replaced(&side, "at = [0.0, -1.3]", "at = [0.0, 1.3]"), "sideslip = -90", "sideslip = 90");
    assert!(!told(&right).contains("the crush of car"), "{}", told(&right));
    assert!(!driven(&right).outcome.damage[0].dents.is_empty());
    let early = replaced(&side, "time.end = \"150 ms\"", "time.end = \"10 ms\"");
    assert!(!told(&early).contains("the crush of car"), "{}", told(&early));
    // a panel that moves
    let panel = "[frames.door]\npath = { kind = \"table\", columns = [\"t[s]\", \"y[m]\"], rows = [[0, 0], [0.05, 0.2], [0.2, 0.2]] }\n[materials]";
    let found = told(&replaced(&side, "[materials]", panel));
    assert!(found.contains("the crush of car reaches") && !found.contains("error"), "{found}");
    build(&replaced(&side, "[materials]", panel));
    // the front is far from his feet
    assert!(!told(&wall()).contains("the crush of car"), "{}", told(&wall()));
}

/// Presets of signs and cushions keep to what their classes ask: they are made so, and are no evidence of a product.
#[test]
fn presets_keep_to_their_classes() {
    let drives = |car: &str, kmh: f64, keys: &str| {
        let text = replaced(&wall(), "kind = \"wall\"\nat = [\"2.5 m\", 0]\n", &format!("at = [3, 0]\n{keys}\n"));
        let text = replaced(&text, "end = \"0.3 s\"", "end = \"1.5 s\"");
        let text = replaced(&text, "speed = \"15 m/s\"", &format!("speed = \"{kmh} km/h\""));
        driven(&replaced(&text, "preset = \"sedan\"", &format!("preset = \"{car}\"")))
    };
    // EN 12767: what leaves at 70 to 100, 50 to 70, at most 50 km/h; measured 85, 57 and 14 km/h
    for (category, range) in [("ne", 70.0..100.0), ("le", 50.0..70.0), ("he", 0.0..50.0)] {
        let drives = drives("en900", 100.0, &format!("kind = \"sign\"\npreset = \"en12767-{category}\""));
        let leaves = drives.outcome.contacts[0].struck[0].unwrap().leaves_m_s.norm() * 3.6;
        assert!(range.contains(&leaves), "{category}: {leaves}");
        assert!(drives.outcome.slides[0].most_m > 0.5, "{category}");
    }
    // EN 1317-3: light and heavy cars stop within the stroke, and push back little
    for (kmh, stroke_m) in [(80.0, 4.0), (100.0, 6.0)] {
        for car in ["en900", "en900\"\nmass = \"1300 kg"] {
            let drives = drives(car, kmh, &format!("kind = \"cushion\"\npreset = \"en1317-3-{kmh}\""));
            let (slid, last) = (&drives.outcome.slides[0], drives.outcome.rides[0].last());
            assert!((0.4..1.0).contains(&(slid.most_m / stroke_m)), "{car} {kmh}: {slid:?}");
            // measured 4.3 to 5.5 m/s: at most what a returned share of 0.05 gives, √0.05 of the speed
            assert!(last.velocity_m_s.norm() < 0.23 * kmh / 3.6, "{car} {kmh}: {:?}", last.velocity_m_s);
        }
    }
}

/// Cars that lean on each other after a crash do not collide again, and a contact ends with its force.
#[test]
fn a_contact_ends_with_its_force() {
    let outcome = &driven(&wall()).outcome;
    assert_eq!(outcome.contacts.len(), 1);
    let contact = &outcome.contacts[0];
    // loaded for a quarter of a period, π/2 · 1.2/27.7 s, and unloaded eight times as fast
    let lasts_s = contact.until_s - contact.from_s;
    assert!((0.06..0.1).contains(&lasts_s), "{lasts_s}");
}

#[test]
fn warnings_say_what_is_beyond_the_model() {
    let barrier = "kind = \"wall\"\nat = [\"2.5 m\", 0]\n";
    let cases = [
        ("speed = \"15 m/s\"", "speed = \"40 m/s\"", "the distance to its front axle"),
        ("speed = \"15 m/s\"", "speed = \"80 m/s\"", "more than half of it"),
        (barrier, "kind = \"rail\"\nline = [[-3, 2], [5.5, 0.4]]\n", "beyond an end of this rail"),
    ];
    for (old, new, expected) in cases {
        let found = match load(&replaced(&wall(), old, new)).and_then(|loaded| loaded.drives()) {
            Ok((_, warnings)) => warnings.to_string(),
            Err(problems) => format!("an error: {problems}"),
        };
        assert!(found.contains(expected) && found.contains("warning") && found.contains("s.toml:"), "{new}: {found}");
    }
    let quiet = replaced(&wall(), barrier, "kind = \"rail\"\nline = [[-20, 3], [60, -4]]\n");
    let (drives, warnings) = load(&quiet).unwrap().drives().unwrap();
    assert!(
        drives.is_some_and(|drives| drives.outcome.rails[0].deflection_m > 0.01) && warnings.is_empty(),
        "{warnings}"
    );
}

#[test]
fn mistakes_are_told_with_their_places() {
    let at = "at = [\"2.5 m\", 0]";
    let barrier = "kind = \"wall\"\nat = [\"2.5 m\", 0]\n";
    let cushion = |stroke: &str, force: &str| {
        format!(
            "kind = \"cushion\"\nat = [3, 0]\nwidth = 1\nlength = 3\nmass = 50\nstroke = {stroke}\nforce = {force}\n"
        )
    };
    let rows = [cushion("[0, 1, 1]", "[1, 1, 1]"), cushion("[0.1, 1]", "[1, 1]"), cushion("[0, 1]", "[1]")];
    let cases = [
        (at, "at = [1, 0]", "within wall"),
        (barrier, "kind = \"hedge\"\n", "hedge"),
        (barrier, "kind = \"pole\"\nat = [3, 0]\n", "diameter"),
        (barrier, "kind = \"pole\"\nat = [3, 0]\ndiameter = 0\n", "out of range"),
        (barrier, "kind = \"block\"\ncorners = [[3, 0], [4, 0], [3.2, 0.2], [3, 1]]\n", "convex"),
        (barrier, "kind = \"block\"\ncorners = []\n", "convex"),
        (barrier, "kind = \"block\"\ncentre = [4, 0]\n", "lengths"),
        (barrier, "kind = \"rail\"\nline = [[0, 3], [1, 3]]\n", "at least two spacings"),
        (barrier, "kind = \"rail\"\nline = [[0, 3], [40, 3]]\nedges = [0.7, 0.4]\n", "the lower edge"),
        (barrier, &rows[0], "stroke 3 is 1 m, after 1 m"),
        (barrier, &rows[1], "a first stroke of 0.1 m"),
        (barrier, &rows[2], "2 strokes and 1 forces"),
        (barrier, "kind = \"sign\"\nat = [3, 0]\n", "no `diameter`, and no preset"),
        (
            barrier,
            "kind = \"sign\"\nat = [3, 0]\npreset = \"en12767-ne\"\nstroke = [0, 1]\n",
            "`stroke` without `force`",
        ),
        (
            barrier,
            "kind = \"cushion\"\nat = [3, 0]\nwidth = 1\nlength = 3\nmass = 50\n",
            "neither `stroke` and `force`",
        ),
        (barrier, "kind = \"cushion\"\nat = [3, 0]\npreset = \"tl-3\"\n", "en1317-3-80"),
        ("preset = \"sedan\"", "preset = \"sedan\"\ninertia = [100, 200, 2640]", "none above the sum of the others"),
        (
            "preset = \"sedan\"",
            "preset = \"sedan\"\nsuspension = { front = { wheel_mass = 700 } }",
            "the wheels have all of the vehicle's mass",
        ),
        ("preset = \"sedan\"", "preset = \"sedan\"\ncrush = { front = { A = 0, B = 1 } }", "out of range"),
        (
            "preset = \"sedan\"",
            "preset = \"sedan\"\ncrush = { reading = \"residual\", longer = 0.3 }",
            "residual reading",
        ),
        (
            "preset = \"sedan\"",
            "preset = \"sedan\"\ncrush = { test = { speed = 15, depths = [0, 0, 0, 0, 0, 0] } }",
            "a mean crush of 0 m",
        ),
        (
            "[drive.barriers.wall]",
            "[[drive.impacts]]\nbetween = [\"car\", \"wal\"]\nnormal = 0\n[drive.barriers.wall]",
            "no vehicle or barrier of `drive` is named \"wal\"",
        ),
        (
            "[drive.barriers.wall]",
            "[[drive.impacts]]\nbetween = [\"car\", \"car\"]\nnormal = 0\n[drive.barriers.wall]",
            "an impact of car with itself",
        ),
    ];
    for (old, new, expected) in cases {
        let found = complaint(&replaced(&wall(), old, new));
        assert!(found.contains(expected) && found.contains("s.toml:"), "{new}: {found}");
    }
}
