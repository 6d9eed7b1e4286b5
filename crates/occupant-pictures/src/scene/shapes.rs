//! Shapes of what stands in a picture: planes, wheels, webbing, cloth.

use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, Point3, Vector3};
use occupant_units::trig;

use super::canvas::{Colour, Corner, Paint, Piece, Veil};
use super::lens::V3;
use super::light::linear;
use crate::body::Lump;
use crate::mesh::Mesh;

/// Half width and thickness of webbing, m, and how much nearer to the eye it counts.
const WEBBING_M: [f32; 2] = [0.024, 0.11];
/// Directions round and along in which a bag's cloth is drawn.
const CLOTH: [usize; 2] = [28, 14];
/// Width of a tyre, m.
const TYRE_M: f64 = 0.2;
/// Half side of a ground without end, and how far an ending one goes on, m.
const FAR_M: f64 = 400.0;
const TYRE: Colour = [0.13, 0.13, 0.14];
const BAG: Colour = [0.97, 0.96, 0.94];

/// A skull with a jaw instead of a ball; other parts as they are.
pub(super) fn skull(ends: &[Lump; 2]) -> [Lump; 2] {
    let [ball, other] = ends;
    if ball != other {
        return *ends;
    }
    let r = ball.half_m.x;
    let crown = Lump {
        centre_m: ball.centre_m + Vector3::new(-0.03, 0.0, 0.06) * r,
        half_m: Vector3::new(0.97, 0.80, 0.94) * r,
    };
    let jaw = Lump {
        centre_m: ball.centre_m + Vector3::new(0.36, 0.0, -0.60) * r,
        half_m: Vector3::new(0.46, 0.46, 0.42) * r,
    };
    [crown, jaw]
}

/// Points round a circle, the first once more at the end.
pub(super) fn circle(centre_m: &Point3<f64>, axis: &Vector3<f64>, radius_m: f64) -> Vec<Point3<f64>> {
    let u = axis.cross(&Vector3::z()).try_normalize(1e-6).unwrap_or_else(Vector3::x);
    let v = axis.cross(&u).try_normalize(1e-9).unwrap_or_else(Vector3::y);
    let corner = |i: usize| {
        let (sine, cosine) = trig::sin_cos(TAU * i as f64 / 28.0);
        centre_m + (u * cosine + v * sine) * radius_m
    };
    (0..=28).map(corner).collect()
}

pub(super) fn placed(mesh: &Mesh, pose: &Isometry3<f64>, origin: &Vector3<f64>, paint: Paint) -> Piece {
    let turn = pose.rotation.to_rotation_matrix().matrix().cast::<f32>();
    let shift: V3 = (pose.translation.vector - origin).cast();
    let corner = |(place, normal): (&[f32; 3], &[f32; 3])| Corner {
        place: turn * V3::from(*place) + shift,
        normal: turn * V3::from(*normal),
    };
    let corners = mesh.corners.iter().zip(&mesh.normals).map(corner).collect();
    Piece { corners, triangles: mesh.triangles.clone(), paint, before_m: 0.0 }
}

/// A convex polygon.
pub(super) fn flat(corners: &[V3], paint: Paint) -> Piece {
    let mut piece = Piece { paint, ..Piece::default() };
    add_flat(&mut piece, corners);
    piece
}

pub(super) fn add_flat(piece: &mut Piece, corners: &[V3]) {
    if corners.len() < 3 {
        return;
    }
    let first = piece.corners.len() as u32;
    let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).try_normalize(1e-12).unwrap_or_else(V3::z);
    piece.corners.extend(corners.iter().map(|place| Corner { place: *place, normal }));
    piece.triangles.extend((2..corners.len() as u32).map(|i| [first, first + i - 1, first + i]));
}

pub(super) fn polygons(all: &[Vec<Point3<f64>>], origin: &Vector3<f64>, paint: Paint) -> Piece {
    let mut piece = Piece { paint, ..Piece::default() };
    for polygon in all {
        let corners: Vec<V3> = polygon.iter().map(|p| (p.coords - origin).cast()).collect();
        add_flat(&mut piece, &corners);
    }
    piece
}

/// A plane without end.
pub(super) fn plane(
    normal: &Vector3<f64>,
    offset_m: f64,
    about: &Vector3<f64>,
    origin: &Vector3<f64>,
    paint: Paint,
) -> Piece {
    let foot = about - normal * (normal.dot(about) - offset_m) - origin;
    let u = normal.cross(&Vector3::y()).try_normalize(1e-6).unwrap_or_else(Vector3::x);
    let v = normal.cross(&u);
    let sides = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let corners: Vec<V3> = sides.map(|(a, b)| (foot + (u * a + v * b) * FAR_M).cast()).to_vec();
    flat(&corners, paint)
}

