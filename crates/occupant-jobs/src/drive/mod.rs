//! Results of a drive: events, tyre marks, figures, tables.

mod barriers;
mod collisions;
mod events;
mod film;
mod plan;
mod slip;
mod table;
mod text;

use occupant_scenario::Drives;
use vehicle_motion::marks::{Mark, marks};
use vehicle_motion::run::{Ride, Station};

use crate::risk::{Figure, Figures, PATH_INTERVAL_S, Report, Subject};
use barriers::Met;
use collisions::Collision;
use events::Event;
use slip::{slip_rad, slips_rad};

pub use film::film;
pub use plan::plan;
pub use table::{columns, path_columns, write};
pub use text::{json, text};

/// Speed below which a vehicle is at rest, m/s.
const REST_M_S: f64 = 0.05;

/// A vehicle's drive with its evaluation.
pub struct Driven {
    /// The vehicle's number.
    pub number: usize,
    /// Events in order of time.
    pub events: Vec<Event>,
    /// Tyre marks.
    pub marks: Vec<Mark>,
    /// Extremes of the motion.
    pub motion: Figurable,
    /// Collisions in the order of first contacts.
    pub collisions: Vec<Collision>,
    /// Barrier contacts.
    pub barriers: Vec<Met>,
    /// Risk measures for occupants; none after an impact without duration, which has no accelerations.
    pub risk: Vec<Figure>,
}

/// Extremes of a drive, SI.
pub struct Figurable {
    /// Time of coming to rest, s; none if still moving.
    pub rest_s: Option<f64>,
    /// Path length of the centre of gravity, m.
    pub distance_m: f64,
    /// Yaw angle of the whole drive, including full turns, rad.
    pub turned_rad: f64,
    /// Largest roll, rad, and its time, s.
    pub roll: (f64, f64),
    /// Largest pitch, rad, and its time, s.
    pub pitch: (f64, f64),
    /// Largest slip angle, rad, and its time, s.
    pub slip: (f64, f64),
    /// Steepest ground under the centre of gravity, rise over run.
    pub slope: (f64, f64),
}

impl Driven {
    /// The drive of a vehicle.
    pub fn of(drives: &Drives, number: usize) -> Self {
        let ride = &drives.outcome.rides[number];
        let collisions = collisions::of(drives, number);
        Driven {
            number,
            events: events::of(ride, &drives.world.ground, &collisions),
            marks: marks(ride, &drives.world.ground),
            motion: Figurable::of(ride, drives),
            risk: if collisions.iter().any(Collision::is_at_once) {
                Vec::new()
            } else {
                risk(drives, number, collisions.first().map_or(0.0, |first| first.from_s))
            },
            collisions,
            barriers: barriers::of(drives, number),
        }
    }
}

/// Risk measures from the motion of the compartment's origin, from a time on.
fn risk(drives: &Drives, number: usize, from_s: f64) -> Vec<Figure> {
    let ride = &drives.outcome.rides[number];
    let end_s = ride.last().time_s;
    let subject = Subject::path("", drives.path(number), [from_s, end_s], PATH_INTERVAL_S);
    let report = subject.and_then(Report::of_path);
    report.map(|report| Figures::of(&report).figures).unwrap_or_default()
}

impl Figurable {
    fn of(ride: &Ride, drives: &Drives) -> Self {
        let stations = ride.stations();
        let most = |most: (f64, f64), x: (f64, f64)| if x.0.abs() > most.0.abs() { x } else { most };
        let greatest = |of: &dyn Fn(&Station) -> f64| {
            stations.iter().map(|station| (of(station), station.time_s)).fold((0.0, 0.0), most)
        };
        let turns = ride.turns_rad();
        let turn = |i: usize| {
            turns.iter().zip(stations).map(|(turn, station)| (turn[i], station.time_s)).fold((0.0, 0.0), most)
        };
        let slips = slips_rad(stations).into_iter().zip(stations);
        let moving = stations.iter().rev().find(|station| station.velocity_m_s.norm() > REST_M_S);
        let last_s = ride.last().time_s;
        let after_s = moving.map_or(0.0, |station| station.time_s);
        Figurable {
            rest_s: (after_s < last_s - 0.1).then_some(after_s),
            distance_m: stations.windows(2).map(|pair| (pair[1].position_m - pair[0].position_m).norm()).sum(),
            turned_rad: turns[turns.len() - 1][0] - turns[0][0],
            roll: turn(2),
            pitch: turn(1),
            slip: slips.map(|(slip, station)| (slip, station.time_s)).fold((0.0, 0.0), most),
            slope: greatest(&|station| {
                let normal = drives.world.ground.normal(station.position_m.x, station.position_m.y);
                normal.y / normal.z
            }),
        }
    }
}

/// Names of the wheels in channels and in text.
pub const WHEELS: [[&str; 2]; 4] = [
    ["left_front", "left front wheel"],
    ["right_front", "right front wheel"],
    ["left_rear", "left rear wheel"],
    ["right_rear", "right rear wheel"],
];
