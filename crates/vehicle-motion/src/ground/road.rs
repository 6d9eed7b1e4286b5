//! A road: a line of straights and arcs in plan, with cross-sections along it.

use libm::{atan2, sincos, tan};

use super::mesh::{Mesh, Row};
use super::{FAR_M, GroundError};
use crate::V3;

/// Distance of rows in bends and where the cross-section changes, m.
const ROW_M: f64 = 1.0;
/// Largest number of rows.
const MOST_ROWS: usize = 100_000;
/// Largest coordinate of the line, m.
const FARTHEST_M: f64 = 1e6;
/// How much of a bend's radius the ground may reach inwards.
const INWARD: f64 = 0.95;

/// A road as data. Distances along its line are counted from its first point.
#[derive(Clone, Debug, PartialEq)]
pub struct Road {
    /// Points of its line in plan, X and Y, m; it goes on straight before the first and behind the last.
    pub line_m: Vec<[f64; 2]>,
    /// Radius of the arcs that round the inner points, m.
    pub radius_m: f64,
    /// Cross-sections; between them the ground changes linearly.
    pub stations: Vec<Station>,
    /// Rise along the line.
    pub grade: f64,
}

/// A cross-section at a place along the road.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Distance along the line, m.
    pub at_m: f64,
    /// Corners from left to right: distance right of the line, and height above the line's, m.
    pub corners_m: Vec<[f64; 2]>,
}

/// A straight or an arc.
#[derive(Clone, Copy, Debug)]
struct Part {
    from_m: [f64; 2],
    heading_rad: f64,
    length_m: f64,
    /// 1/radius, positive to the right; 0 of a straight.
    bend_per_m: f64,
}

impl Part {
    fn row(&self, along_m: f64) -> Row {
        let [x, y] = self.from_m;
        let (sine, cosine) = sincos(self.heading_rad);
        if self.bend_per_m == 0.0 {
            return Row { at_m: [x + cosine * along_m, y + sine * along_m], way: [cosine, sine] };
        }
        let radius_m = 1.0 / self.bend_per_m;
        let (late_sine, late_cosine) = sincos(self.heading_rad + along_m * self.bend_per_m);
        let at_m = [x + radius_m * (late_sine - sine), y - radius_m * (late_cosine - cosine)];
        Row { at_m, way: [late_cosine, late_sine] }
    }
}

impl Road {
    /// The ground of the road.
    ///
    /// # Errors
    /// Fewer than two points or no cross-section, numbers that are not finite, arcs that do not fit between the
    /// points, cross-sections that do not rise to the right, differ in their number of corners or reach beyond the
    /// centre of a bend.
    pub fn mesh(&self) -> Result<Mesh, GroundError> {
        self.check()?;
        let parts = self.parts()?;
        let spread_m = self.spread_m(&parts)?;
        let mut rows = Vec::new();
        let mut corners_m = Vec::new();
        let mut start_m = 0.0;
        let last = parts.len() - 1;
        for (i, part) in parts.iter().enumerate() {
            // cross-sections may lie before the first point and behind the last
            let least_m = self.stations.first().filter(|_| i == 0).map_or(0.0, |station| station.at_m.min(0.0));
            let behind = self.stations.last().filter(|_| i == last).map_or(0.0, |station| station.at_m - start_m);
            let ends_m = [least_m, part.length_m.max(behind)];
            let mut places = self.places_m(part, start_m, ends_m, rows.len())?;
            if i == 0 {
                places.insert(0, least_m - FAR_M);
            } else {
                // the end of the part before
                places.remove(0);
            }
            if i == last {
                places.push(ends_m[1] + FAR_M);
            }
            for along_m in places {
                let row = part.row(along_m);
                corners_m.extend(self.corners(&row, start_m + along_m, spread_m));
                rows.push(row);
            }
            start_m += part.length_m;
        }
        Ok(Mesh::along(rows, corners_m))
    }

