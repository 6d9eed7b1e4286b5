//! The report of a drive as text and as JSON.

use occupant_scenario::{DrivenVehicle, Drives};
use serde_json::{Value, json as value};
use vehicle_motion::body::Reading;
use vehicle_motion::presets::Evidence;

use super::{Driven, WHEELS, barriers, collisions};
use crate::base::Units;
use crate::base::text_table::{Align, Table, facts};

/// The report of all vehicles.
pub fn text(drives: &Drives, all: &[Driven], units: Units) -> String {
    all.iter().map(|driven| one(drives, driven, units)).collect::<Vec<_>>().join("\n")
}

fn one(drives: &Drives, driven: &Driven, units: Units) -> String {
    let own = &drives.vehicles[driven.number];
    let ride = &drives.outcome.rides[driven.number];
    let damage = &drives.outcome.damage[driven.number];
    let (first, last, motion) = (&ride.stations()[0], ride.last(), &driven.motion);
    let say = |value: f64, unit: &str, decimals: usize| units.say(value, unit, decimals);
    let angle = |(rad, time_s): (f64, f64)| format!("{:.1} deg at {time_s:.2} s", rad.to_degrees());
    let place = |at: vehicle_motion::V3| format!("x {}, y {}", say(at.x, "m", 2), say(at.y, "m", 2));
    let yaw = |state: &vehicle_motion::state::State| state.yaw_pitch_roll_rad()[0].to_degrees();
    let end = match motion.rest_s {
        Some(rest_s) => format!("at rest from {rest_s:.2} s"),
        None => format!("still moving at {}", say(last.velocity_m_s.norm(), "m/s", 2)),
    };
    let given = if own.given.is_empty() { String::new() } else { format!("; given: {}", own.given.join(", ")) };
    let load_kg = own.car.mass_kg - own.unladen.mass_kg;
    let riders = own.car.riders.map_or_else(String::new, |riders| {
        format!("; people of {} push it by their forces", say(riders.mass_kg, "kg", 0))
    });
    let mut head = vec![
        ("vehicle", format!("{}: preset {}{given}", own.name, own.preset.name)),
        ("mass", format!("{} with a load of {}{riders}", say(own.car.mass_kg, "kg", 0), say(load_kg, "kg", 0))),
        ("passes", passes(drives, units)),
        (
            "start",
            format!(
                "{} at yaw {:.1} deg, {}",
                say(first.velocity_m_s.norm(), "m/s", 2),
                yaw(&first.state),
                place(first.position_m)
            ),
        ),
        ("end", format!("{:.2} s: {end}, {}, yaw {:.1} deg", last.time_s, place(last.position_m), yaw(&last.state))),
        (
            "distance",
            format!("{}, turned by {:.1} deg", say(motion.distance_m, "m", 2), motion.turned_rad.to_degrees()),
        ),
        ("largest roll", angle(motion.roll)),
        ("largest pitch", angle(motion.pitch)),
        ("largest slip angle", angle(motion.slip)),
        ("steepest ground", format!("{:.0} % at {:.2} s", 100.0 * motion.slope.0, motion.slope.1)),
        ("crush", collisions::crush_words(damage, units)),
        ("energy balance", format!("off by {:.1e} of the largest kinetic energy", ride.balance().abs())),
        ("steps", format!("{}, {} evaluations", ride.stations().len() - 1, ride.evaluations)),
    ];
    let is_hit = !driven.collisions.is_empty() || damage.roof_m > 0.0;
    head.retain(|(name, words)| {
        !(*name == "steepest ground" && words.starts_with("0 %") || *name == "crush" && !is_hit || words.is_empty())
    });
    let mut parts = vec![facts(&head)];
    parts.push(events(driven));
    if !driven.collisions.is_empty() {
        parts.push(collisions::text(&driven.collisions, units));
        if !driven.barriers.is_empty() {
            parts.push(barriers::text(&driven.barriers, units));
        }
        parts.push(collisions::damage_text(damage, units));
    }
    if !driven.marks.is_empty() {
        parts.push(marks(driven, units));
    }
    parts.push(risk(driven, units));
    parts.push(evidence(drives, driven));
    parts.join("\n")
}

