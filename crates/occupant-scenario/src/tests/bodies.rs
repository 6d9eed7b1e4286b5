//! Bodies of 15 and 17 segments, and bodies of your own.

use approx::assert_relative_eq;

use super::*;
use occupant_core::body::{Body, JointKind};

fn body_of(section: &str) -> String {
    short_with("[body]\npreset = \"male50\"", &format!("[body]\n{section}"))
}

fn names(body: &Body) -> Vec<&'static str> {
    body.tree.segment_rows().iter().map(|row| row.name).collect()
}

#[test]
fn a_preset_and_a_person_are_divided_into_fifteen_and_seventeen() {
    let fifteen = build(&body_of("preset = \"male50\"\nsegment_count = 15")).body;
    assert_eq!(&names(&fifteen)[..5], ["middle_torso", "upper_torso", "neck", "head", "lower_torso"]);
    assert_eq!((fifteen.segments.len(), fifteen.spheres.len(), fifteen.name.as_str()), (15, 17, "male50"));
    assert_relative_eq!(fifteen.mass_kg(), Body::male50().mass_kg(), max_relative = 1e-12);
    let foot = fifteen.sphere("left_foot").map(|i| &fifteen.spheres[i]).unwrap();
    assert_eq!(fifteen.tree[foot.segment].name, "left_foot");
    let head = fifteen.segment(fifteen.tree.landmarks().head.unwrap());
    assert_relative_eq!(head.principal.angle(), 36_f64.to_radians(), max_relative = 1e-12);
    let person = "sex = \"female\"\nstature = \"1.55 m\"\nmass = \"52 kg\"\nsegment_count = 17";
    let seventeen = build(&body_of(person)).body;
    assert_eq!((seventeen.segments.len(), seventeen.tree.joints().len()), (17, 16));
    assert_relative_eq!(seventeen.mass_kg(), 52.0, max_relative = 1e-12);
    // both presets of joints know the joints of these bodies
    for preset in ["male50", "gebod"] {
        let text = body_of(person).replace("preset = \"male50\"\n\n[seats", &format!("preset = {preset:?}\n\n[seats"));
        let joints = build(&text).joints;
        let named = |name| joints.tree().joint_named(name).unwrap();
        assert_eq!(joints[named("left_wrist")].ball().map(|law| law.damping_n_m_s > 0.0), Some(true));
        assert!(joints.limits.is_empty() == (preset == "male50"));
    }
}

#[test]
fn the_explicit_form_of_a_divided_body_is_the_same_body() {
    let loaded = load(&body_of("preset = \"male50\"\nsegment_count = 15\nsegments.neck.mass = \"1.2 kg\"")).unwrap();
    let first = loaded.build().unwrap().0.body;
    let again = build(&loaded.explicit().to_toml().unwrap()).body;
    assert_eq!((&again.segments, &again.places, &again.spheres), (&first.segments, &first.places, &first.spheres));
    assert!(std::ptr::eq(again.tree, first.tree));
    assert_eq!(first.segments[2].mass_kg, 1.2);
    let twelve = load(&body_of("preset = \"male50\"\nsegment_count = 12")).unwrap();
    let again = build(&twelve.explicit().to_toml().unwrap()).body;
    assert_eq!(again.segments, twelve.build().unwrap().0.body.segments);
}

#[test]
fn a_preset_takes_other_places_and_kinds_of_joints() {
    let body =
        build(&body_of("preset = \"male50\"\njoints.neck.on_distal = [0, 0, \"10 mm\"]\njoints.neck.kind = \"fixed\""))
            .body;
    let neck = body.tree.joint_named("neck").unwrap();
    assert_eq!((body.place(neck).distal.point_m.z, body.tree[neck].kind), (0.01, JointKind::Fixed));
    // what nobody changed is where it was
    let (hip, made) = (body.tree.joint_named("left_hip").unwrap(), Body::male50());
    assert_eq!(body.place(hip), made.place(made.tree.joint_named("left_hip").unwrap()));
}

