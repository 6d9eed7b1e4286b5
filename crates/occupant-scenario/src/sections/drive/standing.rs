//! Barriers as polygons to draw.

use occupant_units::trig;
use std::f64::consts::TAU;

use nalgebra::Point3;
use vehicle_motion::barrier::{Barrier, Rail, Slider, Wall};
use vehicle_motion::world::{Bend, Bent};

use super::Drives;
use super::scenery::{Polygons, on_ground};

/// Default heights of barriers, m.
const WALL_M: f64 = 0.9;
const POLE_M: f64 = 2.4;
/// Length of a wall drawn beyond the drive, m.
const BEYOND_M: f64 = 5.0;
/// Half width of a post, m.
const POST_M: f64 = 0.06;
/// Sides of a pole.
const ROUND: usize = 12;

/// A barrier by its number; a rail and a cushion in their final state.
pub(super) fn polygons(drives: &Drives, number: usize) -> Polygons {
    match &drives.world.barriers[number] {
        Barrier::Wall(wall) => vec![face(drives, wall)],
        Barrier::Pole(pole) => upright(drives, &round(pole.at_m, pole.radius_m), [0.0, POLE_M]),
        Barrier::Block(block) => upright(drives, &block.corners_m, [0.0, WALL_M]),
        Barrier::Rail(rail) => {
            let bent = drives.outcome.rails.iter().find(|bent| bent.barrier == number);
            of_rail(drives, rail, bent.map_or(&rail.line_m[..], |bent| &bent.line_m))
        }
        Barrier::Slider(slider) => of_slider(drives, number, slider),
    }
}

/// Each rail while it moves: the number of its barrier, and from each time on, s, its polygons.
pub fn moving_rails(drives: &Drives) -> Vec<(usize, Vec<(f64, Polygons)>)> {
    let of = |bent: &Bent| match &drives.world.barriers[bent.barrier] {
        Barrier::Rail(rail) => {
            let at = |bend: &Bend| (bend.time_s, of_rail(drives, rail, &bend.line_m));
            Some((bent.barrier, bent.moving.iter().map(at).collect()))
        }
        _ => None,
    };
    drives.outcome.rails.iter().filter_map(of).collect()
}

/// Corners of the outline of a pole.
fn round([x, y]: [f64; 2], radius_m: f64) -> Vec<[f64; 2]> {
    let corner = |i: usize| {
        let (sine, cosine) = trig::sin_cos(TAU * i as f64 / ROUND as f64);
        [x + radius_m * cosine, y + radius_m * sine]
    };
    (0..ROUND).map(corner).collect()
}

/// The part of a wall's face beside the drive.
fn face(drives: &Drives, wall: &Wall) -> Vec<Point3<f64>> {
    let (sine, cosine) = trig::sin_cos(wall.normal_rad);
    let along = |x: f64, y: f64| (y - wall.point_m[1]) * cosine - (x - wall.point_m[0]) * sine;
    let stations = drives.outcome.rides.iter().flat_map(|ride| ride.stations());
    let places = stations.map(|station| along(station.position_m.x, station.position_m.y));
    let [from, to] = places.fold([0.0, 0.0], |[least, most]: [f64; 2], at| [least.min(at), most.max(at)]);
    let at = |way: f64, up: f64| {
        let way = way + BEYOND_M.copysign(way);
        on_ground(drives, wall.point_m[0] - sine * way, wall.point_m[1] + cosine * way, up)
    };
    vec![at(from.min(-1e-9), 0.0), at(to, 0.0), at(to, WALL_M), at(from.min(-1e-9), WALL_M)]
}

/// Sides and top of a prism between two heights.
fn upright(drives: &Drives, corners: &[[f64; 2]], [foot, top]: [f64; 2]) -> Polygons {
    let at = |[x, y]: [f64; 2], up: f64| on_ground(drives, x, y, up);
    let side = |i: usize| {
        let [a, b] = [corners[i], corners[(i + 1) % corners.len()]];
        vec![at(a, foot), at(b, foot), at(b, top), at(a, top)]
    };
    let roof = corners.iter().map(|corner| at(*corner, top)).collect();
    (0..corners.len()).map(side).chain([roof]).collect()
}

/// The strip of a rail along a line, and its posts in their initial position.
fn of_rail(drives: &Drives, rail: &Rail, line: &[[f64; 2]]) -> Polygons {
    let [low, high] = rail.band_m;
    let at = |[x, y]: [f64; 2], up: f64| on_ground(drives, x, y, up);
    let strip = |pair: &[[f64; 2]]| vec![at(pair[0], low), at(pair[1], low), at(pair[1], high), at(pair[0], high)];
    let [from, to] = rail.line_m;
    let way = [to[0] - from[0], to[1] - from[1]];
    let posts = (trig::hypot(way[0], way[1]) / rail.spacing_m).floor() as usize;
    let post = |i: usize| {
        let share = i as f64 * rail.spacing_m / trig::hypot(way[0], way[1]);
        let [x, y] = [from[0] + share * way[0], from[1] + share * way[1]];
        let corner = |dx: f64, up: f64| at([x + dx * way[0].signum() * POST_M, y], up);
        vec![corner(-1.0, 0.0), corner(1.0, 0.0), corner(1.0, high), corner(-1.0, high)]
    };
    line.windows(2).map(strip).chain((0..=posts).map(post)).collect()
}

/// A cushion from its final nose to its back; a sign in its initial position.
fn of_slider(drives: &Drives, number: usize, slider: &Slider) -> Polygons {
    let Some(direction_rad) = slider.direction_rad else { return upright(drives, &slider.corners_m, [0.0, POLE_M]) };
    let (sine, cosine) = trig::sin_cos(direction_rad);
    let along = |[x, y]: [f64; 2]| x * cosine + y * sine;
    let ends = slider.corners_m.iter().map(|corner| along(*corner));
    let [nose, back] = ends.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], at| [a.min(at), b.max(at)]);
    let pushed = (nose + drives.outcome.slides[number].most_m).min(back - 0.1 * (back - nose));
    let moved = |corner: &[f64; 2]| {
        let way = (pushed - along(*corner)).max(0.0);
        [corner[0] + way * cosine, corner[1] + way * sine]
    };
    upright(drives, &slider.corners_m.iter().map(moved).collect::<Vec<_>>(), [0.0, WALL_M])
}
