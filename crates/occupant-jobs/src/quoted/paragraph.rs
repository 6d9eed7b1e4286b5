//! The paragraph of a figure that can be quoted.

use occupant_study::certainty::Quantile;

use super::{About, Exceeded, Sampling, Statement};
use crate::base::shown::with_unit;
use crate::base::{Told, Units};

/// The paragraph: what was simulated, what was varied, what was left out, what came of it, how certain it is.
pub fn paragraph(about: &About, of: &Statement, units: Units) -> String {
    let unit = units.told(&of.unit);
    let case = of.case.as_ref().map(|case| format!(" with {case}")).unwrap_or_default();
    let mut sentences = vec![format!("{}{case}: {}.", of.figure, about.simulated)];
    sentences.push(match about.varied.is_empty() {
        true => "No input was varied.".to_owned(),
        false => format!("Varied: {}.", about.varied.join("; ")),
    });
    sentences.push(left_out(of, about));
    sentences.extend(middle(about, of, &unit));
    sentences
        .extend(of.unchanged.map(|x| format!("The unchanged run has {}; it is not counted.", with_unit(x, &unit))));
    sentences.extend(of.limits.iter().map(|limit| over(limit, about, of, &unit)));
    let [some, all] = of.runs_with_caveats;
    if some > 0 {
        let names = of.caveats.join(", ");
        sentences.push(format!(
            "In {some} of {all} runs this figure has caveats, and should not be quoted without them: {names}."
        ));
    }
    sentences.push(certainty(about));
    sentences.join(" ")
}

fn counted(n: u64, about: &About) -> String {
    format!("{n} {}", about.each[usize::from(n != 1)])
}

fn left_out(of: &Statement, about: &About) -> String {
    let all: u64 = of.left_out.iter().map(|left| left.runs).sum();
    if all == 0 {
        return format!("No {} is left out.", about.each[0]);
    }
    let each = of.left_out.iter().map(|left| format!("{} {}", left.runs, left.reason));
    format!("Left out: {}: {}.", counted(all, about), each.collect::<Vec<_>>().join("; "))
}

/// Median and middle 95 %.
fn middle(about: &About, of: &Statement, unit: &Told) -> Vec<String> {
    let [Some(low), Some(median), Some(high)] = [0.025, 0.5, 0.975].map(|part| of.quantile(part)) else {
        return Vec::new();
    };
    let runs = counted(of.runs as u64, about);
    if of.histogram.is_none() {
        return vec![format!("It is {} in all of {runs}.", with_unit(median.value, unit))];
    }
    let with = |q: &Quantile| match interval(q, unit) {
        Some(interval) => format!("{} (95 % interval {interval})", with_unit(q.value, unit)),
        None => with_unit(q.value, unit),
    };
    let mut all = vec![
        format!("The median of {runs} is {}.", with(median)),
        format!(
            "95 % of the values lie between the 2.5 % quantile, {}, and the 97.5 % quantile, {}.",
            with(low),
            with(high)
        ),
    ];
    all.extend(of.rank_error.map(|error| {
        let most = 100.0 * error;
        format!("The ranks of these quantiles are off by at most {most:.2} % of the {}.", about.each[1])
    }));
    if of.without_intervals.is_none() && of.runs < low.needed {
        all.push(format!(
            "These two quantiles have closed intervals from {} {} on; with fewer, an open end is unknown.",
            low.needed, about.each[1]
        ));
    }
    all
}

/// The interval of a quantile, with open ends where the sample is too small; none if both are.
fn interval(q: &Quantile, unit: &Told) -> Option<String> {
    let value = |x: f64| with_unit(x, unit);
    match (q.low, q.high) {
        (Some(low), Some(high)) => Some(format!("{} to {}", value(low), value(high))),
        (Some(low), None) => Some(format!("from {}, upper end open", value(low))),
        (None, Some(high)) => Some(format!("up to {}, lower end open", value(high))),
        (None, None) => None,
    }
}

/// How often a limit is exceeded.
fn over(limit: &Exceeded, about: &About, of: &Statement, unit: &Told) -> String {
    let found = &limit.found;
    let rules = match (limit.rules.is_empty(), limit.dummy) {
        (true, _) => "the limit asked for".to_owned(),
        (false, dummy) => {
            let dummy = dummy.map(|dummy| format!(", {dummy}")).unwrap_or_default();
            let memory = if limit.quoted { "" } else { ", as generally known" };
            format!("{}{dummy}{memory}", limit.rules.join(", "))
        }
    };
    let most = with_unit(limit.most, unit);
    let start = format!("{} of {} exceed {most} ({rules})", found.above, counted(found.of as u64, about));
    if of.without_intervals.is_some() {
        return format!("{start}.");
    }
    let [p, low, high] = percents([found.probability, found.low, found.high]);
    let wide = found.high - found.low > occupant_study::certainty::NARROW;
    let needed = if wide {
        format!("; for an interval of 10 percentage points it would take about {}", found.needed)
    } else {
        String::new()
    };
    format!("{start}: probability {p} % (95 % interval {low} % to {high} %, Wilson{needed}).")
}

/// What the intervals are, and what they leave out.
fn certainty(about: &About) -> String {
    let model = "Errors of the model and of the assumed inputs come on top";
    match &about.sampling {
        Sampling::None(why) => {
            format!("There are no intervals and no probabilities: {why}. {model}.")
        }
        Sampling::Random => {
            format!(
                "Intervals of quantiles are order statistics; all intervals allow for the number of runs alone. {model}."
            )
        }
        Sampling::Even => format!(
            "Intervals of quantiles are order statistics; all intervals allow for the number of runs alone, as if it were drawn at random: this design is as a rule more exact. {model}."
        ),
    }
}

/// A probability in per cent, to a tenth where that matters.
pub fn percent(p: f64) -> String {
    let x = 100.0 * p;
    let text = if (0.05..10.0).contains(&x) || (x > 90.0 && x < 99.95) { format!("{x:.1}") } else { format!("{x:.0}") };
    // neither 0 nor 100 by rounding
    match text.as_str() {
        "0" if p > 0.0 => format!("{x:.1e}"),
        "100" if p < 1.0 => "above 99.9".to_owned(),
        _ => text,
    }
}

/// The same of a probability and the ends of its interval, with as many digits as tell the ends apart.
fn percents(all: [f64; 3]) -> [String; 3] {
    let apart = |texts: &[String; 3]| all[1] == all[2] || texts[1] != texts[2];
    let finer = (2..=6).map(|digits| all.map(|p| format!("{:.digits$}", 100.0 * p)));
    std::iter::once(all.map(percent)).chain(finer).find(apart).unwrap_or_else(|| all.map(percent))
}

#[cfg(test)]
mod tests {
    use super::{percent, percents};

    #[test]
    fn the_ends_of_a_narrow_interval_are_told_apart() {
        assert_eq!(percents([0.35, 0.2, 0.5]), ["35", "20", "50"]);
        // of ten million runs
        assert_eq!(percents([0.11, 0.1098, 0.1102]), ["11.00", "10.98", "11.02"]);
        assert_eq!(percents([1.0; 3]), ["100"; 3]);
    }

    #[test]
    fn probabilities_are_never_rounded_to_none_or_all() {
        let cases = [(0.0, "0"), (0.0231, "2.3"), (0.35, "35"), (0.953, "95.3"), (0.9999, "above 99.9"), (1.0, "100")];
        for (p, text) in cases {
            assert_eq!(percent(p), text);
        }
        assert_eq!(percent(0.0001), "1.0e-2");
    }
}
