//! The `[[constraints]]` of a study: linear in the values of its parameters.

use super::{Binder, Purpose};
use crate::design::Design;
use crate::law::{Bounds, Distribution, Law, Value};
use crate::parameter::Parameter;
use crate::relation::{Relation, Within};
use crate::section::LinearConstraintSection;
use crate::{Study, StudyText};
use occupant_scenario::Diagnostics;
use occupant_scenario::kind::{KINDS, RATIO};
use placed_text::{Problem, Value as Written, with_key};

impl Binder<'_> {
    /// The constraints that make sense; a wrong one is reported and left out.
    pub(super) fn relations(&mut self, parameters: &[Parameter], design: &Design) -> Vec<Relation> {
        let sections = &self.text.section.constraints;
        if let (false, Design::Saltelli { .. } | Design::Morris { .. }) = (sections.is_empty(), design) {
            let found = "constraints in a design that is only analysed as a whole";
            let expected = "another design, such as \"sobol\", whose points may be left out one by one";
            let hint = "vary a parameter in a range that keeps the constraint, or as a factor on another".to_owned();
            self.error("constraints", found, expected, Some(hint));
        }
        let mut relations: Vec<Relation> = Vec::new();
        for (n, section) in sections.iter().enumerate() {
            let at = format!("constraints[{n}]");
            let Some(relation) = self.relation(section, &at, (parameters, design)) else { continue };
            if relations.iter().any(|other| other.name == relation.name) {
                let found = format!("two constraints named \"{}\"", relation.name);
                self.error(&format!("{at}.name"), found, "a unique name", None);
            }
            relations.push(relation);
        }
        self.judge_base(&relations, parameters, design);
        self.refuse_empty(&relations, parameters);
        relations
    }

    fn relation(
        &mut self,
        section: &LinearConstraintSection,
        at: &str,
        (parameters, design): (&[Parameter], &Design),
    ) -> Option<Relation> {
        let mut terms: Vec<(usize, f64)> = Vec::new();
        if section.sum.is_empty() {
            let hint = "sum = { \"lap limit\" = 1, \"torso limit\" = -1 }".to_owned();
            self.error(&format!("{at}.sum"), "a sum of nothing", "parameters with their factors", Some(hint));
        }
        for (name, factor) in &section.sum {
            let at = with_key(&format!("{at}.sum"), name);
            let term = self.summand(name, *factor, &at, (parameters, design));
            let first = terms.first().map(|(first, _)| &parameters[*first]);
            let other = term.zip(first).filter(|((i, _), first)| parameters[*i].unit != first.unit);
            if let Some(((i, _), first)) = other {
                let [one, other] = [first, &parameters[i]].map(|of| match of.unit {
                    "" => format!("`{}` is a plain number", of.name),
                    unit => format!("`{}` is in {unit}", of.name),
                });
                self.error(&at, format!("{one}, {other}"), "parameters of one quantity", None);
            }
            terms.extend(term.filter(|_| other.is_none()));
        }
        if terms.len() < section.sum.len() || terms.is_empty() {
            return None;
        }
        let unit = parameters[terms[0].0].unit;
        let least = self.limit(section.min.as_ref(), unit, &format!("{at}.min"));
        let most = self.limit(section.max.as_ref(), unit, &format!("{at}.max"));
        let (least, most) = (least?.unwrap_or(f64::NEG_INFINITY), most?.unwrap_or(f64::INFINITY));
        if section.min.is_none() && section.max.is_none() {
            self.error(at, "a constraint without limits", "`min`, `max` or both", None);
            return None;
        }
        if least > most {
            self.error(&format!("{at}.max"), "`max` is below `min`", "`min` up to `max`", None);
            return None;
        }
        let name = section.name.clone().unwrap_or_else(|| at.to_owned());
        Some(Relation { name, terms, least, most, unit })
    }

    /// Index and factor of a parameter in a sum.
    fn summand(
        &mut self,
        name: &str,
        factor: f64,
        at: &str,
        (parameters, design): (&[Parameter], &Design),
    ) -> Option<(usize, f64)> {
        let Some(i) = parameters.iter().position(|parameter| parameter.name == name) else {
            // a broken parameter has been reported
            if !self.problems.has_errors() || parameters.len() == self.text.section.parameters.len() {
                let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
                self.unknown_name(at, name, &names);
            }
            return None;
        };
        let (parameter, expected) = (&parameters[i], "a parameter that is a number in every sample");
        let mut wrong = |found: String, expected: &str| self.error(at, found, expected, None);
        if factor == 0.0 {
            wrong("a factor of 0".to_owned(), "a number other than 0");
        } else if parameter.crossed {
            wrong(format!("`{name}` is crossed with all samples"), "parameters that are sampled");
        } else if has_words(parameter, i, design) {
            wrong(format!("`{name}` has values that are no numbers"), expected);
        } else if takes_base(i, design) && nominal(parameter).is_none() {
            wrong(
                format!("`{name}` has no single value in the base scenario, which some samples leave as it is"),
                expected,
            );
        } else {
            return Some((i, factor));
        }
        None
    }

    /// A limit in SI units; none if it is wrong, which is reported.
    fn limit(&mut self, written: Option<&Written>, unit: &str, at: &str) -> Option<Option<f64>> {
        let Some(written) = written else { return Some(None) };
        let kind = KINDS.iter().find(|kind| kind.unit.expression() == unit).filter(|_| !unit.is_empty());
        let read = kind.unwrap_or(&KINDS[RATIO]).si(written, self.units());
        read.map(Some).map_err(|error| self.error(at, error.found, error.expected, error.hint)).ok()
    }

    /// Warns of a base scenario that breaks a constraint, where it is run.
    fn judge_base(&mut self, relations: &[Relation], parameters: &[Parameter], design: &Design) {
        let is_search = self.purpose != Purpose::Sweep;
        if relations.is_empty() || !(is_search || matches!(design, Design::OneAtATime { .. })) {
            return;
        }
        let base: Vec<f64> = parameters.iter().map(|parameter| nominal(parameter).unwrap_or(f64::NAN)).collect();
        if let Some(broken) = relations.iter().find_map(|relation| relation.broken(&base)) {
            let found = format!("the base scenario breaks a constraint: {broken}");
            let hint = match is_search {
                true => "it is run for comparison; the search begins at the nearest point that keeps all constraints",
                false => "without its run there is nothing to compare the others with",
            };
            let problem = Problem::warning("constraints", found, "a base scenario that keeps them");
            self.report(problem.with_hint(Some(hint.to_owned())));
        }
    }

    /// Refuses constraints that no point of the ranges keeps, without a look at each sample.
    fn refuse_empty(&mut self, relations: &[Relation], parameters: &[Parameter]) {
        let bounds: Option<Vec<Bounds>> = parameters.iter().map(|parameter| hull(&parameter.law)).collect();
        if !relations.is_empty() && bounds.is_some_and(|bounds| Within::new(relations, &bounds).is_none()) {
            self.error("constraints", "no point of the ranges keeps all of them", "constraints that leave some", None);
        }
    }
}

