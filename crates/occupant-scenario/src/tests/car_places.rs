//! Distances, years, belts and spreads of cars in words.

use super::belts::changed;
use super::car::of;
use super::{build, complaint, load};
use crate::{Draft, Format, Size, Usual};
use occupant_core::diagnosis::{OnShoulder, Way, diagnose};
use occupant_core::forces::chain::Site;
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::setup::Setup;

/// The distance or angle of a name, m or rad.
fn size(text: &str, name: &str) -> f64 {
    let all = load(text).unwrap_or_else(|said| panic!("{said}")).dimensions();
    let found = all.iter().find(|own| own.name == name).unwrap_or_else(|| panic!("no {name} among {all:?}"));
    let (Size::Distance(size) | Size::Angle(size) | Size::Force(size) | Size::Moment(size)) = found.size else {
        panic!("{found:?}")
    };
    size
}

#[test]
fn every_distance_that_is_said_is_told_again() {
    let text = of(
        "class = \"van\"\nseat_height = \"36 cm\"\nwheel = { ahead = \"31 cm\", above = \"37 cm\", angle = 30, diameter = \"40 cm\" }\n\
                   panel = { ahead = \"66 cm\", above = \"41 cm\", bolster = \"61 cm\" }\nseat_offset = \"44 cm\"\nshoulder_room = \"1.62 m\"\n\
                   roof = \"91 cm\"\ncouple = \"88 cm\"\n[car.seats.driver]\ntrack = \"5 cm\"\nheight = \"2 cm\"\nrecline = 18\nslack = \"3 cm\"\n\
                   d_ring = { behind = \"30 cm\", outboard = \"26 cm\", above = \"63 cm\" }\nlap_above = \"1 cm\"\n\
                   [occupants.driver]\n[occupants.rear_right]\n",
    );
    for (name, expected) in [
        ("seat_height", 0.36),
        ("wheel.ahead", 0.31),
        ("wheel.above", 0.37),
        ("wheel.angle", 30.0_f64.to_radians()),
        ("wheel.diameter", 0.40),
        ("panel.ahead", 0.66),
        ("panel.above", 0.41),
        ("panel.bolster", 0.61),
        ("seat_offset", 0.44),
        ("shoulder_room", 1.62),
        ("roof", 0.91),
        ("couple", 0.88),
        ("seats.driver.track", 0.05),
        ("seats.driver.height", 0.02),
        ("seats.driver.recline", 18.0_f64.to_radians()),
        ("seats.driver.slack", 0.03),
        ("seats.driver.d_ring.behind", 0.30),
        ("seats.driver.d_ring.outboard", 0.26),
        ("seats.driver.d_ring.above", 0.63),
        ("seats.driver.lap_above", 0.01),
    ] {
        assert!((size(&text, name) - expected).abs() < 1e-9, "{name}: {}", size(&text, name));
    }
    assert!(load(&of("class = \"sled\"")).unwrap().dimensions().iter().all(|own| !own.name.starts_with("wheel")));
}

/// Dimensions of a sedan in the source of the classes: H30 250, L50 850, H61 975 mm.
#[test]
fn a_sedan_has_the_published_size() {
    let text = of("[occupants.driver]\n[occupants.rear_left]\n");
    for (name, expected) in [("seat_height", 0.250), ("couple", 0.850), ("head room", 0.975)] {
        assert!((size(&text, name) - expected).abs() < 0.026, "{name}: {}", size(&text, name));
    }
}

/// A shoe on a pedal leans by A47 of SAE J1516, 64.4° where H30 is 250 mm, so its heel is 203 mm · cos A47 before its ball, which is 883.5 mm
/// from the H-point of a mean driver. The heels of a body stand 27 mm nearer.
#[test]
fn heels_of_a_driver_are_those_of_shoes_on_a_pedal() {
    let ahead = |class: &str| {
        let mut draft = Draft::read(&of(class), Format::Toml, "s.toml").unwrap();
        let found = draft.get("posture.heels[0]").unwrap();
        let placed_text::Value::String(text) = &found[0].1 else { panic!("{found:?}") };
        text.trim_end_matches(" m").parse::<f64>().unwrap()
    };
    assert!((ahead("class = \"sedan\"") - 0.7688).abs() < 1e-4, "{}", ahead("class = \"sedan\""));
    // a high seat has a flat pedal, near the seat; no seat is so high that a shoe points back
    let [low, high, highest] = ["0.25", "0.35", "1.2"].map(|h| ahead(&format!("seat_height = {h}")));
    assert!(low > high && high > highest && (low - highest - 0.24 * 0.95) < 0.203, "{low} {high} {highest}");
}

