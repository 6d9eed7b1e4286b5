//! Definition of a measure: its name, computation and limits.

use super::readings::Readings;
use super::{Filtering, Measure, Options, Risk};
use crate::measure::risk::Severity;
use crate::measure::{Dummy, LIMITS, Peak, Quantity, ThreeMs};
use crate::signal::{ChannelClass, SignalError};
use occupant_units::unit::Unit;

/// Definition of a measure: name, formula, limits, risk curves.
pub(super) struct Definition {
    name: &'static str,
    label: &'static str,
    unit: Unit,
    figure: Option<&'static str>,
    brief: bool,
    class: ChannelClass,
    of: Make,
    /// Remark if its signal is missing; without one the measure is then left out.
    absent: Option<&'static str>,
    limited: Option<Quantity>,
    /// Quantity whose limits say what change of it matters.
    weighed: Option<Quantity>,
    risks: &'static [(&'static str, Severity)],
    curve: fn(f64, Severity, Dummy) -> Option<f64>,
}

/// A value and its window, relative to the first sample.
pub(super) struct Finding {
    pub value: f64,
    pub from_s: Option<f64>,
    pub to_s: Option<f64>,
    pub remark: Option<String>,
    /// Whether limits and risk curves of dummies apply to it.
    pub is_of_dummy: bool,
}

/// Formula of a measure.
pub(super) type Make = fn(&Readings) -> Result<Finding, Lack>;

/// Reason why a measure has no value.
#[derive(Debug)]
pub(super) enum Lack {
    /// An unusable signal.
    Unusable(SignalError),
    /// No such signal is recorded.
    Absent,
    /// The dummy of the limits has no such criterion.
    NotOfDummy,
    /// A body without such a load cell, and what there is instead.
    Without(&'static str),
    /// The head never touches the restraint.
    NoContact,
}

impl From<SignalError> for Lack {
    fn from(error: SignalError) -> Self {
        Self::Unusable(error)
    }
}

/// A measure of signals of a filter class.
pub(super) const fn measure(
    name: &'static str,
    label: &'static str,
    unit: Unit,
    class: ChannelClass,
    of: Make,
) -> Definition {
    let (figure, absent, limited, weighed, risks) = (Some(name), None, None, None, &[]);
    let curve = |_, _, _| None;
    Definition { name, label, unit, figure, brief: false, class, of, absent, limited, weighed, risks, curve }
}

impl Definition {
    /// Name in tables of many runs.
    pub(super) const fn figure(mut self, name: &'static str) -> Self {
        self.figure = Some(name);
        self
    }

    /// Lists it with this remark if its signal is missing.
    pub(super) const fn or_say(mut self, reason: &'static str) -> Self {
        self.absent = Some(reason);
        self
    }

    /// Includes it in short tables.
    pub(super) const fn brief(mut self) -> Self {
        self.brief = true;
        self
    }

    /// Compares it with the limits of a quantity.
    pub(super) const fn limited(mut self, quantity: Quantity) -> Self {
        self.limited = Some(quantity);
        self.weighed(quantity)
    }

    /// Weighs its changes by the limits of a quantity.
    pub(super) const fn weighed(mut self, quantity: Quantity) -> Self {
        self.weighed = Some(quantity);
        self
    }

    /// The least limit by which its changes are weighed, whatever the rule and the dummy; none without.
    pub(super) fn weight(&self, name: &str) -> Option<f64> {
        let quantity = self.weighed.filter(|_| self.name == name)?;
        LIMITS.iter().filter(|limit| limit.quantity == quantity).map(|limit| limit.most).min_by(f64::total_cmp)
    }

