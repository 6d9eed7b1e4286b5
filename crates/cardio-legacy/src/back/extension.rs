//! The cards that extend a run that has ended: series 6 and 14, as the original procedure has it.

use std::collections::BTreeSet;

use occupant_core::body::tti12::{LOWER_BACK, UPPER_BACK};
use occupant_core::forces::belt::Belt;
use occupant_core::forces::contact::PASSED;
use occupant_core::motion::report_coordinates::ReportCoordinates;
use occupant_core::results::sample::Sample;

use super::digits::{digits, factor};
use super::joints::ball_of;
use super::unit_of;
use crate::cards::BELTS;
use crate::compartment::CompartmentLayout;
use crate::deck::{Deck, DeckCard};

/// Where a run ended, as far as cards can say it. They carry no greatest deformation, so an extension by cards is approximate.
#[derive(Debug, Clone, PartialEq)]
pub struct RunEnd {
    /// Time, s.
    pub time_s: f64,
    /// The report's coordinates and their rates, SI.
    pub coordinates: ReportCoordinates,
    /// β₀ of the upper and the lower back joint, rad: the angles at which the spine's springs rest.
    pub spine_rest_rad: [f64; 2],
    /// L₀ of the lap and of the torso belt, m, where there is one.
    pub belt_lengths_m: [Option<f64>; 2],
    /// Pairs (sphere, surface) that have passed the surface's edge, by the report's numbers.
    pub passed: Vec<(u32, u32)>,
}

impl RunEnd {
    /// The end of a run from its last sample and β₀ of the two back joints, [`spine_rest`] of the first sample.
    pub fn after(spine_rest_rad: [f64; 2], last: &Sample<'_>, layout: &CompartmentLayout) -> Self {
        let model = last.model;
        let loops_round =
            |belt: &Belt, sphere: &str| model.body().spheres.get(belt.sphere).is_some_and(|s| s.name == sphere);
        let length = |sphere: &str| {
            let at = model.setup().belts.iter().position(|belt| loops_round(belt, sphere))?;
            Some(model.system().forces.belts.get(at)?.rest_length)
        };
        Self {
            time_s: last.time_s,
            coordinates: last.report_coordinates(),
            spine_rest_rad,
            belt_lengths_m: BELTS.map(|(_, _, sphere)| length(sphere)),
            passed: passed(last, layout),
        }
    }
}

/// β₀ of the upper and the lower back joint: the scenario's, or the angles at the start.
pub fn spine_rest(first: &Sample<'_>) -> [f64; 2] {
    let joints = &first.model.setup().joints;
    [UPPER_BACK, LOWER_BACK].map(|joint| {
        ball_of(joints, joint).spring.and_then(|s| s.rest_rad).unwrap_or_else(|| first.joint_angle_rad(joint))
    })
}

fn passed(sample: &Sample<'_>, layout: &CompartmentLayout) -> Vec<(u32, u32)> {
    let contacts = &sample.model.system().forces.contacts;
    let surfaces = &sample.model.setup().surfaces;
    let mut pairs = BTreeSet::new();
    for group in contacts.groups() {
        for at in group.pairs.clone() {
            let is_passed = sample.history.memory.contacts.get(at).is_some_and(|p| p.phase == PASSED);
            let parts = contacts.pairs().get(at).map(|p| p.parts.as_slice()).unwrap_or_default();
            for part in parts.iter().filter(|_| is_passed) {
                let number = surfaces.get(part.surface).and_then(|s| layout.number_of(&s.name));
                pairs.extend(number.and_then(|surface| Some((u32::try_from(group.sphere + 1).ok()?, surface))));
            }
        }
    }
    pairs.into_iter().collect()
}

impl Deck {
    /// The deck that extends this one's run from where it ended to `final_s`: NPOS = 1, series 6 and 14 in place of seating.
    pub fn extended(&self, end: &RunEnd, final_s: f64) -> Deck {
        let cards = self.cards().iter().filter(|card| ![4, 10].contains(&card.id.series));
        let cards = cards.map(|card| DeckCard { line: None, raw: None, ..card.clone() });
        let mut deck = Deck::assemble(self.titles().clone(), cards.collect(), self.plot());
        if !deck.has_series(6) {
            deck.add_series(6, 0);
        }
        for (name, time_s) in [("T1", end.time_s), ("TF", final_s)] {
            deck.set(name, &digits(time_s, unit_of(name)).0);
        }
        deck.set("NPOS", "1");
        let springs = ["BETA4", "BETA7"].map(str::to_owned).into_iter().zip(end.spine_rest_rad);
        let lengths = ["BLTLEO(1)", "BLTLEO(2)"].map(str::to_owned).into_iter().zip(end.belt_lengths_m);
        let lengths = lengths.filter_map(|(name, length_m)| Some((name, length_m?)));
        for (name, si) in springs.chain(lengths).chain(coordinate_fields(&end.coordinates)) {
            deck.set(&name, &rounded(&name, si));
        }
        deck.set("SLACK(1)", "");
        deck.set("SLACK(2)", "");
        let pairs: Vec<_> = end.passed.iter().map(|(j, k)| (j.to_string(), k.to_string())).collect();
        deck.set_pairs(&pairs);
        deck
    }
}

/// The fields of the coordinates and of their rates.
pub(super) fn coordinate_fields(coordinates: &ReportCoordinates) -> impl Iterator<Item = (String, f64)> {
    let pairs = (1..).zip(coordinates.q.into_iter().zip(coordinates.rates));
    pairs.flat_map(|(n, (q, rate))| [(format!("Q0({n})"), q), (format!("QDO({n})"), rate)])
}

/// A number of a state as cards show it: six decimals, fewer where they would not leave a blank before the next field.
fn rounded(name: &str, si: f64) -> String {
    let value = si / factor(unit_of(name));
    let texts = (0..=DECIMALS).rev().map(|decimals| format!("{value:.decimals$}"));
    let fitting = texts.into_iter().find(|text| text.len() <= STATE_WIDTH).unwrap_or_else(|| format!("{value:e}"));
    if !fitting.contains('.') {
        return fitting;
    }
    fitting.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Decimals of a state on cards.
const DECIMALS: usize = 6;
/// Columns of a number of a state; the tenth stays blank.
const STATE_WIDTH: usize = 9;
