//! `[mount]`: parts of a body on a rig, against closed forms and against the same parts written the other way round.

use super::*;
use occupant_core::results::channel::{Series, matching};
use occupant_core::results::outcome::Outcome;
use occupant_core::results::summary::Summarizer;
use occupant_core::run::simulate::simulate;

const HEADER: &str = "title = \"rig\"\ntime.end = 0.5\noutput.interval = 0.001\n\
                      integrator = { kind = \"rk4\", step = \"0.25 ms\" }\n";
/// An arm and a bob on a pin, along one line.
const BOB: &str = "[body]
segments.arm = { length = 0.2, cg_from_lower_end = 0.1, mass = 2, inertia = [0.01, 0.01, 0.005] }
segments.bob = { length = 0.3, cg_from_lower_end = 0.2, mass = 4, inertia = [0.03, 0.02, 0.02] }
joints.pin = { proximal = \"arm\", distal = \"bob\", kind = \"pin\", on_proximal = [0, 0, 0.2], on_distal = [0, 0, 0] }
[joints]
pin.damping = 0
[mount]
segment = \"arm\"
roll = 180
";

/// All channels of a run and how it ended.
fn run(text: &str) -> (Series, Outcome) {
    let model = model_of(&format!("{HEADER}{text}"));
    let mut series = Series::new(matching(&model, "*"));
    let outcome = simulate(&model, &mut series).unwrap();
    (series, outcome)
}

pub(super) fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| x.abs().max(most))
}

#[test]
fn what_hangs_at_rest_pulls_by_its_weight() {
    let (series, _) = run(&format!("path = {{ kind = \"fixed\" }}\n{BOB}point = [0.05, 0, 0.1]\n"));
    let weight_n = 6.0 * 9.80665;
    for (name, expected) in [("force.x", 0.0), ("force.z", weight_n), ("moment.y", 0.05 * weight_n)] {
        let found = series.of(&format!("mount.{name}")).unwrap();
        assert!(found.iter().all(|x| (x.abs() - f64::abs(expected)).abs() < 1e-9), "{name}: {found:?}");
    }
}

/// In a frame with deceleration a, a hanging body at rest swings from the vertical to 2 atan(a/g), for any inertia.
#[test]
fn a_pendulum_in_a_frame_that_slows_down_swings_twice_as_far_as_it_would_hang() {
    let path = "path = { kind = \"pulse\", shape = \"square\", speed = 10, peak = 6, duration = 1 }\n";
    let (series, outcome) = run(&format!("{path}{BOB}"));
    let expected = 2.0 * (6.0_f64 / 9.80665).atan();
    let found = greatest(series.of("joint.pin.angle").unwrap());
    assert!((found - expected).abs() < 2e-5, "{found} for {expected}");
    // the mount's work is the vehicle's
    let (work, last) = (series.of("energy.vehicle_work").unwrap(), series.time_s.len() - 1);
    assert!(work[last] < -50.0, "{}", work[last]);
    assert!(outcome.energy.balance_error < 1e-9, "{:?}", outcome.energy);
    // and its power is F·v, here of the arm's lower end, which is where it is held
    let [force, speed] = ["mount.force.x", "arm.velocity.x"].map(|name| series.of(name).unwrap());
    let power: Vec<f64> = force.iter().zip(speed).map(|(force, speed)| force * speed).collect();
    let sum: f64 = power.windows(2).map(|p| 0.5e-3 * (p[0] + p[1])).sum();
    assert!((sum - work[last]).abs() < 1e-4 * work[last].abs(), "{sum} for {}", work[last]);
}

