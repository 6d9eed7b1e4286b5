//! The vehicle's path (series 12): order, cover of the run, unwrapped angles, speed of the occupant.

use nalgebra::Vector3;
use occupant_core::vehicle::{AfterEnd, Interpolation, PathCursor, Station, TablePath, VehiclePath};

use super::Check;
use crate::deck::DeckCard;
use crate::rule::Rule;

/// Relative difference of the speeds of vehicle and occupant above which they contradict.
const SPEED_TOLERANCE: f64 = 0.1;
const FASTEST_IN_PER_S: f64 = 3000.0;

pub(super) fn check(c: &mut Check<'_>) {
    if c.value("MREAD") != 0.0 {
        return;
    }
    let numbers = |card: &DeckCard| card.numbers.iter().map(|n| n.value).collect::<Vec<_>>();
    let stations: Vec<Vec<f64>> = c.deck.cards_of(12, 'b').map(numbers).filter(|n| n.len() >= 7).collect();
    for (index, pair) in stations.windows(2).enumerate() {
        check_step(c, index + 2, &pair[0], &pair[1]);
    }
    check_cover(c, &stations);
    check_speed(c, &stations);
}

fn check_step(c: &mut Check<'_>, station: usize, before: &[f64], after: &[f64]) {
    let message = format!("not after the station before it, {}", before[0]);
    c.wrong_if(after[0] <= before[0], Rule::Impossible, format!("CALT({station})"), message)
        .expected("times that grow from card to card", "sort the stations, or remove the doubled one");
    for (place, name) in [(4, "CALPH"), (5, "CALTH"), (6, "CALPS")] {
        let jump = (after[place] - before[place]).abs();
        let message = format!("it jumps by {jump} degrees from the station before");
        let remedy = "let the angle run on beyond 180 degrees instead of starting again at −180";
        c.wrong_if(jump > 180.0, Rule::Impossible, format!("{name}({station})"), message)
            .expected("unwrapped angles", remedy);
    }
    let way = way(before, after);
    let fast = after[0] > before[0] && way / (after[0] - before[0]) > FASTEST_IN_PER_S;
    let message = format!("the vehicle moves {way:.3} in from the station before, faster than 170 mph");
    c.wrong_if(fast, Rule::Unlikely, format!("CALX({station})"), message)
        .expected("positions in inches, times in seconds", "look for the decimal point");
}

/// Displacement of the vehicle between two stations, in.
fn way(before: &[f64], after: &[f64]) -> f64 {
    (1..=3).map(|axis| (after[axis] - before[axis]).powi(2)).sum::<f64>().sqrt()
}

fn check_cover(c: &mut Check<'_>, stations: &[Vec<f64>]) {
    let (Some(first), Some(last)) = (stations.first(), stations.last()) else { return };
    let (start, end) = (c.value("T1"), c.value("TF"));
    let mut report = |name: &str, message: String| {
        c.problem(Rule::PathTooShort, name, message)
            .expected("stations from T1 or earlier to TF or later", "add stations, or change T1 and TF on card 3");
    };
    if first[0] > start {
        report("CALT(1)", format!("the path begins at {} s and the run at T1 = {start} s", first[0]));
    }
    if last[0] < end {
        let name = format!("CALT({})", stations.len());
        report(&name, format!("the path ends at {} s and the run at TF = {end} s", last[0]));
    }
    if stations.len() == 1 {
        report("NVPOS", "one station makes no path".to_owned());
    }
}

/// The occupant usually starts with the vehicle's velocity; a factor of 12 or 17.6 between their speeds is an error of
/// unit.
fn check_speed(c: &mut Check<'_>, stations: &[Vec<f64>]) {
    let Some(vehicle) = velocity_at(stations, c.value("T1")).filter(|_| c.value("NPOS") == 0.0) else { return };
    let names = ["VXVC", "VYVC", "VZVC"];
    let occupant = Vector3::from(names.map(|name| c.value(name)));
    let apart = vehicle - occupant;
    let near = |factor: f64| (vehicle.norm() / occupant.norm() / factor - 1.0).abs() < 0.05;
    let (rule, message) = if near(12.0) {
        (Rule::LooksLikeOtherUnit, "this looks like ft/s")
    } else if near(17.6) {
        (Rule::LooksLikeOtherUnit, "this looks like miles per hour")
    } else if apart.norm() > SPEED_TOLERANCE * vehicle.norm().max(occupant.norm()) {
        (Rule::Inconsistent, "occupant and vehicle begin at different velocities")
    } else {
        return;
    };
    let shown = |v: Vector3<f64>| format!("({:.2}, {:.2}, {:.2}) in/s", v.x + 0.0, v.y + 0.0, v.z + 0.0);
    let (vehicle, occupant) = (shown(vehicle), shown(occupant));
    let message = format!("{message}: along its axes the vehicle has {vehicle} at T1, the occupant {occupant}");
    let remedy = "give the occupant the vehicle's velocity unless the difference is meant";
    c.wrong_if(true, rule, names[apart.iamax()], message)
        .expected("the initial velocity in vehicle axes, in in/s", remedy);
}

/// Velocity of the vehicle along its own axes in the interval that contains `start_s`, in/s; none if the stations are
/// not a path or do not cover that time.
fn velocity_at(stations: &[Vec<f64>], start_s: f64) -> Option<Vector3<f64>> {
    let station = |n: &Vec<f64>| Station::new(n[0], [n[1], n[2], n[3]], [n[4], n[5], n[6]].map(f64::to_radians));
    let table = TablePath::new(stations.iter().map(station).collect(), Interpolation::Linear, AfterEnd::Error).ok()?;
    let (first_s, last_s) = table.span_s();
    let covered = (first_s..last_s).contains(&start_s);
    let motion = covered.then(|| VehiclePath::Table(table).motion(start_s, start_s, &mut PathCursor::default()))?;
    Some(motion.vector_to_frame(motion.velocity_m_s))
}
