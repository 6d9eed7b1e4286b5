//! Body → series 5 and 7.

use occupant_core::body::tti12::TTI12;

use super::Back;

/// Largest difference of sphere centres from the report's that counts as rounding, m.
const SAME_PLACE_M: f64 = 1e-12;

pub(super) fn read(back: &mut Back<'_>) {
    let body = &back.setup.body;
    back.set_all([("XLS", body.shoulder_half_width_m), ("XLH", body.hip_half_width_m)]);
    back.misfit_if(body.neck_height_m != 0.0, "body.neck_height: cards have the neck at the shoulders");
    for segment in TTI12.segments() {
        let (p, inertia) = (body.segment(segment), body.segment(segment).inertia_kg_m2);
        let lengths = [("XLE", p.length_m), ("RHO", p.cg_from_lower_end_m), ("XM", p.mass_kg)];
        back.set_numbered(segment.number(), lengths);
        back.set_numbered(segment.number(), [("XIN", inertia.x), ("YIN", inertia.y), ("ZIN", inertia.z)]);
    }
    spheres(back);
}

/// Cards support the 17 spheres of the report only, in their positions.
fn spheres(back: &mut Back<'_>) {
    let body = &back.setup.body;
    let rows = TTI12.spheres();
    let mut radii_m = vec![0.0; rows.len()];
    for (radius_m, name) in radii_m.iter_mut().zip(rows.iter().map(|row| row.name)) {
        match body.sphere(name) {
            Some(at) => *radius_m = body.spheres[at].radius_m,
            None => back.misfit(format!("body.spheres.{name} is removed: cards need all 17 spheres")),
        }
    }
    let standard = body.standard_spheres(&radii_m);
    for sphere in &body.spheres {
        match standard.iter().position(|s| s.name == sphere.name) {
            None => back.misfit(format!("body.spheres.{}: cards know the report's 17 spheres only", sphere.name)),
            Some(at) => {
                let moved =
                    (sphere.centre_from_lower_end_m - standard[at].centre_from_lower_end_m).norm() > SAME_PLACE_M;
                if moved || sphere.segment != standard[at].segment {
                    back.misfit(format!(
                        "body.spheres.{}: it has been moved, and cards have no place for a centre",
                        sphere.name
                    ));
                }
                back.set(format!("RS({})", at + 1), sphere.radius_m);
            }
        }
    }
}
