//! Injury measures of a run: what a dummy's instruments would report, against limits and risk curves.
//!
//! [`Signals`] are the channels of the head, neck, chest, pelvis and femurs; [`Readings`] filters them; [`assess`] makes
//! [`Measure`]s of them with the formulas of [`crate::measure`]. A simulated signal has no noise, so by default nothing
//! is filtered; the classes of SAE J211 can be asked for where outputs are close enough for them.
//!
//! What every body reads makes the first measures. A chest that yields, load cells of dummies for the side, instruments of
//! whiplash tests and lower legs ([`Special`]) make more of them where they are read. A chest that is rigid has no deflection
//! and no viscous criterion, and its measures say so instead of guessing.

mod definition;
mod measures;
mod parts;
mod readings;
mod rear;
mod signals;
mod special;

use occupant_units::trig;
use std::sync::LazyLock;

use serde::{Serialize, Serializer};

use crate::measure::{Basis, Dummy, Grade, Limit, Rule};
use crate::signal::CfcFamily;
use occupant_units::unit::Unit;

pub use readings::{Acceleration, Readings};
pub use signals::{Components, Extreme, Extremes, Person, Ribs, Signals};
pub use special::{ChestPoint, Special, TibiaLoad, TibiaSite};

/// Filters of signals before measures are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filtering {
    /// Unfiltered.
    #[default]
    None,
    /// By the class that SAE J211 names for each channel: head and pelvis accelerations and neck forces 1000, neck moments
    /// and femurs 600, chest acceleration 180, head rotation 60; [`Special`] signals as [`Special::class`] says.
    Classes(CfcFamily),
}

/// Settings of measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The dummy whose limits and risk curves apply.
    pub dummy: Dummy,
    /// Whether a body of another size is compared with the frontal dummy of that size: see [`Options::for_body`].
    pub by_size: bool,
    /// Another dummy whose limits apply too, for the same parts.
    pub also: Option<Dummy>,
    /// Filters.
    pub filtering: Filtering,
}

impl Default for Options {
    /// Hybrid III 50M, or that of the body's size, unfiltered.
    fn default() -> Self {
        Options { dummy: Dummy::HybridIii50M, by_size: true, also: None, filtering: Filtering::None }
    }
}

impl Options {
    /// Settings for one dummy, whatever the body.
    #[must_use]
    pub fn with(self, dummy: Dummy) -> Options {
        Options { dummy, by_size: false, also: None, ..self }
    }

    /// Settings for a body of this mass, kg: the Hybrid III nearest in mass, if chosen by size.
    #[must_use]
    pub fn for_body(self, mass_kg: f64) -> Options {
        if !self.by_size {
            return self;
        }
        self.with(nearest(&Dummy::SIZES, mass_kg).unwrap_or(self.dummy))
    }

    /// Settings for a body of this mass, kg, whose ribs yield to the side: SID-IIs or ES-2, whichever is nearer in mass, if
    /// chosen by size. Limits of the ES-2re apply beside those of the ES-2, which differs from it behind its ribs only.
    #[must_use]
    pub fn for_side(self, mass_kg: f64) -> Options {
        if !self.by_size {
            return self;
        }
        let own = self.with(nearest(&[Dummy::SidIis, Dummy::Es2], mass_kg).unwrap_or(self.dummy));
        Options { also: (own.dummy == Dummy::Es2).then_some(Dummy::Es2Re), ..own }
    }
}

/// The dummy nearest in mass.
fn nearest(dummies: &[Dummy], mass_kg: f64) -> Option<Dummy> {
    let far = |dummy: &Dummy| trig::ln(mass_kg / dummy.mass_kg()).abs();
    dummies.iter().copied().min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// A measure of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measure {
    /// Name, such as `hic15`.
    pub name: &'static str,
    /// Label in tables.
    pub label: &'static str,
    /// Its name among the figures of a run; none for one that no run has.
    #[serde(skip)]
    pub figure: Option<&'static str>,
    /// Whether it is in short tables.
    #[serde(skip)]
    pub brief: bool,
    /// Unit of the value and of its limits.
    #[serde(serialize_with = "symbol")]
    pub unit: Unit,
    /// The value; none if it cannot be computed, for the reason in `remark`.
    pub value: Option<f64>,
    /// Its time, or the start of its window, s.
    pub from_s: Option<f64>,
    /// End of the window, s.
    pub to_s: Option<f64>,
    /// Filter class of its signals; 0 is none.
    pub filter_class: u32,
    /// Reason for a missing value, or a remark.
    pub remark: Option<String>,
    /// Comparison with limits.
    pub limits: Vec<Judgement>,
    /// Probabilities of injury.
    pub risks: Vec<Risk>,
}

impl Measure {
    /// Whether it is beyond any of its limits.
    pub fn is_exceeded(&self) -> bool {
        self.limits.iter().any(|limit| !limit.passed)
    }
}

