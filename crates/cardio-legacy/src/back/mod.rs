//! Scenario → deck, where the scenario fits one; otherwise a list of what does not. Nothing is left out in silence.

mod body;
mod compartment;
mod digits;
mod extension;
mod joints;
mod motion;
mod path;
mod points;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Display;

use occupant_core::body::tti12::TTI12;
use occupant_core::forces::contact::EdgeForce;
use occupant_core::model::seating::InitialPosture;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_scenario::{Diagnostics as ScenarioDiagnostics, Loaded, Scenario};
use thiserror::Error;

pub use motion::{RunEnd, passed_pairs, spine_rest};

use crate::cards::{Unit, field_named};
use crate::compartment::CompartmentLayout;
use crate::deck::{Deck, Plot};
use crate::notes::{self, Kept};
use crate::punched::{CARD_WIDTH, is_control};

/// A deck made from a scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct FromScenario {
    /// The deck.
    pub deck: Deck,
    /// Values chosen where the scenario gives none, and numbers that ten columns cannot hold.
    pub remarks: Vec<String>,
}

/// Reason why a scenario cannot be converted to a deck.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoDeck {
    /// The scenario itself is invalid.
    #[error("the scenario is refused:\n{0}")]
    Refused(Box<ScenarioDiagnostics>),
    /// The compartment's data file cannot be used.
    #[error("the compartment's data file cannot be used: {0}")]
    Compartment(String),
    /// Features without fields on cards, each with its key and the alternative on cards.
    #[error("the scenario does not fit on cards:{}", .0.iter().map(|misfit| format!("\n  - {misfit}")).collect::<String>())]
    Misfits(Vec<String>),
}

impl Deck {
    /// Deck of a scenario.
    ///
    /// # Errors
    /// A scenario that is refused, or every feature of it that cards cannot hold.
    pub fn from_scenario(scenario: &Loaded, layout: Option<&CompartmentLayout>) -> Result<FromScenario, NoDeck> {
        let (setup, _) = scenario.build().map_err(|d| NoDeck::Refused(Box::new(d)))?;
        if *setup.body.tree != TTI12 {
            let count = setup.body.segments.len();
            return Err(NoDeck::Misfits(vec![format!("body: {count} segments; cards have the report's 12")]));
        }
        let layout = CompartmentLayout::or_reconstruction(layout).map_err(NoDeck::Compartment)?;
        let kept = notes::from_notes(scenario.scenario.notes.as_deref().unwrap_or_default());
        let mut back = Back::new(&setup, kept);
        left_behind(&mut back, &scenario.scenario);
        times(&mut back);
        body::read(&mut back);
        joints::read(&mut back);
        compartment::read(&mut back, &layout);
        motion::read(&mut back, &layout);
        path::read(&mut back);
        back.finish()
    }
}

/// A deck during conversion from a scenario.
struct Back<'a> {
    setup: &'a Setup,
    kept: Kept,
    deck: Deck,
    /// Passed pairs (sphere, surface), by the report's numbers.
    passed: Vec<(String, String)>,
    /// Numbers that ten columns cannot hold, by variable: the first of them as rounded, and all their names.
    rounded: BTreeMap<String, (String, BTreeSet<String>)>,
    remarks: Vec<String>,
    misfits: Vec<String>,
}

impl<'a> Back<'a> {
    fn new(setup: &'a Setup, kept: Kept) -> Self {
        let mut deck = Deck::assemble(Default::default(), Vec::new(), Plot::None);
        let is_seated = matches!(setup.posture, InitialPosture::Seated(_));
        let of_start: &[u8] = if is_seated { &[4, 10] } else { &[6] };
        for series in [3, 5, 7, 8, 9, 11].iter().chain(of_start) {
            deck.add_series(*series, 0);
        }
        let (passed, rounded) = (Vec::new(), BTreeMap::new());
        Self { setup, kept, deck, passed, rounded, remarks: Vec::new(), misfits: Vec::new() }
    }

    /// Sets a field from an SI number.
    fn set(&mut self, name: impl Into<String>, si: f64) {
        let name = name.into();
        let digits = self.fitting(&name, unit_of(&name), si);
        self.deck.set(&name, &digits);
    }

    /// Digits of an SI number in the unit of a field; rounding is noted by variable.
    fn fitting(&mut self, name: &str, unit: Unit, si: f64) -> String {
        let (digits, exact) = digits::digits(si, unit);
        if let Some(exact) = exact {
            let base = name.split_once('(').map_or(name, |(base, _)| base);
            let symbol = unit.symbol;
            let first = format!("{name}: {exact} {symbol} does not fit into ten columns and was rounded to {digits}");
            self.rounded.entry(base.to_owned()).or_insert((first, BTreeSet::new())).1.insert(exact);
        }
        digits
    }

    /// The digits of a field, if it has been set.
    fn digits(&self, name: &str) -> Option<&str> {
        self.deck.number(name).filter(|number| !number.blank).map(|number| number.digits.as_str())
    }

    /// Sets fields from SI numbers.
    fn set_all<const N: usize>(&mut self, numbers: [(&str, f64); N]) {
        numbers.into_iter().for_each(|(name, si)| self.set(name, si));
    }

    /// Sets the fields of a numbered segment, surface, belt or station from SI numbers.
    fn set_numbered<const N: usize>(&mut self, number: impl Display + Copy, numbers: [(&str, f64); N]) {
        numbers.into_iter().for_each(|(name, si)| self.set(format!("{name}({number})"), si));
    }

