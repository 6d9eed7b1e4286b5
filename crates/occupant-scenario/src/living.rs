//! Consequences of a person's joints: a body whose neck has two joints and, for a volunteer, the muscles of an active
//! neck.

use super::expand::written;
use super::presets;
use super::sections::BodySection;
use occupant_core::body::people::{Person, REFERENCE_PERSON, Sex};
use placed_text::{Document, Entry, Node, Sources, Table, Value};
use serde::Deserialize;

/// The preset of joints that has muscles.
const VOLUNTEER: &str = "volunteer";

/// The default trigger of the muscles.
const FEELS: &str = "volunteer_feels";

/// Vehicle acceleration in the floor plane from which a volunteer reacts; our estimate, above that of ordinary driving.
const FELT: &str = "[triggers]\nvolunteer_feels = { kind = \"vehicle_acceleration\", threshold = \"0.5 g\" }\n";

/// Gains of a fully active muscle.
struct Gains {
    joint: &'static str,
    /// Gains of antagonistic muscles: torque per angle, N·m/rad, and per rate, N·m·s/rad, immediate.
    tense: [f64; 2],
    /// The same for reflexes, delayed.
    late: [f64; 2],
    /// Maximum torque, N·m.
    most_n_m: f64,
}

/// Fitted to four men at 15 g, frontal (Ewing and Thomas 1972), driven at T1, with their curves in view. The delayed
/// part was set by hand: the curves need none. The base's limit is 1.5 times the 52 (± 11) N·m that men pull back at C7
/// (Vasavada et al. 2001), for muscles that are stretched; the limit at the skull is half of it, a guess.
const GAINS: [Gains; 2] = [
    Gains { joint: "neck_base", tense: [2.0, 8.9], late: [10.0, 1.3], most_n_m: 78.0 },
    Gains { joint: "neck", tense: [1.0, 2.4], late: [2.0, 0.2], most_n_m: 39.0 },
];

/// Women pull 0.40 to 0.50 of what men pull (Vasavada et al. 2001: 21, 15, 16 and 6 N·m back, forward, sideways and in
/// twist, against 52, 30, 36 and 15). The same factor is used for all of their muscles.
const WOMEN: f64 = 0.44;

/// Time constant of reflexes, ms: 20 in the nerves and some 30 until the muscle pulls, as in published active models.
const LATE_MS: f64 = 50.0;

/// Time constant of activation, fitted, ms.
const RISE_MS: f64 = 12.0;

/// Activation before the stimulus, and ms from then until muscles pull. Both are fitted for the aware. Reflexes of
/// necks show after 54 to 92 ms (Foust et al. 1973, Schneider et al. 1975), so 50 is early; the 75 of the unaware is a
/// guess in this range. The tone of the braced is a guess: a level that people can hold for a while.
fn readiness(word: &str) -> [f64; 2] {
    match word {
        "unaware" => [0.0, 75.0],
        "braced" => [0.3, 50.0],
        _ => [0.0, 50.0],
    }
}

impl Gains {
    /// The muscle as keys of a scenario, for a person with a fraction of a man's strength.
    fn words(&self, strength: f64, [tone, reaction_ms]: [f64; 2], trigger: &str) -> String {
        let [[k, d], [late_k, late_d]] = [self.tense, self.late].map(|both| both.map(|gain| gain * strength));
        let (joint, most) = (self.joint, self.most_n_m * strength);
        format!(
            "[muscles.{joint}]\ntrigger = {trigger:?}\nreaction = \"{reaction_ms} ms\"\nrise = \"{RISE_MS} ms\"\ntone = {tone}\n\
             stiffness = \"{k} N m/rad\"\ndamping = \"{d} N m s/rad\"\nlimit = \"{most} N m\"\n\
             reflex = {{ stiffness = \"{late_k} N m/rad\", damping = \"{late_d} N m s/rad\", delay = \"{LATE_MS} ms\" }}\n"
        )
    }
}

fn preset<'n>(occupant: &'n Node, key: &str) -> Option<&'n str> {
    occupant.get(key)?.get("preset").and_then(Node::as_str)
}

/// Whether an occupant is a volunteer.
fn is_volunteer(occupant: &Node) -> bool {
    preset(occupant, "joints") == Some(VOLUNTEER)
}