    /// Adds risk curves.
    pub(super) const fn risks(
        mut self,
        injuries: &'static [(&'static str, Severity)],
        curve: fn(f64, Severity, Dummy) -> Option<f64>,
    ) -> Self {
        self.risks = injuries;
        self.curve = curve;
        self
    }

    /// The measure of a run; none if its signal is missing and it has no remark.
    pub(super) fn of(&self, readings: &Readings) -> Option<Measure> {
        let filtered = readings.options.filtering != Filtering::None;
        let filter_class = if filtered { self.class.hertz() as u32 } else { 0 };
        let dummy = readings.options.dummy;
        let mut measure = Measure {
            name: self.name,
            label: self.label,
            figure: self.figure,
            brief: self.brief,
            unit: self.unit,
            value: None,
            from_s: None,
            to_s: None,
            filter_class,
            limits: Vec::new(),
            risks: Vec::new(),
            remark: None,
        };
        match (self.of)(readings) {
            Ok(finding) => {
                let time_s = |at_s: Option<f64>| Some(readings.start_s + at_s?);
                (measure.from_s, measure.to_s) = (time_s(finding.from_s), time_s(finding.to_s));
                (measure.value, measure.remark) = (Some(finding.value), finding.remark);
                if finding.is_of_dummy {
                    self.judge(&mut measure, finding.value, &readings.options);
                }
            }
            Err(Lack::Absent) => {
                (measure.filter_class, measure.figure, measure.brief) = (0, None, false);
                measure.remark = Some(self.absent?.to_owned());
            }
            Err(Lack::NotOfDummy) => measure.remark = Some(format!("the {} has no such criterion", dummy.name())),
            Err(Lack::Without(why)) => {
                (measure.filter_class, measure.figure, measure.brief) = (0, None, false);
                measure.remark = Some(why.to_owned());
            }
            Err(Lack::NoContact) => measure.remark = Some(NO_CONTACT.to_owned()),
            Err(Lack::Unusable(error)) => measure.remark = Some(why(&error)),
        }
        Some(measure)
    }

    fn judge(&self, measure: &mut Measure, value: f64, options: &Options) {
        if let Some(quantity) = self.limited {
            measure.judge(value, quantity, options);
        }
        let dummy = options.dummy;
        for &(injury, severity) in self.risks {
            let probability = (self.curve)(value, severity, dummy);
            measure.risks.extend(probability.map(|probability| Risk { injury, probability, agrees: true }));
        }
        measure.compare_risks();
    }
}

/// Remark of measures that start at the head's contact.
const NO_CONTACT: &str = "the head is never in contact with its restraint for 40 ms";

/// Remark of a measure whose body part is missing.
const NO_PART: &str = "the body has no such part, or a mount prescribes its motion";

impl Measure {
    /// Whether the body has this part, and its motion is computed.
    pub fn has_part(&self) -> bool {
        self.remark.as_deref() != Some(NO_PART)
    }

    /// Finds contradictory risks, where a worse injury is more likely.
    fn compare_risks(&mut self) {
        for worse in 1..self.risks.len() {
            if self.risks[worse].probability > self.risks[worse - 1].probability {
                self.risks[worse - 1..=worse].iter_mut().for_each(|risk| risk.agrees = false);
            }
        }
        let crossed: Vec<&str> = self.risks.iter().filter(|risk| !risk.agrees).map(|risk| risk.injury).collect();
        if !crossed.is_empty() {
            let found = format!("the curves of {} cross: do not quote their risks", crossed.join(", "));
            self.remark = Some(self.remark.take().map_or_else(|| found.clone(), |known| format!("{known}; {found}")));
        }
    }
}

/// Reason why there is no value; the same text for all filter classes.
fn why(error: &SignalError) -> String {
    match error {
        SignalError::CornerAboveNyquist { nyquist_hz, .. } => {
            let every_ms = (5e8 / nyquist_hz).round() / 1e6;
            format!("outputs every {every_ms} ms are too coarse for the filter: run with output.interval = \"0.1 ms\"")
        }
        // a reading that is none from the first sample on is that of a part which is not there
        SignalError::NotFinite { index: 0, found, .. } if found.is_nan() => NO_PART.to_owned(),
        error => error.to_string(),
    }
}

pub(super) fn own<T>(signal: &Result<T, SignalError>) -> Result<&T, SignalError> {
    signal.as_ref().map_err(Clone::clone)
}

/// A measure of the whole record.
pub(super) fn whole(value: f64) -> Finding {
    Finding { value, from_s: None, to_s: None, remark: None, is_of_dummy: true }
}

pub(super) fn at(peak: Peak) -> Finding {
    Finding { from_s: Some(peak.time_s), ..whole(peak.value) }
}

pub(super) fn peak(of: &Result<Peak, SignalError>) -> Result<Finding, Lack> {
    Ok(at(of.clone()?))
}

pub(super) fn level(of: &Result<ThreeMs, SignalError>) -> Result<Finding, Lack> {
    let level = of.clone()?;
    Ok(Finding { from_s: Some(level.start_s), to_s: Some(level.end_s), ..whole(level.level_mps2) })
}
