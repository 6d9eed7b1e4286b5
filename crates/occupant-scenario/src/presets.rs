//! Bases of `body` and `joints` of a scenario: built-in occupants, in `presets` or made by
//! [`occupant_core::body::people`]. Programs without a text get the same ones, read like a scenario's.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use nalgebra::{UnitQuaternion, Vector2};
use serde::Deserialize;
use serde::de::DeserializeOwned;

pub(super) mod chest;

use super::expand::{expand, written};
use super::sections::{AbdomenChoice, BodySection, ChestChoice, PelvisChoice, SidesChoice, occupant};
use occupant_core::body::people::{self, Division, Person};
use occupant_core::body::tti12::TTI12;
use occupant_core::body::{Body, Joint, JointKind};
use occupant_core::forces::joint::Joints;
use placed_text::{Document, Format, Node};

/// The body named in `body.preset`; none for an unknown name.
pub fn preset_body(name: &str) -> Option<Body> {
    Some(read(name)?.0)
}

/// The occupant of a scenario with only names of presets.
pub(crate) fn read(body: &str) -> Option<(Body, Joints)> {
    let text = format!("body = {{ preset = {body:?} }}\njoints = {{ preset = \"male50\" }}\n");
    let mut document = Document::read(&text, Format::Toml, "preset").ok()?;
    document.root = expand(&mut document.sources, &document.root);
    occupant(body, &document)
}

/// The base text of a section named `key` of a checked scenario, and its name in messages.
pub(super) fn base(section: &Node, key: &str) -> Option<(String, Arc<Document>)> {
    let preset = section.get("preset").and_then(Node::as_str);
    match (key, preset) {
        ("joints", Some("male50")) => Some(("preset male50".to_owned(), male50()?.clone())),
        ("body", Some(OLD)) if section.get("joints").is_none() => Some(("preset male50".to_owned(), male50()?.clone())),
        ("joints", Some(name)) => {
            let at = ELASTIC.iter().position(|(known, _)| *known == name)?;
            static READ: [Read; ELASTIC.len()] = [const { OnceLock::new() }; ELASTIC.len()];
            let title = format!("preset {name}");
            let document = READ[at].get_or_init(|| written(&title, ELASTIC[at].1).map(Arc::new)).clone()?;
            Some((title, document))
        }
        ("body", _) => made(section, preset),
        _ => None,
    }
}

/// Text of the deformable parts chosen by a body section, and its name.
fn giving(own: &BodySection, made: &Made, body: &Body) -> Option<(String, String)> {
    let flesh = (own.pelvis == Some(PelvisChoice::Flesh)).then(|| chest::flesh(body));
    let chest = chest_of(own, made, body);
    let abdomen = own.abdomen.filter(|choice| *choice == AbdomenChoice::Person).and_then(|_| chest::abdomen(body));
    let named = own.chest.filter(|_| chest.is_some()).map(|chest| format!("chest {}", chest.name()));
    let sides = sides_of(own, made, body);
    let parts = [("flesh", flesh.is_some()), ("abdomen", abdomen.is_some()), ("sides", sides.is_some())];
    let parts = parts.into_iter().filter(|(_, is_there)| *is_there).map(|(name, _)| name.to_owned());
    let name = named.into_iter().chain(parts).collect::<Vec<_>>();
    if name.is_empty() {
        return None;
    }
    // how spheres ride stands behind the table of spheres, plates after it
    let ([rides, plates], [belly, its_plate]) = (flesh.unwrap_or_default(), abdomen.unwrap_or_default());
    let [chest, sides] = [chest, sides].map(|lines| lines.unwrap_or_default().join("\n"));
    Some(([rides, belly, chest, plates, its_plate, sides].join("\n"), name.join(" and ")))
}

/// Text of the chest chosen by a body section; none for a child, for which there are no tests.
fn chest_of(own: &BodySection, made: &Made, body: &Body) -> Option<Vec<String>> {
    let choice = own.chest.filter(|choice| *choice != ChestChoice::Rigid)?;
    let (people, reference) = beside_reference(made)?;
    Some(chest::words(choice, body, people, &reference))
}

/// The same for the sides.
fn sides_of(own: &BodySection, made: &Made, body: &Body) -> Option<Vec<String>> {
    let choice = own.sides.filter(|choice| *choice != SidesChoice::Rigid)?;
    let (people, reference) = beside_reference(made)?;
    Some(chest::sides(choice, body, people, &reference))
}

