//! Sections of a bag that pictures draw, pressed in where the body is.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Point3, Vector3};

use super::data::{Bag, Shape};
use occupant_units::trig::sin_cos;

use crate::forces::shown::Section;

/// Segments per quarter circle.
const QUARTER: usize = 6;

/// Straight segments of each long side of a capsule.
const PIECES: usize = 12;

/// A corner of a section, and the inner point from which it is projected.
type Ray = [Point3<f64>; 2];

/// Sections of a bag scaled by `scale`; `place` converts points of its frame, `spheres` press it in (centres and radii,
/// in the target axes).
pub(super) fn sections(
    bag: &Bag,
    scale: f64,
    place: impl Fn(Point3<f64>) -> Point3<f64>,
    spheres: &[(Point3<f64>, f64)],
) -> Vec<Section> {
    let mount = bag.mount_m;
    let place = |point: Point3<f64>| place(mount + (point - mount) * scale);
    let corner = |ray: Ray| {
        let [from, to] = ray.map(place);
        from + (to - from) * spheres.iter().map(|sphere| free(from, to, sphere)).fold(1.0, f64::min)
    };
    let section =
        |rays: Vec<Ray>| Section { name: bag.name.clone(), corners_m: rays.into_iter().map(corner).collect() };
    shape(bag).into_iter().map(section).collect()
}

/// Fraction of a line between two points that is outside a sphere.
fn free(from: Point3<f64>, to: Point3<f64>, (centre, radius): &(Point3<f64>, f64)) -> f64 {
    let (way, seen) = (to - from, from - centre);
    let (a, b, c) = (way.norm_squared(), way.dot(&seen), seen.norm_squared() - radius * radius);
    if c <= 0.0 {
        return 0.0;
    }
    let root = b * b - a * c;
    if root < 0.0 || b >= 0.0 { 1.0 } else { (c / (root.sqrt() - b)).min(1.0) }
}

/// Sections of a full unloaded bag, axes of its frame.
fn shape(bag: &Bag) -> Vec<Vec<Ray>> {
    let mount = bag.mount_m;
    match bag.shape {
        Shape::Dome { axis, .. } => {
            let axis = axis.normalize();
            let profile = dome_profile(&bag.shape);
            let rim = profile.iter().map(|p| p[0]).fold(0.0, f64::max);
            let [u, v] = beside(axis);
            let through = |side: Vector3<f64>| {
                let at = |p: &[f64; 2]| [mount + side * p[0], mount + side * p[0] + axis * p[1]];
                profile.iter().map(at).collect()
            };
            let halves = [u, v, (u + v).normalize(), (u - v).normalize()].map(through);
            let high = profile.iter().filter(|p| p[0] >= rim).map(|p| p[1]).fold(0.0, f64::max);
            let circles = [0.0, high].map(|height| circle(mount, axis * height, [u, v], rim));
            [halves.to_vec(), circles.to_vec()].concat()
        }
        Shape::Sphere { centre_m, radius_m } => {
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
            let round = |i: usize| circle(centre_m, Vector3::zeros(), [axes[i], axes[(i + 1) % 3]], radius_m);
            let from_middle = |rays: Vec<Ray>| rays.into_iter().map(|[_, to]| [centre_m, to]).collect();
            (0..3).map(round).map(from_middle).collect()
        }
        Shape::Capsule { ends_m: [from, to], radius_m } => {
            let along = (to - from).try_normalize(0.0).unwrap_or_else(Vector3::x);
            let [u, v] = beside(along);
            let stadium = |side: Vector3<f64>| {
                let turn = |end: Point3<f64>, begin: f64| {
                    (0..=2 * QUARTER).map(move |i| {
                        let (sine, cosine) = sin_cos(begin + PI * i as f64 / (2 * QUARTER) as f64);
                        [end, end + (along * cosine + side * sine) * radius_m]
                    })
                };
                let straight = |from: Point3<f64>, to: Point3<f64>, side: Vector3<f64>| {
                    (1..PIECES).map(move |i| {
                        let on = from + (to - from) * (i as f64 / PIECES as f64);
                        [on, on + side * radius_m]
                    })
                };
                let there = turn(to, -FRAC_PI_2).chain(straight(to, from, side));
                there.chain(turn(from, FRAC_PI_2)).chain(straight(from, to, -side)).collect::<Vec<Ray>>()
            };
            let middle = from + (to - from) * 0.5;
            let round = circle(middle, Vector3::zeros(), [u, v], radius_m).into_iter().map(|[_, to]| [middle, to]);
            vec![stadium(u), stadium(v), round.collect()]
        }
    }
}

/// Distance from the axis and height of the corners of a dome's section, from its base around its face.
fn dome_profile(shape: &Shape) -> Vec<[f64; 2]> {
    let Shape::Dome { depth_m, radius_m, face_radius_m, .. } = *shape else { return Vec::new() };
    let reach = radius_m.min(face_radius_m);
    let half = occupant_units::trig::atan2(reach, (face_radius_m * face_radius_m - reach * reach).max(0.0).sqrt());
    let face = (0..=2 * QUARTER).map(|i| {
        let (sine, cosine) = sin_cos(half * (1.0 - i as f64 / QUARTER as f64));
        [face_radius_m * sine, (depth_m - face_radius_m * (1.0 - cosine)).max(0.0)]
    });
    [[radius_m, 0.0]].into_iter().chain(face).chain([[-radius_m, 0.0]]).collect()
}

/// Two directions normal to an axis.
fn beside(axis: Vector3<f64>) -> [Vector3<f64>; 2] {
    let other = if axis.y.abs() < 0.9 { Vector3::y() } else { Vector3::z() };
    let u = axis.cross(&other).normalize();
    [u, axis.cross(&u)]
}

/// A circle, each corner with an inner point lower by `above`.
fn circle(centre: Point3<f64>, above: Vector3<f64>, [u, v]: [Vector3<f64>; 2], radius: f64) -> Vec<Ray> {
    let corner = |i: usize| {
        let (sine, cosine) = sin_cos(TAU * i as f64 / (4 * QUARTER) as f64);
        let low = centre + (u * cosine + v * sine) * radius;
        [low, low + above]
    };
    (0..4 * QUARTER).map(corner).collect()
}
