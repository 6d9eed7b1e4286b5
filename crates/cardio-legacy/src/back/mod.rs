//! Scenario → deck, where the scenario fits one; otherwise a list of what does not.

mod body;
mod compartment;
mod digits;
mod extension;
mod joints;
mod motion;
mod path;
mod points;

use std::fmt;

use occupant_core::forces::contact::EdgeForce;
use occupant_core::model::setup::{Integrator, Setup};
use occupant_core::scenario::{Diagnostics as ScenarioDiagnostics, Loaded};

pub use extension::{RunEnd, spine_rest};

use crate::builder::DeckBuilder;
use crate::card::CARD_WIDTH;
use crate::compartment::CompartmentLayout;
use crate::deck::{Deck, Plot};
use crate::kept::{self, Kept};
use crate::layout::Unit;

/// A deck made from a scenario.
#[derive(Debug, Clone, PartialEq)]
pub struct FromScenario {
    /// The deck.
    pub deck: Deck,
    /// What the scenario does not say and was chosen, and numbers that ten columns cannot hold.
    pub remarks: Vec<String>,
}

/// Why a scenario has no deck.
#[derive(Debug, Clone, PartialEq)]
pub enum NoDeck {
    /// The scenario itself is refused.
    Refused(Box<ScenarioDiagnostics>),
    /// The compartment's data file cannot be used.
    Compartment(String),
    /// Features that cards have no place for, each with the key and what the cards can say instead.
    Misfits(Vec<String>),
}

impl fmt::Display for NoDeck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(diagnostics) => write!(f, "the scenario is refused:\n{diagnostics}"),
            Self::Compartment(reason) => {
                write!(f, "the compartment's data file cannot be used: {reason}")
            }
            Self::Misfits(misfits) => {
                write!(f, "the scenario does not fit on cards:")?;
                misfits.iter().try_for_each(|misfit| write!(f, "\n  - {misfit}"))
            }
        }
    }
}

impl std::error::Error for NoDeck {}

impl Deck {
    /// The deck of a scenario.
    ///
    /// # Errors
    /// A scenario that is refused, or every feature of it that cards cannot hold.
    pub fn from_scenario(scenario: &Loaded, layout: Option<&CompartmentLayout>) -> Result<FromScenario, NoDeck> {
        let (setup, _) = scenario.build().map_err(|d| NoDeck::Refused(Box::new(d)))?;
        let layout = match layout {
            Some(layout) => layout.clone(),
            None => CompartmentLayout::reconstruction().map_err(NoDeck::Compartment)?,
        };
        let notes = scenario.scenario.notes.as_deref().unwrap_or_default();
        let mut back = Back::new(&setup, kept::from_notes(notes));
        times(&mut back);
        body::read(&mut back);
        joints::read(&mut back);
        compartment::read(&mut back, &layout);
        motion::read(&mut back, &layout);
        path::read(&mut back);
        back.finish()
    }
}

/// A deck on its way back from a scenario.
struct Back<'a> {
    setup: &'a Setup,
    kept: Kept,
    builder: DeckBuilder,
    /// Passed pairs (sphere, surface), by the report's numbers.
    passed: Vec<(String, String)>,
    remarks: Vec<String>,
    misfits: Vec<String>,
}

impl<'a> Back<'a> {
    fn new(setup: &'a Setup, kept: Kept) -> Self {
        Self { setup, kept, builder: DeckBuilder::new(), passed: Vec::new(), remarks: Vec::new(), misfits: Vec::new() }
    }

    /// Sets a field from an SI number.
    fn set(&mut self, name: &str, si: f64, unit: Unit) {
        let (digits, exact) = digits::digits(si, unit);
        if let Some(exact) = exact {
            self.remarks.push(format!(
                "{name}: {exact} {} does not fit into ten columns and was rounded to {digits}",
                unit.symbol()
            ));
        }
        self.builder.set(name, &digits);
    }

