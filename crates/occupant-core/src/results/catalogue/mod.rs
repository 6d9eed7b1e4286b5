//! The catalogue of results: every quantity of a model once, as a time history ([`crate::results::channel`]) and as a field
//! of the result file's messages ([`messages`]).
//!
//! Summaries, plots, exports, prints and studies take names, units, axes and values from here. It writes nothing.

mod body;
mod chest;
mod drive;
mod energy;
mod joint;
mod marker;
mod sphere;
mod surface;
mod turn;
mod vehicle;

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;

use crate::forces::own::ForceChannel;
use crate::forces::{Listed, STORED, SUMS, StoredEnergy, Visitor, WorkSum, visit_kinds};
use crate::model::Model;
use crate::quantity::{Axes, Energy, Kind, Owner, Quantity, Value};
use crate::results::channel::{Channel, Component};
use crate::results::energy::EnergyLedger;
use crate::results::sample::Sample;

pub use sphere::touch;

/// Access to a value in a sample of the catalogued model.
#[derive(Clone)]
pub struct Source(Arc<dyn Fn(&Sample<'_>) -> Value + Send + Sync>);

impl Source {
    /// A source from a function.
    pub(crate) fn new(of: impl Fn(&Sample<'_>) -> Value + Send + Sync + 'static) -> Self {
        Source(Arc::new(of))
    }

    /// The value at an output.
    pub fn value(&self, sample: &Sample<'_>) -> Value {
        (self.0)(sample)
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Source")
    }
}

/// Message type of the result file, with its topic and its fields by number.
#[derive(Clone, Debug)]
pub struct Message {
    /// Name of the type.
    pub name: &'static str,
    /// Topic: ASCII and small letters, the same in every run of a scenario.
    pub topic: String,
    /// Fields in the order of their numbers.
    pub fields: Vec<Field>,
}

/// A field of a message.
#[derive(Clone, Debug)]
pub struct Field {
    /// Its number.
    pub number: u32,
    /// Quantity, axes, unit.
    pub name: String,
    /// Meaning.
    pub meaning: Cow<'static, str>,
    /// Its type.
    pub kind: Kind,
    /// Source; none in a message that is written as a whole.
    pub source: Option<Source>,
}

/// Position of the message types of force elements in [`ORDER`].
const ELEMENTS: &str = "";

/// Message types in their order in a file.
const ORDER: [&str; 14] = [
    "VehicleMotion",
    "DriveState",
    "SegmentState",
    "SphereLoad",
    ELEMENTS,
    "JointAngles",
    "JointLoad",
    "Instruments",
    "MountLoad",
    "MarkerMotion",
    "EnergyLedger",
    "EnergyOfBody",
    "SolverState",
    "ReportCoordinates",
];

/// All messages of a model with results at every output, in their order in a file.
pub fn messages(model: &Model) -> Vec<Message> {
    let mut messages = Catalogue::of(model).messages;
    let place = |of: &str| ORDER.iter().position(|name| *name == of);
    messages.sort_by_key(|m| place(m.name).or(place(ELEMENTS)));
    for message in &mut messages {
        message.fields.sort_by_key(|f| f.number);
    }
    messages
}

/// Adds the quantities of force elements.
struct Elements<'a> {
    model: &'a Model,
    all: &'a mut Catalogue,
}

impl Visitor for Elements<'_> {
    fn visit<E: Listed>(&mut self) {
        let [of, _] = E::NAMES;
        let data = self.model.setup().forces(self.model.faces());
        let names = E::named(E::data(&data)).into_iter().map(|one| one.name);
        for (i, (name, topic)) in named(&format!("/{of}"), names).into_iter().enumerate() {
            let (channel, words) = (format!("{of}.{name}"), format!("{of} {name}"));
            let place = Place { message: E::MESSAGE, topic, name: &channel, words: &words };
            self.all.add(&place, E::QUANTITIES, move |s| &E::actions(s.actions)[i]);
        }
    }
}

/// Owner of the quantities of a list in a model.
struct Place<'a> {
    /// Message type.
    message: &'static str,
    topic: String,
    /// Prefix of the channel names.
    name: &'a str,
    /// Text of the owner.
    words: &'a str,
}

