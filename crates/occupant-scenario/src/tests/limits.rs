//! Elastic limits and dry friction of joints: what can be wrong with them, and what a change leaves of a preset.

use super::*;
use crate::Draft;
use occupant_core::body::Joint;
use occupant_core::body::tti12::*;
use occupant_core::forces::joint::limit::{Centre, Stop};
use occupant_core::results::channel::{Series, matching};
use occupant_core::run::simulate::simulate;

/// Problems of the short scenario with the joints of GEBOD and this change.
fn said(change: &str) -> String {
    let mut draft = Draft::read(SHORT, Format::Toml, "test").unwrap();
    draft.set("joints.preset=\"gebod\"").unwrap();
    draft.set(change).unwrap();
    match draft.load(&no_files).and_then(|scenario| scenario.model()) {
        Ok((_, warnings)) => warnings.to_string(),
        Err(problems) => problems.to_string(),
    }
}

#[test]
fn what_is_wrong_with_a_limit_is_said_at_its_place() {
    let four = "azimuths = [0, 90, 180, 270], angles = [60, 40, 70, 50]";
    for (change, expected) in [
        ("neck.limit.angle=0.3", "limits from 0.3° to 0.3°"),
        ("neck.limit.angle=160", "0.5° to 150° everywhere, beside a limit of twist"),
        ("neck.twist_limit.range=[-160, 160]", "two angles that rise, from −150° to 150°"),
        ("neck.limit={ azimuths = [0, 90, 180, 270], angles = [3, 9, 9, 9] }", "5° to 150° everywhere"),
        ("neck.limit={ angle = 10, azimuths = [0, 90, 180, 270] }", "together"),
        ("hips.limit={ angles = [60, 60, 60, 60] }", "azimuths = [0, 90, 180, 270] go with 4 angles"),
        ("hips.limit={ azimuths = [0, 90, 180], angles = [60, 60, 60] }", "four or more increasing azimuths"),
        ("hips.limit={ azimuths = [0, 90, 80, 270], angles = [60, 60, 60, 60] }", "four or more increasing azimuths"),
        ("neck.limit.torque={ angles = [0, 10], moments = [1, 5] }", "the first 0"),
        ("neck.limit.torque={ angles = [0, 10, 20], moments = [0, 5, 4] }", "a torque that falls somewhere"),
        ("neck.limit.torque={ c1 = 1, angles = [0, 10], moments = [0, 5] }", "coefficients and points of one torque"),
        ("neck.limit.torque.c2=0", "no torque at all"),
        ("neck.limit.torque.returned=0", "0, taken as 0.01"),
        ("neck.centre={ axis = [0, 0, 1], forward = [0, 0, 2] }", "along one line"),
        ("neck.angle_limit={ range = [0, 1] }", "`angle_limit` of a ball joint"),
        ("knees.limit={ angle = 20 }", "`limit` of a hinge"),
        ("neck.stop={ begin = 45, full = 60, damping = 1 }", "a viscous stop and an elastic limit in one joint"),
        ("knees.angle_limit.range=[0, 20]", "beyond its elastic limit at the start"),
        (&format!("neck.limit={{ {four} }}"), "differ to the left and to the right"),
    ] {
        let found = said(&format!("joints.{change}"));
        assert!(found.contains(expected), "{change}: {found}");
    }
    let none = short_with("preset = \"male50\"\n\n[seats", "preset = \"male50\"\nneck.limit = {}\n\n[seats");
    let found = complaint(&none);
    assert!(found.contains("has no key `angle`") && found.contains("has no key `torque`"), "{found}");
}

#[test]
fn a_change_leaves_the_rest_of_a_presets_limit() {
    for change in [
        "elbows.friction.torque=\"2 N m\"",
        "neck.limit.angle=\"30 deg\"",
        "neck.limit={ azimuths = [0, 90, 180, 270], angles = [60, 45, 70, 45] }",
        "hips.limit.torque={ angles = [0, 10], moments = [0, 20] }",
        "*.limit.torque.returned=0.5",
    ] {
        assert_eq!(said(&format!("joints.{change}")), "", "{change}");
    }
}

/// A bob on a ball joint whose axes are turned on both of its segments.
fn bob(axes: &str, lean_deg: f64) -> String {
    format!(
        "title = \"bob\"\ntime.end = 0.5\nintegrator = {{ kind = \"rk4\", step = 0.0001 }}\npath = {{ kind = \"fixed\" }}\n\
         mount = {{ segment = \"arm\", posture = {{ bob = {lean_deg:?} }} }}\n[body]\n\
         segments.arm = {{ length = 0.2, cg_from_lower_end = 0.1, mass = 2, inertia = [0.01, 0.01, 0.005] }}\n\
         segments.bob = {{ length = 0.3, cg_from_lower_end = 0.2, mass = 4, inertia = [0.03, 0.02, 0.02] }}\n\
         joints.ball = {{ proximal = \"arm\", distal = \"bob\", on_proximal = [0, 0, 0.2], on_distal = [0, 0, 0], {axes} }}\n\
         [joints.ball]\ndamping = 0\n\
         limit = {{ azimuths = [0, 90, 180, 270], angles = [15, 10, 25, 20], torque = {{ c1 = 60, returned = 1 }} }}\n\
         twist_limit = {{ range = [-5, 10], torque = {{ c1 = 20, returned = 1 }} }}\n"
    )
}

