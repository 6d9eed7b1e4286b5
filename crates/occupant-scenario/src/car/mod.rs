//! `[car]` written out: the inside of a car in the words of the other sections, under what the scenario says itself. Dummies in one word
//! are written out with it.

mod classes;
mod dimensions;
mod ride;
mod seats;
mod shell;
mod usual;
mod years;

use std::fmt::Write as _;

use serde::Deserialize;

use crate::check::check_parts;
use crate::dummies;
use crate::expand::{over, written};
use crate::presets;
use crate::sections::{BodySection, CAR_TITLE, CarClass, CarSeatSection, CarSection, DummyChoice, Side, schema};
use classes::Measures;
pub(super) use dimensions::dimensions;
pub use dimensions::{Dimension, Size};
use placed_text::{Diagnostics, Document, Node, Problem, SourceId, Sources, Table, did_you_mean, one_of, with_key};
pub use usual::Usual;
pub(super) use usual::usual;
use years::Years;

/// Sections of a car, checked before it is expanded.
pub(super) const CAR: [&str; 2] = ["car", "vehicles"];
/// Sections of its occupants.
const BODIES: [&str; 2] = ["body", "occupants"];

/// Whether a scenario has a car or a dummy to expand.
pub(super) fn is_there(root: &Node) -> bool {
    cars(root).next().is_some() || dummies::any(root)
}

/// The cars of a scenario, with the vehicle name that prefixes all parts (none for the first) and the path.
fn cars(root: &Node) -> impl Iterator<Item = (Option<&str>, &Node)> {
    let others = root.get("vehicles").and_then(Node::as_table).into_iter().flatten();
    let others = others.filter_map(|(name, entry)| Some((Some(name.as_str()), entry.node.get("car")?)));
    root.get("car").map(|car| (None, car)).into_iter().chain(others)
}

/// Problems of a car with valid keys.
pub(super) fn check(document: &Document) -> Diagnostics {
    let mut problems = Diagnostics::new();
    let names: Vec<&str> = SEATS.iter().map(|(name, ..)| *name).collect();
    for (vehicle, car) in cars(&document.root) {
        let path = vehicle.map_or_else(|| "car".to_owned(), |name| with_key("vehicles", name) + ".car");
        let seats = car.get("seats").and_then(Node::as_table);
        for name in seats.into_iter().flat_map(Table::keys).filter(|name| !names.contains(&name.as_str())) {
            let at = with_key(&format!("{path}.seats"), name);
            let problem = Problem::error(at, format!("`{name}` is not a seat"), one_of(&names, '`'));
            problems.add(problem.with_hint(did_you_mean(name, &names, '`')), |problem| document.place(problem));
        }
        bounded(document, Some(car), &path, &mut problems);
        if let Some(vehicle) = vehicle {
            own_seats(document, vehicle, &mut problems);
        }
    }
    problems
}

/// Reports who sits in a car of another vehicle than the first, but on a seat of the first.
fn own_seats(document: &Document, vehicle: &str, problems: &mut Diagnostics) {
    let several = document.root.get("occupants").and_then(Node::as_table).into_iter().flatten();
    for (name, entry) in several {
        let own = |key: &str| entry.node.get(key);
        let seat = own("posture").and_then(|posture| posture.get("seat")).and_then(Node::as_str);
        if own("vehicle").and_then(Node::as_str) == Some(vehicle) && seat.is_some_and(is_seat) {
            let seat = seat.unwrap_or_default();
            let at = with_key("occupants", name) + ".posture.seat";
            let found = format!("`{seat}`, a seat of the first vehicle");
            let problem = Problem::error(at, found, format!("`{vehicle}_{seat}`, the seat of `{vehicle}`"));
            problems.add(problem, |problem| document.place(problem));
        }
    }
}

