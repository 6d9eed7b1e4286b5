//! What the words come to: precedence, defaults, outlines, warnings.

use approx::assert_relative_eq;
use nalgebra::{Point3, Vector3};

use super::{build, complaint, load, short_with};
use occupant_core::body::{Body, Sex, tti12};
use occupant_core::forces::contact::material::{DEFAULT_FRICTION_SPEED_M_S, Memory};
use occupant_core::forces::contact::surface::{Facing, Frame, Outline};
use occupant_core::model::seating::{InitialPosture, InitialVelocity};
use occupant_core::model::setup::{Integrator, STANDARD_GRAVITY_M_S2};

const JOINTS: &str = "[joints]\npreset = \"male50\"";

#[test]
fn what_is_said_of_fewer_joints_wins() {
    let setup = build(&short_with(
        JOINTS,
        "[joints]
preset = \"male50\"
all.damping = 1
shoulders = { damping = 2, twist_damping = 0.1 }
left_shoulder.damping = 3
neck.set = \"stiff\"
knees = { set = \"stiff\", damping = 5 }
[joint_sets.stiff]
damping = 4",
    ));
    let j = &setup.joints;
    assert_eq!(j[tti12::LEFT_HIP].ball().unwrap().damping_n_m_s, 1.0);
    assert_eq!(j[tti12::RIGHT_SHOULDER].ball().unwrap().damping_n_m_s, 2.0);
    assert_eq!(j[tti12::LEFT_SHOULDER].ball().unwrap().damping_n_m_s, 3.0);
    assert_eq!(j[tti12::LEFT_SHOULDER].ball().unwrap().twist_damping_n_m_s, 0.1);
    assert_eq!(j[tti12::NECK].ball().unwrap().damping_n_m_s, 4.0);
    assert_eq!(j[tti12::LEFT_KNEE].hinge().unwrap().damping_n_m_s, 5.0);
    // What nobody spoke of comes from the preset.
    assert_relative_eq!(
        j[tti12::NECK].ball().unwrap().stop.unwrap().begin_rad,
        45f64.to_radians(),
        max_relative = 1e-15
    );
    assert_relative_eq!(
        j[tti12::UPPER_BACK].ball().unwrap().spring.unwrap().stiffness_n_m,
        112.9848290276167,
        max_relative = 1e-14
    );
}

#[test]
fn all_gives_each_kind_of_joint_what_it_can_have() {
    let setup = build(&short_with(
        JOINTS,
        "[joints]
epsilon = 0
all = { damping = 1, twist_damping = 0.2, stop = { begin = 50, full = 60, damping = 9 } }",
    ));
    assert_eq!(setup.joints.epsilon, 0.0);
    assert_eq!(setup.joints[tti12::LEFT_HIP].ball().unwrap().twist_damping_n_m_s, 0.2);
    assert_relative_eq!(setup.joints[tti12::LEFT_HIP].ball().unwrap().stop.unwrap().full_rad, 60f64.to_radians());
    assert_eq!(setup.joints[tti12::LEFT_KNEE].hinge().unwrap().damping_n_m_s, 1.0);
    assert!(setup.joints[tti12::LEFT_KNEE].hinge().unwrap().upper_stop.is_none());
}

#[test]
fn defaults_are_those_of_the_description() {
    let setup = build(super::SHORT);
    assert_eq!(setup.gravity_m_s2, STANDARD_GRAVITY_M_S2);
    let adaptive = Integrator::Adaptive {
        relative: 1e-6,
        absolute_m: 0.1 * 1e-6,
        absolute_m_s: 10.0 * 1e-6,
        min_step_s: 1e-10,
        max_step_s: 5e-4,
    };
    assert_eq!(setup.integrator, adaptive);
    assert_eq!((setup.time.start_s, setup.time.end_s, setup.time.output_s), (0.0, 0.15, 1e-3));
    assert_eq!(setup.velocity, InitialVelocity::WithVehicle);
    assert!(!setup.output.report_coordinates);
    let foam = &setup.materials[0];
    assert_eq!(foam.friction_speed_m_s, DEFAULT_FRICTION_SPEED_M_S);
    assert_eq!(foam.memory, Memory::Reset);
    // Linear without a break, one returned fraction for both ranges.
    let spring = foam.force.bilinear().unwrap();
    assert_eq!(spring.k2_n_per_m, spring.k1_n_per_m);
    assert_eq!(spring.returned_2, 0.5);
}

#[test]
fn spheres_know_their_place_and_can_be_moved_removed_and_added() {
    let setup = build(&short_with(
        "[body]\npreset = \"male50\"",
        "[body]
preset = \"male50\"
[body.spheres]
hands.remove = true
head = { centre = [0.02, 0, 0.2] }
nose = { segment = \"head\", centre = [0.1, 0, 0.18], radius = \"1 cm\" }",
    ));
    let names: Vec<&str> = setup.body.spheres.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names.len(), 16);
    assert_eq!((names[0], names[15]), ("head", "nose"));
    assert_eq!(setup.body.spheres[0].centre_from_lower_end_m, Point3::new(0.02, 0.0, 0.2));
    assert_relative_eq!(setup.body.spheres[0].radius_m, 3.9 * 0.0254, max_relative = 1e-15);
    let pelvis = &setup.body.spheres[setup.body.sphere("pelvis").unwrap()];
    assert_eq!(pelvis.centre_from_lower_end_m, Point3::origin());
}

#[test]
fn outlines_have_their_corners() {
    let setup = build(&short_with(
        "[surfaces]",
        "[surfaces]
trapezoid = { material = \"foam\", edge = [[0, 1], [2, 1]], y = 0.5, half_width = 1, end_half_width = 0.5 }
wheel = { material = \"foam\", disc = { centre = [1, 0, 0], diameter = 0.4, tilt = 30 } }
ground = { material = \"foam\", frame = \"space\", plane = { point = [0, 0, -1], normal = [0, 0, 2] }, spheres = [\"head\"] }
pane = { material = \"foam\", points = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], facing = \"order\" }",
    ));
    let corner = Point3::new;
    assert_eq!(
        setup.surfaces[0].outline,
        Outline::Polygon(vec![
            corner(0.0, -0.5, 1.0),
            corner(0.0, 1.5, 1.0),
            corner(2.0, 1.0, 1.0),
            corner(2.0, 0.0, 1.0)
        ])
    );
    assert_eq!(setup.surfaces[0].facing, Facing::Towards(corner(0.1, 0.0, -0.3)));
    let Outline::Disc { axis, radius_m, .. } = &setup.surfaces[1].outline else { panic!("no disc") };
    // Rearward and up.
    let expected = Vector3::new(-(0.75f64.sqrt()), 0.0, -0.5);
    assert_relative_eq!(*axis, expected, max_relative = 1e-15);
    assert_eq!(*radius_m, 0.2);
    // A point inside the vehicle says nothing about space.
    assert_eq!((setup.surfaces[2].frame, setup.surfaces[2].facing), (Frame::Space, Facing::Order));
    assert_eq!(setup.surfaces[2].spheres, Some(vec![0]));
    assert_eq!(setup.surfaces[3].facing, Facing::Order);
}

#[test]
fn an_exact_state_replaces_the_posture() {
    let posture = super::SHORT.split("[posture]").nth(1).unwrap().split("[belts").next().unwrap();
    let numbers = |x: f64| (0..31).map(|_| x.to_string()).collect::<Vec<_>>().join(", ");
    let text = super::SHORT.replace(
        &format!("[posture]{posture}"),
        &format!("[initial_state]\nq = [{}]\nrates = [{}]\n\n", numbers(0.5), numbers(2.0)),
    );
    let in_metres = build(&text);
    let in_inches = build(&text.replace("title", "units = \"in-lbf-s\"\ntitle"));
    let InitialPosture::Coordinates(metres) = &in_metres.posture else { panic!("no coordinates") };
    let InitialPosture::Coordinates(inches) = &in_inches.posture else { panic!("no coordinates") };
    assert_eq!((metres.q[0], metres.q[5], metres.rates[1]), (0.5, 0.5, 2.0));
    assert_eq!((inches.q[0], inches.q[5], inches.rates[1]), (0.0127, 0.5, 0.0508));
    let with_passed = |pairs: &str| text.replace("rates =", &format!("passed = {pairs}\nrates ="));
    let continued = build(&with_passed(r#"[["left_hand", "cushion"]]"#));
    let InitialPosture::Continued { passed, .. } = &continued.posture else { panic!("no pairs") };
    let [(sphere, surface)] = passed.as_slice() else { panic!("{passed:?}") };
    assert_eq!(continued.body.spheres[*sphere].name, "left_hand");
    assert_eq!(continued.surfaces[*surface].name, "cushion");
    let wrong = complaint(&with_passed(r#"[["left_hand", "cushon"]]"#));
    assert!(wrong.contains("no surface is named \"cushon\""), "{wrong}");
    let never =
        with_passed(r#"[["left_hand", "cushion"]]"#).replace("cushion = {", "cushion = { spheres = [\"pelvis\"],");
    let wrong = complaint(&never);
    assert!(wrong.contains("`left_hand` cannot have passed `cushion`"), "{wrong}");
}

#[test]
fn velocities_at_the_start() {
    let posture = |line: &str| short_with("heels =", &format!("{line}\nheels ="));
    assert_eq!(build(&posture("moves_with_vehicle = false")).velocity, InitialVelocity::VehicleOrigin);
    assert_eq!(
        build(&posture("velocity = [\"36 km/h\", 0, 1]")).velocity,
        InitialVelocity::Given(Vector3::new(10.0, 0.0, 1.0))
    );
    let both = posture("moves_with_vehicle = true\nvelocity = [1, 0, 0]");
    assert!(complaint(&both).contains("`moves_with_vehicle` and `velocity` together"));
}

#[test]
fn slips_of_units_are_warned_of() {
    let warnings = |text: &str| load(text).unwrap().build().unwrap().1.to_string();
    assert_eq!(warnings(super::SHORT), "");
    let text = short_with("inside", "gravity = 32.17\ninside")
        .replace("\"70 kN/m\"", "400")
        .replace("heels = [0.69, 0.33]", "heels = [27, 13]")
        .replace("end = \"150 ms\"", "end = 150")
        .replace("middle_torso = 15", "middle_torso = 0.26")
        .replace("upper_torso = 18", "upper_torso = 0.31")
        .replace("head = 5", "head = 0.09")
        .replace("lower_torso = 20", "lower_torso = 0.35")
        .replace("upper_arms = 35", "upper_arms = 0.61")
        .replace("elbows = -60", "elbows = -1.05");
    let problems = load(&text).unwrap().build().unwrap().1;
    let found: Vec<&str> = problems.iter().map(|d| d.problem.found.as_str()).collect();
    assert_eq!(
        found,
        [
            "32.17 m/s² is unusual for gravity on earth",
            "150 s is unusual for the duration of a crash",
            "400 N/m is unusual for the stiffness of a part of a car",
            "27 m is unusual for a position in a vehicle, as are 1 more",
            "all angles of the posture are below 3.2°, as if in radians",
        ]
    );
}

#[test]
fn what_no_person_and_no_vehicle_does_is_said() {
    let belt = |y: &str| {
        let belt = |name, y| {
            format!(
                "{name} = {{ sphere = \"{name}\", anchors = [[-0.11, {y}, 0.05], [-0.25, 0.3, 0.2]], k1 = 60000 }}\n"
            )
        };
        format!("[belts]\n{}{}[body]", belt("pelvis", "-0.3"), belt("chest", y))
    };
    let spike = "kind = \"table\"\ninterpolation = \"linear\"\ncolumns = [\"t[s]\", \"x[m]\"]\n\
        rows = [[0, 0], [0.1004, 1], [0.1005, 1.1], [0.2, 2]]";
    let rows =
        |x: &str| format!("kind = \"table\"\ncolumns = [\"t[s]\", \"x[m]\"]\nrows = [[0, 0], [0.1, {x}], [0.2, 2]]");
    for (old, new, said) in [
        ("head = 5", "head = 180".to_owned(), "warning: 180 ° is unusual for the lean of a head"),
        ("head = 5", "head = 1e9".to_owned(), "error: 1000000000"),
        ("head = 5", "head = -59".to_owned(), "warning: 77.0° at the start, beyond its stop, which is full at 60.0°"),
        (
            "middle_torso = 15",
            "middle_torso = -90".to_owned(),
            "warning: -90 ° is unusual for the lean of a person who sits",
        ),
        ("elbows = -60", "elbows = 90".to_owned(), "warning: 90 ° is unusual for the angle of elbows"),
        (
            "[body]",
            "[body]\nsegments.head.mass = 1e-6\n".to_owned(),
            "warning: 0.000001 kg with these moments of inertia",
        ),
        ("friction = 0.8", "friction = 1e6".to_owned(), "warning: 1000000 is unusual for a coefficient of friction"),
        ("[body]", belt("-0.3"), ""),
        ("[body]", belt("0.0"), "warning: anchor 1 lies 0."),
        ("[-0.15, -0.23, 0.23]", "[0.08, -0.1, 0.03]".to_owned(), "of the sphere left_thigh of radius 0."),
        ("k1 = \"70 kN/m\"", "k1 = \"70 kN/m\"\nlength = 0.9".to_owned(), ""),
        ("k1 = \"70 kN/m\"", "k1 = \"70 kN/m\"\nlength = 0.75".to_owned(), "warning: the belt is 75 mm too short"),
        ("k1 = \"70 kN/m\"", "k1 = \"70 kN/m\"\nlength = 1.2".to_owned(), "warning: the belt has 0.38 m of slack"),
        (super::tables::PULSE, rows("1"), ""),
        (super::tables::PULSE, rows("20"), "warning: the vehicle's speed is "),
        (super::tables::PULSE, rows("20"), "warning: the vehicle's acceleration is "),
        (super::tables::PULSE, rows("1e7"), "error: the vehicle's speed is "),
        (super::tables::PULSE, spike.to_owned(), "warning: the vehicle's speed is 1.000e3 m/s at t = 0.1004"),
        (super::tables::PULSE, rows("1e12"), "error: station 2: found x = 1000000000000"),
    ] {
        let found = match load(&short_with(old, &new)).and_then(|loaded| loaded.model()) {
            Ok((_, warnings)) => warnings.to_string(),
            Err(problems) => problems.to_string(),
        };
        assert!(if said.is_empty() { found.is_empty() } else { found.contains(said) }, "{new}: {found}");
    }
}

#[test]
fn provenance_of_nothing_is_warned_of() {
    let text =
        short_with("[body]", "[provenance]\n\"materials.foan.k1\" = \"a guess\"\n\"the pulse\" = \"sled\"\n[body]");
    let warnings = load(&text).unwrap().build().unwrap().1;
    // The nearest part that exists is `materials`, so the path leads somewhere; a wrong section leads nowhere.
    assert!(warnings.is_empty(), "{warnings}");
    let text = short_with("[body]", "[provenance]\n\"material.foam.k1\" = \"a guess\"\n[body]");
    let warnings = load(&text).unwrap().build().unwrap().1;
    assert_eq!(
        warnings.to_string(),
        "warning: `material.foam.k1` is not part of the scenario
  --> s.toml:13:22
   |
13 | \"material.foam.k1\" = \"a guess\"
   |                      ^^^^^^^^^
   = in: provenance.\"material.foam.k1\"
   = expected: a path such as materials.seat, or a topic in words"
    );
}

/// A body section instead of the preset.
fn body_of(section: &str) -> String {
    short_with("[body]\npreset = \"male50\"", section)
}

#[test]
fn a_person_is_made_by_sex_stature_and_mass_or_by_changing_another() {
    let own = build(&body_of("[body]\nsex = \"female\"\nstature = \"1.55 m\"\nmass = \"52 kg\"")).body;
    let made = Body::person(Sex::Female, 1.55, 52.0).unwrap();
    assert_eq!(own.segments, made.segments);
    assert_eq!((own.spheres, own.neck_height_m), (made.spheres, made.neck_height_m));
    let heavier = build(&body_of("[body]\npreset = \"female05\"\nmass = \"52 kg\"\nneck_height = \"80 mm\"")).body;
    assert_eq!(heavier.segments, Body::person(Sex::Female, 1.511, 52.0).unwrap().segments);
    assert_eq!(heavier.neck_height_m, 0.08);
    assert_eq!(build(&body_of("[body]\npreset = \"male50\"")).body.segments, Body::male50().segments);
    for (preset, mass_kg) in [("female50", 59.3), ("male95", 97.52), ("child06", 21.45), ("child10", 37.24)] {
        let body = build(&body_of(&format!("[body]\npreset = \"{preset}\""))).body;
        assert_relative_eq!(body.mass_kg(), mass_kg, max_relative = 5e-4);
        assert_eq!(body.name, preset);
    }
}

#[test]
fn the_body_of_1970_has_its_neck_at_the_shoulders() {
    let body = build(&body_of("[body]\npreset = \"male50-1970\"")).body;
    assert_eq!(body.neck_height_m, 0.0);
    assert_relative_eq!(body.segments[2].length_m, 13.71 * 0.0254, max_relative = 1e-15);
}

#[test]
fn a_person_that_cannot_be_made_is_refused_with_the_reason() {
    for (section, expected) in [
        ("sex = \"female\"\nmass = \"52 kg\"", "`body` has no key `stature`"),
        ("stature = \"1.6 m\"\nmass = \"52 kg\"", "`body` has no key `sex`"),
        ("preset = \"child06\"\nmass = \"25 kg\"", "the preset child06 has one size"),
        ("preset = \"male50-1970\"\nstature = \"1.8 m\"", "the preset male50-1970 has one size"),
        ("preset = \"male50\"\nstature = \"0.9 m\"", "an adult of 1.4 to 2.05 m"),
    ] {
        let problem = complaint(&body_of(&format!("[body]\n{section}")));
        assert!(problem.contains(expected), "{section}: {problem}");
        assert_eq!(problem.matches("error").count(), 1, "{section}: {problem}");
    }
}
