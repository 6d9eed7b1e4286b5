//! Elastic limits and dry friction of joints: what can be wrong with them, and what a change leaves of a preset.

use super::*;
use crate::scenario::Draft;

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
        ("neck.limit.angle=3", "limits from 3.0° to 3.0°"),
        ("neck.limit.angle=160", "5° to 150° everywhere, beside a limit of twist"),
        ("neck.twist_limit.range=[-160, 160]", "two angles that rise, from −150° to 150°"),
        ("hips.limit={ azimuths = [0, 90, 180], angles = [60, 60, 60] }", "four or more azimuths"),
        ("hips.limit={ azimuths = [0, 90, 80, 270], angles = [60, 60, 60, 60] }", "four or more azimuths"),
        ("neck.limit.torque={ angles = [0, 10], moments = [1, 5] }", "the first 0"),
        ("neck.limit.torque={ angles = [0, 10, 20], moments = [0, 5, 4] }", "a torque that falls somewhere"),
        ("neck.limit.torque={ c1 = 1, angles = [0, 10], moments = [0, 5] }", "coefficients and points of one torque"),
        ("neck.limit.torque.c2=0", "no torque at all"),
        ("neck.limit.torque.returned=0", "0, which counts as 0.01"),
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