/// A measure compared with one limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Judgement {
    /// The rule.
    pub rule: &'static str,
    /// The largest value allowed, in the measure's unit.
    pub most: f64,
    /// Within the limit.
    pub passed: bool,
    /// Limit minus value, in the measure's unit.
    pub margin: f64,
    /// The margin as a fraction of the limit.
    pub relative_margin: f64,
    /// Whether the limit was read in a source that quotes the rule; otherwise it is from memory.
    pub quoted: bool,
}

impl Judgement {
    /// A value compared with a limit, both in the measure's unit.
    pub fn of(limit: &Limit, value: f64) -> Self {
        let verdict = limit.judge(value);
        Judgement {
            rule: limit.rule.name(),
            most: limit.most,
            passed: verdict.passed,
            margin: verdict.margin,
            relative_margin: verdict.relative_margin,
            quoted: limit.basis == Basis::SecondarySource,
        }
    }
}

/// The probability of an injury.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Risk {
    /// Injury, such as `head AIS3+`.
    pub injury: &'static str,
    /// 0 to 1.
    pub probability: f64,
    /// Whether its curve is consistent with those of milder and worse injuries, of which the worse cannot be more
    /// likely: the curves were fitted separately and cross.
    pub agrees: bool,
}

/// All measures, in the order of a dummy from head to legs. The list has the same names for all signals with the same
/// [`Signals::special`].
pub fn assess(signals: &Signals, options: &Options) -> Vec<Measure> {
    Readings::new(signals, options).measures()
}

/// Fewest samples for which half of them still give a result.
const FEWEST: usize = 4;

/// Largest relative change of each of `measures`, computed from `signals`, when the even or the odd samples are left
/// out: it detects spikes of a single sample. 1 with fewer than four samples; 0 where the change is unknown or smaller
/// than 1 % of all limits. Without limits for the body those for any dummy count (for NIC at contact those of NIC), else
/// 1 for a pure number.
pub fn coarseness(signals: &Signals, options: &Options, measures: &[Measure]) -> Vec<f64> {
    let halves = [0, 1].map(|first| assess(&signals.every_other(first), options));
    let change = |whole: &Measure, half: &Measure| {
        let value = whole.value?;
        let half = if signals.len() < FEWEST { 0.0 } else { half.value? };
        let change = (half - value).abs();
        let other = || readings::weight(whole.name).or((whole.unit == Unit::One).then_some(1.0));
        let other = if whole.limits.is_empty() { other() } else { None };
        let scales = whole.limits.iter().map(|limit| limit.most).chain(other);
        let matters = scales.into_iter().all(|scale| change > 0.01 * scale);
        matters.then_some(change / value.abs()).filter(|part| part.is_finite())
    };
    let most = |(i, whole)| halves.iter().filter_map(|half| change(whole, &half[i])).fold(0.0, f64::max);
    measures.iter().enumerate().map(most).collect()
}

/// Rules whose limits apply to an occupant.
pub const RULES: [Rule; 14] = [
    Rule::Fmvss208,
    Rule::UnR94,
    Rule::UnR137,
    Rule::UnR95,
    Rule::UnR135,
    Rule::Fmvss214,
    Rule::EuroNcapFullWidth,
    Rule::EuroNcapMpdb,
    Rule::EuroNcapSideBarrier,
    Rule::EuroNcapSidePole,
    Rule::EuroNcapWhiplashLow,
    Rule::EuroNcapWhiplashMedium,
    Rule::EuroNcapWhiplashHigh,
    Rule::SeverityIndex,
];

/// Limits of the [`RULES`], in their order, that occupants are judged by.
static JUDGED: LazyLock<Vec<&'static Limit>> = LazyLock::new(|| {
    let of = |rule| crate::measure::LIMITS.iter().filter(move |limit| limit.rule == rule && is_judged(limit));
    RULES.into_iter().flat_map(of).collect()
});

/// Whether exceeding a limit of these grades breaks a rule or scores no points.
fn is_judged(limit: &Limit) -> bool {
    match limit.grade {
        Grade::Maximum | Grade::LowerPerformance => true,
        // where nothing but a cap is given
        Grade::Capping => !crate::measure::LIMITS.iter().any(|other| {
            (other.rule, other.dummy, other.quantity) == (limit.rule, limit.dummy, limit.quantity)
                && other.grade == Grade::LowerPerformance
        }),
        _ => false,
    }
}

impl Measure {
    /// Compares the value with the limits of all [`RULES`] for a quantity.
    fn judge(&mut self, value: f64, quantity: crate::measure::Quantity, options: &Options) {
        let applies =
            |limit: &Limit| [Some(options.dummy), options.also].into_iter().flatten().any(|d| limit.applies_to(d));
        let judged = JUDGED.iter().filter(|limit| limit.quantity == quantity && applies(limit));
        self.limits = judged.map(|limit| Judgement::of(limit, value)).collect();
    }
}

fn symbol<S: Serializer>(unit: &Unit, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(unit.symbol())
}

#[cfg(test)]
mod tests;
