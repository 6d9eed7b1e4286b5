//! Limits by rule, and the verdict on a value.
//!
//! The rules' own texts were not at hand. Every limit says where it was read: [`Basis::SecondarySource`]
//! (a program, manual or report that quotes the rule) or [`Basis::CommonKnowledge`] (not seen quoted).
//! Neither is the rule itself: for a legal statement, check the rule.

use super::Dummy;
use crate::signal::STANDARD_GRAVITY_MPS2 as G;

/// A rule or test procedure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Rule {
    /// FMVSS 208.
    Fmvss208,
    /// UN Regulation 94.
    UnR94,
    /// UN Regulation 137.
    UnR137,
    /// MASH 2016.
    Mash2016,
    /// MASH 2016, breakaway supports.
    Mash2016Supports,
    /// NCHRP Report 350.
    Nchrp350,
    /// EN 1317-1:1998.
    En1317Edition1998,
    /// EN 1317-1:2010, which has no PHD.
    En1317Edition2010,
    /// Historical 1000 of the severity indices.
    SeverityIndex,
}

impl Rule {
    /// Its name as tables print it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fmvss208 => "FMVSS 208",
            Self::UnR94 => "UN R94",
            Self::UnR137 => "UN R137",
            Self::Mash2016 => "MASH 2016",
            Self::Mash2016Supports => "MASH 2016 (breakaway supports)",
            Self::Nchrp350 => "NCHRP 350",
            Self::En1317Edition1998 => "EN 1317-1:1998",
            Self::En1317Edition2010 => "EN 1317-1:2010",
            Self::SeverityIndex => "severity index (historical)",
        }
    }
}

/// What is limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// HIC15.
    Hic15,
    /// HIC36, HPC.
    Hic36,
    /// Cumulative 3 ms level of the head, m/s².
    HeadThreeMsCumulative,
    /// Nij.
    Nij,
    /// Neck tension, N.
    NeckTension,
    /// Neck compression as a positive number, N.
    NeckCompression,
    /// Cumulative 3 ms level of the chest, m/s².
    ChestThreeMsCumulative,
    /// Chest deflection (measured; a rigid thorax has none), m.
    ChestDeflection,
    /// Viscous criterion (measured), m/s.
    ViscousCriterion,
    /// Femur axial compression as a positive number, N.
    FemurAxial,
    /// Femur force over the R94 curve that falls with duration.
    FemurDurationUse,
    /// GSI or CSI.
    SeverityIndex,
    /// Occupant impact velocity, each component, m/s.
    OccupantImpactVelocity,
    /// Occupant ridedown acceleration, each component, m/s².
    RidedownAcceleration,
    /// Acceleration severity index.
    Asi,
    /// Theoretical head impact velocity, m/s.
    Thiv,
    /// Post-impact head deceleration, m/s².
    Phd,
}

/// What exceeding a limit means.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Grade {
    /// The rule is not met.
    Maximum,
    /// A preferred value; exceeding it is allowed.
    Preferred,
    /// Bound of severity class A.
    ClassA,
    /// Bound of severity class B.
    ClassB,
    /// Bound of severity class C.
    ClassC,
}

/// Where a number was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Basis {
    /// In a program, manual or report that quotes the rule.
    SecondarySource,
    /// Nowhere in particular; generally known.
    CommonKnowledge,
}

/// One limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The rule.
    pub rule: Rule,
    /// The dummy it holds for; none where it holds for any or no dummy is involved.
    pub dummy: Option<Dummy>,
    /// The quantity.
    pub quantity: Quantity,
    /// The largest value allowed, SI.
    pub most: f64,
    /// What exceeding it means.
    pub grade: Grade,
    /// Where the number was read.
    pub basis: Basis,
}

/// A value against its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// The value is finite and does not exceed the limit.
    pub passed: bool,
    /// Limit minus value, SI; negative beyond the limit.
    pub margin: f64,
    /// The margin as a fraction of the limit.
    pub relative_margin: f64,
}