/// The adult of a body and the one of the tests, and the body of the latter; none for a child.
fn beside_reference(made: &Made) -> Option<([Person; 2], Body)> {
    let is_old = made.preset.as_deref() == Some(OLD);
    let person = if is_old { people::REFERENCE_PERSON } else { made.person? };
    let division = if is_old { Division::default() } else { made.division };
    let reference = people::REFERENCE_PERSON.body(division).0;
    Some(([person, people::REFERENCE_PERSON], reference))
}

/// A built-in text, once parsed.
type Read = OnceLock<Option<Arc<Document>>>;

/// Key of a generated body.
#[derive(Clone, PartialEq)]
struct Made {
    preset: Option<String>,
    person: Option<Person>,
    division: Division,
    /// Whether its joints are written.
    has_joints: bool,
    gives: (Option<ChestChoice>, Option<PelvisChoice>, Option<AbdomenChoice>, Option<SidesChoice>),
}

/// Bodies already made, with their names in messages.
type Kept = Vec<(Made, String, Arc<Document>)>;

/// The text of a body made from a section. Samples of a study request the same bodies repeatedly, so the latest are
/// kept.
fn made(section: &Node, preset: Option<&str>) -> Option<(String, Arc<Document>)> {
    const KEPT: usize = 32;
    static LATEST: Mutex<Kept> = Mutex::new(Vec::new());
    let own = BodySection::deserialize(section).ok()?;
    let from = Made {
        preset: preset.map(str::to_owned),
        person: person(&own, preset),
        division: own.division().unwrap_or_default(),
        has_joints: section.get("joints").is_some(),
        gives: (own.chest, own.pelvis, own.abdomen, own.sides),
    };
    let latest = || LATEST.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, title, document)) = latest().iter().find(|(key, ..)| *key == from) {
        return Some((title.clone(), document.clone()));
    }
    let old = || (preset == Some(OLD)).then(|| preset_body(OLD)).flatten();
    let body = preset.and_then(|name| people::child(name, from.division)).or_else(old);
    let body = body.or_else(|| Some(from.person?.body(from.division).0))?;
    let (mut text, mut title) = (words(&body, from.has_joints), format!("body of {}", preset.unwrap_or("a person")));
    if let Some((more, name)) = giving(&own, &from, &body) {
        (text, title) = (text + "\n" + &more, format!("{title} with {name}"));
    }
    let document = Arc::new(written(&title, &text)?);
    let mut latest = latest();
    if latest.len() == KEPT {
        latest.remove(0);
    }
    latest.push((from, title.clone(), document.clone()));
    Some((title, document))
}

/// The preset whose body is stored in a file.
pub(super) const OLD: &str = "male50-1970";

/// Presets of joints whose necks have two joints.
pub(super) const OF_PEOPLE: [&str; 2] = ["person", "volunteer"];

/// The body of the first version and a starting set of joints.
fn male50() -> Option<&'static Arc<Document>> {
    static READ: Read = OnceLock::new();
    READ.get_or_init(|| written("preset male50", include_str!("presets/male50-1970.toml")).map(Arc::new)).as_ref()
}

/// Sections of a scenario that the library has entries for.
pub(super) const IN_LIBRARY: [&str; 5] = ["materials", "webbings", "limiters", "frames", "bags"];

/// Materials, webbings, limiters and columns from public texts, with their sources, and invented bags.
pub(super) fn library() -> Option<&'static Document> {
    static READ: OnceLock<Option<Document>> = OnceLock::new();
    READ.get_or_init(|| written("library", include_str!("presets/library.toml"))).as_ref()
}

/// An entry of a section of the library.
pub(super) fn from_library<T: DeserializeOwned>(section: &str, name: &str) -> Option<T> {
    T::deserialize(library()?.root.get(section)?.get(name)?).ok()
}

/// Joints with elastic limits, by name.
const ELASTIC: [(&str, &str); 7] = [
    ("person", include_str!("presets/person.toml")),
    // whose muscles stand in `living.rs`
    ("volunteer", include_str!("presets/person.toml")),
    ("gebod", include_str!("presets/gebod.toml")),
    ("dummy50-1973-like", include_str!("presets/dummy50-1973-like.toml")),
    ("dummy50-like", include_str!("presets/dummy50-like.toml")),
    ("dummy05f-like", include_str!("presets/dummy05f-like.toml")),
    ("dummy06c-like", include_str!("presets/dummy06c-like.toml")),
];