/// Ranges of a car's numbers: key, least and greatest in SI units, and the range as text.
#[rustfmt::skip]
const BETWEEN: [(&str, f64, f64, &str); 30] = [
    ("seat_height", 0.05, 0.8, "5 cm to 80 cm"), ("seat_offset", 0.05, 1.2, "5 cm to 1.2 m"), ("couple", 0.4, 2.0, "0.4 m to 2 m"),
    ("shoulder_room", 0.8, 2.5, "0.8 m to 2.5 m"), ("roof", 0.5, 2.0, "0.5 m to 2 m"), ("ahead", 0.1, 1.5, "10 cm to 1.5 m"),
    ("above", -1.0, 1.5, "-1 m to 1.5 m"), ("angle", 0.0, 1.4, "0 to 80 degrees"), ("diameter", 0.2, 0.6, "20 cm to 60 cm"),
    ("column_force", 100.0, 1e6, "100 N to 1 MN"), ("column_stroke", 0.005, 0.5, "5 mm to 0.5 m"), ("bolster", 0.2, 1.5, "20 cm to 1.5 m"),
    ("bolster_stiffness", 1e3, 1e7, "1 kN/m to 10 MN/m"), ("delay", 0.0, 1.0, "0 to 1 s"), ("vent", 0.01, 100.0, "0.01 to 100"),
    ("track", -0.5, 0.5, "-0.5 m to 0.5 m"), ("height", -0.3, 0.3, "-0.3 m to 0.3 m"), ("recline", 0.0, 1.4, "0 to 80 degrees"),
    ("y", -1.5, 1.5, "-1.5 m to 1.5 m"), ("foam", 0.01, 100.0, "0.01 to 100"), ("head_gap", 0.0, 0.5, "0 to 0.5 m"),
    ("head_height", 0.3, 1.2, "0.3 m to 1.2 m"), ("limiter", 100.0, 1e6, "100 N to 1 MN"), ("film", 0.001, 0.4, "1 mm to 0.4 m"),
    ("depth", 0.001, 1.0, "1 mm to 1 m"), ("begins", 0.0, 10.0, "0 to 10 s"), ("lasts", 0.005, 1.0, "5 ms to 1 s"),
    ("booster", 0.02, 0.3, "2 cm to 30 cm"), ("back_moment", 50.0, 1e5, "50 N·m to 100 kN·m"),
    ("lap_above", -0.1, 0.15, "-10 cm to 15 cm"),
];
const OTHERS_M: [&str; 4] = ["slack", "pretensioner", "behind", "outboard"];

/// Reports implausible numbers.
fn bounded(document: &Document, node: Option<&Node>, path: &str, problems: &mut Diagnostics) {
    for (key, entry) in node.and_then(Node::as_table).into_iter().flatten() {
        let path = with_key(path, key);
        bounded(document, Some(&entry.node), &path, problems);
        let other = (key.as_str(), -1.0, 1.0, "at most 1 m");
        let known = BETWEEN.iter().find(|(known, ..)| known == key).copied();
        let limits = known.or_else(|| OTHERS_M.contains(&key.as_str()).then_some(other));
        let (Some((_, least, most, told)), Some(si)) = (limits, entry.node.si) else { continue };
        if !(least..=most).contains(&si) {
            let found = format!("{}: no car has that `{key}`", document.sources.slice(entry.node.span));
            problems.add(Problem::error(path, found, told), |problem| document.place(problem));
        }
    }
}

/// A text of cars or dummies written out: where it stands among the sources, and its tree there.
#[derive(Clone, Debug)]
pub(super) struct WrittenOut {
    id: SourceId,
    root: Node,
}

/// The scenario with its car expanded; unchanged if it has none, or an invalid one. Texts that were `read` before into the
/// same sources are not read again; others are added to the list.
pub(super) fn whole(sources: &mut Sources, root: &Node, read: &mut Vec<WrittenOut>) -> Node {
    if !is_there(root) {
        return root.clone();
    }
    let mut said = Document { sources: sources.clone(), main: root.span.source, root: root.clone() };
    if check_parts(&mut said, schema(), &CAR).has_errors() {
        return root.clone();
    }
    // for their quantities: what they lack the car gives them
    check_parts(&mut said, schema(), &BODIES);
    let texts = [("dummy", dummies::words(&said.root)), (CAR_TITLE, words(&said.root).unwrap_or_default())];
    texts.iter().filter(|(_, text)| !text.is_empty()).fold(root.clone(), |root, (title, text)| {
        if let Some(known) = read.iter().find(|known| sources.text(known.id) == *text) {
            return over(known.root.clone(), &root);
        }
        let Some(document) = written(title, text) else { return root };
        let id = sources.add(*title, document.shared());
        let own = document.root.moved_to(id);
        read.push(WrittenOut { id, root: own.clone() });
        over(own, &root)
    })
}

fn words(root: &Node) -> Option<String> {
    let riders: Vec<Rider> = cars(root).flat_map(|(vehicle, _)| riders(root, vehicle)).collect();
    cars(root).next()?;
    let mut text = String::from(SOURCES) + include_str!("materials.toml");
    if riders.iter().any(|rider| !rider.prefix.is_empty()) {
        text += "[contact]\nskin = \"flesh\"\n\n";
    }
    for (vehicle, car) in cars(root) {
        let section = CarSection::deserialize(car).ok()?;
        text += &Car::of(vehicle, &section, riders.len()).words(&riders);
    }
    Some(text)
}

