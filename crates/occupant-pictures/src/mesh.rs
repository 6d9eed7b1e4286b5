//! Triangle meshes of the parts of a body and of what there is to touch.

use occupant_units::trig;
use std::f64::consts::{PI, TAU};

use nalgebra::{Point3, Vector3};

use crate::body::Lump;

/// A triangle mesh: vertices, normals, and three indices per triangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Mesh {
    pub(crate) corners: Vec<[f32; 3]>,
    pub(crate) normals: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Number of directions around the long axis and from end to end: of a file's mesh, and of a picture's.
pub(crate) const COARSE: [u32; 2] = [20, 12];
pub(crate) const FINE: [u32; 2] = [36, 25];

/// The convex hull of two ellipsoids, by its support points.
pub(crate) fn hull(ends: &[Lump; 2], [round, along]: [u32; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..=along {
        // both sides of the middle, where the point goes from one end to the other, are close together
        let height = f64::from(i) / f64::from(along) * PI;
        for j in 0..round {
            let angle = f64::from(j) / f64::from(round) * TAU;
            let direction = axes(ends)
                * Vector3::new(
                    trig::sin(height) * trig::cos(angle),
                    trig::sin(height) * trig::sin(angle),
                    trig::cos(height),
                );
            mesh.corners.push(farthest(ends, &direction).map(|x| x as f32));
            mesh.normals.push(direction.data.0[0].map(|x| x as f32));
        }
    }
    for i in 0..along {
        for j in 0..round {
            let next = (j + 1) % round;
            let [a, b, c, d] = [i * round + j, i * round + next, (i + 1) * round + j, (i + 1) * round + next];
            mesh.triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    mesh
}

/// Axes whose third is the line between the ends.
fn axes(ends: &[Lump; 2]) -> nalgebra::Rotation3<f64> {
    let along = ends[1].centre_m - ends[0].centre_m;
    nalgebra::Rotation3::rotation_between(&Vector3::z(), &along).unwrap_or_else(nalgebra::Rotation3::identity)
}

fn farthest(ends: &[Lump; 2], direction: &Vector3<f64>) -> [f64; 3] {
    let point = |lump: &Lump| {
        let scaled = lump.half_m.component_mul(direction);
        lump.centre_m + lump.half_m.component_mul(&scaled) / scaled.norm().max(f64::MIN_POSITIVE)
    };
    let [a, b] = [point(&ends[0]), point(&ends[1])];
    if a.dot(direction) > b.dot(direction) { a.data.0[0] } else { b.data.0[0] }
}

/// Convex polygons.
pub(crate) fn polygons(all: &[Vec<Point3<f64>>]) -> Mesh {
    let mut mesh = Mesh::default();
    for corners in all.iter().filter(|corners| corners.len() > 2) {
        let first = mesh.corners.len() as u32;
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let normal = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
        mesh.corners.extend(corners.iter().map(|p| p.coords.data.0[0].map(|x| x as f32)));
        mesh.normals.extend(corners.iter().map(|_| normal.data.0[0].map(|x| x as f32)));
        mesh.triangles.extend((2..corners.len() as u32).map(|i| [first, first + i - 1, first + i]));
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_of_two_balls_is_a_capsule_with_its_outside_outside() {
        let ball = |z: f64| Lump { centre_m: Vector3::new(0.0, 0.0, z), half_m: Vector3::repeat(0.1) };
        let mesh = hull(&[ball(0.0), ball(0.4)], COARSE);
        let beyond = |p: &[f32; 3]| {
            let z = f64::from(p[2]).clamp(0.0, 0.4);
            Vector3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]) - z).norm()
        };
        assert!(mesh.corners.iter().all(|p| (beyond(p) - 0.1).abs() < 1e-6));
        let at = |i: u32| Vector3::from(mesh.corners[i as usize]).cast::<f64>();
        let centre = Vector3::new(0.0, 0.0, 0.2);
        let outward = |[a, b, c]: &[u32; 3]| (at(*b) - at(*a)).cross(&(at(*c) - at(*a))).dot(&(at(*a) - centre));
        assert!(mesh.triangles.iter().all(|triangle| outward(triangle) > -1e-9));
        let volume: f64 = mesh.triangles.iter().map(|[a, b, c]| at(*a).cross(&at(*b)).dot(&at(*c)) / 6.0).sum();
        let exact = PI * 0.01 * 0.4 + 4.0 / 3.0 * PI * 1e-3;
        assert!((volume / exact - 1.0).abs() < 0.05, "{volume} of {exact}");
    }
}