/// Three segments in a row, held by the last: written from either end.
fn row(is_turned: bool) -> String {
    let joint = |name: &str, (a, from): (&str, &str), (b, to): (&str, &str), rest: &str| {
        let ((p, at), (d, on)) = if is_turned { ((b, to), (a, from)) } else { ((a, from), (b, to)) };
        format!(
            "joints.{name} = {{ proximal = \"{p}\", distal = \"{d}\", on_proximal = {at}, on_distal = {on}, {rest} }}\n"
        )
    };
    let (bent, range) = if is_turned { ("-20", "[-30, 5]") } else { ("20", "[-5, 30]") };
    format!(
        "path = {{ kind = \"sensors\", columns = [\"t[s]\", \"ax[g]\", \"az[g]\", \"wy[rad/s]\", \"wz[rad/s]\"], gravity = \"removed\", \
         rows = [[0, 0, 0, 0, 0], [0.1, -12, 2, 3, 1], [0.2, 0, -2, -4, 2], [0.5, 1, 0, 0, 0]], speed = 5 }}\n[body]\n\
         segments.far = {{ length = 0.3, cg_from_lower_end = 0.2, cg_beside = [0.02, 0.01], mass = 4, inertia = [0.03, 0.02, 0.02] }}\n\
         segments.middle = {{ length = 0.2, cg_from_lower_end = 0.1, mass = 2, inertia = [0.01, 0.01, 0.005], principal_axes = [0, 20, 0] }}\n\
         segments.base = {{ length = 0.2, cg_from_lower_end = 0.1, mass = 2, inertia = [0.01, 0.01, 0.005] }}\n{}{}\
         [joints]\nepsilon = 0\nball = {{ damping = 0.3, lock = {{ stiffness = 30 }} }}\n\
         pin = {{ damping = 0.1, angle_limit = {{ range = {range}, torque = {{ c1 = 40, returned = 0.6 }} }} }}\n\
         [muscles.pin]\nstiffness = 5\ntone = 0.5\n\
         [mount]\nsegment = \"base\"\nyaw = 20\npitch = 10\nposture = {{ pin = {bent}, far = 15 }}\n",
        joint("ball", ("far", "[0.01, 0, 0]"), ("middle", "[0, 0.01, 0.2]"), "kind = \"ball\""),
        joint("pin", ("middle", "[0, 0, 0]"), ("base", "[0, 0, 0.2]"), "kind = \"pin\", axis = [0.1, 1, 0]"),
    )
}

#[test]
fn a_joint_on_the_way_to_the_mount_acts_as_one_written_the_other_way_round() {
    let [one, other] = [false, true].map(|is_turned| run(&row(is_turned)));
    let excess = greatest(one.0.of("joint.pin.excess").unwrap());
    assert!(excess > 0.05, "the limit was not reached: {excess}");
    for name in ["far.position", "far.acceleration", "middle.angular_velocity", "mount.force", "mount.moment"] {
        for axis in ["x", "y", "z"] {
            let [a, b] = [&one, &other].map(|(series, _)| series.of(&format!("{name}.{axis}")).unwrap());
            let off = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-9 * (1.0 + greatest(a)), "{name}.{axis}: {off:e}");
        }
    }
    for name in ["joint.pin.angle", "joint.pin.force.resultant", "joint.ball.moment.resultant", "muscle.pin.moment"] {
        let [a, b] = [&one, &other].map(|(series, _)| series.of(name).unwrap());
        let off = a.iter().zip(b).map(|(a, b)| (a.abs() - b.abs()).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9 * (1.0 + greatest(a)), "{name}: {off:e}");
    }
    assert!(one.1.energy.balance_error < 1e-5, "{:?}", one.1.energy);
}

/// A whole body held by a hand, with elastic limits in joints that are turned round.
#[test]
fn a_body_held_by_its_forearm_keeps_its_energy() {
    let (series, outcome) =
        run("path = { kind = \"pulse\", shape = \"half_sine\", speed = 6, delta_v = 6, duration = 0.1 }\n\
        body.preset = \"male50\"\njoints.preset = \"gebod\"\nmount = { segment = \"left_forearm\", roll = 150 }\n");
    assert!(greatest(series.of("energy.stops").unwrap()) > 1.0);
    assert!(outcome.energy.balance_error < 1e-4, "{:?}", outcome.energy);
}

#[test]
fn a_part_has_the_results_of_what_it_has() {
    let model = model_of(&format!(
        "{HEADER}path = {{ kind = \"pulse\", shape = \"half_sine\", speed = 6, delta_v = 6, duration = 0.1 }}\n\
         body = {{ preset = \"male50\", segment_count = 15 }}\njoints.preset = \"dummy50-like\"\n\
         mount = {{ segment = \"upper_torso\", without = [\"middle_torso\", \"upper_arms\"] }}\n"
    ));
    let names: Vec<&str> = model.body().tree.segment_rows().iter().map(|row| row.name).collect();
    assert_eq!(names, ["upper_torso", "neck", "head"]);
    let mut summarizer = Summarizer::new();
    simulate(&model, &mut summarizer).unwrap();
    let summary = summarizer.summary(None).unwrap();
    // what was left out does not make it another person
    assert!(summary.caveats.iter().all(|caveat| caveat.name != "other_dummy"), "{:?}", summary.caveats);
    let figures = summary.figures(&model);
    let value = |name: &str| figures.iter().find(|figure| figure.name == name).unwrap().value;
    assert!(value("hic15").is_some_and(|hic| hic > 1.0) && value("nij").is_some());
    assert_eq!((value("pelvis.peak"), value("pelvis.peak_time")), (None, None));
    assert!(matching(&model, "left_femur.*").is_empty());
}

