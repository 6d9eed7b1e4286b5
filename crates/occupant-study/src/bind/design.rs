//! The `[design]` of a study, and whether it fits the parameters.

use super::{Binder, table};
use crate::crossing;
use crate::design::Design;
use crate::ensemble::Ensemble;
use crate::parameter::Parameter;
use crate::sobol::MAX_DIMENSIONS;
use occupant_scenario::Resolver;
use placed_text::Problem;

/// Largest number of runs; more would take months and are taken for a typing error.
pub const MOST_RUNS: u64 = 10_000_000;

impl Binder<'_> {
    /// The design of the study; columns of a table of samples may become parameters.
    pub(super) fn design(&mut self, parameters: &mut Vec<Parameter>, resolver: Resolver) -> Design {
        let section = &self.text.section;
        match &section.design {
            None => self.without_design(),
            Some(Design::Table { file, .. }) => {
                Design::Table { file: file.clone(), rows: table::rows(self, file, parameters, resolver) }
            }
            Some(design) => {
                if section.parameters.is_empty() {
                    let expected = "`[[parameters]]`";
                    self.error("design", "a design without parameters", expected, None);
                }
                design.clone()
            }
        }
    }

    fn without_design(&mut self) -> Design {
        let section = &self.text.section;
        if !section.parameters.is_empty() {
            let mut hint = "design = { kind = \"latin_hypercube\", samples = 100 }".to_owned();
            if section.fit.is_some() {
                hint.push_str(", or `occupant fit` for its [fit]");
            }
            if section.optimise.is_some() {
                hint.push_str(", or `occupant optimise` for its [optimise]");
            }
            let expected = "how the samples are chosen";
            self.error("", "parameters without a `design`", expected, Some(hint));
        } else if section.ensemble.is_none() {
            let expected = "`parameters` and a `design`, or an `ensemble`";
            self.error("", "the study varies nothing", expected, None);
        }
        Design::Single
    }

    /// Checks that parameters and design match in kind and number.
    pub(super) fn sizes(&mut self, parameters: &[Parameter], design: &Design, ensemble: Option<&Ensemble>) {
        let levels: Vec<Option<u64>> = parameters.iter().map(|p| p.law.levels()).collect();
        if *design == Design::FullFactorial {
            for (parameter, _) in parameters.iter().zip(&levels).filter(|(_, l)| l.is_none()) {
                let found = format!("`{}` has no list of values", parameter.name);
                let hint = "or choose another design, such as \"latin_hypercube\"".to_owned();
                self.error("design", found, "a `grid` or a `list` for each parameter", Some(hint));
            }
        }
        if design.is_sampled() && !parameters.is_empty() && parameters.iter().all(|parameter| parameter.crossed) {
            let hint = "design = { kind = \"full_factorial\" } runs each combination once".to_owned();
            self.error("design", "all parameters are crossed: nothing is sampled", "a parameter to sample", Some(hint));
        }
        self.limits(parameters.len(), design);
        let members = ensemble.map_or(1, |e| e.members);
        let crossing = crossing(parameters);
        let runs = design.len(&levels).and_then(|n| n.checked_mul(crossing?)?.checked_mul(members));
        if runs.is_none_or(|n| n > MOST_RUNS) {
            let found = runs.map_or("more runs than can be counted".to_owned(), |n| format!("{n} runs"));
            self.error("design", found, format!("at most {MOST_RUNS} runs"), None);
        }
        self.power_of_two(design);
    }

    /// Checks the ranges of a design's numbers.
    fn limits(&mut self, parameters: usize, design: &Design) {
        let most = match design {
            Design::Sobol { .. } => MAX_DIMENSIONS,
            Design::Saltelli { .. } => MAX_DIMENSIONS / 2,
            _ => usize::MAX,
        };
        if parameters > most {
            let found = format!("{} parameters", parameters);
            self.error("design", found, format!("at most {most} in this design"), None);
        }
        if let Design::Morris { levels, .. } = design
            && levels % 2 == 1
        {
            let found = format!("`{levels}` is not an even number");
            self.error("design.levels", found, "an even number of levels, such as 4", None);
        }
        if let Design::Morris { tail, .. } | Design::OneAtATime { tail } = design
            && tail.si() >= 0.5
        {
            self.error("design.tail", format!("a tail of {}", tail.si()), "a part below 0.5", None);
        }
    }

    /// Warns of a number of points that is no power of 2.
    fn power_of_two(&mut self, design: &Design) {
        let (Design::Sobol { samples, .. } | Design::Saltelli { samples, .. }) = design else { return };
        if !samples.is_power_of_two() {
            let near = samples.checked_next_power_of_two().unwrap_or(*samples);
            let found = format!("{samples} points of Sobol's sequence, which is balanced only for powers of 2");
            let hint = format!("samples = {} or {near}", near / 2);
            self.report(Problem::warning("design.samples", found, "a power of 2").with_hint(Some(hint)));
        }
    }
}
