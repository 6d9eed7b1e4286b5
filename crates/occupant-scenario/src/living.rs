//! Consequences of a person's joints: a body whose neck has two joints and, for a volunteer, the muscles of an active
//! body.

use super::expand::written;
use super::presets;
use super::sections::BodySection;
use occupant_core::body::both_sides;
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
    /// The same for reflexes, delayed; 0 without.
    late: [f64; 2],
    /// Maximum torque, N·m.
    most_n_m: f64,
    /// Gains and torque of a woman's muscle, as a fraction of a man's.
    women: f64,
}

/// Neck: fitted to four men at 15 g, frontal (Ewing and Thomas 1972), driven at T1, with their curves in view. The delayed
/// part was set by hand: the curves need none. The base's limit is 1.5 times the 52 (± 11) N·m that men pull back at C7
/// (Vasavada et al. 2001), for muscles that are stretched; the limit at the skull is half of it, a guess. Women pull
/// 0.40 to 0.50 of what men pull (Vasavada et al. 2001: 21, 15, 16 and 6 N·m back, forward, sideways and in twist, against
/// 52, 30, 36 and 15).
const NECK: [Gains; 2] = [
    Gains { joint: "neck_base", tense: [2.0, 8.9], late: [10.0, 1.3], most_n_m: 78.0, women: 0.44 },
    Gains { joint: "neck", tense: [1.0, 2.4], late: [2.0, 0.2], most_n_m: 39.0, women: 0.44 },
];

/// Trunk and limbs. Torques: medians of men (Stobbe 1982, in Chaffin and Andersson, Occupational Biomechanics), each the
/// mean over directions, because a muscle here knows one: trunk back 234, forward 143, sideways 159; hip 190 and 185;
/// knee 168 and 100; foot down 126, up a guess of 40; shoulder 67 to 92; elbow 77 and 46 N·m. Those of women by the same
/// table. Those of wrist and clavicle are guesses. Gains are those of `scenarios/side-slope.toml`, chosen with the heads of braked
/// volunteers in view (`docs/roadside.md`); of the back's, 42 % come late, the share of reflexes in the trunk's stiffness
/// (Moorhouse and Granata 2007). Reflexes of limbs are in their gains and their reaction time.
const TRUNK_AND_LIMBS: [Gains; 9] = [
    Gains { joint: "upper_back", tense: [290.0, 20.0], late: [210.0, 10.0], most_n_m: 179.0, women: 0.66 },
    Gains { joint: "lower_back", tense: [290.0, 20.0], late: [210.0, 10.0], most_n_m: 179.0, women: 0.66 },
    Gains { joint: "sternoclaviculars", tense: [20.0, 3.0], late: [0.0, 0.0], most_n_m: 74.0, women: 0.47 },
    Gains { joint: "shoulders", tense: [20.0, 3.0], late: [0.0, 0.0], most_n_m: 74.0, women: 0.47 },
    Gains { joint: "elbows", tense: [20.0, 3.0], late: [0.0, 0.0], most_n_m: 62.0, women: 0.55 },
    Gains { joint: "wrists", tense: [10.0, 0.5], late: [0.0, 0.0], most_n_m: 10.0, women: 0.55 },
    Gains { joint: "hips", tense: [120.0, 15.0], late: [0.0, 0.0], most_n_m: 188.0, women: 0.60 },
    Gains { joint: "knees", tense: [150.0, 12.0], late: [0.0, 0.0], most_n_m: 134.0, women: 0.63 },
    Gains { joint: "ankles", tense: [60.0, 4.0], late: [0.0, 0.0], most_n_m: 83.0, women: 0.64 },
];

/// Time constant of reflexes, ms: 20 in the nerves and some 30 until the muscle pulls, as in published active models.
const LATE_MS: f64 = 50.0;

/// When and how fast muscles act.
struct Timing {
    /// Activation before the stimulus.
    tone: f64,
    /// From the stimulus until muscles pull, ms.
    reaction_ms: f64,
    /// Time constant of activation, ms.
    rise_ms: f64,
}

/// The neck's. Reaction and rise are fitted for the aware. Reflexes of necks show after 54 to 92 ms (Foust et al. 1973,
/// Schneider et al. 1975), so 50 is early; the 75 of the unaware is a guess in this range. The tone of the braced is a
/// guess: a level that people can hold for a while.
fn of_the_neck(ready: &str) -> Timing {
    let (tone, reaction_ms) = match ready {
        "unaware" => (0.0, 75.0),
        "braced" => (0.3, 50.0),
        _ => (0.0, 50.0),
    };
    Timing { tone, reaction_ms, rise_ms: 12.0 }
}

/// Those of trunk and limbs. Muscles of relaxed men on a sled begin 100 ms after its start (Ejima et al. 2007) to 130 ms
/// (Ejima et al. 2008). The rise is of the size that active models use. Tone is a guess: a quarter of the back's stiffness holds a
/// trunk upright, whose weight topples it with some 90 N·m/rad.
fn of_the_body(ready: &str) -> Timing {
    let (tone, reaction_ms) = match ready {
        "unaware" => (0.25, 130.0),
        "braced" => (0.7, 100.0),
        _ => (0.25, 100.0),
    };
    Timing { tone, reaction_ms, rise_ms: 40.0 }
}

impl Gains {
    /// The muscle as keys of a scenario.
    fn words(&self, sex: Sex, timing: &Timing, trigger: &str) -> String {
        let strength = if sex == Sex::Female { self.women } else { 1.0 };
        let [[k, d], [late_k, late_d]] = [self.tense, self.late].map(|both| both.map(|gain| gain * strength));
        let (joint, most) = (self.joint, self.most_n_m * strength);
        let Timing { tone, reaction_ms, rise_ms } = timing;
        let late =
            format!("stiffness = \"{late_k} N m/rad\", damping = \"{late_d} N m s/rad\", delay = \"{LATE_MS} ms\"");
        let reflex = if self.late == [0.0; 2] { String::new() } else { format!("reflex = {{ {late} }}\n") };
        format!(
            "[muscles.{joint}]\ntrigger = {trigger:?}\nreaction = \"{reaction_ms} ms\"\nrise = \"{rise_ms} ms\"\ntone = {tone}\n\
             carries = true\nstiffness = \"{k} N m/rad\"\ndamping = \"{d} N m s/rad\"\nlimit = \"{most} N m\"\n{reflex}"
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

/// The muscles of a volunteer with joints of these names; entries by name override the preset. None for anyone else.
pub(super) fn muscles<'a>(
    sources: &mut Sources,
    occupant: &Node,
    joints: impl Iterator<Item = &'a str> + Clone,
) -> Option<Entry> {
    if !is_volunteer(occupant) {
        return None;
    }
    let said = occupant.get("muscles");
    let word = |key: &str| said.and_then(|said| said.get(key)).and_then(Node::as_str);
    let (ready, trigger) = (word("readiness").unwrap_or("aware"), word("trigger").unwrap_or(FEELS));
    let sex = sex(occupant);
    let title = format!("muscles of a volunteer, {sex:?}, {ready}, {trigger:?}");
    let text = |rows: &[Gains], timing: Timing| -> String {
        rows.iter().map(|gains| gains.words(sex, &timing, trigger)).collect()
    };
    let text = text(&NECK, of_the_neck(ready)) + &text(&TRUNK_AND_LIMBS, of_the_body(ready));
    let mut muscles = laid(sources, &title, &text, "muscles")?;
    let table = muscles.node.as_table_mut()?;
    table.retain(|key, _| joints.clone().any(|joint| joint == key || both_sides(joint).as_ref() == Some(key)));
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