#[test]
fn half_a_neck_says_so() {
    for (preset, segments, is_half) in
        [("gebod", 12, true), ("person", 12, true), ("person", 15, false), ("dummy50-like", 12, false)]
    {
        let model = model_of(&format!(
            "{HEADER}path = {{ kind = \"fixed\" }}\nbody = {{ preset = \"male50\", segment_count = {segments} }}\n\
             joints.preset = \"{preset}\"\nmount = {{ segment = \"upper_torso\", without = [\"middle_torso\", \"upper_arms\"] }}\n"
        ));
        let mut summarizer = Summarizer::new();
        simulate(&model, &mut summarizer).unwrap();
        let caveats = summarizer.summary(None).unwrap().caveats;
        assert_eq!(caveats.iter().any(|caveat| caveat.name == "neck_of_gebod"), is_half, "{preset} {segments}");
    }
}

/// In space, beside a moving vehicle: a released head falls by the closed form.
#[test]
fn a_mount_that_lets_go_in_space_lets_fall_in_space() {
    let (series, outcome) =
        run("path = { kind = \"pulse\", shape = \"half_sine\", speed = 6, delta_v = 6, duration = 0.1 }\n\
         body = { preset = \"male50\", segment_count = 15 }\njoints.preset = \"gebod\"\n\
         mount = { segment = \"head\", without = [\"neck\"], frame = \"space\", let_go = [1, 2, 3] }\n");
    let t = series.time_s[series.time_s.len() - 1];
    for (axis, start, expected) in [("x", 1.0, 1.0), ("y", -2.0, -2.0), ("z", -3.0, 9.80665 * t - 3.0)] {
        let speed = series.of(&format!("head.velocity.{axis}")).unwrap();
        assert!((speed[0] - start).abs() < 1e-9, "{axis}: {}", speed[0]);
        assert!((speed[speed.len() - 1] - expected).abs() < 1e-9, "{axis}: {:?}", speed.last());
    }
    assert!(outcome.energy.balance_error < 1e-9);
}

#[test]
fn what_is_wrong_with_a_mount_is_said_at_its_place() {
    let rig = "path = { kind = \"fixed\" }\nbody.preset = \"male50\"\njoints.preset = \"gebod\"\nmount.segment = \"upper_torso\"\n";
    let text = |old: &str, new: &str| {
        assert!(rig.contains(old), "{old}");
        format!("{HEADER}{}", rig.replacen(old, new, 1))
    };
    let plus = |line: &str| format!("{HEADER}{rig}{line}\n");
    let universal = "body = { segments.a = { length = 1, cg_from_lower_end = 0.5, mass = 1, inertia = [1, 1, 1] }, \
        segments.b = { length = 1, cg_from_lower_end = 0.5, mass = 1, inertia = [1, 1, 1] }, \
        joints.u = { proximal = \"a\", distal = \"b\", kind = \"universal\", on_proximal = [0, 0, 0], on_distal = [0, 0, 0] } }\n\
        joints.all.damping = 0\nmount.segment = \"b\"\n";
    for (text, expected) in [
        (text("\"upper_torso\"", "\"uper_torso\""), "did you mean \"upper_torso\""),
        (plus("mount.without = [\"legs\"]"), "no segment is named \"legs\""),
        (plus("mount.without = [\"upper_torso\"]"), "`upper_torso`, which the mount holds"),
        (plus("mount.posture.upper_torso = 3"), "no segment or pin of the posture is named \"upper_torso\""),
        (plus("mount.posture.haed = 3"), "did you mean \"head\""),
        (plus("mount.posture.head = 300"), "an angle from −180° to 180°"),
        (plus("posture.seat = \"x\""), "`mount` and `posture` together"),
        (plus("output.report_coordinates = true"), "the report's coordinates of a body of 12 segments"),
        (
            text(
                "{ kind = \"fixed\" }",
                "{ kind = \"table\", columns = [\"t[s]\", \"x[m]\"], rows = [[0, 0], [0.1, 1], [0.2, 1]], after = \"hold\", interpolation = \"linear\" }",
            ),
            "the velocity of the mount jumps by 10.000 m/s",
        ),
        (
            format!("{HEADER}path = {{ kind = \"fixed\" }}\n{universal}"),
            "the universal joint `u` on the way to the mount",
        ),
    ] {
        let problem = match load(&text).and_then(|loaded| loaded.model()) {
            Ok(_) => "nothing".to_owned(),
            Err(problems) => problems.to_string(),
        };
        assert!(problem.contains(expected), "{expected}: {problem}");
    }
}