/// Coupled passes; empty without.
fn passes(drives: &Drives, units: Units) -> String {
    let Some(change_m) = drives.changes_m.last() else { return String::new() };
    let made = drives.changes_m.len();
    format!("{made}; the last moved a vehicle by at most {}", units.say(*change_m, "m", 4))
}

fn events(driven: &Driven) -> String {
    let mut table = Table::new(&[(Align::Right, &["time, s"]), (Align::Left, &["what happens"])]);
    for event in &driven.events {
        table.row([format!("{:.3}", event.time_s), event.what.clone()]);
    }
    if driven.events.is_empty() { "no event: all wheels stay on the same ground\n".to_owned() } else { table.text() }
}

fn marks(driven: &Driven, units: Units) -> String {
    let mut table = Table::new(&[
        (Align::Left, &["tyre mark", "kind"]),
        (Align::Right, &["from, s", "until, s", "length"]),
        (Align::Left, &["from x, y", "to x, y"]),
    ]);
    for mark in &driven.marks {
        let place = |at: Option<&[f64; 2]>| {
            at.map_or_else(String::new, |at| format!("{}, {}", units.say(at[0], "m", 2), units.say(at[1], "m", 2)))
        };
        table.row([
            WHEELS[mark.wheel][1].to_owned(),
            mark.kind.to_owned(),
            format!("{:.2}", mark.from_s),
            format!("{:.2}", mark.until_s),
            units.say(mark.length_m, "m", 2),
            place(mark.points_m.first()),
            place(mark.points_m.last()),
        ]);
    }
    table.text()
}

/// Risk measures; times are relative to the start of the drive.
fn risk(driven: &Driven, units: Units) -> String {
    if let Some(own) = driven.collisions.iter().find(|own| own.is_at_once()) {
        return format!(
            "no measures of occupant risk: the impact with {} has no duration, so that no acceleration is defined\n",
            own.with
        );
    }
    let us = units.symbol("m") != "m";
    let mut table = Table::new(&[
        (Align::Left, &[if driven.collisions.is_empty() { "risk by the vehicle's motion" } else { RISK_OF_COLLISION }]),
        (Align::Right, &["value"]),
        (Align::Left, &["unit", "time, s"]),
    ]);
    for figure in &driven.risk {
        let (unit, decimals) = figure.units[usize::from(us)];
        let times: Vec<String> = figure.when_s.iter().map(|t| format!("{t:.3}")).collect();
        table.row([
            figure.name.clone(),
            crate::base::text_table::number(figure.value / unit.si, decimals),
            unit.symbol(),
            times.join(" – "),
        ]);
    }
    table.text()
}

/// Reliability of the values.
fn evidence(drives: &Drives, driven: &Driven) -> String {
    let own = &drives.vehicles[driven.number];
    let mut table = Table::new(&[(Align::Left, &["number", "trust", "source"])]);
    for (number, trust, source) in evidence_of(own, driven) {
        table.row([number.to_owned(), trust.words().to_owned(), source.to_owned()]);
    }
    table.text()
}

/// Evidence of the preset, of values common to all presets, and of barriers.
fn evidence_of(own: &DrivenVehicle, driven: &Driven) -> Vec<(&'static str, Evidence, &'static str)> {
    let collides = !driven.collisions.is_empty();
    let is_dynamic = collides && matches!(own.car.body.crush.reading, Reading::Dynamic { .. });
    let dynamic = DYNAMIC.into_iter().filter(|_| is_dynamic);
    let behind = BEHIND.into_iter().filter(|_| collides);
    let twice = TWICE.into_iter().filter(|_| collides && own.car.riders.is_some());
    let common = own.preset.evidence().into_iter().chain(COMMON);
    common.chain(dynamic).chain(behind).chain(twice).chain(barriers::evidence(&driven.barriers)).collect()
}

fn mark(mark: &vehicle_motion::marks::Mark) -> Value {
    value!({
        "wheel": WHEELS[mark.wheel][0],
        "kind": mark.kind,
        "from_s": mark.from_s,
        "until_s": mark.until_s,
        "length_m": mark.length_m,
        "points_m": mark.points_m,
    })
}

