//! Names of frames, and of the topics that are not results of the catalogue. ASCII and small letters, the same in every run of a scenario.

/// Space: X forward, Y left, Z up; the root of all frames.
pub const SPACE_FRAME: &str = "space";
/// The vehicle: X forward, Y right, Z down, origin at its centre of gravity.
pub const VEHICLE_FRAME: &str = "vehicle";

/// Poses of segments and vehicles.
pub const TRANSFORMS: &str = "/tf";
/// Surfaces, written once.
pub const COMPARTMENT_SCENE: &str = "/scene/compartment";
/// Limbs and trunk, written once; the transforms move them.
pub const BODY_SCENE: &str = "/scene/body";
/// Contact spheres, written once; the transforms move them.
pub const SPHERES_SCENE: &str = "/scene/spheres";
/// Lines of force elements, every frame.
pub const LINES_SCENE: &str = "/scene/belts";
/// Forces on the body, every frame.
pub const FORCES_SCENE: &str = "/scene/forces";
/// Names and open sides of the surfaces, written once.
pub const LABELS_SCENE: &str = "/scene/labels";
/// Warnings, first contacts, the end.
pub const LOG: &str = "/log";

/// The frame of a segment: its axes, at its centre of gravity.
pub fn segment_frame(name: &str) -> String {
    match name.split_once('.') {
        Some((occupant, segment)) => format!("occupants/{occupant}/{segment}"),
        None => format!("occupant/{name}"),
    }
}

/// Frame of a sphere that rides on deformable parts of its segment: the segment's axes, at the displaced position.
pub fn ridden_frame(segment: &str, sphere: &str) -> String {
    let own = sphere.rsplit_once('.').map_or(sphere, |(_, own)| own);
    format!("{}/{own}", segment_frame(segment))
}

/// The frame of a segment that carries surfaces or solids: its axes, at its lower end.
pub fn origin_frame(name: &str) -> String {
    format!("{}/origin", segment_frame(name))
}

/// The frame of another vehicle, the ground or a panel.
pub fn other_frame(name: &str) -> String {
    format!("frames/{name}")
}