impl Limit {
    /// Compares a value, in the unit of the quantity, with the limit. A value that is not finite fails.
    #[must_use]
    pub fn judge(&self, value: f64) -> Verdict {
        let margin = self.most - value;
        Verdict { passed: value.is_finite() && margin >= 0.0, margin, relative_margin: margin / self.most }
    }
}

/// The limits of a rule that hold for a dummy, those for any dummy included.
pub fn limits(rule: Rule, dummy: Dummy) -> impl Iterator<Item = &'static Limit> {
    LIMITS.iter().filter(move |limit| limit.rule == rule && limit.dummy.is_none_or(|d| d == dummy))
}

const fn entry(rule: Rule, dummy: Option<Dummy>, quantity: Quantity, most: f64, grade: Grade, basis: Basis) -> Limit {
    Limit { rule, dummy, quantity, most, grade, basis }
}

const MALE: Option<Dummy> = Some(Dummy::HybridIii50M);
const FEMALE: Option<Dummy> = Some(Dummy::HybridIii5F);

use Basis::{CommonKnowledge, SecondarySource};
use Grade::{ClassA, ClassB, ClassC, Maximum, Preferred};
use Quantity::{
    Asi, ChestDeflection, ChestThreeMsCumulative, FemurAxial, FemurDurationUse, HeadThreeMsCumulative, Hic15, Hic36,
    NeckCompression, NeckTension, OccupantImpactVelocity, Phd, RidedownAcceleration, Thiv, ViscousCriterion,
};
use Rule::{En1317Edition1998, En1317Edition2010, Fmvss208, Mash2016, Mash2016Supports, Nchrp350, UnR94, UnR137};

