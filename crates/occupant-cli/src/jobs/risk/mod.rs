//! What a vehicle's motion alone says of the risk to its occupants: measures, limits, their table and JSON. Reads no file.

mod columns;
mod figures;
mod intervals;
mod json;
mod page;
mod plots;
mod subject;
mod table;

use crash_measures::measure::limits::Rule;
use occupant_study::risk::{
    Flight, Judgement, Preparation, ROADSIDE_RULES, SensorErrors, VehicleRisk, VehicleSignals, judge,
};

pub(crate) use columns::columns;
pub(crate) use figures::{Figure, Figures};
pub(crate) use intervals::Intervals;
pub(crate) use json::json;
pub(crate) use page::page;
pub(crate) use subject::{PATH_INTERVAL_S, Subject};
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
    /// What the errors of the sensors make of the measures, if they were told.
    pub(crate) intervals: Option<Intervals>,
    /// What to know of the record.
    pub(crate) notes: Vec<String>,
}

/// An index that still has so much of its maximum at the end of the record may go beyond it.
const LEFT_AT_END: f64 = 0.2;

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
        let left = risk.asi_left_at_end.filter(|left| *left > LEFT_AT_END).map(|left| {
            format!(
                "the record ends at {} s while the vehicle is still accelerated: ASI (2010) has {:.0} % of its maximum there, beyond its end the mean of the last \
                 50 ms was taken to go on, and what a longer record would give is not known",
                placed_text::number(signals.end_s()),
                100.0 * left
            )
        });
        let notes = left.into_iter().collect();
        Report { subject, preparation, flight, signals, risk, judgements, intervals: None, notes }
    }

    /// With what errors of the sensors make of the measures.
    pub(crate) fn with_errors(mut self, errors: SensorErrors) -> Self {
        if !errors.is_none() {
            self.intervals = Some(Intervals::of(&self.signals, &self.flight, errors));
        }
        self
    }
}
