//! Muscles, their triggers, markers, locks and dummies' joints: what they come to, and what can be wrong with them.

use super::*;
use crate::Draft;
use occupant_core::forces::joint::limit::Limits;
use occupant_core::forces::joint::muscle::Muscle;

/// The short scenario with these changes, or its messages.
fn changed(changes: &[&str]) -> Result<Setup, String> {
    let mut draft = Draft::read(SHORT, Format::Toml, "test").unwrap();
    changes.iter().for_each(|change| draft.set(change).unwrap());
    match draft.load(&no_files).and_then(|scenario| scenario.model()) {
        Ok((model, warnings)) if warnings.to_string().is_empty() => Ok(model.setup().clone()),
        Ok((_, warnings)) => Err(warnings.to_string()),
        Err(problems) => Err(problems.to_string()),
    }
}

const NECK: &str =
    "muscles.neck={ trigger = \"go\", rise = 0.03, stiffness = 30, damping = 2, limit = 25, tone = 0.1 }";

#[test]
fn what_is_wrong_with_muscles_triggers_markers_and_locks_is_said_at_its_place() {
    let go = "triggers.go={ kind = \"time\", at = 0.05 }";
    for (changes, expected) in [
        (&[NECK][..], "no trigger is named \"go\""),
        (&[go, "muscles.nek={ tone = 1, stiffness = 3 }"], "did you mean \"neck\"?"),
        (&[go, "muscles.neck={ trigger = \"go\", stiffness = 3 }"], "`trigger` without `rise`"),
        (&[go, NECK, "muscles.neck.until=0.02"], "a muscle that relaxes at 0.02 s and begins to act at 0.05 s"),
        (&[go, "muscles.neck={ tone = 1 }"], "a muscle without stiffness, damping and torque"),
        (&[NECK, "triggers.go={ kind = \"time\", at = 9 }"], "this trigger does not fire in this run"),
        (
            &[NECK, "triggers.go={ kind = \"vehicle_acceleration\", threshold = \"900 g\" }"],
            "does not fire in this run",
        ),
        (&["markers.t1={ segment = \"torso\", place = [0, 0, 0] }"], "no segment is named \"torso\""),
        (&["markers.t1={ segment = \"head\", place = [0, 0, 0], frame = \"ground\" }"], "\"segment\""),
        (&["joints.neck.lock={}"], "has no key `stiffness`"),
        (&["joints.knees.lock={ until = 5, slips = true, relock_below = 1 }"], "only one of them"),
    ] {
        let said = changed(changes).err().unwrap_or_default();
        assert!(said.contains(expected), "{changes:?}: {said}");
    }
}

/// A half sine of 20 g within 100 ms reaches 5 g where sin(πt/T) = ¼.
#[test]
fn muscles_answer_what_the_vehicle_does() {
    let pulse = "path={ kind = \"pulse\", speed = 15, shape = \"half_sine\", peak = \"20 g\", duration = 0.1 }";
    let trigger = "triggers.go={ kind = \"vehicle_acceleration\", threshold = \"5 g\", for = \"4 ms\" }";
    let elbows = "muscles.elbows={ tone = 0.3, stiffness = 10 }";
    let setup = changed(&[pulse, trigger, NECK, "muscles.neck.reaction=0.02", elbows]).unwrap();
    let [neck, left, right] = &setup.joints.muscles[..] else { panic!("{:?}", setup.joints.muscles) };
    let fires_s = 0.1 / std::f64::consts::PI * 0.25_f64.asin() + 4e-3;
    assert!((neck.times_s[0] - fires_s - 0.02).abs() < 1e-7, "{neck:?} {fires_s}");
    assert_eq!(Muscle { joint: left.joint, ..*right }, *left);
    assert_eq!((neck.tone, neck.most_n_m, left.tone, left.stiffness_n_m), (0.1, 25.0, 0.3, 10.0));
}

fn limits<'a>(setup: &'a Setup, joint: &str) -> &'a Limits {
    setup.joints.limits.iter().find(|limits| setup.body.tree[limits.joint].name == joint).unwrap()
}

/// The middles of the corridors of 49 CFR 572 that the presets name.
#[test]
fn joints_of_dummies_carry_what_their_calibration_asks() {
    let lbf_ft = 4.4482216152605 * 0.3048;
    // necks are fitted to the pendulum itself (`mount`)
    let setup = changed(&["joints.preset=\"dummy50-like\""]).unwrap();
    let hip = &limits(&setup, "left_hip").bend.as_ref().unwrap();
    // from 90° + 15° of flexion on, counted from a centre at 45°
    let hip = |beyond: f64| {
        let excess = (90.0 - 45.0 + beyond).to_radians() - hip.angle.around(0.0).0;
        hip.stop.value(excess.max(0.0)) / lbf_ft
    };
    assert!(hip(30.0) < 70.0 && (hip(45.0) - 150.0).abs() < 1.5, "{} {}", hip(30.0), hip(45.0));
    let joints = ["upper_back", "lower_back"].map(|joint| limits(&setup, joint).lock.unwrap().stiffness);
    let moment = 40_f64.to_radians() / joints.iter().map(|stiffness| 1.0 / stiffness).sum::<f64>();
    assert!((moment / (52.0 * 15.0 / 12.0 * lbf_ft) - 1.0).abs() < 1e-3, "{moment}");
}

/// A forearm on a pin, mounted by its upper arm: load and torque of its muscle, finally at rest.
#[test]
fn a_muscle_holds_the_angle_that_it_is_told() {
    for (side, arm, muscle, expected_deg) in [
        ("left", "left_upper_arm", "tone = 1, stiffness = 30, damping = 3, hold = [0, -60, 0]", -60.0),
        ("right", "right_forearm", "tone = 1, stiffness = 30, damping = 3, hold = [0, -60, 0]", -60.0),
        (
            "left",
            "left_upper_arm",
            "tone = 0.5, stiffness = 30, damping = 6, torque = [0, -15, 0]",
            -15.0 / 30.0 / 1.0_f64.to_radians(),
        ),
        (
            "left",
            "left_forearm",
            "tone = 0.5, stiffness = 30, damping = 6, torque = [0, -15, 0]",
            -15.0 / 30.0 / 1.0_f64.to_radians(),
        ),
    ] {
        let model = model_of(&format!(
            "title = \"arm\"\ngravity = 0\ntime.end = 1.5\nintegrator = {{ kind = \"rk4\", step = 0.001 }}\n\
             path = {{ kind = \"fixed\" }}\nbody.preset = \"male50\"\njoints.all.damping = 0\n\
             mount = {{ segment = \"{arm}\", without = [\"upper_torso\"] }}\nmuscles.{side}_elbow = {{ {muscle} }}\n"
        ));
        let mut series = occupant_core::results::channel::Series::new(occupant_core::results::channel::matching(
            &model,
            "joint.*.angle",
        ));
        occupant_core::run::simulate::simulate(&model, &mut series).unwrap();
        let last = series.values[0].last().unwrap().to_degrees();
        assert!((last - expected_deg).abs() < 0.01, "{arm} {muscle}: {last}");
    }
}