/// An occupant of a seat.
pub(super) struct Rider {
    /// Prefix of his sections: empty, or "occupants.NAME.".
    prefix: String,
    /// The vehicle that he sits in, none for the first.
    vehicle: Option<String>,
    /// The seat's name.
    seat: String,
    /// Standing height, m.
    stature_m: f64,
    /// The dummy that it is.
    dummy: Option<DummyChoice>,
    /// Missing properties of his body.
    lacks: Lacks,
}

impl Rider {
    /// The occupant's name; empty of one alone.
    fn name(&self) -> &str {
        self.prefix.strip_prefix("occupants.").and_then(|name| name.strip_suffix('.')).unwrap_or_default()
    }
}

/// Properties that a scenario does not give for a body, and that the car's occupant therefore gets by default.
#[derive(Clone, Copy, Default)]
struct Lacks {
    /// The body.
    body: bool,
    /// The joints.
    joints: bool,
    /// Deformable parts: an adult with the joints and the segments of a person.
    flesh: bool,
    /// Flesh under a lap belt on iliac wings: such a person, or the dummy of an adult.
    pelvis: bool,
    /// The spheres: a body that does not define its own segments.
    spheres: bool,
    /// The initial state.
    posture: bool,
    /// The position of the arms.
    arms: bool,
}

/// Seats by name: row, and side from -1 (left) over 0 to 1; of the front row 1 is the driver.
pub(super) const SEATS: [(&str, usize, f64); 8] = [
    ("driver", 0, 1.0),
    ("passenger", 0, -1.0),
    ("rear_left", 1, -1.0),
    ("rear_middle", 1, 0.0),
    ("rear_right", 1, 1.0),
    ("third_left", 2, -1.0),
    ("third_middle", 2, 0.0),
    ("third_right", 2, 1.0),
];

/// Occupants of the seats of a vehicle's car.
fn riders(root: &Node, vehicle: Option<&str>) -> Vec<Rider> {
    let Some(several) = root.get("occupants").and_then(Node::as_table) else {
        let drives = vehicle.is_none().then(|| rider(root, "", "driver", vehicle));
        return drives.flatten().into_iter().collect();
    };
    let sits_here = |own: &Node| match own.get("vehicle").and_then(Node::as_str) {
        None | Some("vehicle") => vehicle.is_none(),
        of => of == vehicle,
    };
    let here: Vec<_> = several.iter().filter(|(_, entry)| sits_here(&entry.node)).collect();
    let usual = |name: &str| if here.len() == 1 && !is_seat(name) { "driver".to_owned() } else { name.to_owned() };
    let sits = |(name, entry): &(&String, &placed_text::Entry)| {
        rider(&entry.node, &format!("occupants.{name}."), &usual(name), vehicle)
    };
    here.iter().filter_map(sits).collect()
}

fn is_seat(name: &str) -> bool {
    SEATS.iter().any(|(seat, ..)| *seat == name)
}

fn rider(own: &Node, prefix: &str, usual: &str, vehicle: Option<&str>) -> Option<Rider> {
    let said = own.get("posture").and_then(|posture| posture.get("seat")).and_then(Node::as_str);
    let stripped = |said| vehicle.map_or(Some(said), |vehicle| str::strip_prefix(said, vehicle)?.strip_prefix('_'));
    let seat = said.map_or(Some(usual), stripped).filter(|seat| is_seat(seat))?;
    let (body, joints) = (own.get("body"), own.get("joints"));
    let section = body.and_then(|body| BodySection::deserialize(body).ok());
    let person = section.as_ref().map_or_else(|| presets::person_of(None), |own| presets::person_of(Some(own)));
    let says =
        |node: Option<&Node>, keys: &[&str]| node.is_some_and(|node| keys.iter().any(|key| node.get(key).is_some()));
    let preset = joints.and_then(|joints| joints.get("preset")).and_then(Node::as_str);
    let is_person = preset.is_none_or(|preset| presets::OF_PEOPLE.contains(&preset));
    let other_count =
        section.as_ref().and_then(|own| own.segment_count).is_some_and(|count| count != ride::SEGMENTS as i64);
    let flesh = is_person && person.is_some() && !other_count && !says(body, &["dummy", "segments"]);
    let hard = body.and_then(|body| body.get("pelvis")).and_then(Node::as_str).is_some_and(|pelvis| pelvis != "flesh");
    let dummy = section.and_then(|own| own.dummy);
    let is_adult_dummy = dummy.is_some_and(|dummy| dummy != DummyChoice::HybridIii6C);
    let lacks = Lacks {
        body: !says(body, &["preset", "dummy", "sex", "stature", "mass", "segments", "joints"]),
        joints: !says(joints, &["preset"]) && !says(body, &["joints", "dummy"]),
        flesh,
        pelvis: !hard && (flesh || (is_adult_dummy && !says(body, &["segments"]))),
        spheres: !says(body, &["sphere_set", "segments"]),
        arms: !says(own.get("posture"), &["upper_arms", "elbows", "left_upper_arm", "right_upper_arm"]),
        posture: !says(Some(own), &["initial_state", "mount", "stance"]),
    };
    let stature_m = person.map_or(classes::MEAN_STATURE_M, |person| person.stature_m);
    let vehicle = vehicle.map(str::to_owned);
    Some(Rider { prefix: prefix.to_owned(), vehicle, seat: seat.to_owned(), stature_m, dummy, lacks })
}

