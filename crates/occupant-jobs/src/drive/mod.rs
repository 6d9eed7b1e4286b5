//! What a drive comes to: events, tyre marks, figures, tables.

mod events;
mod table;
mod text;

use occupant_scenario::Drives;
use occupant_study::risk::{Flight, Preparation, VehicleRisk, prepare};
use vehicle_motion::marks::{Mark, marks};
use vehicle_motion::run::{Ride, Station};

use crate::risk::{Figure, Figures, PATH_INTERVAL_S, Subject};
use events::Event;

pub use table::{columns, path_columns, write};
pub use text::{json, text};

/// Below this speed a vehicle is at rest, m/s.
const REST_M_S: f64 = 0.05;

/// A vehicle's drive and what there is to say of it.
pub struct Driven {
    /// The vehicle's number.
    pub number: usize,
    pub events: Vec<Event>,
    pub marks: Vec<Mark>,
    pub motion: Figurable,
    /// Measures of the risk to occupants.
    pub risk: Vec<Figure>,
}

/// Extremes of a drive, SI.
pub struct Figurable {
    /// When it came to rest, s; none while it moves.
    pub rest_s: Option<f64>,
    /// Way of the centre of gravity, m.
    pub distance_m: f64,
    /// Yaw of the whole drive, turns counted, rad.
    pub turned_rad: f64,
    /// Greatest roll, pitch and slip angle with their times, rad and s.
    pub roll: (f64, f64),
    pub pitch: (f64, f64),
    pub slip: (f64, f64),
    /// Steepest ground under the centre of gravity, rise over run.
    pub slope: (f64, f64),
}

impl Driven {
    /// The drive of a vehicle.
    pub fn of(drives: &Drives, number: usize) -> Self {
        let ride = &drives.outcome.rides[number];
        Driven {
            number,
            events: events::of(ride, &drives.world.ground),
            marks: marks(ride, &drives.world.ground),
            motion: Figurable::of(ride, drives),
            risk: risk(drives, number),
        }
    }
}

/// Measures of the risk to occupants by the motion of the compartment's origin.
fn risk(drives: &Drives, number: usize) -> Vec<Figure> {
    let ride = &drives.outcome.rides[number];
    let end_s = ride.last().time_s;
    let subject = Subject::path("", drives.path(number), [0.0, end_s], PATH_INTERVAL_S);
    let class = crash_measures::signal::ChannelClass::from_number(180);
    let filter = class.map(|class| (class, crash_measures::signal::CfcFamily::Iso6487));
    let signals = subject.and_then(|subject| {
        let signals = prepare(&subject.record, &Preparation { filter, ..Preparation::default() }).ok()?;
        Some(occupant_study::risk::VehicleSignals { initial: subject.initial, ..signals })
    });
    let figures = signals.map(|s| Figures::of_risk(&VehicleRisk::of(&s, &Flight::default()), &s).figures);
    figures.unwrap_or_default()
}

impl Figurable {
    fn of(ride: &Ride, drives: &Drives) -> Self {
        let stations = ride.stations();
        let greatest = |of: &dyn Fn(&Station) -> f64| {
            let one = |station: &Station| (of(station), station.time_s);
            stations
                .iter()
                .map(one)
                .fold((0.0, 0.0), |most: (f64, f64), x| if x.0.abs() > most.0.abs() { x } else { most })
        };
        let moving = stations.iter().rev().find(|station| station.velocity_m_s.norm() > REST_M_S);
        let last_s = ride.last().time_s;
        let after_s = moving.map_or(0.0, |station| station.time_s);
        Figurable {
            rest_s: (after_s < last_s - 0.1).then_some(after_s),
            distance_m: stations.windows(2).map(|pair| (pair[1].position_m - pair[0].position_m).norm()).sum(),
            turned_rad: turned(stations),
            roll: greatest(&|station| station.state.yaw_pitch_roll_rad()[2]),
            pitch: greatest(&|station| station.state.yaw_pitch_roll_rad()[1]),
            slip: greatest(&slip_rad),
            slope: greatest(&|station| {
                let normal = drives.world.ground.normal(station.position_m.y);
                normal.y / normal.z
            }),
        }
    }
}

/// Yaw from the first to the last station, rad.
fn turned(stations: &[Station]) -> f64 {
    let step = |pair: &[Station]| {
        let turn = pair[1].state.yaw_pitch_roll_rad()[0] - pair[0].state.yaw_pitch_roll_rad()[0];
        turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round()
    };
    stations.windows(2).map(step).sum()
}

/// Direction of travel to the right of the heading, rad; 0 at rest.
pub fn slip_rad(station: &Station) -> f64 {
    let velocity = station.attitude.inverse() * station.velocity_m_s;
    if velocity.norm() < 0.5 { 0.0 } else { occupant_units::trig::atan2(velocity.y, velocity.x) }
}

/// Names of wheels in channels, and in words.
pub const WHEELS: [[&str; 2]; 4] = [
    ["left_front", "left front wheel"],
    ["right_front", "right front wheel"],
    ["left_rear", "left rear wheel"],
    ["right_rear", "right rear wheel"],
];
