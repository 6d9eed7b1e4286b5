//! `occupant risk`: what a vehicle's motion alone says of the risk to its occupants.

mod figures;
mod json;
mod subject;
mod table;

use occupant_core::measure::limits::Rule;
use occupant_core::vehicle_risk::{Flight, Judgement, Preparation, ROADSIDE_RULES, VehicleRisk, VehicleSignals, judge};

pub use json::json;
pub use subject::Subject;
pub use table::text;

/// Everything that is reported.
#[derive(Debug)]
pub struct Report {
    /// What was measured, and where it came from.
    pub subject: Subject,
    /// How it was prepared.
    pub preparation: Preparation,
    /// Where the occupant starts and how far it may fly.
    pub flight: Flight,
    /// What was measured on.
    pub signals: VehicleSignals,
    /// The measures.
    pub risk: VehicleRisk,
    /// The measures against limits.
    pub judgements: Vec<Judgement>,
}

impl Report {
    /// Measures, and judges by `rules`; by all of them if none is named.
    pub fn new(
        subject: Subject,
        preparation: Preparation,
        signals: VehicleSignals,
        flight: Flight,
        rules: &[Rule],
    ) -> Self {
        let risk = VehicleRisk::of(&signals, &flight);
        let judgements = match rules {
            [] => judge(&risk, &ROADSIDE_RULES),
            rules => judge(&risk, rules),
        };
        Report { subject, preparation, flight, signals, risk, judgements }
    }
}