/// A ring on the pillar stays where it is as the seat slides, and one that is said stays where it was said.
#[test]
fn a_d_ring_stands_on_the_pillar() {
    let behind = |car: &str| size(&of(&format!("[car.seats.driver]\n{car}")), "seats.driver.d_ring.behind");
    assert!((behind("track = \"-8 cm\"") - behind("track = 0") - 0.08).abs() < 1e-12);
    assert_eq!(behind("track = \"-8 cm\"\nd_ring = { behind = \"30 cm\" }"), 0.30);
}

#[test]
fn belts_of_usual_drivers_bear_on_the_shoulder_and_a_high_ring_lifts_them_off() {
    for body in ["male50", "female05", "female50", "male95"] {
        for class in ["small", "sedan", "suv", "van", "pickup"] {
            let text = of(&format!("class = \"{class}\"\n[body]\npreset = \"{body}\"\n"));
            let diagnosis = diagnose(&changed(&text, &[]).unwrap().0);
            let lies: Vec<OnShoulder> = diagnosis.shoulder_belts.iter().map(|own| own.lies).collect();
            assert_eq!(lies, [OnShoulder::Bears], "{body} in {class}");
        }
    }
    let high = of("[car.seats.driver]\nd_ring = { behind = \"27 cm\", above = \"66 cm\" }\n");
    assert_eq!(diagnose(&changed(&high, &[]).unwrap().0).shoulder_belts[0].lies, OnShoulder::LiftedOff);
}

#[test]
fn what_is_free_before_the_body_follows_the_panel() {
    let free = |bolster: &str| {
        let all = diagnose(&changed(&of(&format!("panel = {{ bolster = {bolster} }}")), &[]).unwrap().0).clearances;
        let knee = all.iter().find(|own| own.sphere == "left_knee").unwrap_or_else(|| panic!("{all:?}"));
        assert_eq!((knee.surface.as_str(), knee.way), ("knee_bolster", Way::Ahead));
        assert!(all.iter().any(|own| own.sphere == "head" && own.way == Way::Up && own.surface == "roof"), "{all:?}");
        knee.distance_m
    };
    assert!((free("0.62") - free("0.58") - 0.04).abs() < 2e-3);
}

#[test]
fn years_leave_out_what_cars_did_not_have() {
    let of_years = |years: &str| build(&of(years));
    let [old, nineties, noughties, today] =
        ["1970s", "1990s", "2000s", "present"].map(|years| of_years(&format!("years = \"{years}\"")));
    let bags = |setup: &Setup| setup.bags.len();
    assert_eq!([&old, &nineties, &noughties, &today].map(bags), [0, 1, 1, 1]);
    let pulls = |setup: &Setup| setup.chains[0].device.reel.as_ref().is_some_and(|reel| reel.pull.is_some());
    assert_eq!([&old, &nineties, &noughties, &today].map(pulls), [false, false, true, true]);
    // without a limiter 10 cm beyond the film the force is that of webbing which is held
    let force = |setup: &Setup| {
        let points = &setup.chains[0].device.limiter.as_ref().unwrap().points;
        let ahead = points.windows(2).find(|pair| pair[1][0] >= 0.13).unwrap();
        let [[a, from], [b, to]] = [ahead[0], ahead[1]];
        from + (to - from) * (0.13 - a) / (b - a)
    };
    assert!((force(&today) - 3000.0).abs() < 1e-6 && force(&old) > 20e3, "{} {}", force(&today), force(&old));
    // each can be said
    let own = of_years(
        "years = \"1970s\"\nbags = { driver = true }\n[car.seats.driver]\nlimiter = \"5 kN\"\npretensioner = \"8 cm\"\n",
    );
    assert!(own.bags.len() == 1 && pulls(&own) && (force(&own) - 5000.0).abs() < 1e-6);
    assert_eq!(format!("{:?}", of_years("")), format!("{today:?}"));
}

/// Of the table of `check`: what is no distance.
fn word(text: &str, name: &str) -> String {
    let all = load(text).unwrap_or_else(|said| panic!("{said}")).dimensions();
    let found = all.iter().find(|own| own.name == name).unwrap_or_else(|| panic!("no {name} among {all:?}"));
    let Size::Word(word) = &found.size else { panic!("{found:?}") };
    word.clone()
}

#[test]
fn backs_yield_by_their_years_where_somebody_sits() {
    let moments = |years: &str| {
        let setup = build(&of(years));
        setup
            .columns
            .iter()
            .filter(|column| column.hinge.is_some())
            .map(|column| column.force.points[1][1])
            .collect::<Vec<_>>()
    };
    for (years, expected) in [("1970s", 850.0), ("1990s", 1100.0), ("2000s", 1700.0)] {
        let car = format!("years = \"{years}\"\n");
        assert_eq!(moments(&car), [expected]);
        assert_eq!(moments(&(car + "[car.seats.driver]\nback_moment = \"2 kN m\"\n")), [2000.0]);
    }
    assert!(moments("").is_empty());
    let old =
        of("years = \"1970s\"\n[car.seats.driver]\nlocking_tongue = true\nlap_above = \"1 cm\"\nslack = \"2 cm\"\n");
    assert_eq!(word(&old, "years"), "1970s");
    assert_eq!([word(&old, "seats.driver.locking_tongue"), word(&old, "seats.driver.limiter")], ["true", "none"]);
    let named = ["lap_above", "slack", "film", "back_moment"].map(|key| size(&old, &format!("seats.driver.{key}")));
    assert_eq!(named, [0.01, 0.02, 0.03, 850.0]);
    assert_eq!([word(&of(""), "years"), word(&of(""), "seats.driver.back_moment")], ["present", "fixed"]);
}

