//! Events with their times.

use std::f64::consts::FRAC_PI_2;

use occupant_units::trig;
use serde::Serialize;
use vehicle_motion::ground::Ground;
use vehicle_motion::run::{Ride, Station};

use super::collisions::Collision;
use super::{WHEELS, slips_rad};

/// An event.
#[derive(Clone, Debug, Serialize)]
pub struct Event {
    /// Time of the first station after it, s; at most 10 ms late.
    pub time_s: f64,
    /// Description.
    pub what: String,
}

const SPINS: &str = "spins out: it slides sideways, slip angle 90 deg";
/// Time without load after which a wheel counts as airborne, s.
const AIR_S: f64 = 0.03;

/// Events of a ride in the order of time.
pub(super) fn of(ride: &Ride, ground: &Ground, collisions: &[Collision]) -> Vec<Event> {
    let stations = ride.stations();
    let mut events = Vec::new();
    for (wheel, [_, name]) in WHEELS.iter().enumerate() {
        zones(stations, ground, wheel, name, &mut events);
        flights(stations, wheel, name, &mut events);
    }
    for collision in collisions {
        events.push(Event { time_s: collision.from_s, what: format!("touches {}", collision.with) });
        if collision.until_s < stations[stations.len() - 1].time_s {
            events.push(Event { time_s: collision.until_s, what: format!("parts from {}", collision.with) });
        }
    }
    let slips = slips_rad(stations);
    let spins = slips.windows(2).position(|pair| pair[0].abs() <= FRAC_PI_2 && pair[1].abs() > FRAC_PI_2);
    let spins = spins.map(|before| stations[before + 1].time_s);
    events.extend(spins.map(|time_s| Event { time_s, what: SPINS.to_owned() }));
    let turns = ride.turns_rad();
    let mut first = |what: &str, is_so: &dyn Fn(&[f64; 3]) -> bool| {
        let found = turns.iter().position(is_so);
        events.extend(found.map(|i| Event { time_s: stations[i].time_s, what: what.to_owned() }));
    };
    first("on its side: a quarter turn", &|[_, _, roll]| roll.abs() > FRAC_PI_2);
    first("on its roof", &|[_, pitch, roll]| is_over(*roll, *pitch) || is_over(*pitch, *roll));
    events.sort_by(|a, b| a.time_s.total_cmp(&b.time_s));
    events
}

/// Whether a roll or pitch is within 10° of upside down, while the other leaves it so.
fn is_over(turn: f64, other: f64) -> bool {
    trig::cos(turn) < trig::cos(170f64.to_radians()) && trig::cos(other) > 0.0
}

/// Transitions of a wheel between zones.
fn zones(stations: &[Station], ground: &Ground, wheel: usize, name: &str, events: &mut Vec<Event>) {
    let zone = |station: &Station| {
        ground.zone(station.wheels[wheel].contact_m.x, station.wheels[wheel].contact_m.y).map(|zone| zone.name.as_str())
    };
    for pair in stations.windows(2) {
        let [before, after] = [zone(&pair[0]), zone(&pair[1])];
        if before != after {
            let what = match after {
                Some(after) => format!("{name} on {after}"),
                None => format!("{name} back on the road"),
            };
            events.push(Event { time_s: pair[1].time_s, what });
        }
    }
}

/// A wheel lifts off and lands.
fn flights(stations: &[Station], wheel: usize, name: &str, events: &mut Vec<Event>) {
    let mut since_s = None;
    for station in stations {
        let bears = station.wheels[wheel].load_n > 0.0;
        match (since_s, bears) {
            (None, false) => since_s = Some(station.time_s),
            (Some(from_s), true) => {
                if station.time_s - from_s > AIR_S {
                    events.push(Event { time_s: from_s, what: format!("{name} lifts off") });
                    events.push(Event { time_s: station.time_s, what: format!("{name} lands") });
                }
                since_s = None;
            }
            _ => {}
        }
    }
    if let Some(from_s) = since_s {
        events.push(Event { time_s: from_s, what: format!("{name} lifts off") });
    }
}
