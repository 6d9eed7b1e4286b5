//! Cars in words.

use super::belts::changed;
use super::{build, complaint};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::setup::Setup;

/// A scenario that says nothing but its car.
pub(super) fn of(car: &str) -> String {
    format!(
        "title = \"car\"\n[time]\nend = 0.1\n[path]\nkind = \"pulse\"\nshape = \"half_sine\"\nspeed = \"50 km/h\"\n\
         delta_v = \"50 km/h\"\nduration = \"0.1 s\"\n[car]\n{car}\n"
    )
}

fn solid<'s>(setup: &'s Setup, name: &str) -> &'s occupant_core::forces::contact::solid::Solid {
    setup.solids.iter().find(|solid| solid.name == name).unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn whoever_says_nothing_but_a_car_gets_a_driver_with_belt_and_bag() {
    for class in ["small", "sedan", "suv", "van", "pickup"] {
        let (model, said) = changed(&of(&format!("class = \"{class}\"")), &[]).unwrap();
        assert!(said.is_empty(), "{class}: {said}");
        let setup = model.setup();
        assert_eq!(setup.body.segments.len(), 19);
        assert_eq!((setup.bags.len(), setup.columns.len()), (1, 1));
        assert_eq!(setup.body.plates.len(), 5, "{class}");
    }
    let sled = build(&of("class = \"sled\""));
    assert!(sled.bags.is_empty() && sled.solids.iter().all(|solid| solid.name != "windscreen"));
}

#[test]
fn a_wheel_stands_where_it_was_measured() {
    let car = of(
        "wheel = { ahead = \"36 cm\", above = \"38 cm\", angle = \"31 deg\", diameter = \"39 cm\" }\ndrive = \"right\"",
    );
    let setup = build(&car);
    let text = format!("{:?}", solid(&setup, "wheel_rim"));
    for number in ["0.36, 0.36, -0.38", "0.195"] {
        assert!(text.contains(number), "{number} in {text}");
    }
}

#[test]
fn what_a_scenario_says_is_laid_over_the_car() {
    let own = of("")
        + "[solids.wheel_rim]\nmaterial = \"padding\"\n[solids.box]\nkind = \"box\"\nmaterial = \"padding\"\n\
                       centre = [0.2, 0, 0.1]\nlengths = [0.5, 0.2, 0.2]\n[materials.foam]\nk1 = \"9 kN/m\"\n";
    let (setup, plain) = (build(&own), build(&of("")));
    assert_eq!(setup.solids.len(), plain.solids.len() + 1);
    let rim = |setup: &Setup| solid(setup, "wheel_rim").material;
    assert_ne!(rim(&setup), rim(&plain));
}

#[test]
fn a_number_set_afterwards_is_one_that_was_written() {
    let draft = |text: &str| crate::Draft::read(text, crate::Format::Toml, "s.toml").unwrap();
    let written = draft(&of("[car.seats.driver]\nrecline = 27\nlimiter = \"4.5 kN\""));
    let mut set = draft(&of("")).prepared();
    for change in ["car.seats.driver.recline=27", "car.seats.driver.limiter=4.5 kN"] {
        set.set(change).unwrap();
    }
    let of = |draft: crate::Draft| format!("{:?}", draft.load(&super::no_files).unwrap().build().unwrap().0);
    assert!(of(set) == of(written));
}

/// How far ahead the cushion of an occupied seat reaches, m.
fn ahead(seat: &str, body: &str) -> f64 {
    let text = of("") + &format!("[posture]\nseat = \"{seat}\"\n[body]\n{body}\n");
    let mut draft = crate::Draft::read(&text, crate::Format::Toml, "s.toml").unwrap();
    let found = draft.get(&format!("solids.{seat}_foam.profile[1][0]")).unwrap();
    let placed_text::Value::String(text) = &found[0].1 else { panic!("{found:?}") };
    text.trim_end_matches(" m").parse::<f64>().unwrap()
}

#[test]
fn the_seat_of_a_tall_driver_stands_farther_back() {
    let tall = ahead("driver", "sex = \"male\"\nstature = \"1.88 m\"\nmass = \"90 kg\"");
    let short = ahead("driver", "sex = \"female\"\nstature = \"1.52 m\"\nmass = \"50 kg\"");
    assert!((short - tall - 0.433 * (1.88 - 1.52)).abs() < 1e-12, "{short} {tall}");
}

