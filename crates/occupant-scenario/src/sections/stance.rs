//! `[stance]`: its keys, converted to a posture.

use indexmap::IndexMap;
use nalgebra::{Point3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::path::pose;
use super::posture::{angle_words, unknown_angles};
use super::quantity::{NOT_NEGATIVE, Quantity, all_si, si_or};
use super::{Angle, Length, Scenario, Speed};
use occupant_core::body::{Body, ContactSphere, both_sides};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::seating::{InitialPosture, InitialVelocity, Mounting, Placing};

/// Standing posture. The body is raised or lowered until the feet carry it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StanceSection {
    /// Basic posture: "standing", arms hanging; "walking", left leg forward, arms opposite; "none", every segment
    /// aligned with its parent. "standing" if absent.
    #[schemars(extend("enum" = ["standing", "walking", "none"]))]
    pub(crate) preset: Option<String>,
    /// [x, y] of the body's reference point T1, in vehicle-space or in the axes of its vehicle.
    pub(crate) at: [Length; 2],
    /// Heading, to the right of x; 0 if absent.
    pub(crate) yaw: Option<Angle>,
    /// Forward speed relative to its vehicle; 0 if absent.
    pub(crate) speed: Option<Speed<NOT_NEGATIVE>>,
    /// Angles by the names of segments and pins, as in `posture`: positive leans the top of a segment back, in the
    /// plane in which the body faces.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) posture: IndexMap<String, Angle>,
}

/// Angles of the preset stances, degrees, by names of segments and pins, for both divisions of the body.
#[rustfmt::skip]
const STANCES: [(&str, &[(&str, f64)]); 3] = [
    ("standing", &[("left_upper_arm", -3.0), ("right_upper_arm", -3.0), ("left_elbow", -10.0), ("right_elbow", -10.0)]),
    ("walking", &[
        ("left_thigh", 25.0), ("right_thigh", -25.0), ("left_knee", 5.0), ("right_knee", 30.0),
        ("left_upper_arm", -20.0), ("right_upper_arm", 20.0), ("left_elbow", -20.0), ("right_elbow", -20.0),
    ]),
    ("none", &[]),
];

/// Initial state of a standing body.
pub(super) fn stance(
    b: &mut Builder,
    s: &Scenario,
    section: &StanceSection,
    body: &Body,
) -> (InitialPosture, InitialVelocity) {
    let root = body.tree.segment(0);
    let words = angle_words(body.tree, |_| true);
    unknown_angles(b, "stance.posture", section.posture.keys().map(String::as_str), &words);
    let own: Vec<(String, f64)> = section.posture.iter().map(|(name, angle)| (name.clone(), angle.si())).collect();
    let preset = section.preset.as_deref().unwrap_or("standing");
    let usual = STANCES.iter().filter(|(name, _)| *name == preset).flat_map(|(_, angles)| angles.iter());
    // what is said of one or of both sides replaces the preset
    let is_said = |name: &str| own.iter().any(|(said, _)| said == name || both_sides(name).as_ref() == Some(said));
    let usual = usual.filter(|(name, _)| words.iter().any(|word| word == name) && !is_said(name));
    let angles_rad =
        usual.map(|(name, degrees)| ((*name).to_owned(), degrees.to_radians())).chain(own.clone()).collect();
    let [x, y] = all_si(&section.at);
    let below_m = s.ground.as_ref().map_or(0.0, |ground| si_or(&ground.below, 0.0));
    let yaw = section.yaw.as_ref();
    let at = Mounting {
        frame: Frame::Vehicle,
        point_m: body.joint_m(root),
        place_m: Vector3::new(x, y, below_m - leg_m(body)),
        attitude: pose(&None, [&None, &None, &section.yaw]).attitude,
        angles_rad,
    };
    let heading = yaw.map_or(0.0, Quantity::si);
    let (sin, cos) = occupant_units::trig::sin_cos(heading);
    let velocity = Vector3::new(cos, sin, 0.0) * si_or(&section.speed, 0.0);
    let placing = Placing { at, stands: true, spin_rad_s: Vector3::zeros() };
    (InitialPosture::Placed(Box::new(placing)), InitialVelocity::Given(velocity))
}

/// Height of T1 above the ground of a standing body, m.
fn leg_m(body: &Body) -> f64 {
    let lowest = |sphere: (&ContactSphere, Point3<f64>)| sphere.0.radius_m - sphere.1.z;
    body.spheres.iter().zip(body.standing_m()).map(lowest).fold(0.0, f64::max)
}
