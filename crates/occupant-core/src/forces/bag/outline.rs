//! Sections of a bag that pictures draw.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Point3, Vector3};

use super::data::{Bag, Shape};
use occupant_units::trig::sin_cos;

use crate::forces::shown::Section;

/// Steps of a quarter of a circle.
const QUARTER: usize = 6;

/// Sections of a bag all of whose lengths are `scale` times the full ones, axes of its frame.
pub(super) fn sections(bag: &Bag, scale: f64) -> Vec<Section> {
    let mount = bag.mount_m;
    let place = |point: Point3<f64>| mount + (point - mount) * scale;
    let section = |corners: Vec<Point3<f64>>| Section {
        name: bag.name.clone(),
        corners_m: corners.into_iter().map(place).collect(),
    };
    let polygons = match bag.shape {
        Shape::Dome { axis, .. } => {
            let axis = axis.normalize();
            let profile = dome_profile(&bag.shape);
            let rim = profile.iter().map(|p| p[0]).fold(0.0, f64::max);
            let [u, v] = beside(axis);
            let through = |side: Vector3<f64>| profile.iter().map(|p| mount + side * p[0] + axis * p[1]).collect();
            let halves = [u, v, (u + v).normalize(), (u - v).normalize()].map(through);
            let high = profile.iter().filter(|p| p[0] >= rim).map(|p| p[1]).fold(0.0, f64::max);
            let circles = [0.0, high].map(|height| circle(mount + axis * height, [u, v], rim));
            [halves.to_vec(), circles.to_vec()].concat()
        }
        Shape::Sphere { centre_m, radius_m } => {
            let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
            (0..3).map(|i| circle(centre_m, [axes[i], axes[(i + 1) % 3]], radius_m)).collect()
        }
        Shape::Capsule { ends_m: [from, to], radius_m } => {
            let along = (to - from).try_normalize(0.0).unwrap_or_else(Vector3::x);
            let [u, v] = beside(along);
            let stadium = |side: Vector3<f64>| {
                let turn = |end: Point3<f64>, begin: f64| {
                    (0..=2 * QUARTER).map(move |i| {
                        let (sine, cosine) = sin_cos(begin + PI * i as f64 / (2 * QUARTER) as f64);
                        end + (along * cosine + side * sine) * radius_m
                    })
                };
                turn(to, -FRAC_PI_2).chain(turn(from, FRAC_PI_2)).collect::<Vec<_>>()
            };
            let middle = from + (to - from) * 0.5;
            vec![stadium(u), stadium(v), circle(middle, [u, v], radius_m)]
        }
    };
    polygons.into_iter().map(section).collect()
}

/// Distance from the axis and height of the corners of a dome's section, from its base round its face.
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

/// Two directions across an axis.
fn beside(axis: Vector3<f64>) -> [Vector3<f64>; 2] {
    let other = if axis.y.abs() < 0.9 { Vector3::y() } else { Vector3::z() };
    let u = axis.cross(&other).normalize();
    [u, axis.cross(&u)]
}

fn circle(centre: Point3<f64>, [u, v]: [Vector3<f64>; 2], radius: f64) -> Vec<Point3<f64>> {
    let corner = |i: usize| {
        let (sine, cosine) = sin_cos(TAU * i as f64 / (4 * QUARTER) as f64);
        centre + (u * cosine + v * sine) * radius
    };
    (0..4 * QUARTER).map(corner).collect()
}
