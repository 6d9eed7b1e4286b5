//! Names of topics and frames. ASCII and small letters, the same in every run of a scenario.

use std::collections::BTreeSet;

use occupant_core::body::Segment;
use occupant_core::body::joint::Joint;

/// Space: X forward, Y left, Z up; the root of all frames.
pub(crate) const SPACE_FRAME: &str = "space";
/// The vehicle: X forward, Y right, Z down, origin at its centre of gravity.
pub(crate) const VEHICLE_FRAME: &str = "vehicle";

pub(crate) const TRANSFORMS: &str = "/tf";
/// Surfaces, written once.
pub(crate) const COMPARTMENT_SCENE: &str = "/scene/compartment";
/// Limbs and trunk, written once; the transforms move them.
pub(crate) const BODY_SCENE: &str = "/scene/body";
/// Contact spheres, written once; the transforms move them.
pub(crate) const SPHERES_SCENE: &str = "/scene/spheres";
/// Belts, every frame.
pub(crate) const BELTS_SCENE: &str = "/scene/belts";
/// Contact and belt forces, every frame.
pub(crate) const FORCES_SCENE: &str = "/scene/forces";
/// Names and open sides of the surfaces, written once.
pub(crate) const LABELS_SCENE: &str = "/scene/labels";
/// Motion of the vehicle.
pub(crate) const VEHICLE: &str = "/vehicle";
/// Joint angles.
pub(crate) const JOINTS: &str = "/occupant/joints";
/// Load cells of a dummy.
pub(crate) const INSTRUMENTS: &str = "/occupant/instruments";
/// Parent of the topics of contact spheres.
pub(crate) const SPHERES: &str = "/occupant/sphere";
/// Parent of the topics of belts.
pub(crate) const BELTS: &str = "/belt";
/// The report's coordinates.
pub(crate) const REPORT_COORDINATES: &str = "/occupant/report_coordinates";
/// Energy ledger.
pub(crate) const ENERGY: &str = "/energy";
/// Integrator.
pub(crate) const SOLVER: &str = "/solver";
/// All that a run carries on from an output.
pub(crate) const CHECKPOINT: &str = "/checkpoint";
/// Warnings, first touches, the end.
pub(crate) const LOG: &str = "/log";

/// The frame of a segment: its axes, at its centre of gravity.
pub(crate) fn segment_frame(segment: Segment) -> String {
    format!("occupant/{}", segment.name())
}

/// The topic of a segment.
pub(crate) fn segment(segment: Segment) -> String {
    format!("/occupant/segment/{}", segment.name())
}

/// The topic of what a joint carries.
pub(crate) fn joint_load(joint: Joint) -> String {
    format!("/occupant/joint/{}", joint.name())
}

/// Topics below `parent` for names that a user chose, one for each, all different.
pub(crate) fn named<'a>(parent: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let mut topic = |name: &str| {
        let plain = format!("{parent}/{}", in_small_letters(name));
        let mut found = plain.clone();
        let mut number = 2;
        while !taken.insert(found.clone()) {
            found = format!("{plain}_{number}");
            number += 1;
        }
        found
    };
    names.into_iter().map(&mut topic).collect()
}

/// Letters and digits stay, in small letters; anything else becomes `_`.
fn in_small_letters(name: &str) -> String {
    let letter = |c: char| {
        if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }
    };
    name.chars().map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_different_topics() {
        let names = ["lap", "Lap", "left knee", "gurt/λ"];
        let topics = named("/belt", names);
        assert_eq!(topics, ["/belt/lap", "/belt/lap_2", "/belt/left_knee", "/belt/gurt__"]);
    }
}
