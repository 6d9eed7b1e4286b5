//! Nearest surfaces in front of head, chest and knees and above the head at the start, with their distances.

use nalgebra::{Point3, Vector3};
use serde::Serialize;

use super::rates::frame_at_start;
use crate::forces::contact::solid::Shape;
use crate::forces::contact::surface::{Frame, Outline};
use crate::model::Model;
use crate::motion::kinematics::Kinematics;

/// Largest clearance in a compartment, m.
const FAR_M: f64 = 1.5;
/// Rays from a sphere: lateral offsets, relative to its radius.
const RAYS: [[f64; 2]; 9] = [
    [0.0, 0.0],
    [0.5, 0.0],
    [-0.5, 0.0],
    [0.0, 0.5],
    [0.0, -0.5],
    [0.85, 0.0],
    [-0.85, 0.0],
    [0.0, 0.85],
    [0.0, -0.85],
];

/// Clearance of a sphere in the initial position.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Clearance {
    /// Name of the sphere.
    pub sphere: String,
    /// Direction.
    pub way: Way,
    /// First obstacle.
    pub surface: String,
    /// Distance to it, m.
    pub distance_m: f64,
    /// Ends of its line, axes of the occupant's vehicle, for pictures.
    #[serde(skip)]
    pub ends_m: [[f64; 3]; 2],
}

/// A direction in the vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Way {
    /// Straight forward.
    Ahead,
    /// Straight up.
    Up,
}

/// Clearances of all occupants of vehicles.
pub fn clearances(model: &Model) -> Vec<Clearance> {
    let (setup, body) = (model.setup(), model.body());
    let (homes, k) = (setup.homes(), Kinematics::new(&model.system().skeleton, &model.start().state));
    let mut found = Vec::new();
    for (i, sphere) in body.spheres.iter().enumerate() {
        let Some(home) = homes.get(body.tree.body_of(sphere.segment)).filter(|home| !setup.is_ground(**home)) else {
            continue;
        };
        let ways: &[Way] = match sphere.name.rsplit('.').next() {
            Some("head") => &[Way::Ahead, Way::Up],
            Some("chest" | "left_knee" | "right_knee") => &[Way::Ahead],
            _ => &[],
        };
        for way in ways {
            let centre = model.system().sphere(&k, i).1.to_vector();
            let centre = frame_at_start(model, *home).point_to_frame(centre);
            let Some((surface, distance_m, from)) = first(model, *home, (centre, sphere.radius_m), *way) else {
                continue;
            };
            let to = from + distance_m * way.direction();
            let ends_m = [from, to].map(Into::into);
            found.push(Clearance { sphere: sphere.name.clone(), way: *way, surface, distance_m, ends_m });
        }
    }
    found
}

impl Way {
    fn direction(self) -> Vector3<f64> {
        match self {
            Way::Ahead => Vector3::x(),
            Way::Up => -Vector3::z(),
        }
    }

    fn beside(self) -> [Vector3<f64>; 2] {
        match self {
            Way::Ahead => [Vector3::y(), Vector3::z()],
            Way::Up => [Vector3::x(), Vector3::y()],
        }
    }
}

/// First obstacle of a sphere in its vehicle, its distance from the skin, and the start of the ray.
fn first(
    model: &Model,
    home: Frame,
    (centre, radius_m): (Vector3<f64>, f64),
    way: Way,
) -> Option<(String, f64, Vector3<f64>)> {
    let (along, beside) = (way.direction(), way.beside());
    let starts = RAYS.map(|part| {
        let deep = (1.0 - part[0] * part[0] - part[1] * part[1]).sqrt();
        centre + radius_m * (deep * along + part[0] * beside[0] + part[1] * beside[1])
    });
    let mut nearest: Option<(String, f64, Vector3<f64>)> = None;
    let mut look = |name: &str, frame: Frame, polygons: &[Vec<Point3<f64>>]| {
        for polygon in polygons {
            let corners: Vec<_> = polygon.iter().map(|corner| in_home(model, home, frame, corner.coords)).collect();
            for start in starts {
                let Some(far) = meets(&corners, start, along).filter(|far| *far < FAR_M) else { continue };
                if nearest.as_ref().is_none_or(|(_, least, _)| far < *least) {
                    nearest = Some((name.to_owned(), far, start));
                }
            }
        }
    };
    let setup = model.setup();
    let is_own = |frame: Frame| setup.belongs_to(frame) == home;
    for own in setup.surfaces.iter().filter(|own| is_own(own.frame)) {
        if let Outline::Polygon(corners) = &own.outline {
            look(&own.name, own.frame, std::slice::from_ref(corners));
        }
    }
    for own in setup.solids.iter().filter(|own| is_own(own.frame) && !matches!(own.shape, Shape::HalfSpace { .. })) {
        look(&own.name, own.frame, &own.outline());
    }
    nearest
}

/// A point of a frame in axes of the vehicle that carries it.
fn in_home(model: &Model, home: Frame, frame: Frame, point: Vector3<f64>) -> Vector3<f64> {
    if frame == home {
        return point;
    }
    frame_at_start(model, home).point_to_frame(frame_at_start(model, frame).point_to_space(point))
}

/// Distance along a ray to a convex polygon, m; none without intersection.
fn meets(corners: &[Vector3<f64>], start: Vector3<f64>, along: Vector3<f64>) -> Option<f64> {
    let [a, b, c, ..] = corners else { return None };
    let normal = (b - a).cross(&(c - a));
    let slope = normal.dot(&along);
    if slope.abs() <= 1e-9 * normal.norm() {
        return None;
    }
    let far = normal.dot(&(a - start)) / slope;
    let point = start + far * along;
    let side = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        (to - from).cross(&(point - from)).dot(&normal)
    };
    (far >= 0.0 && (0..corners.len()).all(|i| side(i) >= 0.0)).then_some(far)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_meets_a_plate_inside_its_edges_alone() {
        let plate = [[1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [1.5, 1.0, 1.0], [1.5, -1.0, 1.0]].map(Vector3::from);
        let at = |y: f64, z: f64| meets(&plate, Vector3::new(0.0, y, z), Vector3::x());
        assert!((at(0.0, 0.0).unwrap() - 1.25).abs() < 1e-12);
        assert_eq!([at(1.1, 0.0), at(0.0, -1.1)], [None; 2]);
        assert_eq!(meets(&plate, Vector3::new(2.0, 0.0, 0.0), Vector3::x()), None);
        let turned: Vec<_> = plate.iter().rev().copied().collect();
        assert!((meets(&turned, Vector3::zeros(), Vector3::x()).unwrap() - 1.25).abs() < 1e-12);
    }
}
