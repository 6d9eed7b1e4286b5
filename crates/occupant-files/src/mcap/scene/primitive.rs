//! Primitives of an entity. Sizes of spheres and cylinders are diameters; a cylinder's axis is its Z, an arrow's its X.

use std::f64::consts::PI;

use nalgebra::{Point3, UnitQuaternion, Vector3};

use super::Color;
use crate::mcap::wire::Wire;

/// An ellipsoid along the frame's axes.
pub fn ellipsoid(wire: &mut Wire, centre_m: Vector3<f64>, size_m: Vector3<f64>, color: Color) {
    wire.message(9, |w| {
        pose(w, centre_m, UnitQuaternion::identity());
        w.vector(2, &size_m);
        paint(w, 3, color);
    });
}

/// An elliptic cylinder; `size_m` is along its own axes.
pub fn cylinder(
    wire: &mut Wire,
    centre_m: Vector3<f64>,
    orientation: UnitQuaternion<f64>,
    size_m: Vector3<f64>,
    color: Color,
) {
    wire.message(10, |w| {
        pose(w, centre_m, orientation);
        w.vector(2, &size_m);
        w.number(3, 1.0);
        w.number(4, 1.0);
        paint(w, 5, color);
    });
}

/// An arrow along `arrow_m`.
pub fn arrow(wire: &mut Wire, start_m: Vector3<f64>, arrow_m: Vector3<f64>, diameter_m: f64, color: Color) {
    let length_m = arrow_m.norm();
    let head_m = (3.0 * diameter_m).min(0.5 * length_m);
    // None for the half turn from X to −X
    let turn = UnitQuaternion::rotation_between(&Vector3::x(), &arrow_m)
        .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::z_axis(), PI));
    wire.message(7, |w| {
        pose(w, start_m, turn);
        w.number(2, length_m - head_m);
        w.number(3, diameter_m);
        w.number(4, head_m);
        w.number(5, 2.0 * diameter_m);
        paint(w, 6, color);
    });
}

/// Whether a line is closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closing {
    /// `LINE_STRIP`.
    Open = 0,
    /// `LINE_LOOP`.
    Closed = 1,
}

/// A line through `points_m`.
pub fn line(wire: &mut Wire, closing: Closing, points_m: &[Point3<f64>], thickness_m: f64, color: Color) {
    wire.message(11, |w| {
        w.count(1, closing as u64);
        // field 2 here, unlike the other primitives
        w.message(2, |w| pose_fields(w, Vector3::zeros(), UnitQuaternion::identity()));
        w.number(3, thickness_m);
        w.flag(4, false);
        points_m.iter().for_each(|p| w.vector(5, &p.coords));
        paint(w, 6, color);
    });
}

/// A convex polygon as triangles.
pub fn polygon(wire: &mut Wire, corners_m: &[Point3<f64>], color: Color) {
    let last = corners_m.len() as u32;
    let fan: Vec<u32> = (2..last).flat_map(|i| [0, i - 1, i]).collect();
    wire.message(12, |w| {
        pose(w, Vector3::zeros(), UnitQuaternion::identity());
        corners_m.iter().for_each(|p| w.vector(2, &p.coords));
        paint(w, 3, color);
        w.indices(5, &fan);
    });
}

/// A text that faces the viewer.
pub fn text(wire: &mut Wire, place_m: Vector3<f64>, height_m: f64, color: Color, words: &str) {
    wire.message(13, |w| {
        pose(w, place_m, UnitQuaternion::identity());
        w.flag(2, true);
        w.number(3, height_m);
        w.flag(4, false);
        paint(w, 5, color);
        w.text(6, words);
    });
}

fn pose(wire: &mut Wire, position_m: Vector3<f64>, orientation: UnitQuaternion<f64>) {
    wire.message(1, |w| pose_fields(w, position_m, orientation));
}

fn pose_fields(wire: &mut Wire, position_m: Vector3<f64>, orientation: UnitQuaternion<f64>) {
    wire.vector(1, &position_m);
    wire.rotation(2, &orientation);
}

fn paint(wire: &mut Wire, field: u32, Color(r, g, b, a): Color) {
    wire.message(field, |w| {
        w.number(1, r);
        w.number(2, g);
        w.number(3, b);
        w.number(4, a);
    });
}
