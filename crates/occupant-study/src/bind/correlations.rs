//! The `[[correlations]]` of a study.

use super::Binder;
use crate::copula::Copula;
use crate::design::Design;
use crate::parameter::Parameter;
use placed_text::{did_you_mean, one_of};

impl Binder<'_> {
    pub(super) fn copula(&mut self, parameters: &[Parameter], design: &Design) -> Option<Copula> {
        let sections = &self.text.section.correlations;
        if sections.is_empty() {
            return None;
        }
        if !design.is_sampled() {
            let expected = "the design \"latin_hypercube\", \"sobol\" or \"monte_carlo\"";
            self.error("correlations", "correlations in a design that does not support them", expected, None);
            return None;
        }
        let mut ranks: Vec<(usize, usize, f64)> = Vec::new();
        for (n, section) in sections.iter().enumerate() {
            let [a, b] = [0, 1].map(|side| self.correlated(parameters, n, side));
            let (Some(a), Some(b)) = (a, b) else { continue };
            if !(-1.0..=1.0).contains(&section.rank) {
                let found = format!("a correlation of {}", section.rank);
                self.error(&format!("correlations[{n}].rank"), found, "a number from -1 to 1", None);
            } else if let Some(crossed) = [a, b].into_iter().find(|i| parameters[*i].crossed) {
                let found = format!("`{}` is crossed with all samples", parameters[crossed].name);
                self.error(&format!("correlations[{n}]"), found, "parameters that are sampled", None);
            } else if a == b || ranks.iter().any(|(x, y, _)| [*x, *y] == [a, b] || [*x, *y] == [b, a]) {
                let found = "a pair of parameters given twice, or a parameter with itself";
                self.error(&format!("correlations[{n}]"), found, "each pair once", None);
            } else {
                ranks.push((a, b, section.rank));
            }
        }
        let copula = Copula::new(parameters.len(), &ranks);
        if copula.is_none() {
            let hint = "if a correlates with b and b with c, then a must correlate with c to some degree".to_owned();
            let found = "correlations that contradict each other: their matrix is not positive definite";
            self.error("correlations", found, "a positive definite matrix", Some(hint));
        }
        copula
    }

    /// The parameter that one side of a correlation names.
    pub(super) fn correlated(&mut self, parameters: &[Parameter], n: usize, side: usize) -> Option<usize> {
        let name = &self.text.section.correlations[n].between[side];
        let found = parameters.iter().position(|p| p.name == *name);
        // a parameter that was left out as broken has been reported already
        if found.is_none() && parameters.len() == self.text.section.parameters.len() {
            let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
            let at = format!("correlations[{n}].between[{side}]");
            self.unknown_name(&at, name, &names);
        }
        found
    }

    pub(super) fn unknown_name(&mut self, at: &str, name: &str, names: &[&str]) {
        let hint = did_you_mean(name, names, '"');
        let found = format!("no parameter is named \"{name}\"");
        self.error(at, found, one_of(names, '"'), hint);
    }
}
