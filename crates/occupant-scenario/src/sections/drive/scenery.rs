//! The road, tyre marks and the outside of driven vehicles, as polygons to draw.

use occupant_units::trig;
use std::f64::consts::TAU;

use nalgebra::{Point3, Vector3};
use vehicle_motion::V3;
use vehicle_motion::ground::Mesh;
use vehicle_motion::marks::marks;

use super::super::Scenario;
use super::super::frames::VEHICLE;
use super::{DrivenVehicle, Drives};
use occupant_core::forces::contact::surface::Frame;
use occupant_core::model::setup::Scenery;

/// Convex polygons.
pub type Polygons = Vec<Vec<Point3<f64>>>;

/// Length of the road beyond the drive, m.
const BEYOND_M: f64 = 12.0;
/// Number of corners of a wheel.
const ROUND: usize = 24;
/// Largest number of pieces of the ground that are drawn, and number of squares along a side that replace more.
const MOST_PIECES: usize = 4000;
const SQUARES: usize = 40;
/// Width of a tyre mark, and its height above the ground, m.
const TREAD_M: f64 = 0.16;
const OVER_M: f64 = 0.01;
/// Length of its parts, m.
const PART_M: f64 = 0.3;

/// A part of a drive to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Its name: "road", "barrier NAME", "VEHICLE marks", "VEHICLE outside".
    pub name: String,
    /// The vehicle in whose axes it stands, forward, right, down from the compartment's origin; otherwise space: x forward, y left, z up.
    pub vehicle: Option<usize>,
    /// Convex polygons, m.
    pub polygons_m: Polygons,
}

/// Road, barriers in their final state, tyre marks and the outsides of the vehicles.
pub fn drawings(drives: &Drives) -> Vec<Drawing> {
    let still = |name: String, polygons_m| Drawing { name, vehicle: None, polygons_m };
    let mut all = vec![still("road".to_owned(), road(drives))];
    for (i, (name, _)) in drives.barriers.iter().enumerate() {
        all.push(still(format!("barrier {name}"), super::standing::polygons(drives, i)));
    }
    for (i, vehicle) in drives.vehicles.iter().enumerate() {
        let name = |what: &str| format!("{} {what}", vehicle.name);
        all.push(still(name("marks"), strips(drives, i)));
        all.push(Drawing { name: name("outside"), vehicle: Some(i), polygons_m: outside(vehicle) });
    }
    all
}

/// All of it, in the frames of a scenario; vehicles that carry nobody are left out.
pub(crate) fn scenery(s: &Scenario, drives: &Drives) -> Vec<Scenery> {
    let carried = |vehicle: usize| {
        let mut names = std::iter::once(VEHICLE).chain(s.vehicles.keys().map(String::as_str));
        names.find(|name| s.driven(name) == Some(vehicle)).and_then(|name| s.frame_named(name))
    };
    let placed = |Drawing { name, vehicle, polygons_m }| {
        let frame = vehicle.map_or(Some(Frame::Space), carried)?;
        Some(Scenery { name, frame, polygons_m })
    };
    drawings(drives).into_iter().filter_map(placed).collect()
}

/// A place on the ground in space axes.
pub(super) fn on_ground(drives: &Drives, x_m: f64, right_m: f64, over_m: f64) -> Point3<f64> {
    Point3::new(x_m, -right_m, drives.world.ground.height_m(x_m, right_m) + over_m)
}

/// The faces of the ground along the drive.
fn road(drives: &Drives) -> Polygons {
    let places = || drives.outcome.rides.iter().flat_map(|ride| ride.stations()).map(|station| station.position_m);
    let least = |axis: usize| places().map(|p| p[axis]).fold(f64::INFINITY, f64::min) - BEYOND_M;
    let most = |axis: usize| places().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max) + BEYOND_M;
    let ([from_m, to_m], [left_m, right_m]) = ([least(0), most(0)], [least(1), most(1)]);
    if let Some(mesh) = drives.world.ground.as_mesh() {
        return faces(drives, mesh, [from_m, left_m], [to_m, right_m]);
    }
    let corners = drives.world.ground.corners_m();
    let last = corners.len() - 2;
    let plane = |(i, pair): (usize, &[[f64; 2]])| {
        // the outer planes go on
        let one = if i == 0 { left_m } else { pair[0][0].max(left_m) };
        let other = if i == last { right_m } else { pair[1][0].min(right_m) };
        let corner = |x: f64, y: f64| on_ground(drives, x, y, 0.0);
        (one < other).then(|| vec![corner(from_m, one), corner(from_m, other), corner(to_m, other), corner(to_m, one)])
    };
    corners.windows(2).enumerate().filter_map(plane).collect()
}

