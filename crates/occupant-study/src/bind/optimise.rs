//! The `[optimise]` of a study: goals and constraints that make sense; their numbers once the units are known.

use super::fit::{TOLERANCE, population};
use super::{Binder, Purpose};
use crate::optimise::{Constraint, Goal, Optimise};
use crate::optimise_section::{GoalSection, OptimiseSection};
use crate::{Study, StudyText};
use occupant_scenario::kind::{KINDS, RATIO};
use occupant_scenario::{Diagnostics, Draft, Resolver};
use occupant_units::unit::Unit;
use placed_text::Value;

/// Default budget per parameter.
const BUDGET: u64 = 60;
/// Points of a front, and the goals that it can have.
const FRONT: std::ops::RangeInclusive<u64> = 2..=100;
const MOST_GOALS: usize = 4;
/// Default quantile of an ensemble.
const QUANTILE: f64 = 0.95;

impl StudyText {
    /// The optimise section of the study.
    ///
    /// # Errors
    /// None in the study; all problems of it, as far as they can be seen without its scenario.
    pub fn optimise(&self) -> Result<Optimise, Diagnostics> {
        let mut binder = Binder::new(self, Purpose::Sweep);
        let Some(section) = &self.section.optimise else {
            let hint = "[optimise] with `minimise = \"hic15\"`".to_owned();
            binder.error("", "the study has no [optimise]", "what to optimise", Some(hint));
            return Err(binder.problems);
        };
        if self.section.parameters.is_empty() {
            let hint = "[[parameters]] with `path` and `range`".to_owned();
            binder.error("", "nothing to vary", "`parameters` with ranges", Some(hint));
        }
        binder.search_limits("optimise", section.budget, section.population, [("tolerance", section.tolerance)]);
        let goals = binder.goals(section);
        let constraints = binder.constraints(section);
        binder.quantile(section);
        binder.front(section, goals.len());
        let n = self.section.parameters.len();
        let optimise = Optimise {
            goals,
            constraints,
            allow_caveats: section.allow_caveats.clone(),
            quantile: section.quantile.unwrap_or(QUANTILE),
            seed: self.section.seed.unwrap_or(0),
            budget: section.budget.unwrap_or(BUDGET * n.max(1) as u64 * if section.front.is_some() { 2 } else { 1 }),
            front: section.front.unwrap_or(0),
            population: population(section.population, n),
            tolerance: section.tolerance.unwrap_or(TOLERANCE),
        };
        if binder.problems.has_errors() { Err(binder.problems) } else { Ok(optimise) }
    }

    /// Checks the study against its base scenario for an optimisation: with its ensemble, without its design.
    ///
    /// # Errors
    /// As [`StudyText::bind`]; a parameter without finite ends.
    pub fn bind_optimise(&self, base: Draft, overrides: &[String], resolver: Resolver) -> Result<Study, Diagnostics> {
        self.bind_for(Purpose::Optimise, base, overrides, resolver)
    }

    /// A number of the study at a path, in the unit of a measure's table; bare in the study's units, or with its own.
    ///
    /// # Errors
    /// No number with a unit of that measure.
    pub fn measured(&self, path: &str, written: &Value, unit: &str) -> Result<f64, Diagnostics> {
        let measuring = Unit::measuring(unit);
        let kind = measuring.and_then(|(unit, _)| KINDS.iter().find(|kind| kind.unit == unit));
        let kind = kind.or_else(|| measuring.is_none().then_some(&KINDS[RATIO]));
        let units = self.section.units.unwrap_or_default();
        let si = match (kind, written.number()) {
            (Some(kind), _) => kind.si(written, units).map_err(|e| (e.found, e.expected, e.hint)),
            (None, Some(number)) => Ok(number * measuring.map_or(1.0, |(_, si)| si)),
            (None, None) => {
                Err((format!("{} instead of a number", written.kind()), format!("a number in {unit}"), None))
            }
        };
        let si = si.map_err(|(found, expected, hint)| self.complaint(path, found, expected, hint))?;
        Ok(si / measuring.map_or(1.0, |(_, si)| si))
    }
}

