//! The fourteen plots of the card STAN.
//!
//! The report says that fourteen selected variables were plotted against time; which they were is lost with its listing. Ours:
//! accelerations of head, chest (upper torso) and pelvis (lower torso) ahead, up and resultant, as an accelerometer in the
//! segment reads them (1–9); contact forces on head, chest and knees (10); belt loads (11); spine angles (12); energies (13);
//! the vehicle's acceleration (14).

use crate::base::customary::{ACCELERATIONS, ENERGIES, FRONTAL_CONTACTS, SPINE, VEHICLE, WEBBING};
use occupant_core::model::Model;
use occupant_core::results::channel::{find, matching, star};

/// A plot that is wished for.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plot {
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

/// Energies of several runs over each other: the first of them.
const FEW_ENERGIES: usize = 4;

/// The plots, for the spheres and belts of a model; of several runs over each other, the energies that matter most.
pub(crate) fn standard(model: &Model, several: bool) -> Vec<Plot> {
    let mut plots = Vec::with_capacity(14);
    for (resultant, name) in ACCELERATIONS {
        let (vector, name) = (resultant.trim_end_matches("resultant"), capitalized(name));
        for (component, words) in [("x", "X, ahead"), ("z", "Z, up"), ("resultant", "resultant")] {
            let channel = (format!("{vector}{component}"), words);
            plots.push(plot(&format!("{name} acceleration {words}"), "acceleration", [channel]));
        }
    }
    let touched = FRONTAL_CONTACTS.iter().filter(|(channel, _)| find(model, channel).is_ok());
    plots.push(plot("Contact force on head, chest and knees", "force", touched.map(owned)));
    let belts = WEBBING.iter().flat_map(|(pattern, _)| {
        let channels = matching(model, pattern).into_iter();
        channels.filter_map(|c| Some((c.name.clone(), star(pattern, &c.name)?.to_owned())))
    });
    plots.push(plot("Belt loads", "loop force", belts));
    plots.push(plot("Spine angles", "angle between the segments", SPINE.iter().map(owned)));
    let energies = ENERGIES.iter().take(if several { FEW_ENERGIES } else { ENERGIES.len() });
    let label = |label: &'static str| label.trim_start_matches("stored in ");
    plots.push(plot("Energy", "energy", energies.map(|(channel, name)| ((*channel).to_owned(), label(name)))));
    let axes = VEHICLE.iter().map(|(channel, axis)| ((*channel).to_owned(), axis.to_uppercase()));
    plots.push(plot("Vehicle acceleration", "acceleration", axes));
    plots
}

fn owned((channel, label): &(&str, &'static str)) -> (String, &'static str) {
    ((*channel).to_owned(), label)
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