/// The combined lists.
#[derive(Default)]
pub(super) struct Catalogue {
    pub(super) channels: Vec<Channel>,
    of: u64,
    messages: Vec<Message>,
}

impl Catalogue {
    pub(super) fn of(model: &Model) -> Self {
        let mut all = Catalogue { of: model.names_hash(), ..Catalogue::default() };
        all.vehicles(model);
        let tree = model.body().tree;
        for segment in tree.segments() {
            let name = tree[segment].name;
            let topic = topic_of("segment", name);
            let place = Place { message: "SegmentState", topic, name, words: &name.replace('_', " ") };
            all.add(&place, body::SEGMENT, move |s| (s, segment));
            all.add(&place, turn::SEGMENT, move |s| (s, segment));
        }
        for (of, row) in tree.bodies().into_iter().enumerate() {
            let instruments: Vec<_> = body::of_dummy(&row.landmarks).collect();
            let topic = if row.name.is_empty() {
                "/occupant/instruments".to_owned()
            } else {
                topic_of("instruments", row.name)
            };
            let place = Place { message: "Instruments", topic, name: row.name, words: row.name };
            all.add(&place, &instruments, move |s| s.of_body(of));
        }
        if model.setup().mounting().is_some() {
            all.whole("MountLoad", "/occupant/mount", "", body::MOUNT, |s| *s);
        }
        let names = model.body().spheres.iter().map(|s| s.name.as_str());
        for (i, (name, topic)) in named("/occupant/sphere", names).into_iter().enumerate() {
            let (channel, words) = (format!("sphere.{name}"), format!("sphere {name}"));
            let place = Place { message: "SphereLoad", topic, name: &channel, words: &words };
            all.add(&place, sphere::QUANTITIES, move |s| (s, i));
            if !model.setup().bags.is_empty() {
                all.add(&place, sphere::OF_BAGS, move |s| (s, i));
            }
        }
        all.surfaces(model);
        visit_kinds(&mut Elements { model, all: &mut all });
        all.own_forces(model);
        model.body().chests.iter().for_each(|chest| all.chest(chest));
        for joint in tree.joints() {
            let name = tree[joint].name;
            let (channel, words) = (format!("joint.{name}"), name.replace('_', " "));
            let topic = match name.rsplit_once('.') {
                Some((of, _)) => topic_of("joints", of),
                None => "/occupant/joints".to_owned(),
            };
            let place = Place { message: "JointAngles", topic, name: &channel, words: &words };
            all.add(&place, &[joint::angle(tree, joint)], move |s| (s, joint));
            let topic = topic_of("joint", name);
            let place = Place { message: "JointLoad", topic, name: &channel, words: &words };
            all.add(&place, joint::LOAD, move |s| (s, joint));
            all.add(&place, turn::JOINT, move |s| (s, joint));
        }
        all.markers(model);
        all.energies(model);
        all.whole("SolverState", "/solver", "", energy::EFFORT, |s| s.effort);
        if model.setup().output.report_coordinates {
            all.whole("ReportCoordinates", "/occupant/report_coordinates", "", body::REPORT_COORDINATES, |s| *s);
        }
        all
    }

    fn vehicles(&mut self, model: &Model) {
        let setup = model.setup();
        let place = Place { message: "VehicleMotion", topic: "/vehicle".to_owned(), name: "vehicle", words: "vehicle" };
        self.add(&place, &vehicle::quantities(&setup.path), vehicle::first);
        let names = named("/vehicle", vehicle::others(setup).map(|(_, frame)| frame.name.as_str()));
        for ((i, frame), (name, topic)) in vehicle::others(setup).zip(names) {
            let (channel, words) = (format!("vehicle.{name}"), format!("vehicle {name}"));
            let place = Place { message: "VehicleMotion", topic, name: &channel, words: &words };
            self.add(&place, &vehicle::quantities(&frame.path), move |s| vehicle::other(s, i));
        }
        let names = named("/drive", setup.logs.iter().map(|log| log.name.as_str()));
        for (i, (name, topic)) in names.into_iter().enumerate() {
            let (channel, words) = (format!("drive.{name}"), format!("driven vehicle {name}"));
            let place = Place { message: "DriveState", topic, name: &channel, words: &words };
            self.add(&place, &drive::QUANTITIES, move |s| drive::at(s, i));
        }
    }

