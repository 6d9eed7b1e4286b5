//! Groups of solids that do not act as one body: concave corners and gaps between them.
//!
//! Only the nearest solid of a group pushes. If a sphere touches two of them from different sides at once, only one
//! resists, and the sphere sinks into the other until that one is deeper.

use nalgebra::{Point3, Vector3};

use super::{Solid, build};
use crate::forces::contact::OPEN;
use crate::forces::contact::solid::Faced;
use crate::motion::vector::V3;

/// Centres of spheres so far from a solid are tried, m.
const AWAY_M: f64 = 0.03;
/// Solids whose boxes are farther apart have no such angle, m.
pub(crate) const CONCAVE_WITHIN_M: f64 = 2.1 * AWAY_M;
/// Normals of two solids that push in directions nearer to each other than this are one, rad: 30°.
const ONE_RAD: f64 = std::f64::consts::FRAC_PI_6;

/// The largest angle between the normals of two solids at places that are equally near to both, rad; none if it is small.
pub(crate) fn concave_rad(one: &Solid, other: &Solid) -> Option<f64> {
    let [Ok(a), Ok(b)] = [&one.shape, &other.shape].map(build) else { return None };
    let angles = one.outline().into_iter().flat_map(|polygon| angles(&polygon, &a, &b));
    let greatest = angles.fold(0.0, f64::max);
    (greatest > ONE_RAD).then_some(greatest)
}

/// Angles between the normals where `b` is as far from the lines of a polygon of `a`, held off by [`AWAY_M`], as `a` is.
fn angles(polygon: &[Point3<f64>], a: &Faced<f64>, b: &Faced<f64>) -> Vec<f64> {
    let count = polygon.len();
    let middle = polygon.iter().map(|p| p.coords).sum::<Vector3<f64>>() / count as f64;
    let normal_of = |shape: &Faced<f64>, place: &Vector3<f64>| shape.distance(V3::of(place), OPEN);
    let outwards = normal_of(a, &middle).normal.to_vector() * AWAY_M;
    let excess_m = |place: &Vector3<f64>| normal_of(b, place).phi - normal_of(a, place).phi;
    let corner = |i: usize| polygon[i % count].coords + outwards;
    let lines = (0..count).flat_map(|i| [(corner(i), middle + outwards), (corner(i), corner(i + 1))]);
    let crossed = lines.filter_map(|(mut far, mut near)| {
        let (start, end) = (excess_m(&far), excess_m(&near));
        if start * end >= 0.0 {
            return None;
        }
        if start < 0.0 {
            std::mem::swap(&mut far, &mut near);
        }
        for _ in 0..40 {
            let place = 0.5 * (far + near);
            if excess_m(&place) > 0.0 { far = place } else { near = place }
        }
        let [m, n] = [a, b].map(|shape| normal_of(shape, &far).normal.to_vector());
        Some(m.angle(&n))
    });
    crossed.collect()
}