#[test]
fn dummies_sit_where_crash_tests_put_them() {
    for seat in ["driver", "passenger", "rear_left"] {
        let of = |dummy: &str| ahead(seat, &format!("dummy = \"{dummy}\""));
        let moved = of("hybrid3_5f-like") - of("hybrid3_50m-like");
        let expected = if seat == "rear_left" { 0.0 } else { 0.12 };
        assert!((moved - expected).abs() < 1e-12, "{seat}: {moved}");
    }
    let person = ahead("passenger", "preset = \"female05\"");
    assert!((person - ahead("passenger", "dummy = \"hybrid3_50m-like\"")).abs() < 1e-12);
}

/// What a person of a car has by default can be written down without a change, alone or together.
#[test]
fn a_default_that_is_written_down_changes_nothing() {
    let of_body = |body: &str| build(&(of("") + "[body]\n" + body));
    let plain = of_body("");
    let all = ["segment_count = 19", "chest = \"person\"", "abdomen = \"person\"", "pelvis = \"flesh\""];
    for body in all.into_iter().chain([all.join("\n").as_str()]) {
        assert!(format!("{:?}", of_body(body)) == format!("{plain:?}"), "{body}");
    }
    assert!(format!("{:?}", of_body("pelvis = \"rigid\"")) != format!("{plain:?}"));
}

/// People of every mass that bodies are made for have a place in a car.
#[test]
fn heavy_people_can_sit_in_a_car() {
    for (sex, stature, bmi) in
        [("female", 1.65, 32.5), ("female", 1.5, 44.9), ("female", 2.05, 40.0), ("male", 1.75, 44.9)]
    {
        let mass = bmi * stature * stature;
        build(&(of("") + &format!("[body]\nsex = \"{sex}\"\nstature = \"{stature} m\"\nmass = \"{mass} kg\"\n")));
    }
}

#[test]
fn a_sled_has_no_wheel_and_a_wheel_follows_its_driver() {
    let sled = build(&of("class = \"sled\""));
    assert!(sled.columns.is_empty() && sled.solids.iter().all(|solid| !solid.name.contains("wheel")));
    let beside = build(&of("[car.seats.driver]\ny = \"-30 cm\""));
    assert!(format!("{:?}", solid(&beside, "wheel_rim")).contains("-0.3"));
}

#[test]
fn a_pretensioner_takes_slack_up_first() {
    let pull = |seat: &str| {
        let mut draft =
            crate::Draft::read(&of(&format!("[car.seats.driver]\n{seat}")), crate::Format::Toml, "s.toml").unwrap();
        let all = draft.get("retractors.driver.pretensioner.pull[*]").unwrap_or_default();
        let lost = draft.get("limiters.driver.payout[1]").unwrap();
        (all.len(), format!("{:?}", all.last()), format!("{:?}", lost[0].1))
    };
    assert_eq!(pull("slack = 0").0, 2);
    let (count, last, film) = pull("slack = \"4 cm\"");
    assert!(count == 3 && last.contains("0.06") && film.contains("0.03"), "{last} {film}");
    let (count, _, loose) = pull("slack = \"15 cm\"");
    assert!(count == 0 && loose.contains("0.04") | loose.contains("0.05"), "{loose}");
    for slack in ["0", "\"1 mm\"", "\"10 cm\"", "\"50 cm\""] {
        build(&of(&format!("[car.seats.driver]\nslack = {slack}")));
    }
}

#[test]
fn arms_that_are_said_are_not_put_on_the_wheel() {
    let setup = build(&(of("") + "[posture]\nupper_arms = 30\nelbows = -60\n"));
    assert!(format!("{:?}", setup.posture).contains("hands_m: None"));
    let stiffer = build(&of("panel = { bolster_stiffness = \"70 kN/m\" }"));
    assert_eq!(stiffer.materials.len(), build(&of("")).materials.len() + 1);
}

#[test]
fn three_people_sit_in_a_van() {
    let people = "class = \"van\"\n[occupants.driver]\n[occupants.passenger]\nbody = { preset = \"female05\" }\n[occupants.rear_left]\n\
                  body = { preset = \"female50\" }";
    let setup = build(&of(people));
    assert_eq!(setup.bags.len(), 2);
    assert_eq!(setup.body.tree.bodies().len(), 3);
    let four = build(&of(
        "class = \"van\"\n[occupants.driver]\n[occupants.passenger]\n[occupants.rear_left]\n[occupants.third_right]",
    ));
    assert_eq!(four.body.segments.len(), 48);
}

