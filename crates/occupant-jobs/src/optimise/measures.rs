//! The measures of goals and constraints: their places among the figures of a run, and what they make of a candidate.

use std::collections::BTreeMap;

use occupant_core::results::summary::Figure;
use occupant_study::search::{Rank, Trial};
use occupant_study::spread::quantile;
use occupant_study::{Constraint, Optimise, StudyText};
use placed_text::{Diagnostics, nearest};

/// The goal's clamp, and the scores of candidates that are not allowed: all of the former come first.
const GOAL: f64 = 1e4;
const BEYOND: f64 = 2e4;
const REFUSED: f64 = 4e4;

/// Measures of an optimisation.
pub struct Measures {
    /// Names, units, and places among the figures of the base scenario.
    pub all: Vec<(String, &'static str, usize)>,
    /// Values that count: indices of measures, and whether large values are bad.
    pub uses: Vec<(usize, bool)>,
    /// Goals: index of the value, and its factor in the sum.
    pub goals: Vec<(usize, f64)>,
    /// Divisor of each goal, in its measure's unit.
    pub per: Vec<f64>,
    /// Constraints.
    pub limits: Vec<Limit>,
    /// Runs per candidate.
    members: usize,
    /// Quantile of the members.
    quantile: f64,
}

/// A limit in the unit of its measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Index of the value.
    pub value: usize,
    /// The limit.
    pub limit: f64,
    /// Whether it is the least value allowed.
    pub is_floor: bool,
    /// What an excess is divided by: the limit's size; of a limit of 0 the base scenario's value, or 1.
    size: f64,
}

impl Limit {
    /// By how much a value exceeds it, as a fraction of the limit; negative within it.
    pub fn beyond(&self, value: f64) -> f64 {
        let excess = if self.is_floor { self.limit - value } else { value - self.limit };
        excess / self.size
    }
}

/// Work on the measures of a study, with the problems found so far.
struct Finder<'a> {
    text: &'a StudyText,
    figures: &'a [Figure],
    problems: Vec<Diagnostics>,
    measures: Measures,
    /// Whether the median of the members counts.
    is_median: bool,
}

impl Measures {
    /// Finds the measures of a study among the figures of its base scenario; `base` has their values if it could be run.
    ///
    /// # Errors
    /// Everything that is wrong with them.
    pub fn find(
        text: &StudyText,
        of: &Optimise,
        members: u64,
        figures: &[Figure],
        base: &BTreeMap<String, f64>,
    ) -> Result<Measures, Vec<Diagnostics>> {
        let (all, uses, goals, per, limits) = Default::default();
        let members = members as usize;
        let measures = Measures { all, uses, goals, per, limits, members, quantile: of.quantile };
        let is_median = of.quantile == 0.5;
        let mut finder = Finder { text, figures, problems: Vec::new(), measures, is_median };
        for goal in &of.goals {
            let Some(at) = finder.value(&goal.measure, !goal.is_maximised, &goal.at) else { continue };
            let unit = finder.unit(at);
            let own = base.get(&goal.measure).copied();
            let per = match &goal.per {
                Some(written) => finder.number(&goal.at_per, written, unit),
                None => own.map(f64::abs).filter(|x| *x > 0.0),
            };
            let given = goal.per.is_some();
            match per.filter(|per| *per > 0.0 && per.is_finite() && (goal.weight / per).is_finite()) {
                Some(per) => {
                    let sign = if goal.is_maximised { -1.0 } else { 1.0 };
                    finder.measures.goals.push((at, sign * goal.weight / per));
                    finder.measures.per.push(per);
                }
                None if given && per.is_none() => {}
                None => {
                    let (path, found) = match given {
                        true => (&goal.at_per, "a divisor that is not above 0, or too small".to_owned()),
                        false => {
                            (&goal.at, format!("the base scenario has no value of `{}` to divide by", goal.measure))
                        }
                    };
                    let hint = format!("[[optimise.goals]] with minimise = \"{}\" and per = …", goal.measure);
                    finder.complain(path, found, "a divisor above 0", Some(hint));
                }
            }
        }
        for constraint in &of.constraints {
            finder.limit(constraint, base);
        }
        if finder.problems.is_empty() { Ok(finder.measures) } else { Err(finder.problems) }
    }

    /// Values that count from those of all members: each measure's, or its quantile to the bad side.
    pub fn values(&self, parts: &[f64]) -> Vec<f64> {
        let count = self.all.len();
        if parts.len() != count * self.members {
            return vec![f64::NAN; self.uses.len()];
        }
        let of = |(measure, high_is_bad): &(usize, bool)| {
            let members: Vec<f64> = (0..self.members).map(|m| parts[m * count + measure]).collect();
            let p = if *high_is_bad { self.quantile } else { 1.0 - self.quantile };
            if self.members == 1 { members[0] } else { quantile(&members, p).unwrap_or(f64::NAN) }
        };
        self.uses.iter().map(of).collect()
    }