    fn surfaces(&mut self, model: &Model) {
        let setup = model.setup();
        let surfaces = setup.surfaces.iter().map(|surface| ("surface", &surface.name, surface.frame));
        let solids = setup.solids.iter().map(|solid| ("solid", &solid.name, solid.frame));
        for (i, (of, name, frame)) in surfaces.chain(solids).enumerate() {
            let (channel, words) = (format!("{of}.{name}"), format!("{of} {name}"));
            let place = Place { message: "", topic: String::new(), name: &channel, words: &words };
            let carrier = setup.belongs_to(frame);
            self.add(&place, &surface::quantities(carrier), move |s| (s, i, carrier));
        }
    }

    /// Values shown by a program's own forces.
    fn own_forces(&mut self, model: &Model) {
        for (i, own) in model.setup().own_forces.iter().enumerate() {
            for (k, ForceChannel { name, unit }) in own.force.channels().into_iter().enumerate() {
                self.channels.push(Channel {
                    name: format!("own_force.{}.{name}", own.name),
                    unit,
                    axes: Axes::None,
                    meaning: format!("{} of the own force {}", name.replace('_', " "), own.name),
                    source: Source::new(move |sample| {
                        Value::Number(sample.actions.own.get(i).map_or(f64::NAN, |action| action.shown[k]))
                    }),
                    component: Component::X,
                    of: self.of,
                });
            }
        }
    }

    fn markers(&mut self, model: &Model) {
        let markers = &model.setup().output.markers;
        let names = named("/occupant/marker", markers.iter().map(|marker| marker.name.as_str()));
        for (marker, (name, topic)) in markers.iter().zip(names) {
            let (channel, words) = (format!("marker.{name}"), format!("marker {name}"));
            let place = Place { message: "MarkerMotion", topic, name: &channel, words: &words };
            let (site, frame) = (marker.site(model.body()), marker.frame);
            let start_m = marker::start_m(model, &site, frame);
            self.add(&place, &marker::quantities(frame), move |s| marker::motion(s, &site, frame, &start_m));
        }
    }

    fn energies(&mut self, model: &Model) {
        for (of, member) in model.setup().members.iter().enumerate() {
            let name = member.name.as_str();
            let place = Place {
                message: "EnergyOfBody",
                topic: format!("/occupants/{}/energy", in_small_letters(name)),
                name: &format!("energy.{name}"),
                words: name,
            };
            for (value, quantity) in energy::OF_BODY {
                self.add(&place, &[quantity], move |s| value(&s.ledgers[of]));
            }
        }
        for (of, quantity) in energy::MOTION {
            self.energy(quantity, of);
        }
        let forces = &model.system().forces;
        for StoredEnergy { at, quantity, .. } in STORED.into_iter().filter(|energy| forces.tells(&energy.quantity)) {
            self.energy(quantity, move |ledger| ledger.stored_j[at]);
        }
        for WorkSum { at, quantity } in SUMS.into_iter().filter(|energy| forces.tells(&energy.quantity)) {
            self.energy(quantity, move |ledger| ledger.lost_j[at]);
        }
        for (of, quantity) in energy::BALANCE {
            self.energy(quantity, of);
        }
    }

    fn energy(&mut self, quantity: Quantity<Energy>, of: impl Fn(&EnergyLedger) -> f64 + Send + Sync + Copy + 'static) {
        self.whole("EnergyLedger", "/energy", "energy", &[quantity], move |s| of(&s.energy));
    }