    fn check(&self) -> Result<(), GroundError> {
        let refuse = |found: String| Err(GroundError::Road(found));
        if self.line_m.len() < 2 {
            return refuse(format!("a line of {} points; expected at least two", self.line_m.len()));
        }
        let numbers = self.line_m.iter().flatten().chain([&self.grade, &self.radius_m]);
        if numbers.chain(self.stations.iter().map(|station| &station.at_m)).any(|x| !x.is_finite()) {
            return Err(GroundError::NotFinite);
        }
        if let Some(far) = self.line_m.iter().flatten().find(|x| x.abs() > FARTHEST_M) {
            return refuse(format!("a point of the line at {far} m; expected at most {FARTHEST_M} m"));
        }
        let Some(first) = self.stations.first() else { return refuse("a road without a cross-section".into()) };
        for (i, station) in self.stations.iter().enumerate() {
            super::Ground::section(station.corners_m.clone(), self.grade)?;
            if station.corners_m.len() != first.corners_m.len() {
                let (found, expected) = (station.corners_m.len(), first.corners_m.len());
                return refuse(format!(
                    "{found} corners in cross-section {}; expected {expected}, as in the first",
                    i + 1
                ));
            }
            if i > 0 && station.at_m <= self.stations[i - 1].at_m {
                return refuse(format!("cross-section {} is not ahead of the one before", i + 1));
            }
        }
        Ok(())
    }

    /// Straights and arcs.
    fn parts(&self) -> Result<Vec<Part>, GroundError> {
        let legs: Vec<(f64, f64)> = self.line_m.windows(2).map(|pair| leg(pair[0], pair[1])).collect();
        if let Some(short) = legs.iter().position(|(length_m, _)| *length_m <= 0.0) {
            return Err(GroundError::Road(format!("points {} and {} of the line are the same", short + 1, short + 2)));
        }
        let turn = |i: usize| {
            let rad = legs[i].1 - legs[i - 1].1;
            rad - core::f64::consts::TAU * (rad / core::f64::consts::TAU).round()
        };
        // what an arc takes of the legs on both sides
        let tangent = |i: usize| {
            if i == 0 || i == legs.len() { 0.0 } else { self.radius_m * tan(0.5 * turn(i).abs()) }
        };
        let mut parts: Vec<Part> = Vec::new();
        for (i, &(length_m, heading_rad)) in legs.iter().enumerate() {
            let [before_m, after_m] = [tangent(i), tangent(i + 1)];
            let left_m = length_m - before_m - after_m;
            if !(left_m >= -1e-9 * length_m && before_m >= 0.0 && after_m >= 0.0) {
                let (number, next) = (i + 1, i + 2);
                return Err(GroundError::Road(format!(
                    "arcs of {} m take {:.3} m of the {length_m:.3} m between points {number} and {next}; expected a \
                     smaller radius, or points further apart",
                    self.radius_m,
                    before_m + after_m
                )));
            }
            if i > 0 && turn(i) != 0.0 {
                let from_m = parts.last().map_or([0.0; 2], |part| part.row(part.length_m).at_m);
                let bend_per_m = (1.0 / self.radius_m).copysign(turn(i));
                let arc_m = self.radius_m * turn(i).abs();
                parts.push(Part { from_m, heading_rad: legs[i - 1].1, length_m: arc_m, bend_per_m });
            }
            let from_m = parts.last().map_or(self.line_m[0], |part| part.row(part.length_m).at_m);
            parts.push(Part { from_m, heading_rad, length_m: left_m.max(0.0), bend_per_m: 0.0 });
        }
        Ok(parts)
    }

