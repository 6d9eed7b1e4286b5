//! The written numbers of a parameter as a [`Law`] in SI units.

use super::Binder;
use crate::inputs::of_usual;
use crate::law::{Distribution, Law, Value};
use crate::section::{ApplyChoice, GridSection, ParameterSection, ScaleChoice};
use occupant_scenario::Wanted;
use occupant_scenario::kind::{KINDS, Kind, RATIO, UnitSystem};
use placed_text::{Value as Written, did_you_mean, one_of};

/// The built-in distribution for a parameter's only path.
fn usual(binder: &mut Binder, section: &ParameterSection, at: &str) -> Option<Distribution<f64>> {
    let found = section.path.as_deref().and_then(|path| binder.base?.usual(path));
    if found.is_none() || section.apply.unwrap_or_default() != ApplyChoice::Value {
        let expected = "one `path` of a seat, belt, wheel or person that has one, such as `car.seats.driver.track`, `body.stature` beside \
                        `body.sex`; else a `distribution`";
        binder.error(at, "no usual spread is known of this", expected, None);
        return None;
    }
    found.map(of_usual)
}

/// Reading of the values of a parameter.
pub(super) struct Quantities<'w> {
    /// The kind of its numbers; none for names.
    pub(super) kind: Option<&'static Kind>,
    /// Kinds of values that its paths accept.
    pub(super) wanted: &'w Wanted,
    /// Units of bare numbers.
    pub(super) units: UnitSystem,
}

