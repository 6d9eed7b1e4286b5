//! Limits by rule, and the verdict on a value.
//!
//! The rules' own texts were not at hand. Every limit says where it was read: [`Basis::SecondarySource`]
//! (a program, manual or report that quotes the rule) or [`Basis::CommonKnowledge`] (not seen quoted).
//! Neither is the rule itself: for a legal statement, check the rule.

mod quantity;
mod rule;
mod table;

use super::Dummy;

pub use quantity::Quantity;
pub use rule::Rule;
pub use table::LIMITS;

/// Consequence of exceeding a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Grade {
    /// The rule is not met.
    Maximum,
    /// A preferred value; exceeding it is allowed.
    Preferred,
    /// Full points up to it (higher performance limit).
    HigherPerformance,
    /// No points from it on (lower performance limit).
    LowerPerformance,
    /// All points of the test are lost beyond it.
    Capping,
    /// Bound of "good".
    Good,
    /// Bound of "acceptable".
    Acceptable,
    /// Bound of "marginal"; "poor" beyond.
    Marginal,
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
    /// Description.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Maximum => "maximum",
            Self::Preferred => "preferred",
            Self::HigherPerformance => "higher performance",
            Self::LowerPerformance => "lower performance",
            Self::Capping => "capping",
            Self::Good => "good",
            Self::Acceptable => "acceptable",
            Self::Marginal => "marginal",
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

/// Source of a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Basis {
    /// In a program, manual or report that quotes the rule.
    SecondarySource,
    /// From memory; generally known.
    CommonKnowledge,
}

/// One limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The rule.
    pub rule: Rule,
    /// The dummy it applies to; none if it applies to any dummy of the rule's direction, or without a dummy.
    pub dummy: Option<Dummy>,
    /// The quantity.
    pub quantity: Quantity,
    /// The largest value allowed, SI.
    pub most: f64,
    /// Consequence of exceeding it.
    pub grade: Grade,
    /// Source of the number.
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

    /// Whether it is a limit of this dummy: its rule has the dummy's direction, and it names this dummy or none.
    pub(crate) fn applies_to(&self, dummy: Dummy) -> bool {
        self.dummy.is_none_or(|own| own == dummy) && self.rule.blow().is_none_or(|blow| blow == dummy.blow())
    }

    /// Whether exceeding it breaks the rule: it is a maximum, or the bound of the rule's last class or level.
    #[must_use]
    pub fn is_last(&self) -> bool {
        let mut beside = LIMITS.iter().filter(|other| other.rule == self.rule && other.quantity == self.quantity);
        self.grade == Grade::Maximum || beside.all(|other| other.most <= self.most)
    }
}

/// The limits of a rule for a dummy, including those for any dummy of the rule's direction. A rule without dummies
/// applies to all.
pub fn limits(rule: Rule, dummy: Dummy) -> impl Iterator<Item = &'static Limit> {
    LIMITS.iter().filter(move |limit| limit.rule == rule && limit.applies_to(dummy))
}

#[cfg(test)]
mod tests {
    use super::Grade::{ClassB, ClassC, Level1, Level2, Maximum, Preferred};
    use super::Quantity::{
        Asi, FemurAxial, Hic15, LongitudinalImpactVelocity, OccupantImpactVelocity, RidedownAcceleration,
    };
    use super::Quantity::{Roll, Thiv};
    use super::Rule::{
        En1317CushionSide, En1317Edition2010, En12767, Fmvss208, Mash2016, Mash2016Supports, Nchrp350, Nchrp350Supports,
    };
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

    /// Every verdict names the document and its year.
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

    /// A frontal rule does not apply to a side-impact dummy, nor vice versa.
    #[test]
    fn rules_hold_for_dummies_of_their_own_blow() {
        for (rule, own, other) in [
            (Fmvss208, Dummy::HybridIii50M, Dummy::Es2Re),
            (Rule::Fmvss214, Dummy::Es2Re, Dummy::HybridIii50M),
            (Rule::UnR135, Dummy::WorldSid50M, Dummy::WorldSid5F),
            (Rule::EuroNcapWhiplashMedium, Dummy::BioRidIi, Dummy::Thor50M),
        ] {
            assert!(limits(rule, own).count() > 0 && limits(rule, other).count() == 0, "{rule:?}");
        }
        // rules of the roadside ask no dummy
        assert_eq!(limits(Mash2016, Dummy::SidIis).count(), limits(Mash2016, Dummy::HybridIii50M).count());
        for limit in LIMITS {
            let fits = |dummy: Dummy| limit.rule.blow() == Some(dummy.blow());
            assert!(limit.dummy.is_none_or(fits), "{limit:?}");
        }
    }

    /// Points fall from the higher limit to the lower one, and a cap lies at or beyond it.
    #[test]
    fn performance_limits_are_in_order() {
        let beside = |limit: &Limit, grade| {
            LIMITS
                .iter()
                .find(|l| (l.rule, l.dummy, l.quantity, l.grade) == (limit.rule, limit.dummy, limit.quantity, grade))
        };
        let mut pairs = 0;
        for limit in LIMITS {
            for (milder, worse) in [
                (Grade::HigherPerformance, Grade::LowerPerformance),
                (Grade::LowerPerformance, Grade::Capping),
                (Grade::Good, Grade::Acceptable),
                (Grade::Acceptable, Grade::Marginal),
            ] {
                let Some(worse) = beside(limit, worse).filter(|_| limit.grade == milder) else { continue };
                assert!(limit.most <= worse.most, "{limit:?} {worse:?}");
                pairs += 1;
            }
        }
        assert!(pairs > 50, "{pairs}");
    }

    #[test]
    fn no_limit_stands_twice() {
        for (i, a) in LIMITS.iter().enumerate() {
            let is_same = |b: &&Limit| (a.rule, a.dummy, a.quantity, a.grade) == (b.rule, b.dummy, b.quantity, b.grade);
            assert_eq!(LIMITS[..i].iter().find(is_same), None);
        }
    }
}