fn profile(own: &vehicle_motion::world::Profile) -> Value {
    value!({
        "side": collisions::side_name(own.side),
        "span_m": own.span_m,
        "depths_m": own.depths_m,
        "mean_m": own.mean_m,
        "energy_j": own.energy_j,
    })
}

const RISK_OF_COLLISION: &str = "occupant risk from the vehicle's motion, from its first collision on";

/// Values common to all presets.
const COMMON: [(&str, Evidence, &str); 3] = [
    ("tyres", Evidence::Typical, "between published tyres; relaxation and camber are plausible, not measured"),
    ("friction of the ground", Evidence::Typical, "0.76 on dry asphalt (0.64 to 0.88 in 95 % of tests) unless given"),
    ("soil", Evidence::Guess, "a friction factor: wheels do not sink in; only `lateral` models furrowing"),
];

/// What collisions add.
const DYNAMIC: [(&str, Evidence, &str); 1] = [(
    "crush while it lasts",
    Evidence::Guess,
    "a fifth longer than crush that stays tells, by one wall test with channels",
)];
const TWICE: [(&str, Evidence, &str); 1] = [(
    "crush under passes",
    Evidence::Fitted,
    "stiffness was drawn from tests with the dummies as part of the mass: who pushes by forces is counted twice, by a few percent",
)];
const BEHIND: [(&str, Evidence, &str); 2] = [
    (
        "restitution",
        Evidence::Typical,
        "0.14 at 56 km/h into a wall, 0.45 at 8 km/h; four oblique tests have 0.09 to 0.15",
    ),
    (
        "door and engine",
        Evidence::Guess,
        "0.2 m and 0.4 m, added to the crush before occupants are looked for within it",
    ),
];

/// The report as JSON, SI, angles in radians.
pub fn json(drives: &Drives, all: &[Driven]) -> Value {
    let one = |driven: &Driven| {
        let own = &drives.vehicles[driven.number];
        let ride = &drives.outcome.rides[driven.number];
        let (last, motion, damage) = (ride.last(), &driven.motion, &drives.outcome.damage[driven.number]);
        let risk: serde_json::Map<String, Value> =
            driven.risk.iter().map(|figure| (figure.key.clone(), value!(figure.value))).collect();
        let evidence = evidence_of(own, driven);
        let evidence: Vec<Value> =
            evidence.iter().map(|(number, trust, source)| value!([number, trust.words(), source])).collect();
        value!({
            "vehicle": own.name,
            "preset": own.preset.name,
            "given": own.given,
            "mass_kg": own.car.mass_kg,
            "riders_kg": own.car.riders.map(|riders| riders.mass_kg),
            "passes": drives.changes_m.len(),
            "pass_change_m": drives.changes_m.last(),
            "end_s": last.time_s,
            "rest_s": motion.rest_s,
            "position_m": [last.position_m.x, last.position_m.y, last.position_m.z],
            "yaw_rad": last.state.yaw_pitch_roll_rad()[0],
            "turned_rad": motion.turned_rad,
            "speed_m_s": last.velocity_m_s.norm(),
            "distance_m": motion.distance_m,
            "max_roll_rad": motion.roll.0,
            "max_pitch_rad": motion.pitch.0,
            "max_slip_angle_rad": motion.slip.0,
            "steepest_ground": motion.slope.0,
            "energy_balance": ride.balance(),
            "events": driven.events,
            "collisions": driven.collisions,
            "barriers": driven.barriers,
            "crush_dynamic_m": damage.dynamic_m,
            "crush_residual_m": damage.residual_m,
            "crush_roof_m": damage.roof_m,
            "ees_m_s": damage.ees_m_s,
            "damage": damage.profiles.iter().map(profile).collect::<Vec<_>>(),
            "tyre_marks": driven.marks.iter().map(mark).collect::<Vec<_>>(),
            "risk": risk,
            "evidence": evidence,
        })
    };
    Value::Array(all.iter().map(one).collect())
}