    /// Sets a field that has to be the same wherever the scenario says it.
    fn agree(&mut self, name: &str, si: f64, unit: Unit, where_said: &str) {
        let (digits, _) = digits::digits(si, unit);
        match self.builder.digits(name).map(str::to_owned) {
            None => self.set(name, si, unit),
            Some(before) if before == digits || before.parse::<f64>() == digits.parse::<f64>() => {}
            Some(before) => self.misfit(format!(
                "{where_said} has {digits} where another place has {before}: on cards both are {name}"
            )),
        }
    }

    fn misfit(&mut self, text: impl Into<String>) {
        self.misfits.push(text.into());
    }

    fn misfit_if(&mut self, wrong: bool, text: &str) {
        if wrong {
            self.misfits.push(text.to_owned());
        }
    }

    fn finish(mut self) -> Result<FromScenario, NoDeck> {
        if !self.misfits.is_empty() {
            return Err(NoDeck::Misfits(self.misfits));
        }
        let titles = self.titles();
        let plot =
            if self.kept.get(kept::PLOT).map(String::as_str) == Some("STAN") { Plot::Standard } else { Plot::None };
        self.keep();
        Ok(FromScenario { deck: self.builder.build(titles, plot), remarks: self.remarks })
    }

    fn titles(&mut self) -> [String; 2] {
        let first = match self.kept.get("TITLE 1") {
            Some(title) => title.clone(),
            None => self.setup.title.clone(),
        };
        let second = self.kept.get(kept::TITLE_2).cloned().unwrap_or_default();
        let one_line = first.lines().next().unwrap_or_default();
        if one_line.chars().count() > CARD_WIDTH {
            self.remarks.push(format!("the title is cut to {CARD_WIDTH} columns"));
        }
        [one_line, &second]
            .map(|title| title.chars().take(CARD_WIDTH).collect::<String>().trim_end_matches(' ').to_owned())
    }

    /// Fields that the scenario could not say and its notes kept.
    fn keep(&mut self) {
        let kept: Vec<(String, String)> = self.kept.iter().map(|(n, v)| (n.clone(), v.clone())).collect();
        let mut pairs = std::mem::take(&mut self.passed);
        for (name, value) in kept {
            if let Some(place) = name.strip_prefix(kept::PAIR) {
                // back to its place in the series
                let place = place.trim().parse().unwrap_or(usize::MAX);
                if let Some((j, k)) = value.split_once(' ') {
                    let at = place.saturating_sub(1).min(pairs.len());
                    pairs.insert(at, (j.to_owned(), k.to_owned()));
                }
            } else if kept::is_kept_field(&name) && !self.builder.has(&name) {
                self.builder.set(&name, &value);
            }
        }
        if !pairs.is_empty() {
            extension::set_pairs(&mut self.builder, &pairs);
        }
        for (name, value, why) in
            [("NDISK", "1", "no plot data on disk"), ("XV(14)", "0", "point 14 bounds no surface"), ("ZV(14)", "", "")]
        {
            if !self.builder.has(name) {
                let floor = self.builder.digits("ZV(8)").unwrap_or("0").to_owned();
                self.builder.set(name, if value.is_empty() { &floor } else { value });
                if !why.is_empty() {
                    self.remarks.push(format!("{name} = {value}: {why}"));
                }
            }
        }
    }
}

/// Times, integrator, output, gravity (cards 3 and 11e).
fn times(back: &mut Back<'_>) {
    let setup = back.setup;
    back.set("T1", setup.time.start_s, Unit::Second);
    back.set("TF", setup.time.end_s, Unit::Second);
    back.set("DTPRNT", setup.time.output_s, Unit::Second);
    back.set("GR", setup.gravity_m_s2, Unit::InchPerSecondSquared);
    match setup.integrator {
        Integrator::Rk4 { step_s } => back.set("DT", step_s, Unit::Second),
        Integrator::Adaptive { .. } => {
            back.misfit("integrator.kind = \"adaptive\": cards know the fixed step of rk4 only")
        }
    }
    back.misfit_if(
        setup.edge_force != EdgeForce::default(),
        "the edge force at the sphere's centre: cards cannot choose it",
    );
}