/// The pieces of a mesh within a rectangle; of many, squares at equal distances instead.
fn faces(drives: &Drives, mesh: &Mesh, low_m: [f64; 2], high_m: [f64; 2]) -> Polygons {
    let cut = |piece: Vec<V3>| {
        let corners: Vec<_> = piece.iter().map(|corner| Point3::new(corner.x, -corner.y, -corner.z)).collect();
        // space axes: y to the left
        let sides = [(0, low_m[0], 1.0), (0, high_m[0], -1.0), (1, -high_m[1], 1.0), (1, -low_m[1], -1.0)];
        let part = sides.iter().fold(corners, |polygon, side| clipped(&polygon, *side));
        (part.len() > 2).then_some(part)
    };
    let shown: Polygons = mesh.pieces_m().into_iter().filter_map(cut).take(MOST_PIECES + 1).collect();
    if shown.len() <= MOST_PIECES {
        return shown;
    }
    let at = |i: usize, j: usize| {
        let place = |axis: usize, k: usize| low_m[axis] + (high_m[axis] - low_m[axis]) * k as f64 / SQUARES as f64;
        on_ground(drives, place(0, i), place(1, j), 0.0)
    };
    let square = |i: usize, j: usize| {
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]].map(Vec::from)
    };
    (0..SQUARES).flat_map(|i| (0..SQUARES).flat_map(move |j| square(i, j))).collect()
}

/// The part of a convex polygon on one side of a plane across an axis.
fn clipped(polygon: &[Point3<f64>], (axis, at_m, sign): (usize, f64, f64)) -> Vec<Point3<f64>> {
    let inside = |point: &Point3<f64>| sign * (point[axis] - at_m);
    let mut kept = Vec::new();
    for (i, to) in polygon.iter().enumerate() {
        let from = &polygon[(i + polygon.len() - 1) % polygon.len()];
        let (before, after) = (inside(from), inside(to));
        if before * after < 0.0 {
            kept.push(from + (to - from) * (before / (before - after)));
        }
        if after >= 0.0 {
            kept.push(*to);
        }
    }
    kept
}

/// Tyre marks as strips.
fn strips(drives: &Drives, vehicle: usize) -> Polygons {
    let mut strips = Vec::new();
    for mark in marks(&drives.outcome.rides[vehicle], &drives.world.ground) {
        for pair in thinned(&mark.points_m).windows(2) {
            let way = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let length_m = trig::hypot(way[0], way[1]);
            if length_m > 0.0 {
                let aside = [-way[1], way[0]].map(|x| 0.5 * TREAD_M * x / length_m);
                let at =
                    |p: [f64; 2], side: f64| on_ground(drives, p[0] + side * aside[0], p[1] + side * aside[1], OVER_M);
                strips.push(vec![at(pair[0], -1.0), at(pair[0], 1.0), at(pair[1], 1.0), at(pair[1], -1.0)]);
            }
        }
    }
    strips
}

/// Points of a line at least `PART_M` apart, with both ends: one strip for each step of a run would draw a ladder.
fn thinned(points_m: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for (i, point) in points_m.iter().enumerate() {
        let is_far = |last: &[f64; 2]| trig::hypot(point[0] - last[0], point[1] - last[1]) >= PART_M;
        if i + 1 == points_m.len() || kept.last().is_none_or(is_far) {
            kept.push(*point);
        }
    }
    kept
}

/// Body, cabin and wheels in the axes of the compartment.
fn outside(vehicle: &DrivenVehicle) -> Polygons {
    let (car, body) = (&vehicle.car, &vehicle.car.body);
    let rear_m = body.front_m - body.length_m;
    let at =
        |x: f64, y: f64, height_m: f64| Point3::from(Vector3::new(x, y, car.height_m - height_m) - vehicle.origin_m);
    // heights: sill, belt line, roof
    let [sill_m, belt_m, roof_m] = [0.2, 0.63 * body.height_m, body.height_m];
    let [half_m, top_m] = [0.5 * body.width_m, 0.38 * body.width_m];
    let mut all = frustum(&at, [rear_m, body.front_m], half_m, sill_m, [rear_m, body.front_m], half_m, belt_m);
    let cabin = [rear_m + 0.12 * body.length_m, body.front_m - 0.26 * body.length_m];
    let roof = [rear_m + 0.24 * body.length_m, body.front_m - 0.45 * body.length_m];
    all.extend(frustum(&at, cabin, half_m, belt_m, roof, top_m, roof_m));
    for axle in [&car.front, &car.rear] {
        for side in [-0.5, 0.5] {
            let rim = (0..ROUND).map(|i| {
                let (sine, cosine) = trig::sin_cos(TAU * i as f64 / ROUND as f64);
                let radius_m = car.tyre.radius_m;
                at(axle.ahead_m + radius_m * cosine, side * axle.track_m, radius_m * (1.0 + sine))
            });
            all.push(rim.collect());
        }
    }
    all
}

/// The sides and the top of a block that may narrow upwards.
fn frustum(
    at: &dyn Fn(f64, f64, f64) -> Point3<f64>,
    [back_m, front_m]: [f64; 2],
    half_m: f64,
    low_m: f64,
    [top_back_m, top_front_m]: [f64; 2],
    top_half_m: f64,
    high_m: f64,
) -> Polygons {
    let low = |x: f64, side: f64| at(x, side * half_m, low_m);
    let high = |x: f64, side: f64| at(x, side * top_half_m, high_m);
    let side = |s: f64| vec![low(back_m, s), low(front_m, s), high(top_front_m, s), high(top_back_m, s)];
    let end = |x: f64, top: f64| vec![low(x, -1.0), low(x, 1.0), high(top, 1.0), high(top, -1.0)];
    let top = [(top_back_m, -1.0), (top_front_m, -1.0), (top_front_m, 1.0), (top_back_m, 1.0)];
    vec![
        side(-1.0),
        side(1.0),
        end(back_m, top_back_m),
        end(front_m, top_front_m),
        top.map(|(x, s)| high(x, s)).to_vec(),
    ]
}
