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
    /// NCHRP Report 350, breakaway supports and work-zone devices.
    Nchrp350Supports,
    /// EN 1317-1:1998.
    En1317Edition1998,
    /// EN 1317-1:2010, which has no PHD.
    En1317Edition2010,
    /// EN 1317-3:2010, crash cushions hit head on (TC 1 to TC 3).
    En1317CushionHeadOn,
    /// EN 1317-3:2010, crash cushions hit on the side (TC 4, TC 5).
    En1317CushionSide,
    /// EN 12767:2007 at 50, 70 or 100 km/h.
    En12767,
    /// EN 12767:2007 at 35 km/h.
    En12767Slow,
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
            Self::Nchrp350Supports => "NCHRP 350 (breakaway supports)",
            Self::En1317Edition1998 => "EN 1317-1:1998",
            Self::En1317Edition2010 => "EN 1317-1:2010",
            Self::En1317CushionHeadOn => "EN 1317-3 (cushion, head on)",
            Self::En1317CushionSide => "EN 1317-3 (cushion, side)",
            Self::En12767 => "EN 12767 (50 to 100 km/h)",
            Self::En12767Slow => "EN 12767 (35 km/h)",
            Self::SeverityIndex => "severity index (historical)",
        }
    }

    /// The document that sets its limits, with edition, year and place.
    #[must_use]
    pub fn document(self) -> &'static str {
        match self {
            Self::Fmvss208 => "NHTSA, 49 CFR 571.208, S6, as of 2000 (advanced air bags)",
            Self::UnR94 => "UN Regulation 94, paragraph 5.2.1, as amended in 1998",
            Self::UnR137 => "UN Regulation 137, paragraph 5.2.1, 2016",
            Self::Mash2016 | Self::Mash2016Supports => {
                "AASHTO, Manual for Assessing Safety Hardware, 2nd edition, 2016, Table 5-1, criteria F, H and I"
            }
            Self::Nchrp350 | Self::Nchrp350Supports => {
                "Ross and others, NCHRP Report 350, TRB, 1993, Table 5.1, criteria H and I"
            }
            Self::En1317Edition1998 => "CEN, EN 1317-2:1998 with A1:2006 (class C), impact severity levels",
            Self::En1317Edition2010 => "CEN, EN 1317-2:2010, impact severity levels",
            Self::En1317CushionHeadOn | Self::En1317CushionSide => "CEN, EN 1317-3:2010, impact severity levels",
            Self::En12767 | Self::En12767Slow => {
                "CEN, EN 12767:2007, levels of occupant safety; the edition of 2019 has classes A to E instead"
            }
            Self::SeverityIndex => "Gadd, SAE 660793, 1966; of the chest as of the head",
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
    /// Occupant impact velocity forward or back, m/s; the rule says nothing of the sides.
    LongitudinalImpactVelocity,
    /// Occupant ridedown acceleration, each component, m/s².
    RidedownAcceleration,
    /// Acceleration severity index.
    Asi,
    /// Theoretical head impact velocity, m/s.
    Thiv,
    /// Post-impact head deceleration, m/s².
    Phd,
    /// Largest roll angle, rad.
    Roll,
    /// Largest pitch angle, rad.
    Pitch,
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
    /// Bound of level NE 3 of EN 12767.
    LevelNe3,
    /// Bound of levels HE 3, LE 3 and NE 2 of EN 12767.
    Level3,
    /// Bound of levels HE 2, LE 2 and NE 1 of EN 12767.
    Level2,
    /// Bound of levels HE 1 and LE 1 of EN 12767.
    Level1,
    /// Bound of all levels of EN 12767 but NE 3, at 35 km/h.
    AnyLevel,
}

