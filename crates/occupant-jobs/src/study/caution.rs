//! Marks for samples that are too small for a result. A number that breaks a rule is marked, not hidden.
//!
//! The limits are ours. Each is the minimum for which the number can be quoted at all: the first digit of an index, a
//! known sign, a linear model that explains most of the variation.

use occupant_study::Design;
use occupant_study::analysis::{Effect, Estimate, RankCorrelation, Regression, SobolIndices, rank_correlation};
use occupant_study::spread::Spread;

use super::gather::Spoiled;
use super::{Gathered, Samples};
use crate::base::shown::part as shown_part;
use crate::sweep::Stored;

/// Largest 95 % interval of an unmarked Sobol index.
const INDEX_WIDTH: f64 = 0.1;
/// Least effective number of points of an unmarked Sobol index: with fewer than 5, one in five intervals misses the
/// truth.
const CARRYING: f64 = 10.0;
/// Number of points without an effect after which it occurs in fewer than 3 of that many, with 95 % confidence.
const UNSEEN: usize = 300;
/// Least number of rows per parameter of an unmarked regression.
const ROWS_PER_PARAMETER: usize = 10;
/// Least R² of an unmarked regression.
const EXPLAINED: f64 = 0.7;
/// Least number of rows of an unmarked rank correlation.
const RANKED_ROWS: usize = 20;
/// Least number of trajectories of unmarked Morris effects.
const TRAJECTORIES: usize = 10;
/// Largest fraction of runs without the figure.
const MISSING: f64 = 0.05;
/// Rank correlation above which a pair of parameters is reported.
const TOGETHER: f64 = 0.3;
/// Largest number of such pairs.
const NAMED: usize = 3;

/// The rules, for the page and the documentation.
pub fn rules() -> [String; 8] {
    [
        format!("a Sobol index whose 95 % interval is wider than {INDEX_WIDTH}: its first digit is unknown"),
        format!("a Sobol index that depends on fewer than {CARRYING} points: its interval is too narrow"),
        format!(
            "a Morris effect with fewer than {TRAJECTORIES} trajectories, or whose interval is wider than the effect"
        ),
        format!("a rank correlation with fewer than {RANKED_ROWS} rows"),
        format!(
            "a regression with fewer than {ROWS_PER_PARAMETER} rows per parameter, or one that explains less than {EXPLAINED} of the variance"
        ),
        format!(
            "every number of a response that is missing in more than {:.0} % of the runs, because runs seldom fail by chance",
            100.0 * MISSING
        ),
        format!(
            "every number of a response with caveats in more than {:.0} % of the runs, and a worst or best run with a caveat",
            100.0 * MISSING
        ),
        "an unfinished study: its design is valid only as a whole".to_owned(),
    ]
}

/// Reason to mark a rank correlation.
pub fn rank(found: &RankCorrelation) -> Option<String> {
    (found.rows < RANKED_ROWS).then(|| format!("{} rows, fewer than {RANKED_ROWS}", found.rows))
}

/// Reason to mark the coefficients of a regression.
pub fn regression(found: &Regression) -> Option<String> {
    let needed = ROWS_PER_PARAMETER * found.coefficients.len();
    if found.rows < needed {
        return Some(format!("{} rows, fewer than {needed}", found.rows));
    }
    (found.explained < EXPLAINED).then(|| format!("R² is below {EXPLAINED}"))
}

/// Reason to mark an index.
pub fn index(index: &Estimate, parameter: usize, found: &SobolIndices) -> Option<String> {
    if part(found.dropped, found.points + found.dropped) > MISSING {
        let all = found.points + found.dropped;
        return Some(format!("{} of {all} points have runs without a result", found.dropped));
    }
    let unknown = !index.width().is_finite() || index.width() > INDEX_WIDTH;
    if unknown {
        return Some(format!("interval wider than {INDEX_WIDTH}"));
    }
    match found.carrying.get(parameter) {
        Some(0.0) if found.points < UNSEEN => Some(format!("none of {} points shows an effect", found.points)),
        Some(few) if (0.5..CARRYING).contains(few) => Some(format!("depends on {few:.0} of {} points", found.points)),
        _ => None,
    }
}

