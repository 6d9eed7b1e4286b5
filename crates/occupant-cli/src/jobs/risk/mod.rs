//! What a vehicle's motion alone says of the risk to its occupants: measures, limits, their table and JSON. Reads no file.

mod figures;
mod json;
mod subject;
mod table;

use crash_measures::measure::limits::Rule;
use occupant_study::risk::{Flight, Judgement, Preparation, ROADSIDE_RULES, VehicleRisk, VehicleSignals, judge};

pub(crate) use json::json;
pub(crate) use subject::Subject;
pub(crate) use table::text;

/// Everything that is reported.
#[derive(Debug)]
pub(crate) struct Report {
    /// What was measured, and where it came from.
    pub(crate) subject: Subject,
    /// How it was prepared.
    pub(crate) preparation: Preparation,
    /// Where the occupant starts and how far it may fly.
    pub(crate) flight: Flight,
    /// What was measured on.
    pub(crate) signals: VehicleSignals,
    pub(crate) risk: VehicleRisk,
    /// The measures against limits.
    pub(crate) judgements: Vec<Judgement>,
}

impl Report {
    /// Measures, and judges by `rules`; by all of them if none is named.
    pub(crate) fn new(
        subject: Subject,
        preparation: Preparation,
        signals: VehicleSignals,
        flight: Flight,
        rules: &[Rule],
    ) -> Self {
        let risk = VehicleRisk::of(&signals, &flight);
        let judgements = judge(&risk, if rules.is_empty() { &ROADSIDE_RULES } else { rules });
        Report { subject, preparation, flight, signals, risk, judgements }
    }
}
