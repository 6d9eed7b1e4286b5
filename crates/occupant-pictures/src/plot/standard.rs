//! The fourteen plots of the card STAN, for any body and, where there are several, for each occupant.
//!
//! The report says that fourteen selected variables were plotted against time; which they were is lost with its listing. Ours:
//! accelerations of head, chest (upper torso) and pelvis (lower torso) ahead, up and resultant, as an accelerometer in the
//! segment reads them (1–9); contact forces on head, chest and knees (10); belt loads (11); spine angles (12); energies (13);
//! the vehicle's acceleration (14). Which segments these are a body says by its landmarks. Of several occupants each has the
//! first thirteen, and each vehicle the last.

use occupant_core::body::{BodyRow, Landmarks};
use occupant_core::model::Model;
use occupant_core::results::channel::{channels, matching, star};
use occupant_files::base::customary::{
    ACCELERATIONS, CONTACTS, ENERGIES, ENERGIES_OF_BODY, FRONTAL_CONTACTS, VEHICLE, WEBBING,
};

/// A requested plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Heading.
    pub title: String,
    /// Label of the vertical axis.
    pub axis: String,
    /// The curves.
    pub entries: Vec<Entry>,
    /// Text if a scenario has none of them.
    pub empty: String,
}

/// A channel with its name in the legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The channel.
    pub channel: String,
    /// Label in the legend.
    pub label: String,
}

/// Number of energies in plots of several runs.
const FEW_ENERGIES: usize = 4;
/// Number of spheres of a body without the usual names.
const FEW_SPHERES: usize = 8;

/// The plots of a model; for several runs only the main energies.
pub fn standard(model: &Model, several: bool) -> Vec<Plot> {
    let bodies = model.body().tree.bodies();
    let is_person = |row: &&BodyRow| bodies.len() == 1 || row.landmarks != Landmarks::NONE;
    let people = bodies.iter().filter(is_person).flat_map(|row| of_person(model, row, several));
    people.chain(of_vehicles(model)).collect()
}

/// The first thirteen of a person.
fn of_person(model: &Model, row: &BodyRow, several: bool) -> Vec<Plot> {
    let tree = model.body().tree;
    let marks = &row.landmarks;
    let mut plots = Vec::with_capacity(13);
    for ((_, name), segment) in ACCELERATIONS.iter().zip([marks.head, marks.chest, marks.pelvis]) {
        for (component, words) in [("x", "X, ahead"), ("z", "Z, up"), ("resultant", "resultant")] {
            let channel = segment.map(|own| (format!("{}.acceleration.{component}", tree[own].name), words));
            plots.push(plot(&format!("{} acceleration {words}", capitalized(name)), "acceleration", channel));
        }
    }
    plots.push(plot("Contact force on head, chest and knees", "force", contacts(model, row)));
    plots.push(plot("Belt loads", "loop force", own(model, row, WEBBING)));
    let spine = marks.head.zip(marks.pelvis).map_or_else(Vec::new, |(head, pelvis)| tree.joints_between(head, pelvis));
    let angle = |name: &'static str| (format!("joint.{name}.angle"), after(row, name));
    plots.push(plot("Spine angles", "angle between the segments", spine.into_iter().map(|j| angle(tree[j].name))));
    plots.push(plot("Energy", "energy", energies(row, several)));
    if !row.name.is_empty() {
        let name = row.name.replace('_', " ");
        plots.iter_mut().for_each(|plot| plot.title = format!("{name}: {}", plot.title));
    }
    plots
}

/// A name without the prefix of its body.
fn after<'n>(row: &BodyRow, name: &'n str) -> &'n str {
    name.strip_prefix(row.name).map_or(name, |own| own.trim_start_matches('.'))
}

/// Channels of a body that match these, with the names of their curves.
fn own(model: &Model, row: &BodyRow, curves: &[(&str, &str)]) -> Vec<(String, String)> {
    let of = |(pattern, words): &(&str, &str)| -> Vec<(String, String)> {
        let found = matching(model, pattern).into_iter().filter_map(|channel| {
            let star = star(pattern, &channel.name)?;
            let is_own = row.name.is_empty() || star.split('.').next() == Some(row.name);
            is_own.then(|| (channel.name.clone(), words.replace('*', after(row, star))))
        });
        found.collect()
    };
    curves.iter().flat_map(of).collect()
}

/// Forces on head, chest and knees by their usual names; for a body without them, on its first spheres.
fn contacts(model: &Model, row: &BodyRow) -> Vec<(String, String)> {
    let all = own(model, row, CONTACTS);
    let usual = |name: &str| FRONTAL_CONTACTS.iter().position(|(_, words)| *words == name.replace('_', " "));
    let mut frontal: Vec<_> = all.iter().filter_map(|curve| Some((usual(&curve.1)?, curve.clone()))).collect();
    frontal.sort_by_key(|(place, _)| *place);
    if frontal.is_empty() {
        return all.into_iter().take(FEW_SPHERES).collect();
    }
    frontal.into_iter().map(|(_, curve)| curve).collect()
}

/// Energies of the run as a whole, or of one of several bodies.
fn energies(row: &BodyRow, several: bool) -> Vec<(String, &'static str)> {
    let (all, own) =
        if row.name.is_empty() { (ENERGIES, String::new()) } else { (ENERGIES_OF_BODY, format!(".{}", row.name)) };
    let shown = all.iter().take(if several { FEW_ENERGIES } else { all.len() });
    let channel = |channel: &str| channel.replacen("energy", &format!("energy{own}"), 1);
    shown.map(|(name, words)| (channel(name), words.trim_start_matches("stored in "))).collect()
}

/// The accelerations of every vehicle.
fn of_vehicles(model: &Model) -> Vec<Plot> {
    let all = channels(model);
    let is_it =
        |name: &str| name.strip_prefix("vehicle").and_then(|name| name.strip_suffix(".acceleration.x")).is_some();
    let vehicle = |x: &str| {
        let name = x.strip_suffix(".acceleration.x").unwrap_or(x);
        let title = match name.strip_prefix("vehicle.") {
            Some(other) => format!("Acceleration of the vehicle {other}"),
            None => "Vehicle acceleration".to_owned(),
        };
        let axes = VEHICLE.iter().map(|(channel, axis)| (channel.replacen("vehicle", name, 1), axis.to_uppercase()));
        plot(&title, "acceleration", axes)
    };
    all.iter().filter(|channel| is_it(&channel.name)).map(|channel| vehicle(&channel.name)).collect()
}

fn capitalized(word: &str) -> String {
    let (first, rest) = word.split_at(1);
    first.to_uppercase() + rest
}

fn plot<L: Into<String>>(title: &str, axis: &str, entries: impl IntoIterator<Item = (String, L)>) -> Plot {
    let entry = |(channel, label): (String, L)| Entry { channel, label: label.into().replace('_', " ") };
    Plot {
        title: title.to_owned(),
        axis: axis.to_owned(),
        entries: entries.into_iter().map(entry).collect(),
        empty: format!("{}: none in this scenario", title.to_lowercase()),
    }
}