/// A car with all its dimensions.
pub(super) struct Car<'a> {
    /// Its vehicle, none for the first.
    vehicle: Option<&'a str>,
    measures: Measures,
    years: Years,
    section: &'a CarSection,
    /// How many sit in all cars together.
    riders: usize,
}

/// Backs that yield by their years alone: with the columns of two cars there is room for no more.
const MOST_BACKS: usize = 2;

impl<'a> Car<'a> {
    fn of(vehicle: Option<&'a str>, section: &'a CarSection, riders: usize) -> Self {
        let (measures, years) = (Measures::of(section), Years::of(section.years.unwrap_or_default()));
        Car { vehicle, measures, years, section, riders }
    }
}

impl Car<'_> {
    /// The expanded text for these occupants.
    fn words(&self, riders: &[Rider]) -> String {
        let mut text = String::new();
        let count = riders.len();
        let riders: Vec<&Rider> = riders.iter().filter(|rider| rider.vehicle.as_deref() == self.vehicle).collect();
        let seats = self.seats(&riders);
        for rider in riders {
            text.push_str(&self.ride(rider, count));
        }
        for seat in &seats {
            text.push_str(&seat.words());
        }
        let is_sled = self.section.class == Some(CarClass::Sled);
        text.push_str(&if is_sled { self.foot_rest() } else { self.shell(&seats) });
        text
    }

    /// +1 where the driver sits right of the middle, else -1.
    fn drivers_side(&self) -> f64 {
        if self.section.drive == Some(Side::Right) { 1.0 } else { -1.0 }
    }

    /// Name of a part.
    fn name(&self, part: &str) -> String {
        self.vehicle.map_or_else(|| part.to_owned(), |vehicle| format!("{vehicle}_{part}"))
    }

    /// Its frame.
    fn frame(&self) -> &str {
        self.vehicle.unwrap_or("vehicle")
    }

    /// A prism of it.
    fn prism(&self, name: &str, material: &str, profile: &[[f64; 2]], across: [f64; 2], more: &str) -> String {
        let frame = if more.contains("frame = ") { String::new() } else { frame_line(self.vehicle) };
        prism(&self.name(name), material, profile, across, &(frame + more))
    }

    /// What is said of a seat of a row, and what its years give it.
    fn seat(&self, name: &str, row: usize, is_taken: bool) -> CarSeatSection {
        let yields = is_taken && self.riders <= MOST_BACKS;
        self.years.fill(self.section.seats.get(name).cloned().unwrap_or_default(), row, yields)
    }
}

/// Sources of the numbers.
const SOURCES: &str = r#"
[provenance]
car = "no particular car: H30, W3, W20, L50 and H61 of a class after S. Macey, G. Wardle: H-Point, ch. 6; the driver's place after SAE J4004; D-ring after Shaw et al. 2009; all else ours"
"car.materials" = "ours, of the size of seats, panels and floors of a car; not measured, not fitted"
"car.bags" = "made up: no measured inflator may be shipped"
"#;

/// Line that fixes a part to a vehicle, none for the first.
fn frame_line(frame: Option<&str>) -> String {
    frame.map_or_else(String::new, |frame| format!("frame = \"{frame}\"\n"))
}

/// A length, m, as text.
fn m(length: f64) -> String {
    format!("\"{length} m\"")
}

/// A list of lengths.
fn list(lengths: &[f64]) -> String {
    format!("[{}]", lengths.iter().map(|length| m(*length)).collect::<Vec<_>>().join(", "))
}

/// A list of points.
fn points<const N: usize>(points: &[[f64; N]]) -> String {
    format!("[{}]", points.iter().map(|point| list(point)).collect::<Vec<_>>().join(", "))
}

/// A prism in side view between two lateral faces; `more` are further lines.
fn prism(name: &str, material: &str, profile: &[[f64; 2]], [y, half_width]: [f64; 2], more: &str) -> String {
    let mut text = format!("[solids.{name}]\nkind = \"prism\"\nmaterial = \"{material}\"\n");
    _ = writeln!(text, "profile = {}\ny = {}\nhalf_width = {}\n{more}", points(profile), m(y), m(half_width));
    text
}
