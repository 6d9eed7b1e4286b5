//! Segments and spheres of the body.

use crate::body::{Body, JointKind, Place, SegmentProperties};
use crate::motion::layout::{MOST_HINGES, MOST_SEGMENTS};
use occupant_units::trig;
use placed_text::{Problems, number};

/// Largest distance of a sphere from even a short segment, and of mass from its centre, m.
const WIDEST_M: f64 = 0.3;

/// Whether the numbers of segments and joint positions are those of the tree.
pub(super) fn check_count(body: &Body, problems: &mut Problems) -> bool {
    let given = body.tree.joint_rows().iter().any(|row| row.place == Place::Given);
    let (segments, joints) = (body.tree.segments().len(), if given { body.tree.joints().len() } else { 0 });
    let is_whole = body.segments.len() == segments && body.places.len() == joints;
    if !is_whole {
        let found = format!("{} segments and {} places of joints", body.segments.len(), body.places.len());
        problems.error("body", found, format!("{segments} segments and {joints} places, as many as its tree has"));
    }
    let hinges: usize = body.tree.joint_rows().iter().map(|row| axes_of(row.kind)).sum();
    let counts = [("segments", segments, MOST_SEGMENTS), ("axes of hinges", hinges, MOST_HINGES)];
    // of several bodies together it is said with their names
    let is_alone = body.tree.bodies().len() == 1;
    let mut too_many = counts.into_iter().filter(|(_, found, most)| is_alone && found > most);
    if let Some((what, found, most)) = too_many.next() {
        problems.error("body", format!("{found} {what}"), format!("at most {most} {what}"));
        return false;
    }
    is_whole
}

/// Number of hinge axes of a joint of this kind.
pub(super) fn axes_of(kind: JointKind) -> usize {
    match kind {
        JointKind::Hinge => 1,
        JointKind::Universal => 2,
        JointKind::Ball | JointKind::Fixed => 0,
    }
}

pub(super) fn check_body(body: &Body, problems: &mut Problems) {
    for segment in body.tree.segments() {
        let path = format!("body.segments.{}", body.tree[segment].name);
        check_segment(body.segment(segment), &path, problems);
    }
    for (joint, row) in body.tree.joints().zip(body.tree.joint_rows()) {
        let place = body.place(joint);
        if !place.proximal.point_m.sum().is_finite() || !place.distal.point_m.sum().is_finite() {
            problems.error(format!("body.joints.{}", row.name), "a position that is not finite", "finite coordinates");
        }
    }
    for (key, value) in [
        ("shoulder_half_width", body.shoulder_half_width_m),
        ("hip_half_width", body.hip_half_width_m),
        ("neck_height", body.neck_height_m),
    ] {
        problems.check_at_least_zero(&format!("body.{key}"), value, "m");
    }
    if body.condyles_m.is_some_and(|condyles| !condyles.sum().is_finite()) {
        problems.error("body.condyles", "a position that is not finite", "finite coordinates");
    }
    problems.check_unique("body.spheres", "sphere", body.spheres.iter().map(|s| s.name.as_str()));
    check_spheres(body, problems);
}

fn check_spheres(body: &Body, problems: &mut Problems) {
    for sphere in &body.spheres {
        let path = format!("body.spheres.{}", sphere.name);
        problems.check_positive(&format!("{path}.radius"), sphere.radius_m, "m");
        problems.check_positive(&format!("{path}.share"), sphere.share, "");
        let length = body.segment(sphere.segment).length_m;
        let centre = sphere.centre_from_lower_end_m;
        let z = centre.z;
        let reach = centre.coords.norm();
        let beside = trig::hypot(centre.x, centre.y);
        let widest = length.max(WIDEST_M);
        if !reach.is_finite() {
            problems.error(&path, "a centre that is not a finite number", "finite coordinates");
        } else if z < -0.5 * length || z > 1.5 * length || beside > widest {
            problems.error_with_hint(
                &path,
                format!(
                    "a centre {:.4} m along and {:.4} m beside the {:.4} m long {}",
                    z, beside, length, body.tree[sphere.segment].name
                ),
                "a sphere on its segment",
                "the centre is measured from the segment's lower end, upwards",
            );
        }
    }
}

fn check_segment(p: &SegmentProperties, path: &str, problems: &mut Problems) {
    problems.check_positive(&format!("{path}.length"), p.length_m, "m");
    problems.check_positive(&format!("{path}.mass"), p.mass_kg, "kg");
    let rho = p.cg_from_lower_end_m;
    if !(rho >= 0.0 && rho <= p.length_m) {
        problems.error(
            format!("{path}.cg"),
            format!("ρ = {rho} m from the lower end of a segment of {} m", p.length_m),
            "a centre of gravity between the segment's ends",
        );
    }
    let beside_m = p.cg_beside_m.norm();
    if beside_m.is_nan() || beside_m > p.length_m.max(WIDEST_M) {
        let found = format!("a centre of gravity {beside_m} m beside a segment of {} m", p.length_m);
        problems.error(format!("{path}.cg_beside"), found, "a centre of gravity that is near its segment");
    }
    if !p.principal.coords.sum().is_finite() {
        problems.error(
            format!("{path}.inertia"),
            "principal axes that are not finite",
            "a turn into the segment's axes",
        );
    }
    let inertia = p.inertia_kg_m2;
    let mut sound = true;
    for (axis, value) in ["x", "y", "z"].iter().zip(inertia.iter()) {
        sound &= problems.check_positive(&format!("{path}.inertia"), *value, &format!("kg·m² about {axis}"));
    }
    let sum: f64 = inertia.sum();
    let (gyration_m, most_m) = ((0.5 * sum / p.mass_kg).sqrt(), p.length_m.max(WIDEST_M));
    if sound && gyration_m > most_m {
        let found = format!(
            "{} kg with these moments of inertia, a radius of gyration of {gyration_m:.2e} m",
            number(p.mass_kg)
        );
        problems.warning(format!("{path}.mass"), found, format!("at most {most_m} m, the size of the segment"));
    }
    for (axis, value) in ["I_x", "I_y", "I_z"].iter().zip(inertia.iter()) {
        // Iᵢ ≤ Iⱼ + Iₖ, with a part in 10⁹ for rounded input
        if sound && 2.0 * value > sum * (1.0 + 1e-9) {
            problems.error_with_hint(
                format!("{path}.inertia"),
                format!("{axis} = {value:.6} kg·m² exceeds the sum of the other two, {:.6}", sum - value),
                "principal moments that obey the triangle inequality",
                "no rigid body has such moments; look for a slipped digit or interchanged axes",
            );
        }
    }
}