/// Reason to mark an effect.
pub fn effect(found: &Effect) -> Option<String> {
    if found.effects < TRAJECTORIES {
        return Some(format!("{} trajectories, fewer than {TRAJECTORIES}", found.effects));
    }
    let wide = found.mean_magnitude.width() > found.mean_magnitude.value;
    wide.then(|| "interval wider than the effect".to_owned())
}

/// Reason to mark all numbers of a response: samples without a value.
pub fn lacking(spread: Option<&Spread>) -> Option<String> {
    spread.and_then(|s| missing(s.missing, s.members + s.missing))
}

/// Reason to mark all numbers of a response: its caveats.
pub fn spoiled(found: &Spoiled) -> Option<String> {
    let Spoiled { runs, of, names } = found;
    let names = || names.keys().map(String::as_str).collect::<Vec<_>>().join(", ");
    (part(*runs, *of) > MISSING).then(|| format!("{runs} of {of} runs have caveats on this result: {}", names()))
}

fn missing(missing: usize, rows: usize) -> Option<String> {
    let most = part(missing, rows) > MISSING;
    most.then(|| format!("{missing} of {rows} samples lack this result: the statements apply only to the others"))
}

fn part(some: usize, all: usize) -> f64 {
    some as f64 / all.max(1) as f64
}

/// Notes on the whole study.
pub fn of_the_study(opened: &Stored, gathered: &Gathered) -> Vec<String> {
    let ends = &gathered.ends;
    let mut notes = opened.notes.clone();
    if ends.finished() < ends.planned {
        notes.push(format!(
            "The study is not finished: {} of {} runs. Numbers are those of the finished runs.",
            ends.finished(),
            ends.planned
        ));
    }
    let lost = ends.without_figures();
    if lost as f64 > MISSING * ends.begun() as f64 {
        notes.push(format!(
            "{lost} of {} runs have no valid results. Runs seldom fail by chance, so statements about the others may not apply to all.",
            ends.begun()
        ));
    }
    let caveats: Vec<String> = ends.caveats().collect();
    if !caveats.is_empty() {
        let help = "`occupant run` of such a sample explains the caveats and the results they affect.";
        notes.push(format!("Caveats. {}. {help}", caveats.join("; ")));
    }
    let responses = gathered.samples.responses.iter().map(|response| response.name.as_str()).zip(&gathered.spoiled);
    let present_s = |key: &str| opened.plan.study.base.places(key).ok().and_then(|places| places.first()?.si);
    notes.extend(all_too_coarse(&responses.collect::<Vec<_>>(), present_s));
    let study = &opened.plan.study;
    if !matches!(study.design, Design::Saltelli { .. } | Design::Morris { .. } | Design::OneAtATime { .. }) {
        notes.extend(together(&gathered.samples));
    }
    if study.parameters.is_empty() && study.design == Design::Single {
        notes.push(
            "The study varies only the small changes of its ensemble: there is no parameter to analyse.".to_owned(),
        );
    }
    notes
}

/// What mends readings that are too coarse, of responses of which every value is; `present_s` is the value of a key in the base.
fn all_too_coarse(responses: &[(&str, &Spoiled)], present_s: impl Fn(&str) -> Option<f64>) -> Vec<String> {
    let mends = [("outputs_too_coarse", "output.interval"), ("readings_too_coarse", "integrator.step")];
    let of = |(caveat, key): (&str, &str)| {
        let of_all = |spoiled: &Spoiled| {
            let marked = spoiled.names.iter().filter(|(name, _)| name.ends_with(caveat));
            spoiled.of > 0 && marked.map(|(_, runs)| runs).sum::<usize>() >= spoiled.of
        };
        let figures: Vec<&str> =
            responses.iter().filter(|(_, spoiled)| of_all(spoiled)).map(|(name, _)| *name).collect();
        let told = |s: f64| format!("{} ms", (1e9 * s).round() / 1e6);
        let present = present_s(key).map_or(String::new(), |s| format!(" than {}", told(s)));
        let example = told(present_s(key).map_or(1e-4, |s| 0.5 * s));
        let all = figures.join(", ");
        (!figures.is_empty()).then(|| {
            format!(
                "Every value of {all} is marked {caveat}: a shorter `{key}`{present} mends it, such as set = {{ \"{key}\" = \"{example}\" }}."
            )
        })
    };
    mends.into_iter().filter_map(of).collect()
}