/// Ground whose outer edges go on.
pub(super) fn farther(all: &[Vec<Point3<f64>>]) -> Vec<Vec<Point3<f64>>> {
    let ends = [0, 1].map(|axis| {
        let along = || all.iter().flatten().map(move |p| p[axis]);
        [along().fold(f64::MAX, f64::min), along().fold(f64::MIN, f64::max)]
    });
    let mut grown = Vec::with_capacity(all.len());
    for polygon in all.iter().filter(|polygon| polygon.len() > 2) {
        let normal = (polygon[1] - polygon[0]).cross(&(polygon[2] - polygon[0]));
        let corner = |p: &Point3<f64>| {
            let mut far = *p;
            for axis in 0..2 {
                let [low, high] = ends[axis];
                let beyond = f64::from(u8::from(p[axis] >= high - 1e-6)) - f64::from(u8::from(p[axis] <= low + 1e-6));
                far[axis] += beyond * FAR_M;
            }
            if normal.z.abs() > 1e-9 {
                far.z = p.z - (normal.x * (far.x - p.x) + normal.y * (far.y - p.y)) / normal.z;
            }
            far
        };
        grown.push(polygon.iter().map(corner).collect());
    }
    grown
}

/// A wheel from its rim's middle plane.
pub(super) fn wheel(rim: &[Point3<f64>], at: &dyn Fn(&Point3<f64>) -> V3) -> Piece {
    let mut piece = Piece { paint: Paint::Matt(linear(TYRE)), ..Piece::default() };
    let normal = (rim[rim.len() / 3] - rim[0]).cross(&(rim[2 * rim.len() / 3] - rim[0]));
    let half = normal.try_normalize(1e-12).unwrap_or_else(Vector3::y) * (0.5 * TYRE_M);
    let ring = |side: f64| rim.iter().map(|p| at(&(p + half * side))).collect::<Vec<V3>>();
    let (one, other) = (ring(1.0), ring(-1.0));
    add_flat(&mut piece, &one);
    add_flat(&mut piece, &other);
    for i in 0..rim.len() {
        let next = (i + 1) % rim.len();
        add_flat(&mut piece, &[one[i], one[next], other[next], other[i]]);
    }
    piece
}

/// Webbing along points, flat on the trunk whose middles these are; none without two points.
pub(super) fn ribbon(points: &[V3], middles: &[V3]) -> Option<Piece> {
    let mut piece = Piece { before_m: WEBBING_M[1], ..Piece::default() };
    let [half, _] = WEBBING_M;
    for (i, place) in points.iter().enumerate() {
        let before = points[i.saturating_sub(1)];
        let after = points[(i + 1).min(points.len() - 1)];
        let along = (after - before).try_normalize(1e-6)?;
        let nearest = middles.iter().min_by(|a, b| (*a - place).norm().total_cmp(&(*b - place).norm()));
        let out = nearest.map_or_else(V3::z, |m| place - m);
        let side = along.cross(&out).try_normalize(1e-6).unwrap_or_else(V3::y);
        let normal = side.cross(&along);
        let corner = |sign: f32| Corner { place: place + side * (sign * half), normal };
        piece.corners.extend([corner(1.0), corner(-1.0)]);
    }
    let count = points.len().saturating_sub(1) as u32;
    piece.triangles =
        (0..count).flat_map(|i| [[2 * i, 2 * i + 1, 2 * i + 2], [2 * i + 1, 2 * i + 3, 2 * i + 2]]).collect();
    (count > 0).then_some(piece)
}

/// The convex hull of points, by what is farthest in each direction.
pub(super) fn cloth(points: &[V3]) -> Vec<Veil> {
    let mut veils = Vec::new();
    let [round, along] = CLOTH;
    let direction = |i: usize, j: usize| {
        let (height, angle) = (PI * i as f64 / along as f64, TAU * j as f64 / round as f64);
        let ((sine, cosine), (across, beside)) = (trig::sin_cos(height), trig::sin_cos(angle));
        V3::new((sine * beside) as f32, (sine * across) as f32, cosine as f32)
    };
    let far = |d: V3| points.iter().copied().max_by(|a, b| a.dot(&d).total_cmp(&b.dot(&d)));
    for i in 0..along {
        for j in 0..round {
            let corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|[i, j]| far(direction(i, j)));
            let corners: Vec<V3> = corners.into_iter().flatten().collect();
            let flat = corners.len() < 4 || (corners[2] - corners[0]).cross(&(corners[3] - corners[1])).norm() < 1e-8;
            if !flat {
                let normal = (corners[2] - corners[0]).cross(&(corners[3] - corners[1])).normalize();
                let light = 0.72 + 0.28 * normal.z.abs();
                let colour = linear(BAG).map(|c| c * light);
                veils.push(Veil::Sheet { corners, colour, opacity: 0.34 });
            }
        }
    }
    veils
}