    /// Adds a list of quantities that exist once in a model.
    fn whole<O: Owner + 'static>(
        &mut self,
        message: &'static str,
        topic: &str,
        name: &str,
        list: &[Quantity<O>],
        at: impl for<'a> Fn(&'a Sample<'a>) -> O::At<'a> + Send + Sync + Copy + 'static,
    ) {
        self.add(&Place { message, topic: topic.to_owned(), name, words: name }, list, at);
    }

    /// Adds the quantities of one owner; `at` gives its data at an output.
    fn add<O: Owner + 'static>(
        &mut self,
        place: &Place<'_>,
        list: &[Quantity<O>],
        at: impl for<'a> Fn(&'a Sample<'a>) -> O::At<'a> + Send + Sync + Copy + 'static,
    ) {
        for &quantity in list {
            let source = Source::new(move |sample| quantity.value(&at(sample)));
            self.add_channels(place, &quantity, &source);
            self.add_fields(place, &quantity, source);
        }
    }

    fn add_channels<O: Owner>(&mut self, place: &Place<'_>, quantity: &Quantity<O>, source: &Source) {
        let Some(words) = quantity.channel else {
            return;
        };
        let name = [place.name, words.name].into_iter().filter(|w| !w.is_empty()).collect::<Vec<_>>().join(".");
        let meaning = words.meaning.replace("{}", place.words);
        let (unit, axes, of) = (quantity.unit, quantity.axes, self.of);
        let channel = |name, axes, component| {
            let (meaning, source) = (meaning.clone(), source.clone());
            Channel { name, unit, axes, meaning, source, component, of }
        };
        if quantity.kind() == Kind::Vector {
            let components = Component::ALL.into_iter();
            self.channels.extend(components.map(|c| channel(format!("{name}.{}", c.name()), c.axes(axes), c)));
        } else {
            self.channels.push(channel(name, axes, Component::X));
        }
    }

    fn add_fields<O: Owner>(&mut self, place: &Place<'_>, quantity: &Quantity<O>, source: Source) {
        if quantity.field.is_none() && quantity.resultant.is_none() {
            return;
        }
        let fields = fields(quantity, source);
        match self.messages.iter_mut().find(|m| m.topic == place.topic) {
            Some(message) => message.fields.extend(fields),
            None => self.messages.push(Message::of(place.message, &place.topic, fields)),
        }
    }
}

impl Message {
    /// Message of something that exists once in a model.
    fn of(name: &'static str, topic: &str, fields: impl IntoIterator<Item = Field>) -> Self {
        Message { name, topic: topic.to_owned(), fields: [time()].into_iter().chain(fields).collect() }
    }
}

/// Fields of a quantity: its own and that of its magnitude.
fn fields<O: Owner>(quantity: &Quantity<O>, source: Source) -> impl Iterator<Item = Field> + use<O> {
    let own = quantity.field.map(|words| Field {
        number: words.number,
        name: quantity.field_name(words.stem),
        meaning: words.meaning.into(),
        kind: quantity.kind(),
        source: Some(source.clone()),
    });
    let resultant = quantity.resultant.map(|words| Field {
        number: words.number,
        name: quantity.resultant_name(words.stem),
        meaning: words.meaning.into(),
        kind: Kind::Number,
        source: Some(Source::new(move |sample| Value::Number(Component::Resultant.of(&source.value(sample))))),
    });
    own.into_iter().chain(resultant)
}

/// Time, the first field of every message.
fn time() -> Field {
    Field {
        number: 1,
        name: "time_s".to_owned(),
        meaning: "time of the scenario".into(),
        kind: Kind::Number,
        source: Some(Source::new(|s| Value::Number(s.time_s))),
    }
}

/// Topic of a body's data, or of one of several bodies, whose name precedes a dot.
fn topic_of(of: &str, name: &str) -> String {
    match name.split_once('.') {
        Some((occupant, part)) => format!("/occupants/{}/{of}/{part}", in_small_letters(occupant)),
        None if ["instruments", "joints"].contains(&of) => format!("/occupants/{}/{of}", in_small_letters(name)),
        None => format!("/occupant/{of}/{name}"),
    }
}

/// User's names, each with a topic of its own below `parent`.
fn named<'a>(parent: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<(&'a str, String)> {
    let mut taken = BTreeSet::new();
    let mut topic = |name: &str| {
        let plain = format!("{parent}/{}", in_small_letters(name));
        let mut topic = plain.clone();
        let mut number = 2;
        while !taken.insert(topic.clone()) {
            topic = format!("{plain}_{number}");
            number += 1;
        }
        topic
    };
    names.into_iter().map(|name| (name, topic(name))).collect()
}

/// Lower case; characters other than letters and digits become `_`.
fn in_small_letters(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    name.chars().map(letter).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_different_topics() {
        let topics: Vec<String> =
            named("/belt", ["lap", "Lap", "left knee", "gurt/λ"]).into_iter().map(|n| n.1).collect();
        assert_eq!(topics, ["/belt/lap", "/belt/lap_2", "/belt/left_knee", "/belt/gurt__"]);
    }
}