    /// How far the outer planes go on to the left and to the right, m.
    fn spread_m(&self, parts: &[Part]) -> Result<[f64; 2], GroundError> {
        let out_m = |side: usize| {
            let sign = [-1.0, 1.0][side];
            let last = |station: &Station| sign * station.corners_m[side * (station.corners_m.len() - 1)][0];
            self.stations.iter().map(last).fold(0.0, f64::max)
        };
        let mut spread_m = [FAR_M; 2];
        for part in parts.iter().filter(|part| part.bend_per_m != 0.0) {
            let side = usize::from(part.bend_per_m > 0.0);
            let left_m = INWARD / part.bend_per_m.abs() - out_m(side);
            if left_m <= 0.0 {
                return Err(GroundError::Road(format!(
                    "a cross-section that reaches {} m to the inside of a bend of {} m; expected less than {INWARD} of \
                     the radius",
                    out_m(side),
                    self.radius_m
                )));
            }
            spread_m[side] = spread_m[side].min(left_m);
        }
        Ok(spread_m)
    }

    /// Where rows stand in a part, from its start, m: at these ends, and close together in bends and where the
    /// cross-section changes. `before` is the number of rows there are.
    fn places_m(&self, part: &Part, start_m: f64, ends_m: [f64; 2], before: usize) -> Result<Vec<f64>, GroundError> {
        let mut stops = ends_m.to_vec();
        let inner = |along_m: &f64| *along_m > ends_m[0] && *along_m < ends_m[1];
        stops.extend(self.stations.iter().map(|station| station.at_m - start_m).filter(inner));
        stops.sort_by(f64::total_cmp);
        let mut places = vec![ends_m[0]];
        for pair in stops.windows(2) {
            let changes = part.bend_per_m != 0.0 || self.changes(start_m + 0.5 * (pair[0] + pair[1]));
            let count = if changes { ((pair[1] - pair[0]) / ROW_M).ceil().max(1.0) } else { 1.0 };
            if before as f64 + places.len() as f64 + count > MOST_ROWS as f64 {
                let found = format!("a road of more than {MOST_ROWS} m in bends and changes of its cross-section");
                return Err(GroundError::Road(found));
            }
            places.extend((1..=count as usize).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / count));
        }
        places.dedup();
        Ok(places)
    }

    /// The cross-sections before and after a place, and the share of the latter.
    fn around(&self, at_m: f64) -> (&Station, &Station, f64) {
        let next = self.stations.partition_point(|station| station.at_m <= at_m);
        let last = self.stations.len() - 1;
        let (from, to) = (&self.stations[next.saturating_sub(1)], &self.stations[next.min(last)]);
        let share = if to.at_m > from.at_m { (at_m - from.at_m) / (to.at_m - from.at_m) } else { 0.0 };
        (from, to, share)
    }

    fn changes(&self, at_m: f64) -> bool {
        let (from, to, _) = self.around(at_m);
        from.corners_m != to.corners_m
    }

    /// Corners of a row, m.
    fn corners(&self, row: &Row, at_m: f64, spread_m: [f64; 2]) -> Vec<V3> {
        let (from, to, share) = self.around(at_m);
        let blend = |(a, b): (&[f64; 2], &[f64; 2])| [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
        let mut corners: Vec<[f64; 2]> = from.corners_m.iter().zip(&to.corners_m).map(blend).collect();
        let beyond = |[right, up]: [f64; 2], [inner, level]: [f64; 2], way_m: f64| {
            [right + way_m, up + (up - level) / (right - inner) * way_m]
        };
        let last = corners.len() - 1;
        let [left, right] =
            [beyond(corners[0], corners[1], -spread_m[0]), beyond(corners[last], corners[last - 1], spread_m[1])];
        corners.insert(0, left);
        corners.push(right);
        let placed = |[right_m, up_m]: [f64; 2]| {
            let [x, y] = row.place_m(right_m);
            V3::new(x, y, -up_m - self.grade * at_m)
        };
        corners.into_iter().map(placed).collect()
    }
}

/// Length and heading between two points.
fn leg(from: [f64; 2], to: [f64; 2]) -> (f64, f64) {
    let [x, y] = [to[0] - from[0], to[1] - from[1]];
    ((x * x + y * y).sqrt(), atan2(y, x))
}
