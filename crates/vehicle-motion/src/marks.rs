//! Tyre marks: where a tyre uses nearly all of its friction.

use crate::WHEELS;
use crate::ground::Ground;
use crate::ride::{Ride, Station};

/// Least utilisation of friction for a tyre mark, and least load, N.
const USED: f64 = 0.8;
const BEARS_N: f64 = 200.0;
/// Shortest mark, m.
const SHORTEST_M: f64 = 0.2;

/// A tyre mark.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Number of the wheel.
    pub wheel: usize,
    /// "skid" (longitudinal), "yaw" (lateral), "furrow" (in soil).
    pub kind: &'static str,
    /// From, s.
    pub from_s: f64,
    /// Until, s.
    pub until_s: f64,
    /// Length in plan, m.
    pub length_m: f64,
    /// Places, x and y, m.
    pub points_m: Vec<[f64; 2]>,
}

/// Marks of all wheels of a ride.
pub fn marks(ride: &Ride, ground: &Ground) -> Vec<Mark> {
    let mut marks = Vec::new();
    for wheel in 0..WHEELS {
        let leaves = |station: &Station| {
            let report = &station.wheels[wheel];
            report.saturation > USED && report.load_n > BEARS_N
        };
        for run in ride.stations().chunk_by(|a, b| leaves(a) == leaves(b)).filter(|run| leaves(&run[0])) {
            let mark = mark(wheel, run, ground);
            if mark.length_m >= SHORTEST_M {
                marks.push(mark);
            }
        }
    }
    marks
}

fn mark(wheel: usize, run: &[Station], ground: &Ground) -> Mark {
    let points_m: Vec<[f64; 2]> =
        run.iter().map(|station| [station.wheels[wheel].contact_m.x, station.wheels[wheel].contact_m.y]).collect();
    let sum = |of: &dyn Fn(&Station) -> f64| run.iter().map(of).sum::<f64>();
    let [along, across] = [0, 1].map(|axis: usize| sum(&|station| station.wheels[wheel].slide_m_s[axis].abs()));
    let furrows =
        points_m.iter().filter(|point| ground.zone(point[0], point[1]).is_some_and(|zone| zone.lateral > 1.0)).count();
    let kind = match () {
        () if 2 * furrows > points_m.len() && across > along => "furrow",
        () if across > along => "yaw",
        () => "skid",
    };
    let way = |pair: &[[f64; 2]]| libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
    let length_m = points_m.windows(2).map(way).sum();
    Mark { wheel, kind, from_s: run[0].time_s, until_s: run[run.len() - 1].time_s, length_m, points_m }
}