impl Quantities<'_> {
    /// The law that a parameter's section gives.
    pub(super) fn law(&self, binder: &mut Binder, section: &ParameterSection, at: &str) -> Option<Law> {
        if let Some(list) = &section.list {
            return self.list(binder, list, &format!("{at}.list"));
        }
        if self.kind.is_none() {
            let found = format!("numbers for {}", self.wanted.noun());
            binder.error(at, found, "a `list` of values", None);
            return None;
        }
        if let Some(grid) = &section.grid {
            return self.grid(binder, grid, &format!("{at}.grid"));
        }
        if section.usual == Some(true) {
            return usual(binder, section, &format!("{at}.usual")).map(Law::Distribution);
        }
        let distribution = match (&section.range, &section.distribution) {
            (Some(range), _) => {
                let log = range.scale == Some(ScaleChoice::Log);
                self.uniform(binder, &format!("{at}.range"), [&range.from, &range.to], log)
            }
            (None, written) => self.distribution(binder, written.as_ref()?, &format!("{at}.distribution")),
        };
        distribution.map(Law::Distribution)
    }

    /// A number in SI units; a wrong one is reported.
    pub(super) fn number(&self, binder: &mut Binder, free: &Written, at: &str) -> Option<f64> {
        let value = self.kind?.si(free, self.units);
        value.map_err(|error| binder.error(at, error.found, error.expected, error.hint)).ok()
    }

    /// Two bounds in increasing order, both positive on a logarithmic scale.
    fn ends(&self, binder: &mut Binder, at: &str, [from, to]: [&Written; 2], log: bool) -> Option<[f64; 2]> {
        let from = self.number(binder, from, &format!("{at}.from"));
        let to = self.number(binder, to, &format!("{at}.to"));
        let (from, to) = (from?, to?);
        if log && (from <= 0.0 || to <= 0.0) {
            let end = if from <= 0.0 { "from" } else { "to" };
            let found = format!("`{end}` is not above zero on a logarithmic scale");
            binder.error(&format!("{at}.{end}"), found, "two ends above zero", None);
            return None;
        }
        if from >= to {
            let found = if from == to { "`from` and `to` are the same" } else { "`from` is above `to`" };
            binder.error(&format!("{at}.to"), found, "`from` below `to`", None);
            return None;
        }
        Some([from, to])
    }

    fn grid(&self, binder: &mut Binder, grid: &GridSection, at: &str) -> Option<Law> {
        let log = grid.scale == Some(ScaleChoice::Log);
        let [from, to] = self.ends(binder, at, [&grid.from, &grid.to], log)?;
        Some(Law::Grid { from, to, steps: grid.steps, log })
    }

    fn uniform(&self, binder: &mut Binder, at: &str, ends: [&Written; 2], log: bool) -> Option<Distribution<f64>> {
        let [from, to] = self.ends(binder, at, ends, log)?;
        Some(if log { Distribution::LogUniform { from, to } } else { Distribution::Uniform { from, to } })
    }

    fn distribution(&self, binder: &mut Binder, of: &Distribution<Written>, at: &str) -> Option<Distribution<f64>> {
        match of {
            Distribution::Uniform { from, to } => self.uniform(binder, at, [from, to], false),
            Distribution::LogUniform { from, to } => self.uniform(binder, at, [from, to], true),
            Distribution::Normal { mean, sd } => {
                let [mean, sd] = self.mean_and_sd(binder, mean, sd, at)?;
                Some(Distribution::Normal { mean, sd })
            }
            Distribution::TruncatedNormal { mean, sd, from, to } => {
                let ends = self.ends(binder, at, [from, to], false);
                let [mean, sd] = self.mean_and_sd(binder, mean, sd, at)?;
                let [from, to] = ends?;
                // beyond that hardly anything of the bell is left between the ends
                if (from - mean) / sd > 30.0 || (to - mean) / sd < -30.0 {
                    let found = "both ends more than 30 standard deviations from the mean, on one side";
                    binder.error(at, found, "ends that include part of the distribution", None);
                    return None;
                }
                Some(Distribution::TruncatedNormal { mean, sd, from, to })
            }
            Distribution::Triangular { from, mode, to } => {
                let ends = self.ends(binder, at, [from, to], false);
                let mode = self.number(binder, mode, &format!("{at}.mode"))?;
                let [from, to] = ends?;
                if !(from..=to).contains(&mode) {
                    let expected = "a `mode` from `from` to `to`";
                    binder.error(&format!("{at}.mode"), "`mode` outside the ends", expected, None);
                    return None;
                }
                Some(Distribution::Triangular { from, mode, to })
            }
        }
    }

    fn mean_and_sd(&self, binder: &mut Binder, mean: &Written, sd: &Written, at: &str) -> Option<[f64; 2]> {
        let mean = self.number(binder, mean, &format!("{at}.mean"));
        let sd = self.number(binder, sd, &format!("{at}.sd"))?;
        if sd <= 0.0 {
            let found = "a standard deviation that is not above zero";
            binder.error(&format!("{at}.sd"), found, "a standard deviation above zero", None);
            return None;
        }
        Some([mean?, sd])
    }

    fn list(&self, binder: &mut Binder, list: &[Written], at: &str) -> Option<Law> {
        let values: Vec<Option<Value>> =
            list.iter().enumerate().map(|(i, free)| self.item(binder, free, &format!("{at}[{i}]"))).collect();
        values.into_iter().collect::<Option<_>>().map(Law::List)
    }

    /// One value of a list.
    pub(super) fn item(&self, binder: &mut Binder, free: &Written, at: &str) -> Option<Value> {
        if self.kind.is_some() {
            return self.number(binder, free, at).map(Value::Number);
        }
        match (self.wanted, free) {
            (Wanted::Truth, Written::Bool(b)) => Some(Value::Truth(*b)),
            (Wanted::Text, Written::String(text)) => Some(Value::Text(text.clone())),
            (Wanted::Names(names), Written::String(text)) if names.contains(&text.as_str()) => {
                Some(Value::Text(text.clone()))
            }
            (Wanted::Names(names), Written::String(text)) => {
                let found = format!("\"{text}\" is not one of its names");
                binder.error(at, found, one_of(names, '"'), did_you_mean(text, names, '"'));
                None
            }
            _ => {
                let found = format!("{} instead of {}", free.kind(), self.wanted.noun());
                binder.error(at, found, self.wanted.noun(), None);
                None
            }
        }
    }
}

/// The kind of the numbers that a parameter has; none for names.
pub(super) fn kind_of(wanted: &Wanted, apply: ApplyChoice) -> Option<&'static Kind> {
    match (wanted, apply) {
        (_, ApplyChoice::Factor) | (Wanted::Number, _) => Some(&KINDS[RATIO]),
        (Wanted::Quantity(kind), _) => Some(kind),
        _ => None,
    }
}