impl Binder<'_> {
    fn goals(&mut self, section: &OptimiseSection) -> Vec<Goal> {
        let one = GoalSection {
            minimise: section.minimise.clone(),
            maximise: section.maximise.clone(),
            weight: None,
            per: None,
        };
        let (list, is_one) = section.goals.as_ref().map_or((std::slice::from_ref(&one), true), |goals| (goals, false));
        let mut goals: Vec<Goal> = Vec::new();
        for (i, goal) in list.iter().enumerate() {
            let at = if is_one { "optimise".to_owned() } else { format!("optimise.goals[{i}]") };
            self.check_weight(goal.weight.unwrap_or(1.0), &at);
            let is_maximised = goal.maximise.is_some();
            // the check of the words has refused none and both
            let measure = goal.maximise.clone().or_else(|| goal.minimise.clone()).unwrap_or_default();
            let key = if is_maximised { "maximise" } else { "minimise" };
            if goals.iter().any(|earlier| earlier.measure == measure) {
                self.error(&format!("{at}.{key}"), format!("`{measure}` twice"), "each measure once", None);
            }
            let (weight, per) = (goal.weight.unwrap_or(1.0), goal.per.clone());
            let (at, at_per) = (format!("{at}.{key}"), format!("{at}.per"));
            goals.push(Goal { measure, is_maximised, weight, per, at, at_per });
        }
        goals
    }

    fn constraints(&mut self, section: &OptimiseSection) -> Vec<Constraint> {
        let mut constraints: Vec<Constraint> = Vec::new();
        for (i, written) in section.constraints.iter().enumerate() {
            let at = format!("optimise.constraints[{i}]");
            let is_floor = written.at_least.is_some();
            let Some(limit) = written.at_most.as_ref().or(written.at_least.as_ref()).cloned() else { continue };
            let constraint = Constraint { measure: written.measure.clone(), is_floor, limit, at };
            let same = |c: &Constraint| (&c.measure, c.is_floor) == (&constraint.measure, constraint.is_floor);
            if constraints.iter().any(same) {
                let found = format!("a second `{}` for `{}`", constraint.key(), constraint.measure);
                self.error(&format!("{}.measure", constraint.at), found, "one limit to each side", None);
            }
            constraints.push(constraint);
        }
        constraints
    }

    fn front(&mut self, section: &OptimiseSection, goals: usize) {
        let Some(front) = section.front else { return };
        if !FRONT.contains(&front) {
            let expected = format!("a whole number from {} to {}", FRONT.start(), FRONT.end());
            self.error("optimise.front", front.to_string(), &expected, None);
        }
        if !(2..=MOST_GOALS).contains(&goals) {
            let hint = "[[optimise.goals]] for each".to_owned();
            let expected = format!("2 to {MOST_GOALS} goals");
            self.error("optimise.front", format!("a front of {goals} goals"), &expected, Some(hint));
        }
    }

    fn quantile(&mut self, section: &OptimiseSection) {
        let Some(quantile) = section.quantile else { return };
        if !(0.5..=1.0).contains(&quantile) {
            let hint =
                "of a measure that is minimised 0.95 is the 95 % quantile, of one that is maximised the 5 % quantile";
            let found = format!("a quantile of {quantile}");
            self.error("optimise.quantile", found, "a number from 0.5 to 1", Some(hint.to_owned()));
        }
        if self.text.section.ensemble.is_none() {
            let hint = "[ensemble] with `members = 32`".to_owned();
            self.error("optimise.quantile", "a quantile without an ensemble", "an [ensemble]", Some(hint));
        }
    }
}

/// Whether a caveat's name is among those that a study allows.
pub fn is_allowed(allowed: &[String], name: &str) -> bool {
    allowed.iter().any(|of| of.strip_suffix('*').map_or(of == name, |stem| name.starts_with(stem)))
}
