//! Measures against the limits of rules.

use super::VehicleRisk;
use crash_measures::measure::limits::{Grade, LIMITS, Limit, Quantity, Rule, Verdict};

/// Rules for the motion of a vehicle.
pub const ROADSIDE_RULES: [Rule; 10] = [
    Rule::Mash2016,
    Rule::Mash2016Supports,
    Rule::Nchrp350,
    Rule::Nchrp350Supports,
    Rule::En1317Edition1998,
    Rule::En1317Edition2010,
    Rule::En1317CushionHeadOn,
    Rule::En1317CushionSide,
    Rule::En12767,
    Rule::En12767Slow,
];

/// A measure compared with a limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judgement {
    /// The limit.
    pub limit: &'static Limit,
    /// The measure's name.
    pub measure: &'static str,
    /// Its value, SI, as a magnitude; none if it was left out.
    pub value: Option<f64>,
    /// The verdict, if there is a value.
    pub verdict: Option<Verdict>,
}

impl Judgement {
    /// Whether the rule is broken: a maximum, or the last class or level that the rule has, is exceeded.
    pub fn breaks_the_rule(&self) -> bool {
        self.limit.is_last() && self.verdict.is_some_and(|verdict| !verdict.passed)
    }
}

/// Grade of a motion under a rule with classes or levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attained {
    /// The best class or level whose bounds are all met.
    Grade(Grade),
    /// None, because this bound is exceeded.
    Beyond(&'static Limit),
    /// Unknown, because this measure is missing.
    NotMeasured(&'static str),
}

/// The class or level attained under a rule; none for a rule without any. A maximum beside the classes applies to each.
pub fn attained(rule: Rule, judgements: &[Judgement]) -> Option<Attained> {
    let own = || judgements.iter().filter(move |judgement| judgement.limit.rule == rule);
    let has_classes = own().any(|judgement| !matches!(judgement.limit.grade, Grade::Maximum | Grade::Preferred));
    has_classes.then_some(())?;
    if let Some(unknown) = own().find(|judgement| judgement.verdict.is_none()) {
        return Some(Attained::NotMeasured(unknown.measure));
    }
    let exceeded = |grade: Grade| {
        let of = move |judgement: &&Judgement| judgement.limit.grade == grade;
        own().filter(of).find(|judgement| judgement.verdict.is_some_and(|verdict| !verdict.passed))
    };
    if let Some(beyond) = exceeded(Grade::Maximum) {
        return Some(Attained::Beyond(beyond.limit));
    }
    // from the best to the last, as they are listed
    let grades = || own().map(|judgement| judgement.limit.grade).filter(|grade| *grade != Grade::Maximum);
    let best = grades().find(|grade| exceeded(*grade).is_none()).map(Attained::Grade);
    best.or_else(|| Some(Attained::Beyond(exceeded(grades().next_back()?)?.limit)))
}

/// All limits of `rules` in order, compared with `risk`.
pub fn judge(risk: &VehicleRisk, rules: &[Rule]) -> Vec<Judgement> {
    let mut judgements = Vec::new();
    for rule in rules {
        for limit in LIMITS.iter().filter(|limit| limit.rule == *rule) {
            for (measure, value) in values(risk, limit) {
                let value = value.map(f64::abs);
                judgements.push(Judgement { limit, measure, value, verdict: value.map(|value| limit.judge(value)) });
            }
        }
    }
    judgements
}

/// The measures that a limit applies to.
fn values(risk: &VehicleRisk, limit: &Limit) -> Vec<(&'static str, Option<f64>)> {
    let flail = risk.flail.as_ref().ok();
    let thiv = risk.thiv.as_ref().ok();
    match limit.quantity {
        Quantity::OccupantImpactVelocity => {
            vec![("OIV x", flail.map(|f| f.oiv_x_mps)), ("OIV y", flail.map(|f| f.oiv_y_mps))]
        }
        Quantity::LongitudinalImpactVelocity => vec![("OIV x", flail.map(|f| f.oiv_x_mps))],
        Quantity::RidedownAcceleration => vec![
            ("ORA x", flail.and_then(|f| Some(f.ora_x?.value))),
            ("ORA y", flail.and_then(|f| Some(f.ora_y?.value))),
        ],
        Quantity::Thiv => vec![("THIV", thiv.map(|t| t.speed_mps))],
        Quantity::Phd => vec![("PHD", thiv.and_then(|t| Some(t.phd?.value)))],
        Quantity::Asi => match limit.rule {
            // EN 12767:2007 goes with the edition of its time
            Rule::En1317Edition1998 | Rule::En12767 | Rule::En12767Slow => {
                vec![("ASI (1998)", risk.asi_1998.as_ref().ok().map(|p| p.value))]
            }
            _ => vec![("ASI (2010)", risk.asi_2010.as_ref().ok().map(|p| p.value))],
        },
        Quantity::Roll => vec![("roll", risk.angles.largest[0].as_ref().ok().map(|p| p.value))],
        Quantity::Pitch => vec![("pitch", risk.angles.largest[1].as_ref().ok().map(|p| p.value))],
        _ => Vec::new(),
    }
}