impl Grade {
    /// What it is, in words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Maximum => "maximum",
            Self::Preferred => "preferred",
            Self::ClassA => "class A",
            Self::ClassB => "class B",
            Self::ClassC => "class C",
            Self::LevelNe3 => "level NE 3",
            Self::Level3 => "levels HE 3, LE 3, NE 2",
            Self::Level2 => "levels HE 2, LE 2, NE 1",
            Self::Level1 => "levels HE 1, LE 1",
            Self::AnyLevel => "all levels but NE 3",
        }
    }
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

    /// Whether the rule is broken beyond it: it is a maximum, or the bound of the last class or level that the rule has.
    #[must_use]
    pub fn is_last(&self) -> bool {
        let mut beside = LIMITS.iter().filter(|other| other.rule == self.rule && other.quantity == self.quantity);
        self.grade == Maximum || beside.all(|other| other.most <= self.most)
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
use Grade::{AnyLevel, ClassA, ClassB, ClassC, Level1, Level2, Level3, LevelNe3, Maximum, Preferred};
use Quantity::{
    Asi, ChestDeflection, ChestThreeMsCumulative, FemurAxial, FemurDurationUse, HeadThreeMsCumulative, Hic15, Hic36,
    LongitudinalImpactVelocity, NeckCompression, NeckTension, OccupantImpactVelocity, Phd, Pitch, RidedownAcceleration,
    Roll, Thiv, ViscousCriterion,
};
use Rule::{
    En1317CushionHeadOn, En1317CushionSide, En1317Edition1998, En1317Edition2010, En12767, En12767Slow, Fmvss208,
    Mash2016, Mash2016Supports, Nchrp350, Nchrp350Supports, UnR94, UnR137,
};

/// The roll and pitch that a vehicle may reach and stay upright, rad.
const UPRIGHT_RAD: f64 = 75.0 * std::f64::consts::PI / 180.0;

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
    entry(Mash2016, None, Roll, UPRIGHT_RAD, Maximum, CommonKnowledge),
    entry(Mash2016, None, Pitch, UPRIGHT_RAD, Maximum, CommonKnowledge),
    entry(Mash2016Supports, None, LongitudinalImpactVelocity, 3.0, Preferred, CommonKnowledge),
    entry(Mash2016Supports, None, LongitudinalImpactVelocity, 4.9, Maximum, CommonKnowledge),
    entry(Mash2016Supports, None, RidedownAcceleration, 15.0 * G, Preferred, SecondarySource),
    entry(Mash2016Supports, None, RidedownAcceleration, 20.49 * G, Maximum, SecondarySource),
    entry(Mash2016Supports, None, Roll, UPRIGHT_RAD, Maximum, CommonKnowledge),
    entry(Mash2016Supports, None, Pitch, UPRIGHT_RAD, Maximum, CommonKnowledge),
    entry(Nchrp350, None, OccupantImpactVelocity, 9.0, Preferred, SecondarySource),
    entry(Nchrp350, None, OccupantImpactVelocity, 12.0, Maximum, SecondarySource),
    entry(Nchrp350, None, RidedownAcceleration, 15.0 * G, Preferred, CommonKnowledge),
    entry(Nchrp350, None, RidedownAcceleration, 20.0 * G, Maximum, CommonKnowledge),
    entry(Nchrp350Supports, None, LongitudinalImpactVelocity, 3.0, Preferred, CommonKnowledge),
    entry(Nchrp350Supports, None, LongitudinalImpactVelocity, 5.0, Maximum, CommonKnowledge),
    entry(Nchrp350Supports, None, RidedownAcceleration, 15.0 * G, Preferred, CommonKnowledge),
    entry(Nchrp350Supports, None, RidedownAcceleration, 20.0 * G, Maximum, CommonKnowledge),
    entry(En1317Edition1998, None, Asi, 1.0, ClassA, CommonKnowledge),
    entry(En1317Edition1998, None, Asi, 1.4, ClassB, CommonKnowledge),
    entry(En1317Edition1998, None, Asi, 1.9, ClassC, CommonKnowledge),
    entry(En1317Edition1998, None, Thiv, 33.0 / 3.6, Maximum, SecondarySource),
    entry(En1317Edition1998, None, Phd, 20.0 * G, Maximum, SecondarySource),
    entry(En1317Edition2010, None, Asi, 1.0, ClassA, CommonKnowledge),
    entry(En1317Edition2010, None, Asi, 1.4, ClassB, CommonKnowledge),
    entry(En1317Edition2010, None, Asi, 1.9, ClassC, CommonKnowledge),
    entry(En1317Edition2010, None, Thiv, 33.0 / 3.6, Maximum, CommonKnowledge),
    entry(En1317CushionHeadOn, None, Asi, 1.0, ClassA, CommonKnowledge),
    entry(En1317CushionHeadOn, None, Asi, 1.4, ClassB, CommonKnowledge),
    entry(En1317CushionHeadOn, None, Thiv, 44.0 / 3.6, Maximum, CommonKnowledge),
    entry(En1317CushionSide, None, Asi, 1.0, ClassA, CommonKnowledge),
    entry(En1317CushionSide, None, Asi, 1.4, ClassB, CommonKnowledge),
    entry(En1317CushionSide, None, Thiv, 33.0 / 3.6, Maximum, CommonKnowledge),
    entry(En12767, None, Asi, 0.6, LevelNe3, CommonKnowledge),
    entry(En12767, None, Asi, 1.0, Level3, CommonKnowledge),
    entry(En12767, None, Asi, 1.2, Level2, CommonKnowledge),
    entry(En12767, None, Asi, 1.4, Level1, CommonKnowledge),
    entry(En12767, None, Thiv, 11.0 / 3.6, LevelNe3, CommonKnowledge),
    entry(En12767, None, Thiv, 27.0 / 3.6, Level3, CommonKnowledge),
    entry(En12767, None, Thiv, 33.0 / 3.6, Level2, CommonKnowledge),
    entry(En12767, None, Thiv, 44.0 / 3.6, Level1, CommonKnowledge),
    entry(En12767Slow, None, Asi, 0.6, LevelNe3, CommonKnowledge),
    entry(En12767Slow, None, Asi, 1.0, AnyLevel, CommonKnowledge),
    entry(En12767Slow, None, Thiv, 11.0 / 3.6, LevelNe3, CommonKnowledge),
    entry(En12767Slow, None, Thiv, 27.0 / 3.6, AnyLevel, CommonKnowledge),
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

    /// Whoever reads a verdict finds the document and its year.
    #[test]
    fn each_rule_names_its_document_and_a_year() {
        let has_year = |words: &str| {
            words
                .split(|c: char| !c.is_ascii_digit())
                .any(|number| number.len() == 4 && number > "1959" && number < "2030")
        };
        for limit in LIMITS {
            let document = limit.rule.document();
            assert!(has_year(document), "{}: {document}", limit.rule.name());
        }
    }

    #[test]
    fn preferred_values_lie_below_the_maximum() {
        for (rule, speed) in [
            (Mash2016, OccupantImpactVelocity),
            (Mash2016Supports, LongitudinalImpactVelocity),
            (Nchrp350, OccupantImpactVelocity),
            (Nchrp350Supports, LongitudinalImpactVelocity),
        ] {
            for quantity in [speed, RidedownAcceleration] {
                let most = |grade| {
                    LIMITS.iter().find(|l| l.rule == rule && l.quantity == quantity && l.grade == grade).unwrap().most
                };
                assert!(most(Preferred) < most(Maximum));
            }
        }
    }

    #[test]
    fn a_rule_is_broken_beyond_its_last_bound_alone() {
        let is_last = |rule, quantity, grade| {
            LIMITS.iter().find(|l| l.rule == rule && l.quantity == quantity && l.grade == grade).unwrap().is_last()
        };
        assert!(is_last(En1317Edition2010, Asi, ClassC) && !is_last(En1317Edition2010, Asi, ClassB));
        assert!(
            is_last(En1317CushionSide, Asi, ClassB)
                && is_last(En12767, Thiv, Level1)
                && !is_last(En12767, Thiv, Level2)
        );
        assert!(is_last(Mash2016, Roll, Maximum) && !is_last(Mash2016, OccupantImpactVelocity, Preferred));
        // of supports the sides are not limited
        assert!(
            LIMITS.iter().all(
                |l| l.quantity != OccupantImpactVelocity || ![Mash2016Supports, Nchrp350Supports].contains(&l.rule)
            )
        );
    }
}
