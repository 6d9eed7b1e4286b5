//! The belt as a line that can be drawn: anchor, tangent point, round the sphere, tangent point, anchor.

use nalgebra::{Point3, Vector3};
use occupant_units::trig;

use super::Belt;
use super::law::BeltAction;

/// Largest angle between two points of the arc, rad.
const ARC_STEP_RAD: f64 = 0.15;

/// Points of the belt from the first anchor to the second, vehicle axes; a straight line for a belt off the body.
pub(super) fn course_m(
    belt: &Belt,
    radius_m: f64,
    centre_m: Point3<f64>,
    action: &BeltAction<f64>,
) -> Vec<Point3<f64>> {
    let [first, second] = belt.anchors_m;
    let mut points = vec![first];
    if action.wrap > 0.0 {
        let free_1 = action.free[0].to_vector();
        let tangent_1 = tangent_point(first, centre_m, radius_m, free_1);
        // the arc leaves the first tangent point the way the webbing came: away from the first anchor
        let out = (tangent_1 - centre_m) / radius_m;
        let on = -free_1;
        let steps = (action.wrap / ARC_STEP_RAD).ceil().max(1.0);
        for i in 0..=steps as usize {
            let angle = action.wrap * i as f64 / steps;
            points.push(centre_m + (out * trig::cos(angle) + on * trig::sin(angle)) * radius_m);
        }
    }
    points.push(second);
    points
}

/// Tangent point on the sphere of the free length from `anchor` along −`free`.
fn tangent_point(anchor: Point3<f64>, centre: Point3<f64>, radius_m: f64, free: Vector3<f64>) -> Point3<f64> {
    let square = (anchor - centre).norm_squared() - radius_m * radius_m;
    anchor - free * square.max(0.0).sqrt()
}
