//! Outlines of solids, for pictures.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Point3, Vector3};

use super::distance::Section;
use super::{Shape, Solid, build};
use occupant_units::trig;

/// Corners of a circle.
const ROUND: usize = 24;
/// Corners of the tube about a rim.
const TUBE: usize = 8;
/// A half space is drawn so far about its point, m.
const PLANE_M: f64 = 1.0;

impl Solid {
    /// Convex polygons that bound it, in the axes of its frame, m: round parts by chords, edges without their rounding, a
    /// half space by a square of its plane; none of a shape that has no thickness.
    pub fn outline(&self) -> Vec<Vec<Point3<f64>>> {
        let Ok(shape) = build(&self.shape) else { return Vec::new() };
        let (form, axes) = (&shape.whole, shape.whole.axes.to_matrix());
        let place = |p: &Vector3<f64>| Point3::from(form.centre.to_vector() + axes * p);
        let (ends, rounding) = (form.ends, form.rounding);
        let corners: Vec<[f64; 2]> = match (&form.section, &self.shape) {
            (Section::Ring(ring), _) => {
                return about_ring(*ring, rounding).iter().map(|polygon| polygon.iter().map(place).collect()).collect();
            }
            (Section::Round(radius), _) => circle(ROUND).map(|point| point.map(|x| x * (radius + rounding))).collect(),
            (_, Shape::Prism { corners_m, .. }) => in_order(corners_m, &axes, &form.centre.to_vector()),
            _ => {
                let square = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
                return vec![square.map(|[u, v]| place(&Vector3::new(PLANE_M * u, PLANE_M * v, ends[0]))).to_vec()];
            }
        };
        let polygons = between(&corners, -ends[1] - rounding, ends[0] + rounding);
        polygons.iter().map(|polygon| polygon.iter().map(place).collect()).collect()
    }

    /// A closed line that tells where it is, frame axes, m: the middle of a rim's tube, one end of what has ends.
    pub fn edge(&self) -> Vec<Point3<f64>> {
        let Ok(shape) = build(&self.shape) else { return Vec::new() };
        let form = &shape.whole;
        let Section::Ring(ring) = form.section else { return self.outline().into_iter().next().unwrap_or_default() };
        let axes = form.axes.to_matrix();
        let place = |[c, s]: [f64; 2]| form.centre.to_vector() + axes * Vector3::new(c * ring, s * ring, 0.0);
        circle(ROUND).map(|point| place(point).into()).collect()
    }
}

/// Points of a unit circle, counter-clockwise.
fn circle(count: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |i| trig::sin_cos(TAU * i as f64 / count as f64)).map(|(sine, cosine)| [cosine, sine])
}

/// Corners in the plane of the first two axes, counter-clockwise.
fn in_order(corners: &[Point3<f64>], axes: &Matrix3<f64>, centre: &Vector3<f64>) -> Vec<[f64; 2]> {
    let flat = |p: &Point3<f64>| axes.tr_mul(&(p.coords - centre));
    let mut flat: Vec<[f64; 2]> = corners.iter().map(flat).map(|p| [p.x, p.y]).collect();
    flat.sort_by(|a, b| trig::atan2(a[1], a[0]).total_cmp(&trig::atan2(b[1], b[0])));
    flat
}

/// Both ends and all sides of a prism.
fn between(corners: &[[f64; 2]], low: f64, high: f64) -> Vec<Vec<Vector3<f64>>> {
    let at = |[u, v]: [f64; 2], w: f64| Vector3::new(u, v, w);
    let ends = [corners.iter().rev().map(|c| at(*c, low)).collect(), corners.iter().map(|c| at(*c, high)).collect()];
    let side = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        vec![at(from, low), at(to, low), at(to, high), at(from, high)]
    };
    ends.into_iter().chain((0..corners.len()).map(side)).collect()
}

/// Quadrangles round the tube of a rim.
fn about_ring(ring: f64, radius: f64) -> Vec<Vec<Vector3<f64>>> {
    let at = |[c, s]: [f64; 2], [a, b]: [f64; 2]| {
        let out = ring + radius * a;
        Vector3::new(c * out, s * out, radius * b)
    };
    let (around, tube): (Vec<_>, Vec<_>) = (circle(ROUND).collect(), circle(TUBE).collect());
    let piece = |i: usize, j: usize| {
        let (next, up) = (around[(i + 1) % ROUND], tube[(j + 1) % TUBE]);
        vec![at(around[i], tube[j]), at(next, tube[j]), at(next, up), at(around[i], up)]
    };
    (0..ROUND).flat_map(|i| (0..TUBE).map(move |j| (i, j))).map(|(i, j)| piece(i, j)).collect()
}