#[test]
fn what_is_wrong_with_a_car_is_said_at_its_place() {
    for (car, expected) in [
        ("class = \"saloon\"", "\"sedan\""),
        ("[car.seats.drivr]\ntrack = 0", "did you mean `driver`?"),
        ("[car.seats.driver]\nrecline = \"20 cm\"", "not the unit of an angle"),
        ("[car.seats.driver]\nlimiter = -1", "out of range"),
        ("[car.seats.driver]\nbelt = \"four_point\"", "\"three_point\""),
        ("wheel = { ahed = 1 }", "did you mean `ahead`?"),
        ("[car.seats.driver]\ntrack = 10", "no car has that"),
        ("[car.seats.driver]\nrecline = 120", "0 to 80 degrees"),
        ("[car.seats.driver]\nd_ring = { behind = 3 }", "at most 1 m"),
        ("wheel = { diameter = \"1 mm\" }", "20 cm to 60 cm"),
        ("[solids.wheel_rim]\nmaterial = \"leather\"", "leather"),
        ("[solids.wheel_rim]\nradiuss = 1", "did you mean `radius`?"),
    ] {
        let said = complaint(&of(car));
        assert!(said.contains(expected), "{car}: {said}");
    }
}

#[test]
fn bags_beside_stand_on_the_side_that_is_asked() {
    let names = |car: &str| build(&of(car)).bags.iter().map(|bag| bag.name.clone()).collect::<Vec<_>>();
    assert_eq!(
        names("bags = { driver = false, curtain = \"both\", side = \"left\" }"),
        ["left_curtain", "right_curtain", "driver_side"]
    );
    // right-hand drive: nobody sits on the left
    assert_eq!(
        names("drive = \"right\"\nbags = { driver = false, curtain = \"left\", side = \"left\" }"),
        ["left_curtain"]
    );
    assert_eq!(names("bags = { driver = false, side = \"none\" }"), [""; 0]);
    let setup = build(&of("bags = { curtain = \"left\" }"));
    assert!(setup.bags[1].mount_m.y < -0.5 && setup.bags[1].cover_kg > 0.0, "{:?}", setup.bags[1]);
}

/// A scenario of two vehicles, each with a car and a driver.
fn of_two() -> String {
    of("class = \"small\"")
        + "[vehicles.other.path]\nkind = \"pulse\"\nshape = \"half_sine\"\nspeed = \"40 km/h\"\ndelta_v = \"40 km/h\"\n\
           duration = \"0.1 s\"\nposition = [\"5 m\", 0, 0]\n[vehicles.other.car]\nclass = \"van\"\n[occupants.a]\n[occupants.b]\n\
           vehicle = \"other\"\n"
}

#[test]
fn each_vehicle_has_a_car_of_its_own() {
    let setup = build(&of_two());
    assert_eq!((setup.members.len(), setup.columns.len(), setup.bags.len()), (2, 2, 1));
    let [own, other] = ["wheel_rim", "other_wheel_rim"].map(|name| format!("{:?}", solid(&setup, name)));
    assert!(own.contains("0.185") && other.contains("0.1925"), "{own} {other}");
    let unknown = complaint(&of_two().replace("class = \"van\"", "class = \"van\"\nseats.left.track = 0"));
    assert!(unknown.contains("vehicles.other.car.seats.left"), "{unknown}");
    let far = complaint(&of_two().replace("class = \"van\"", "class = \"van\"\nwheel.ahead = \"9 m\""));
    assert!(far.contains("vehicles.other.car.wheel.ahead"), "{far}");
}

#[test]
fn a_seat_of_another_vehicle_is_named_after_it() {
    let sits = |seat: &str| of_two() + &format!("[occupants.b.posture]\nseat = \"{seat}\"\n");
    let found = complaint(&sits("passenger"));
    assert!(found.contains("a seat of the first vehicle") && found.contains("`other_passenger`"), "{found}");
    assert_eq!(build(&sits("other_passenger")).members.len(), 2);
}

#[test]
fn a_key_of_a_joint_leaves_the_body_as_it_is() {
    let setup = build(&(of("") + "[joints.neck]\ndamping = 1\n"));
    assert_eq!((setup.body.segments.len(), setup.body.plates.len()), (19, 5));
}

#[test]
fn a_number_out_of_range_is_told_once() {
    let found = complaint(&of("wheel.ahead = \"-1 cm\""));
    assert_eq!(found.matches("error:").count(), 1, "{found}");
}

