//! Card values that a scenario has no place for, kept in its notes for the way back to cards.
//!
//! They stand as lines `NAME = value` behind [`MARKER`], the last thing in the notes. A person may change or remove them;
//! what is not there is chosen, and said in the report.

use std::collections::BTreeMap;

use crate::deck::{Deck, Plot};

/// The line before the kept values.
pub(crate) const MARKER: &str = "Card values without a place in a scenario, kept for the way back to cards:";

/// The second title card.
pub(crate) const TITLE_2: &str = "TITLE 2";
/// The plot option, STAN or NONE.
pub(crate) const PLOT: &str = "PLOT";
/// A pair of series 14 that the scenario cannot name: sphere and surface; its place in the series, from 1, is behind this name.
pub(crate) const PAIR: &str = "PASSED PAIR";

/// Damping in a joint's stops, and the angles between which it grows.
const STOPS: [(&str, &[&str]); 7] = [
    ("XJSN", &["AGNN", "AGSN"]),
    ("XJSS", &["AGNS", "AGSS"]),
    ("XJSUB", &["AGNUB", "AGSUB"]),
    ("XJSLB", &["AGNLB", "AGSLB"]),
    ("XJSH", &["AGNH", "AGSH"]),
    ("XJSE", &["AGNE(1)", "AGSE(1)", "AGNE(2)", "AGSE(2)"]),
    ("XJSK", &["AGNK(1)", "AGSK(1)", "AGNK(2)", "AGSK(2)"]),
];

/// Values by name, in the order of their names.
pub(crate) type Kept = BTreeMap<String, String>;

/// What a deck's scenario has to keep, surfaces left out of it excepted.
pub(crate) fn kept_of(deck: &Deck) -> Kept {
    let mut kept = Kept::new();
    let mut keep = |name: &str, value: String| drop(kept.insert(name.to_owned(), value));
    if !deck.titles()[1].is_empty() {
        keep(TITLE_2, deck.titles()[1].clone());
    }
    keep(PLOT, if deck.plot() == Plot::Standard { "STAN" } else { "NONE" }.to_owned());
    let mut fields = vec!["NDISK", "MREAD", "XV(14)", "ZV(14)"];
    fields.extend(unused_stop_dampings(deck));
    if deck.value("NPOS") == Some(0.0) && deck.value("SWP").is_some_and(|v| v <= 0.0) {
        // The place sideways does not tell the seats of left and right apart.
        fields.push("NOPTSP");
    }
    if deck.value("NPOS") == Some(1.0) {
        fields.extend(spring_angles(deck));
    }
    for name in fields {
        if let Some(number) = deck.number(name) {
            keep(name, number.digits.clone());
        }
    }
    kept
}

/// Dampings of stops that are none because their angles are zero.
fn unused_stop_dampings(deck: &Deck) -> impl Iterator<Item = &'static str> {
    let is_zero = |name: &&str| deck.value(name) == Some(0.0);
    STOPS
        .into_iter()
        .filter(move |(damping, angles)| !is_zero(damping) && angles.iter().all(&is_zero))
        .map(|(damping, _)| damping)
}

/// β₀ of a back joint without a spring, which has no place beside it.
fn spring_angles(deck: &Deck) -> impl Iterator<Item = &'static str> {
    [("SPJNT4", "BETA4"), ("SPJNT7", "BETA7")]
        .into_iter()
        .filter(|(spring, _)| deck.value(spring) == Some(0.0))
        .map(|(_, angle)| angle)
}

/// The block for the notes.
pub(crate) fn to_notes(kept: &Kept) -> String {
    let lines: String = kept.iter().map(|(name, value)| format!("  {name} = {value}\n")).collect();
    format!("{MARKER}\n{lines}")
}

/// The kept values of a scenario's notes; empty if there are none.
pub(crate) fn from_notes(notes: &str) -> Kept {
    let Some((_, block)) = notes.split_once(MARKER) else {
        return Kept::new();
    };
    let lines = block.lines().filter_map(|line| line.split_once(" = "));
    lines.map(|(name, value)| (name.trim().to_owned(), value.to_owned())).collect()
}

/// Whether a name of the notes is a field that scenarios may have to keep.
pub(crate) fn is_kept_field(name: &str) -> bool {
    let others = ["NDISK", "SWP", "DSW", "VCW", "VRW", "BETA4", "BETA7"];
    name.ends_with(')') || others.contains(&name) || STOPS.iter().any(|(n, _)| *n == name)
}
