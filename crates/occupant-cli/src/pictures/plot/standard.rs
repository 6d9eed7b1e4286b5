//! The fourteen plots of the card STAN.
//!
//! The report says that fourteen selected variables were plotted against time; which they were is lost with its listing. Ours:
//! accelerations of head, chest (upper torso) and pelvis (lower torso) ahead, up and resultant, as an accelerometer in the
//! segment reads them (1–9); contact forces on head, chest and knees (10); belt loads (11); spine angles (12); energies (13);
//! the vehicle's acceleration (14).

use occupant_core::model::Model;
use occupant_core::results::channel::matching;

/// A plot that is wished for.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wish {
    /// Heading.
    pub(crate) title: String,
    /// What Y measures.
    pub(crate) axis: String,
    /// What is drawn.
    pub(crate) entries: Vec<Entry>,
    /// What stands there if a scenario has none of it.
    pub(crate) empty: String,
}

/// A channel with its name in the legend.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) channel: String,
    pub(crate) label: String,
}

const ACCELERATIONS: [(&str, &str); 3] = [("head", "Head"), ("upper_torso", "Chest"), ("lower_torso", "Pelvis")];

/// Energies, the first of them for several runs.
const ENERGIES: [(&str, &str); 8] = [
    ("kinetic_relative", "kinetic, in the vehicle"),
    ("contacts", "contacts"),
    ("belts", "belts"),
    ("lost_contacts", "lost in contacts"),
    ("lost_friction", "lost in friction"),
    ("lost_joints", "lost in joints"),
    ("lost_belts", "lost in belts"),
    ("spine", "spine springs"),
];
const FEW_ENERGIES: usize = 4;

/// The plots, for the spheres and belts of a model; of several runs over each other, the energies that matter most.
pub(crate) fn standard(model: &Model, several: bool) -> Vec<Wish> {
    let mut wishes = Vec::with_capacity(14);
    for (segment, name) in ACCELERATIONS {
        for (component, words) in [("x", "X, ahead"), ("z", "Z, up"), ("resultant", "resultant")] {
            let channel = format!("{segment}.acceleration.{component}");
            wishes.push(wish(&format!("{name} acceleration {words}"), "acceleration", [(channel, words)]));
        }
    }
    let spheres = ["head", "chest", "right_knee", "left_knee"];
    let force = |s: &'static str| {
        let sphere = model.body().sphere(s);
        sphere.map(|_| (format!("sphere.{s}.force.resultant"), s))
    };
    wishes.push(wish("Contact force on head, chest and knees", "force", spheres.into_iter().filter_map(force)));
    let belts: Vec<(String, String)> = matching(model, "belt.*.force")
        .into_iter()
        .map(|c| (c.name.clone(), c.name["belt.".len()..c.name.len() - ".force".len()].to_owned()))
        .collect();
    wishes.push(wish("Belt loads", "loop force", belts));
    let joints = ["neck", "upper_back", "lower_back"];
    let angle = |j: &str| (format!("joint.{j}.angle"), j.to_owned());
    wishes.push(wish("Spine angles", "angle between the segments", joints.map(angle)));
    let shown = match several {
        true => &ENERGIES[..FEW_ENERGIES],
        false => &ENERGIES[..],
    };
    let energy = |(channel, label): &(&str, &'static str)| (format!("energy.{channel}"), *label);
    wishes.push(wish("Energy", "energy", shown.iter().map(energy)));
    let axes = ["x", "y", "z"].map(|axis| (format!("vehicle.acceleration.{axis}"), axis.to_uppercase()));
    wishes.push(wish("Vehicle acceleration", "acceleration", axes));
    wishes
}

fn wish<L: Into<String>>(title: &str, axis: &str, entries: impl IntoIterator<Item = (String, L)>) -> Wish {
    let entry = |(channel, label): (String, L)| Entry { channel, label: label.into().replace('_', " ") };
    Wish {
        title: title.to_owned(),
        axis: axis.to_owned(),
        entries: entries.into_iter().map(entry).collect(),
        empty: format!("{}: none in this scenario", title.to_lowercase()),
    }
}
