//! Card values that a scenario has no place for, kept in its notes for the way back to cards.
//!
//! They stand as lines `NAME = value` behind [`MARKER`], the last thing in the notes. A person may change or remove
//! them; missing values are chosen and listed in the report.

use std::collections::BTreeMap;

use crate::cards::JOINTS;
use crate::deck::Deck;

/// The line before the kept values.
pub(crate) const MARKER: &str = "Card values without a place in a scenario, kept for the way back to cards:";

/// First title card, if empty, and the second one.
pub(crate) const TITLE_1: &str = "TITLE 1";
pub(crate) const TITLE_2: &str = "TITLE 2";
/// The plot option, STAN or NONE.
pub(crate) const PLOT: &str = "PLOT";
/// A pair of series 14 that the scenario cannot name: sphere and surface, with its position in the series, from 1,
/// after this name.
pub(crate) const PAIR: &str = "PASSED PAIR";

/// Values by name, in the order of their names.
pub(crate) type Kept = BTreeMap<String, String>;

/// Values that a deck's scenario must keep, without those of omitted surfaces.
pub(crate) fn kept_of(deck: &Deck) -> Kept {
    let mut kept = Kept::new();
    let mut keep = |name: &str, value: String| drop(kept.insert(name.to_owned(), value));
    if !deck.titles()[1].is_empty() {
        keep(TITLE_2, deck.titles()[1].clone());
    }
    keep(PLOT, deck.plot().word().to_owned());
    let mut fields = ["NDISK", "MREAD", "XV(14)", "ZV(14)"].map(str::to_owned).to_vec();
    fields.extend(unused_stop_dampings(deck));
    if deck.value("NPOS") == Some(0.0) && deck.value("SWP").is_some_and(|v| v <= 0.0) {
        // The place sideways does not tell the seats of left and right apart.
        fields.push("NOPTSP".to_owned());
    }
    if deck.value("NPOS") == Some(1.0) {
        fields.extend(spring_angles(deck));
        // has no effect, and is kept for the person who reads the cards
        let is_punched = |name: &String| !deck.is_unused(name) && deck.value(name).is_some_and(|slack| slack != 0.0);
        fields.extend(["SLACK(1)", "SLACK(2)"].map(str::to_owned).into_iter().filter(is_punched));
    }
    for name in fields {
        if let Some(number) = deck.number(&name) {
            keep(&name, number.digits.clone());
        }
    }
    kept
}

/// Dampings of stops that do not exist because their angles are zero.
fn unused_stop_dampings(deck: &Deck) -> impl Iterator<Item = String> {
    let is_zero = |name: &String| deck.value(name) == Some(0.0);
    let unused = JOINTS.iter().filter(move |joint| joint.stops().as_flattened().iter().all(is_zero));
    unused.map(|joint| joint.full_damping()).filter(move |damping| !is_zero(damping))
}

/// β₀ of a back joint without a spring, which the scenario cannot hold.
fn spring_angles(deck: &Deck) -> impl Iterator<Item = String> {
    let springs = JOINTS.iter().filter_map(|joint| joint.spring);
    springs.filter(|[stiffness, _]| deck.value(stiffness) == Some(0.0)).map(|[_, angle]| angle.to_owned())
}

/// The block for the notes.
pub(crate) fn to_notes(kept: &Kept) -> String {
    let lines: String = kept.iter().map(|(name, value)| format!("  {name} = {value}\n")).collect();
    format!("{MARKER}\n{lines}")
}

/// Values kept in a scenario's notes.
pub(crate) fn from_notes(notes: &str) -> Kept {
    let Some((_, block)) = notes.split_once(MARKER) else { return Kept::new() };
    let lines = block.lines().filter_map(|line| line.split_once(" = "));
    lines.map(|(name, value)| (name.trim().to_owned(), value.to_owned())).collect()
}

/// Whether a name of the notes is a field that scenarios may have to keep.
pub(crate) fn is_kept_field(name: &str) -> bool {
    let others = ["NDISK", "SWP", "DSW", "VCW", "VRW", "BETA4", "BETA7"];
    name.ends_with(')') || others.contains(&name) || JOINTS.iter().any(|joint| joint.full_damping() == name)
}