/// Correlated parameters, the strongest pair first: their effects cannot be separated.
fn together(samples: &Samples) -> Vec<String> {
    let numbers: Vec<_> = samples.inputs.iter().filter(|i| i.is_number()).collect();
    let mut pairs = Vec::new();
    for (i, a) in numbers.iter().enumerate() {
        for b in &numbers[..i] {
            match rank_correlation(&b.values, &a.values) {
                Ok(found) if found.rho.value.abs() > TOGETHER && found.rho.is_clear() => {
                    pairs.push((found.rho.value, &b.name, &a.name));
                }
                _ => {}
            }
        }
    }
    pairs.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let words = |(rho, a, b): &(f64, &String, &String)| {
        format!(
            "The samples vary {a} and {b} together (rank correlation {}): the effect of one is partly attributed to the other.",
            shown_part(*rho)
        )
    };
    pairs.iter().take(NAMED).map(words).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_mends_readings_is_said_where_every_value_is_too_coarse() {
        let spoiled = |of: usize, marks: &[(&str, usize)]| Spoiled {
            runs: of,
            of,
            names: marks.iter().map(|(name, runs)| ((*name).to_owned(), *runs)).collect(),
        };
        let [all, some] = [10, 9].map(|runs| spoiled(10, &[("outputs_too_coarse", runs), ("balance", 10)]));
        let [of_steps, none] = [spoiled(10, &[("readings_too_coarse", 10)]), spoiled(0, &[])];
        let responses = [("chest.peak", &all), ("hic15", &some), ("head.peak", &of_steps), ("nij", &none)];
        let said = all_too_coarse(&responses, |key| (key == "output.interval").then_some(0.01));
        assert_eq!(
            said,
            [
                "Every value of chest.peak is marked outputs_too_coarse: a shorter `output.interval` than 10 ms mends it, such as set = { \"output.interval\" = \"5 ms\" }.",
                "Every value of head.peak is marked readings_too_coarse: a shorter `integrator.step` mends it, such as set = { \"integrator.step\" = \"0.1 ms\" }."
            ]
        );
        assert!(all_too_coarse(&responses[1..2], |_| None).is_empty());
    }

    #[test]
    fn a_number_is_marked_exactly_where_a_rule_says_so() {
        let estimate = |low: f64, high: f64| Estimate { value: 0.5 * (low + high), low, high };
        let found = |points, dropped| SobolIndices {
            first: Vec::new(),
            total: Vec::new(),
            second: Vec::new(),
            carrying: vec![20.0, 4.0, 0.0],
            mean: 0.0,
            variance: 1.0,
            points,
            dropped,
        };
        assert_eq!(index(&estimate(0.25, 0.35), 0, &found(100, 5)), None);
        assert!(index(&estimate(0.25, 0.36), 0, &found(100, 0)).is_some());
        assert!(index(&estimate(0.25, f64::NAN), 0, &found(100, 0)).is_some());
        assert!(index(&estimate(0.3, 0.3), 0, &found(94, 6)).is_some());
        assert_eq!(index(&estimate(0.0, 0.01), 1, &found(300, 0)).as_deref(), Some("depends on 4 of 300 points"));
        assert!(index(&estimate(0.0, 0.0), 2, &found(299, 0)).is_some());
        assert_eq!(index(&estimate(0.0, 0.0), 2, &found(300, 0)), None);
        let effect_of = |effects, high| Effect {
            mean: estimate(0.0, 0.0),
            mean_magnitude: estimate(1.0, high),
            deviation: 0.0,
            effects,
            dropped: 0,
        };
        assert_eq!(effect(&effect_of(10, 3.0)), None);
        assert!(effect(&effect_of(9, 1.0)).is_some() && effect(&effect_of(10, 3.1)).is_some());
        let fit = |rows, explained| Regression { coefficients: vec![estimate(0.0, 0.0); 3], explained, rows };
        assert_eq!(regression(&fit(30, 0.7)), None);
        assert!(regression(&fit(29, 0.9)).is_some() && regression(&fit(30, 0.69)).is_some());
        assert_eq!(missing(5, 100), None);
        assert!(missing(6, 100).is_some() && missing(0, 0).is_none());
    }
}