#[test]
fn a_side_comes_in_as_far_and_as_fast_as_is_said() {
    let setup = build(&of("intrusion.left = { depth = \"30 cm\", begins = \"10 ms\", lasts = \"50 ms\" }"));
    let frame = setup.frames.iter().find(|frame| frame.name == "left_intrusion").unwrap();
    let y_m = |t_s: f64| frame.path.motion(t_s, t_s, &mut Default::default()).origin_m.y.abs();
    let found = [0.0, 0.01, 0.02, 0.06, 0.1].map(y_m);
    for (found, expected) in found.iter().zip([0.0, 0.0, 0.06, 0.3, 0.3]) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    let fastest = (0..60).map(|i| (y_m(f64::from(i + 1) * 1e-3) - y_m(f64::from(i) * 1e-3)) / 1e-3).fold(0.0, f64::max);
    // twice the mean of 6 m/s, less what rows of 2.5 ms round off
    assert!((11.0..12.01).contains(&fastest), "{fastest}");
    assert!(format!("{:?}", solid(&setup, "left_door")).contains("Other("));
    assert!(format!("{:?}", solid(&setup, "right_door")).contains("Vehicle"));
}

#[test]
fn a_back_that_yields_carries_cover_frame_and_head_restraint() {
    let setup = build(&of("seats.driver.back_moment = \"1.5 kN m\""));
    let hinge = setup.columns.iter().find(|column| column.name == "driver_recliner").unwrap();
    assert!(hinge.turns());
    let on_it = setup.solids.iter().filter(|solid| solid.frame == Frame::Other(hinge.frame));
    let mut names: Vec<&str> = on_it.map(|solid| solid.name.as_str()).collect();
    names.sort_unstable();
    assert_eq!(names, ["driver_back", "driver_frame", "driver_head_restraint"]);
}

#[test]
fn a_child_sits_higher_on_a_booster() {
    let sits = |height: &str| {
        let own =
            format!("seats.rear_left = {{ {height} }}\n[body]\npreset = \"child10\"\n[posture]\nseat = \"rear_left\"");
        let setup = build(&of(&own));
        let model = occupant_core::model::Model::new(setup).unwrap();
        model.start().state.t1().to_vector().z
    };
    // the foam under it no longer sinks in
    let higher = sits("booster = \"10 cm\"") - sits("");
    assert!((0.10..0.16).contains(&higher), "{higher}");
}

#[test]
fn bags_of_the_front_wait_for_blows_on_the_front() {
    let due_s = |direction: &str| {
        let text = of("").replace("[car]", &format!("direction = {direction}\n[car]"));
        build(&text).bags[0].fires_s
    };
    assert!(due_s("[1, 0, 0]") < 0.03);
    for direction in ["[-1, 0, 0]", "[0, 1, 0]"] {
        assert!(due_s(direction) > 1.0, "{direction}");
    }
}

/// Parts of the bodies that the bag named so touches.
fn met(setup: &Setup, bag: &str) -> Vec<String> {
    let bag = setup.bags.iter().find(|one| one.name == bag).unwrap_or_else(|| panic!("no {bag}"));
    bag.spheres.iter().map(|(sphere, _)| setup.body.spheres[*sphere].part.clone()).collect()
}

#[test]
fn a_bag_of_a_car_touches_whoever_sits_before_it_and_no_loose_body() {
    let box_ = "[loose.box]\nmass = 5\ninertia = [0.1, 0.1, 0.1]\nat = [0.5, 0.4, -0.5]\nvehicle = \"vehicle\"\nskin = \"padding\"\n\
                spheres = { a = { centre = [0, 0, 0], radius = 0.1 } }\n";
    let two = "[occupants.driver]\n[occupants.passenger]\n";
    let setup = build(&(of("class = \"sedan\"") + two + box_));
    for (bag, own) in [("driver", "driver."), ("passenger", "passenger.")] {
        let met = met(&setup, bag);
        assert!(met.len() == 8 && met.iter().all(|part| part.starts_with(own)), "{bag}: {met:?}");
    }
    let found = complaint(&(of("bags = { side = \"both\" }") + two + "[bags.driver]\noccupant = \"third\"\n"));
    assert!(found.contains("no occupant is named \"third\""), "{found}");
    let alone = complaint(&(of("class = \"sedan\"") + "[bags.driver]\noccupant = \"driver\"\n"));
    assert!(alone.contains("in a scenario without `occupants`"), "{alone}");
}