#[test]
fn a_belt_on_a_seat_leans_and_slides_with_its_back() {
    let ring = |seat: &str| {
        let setup = build(&of(&format!("[car.seats.driver]\nbelt = \"seat\"\n{seat}\n")));
        let node = setup.chains[0].nodes.iter().find(|node| node.name == "d_ring").unwrap().clone();
        let Site::Vehicle(place, _) = node.site else { panic!("{node:?}") };
        let (hinge, reel) =
            (setup.columns.iter().find(|column| column.hinge.is_some()).unwrap(), &setup.chains[0].nodes[0]);
        assert!(node.frame == Some(Frame::Other(hinge.frame)) && reel.frame == node.frame);
        assert!(setup.chains[0].nodes.iter().filter(|node| node.frame.is_some()).count() == 2);
        (place, hinge.force.points[1][1])
    };
    let (usual, moment) = ring("");
    assert_eq!(moment, 3750.0);
    let (leant, weak) = ring("recline = 40\nback_moment = \"1 kN m\"");
    assert!(weak == 1000.0 && leant.x < usual.x - 0.15 && leant.z > usual.z + 0.05, "{usual} {leant}");
    let (slid, _) = ring("track = \"10 cm\"");
    let (still, _) = ring("track = \"0 cm\"");
    assert!((still.x - slid.x - 0.1).abs() < 1e-9 && still.z == slid.z);
    assert_eq!(word(&of("[car.seats.driver]\nbelt = \"seat\"\n"), "seats.driver.belt"), "seat");
}

#[test]
fn a_lap_belt_begins_where_it_is_said_and_a_tongue_can_clamp() {
    let build_seat = |seat: &str| build(&of(&format!("[car.seats.driver]\n{seat}\n")));
    let crown = |setup: &Setup| {
        let wing = setup.chains[0].nodes.iter().find_map(|node| match &node.site {
            Site::Track(_, track) if track.wing.is_some() => Some(track.points_m[1]),
            _ => None,
        });
        wing.unwrap()
    };
    let (plain, high) = (crown(&build_seat("")), crown(&build_seat("lap_above = \"2 cm\"")));
    let moved = (high - plain).norm();
    assert!(high.z > plain.z && (moved - 0.02).abs() < 1e-3, "{moved}");
    let friction = |setup: &Setup| setup.chains[0].nodes.iter().find(|node| node.name == "buckle").unwrap().friction;
    assert_eq!([friction(&build_seat("")), friction(&build_seat("locking_tongue = true"))], [0.15, 3.0]);
    for (car, expected) in [
        ("[car.seats.driver]\nlap_above = \"9 cm\"", "on this pelvis"),
        ("[car.seats.driver]\nlap_above = \"1 m\"", "-10 cm to 15 cm"),
        ("[car.seats.driver]\nlap_above = \"1 cm\"\n[body]\npelvis = \"rigid\"", "`lap = \"wings\"`"),
        ("years = \"1980s\"", "\"1990s\""),
    ] {
        let said = complaint(&of(car));
        assert!(said.contains(expected), "{car}: {said}");
        assert_eq!(said.matches("error").count(), 1, "{said}");
    }
}

#[test]
fn usual_spreads_stand_about_what_the_car_says() {
    let draft = |car: &str| Draft::read(&of(car), Format::Toml, "s.toml").unwrap();
    let tall = draft("[body]\nsex = \"male\"\nstature = \"1.90 m\"\nmass = \"90 kg\"\n");
    let Some(Usual::Normal { mean_sd: [mean, sd], ends }) = tall.usual("car.seats.driver.track") else { panic!() };
    assert!((mean - 0.433 * (1.90 - 1.69)).abs() < 1e-12 && sd == 0.033 && ends[0] < mean && mean < ends[1]);
    let Some(Usual::Normal { mean_sd: [stature, _], .. }) = tall.usual("body.stature") else { panic!() };
    assert_eq!(stature, 1.757);
    assert_eq!(tall.usual("car.seats.driver.slack"), Some(Usual::Falling { mode: 0.0, to: 0.06 }));
    for path in ["car.seats.driver.limiter", "car.seats.rear_left.track", "path.speed", "occupants.a.body.mass", "car"]
    {
        assert_eq!(tall.usual(path), None, "{path}");
    }
    assert_eq!(draft("").usual("body.stature"), None);
}