/// The adult that a body section describes; the reference if it is incomplete or out of range, which is reported when
/// the body is built.
fn person(own: &BodySection, preset: Option<&str>) -> Option<Person> {
    let named = preset.and_then(Person::named);
    if named.is_none() && !own.describes_a_person() {
        return None;
    }
    let start = named.unwrap_or(people::REFERENCE_PERSON);
    let person = own.person(start);
    Some(if person.is_within_reach() { person } else { start })
}

/// The adult of a body section, by default the reference person; none for a child or your own body.
pub(super) fn person_of(own: Option<&BodySection>) -> Option<Person> {
    let Some(own) = own else { return Some(people::REFERENCE_PERSON) };
    let says = own.preset.is_some() || own.describes_a_person() || !own.segments.is_empty() || !own.joints.is_empty();
    if says { person(own, own.preset.as_deref()) } else { Some(people::REFERENCE_PERSON) }
}

/// A body as keys of a scenario, with its joints if they are its own or `has_joints` is set. Every number has the same
/// width, so positions in one text are valid in another.
fn words(body: &Body, has_joints: bool) -> String {
    let mut lines = vec![
        "[body]".to_owned(),
        format!("shoulder_half_width = {}", quantity(body.shoulder_half_width_m, "m")),
        format!("hip_half_width = {}", quantity(body.hip_half_width_m, "m")),
        format!("neck_height = {}", quantity(body.neck_height_m, "m")),
    ];
    if let Some(at) = body.condyles_m {
        lines.push(format!("condyles = [{}, {}]", quantity(at.x, "m"), quantity(at.z, "m")));
    }
    for (row, p) in body.tree.segment_rows().iter().zip(&body.segments) {
        lines.push(format!("[body.segments.{}]", row.name));
        lines.push(format!("length = {}", quantity(p.length_m, "m")));
        lines.push(format!("cg_from_lower_end = {}", quantity(p.cg_from_lower_end_m, "m")));
        lines.push(format!("mass = {}", quantity(p.mass_kg, "kg")));
        lines.push(format!("inertia = {}", list(p.inertia_kg_m2.as_slice(), "kg m^2")));
        if p.cg_beside_m != Vector2::zeros() {
            lines.push(format!("cg_beside = {}", list(p.cg_beside_m.as_slice(), "m")));
        }
        if p.principal != UnitQuaternion::identity() {
            lines.push(format!("principal_axes = {}", angles(&p.principal)));
        }
    }
    let joints = body.tree.joints().filter(|_| has_joints || *body.tree != TTI12);
    lines.extend(joints.flat_map(|joint| joint_words(body, joint)));
    lines.push("[body.spheres]".to_owned());
    lines.extend(body.spheres.iter().map(|s| format!("{}.radius = {}", s.name, quantity(s.radius_m, "m"))));
    lines.join("\n")
}

fn quantity(value: f64, unit: &str) -> String {
    format!("\"{value:.16e} {unit}\"")
}

fn list(values: &[f64], unit: &str) -> String {
    let each: Vec<String> = values.iter().map(|value| quantity(*value, unit)).collect();
    format!("[{}]", each.join(", "))
}

/// Yaw, pitch and roll.
fn angles(turn: &UnitQuaternion<f64>) -> String {
    let (roll, pitch, yaw) = turn.euler_angles();
    list(&[yaw, pitch, roll], "rad")
}

fn joint_words(body: &Body, joint: Joint) -> Vec<String> {
    let (row, place) = (&body.tree[joint], body.place(joint));
    let kind = match row.kind {
        JointKind::Ball => "ball",
        JointKind::Hinge => "pin",
        JointKind::Universal => "universal",
        JointKind::Fixed => "fixed",
    };
    vec![
        format!("[body.joints.{}]", row.name),
        format!("proximal = {:?}", body.tree[row.proximal].name),
        format!("distal = {:?}", body.tree[row.distal].name),
        format!("kind = {kind:?}"),
        format!("on_proximal = {}", list(place.proximal.point_m.as_slice(), "m")),
        format!("on_distal = {}", list(place.distal.point_m.as_slice(), "m")),
    ]
}