#[test]
fn limits_are_about_the_axes_of_the_joint() {
    let of = |axes: &str, lean_deg: f64| {
        let model = model_of(&bob(axes, lean_deg));
        let mut series = Series::new(matching(&model, "joint.ball.*"));
        let balance = simulate(&model, &mut series).unwrap().energy.balance_error;
        let value = |name: &str| series.of(&format!("joint.ball.{name}")).unwrap();
        assert!(value("excess").iter().any(|x| *x > 0.1) && balance < 1e-6, "{axes}: {balance:e}");
        ["bend", "azimuth"].map(|name| value(name)[0].to_degrees())
    };
    // (axes, lean of the bob) → bend from the joint's centre axis and its direction: back is 180°, forward 0°, left 90°
    for (axes, lean_deg, bend, azimuth) in [
        ("kind = \"ball\"", -4.0, 4.0, 0.0),
        ("axes_on_proximal = [0, 20, 0], axes_on_distal = [0, 20, 0]", -4.0, 4.0, 0.0),
        ("axes_on_proximal = [0, 20, 0]", -4.0, 16.0, 180.0),
        ("axes_on_distal = [0, 20, 0]", -4.0, 24.0, 0.0),
        ("axes_on_proximal = [90, 0, 0], axes_on_distal = [90, 0, 0]", -4.0, 4.0, -90.0),
    ] {
        let found = of(axes, lean_deg);
        assert!((found[0] - bend).abs() < 1e-9, "{axes}: {found:?}");
        // 180° and −180° are one direction
        let off = (found[1] - azimuth).to_radians().sin().abs();
        assert!(off < 1e-8 && (found[1].abs() - f64::abs(azimuth)).abs() < 1e-6, "{axes}: {found:?}");
    }
}

/// (coefficient in in·lbf/deg², limit in degrees) of bend and of twist, pitch of the centre in degrees.
type Row = (Joint, (f64, f64), (f64, f64), f64);

#[test]
fn the_preset_is_gebods_table() {
    let model = model_of(&format!(
        "title = \"t\"\ntime = {{ end = 0.01 }}\npath = {{ kind = \"fixed\" }}\nbody = {{ preset = \"male50\" }}\n\
         joints = {{ preset = \"gebod\" }}\ninitial_state = {{ q = [{}], rates = [{}] }}\n",
        ["0.0"; 31].join(", "),
        ["0.0"; 31].join(", ")
    ));
    let joints = &model.setup().joints;
    let unit = 4.4482216152605 * 0.0254;
    let limits = |joint: Joint| joints.limits.iter().find(|limits| limits.joint == joint).unwrap();
    let is = |stop: &Stop<f64>, coefficient: f64| {
        let torque = stop.value(12_f64.to_radians());
        let [_, back, lost] = stop.returned_to(1.0);
        assert!(
            (torque - coefficient * 144.0 * unit).abs() < 1e-9 * torque && (back / (back + lost) - 0.7).abs() < 1e-12
        );
    };
    let rows: [Row; 5] = [
        (LOWER_BACK, (10.0, 20.0), (10.0, 5.0), 5.0),
        (UPPER_BACK, (10.0, 20.0), (10.0, 35.0), 5.0),
        (NECK, (5.0, 25.0), (10.0, 35.0), 10.0),
        (LEFT_HIP, (10.0, 70.0), (0.8, 40.0), -45.0),
        (RIGHT_SHOULDER, (10.0, 122.5), (10.0, 65.0), -4.1),
    ];
    for (joint, bend, twist, pitch) in rows {
        let found = limits(joint);
        let (bend_limit, turn) = (found.bend.as_ref().unwrap(), found.turn.as_ref().unwrap());
        assert!((bend_limit.angle.around(1.0).0.to_degrees() - bend.1).abs() < 1e-12);
        assert!((turn.range[1].to_degrees() - twist.1).abs() < 1e-12 && turn.range[0] == -turn.range[1]);
        is(&bend_limit.stop, bend.0);
        is(&turn.stop, twist.0);
        let Centre::Pitch { pitch_rad } = found.centre else { panic!("{found:?}") };
        assert!((pitch_rad.to_degrees() - pitch).abs() < 1e-12);
    }
    for (joint, range) in [(LEFT_KNEE, [0.0, 120.0]), (RIGHT_ELBOW, [-140.0, 0.0])] {
        let turn = limits(joint).turn.as_ref().unwrap();
        assert!(turn.range.iter().zip(range).all(|(a, b)| (a.to_degrees() - b).abs() < 1e-12));
        is(&turn.stop, 1.8);
    }
    for (_, law) in joints.iter() {
        let damping = law.ball().map_or_else(|| law.hinge().unwrap().damping_n_m_s, |ball| ball.damping_n_m_s);
        assert!((damping - 0.1 * unit * 180.0 / std::f64::consts::PI).abs() < 1e-12);
    }
}