/// Whether someone is a volunteer without muscles of their own in the scenario.
pub(super) fn any(root: &Node) -> bool {
    is_volunteer(root) || occupants(root).any(is_volunteer)
}

fn occupants(root: &Node) -> impl Iterator<Item = &Node> {
    let own = root.get("occupants").and_then(Node::as_table);
    own.into_iter().flat_map(Table::values).map(|entry| &entry.node)
}

/// The strength class of an occupant.
fn sex(occupant: &Node) -> Sex {
    let own = occupant.get("body").and_then(|body| BodySection::deserialize(body).ok());
    let named = preset(occupant, "body").and_then(Person::named).unwrap_or(REFERENCE_PERSON);
    own.map_or(named, |own| own.person(named)).sex
}

/// The muscles of a volunteer; entries for its joints by name override the preset. None for anyone else.
pub(super) fn muscles(sources: &mut Sources, occupant: &Node) -> Option<Entry> {
    if !is_volunteer(occupant) {
        return None;
    }
    let said = occupant.get("muscles");
    let word = |key: &str| said.and_then(|said| said.get(key)).and_then(Node::as_str);
    let (ready, trigger) = (word("readiness").unwrap_or("aware"), word("trigger").unwrap_or(FEELS));
    let sex = sex(occupant);
    let strength = if sex == Sex::Female { WOMEN } else { 1.0 };
    let title = format!("muscles of a volunteer, {sex:?}, {ready}, {trigger:?}");
    let text: String = GAINS.iter().map(|gains| gains.words(strength, readiness(ready), trigger)).collect();
    let mut muscles = laid(sources, &title, &text, "muscles")?;
    let table = muscles.node.as_table_mut()?;
    for (key, entry) in said.and_then(Node::as_table).into_iter().flatten() {
        if !["readiness", "trigger"].contains(&key.as_str()) {
            table.insert(key.clone(), entry.clone());
        }
    }
    Some(muscles)
}

/// Adds the volunteers' trigger to an explicit scenario, if an occupant in `root` uses it.
pub(super) fn feel(sources: &mut Sources, root: &Node, explicit: &mut Table) -> Option<()> {
    let asks = |own: &Node| is_volunteer(own) && own.get("muscles").and_then(|said| said.get("trigger")).is_none();
    if !(asks(root) || occupants(root).any(asks)) {
        return None;
    }
    let felt = laid(sources, "what a volunteer feels", FELT, "triggers")?;
    match explicit.get_mut("triggers") {
        Some(own) => {
            let felt = felt.node.as_table()?.get(FEELS)?.clone();
            own.node.as_table_mut()?.entry(FEELS.to_owned()).or_insert(felt);
        }
        None => drop(explicit.insert("triggers".to_owned(), felt)),
    }
    Some(())
}

/// A section of a built-in text.
fn laid(sources: &mut Sources, title: &str, text: &str, key: &str) -> Option<Entry> {
    let document: Document = written(title, text)?;
    let id = sources.named(title).unwrap_or_else(|| sources.add(title, document.shared()));
    let entry = document.root.as_table()?.get(key)?;
    Some(Entry { node: entry.node.moved_to(id), ..entry.clone() })
}

/// Default number of segments of a person.
const SEGMENTS: i64 = 19;

/// An occupant with the joints of a person and no given segments, with the number of segments for which a neck of two
/// joints is intended; none otherwise.
pub(super) fn divided(occupant: &Node) -> Option<Node> {
    let body = occupant.get("body")?;
    let says = |key: &str| body.get(key).is_some();
    let is_made = ["preset", "sex", "stature", "mass"].into_iter().any(says);
    let is_fixed = ["segment_count", "segments", "joints"].into_iter().any(says);
    let is_person = preset(occupant, "joints").is_some_and(|name| presets::OF_PEOPLE.contains(&name));
    if !is_person || !is_made || is_fixed || preset(occupant, "body") == Some(presets::OLD) {
        return None;
    }
    let (span, mut whole) = (body.span, occupant.clone());
    let count = Entry { key_span: span, node: Node::new(span, Value::Integer(SEGMENTS)) };
    whole.as_table_mut()?.get_mut("body")?.node.as_table_mut()?.insert("segment_count".to_owned(), count);
    Some(whole)
}
