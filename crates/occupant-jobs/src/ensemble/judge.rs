//! Results of an ensemble that may be quoted as one number.

use occupant_study::spread::{Rule, Spread, Verdict};
use serde::Serialize;

/// A figure with its spread over an ensemble, for tables and JSON; SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Judged {
    /// Its name.
    pub name: String,
    /// Its unit, `1` for a plain number.
    pub unit: String,
    /// Its value in the unchanged run.
    pub nominal: Option<f64>,
    /// Spread of its values.
    #[serde(flatten)]
    pub spread: Spread,
    /// Largest width of the middle 90 % for which it is stable, in its unit.
    pub tolerance: f64,
    /// Whether it may be quoted as one number.
    pub verdict: Verdict,
}

impl Judged {
    /// Assesses a figure from one value per member, the unchanged run first, NaN where missing; `relative` is the
    /// allowed width of the middle 90 % relative to the median. None if no member has a value.
    pub fn of(name: &str, unit: &str, values: &[f64], relative: f64) -> Option<Judged> {
        let spread = Spread::of(values)?;
        let rule = rule_for(name, unit, relative);
        Some(Judged {
            name: name.to_owned(),
            unit: unit.to_owned(),
            nominal: values.first().copied().filter(|x| x.is_finite()),
            tolerance: rule.within(spread.median),
            verdict: spread.verdict(&rule),
            spread,
        })
    }
}

/// The rule by which a figure is assessed.
pub fn rule(name: &str, unit: &str) -> Rule {
    rule_for(name, unit, Rule::default().relative)
}

fn rule_for(name: &str, unit: &str, relative: f64) -> Rule {
    // a time is judged by its plain difference alone: where a clock begins says nothing
    let relative = if unit == "s" { 0.0 } else { relative };
    Rule { relative, absolute: smallest(name, unit), ..Rule::default() }
}

/// Assesses figures (name, unit, one value per member). Figures without values are left out, and times of peaks too
/// small to matter.
pub fn judge<'a>(figures: impl Iterator<Item = (&'a str, &'a str, &'a [f64])>, relative: f64) -> Vec<Judged> {
    let mut judged: Vec<Judged> =
        figures.filter_map(|(name, unit, values)| Judged::of(name, unit, values, relative)).collect();
    let of_nothing = |f: &&Judged| f.spread.greatest.abs() <= smallest(&f.name, &f.unit);
    let nothing = judged.iter().filter(of_nothing);
    let times: Vec<String> = nothing.map(|f| format!("{}_time", f.name)).collect();
    judged.retain(|f| !times.contains(&f.name));
    judged
}

/// Whether a figure is a physical result, not a measure of cost or numerical accuracy.
pub fn is_result(name: &str) -> bool {
    !(name.starts_with("solver.") || name.starts_with("run.") || name == "energy.balance_error")
}

/// Smallest relevant difference, in the unit: below it a figure is stable however small it is.
pub fn smallest(name: &str, unit: &str) -> f64 {
    let index = ["hic", "gsi", "csi"];
    match unit {
        "s" => 0.005,
        "m" => 0.005,
        "m/s" => 0.1,
        // 1 g
        "m/s^2" | "m/s²" => 9.80665,
        "rad" => 1.0_f64.to_radians(),
        "rad/s" => 0.5,
        "rad/s²" => 100.0,
        "N" => 50.0,
        "N·m" => 2.0,
        "J" => 5.0,
        "1" if index.iter().any(|i| name.contains(i)) => 10.0,
        "1" => 0.01,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_figures_and_times_are_judged_by_plain_differences() {
        let relative = Rule::default().relative;
        let verdict = |name, unit, centre: f64, half_width: f64| {
            let values: Vec<f64> = (0..=20).map(|i| centre + half_width * (f64::from(i) / 10.0 - 1.0)).collect();
            Judged::of(name, unit, &values, relative).map(|j| j.verdict)
        };
        // the middle 90 % of evenly spread values is 0.9 of their whole width
        assert_eq!(verdict("a", "N", 1000.0, 55.0), Some(Verdict::Stable));
        assert_eq!(verdict("a", "N", 1000.0, 56.0), Some(Verdict::NotStable));
        assert_eq!(verdict("a", "N", 0.0, 27.0), Some(Verdict::Stable));
        assert_eq!(verdict("a", "s", 10.0, 0.0027), Some(Verdict::Stable));
        assert_eq!(verdict("a", "s", 10.0, 0.0029), Some(Verdict::NotStable));
        assert_eq!(verdict("hic15", "1", 5.0, 5.0), Some(Verdict::Stable));
        assert_eq!(verdict("nij", "1", 0.5, 0.03), Some(Verdict::NotStable));
    }

    #[test]
    fn when_nothing_was_greatest_is_no_figure() {
        let of = |peak: f64| {
            let times: Vec<f64> = (0..12).map(f64::from).collect();
            let figures = [("a.peak", "N", &[peak; 12][..]), ("a.peak_time", "s", &times)];
            judge(figures.into_iter(), Rule::default().relative).len()
        };
        assert_eq!((of(50.0), of(51.0)), (1, 2));
    }

    #[test]
    fn a_figure_that_no_member_has_is_none() {
        assert_eq!(Judged::of("a", "s", &[f64::NAN; 12], 0.1), None);
        let mut some = [1.0; 12];
        some[0] = f64::NAN;
        let judged = Judged::of("a", "s", &some, 0.1);
        let judged = judged.expect("eleven members have it");
        assert_eq!((judged.nominal, judged.verdict), (None, Verdict::NotStable));
    }
}