impl StudyText {
    /// Reports constraints that leave out every sample of a study.
    pub(super) fn refuse_nothing_left(&self, study: &Study) -> Result<(), Diagnostics> {
        let is_left = |sample: u64| study.excluded(sample * study.members()).is_none();
        if study.relations.is_empty() || (0..study.samples()).any(is_left) {
            return Ok(());
        }
        let found = format!("each of the {} samples breaks a constraint", study.samples());
        let first = study.excluded(0).map(|why| format!("of the first, {why}"));
        let mut problems = Diagnostics::new();
        let problem = Problem::error("constraints", found, "constraints that leave some").with_hint(first);
        self.report(&mut problems, problem);
        Err(problems)
    }
}

/// Standard deviations beyond which no value is expected.
const FAR: f64 = 40.0;

/// Ends of all values of a law; none of a table. A law of words has one point, which no constraint uses.
fn hull(law: &Law) -> Option<Bounds> {
    match law {
        Law::List(values) => {
            let number = |value: &Value| if let Value::Number(x) = value { Some(*x) } else { None };
            let numbers = || values.iter().filter_map(number);
            let [from, to] = [numbers().reduce(f64::min), numbers().reduce(f64::max)].map(|end| end.unwrap_or(0.0));
            Some(Bounds { from, to, log: false })
        }
        Law::Distribution(Distribution::Normal { mean, sd }) => {
            Some(Bounds { from: mean - FAR * sd, to: mean + FAR * sd, log: false })
        }
        Law::Table => None,
        law => law.bounds(),
    }
}

/// The value of a parameter in the base scenario, if it is one number.
fn nominal(parameter: &Parameter) -> Option<f64> {
    if let Value::Number(x) = parameter.nominal() { Some(x) } else { None }
}

fn has_words(parameter: &Parameter, i: usize, design: &Design) -> bool {
    match (&parameter.law, design) {
        (Law::List(values), _) => values.iter().any(|value| !matches!(value, Value::Number(_))),
        (Law::Table, Design::Table { rows, .. }) => rows.has_words(i),
        _ => false,
    }
}

/// Whether some samples leave a parameter at the value of the base scenario.
fn takes_base(i: usize, design: &Design) -> bool {
    match design {
        Design::Table { rows, .. } => rows.has_gaps(i),
        design => matches!(design, Design::OneAtATime { .. }),
    }
}