/// Three segments on a pin and a ball joint.
const OWN: &str = "landmarks = { head = \"skull\", chest = \"trunk\", pelvis = \"trunk\" }
segments.trunk = { length = 0.6, cg_from_lower_end = 0.3, mass = 40, inertia = [1.5, 1.4, 0.5] }
segments.stalk = { length = 0.1, cg_from_lower_end = 0.05, mass = 1, inertia = [0.002, 0.002, 0.001] }
segments.skull = { length = 0.2, cg_from_lower_end = 0.1, cg_beside = [0.01, 0], mass = 4, inertia = [0.02, 0.02, 0.015], principal_axes = [0, -36, 0] }
joints.top = { proximal = \"stalk\", distal = \"skull\", kind = \"pin\", axis = [0, 1, 0], on_proximal = [0, 0, 0.1], on_distal = [0, 0, 0] }
joints.base = { proximal = \"trunk\", distal = \"stalk\", on_proximal = [0.02, 0, 0.6], on_distal = [0, 0, 0] }
spheres.head = { segment = \"skull\", centre = [0, 0, 0.1], radius = 0.1 }
spheres.pelvis = { segment = \"trunk\", centre = [0, 0, 0], radius = 0.1 }";

/// A scenario with a body of your own.
fn own(body: &str) -> String {
    let posture = "middle_torso = 15\nupper_torso = 18\nhead = 5\nlower_torso = 20\nupper_arms = 35\nelbows = -60\nheels = [0.69, 0.33]";
    let text = body_of(body);
    assert!(text.contains(posture));
    text.replace(posture, "trunk = 10\ntop = -5")
}

#[test]
fn a_body_of_ones_own_hangs_together_whatever_the_order_of_its_joints() {
    let setup = build(&own(OWN));
    let body = &setup.body;
    assert_eq!(names(body), ["trunk", "stalk", "skull"]);
    let marks = body.tree.landmarks();
    assert_eq!((body.tree[marks.head.unwrap()].name, body.tree[marks.neck.unwrap()].name), ("skull", "top"));
    assert_eq!((body.segments[2].cg_m().x, body.segments[2].cg_m().z), (0.01, 0.1));
    assert_eq!(body.joint_m(body.tree.segment(0)).z, 0.6);
    assert_eq!(body.sphere("pelvis"), Some(1));
    assert!(setup.joints[marks.neck.unwrap()].hinge().is_some_and(|law| law.damping_n_m_s > 0.0));
}

#[test]
fn what_is_wrong_with_a_body_of_ones_own_is_said_at_its_place() {
    for (old, new, expected) in [
        ("distal = \"stalk\"", "distal = \"stilk\"", "no segment is named \"stilk\""),
        ("distal = \"stalk\"", "distal = \"skull\"", "segment `skull` already has a parent joint, `top`"),
        ("proximal = \"trunk\", distal = \"stalk\"", "distal = \"stalk\"", "`body.joints.base` has no key `proximal`"),
        ("proximal = \"trunk\"", "proximal = \"skull\"", "joints that form a loop, or hang on one: `top`, `base`"),
        (
            "segments.stalk",
            "segments.tail = { length = 1 }\nsegments.stalk",
            "neither `trunk` nor `tail` has a parent joint",
        ),
        ("head = \"skull\"", "head = \"skul\"", "no segment for the landmark `head`"),
        ("on_distal = [0, 0, 0] }\njoints.base", "}\njoints.base", "has no key `on_distal`"),
        ("axis = [0, 1, 0]", "axis = [0, 0, 0]", "the axis of a pin, not [0, 0, 0]"),
        ("kind = \"pin\"", "kind = \"pins\"", "did you mean \"pin\""),
        ("segment = \"skull\"", "segment = \"skulls\"", "no segment is named \"skulls\""),
    ] {
        assert!(OWN.contains(old), "{old}");
        let problem = complaint(&own(&OWN.replacen(old, new, 1)));
        assert!(problem.contains(expected), "{new}: {problem}");
        assert!(problem.contains("--> s.toml"), "{new}: {problem}");
    }
    let many: String = (0..20)
        .map(|i| {
            format!("segments.s{i} = {{ length = 1 }}\njoints.j{i} = {{ proximal = \"trunk\", distal = \"s{i}\" }}\n")
        })
        .collect();
    let problem = complaint(&own(&format!("{many}{OWN}")));
    assert!(problem.contains("23 segments with 1 axes"), "{problem}");
    let twice = complaint(&own(&format!("{OWN}\nsegments.skull = {{ length = 1 }}")));
    assert!(twice.contains("duplicate key") || twice.contains("twice"), "{twice}");
}

#[test]
fn names_that_a_body_does_not_know_are_refused() {
    for (old, new, expected) in [
        (
            "[body]\npreset = \"male50\"",
            "[body]\npreset = \"male50\"\nsegments.neck.mass = 1",
            "no segment is named \"neck\"",
        ),
        (
            "[joints]\npreset = \"male50\"",
            "[joints]\npreset = \"male50\"\nankles.damping = 1",
            "no joint is named \"ankles\"",
        ),
        ("upper_arms = ", "left_foot = 1\nupper_arms = ", "is named \"left_foot\""),
        ("head = 5", "haed = 5", "did you mean \"head\""),
        ("head = 5", "haed = 5", "`posture` has no key `head`"),
        ("[body]\npreset = \"male50\"", "[body]\npreset = \"male50\"\nsegment_count = 14", "14 segments"),
        ("[body]\npreset = \"male50\"", "[body]\npreset = \"male50-1970\"\nsegment_count = 15", "male50-1970 in 15"),
        ("[body]\npreset = \"male50\"", "[body]\nsegment_count = 15", "`segment_count` in a body with its own joints"),
    ] {
        let problem = complaint(&short_with(old, new));
        assert!(problem.contains(expected), "{new}: {problem}");
    }
}

#[test]
fn dummies_are_told_from_people() {
    let body = "[body]\npreset = \"male50\"";
    let single = |new: &str| load(&short_with(body, new)).unwrap_or_else(|e| panic!("{e}")).dummies();
    for person in ["", "\nchest = \"person\"", "\nsides = \"person\"\nsphere_set = \"even\""] {
        assert!(single(&format!("{body}{person}")).is_empty(), "{person}");
    }
    for dummy in ["\nchest = \"dummy50\"", "\nsides = \"es2\"\nsphere_set = \"even\""] {
        assert_eq!(single(&format!("{body}{dummy}")), [""], "{dummy}");
    }
    assert_eq!(single("[body]\ndummy = \"hybrid2-like\""), [""]);
    let joints = short_with("[joints]\npreset = \"male50\"", "[joints]\npreset = \"dummy50-like\"");
    assert_eq!(load(&joints).unwrap_or_else(|e| panic!("{e}")).dummies(), [""]);
    let several = "title = \"t\"\ntime.end = \"0.1 s\"\npath = { kind = \"pulse\", shape = \"half_sine\", speed = \"30 km/h\", delta_v = \"30 km/h\", duration = \"0.1 s\" }\n\
                   [car]\nclass = \"van\"\n[occupants.driver]\n[occupants.passenger]\nbody = { dummy = \"hybrid3_5f-like\" }\n";
    assert_eq!(load(several).unwrap_or_else(|e| panic!("{e}")).dummies(), ["passenger"]);
}
