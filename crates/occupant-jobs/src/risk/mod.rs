//! Occupant risk from a vehicle's motion alone: measures, limits, their table and JSON. Reads no file.

mod columns;
mod figures;
mod intervals;
mod json;
mod page;
mod plots;
mod subject;
mod table;

use crash_measures::measure::limits::{Grade, Quantity, Rule};
use crash_measures::signal::{CfcFamily, ChannelClass};
use occupant_core::model::setup::Setup;
use occupant_scenario::kind::UnitSystem;
use occupant_study::risk::{
    Attained, Flight, Judgement, Preparation, ROADSIDE_RULES, SensorErrors, VehicleRisk, VehicleSignals, attained,
    judge, prepare,
};

pub use columns::columns;
pub use figures::{Figure, Figures};
pub use intervals::Intervals;
pub use json::json;
pub use page::{OWN_STYLE, begun, ended, page, sections};
pub use subject::{PATH_INTERVAL_S, Subject, vehicles};
pub use table::text;
use table::{shown, unit_of};

/// Content of a report.
#[derive(Debug)]
pub struct Report {
    /// The motion and its source.
    pub subject: Subject,
    /// Preparation of the record.
    pub preparation: Preparation,
    /// Flail distances and initial head position.
    pub flight: Flight,
    /// Prepared signals.
    pub signals: VehicleSignals,
    /// The measures.
    pub risk: VehicleRisk,
    /// Comparison with limits.
    pub judgements: Vec<Judgement>,
    /// Intervals due to sensor errors, if given.
    pub intervals: Option<Intervals>,
    /// Notes on the record.
    pub notes: Vec<String>,
}

/// An index still above this fraction of its maximum at the record's end may rise further.
const LEFT_AT_END: f64 = 0.2;

impl Report {
    /// Computes the measures and compares them with `rules`, or with all rules if none is given.
    pub fn new(
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
                "the record ends at {} s while the vehicle still accelerates: ASI (2010) is there {:.0} % of its maximum. The mean of the last 50 ms is assumed to continue; a longer record may give other values",
                placed_text::number(signals.end_s()),
                100.0 * left
            )
        });
        let notes = left.into_iter().collect();
        Report { subject, preparation, flight, signals, risk, judgements, intervals: None, notes }
    }

    /// Report on a vehicle of a run by name, with the defaults of `occupant risk`; none if its path cannot be sampled.
    pub fn of_run(name: &str, setup: &Setup, vehicle: Option<&str>) -> Option<Self> {
        Report::of_path(Subject::of_run(name, setup, vehicle, PATH_INTERVAL_S).ok()??)
    }

    /// Report on a sampled path, with the defaults of `occupant risk`; none if it cannot be prepared.
    pub fn of_path(subject: Subject) -> Option<Self> {
        let filter = ChannelClass::from_number(180).map(|class| (class, CfcFamily::Iso6487));
        let preparation = Preparation { filter, ..Preparation::default() };
        let signals = prepare(&subject.record, &preparation).ok()?;
        let signals = VehicleSignals { initial: subject.initial, ..signals };
        Some(Report::new(subject, preparation, signals, Flight::default(), &[]))
    }

    /// Names of the broken rules, each once.
    pub fn broken(&self) -> Vec<&'static str> {
        let mut rules: Vec<_> =
            self.judgements.iter().filter(|j| j.breaks_the_rule()).map(|j| j.limit.rule.name()).collect();
        rules.dedup();
        rules
    }

    /// Class or level for each rule that has any: rule, class, reason.
    pub fn classes(&self, units: Option<UnitSystem>) -> Vec<(&'static str, Option<&'static str>, String)> {
        let mut rules: Vec<Rule> = self.judgements.iter().map(|judgement| judgement.limit.rule).collect();
        rules.dedup();
        let of = |rule: Rule| {
            let bounds = |keep: &dyn Fn(&Judgement) -> bool| {
                let own = self.judgements.iter().filter(|j| j.limit.rule == rule && keep(j));
                let words = own.filter_map(|j| {
                    let unit = unit_of(j.limit.quantity, units);
                    let symbol =
                        if j.limit.quantity == Quantity::Asi { String::new() } else { format!(" {}", unit.0.symbol()) };
                    Some(format!("{} {} of {}{symbol}", j.measure, shown(j.value?, unit), shown(j.limit.most, unit)))
                });
                words.collect::<Vec<_>>().join(", ")
            };
            Some(match attained(rule, &self.judgements)? {
                Attained::Grade(grade) => {
                    (rule.name(), Some(grade.name()), bounds(&|j| [grade, Grade::Maximum].contains(&j.limit.grade)))
                }
                Attained::Beyond(limit) => (rule.name(), None, format!("beyond {}", bounds(&|j| j.limit == limit))),
                Attained::NotMeasured(measure) => (rule.name(), None, format!("unknown: {measure} was not measured")),
            })
        };
        rules.into_iter().filter_map(of).collect()
    }

    /// Adds intervals due to sensor errors.
    pub fn with_errors(mut self, errors: SensorErrors) -> Self {
        if !errors.is_none() {
            self.intervals = Some(Intervals::of(&self.signals, &self.flight, errors));
        }
        self
    }
}