/// Every limit known here.
#[rustfmt::skip] // a table: one limit a line
pub const LIMITS: &[Limit] = &[
    entry(Fmvss208, MALE, Hic15, 700.0, Maximum, SecondarySource),
    entry(Fmvss208, FEMALE, Hic15, 700.0, Maximum, CommonKnowledge),
    entry(Fmvss208, None, Quantity::Nij, 1.0, Maximum, SecondarySource),
    entry(Fmvss208, MALE, NeckTension, 4170.0, Maximum, SecondarySource),
    entry(Fmvss208, MALE, NeckCompression, 4000.0, Maximum, SecondarySource),
    entry(Fmvss208, FEMALE, NeckTension, 2620.0, Maximum, SecondarySource),
    entry(Fmvss208, FEMALE, NeckCompression, 2520.0, Maximum, SecondarySource),
    entry(Fmvss208, None, ChestThreeMsCumulative, 60.0 * G, Maximum, SecondarySource),
    entry(Fmvss208, MALE, ChestDeflection, 0.063, Maximum, SecondarySource),
    entry(Fmvss208, FEMALE, ChestDeflection, 0.052, Maximum, SecondarySource),
    entry(Fmvss208, MALE, FemurAxial, 10_008.0, Maximum, SecondarySource),
    entry(Fmvss208, FEMALE, FemurAxial, 6805.0, Maximum, SecondarySource),
    entry(UnR94, None, Hic36, 1000.0, Maximum, CommonKnowledge),
    entry(UnR94, None, HeadThreeMsCumulative, 80.0 * G, Maximum, SecondarySource),
    entry(UnR94, None, ViscousCriterion, 1.0, Maximum, SecondarySource),
    entry(UnR94, None, FemurDurationUse, 1.0, Maximum, SecondarySource),
    entry(UnR137, None, Hic36, 1000.0, Maximum, CommonKnowledge),
    entry(UnR137, None, HeadThreeMsCumulative, 80.0 * G, Maximum, SecondarySource),
    entry(UnR137, MALE, ChestDeflection, 0.042, Maximum, SecondarySource),
    entry(UnR137, None, ViscousCriterion, 1.0, Maximum, SecondarySource),
    entry(Mash2016, None, OccupantImpactVelocity, 9.1, Preferred, SecondarySource),
    entry(Mash2016, None, OccupantImpactVelocity, 12.2, Maximum, SecondarySource),
    entry(Mash2016, None, RidedownAcceleration, 15.0 * G, Preferred, SecondarySource),
    entry(Mash2016, None, RidedownAcceleration, 20.49 * G, Maximum, SecondarySource),
    entry(Mash2016Supports, None, OccupantImpactVelocity, 3.0, Preferred, CommonKnowledge),
    entry(Mash2016Supports, None, OccupantImpactVelocity, 4.9, Maximum, CommonKnowledge),
    entry(Mash2016Supports, None, RidedownAcceleration, 15.0 * G, Preferred, SecondarySource),
    entry(Mash2016Supports, None, RidedownAcceleration, 20.49 * G, Maximum, SecondarySource),
    entry(Nchrp350, None, OccupantImpactVelocity, 9.0, Preferred, SecondarySource),
    entry(Nchrp350, None, OccupantImpactVelocity, 12.0, Maximum, SecondarySource),
    entry(Nchrp350, None, RidedownAcceleration, 15.0 * G, Preferred, CommonKnowledge),
    entry(Nchrp350, None, RidedownAcceleration, 20.0 * G, Maximum, CommonKnowledge),
    entry(En1317Edition1998, None, Asi, 1.0, ClassA, CommonKnowledge),
    entry(En1317Edition1998, None, Asi, 1.4, ClassB, CommonKnowledge),
    entry(En1317Edition1998, None, Asi, 1.9, ClassC, CommonKnowledge),
    entry(En1317Edition1998, None, Thiv, 33.0 / 3.6, Maximum, SecondarySource),
    entry(En1317Edition1998, None, Phd, 20.0 * G, Maximum, SecondarySource),
    entry(En1317Edition2010, None, Asi, 1.0, ClassA, CommonKnowledge),
    entry(En1317Edition2010, None, Asi, 1.4, ClassB, CommonKnowledge),
    entry(En1317Edition2010, None, Asi, 1.9, ClassC, CommonKnowledge),
    entry(En1317Edition2010, None, Thiv, 33.0 / 3.6, Maximum, CommonKnowledge),
    entry(Rule::SeverityIndex, None, Quantity::SeverityIndex, 1000.0, Maximum, SecondarySource),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_itself_passes_and_beyond_fails() {
        let hic = limits(Fmvss208, Dummy::HybridIii50M).find(|l| l.quantity == Hic15).unwrap();
        let at = hic.judge(700.0);
        assert!(at.passed && at.margin == 0.0);
        let beyond = hic.judge(770.0);
        assert!(!beyond.passed && (beyond.relative_margin + 0.1).abs() < 1e-15);
        assert!(!hic.judge(f64::NAN).passed && !hic.judge(f64::NEG_INFINITY).passed);
    }

    #[test]
    fn each_dummy_gets_its_own_limits_and_the_common_ones() {
        let of = |dummy, quantity| -> Vec<f64> {
            limits(Fmvss208, dummy).filter(|l| l.quantity == quantity).map(|l| l.most).collect()
        };
        assert_eq!(of(Dummy::HybridIii50M, FemurAxial), [10_008.0]);
        assert_eq!(of(Dummy::HybridIii5F, FemurAxial), [6805.0]);
        assert_eq!(of(Dummy::Thor50M, FemurAxial), [0.0; 0]);
        assert_eq!(of(Dummy::Thor50M, Quantity::Nij), [1.0]);
    }

    #[test]
    fn preferred_values_lie_below_the_maximum() {
        for rule in [Mash2016, Mash2016Supports, Nchrp350] {
            for quantity in [OccupantImpactVelocity, RidedownAcceleration] {
                let most = |grade| {
                    LIMITS.iter().find(|l| l.rule == rule && l.quantity == quantity && l.grade == grade).unwrap().most
                };
                assert!(most(Preferred) < most(Maximum));
            }
        }
    }
}
