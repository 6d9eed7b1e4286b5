//! Collisions of a vehicle with obstacles beside the road.

use occupant_scenario::Drives;
use occupant_units::trig;
use serde::Serialize;
use vehicle_motion::V3;
use vehicle_motion::barrier::{Barrier, End};
use vehicle_motion::presets::Evidence;
use vehicle_motion::run::Station;
use vehicle_motion::world::Partner;

use crate::base::Units;
use crate::base::text_table::{Align, NONE, Table};

/// A vehicle's contact with a barrier, SI. Angles are between the velocity and the line of a wall or rail.
#[derive(Clone, Debug, Serialize)]
pub struct Met {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: &'static str,
    /// Time of the first contact, s.
    pub from_s: f64,
    /// Time of the last force, s.
    pub until_s: f64,
    /// Speed at the impact, m/s.
    pub impact_speed_m_s: f64,
    /// Angle towards it, rad.
    pub impact_angle_rad: Option<f64>,
    /// Speed 2 m after the last contact, or at the end of the drive, m/s.
    pub exit_speed_m_s: f64,
    /// Angle away from it, rad.
    pub exit_angle_rad: Option<f64>,
    /// Largest deflection of a rail, cushion or sign, m.
    pub deflection_m: Option<f64>,
    /// Largest tension of a rail, N.
    pub tension_n: Option<f64>,
    /// Number of released posts.
    pub released_posts: Option<usize>,
}

/// Distance after the last contact at which exit speed and angle are taken, m.
const BEYOND_M: f64 = 2.0;

/// Barrier contacts of a vehicle, in the order of the scenario.
pub(super) fn of(drives: &Drives, car: usize) -> Vec<Met> {
    (0..drives.barriers.len()).filter_map(|barrier| met(drives, car, barrier)).collect()
}

fn met(drives: &Drives, car: usize, barrier: usize) -> Option<Met> {
    let is_own = |own: &&vehicle_motion::world::Contact| (own.car, own.partner) == (car, Partner::Barrier(barrier));
    let contacts = || drives.outcome.contacts.iter().filter(is_own);
    let (first, last) = (contacts().next()?, contacts().next_back()?);
    let stations = drives.outcome.rides[car].stations();
    let at = |time_s: f64| stations.partition_point(|station| station.time_s < time_s - 1e-12).min(stations.len() - 1);
    let (before, after) = (first.struck[0]?.enters_m_s, exit(&stations[at(last.until_s)..]));
    let away = away(&drives.world.barriers[barrier]);
    let angle = |velocity: V3, sign: f64| {
        let across = sign * velocity.dot(&away?);
        let along = (trig::hypot(velocity.x, velocity.y).powi(2) - across * across).max(0.0).sqrt();
        Some(trig::atan2(across, along))
    };
    let rail = drives.outcome.rails.iter().find(|rail| rail.barrier == barrier);
    let stroke_m = match &drives.world.barriers[barrier] {
        // what broke away moves on with the vehicle
        Barrier::Slider(slider) if slider.end == End::Released => {
            let breaks_m = slider.force_n.last().map_or(0.0, |point| point[0]);
            Some(drives.outcome.slides[barrier].most_m.min(breaks_m))
        }
        Barrier::Slider(_) => Some(drives.outcome.slides[barrier].most_m),
        _ => None,
    };
    let (name, kind) = &drives.barriers[barrier];
    Some(Met {
        name: name.clone(),
        kind,
        from_s: first.from_s,
        until_s: last.until_s,
        impact_speed_m_s: before.norm(),
        impact_angle_rad: angle(before, -1.0),
        exit_speed_m_s: after.velocity_m_s.norm(),
        exit_angle_rad: angle(after.velocity_m_s, 1.0),
        deflection_m: rail.map(|rail| rail.deflection_m).or(stroke_m),
        tension_n: rail.map(|rail| rail.tension_n),
        released_posts: rail.map(|rail| rail.released),
    })
}

/// The station 2 m after the first, or the last.
fn exit(stations: &[Station]) -> &Station {
    let far = |station: &&Station| (station.position_m - stations[0].position_m).norm() >= BEYOND_M;
    stations.iter().find(far).unwrap_or(&stations[stations.len() - 1])
}

/// Direction away from the face of a wall or rail; none for point barriers.
fn away(barrier: &Barrier) -> Option<V3> {
    match barrier {
        Barrier::Wall(wall) => Some(V3::new(trig::cos(wall.normal_rad), trig::sin(wall.normal_rad), 0.0)),
        Barrier::Rail(rail) => {
            let [from, to] = rail.line_m;
            let left = V3::new(to[1] - from[1], from[0] - to[0], 0.0).normalize();
            Some(if rail.traffic_on_left { left } else { -left })
        }
        Barrier::Pole(_) | Barrier::Block(_) | Barrier::Slider(_) => None,
    }
}

/// All of them as a table.
pub(super) fn text(all: &[Met], units: Units) -> String {
    let mut table = Table::new(&[
        (Align::Left, &["barrier", "kind"]),
        (Align::Right, &["from, s", "until, s", "impact at", "angle, deg", "exit at", "angle, deg"]),
        (Align::Right, &["deflection", "tension", "posts gone"]),
    ]);
    for own in all {
        let speed = |m_s: f64| units.say(m_s, "m/s", 2);
        let angle = |rad: Option<f64>| rad.map_or(NONE.to_owned(), |rad| format!("{:.1}", rad.to_degrees()));
        table.row([
            own.name.clone(),
            own.kind.to_owned(),
            format!("{:.3}", own.from_s),
            format!("{:.3}", own.until_s),
            speed(own.impact_speed_m_s),
            angle(own.impact_angle_rad),
            speed(own.exit_speed_m_s),
            angle(own.exit_angle_rad),
            own.deflection_m.map_or(NONE.to_owned(), |m| units.say(m, "m", 3)),
            own.tension_n.map_or(NONE.to_owned(), |n| units.say(n, "N", 0)),
            own.released_posts.map_or(NONE.to_owned(), |posts| posts.to_string()),
        ]);
    }
    table.text()
}

/// Reliability of the numbers of barriers.
pub(super) fn evidence(all: &[Met]) -> Vec<(&'static str, Evidence, &'static str)> {
    let rows = [
        (
            "rail",
            (
                "rail",
                Evidence::Guess,
                "section from the profile; anchors, posts and their release are tuned to one remembered deflection. Exit angles are larger than in tests: no verdict on an exit box",
            ),
        ),
        (
            "wall",
            (
                "friction along a wall",
                Evidence::Guess,
                "0.55 at a car's corner, 0.2 along smooth concrete; wheels do not climb",
            ),
        ),
        (
            "sign",
            (
                "sign",
                Evidence::Guess,
                "presets are made so that a car of 900 kg at 100 km/h leaves as its category of EN 12767 allows; what breaks off strikes nothing more",
            ),
        ),
        (
            "cushion",
            ("cushion", Evidence::Guess, "presets are made so that the cars of EN 1317-3 stop within their length"),
        ),
        ("pole", ("pole", Evidence::Guess, "front stiffness, uniform over the width: no engine, no wheel behind it")),
    ];
    rows.into_iter().filter(|(kind, _)| all.iter().any(|own| own.kind == *kind)).map(|(_, row)| row).collect()
}