    /// Sets a field that must have one value throughout the scenario.
    fn agree(&mut self, name: &str, si: f64, where_said: &str) {
        let (digits, _) = digits::digits(si, unit_of(name));
        match self.digits(name).map(str::to_owned) {
            None => self.set(name, si),
            Some(before) if before == digits || before.parse::<f64>() == digits.parse::<f64>() => {}
            Some(before) => self.misfit(format!(
                "{where_said} has {digits} where another place has {before}: on cards both are {name}"
            )),
        }
    }

    /// Reports a feature without fields on cards, once.
    fn misfit(&mut self, text: impl Into<String>) {
        let text = text.into();
        if !self.misfits.contains(&text) {
            self.misfits.push(text);
        }
    }

    fn misfit_if(&mut self, wrong: bool, text: impl Into<String>) {
        if wrong {
            self.misfit(text);
        }
    }

    fn finish(mut self) -> Result<FromScenario, NoDeck> {
        if !self.misfits.is_empty() {
            return Err(NoDeck::Misfits(self.misfits));
        }
        for (base, (first, all)) in &self.rounded {
            let more = match all.len() - 1 {
                0 => String::new(),
                more => format!(", and so were {more} more numbers of {base}"),
            };
            self.remarks.push(format!("{first}{more}"));
        }
        let titles = self.titles();
        let plot = self.kept.get(notes::PLOT).and_then(|word| Plot::of_word(word)).unwrap_or(Plot::None);
        self.keep();
        let cards = self.deck.cards().to_vec();
        Ok(FromScenario { deck: Deck::assemble(titles, cards, plot), remarks: self.remarks })
    }

    fn titles(&mut self) -> [String; 2] {
        let first = self.kept.get(notes::TITLE_1).unwrap_or(&self.setup.title).as_str();
        let titles = [first, self.kept.get(notes::TITLE_2).map_or("", String::as_str)];
        let mut strange: Vec<char> =
            titles.iter().flat_map(|title| title.chars()).filter(|c| !is_punchable(*c)).collect();
        strange.sort_unstable();
        strange.dedup();
        if !strange.is_empty() {
            let shown: Vec<_> = strange.iter().map(|c| c.escape_debug().to_string()).collect();
            self.remarks.push(format!("the title's `{}` cannot be punched and became ?", shown.join("`, `")));
        }
        if titles.iter().any(|title| title.chars().count() > CARD_WIDTH) {
            self.remarks.push(format!("the title is cut to {CARD_WIDTH} columns"));
        }
        let punchable = |c: char| if is_punchable(c) { c } else { '?' };
        titles.map(|t| t.chars().take(CARD_WIDTH).map(punchable).collect::<String>().trim_end_matches(' ').to_owned())
    }

    /// Restores fields that the scenario could not hold and its notes kept.
    fn keep(&mut self) {
        let mut pairs = std::mem::take(&mut self.passed);
        for (name, value) in &self.kept {
            if let Some(place) = name.strip_prefix(notes::PAIR) {
                // back to its position in the series
                let place = place.trim().parse().unwrap_or(usize::MAX);
                if let Some((sphere, surface)) = value.split_once(' ') {
                    let at = place.saturating_sub(1).min(pairs.len());
                    pairs.insert(at, (sphere.to_owned(), surface.to_owned()));
                }
            } else if notes::is_kept_field(name) && self.digits(name).is_none() {
                self.deck.set(name, value);
            }
        }
        self.deck.set_pairs(&pairs);
        for (name, value, why) in
            [("NDISK", "1", "no plot data on disk"), ("XV(14)", "0", "point 14 bounds no surface")]
        {
            if self.digits(name).is_none() {
                self.deck.set(name, value);
                self.remarks.push(format!("{name} = {value}: {why}"));
            }
        }
        if self.digits("ZV(14)").is_none() {
            let floor = self.digits("ZV(8)").unwrap_or("0").to_owned();
            self.deck.set("ZV(14)", &floor);
        }
    }
}

/// Whether a character is a printable one of Latin-1.
fn is_punchable(c: char) -> bool {
    u8::try_from(u32::from(c)).is_ok_and(|byte| !is_control(byte))
}

/// Lists descriptive texts of a scenario that cards cannot hold.
fn left_behind(back: &mut Back<'_>, scenario: &Scenario) {
    let notes = scenario.notes.as_deref().unwrap_or_default();
    let own = notes.split_once(notes::MARKER).map_or(notes, |(own, _)| own);
    if !own.trim().is_empty() {
        back.remarks.push("notes: cards can hold only two titles".to_owned());
    }
    back.misfit_if(scenario.title.starts_with("FINI"), "title: a first card that begins with FINI ends the file");
    if !scenario.provenance.is_empty() {
        let count = scenario.provenance.len();
        back.remarks.push(format!("provenance: cards have no place for its {count} sources"));
    }
}

/// The unit of a field.
fn unit_of(name: &str) -> Unit {
    field_named(name).map_or(Unit::ONE, |field| field.unit)
}

/// Times, integrator, output, gravity (cards 3 and 11e).
fn times(back: &mut Back<'_>) {
    let setup = back.setup;
    back.set_all([
        ("T1", setup.time.start_s),
        ("TF", setup.time.end_s),
        ("DTPRNT", setup.time.output_s),
        ("GR", setup.gravity_m_s2),
    ]);
    match setup.integrator {
        Integrator::Rk4 { step_s } => back.set("DT", step_s),
        Integrator::Adaptive { .. } => {
            back.misfit("integrator.kind = \"adaptive\": cards know the fixed step of rk4 only")
        }
    }
    back.misfit_if(
        setup.edge_force != EdgeForce::AtContactPoint && !setup.surfaces.is_empty(),
        "contact.edge_force = \"centre\", the default: cards have only \"contact_point\"",
    );
}
