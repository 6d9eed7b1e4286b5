//! The values of a scenario that a page lets one move by hand.

use occupant_scenario::{Draft, Wanted};
use occupant_units::trig;
use occupant_units::unit::parse;
use placed_text::Value;
use serde::Serialize;

/// A value that can be moved.
#[derive(Debug, Serialize)]
pub struct Knob {
    path: String,
    label: String,
    group: &'static str,
    #[serde(flatten)]
    kind: Kind,
}

/// What a value can be.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Kind {
    /// A number in a unit, between two; `now` is none where the scenario leaves it to what is usual.
    Number { unit: &'static str, from: f64, to: f64, step: f64, now: Option<f64> },
    /// A direction of travel, as its angle to the right of ahead in degrees; set as [x, y, z].
    Direction { now: f64 },
    /// One of these.
    Choice { names: Vec<&'static str>, now: Option<String> },
    /// Yes or no.
    Truth { now: Option<bool> },
}

/// A row of the table: path, label, group, unit and range; a unit of "" is for names and truths.
type Row = (&'static str, &'static str, &'static str, &'static str, [f64; 3]);

const NONE: [f64; 3] = [0.0; 3];

/// Values of the crash and of the car.
const ROWS: &[Row] = &[
    ("path.speed", "speed before", CRASH, "km/h", [0.0, 120.0, 1.0]),
    ("path.delta_v", "change of speed, delta-v", CRASH, "km/h", [2.0, 100.0, 1.0]),
    ("path.duration", "duration", CRASH, "ms", [30.0, 250.0, 5.0]),
    ("path.strength", "strength of the recorded motion", CRASH, "", [0.2, 2.0, 0.05]),
    ("body.preset", "body", PERSON, "", NONE),
    ("body.stature", "stature", PERSON, "cm", [140.0, 205.0, 1.0]),
    ("body.mass", "mass", PERSON, "kg", [35.0, 150.0, 1.0]),
    ("car.class", "car", SEAT, "", NONE),
    ("car.years", "built", SEAT, "", NONE),
    ("car.bags.driver", "driver's air bag", RESTRAINT, "", NONE),
    ("car.bags.passenger", "passenger's air bag", RESTRAINT, "", NONE),
    ("car.bags.curtain", "curtain air bags", RESTRAINT, "", NONE),
    ("car.bags.side", "side air bags", RESTRAINT, "", NONE),
    ("car.bags.vent", "vents of the bags, factor", RESTRAINT, "", [0.3, 3.0, 0.1]),
];

/// Values of each seat that the scenario names; paths from the seat on.
const OF_SEATS: &[Row] = &[
    ("belt", "belt", RESTRAINT, "", NONE),
    ("limiter", "load limiter", RESTRAINT, "kN", [1.0, 10.0, 0.1]),
    ("pretensioner", "pretensioner", RESTRAINT, "mm", [0.0, 150.0, 5.0]),
    ("slack", "slack", RESTRAINT, "mm", [0.0, 150.0, 5.0]),
    ("track", "seat behind its design position", SEAT, "mm", [-120.0, 120.0, 5.0]),
    ("recline", "seat back from the vertical", SEAT, "deg", [10.0, 50.0, 1.0]),
    ("head_gap", "head restraint behind the head", SEAT, "mm", [0.0, 200.0, 5.0]),
    ("head_height", "top of the head restraint above the H-point", SEAT, "mm", [500.0, 900.0, 10.0]),
];

const CRASH: &str = "Crash";
const PERSON: &str = "Person";
const RESTRAINT: &str = "Belt and bags";
const SEAT: &str = "Seat and car";

/// The values of this scenario that can be moved, in the order of the table.
pub fn knobs(draft: &Draft) -> Vec<Knob> {
    let is_person = draft.places("body.sex").is_ok_and(|places| places.iter().any(|place| place.value.is_some()));
    let has = |row: &&Row| is_person || !["body.stature", "body.mass"].contains(&row.0);
    let own = ROWS.iter().filter(has).filter_map(|row| knob(draft, row, row.0.to_owned(), row.1.to_owned()));
    let seats = seats(draft);
    let several = seats.len() > 1;
    let of_seats = seats.iter().flat_map(|seat| {
        OF_SEATS.iter().filter_map(move |row| {
            let whose = if several { format!("{}, {}", row.1, seat.replace('_', " ")) } else { row.1.to_owned() };
            knob(draft, row, format!("car.seats.{seat}.{}", row.0), whose)
        })
    });
    let mut all: Vec<Knob> = own.chain(direction(draft)).chain(of_seats).collect();
    let order = |group: &str| [CRASH, RESTRAINT, PERSON, SEAT].iter().position(|known| *known == group);
    all.sort_by_key(|knob| order(knob.group));
    all
}

/// The direction of a pulse.
fn direction(draft: &Draft) -> Option<Knob> {
    let mut draft = draft.clone();
    let is_pulse = draft.get("path.kind").ok()?.into_iter().any(|(_, kind)| kind == Value::String("pulse".to_owned()));
    let part = |at: usize| draft.places(&format!("path.direction[{at}]")).ok()?.first()?.si;
    let now = match (part(0), part(1)) {
        (Some(x), Some(y)) => trig::atan2(y, x).to_degrees(),
        _ => 0.0,
    };
    let (path, label) = ("path.direction".to_owned(), "direction of travel, to the right of ahead".to_owned());
    is_pulse.then_some(Knob { path, label, group: CRASH, kind: Kind::Direction { now } })
}

/// The seats that a car names, in its order.
fn seats(draft: &Draft) -> Vec<String> {
    let mut seats: Vec<String> = Vec::new();
    for (path, _) in draft.clone().get("car.seats.*").unwrap_or_default() {
        seats.extend(path.strip_prefix("car.seats.").map(str::to_owned));
    }
    seats
}

fn knob(draft: &Draft, row: &Row, path: String, label: String) -> Option<Knob> {
    let &(_, _, group, unit, [from, to, step]) = row;
    // the key must be allowed here; what is not written is changed by its path all the same
    let (wanted, value, si) = match draft.places(&path).ok()?.into_iter().next()? {
        place if place.path == path => (place.wanted, place.value, place.si),
        place if step > 0.0 => (place.wanted, None, None),
        _ => return Some(Knob { kind: unwritten(&path)?, path, label, group }),
    };
    let kind = match wanted {
        Wanted::Names(names) => Kind::Choice {
            names,
            now: match value {
                Some(Value::String(name)) => Some(name),
                _ => None,
            },
        },
        Wanted::Truth => Kind::Truth {
            now: match value {
                Some(Value::Bool(now)) => Some(now),
                _ => None,
            },
        },
        Wanted::Quantity(_) | Wanted::Number if step > 0.0 => {
            let per_si = if unit.is_empty() { 1.0 } else { parse(unit, 0).ok()?.factor };
            Kind::Number { unit, from, to, step, now: si.map(|si| si / per_si) }
        }
        _ => return None,
    };
    Some(Knob { path, label, group, kind })
}

/// Names and truths that change other keys where they are not written.
fn unwritten(path: &str) -> Option<Kind> {
    Some(match path.rsplit('.').next()? {
        "belt" => Kind::Choice { names: vec!["three_point", "seat", "lap", "none"], now: None },
        "curtain" | "side" => Kind::Choice { names: vec!["none", "left", "right", "both"], now: None },
        "years" => Kind::Choice { names: vec!["1970s", "1990s", "2000s", "present"], now: None },
        "driver" | "passenger" => Kind::Truth { now: None },
        _ => return None,
    })
}