    /// Name of a value that counts.
    pub fn name(&self, value: usize) -> String {
        let (measure, high_is_bad) = self.uses[value];
        let name = &self.all[measure].0;
        let percent = 100.0 * if high_is_bad { self.quantile } else { 1.0 - self.quantile };
        if self.members == 1 { name.clone() } else { format!("{name}.q{}", (percent * 1e6).round() / 1e6) }
    }

    /// Unit of a value that counts.
    pub fn unit(&self, value: usize) -> &'static str {
        self.all[self.uses[value].0].1
    }

    /// The weighted sum of the goals.
    pub fn goal(&self, values: &[f64]) -> f64 {
        self.terms(values).iter().sum()
    }

    /// Each goal times its weight over its divisor.
    fn terms(&self, values: &[f64]) -> Vec<f64> {
        self.goals.iter().map(|(at, factor)| factor * values[*at]).collect()
    }

    /// Goal and limits of a candidate.
    pub fn trial(&self, parts: &[f64], has_caveats: bool) -> Trial {
        if parts.is_empty() {
            return Trial::failed();
        }
        let values = self.values(parts);
        let beyond = self.limits.iter().map(|limit| limit.beyond(values[limit.value])).collect();
        Trial { goal: self.goal(&values), parts: self.terms(&values), beyond, is_refused: has_caveats }
    }

    /// The score of a candidate, in the order of the ranking.
    pub fn score(trial: &Trial) -> f64 {
        match trial.rank() {
            Rank::Allowed(goal) => goal.clamp(-GOAL, GOAL),
            Rank::Beyond(sum) => BEYOND + sum.min(GOAL),
            Rank::Refused(sum) => REFUSED + sum.min(GOAL),
            Rank::Failed => f64::INFINITY,
        }
    }

    /// A score as words.
    pub fn told(score: f64) -> String {
        match score {
            s if s <= GOAL => format!("goal {s:.5}"),
            s if s < REFUSED => "no candidate within all limits yet".to_owned(),
            s if s < 2.0 * REFUSED => "no candidate without caveats yet".to_owned(),
            _ => "no completed run yet".to_owned(),
        }
    }
}

impl Finder<'_> {
    fn complain(&mut self, at: &str, found: String, expected: &str, hint: Option<String>) {
        self.problems.push(self.text.complaint(at, found, expected, hint));
    }

    fn unit(&self, value: usize) -> &'static str {
        self.measures.unit(value)
    }

    fn number(&mut self, at: &str, written: &placed_text::Value, unit: &str) -> Option<f64> {
        self.text.measured(at, written, unit).map_err(|problems| self.problems.push(problems)).ok()
    }

    /// Index of the value of a measure.
    fn value(&mut self, name: &str, high_is_bad: bool, at: &str) -> Option<usize> {
        let Some(place) = self.figures.iter().position(|figure| figure.name == name) else {
            let names = self.figures.iter().map(|figure| figure.name.as_str());
            let hint = match nearest(name, names) {
                Some(name) => format!("did you mean `{name}`?"),
                None => "`occupant run` with --json prints all measures of a scenario".to_owned(),
            };
            self.complain(at, format!("there is no measure `{name}`"), "a measure of the scenario", Some(hint));
            return None;
        };
        let Measures { all, uses, members, .. } = &mut self.measures;
        let measure = all.iter().position(|(known, ..)| known == name).unwrap_or_else(|| {
            all.push((name.to_owned(), self.figures[place].unit, place));
            all.len() - 1
        });
        let wanted = (measure, high_is_bad);
        // of one run, and of the median, both sides have the same value
        let is_one = *members == 1 || self.is_median;
        let same = |of: &(usize, bool)| if is_one { of.0 == measure } else { *of == wanted };
        Some(uses.iter().position(same).unwrap_or_else(|| {
            uses.push(wanted);
            uses.len() - 1
        }))
    }

    fn limit(&mut self, constraint: &Constraint, base: &BTreeMap<String, f64>) {
        let (is_floor, at) = (constraint.is_floor, &constraint.at);
        let Some(value) = self.value(&constraint.measure, !is_floor, &format!("{at}.measure")) else { return };
        let path = format!("{at}.{}", constraint.key());
        let Some(limit) = self.number(&path, &constraint.limit, self.unit(value)) else { return };
        let own = base.get(&constraint.measure).map_or(0.0, |x| x.abs());
        let size = [limit.abs(), own].into_iter().find(|x| *x > 0.0).unwrap_or(1.0);
        let other = self.measures.limits.iter().find(|l| l.value == value && l.is_floor != is_floor);
        let pair = other.map(|other| if is_floor { [limit, other.limit] } else { [other.limit, limit] });
        if pair.is_some_and(|[least, most]| least > most) {
            let found = format!("`at_least` of `{}` is above its `at_most`", constraint.measure);
            self.complain(&path, found, "`at_least` below `at_most`", None);
        }
        self.measures.limits.push(Limit { value, limit, is_floor, size });
    }
}
