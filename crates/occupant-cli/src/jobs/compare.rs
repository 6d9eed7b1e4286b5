//! How well a computed history follows a measured one: ISO/TS 18571, CORA, Sprague–Geers and ANOVA of one pair.

use crash_measures::correlation::{CoraSettings, Iso18571Grade, anova, cora, iso18571, sprague_geers};
use crash_measures::signal::{Interpolant, Interpolation, whole_steps};
use serde::Serialize;

/// The rate at which all metrics are computed, that of ISO/TS 18571.
pub(crate) const RATE_HZ: f64 = 10_000.0;

/// Longest time compared, s.
const LONGEST_S: f64 = 100.0;
/// Longest time for CORA, s, whose work grows with the square of the time; ISO/TS 18571 has the same bound.
const LONGEST_CORA_S: f64 = 2.0;

/// A history: times, s, and values, SI.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Track<'a> {
    /// Times, increasing.
    pub(crate) time_s: &'a [f64],
    /// Values; NaN where missing.
    pub(crate) values: &'a [f64],
}

/// The part of the time that counts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Window {
    /// First time; that of the overlap if absent.
    pub(crate) from_s: Option<f64>,
    /// Last time.
    pub(crate) to_s: Option<f64>,
    /// Added to the measured times.
    pub(crate) shift_s: f64,
}

/// All ratings of a pair.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Rating {
    /// First time compared, s.
    pub(crate) from_s: f64,
    /// Last time compared, s.
    pub(crate) to_s: f64,
    /// Samples compared.
    pub(crate) samples: usize,
    /// At this rate, 1/s, by straight lines between samples.
    rate_hz: f64,
    /// ISO/TS 18571.
    pub(crate) iso18571: Option<Iso>,
    pub(crate) cora: Option<CoraScores>,
    /// Sprague–Geers.
    pub(crate) sprague_geers: Option<Mpc>,
    pub(crate) anova: Option<Residuals>,
    /// Why a rating is missing.
    pub(crate) problems: Vec<String>,
}

/// Scores of ISO/TS 18571, 0 to 1.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Iso {
    /// R.
    pub(crate) overall: f64,
    pub(crate) grade: &'static str,
    /// Z.
    pub(crate) corridor: f64,
    /// EP.
    pub(crate) phase: f64,
    /// EM.
    pub(crate) magnitude: f64,
    /// ES.
    pub(crate) slope: f64,
    /// By how much the computed history is late, s.
    pub(crate) lag_s: f64,
}

/// Scores of CORA, 0 to 1.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct CoraScores {
    pub(crate) overall: f64,
    pub(crate) corridor: f64,
    pub(crate) cross_correlation: f64,
    /// Its shape.
    pub(crate) progression: f64,
    pub(crate) size: f64,
    pub(crate) phase: f64,
    /// Interval of evaluation, s.
    pub(crate) interval_s: [f64; 2],
}

/// Errors of Sprague and Geers.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Mpc {
    /// M, positive where the computed history is larger.
    pub(crate) magnitude: f64,
    /// P.
    pub(crate) phase: f64,
    /// C.
    pub(crate) combined: f64,
    /// All within 40 %.
    pub(crate) within_40_percent: bool,
}

/// Residuals over the measured peak.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Residuals {
    /// Mean, positive where the measured signal is larger.
    pub(crate) mean: f64,
    pub(crate) standard_deviation: f64,
    /// Mean within 5 %, deviation within 35 %.
    pub(crate) within_5_and_35_percent: bool,
}

/// Rates a computed against a measured history, both filtered already.
///
/// # Errors
/// No common time, values that are missing in it.
pub(crate) fn rate(computed: Track<'_>, measured: Track<'_>, window: Window) -> Result<Rating, String> {
    let moved: Vec<f64> = measured.time_s.iter().map(|t| t + window.shift_s).collect();
    let measured = Track { time_s: &moved, values: measured.values };
    let [from_s, to_s] = overlap(computed, measured, window)?;
    if to_s - from_s > LONGEST_S {
        return Err(format!(
            "{} s in common: at most {LONGEST_S} s are compared; --from and --to choose a part",
            to_s - from_s
        ));
    }
    let samples = whole_steps(to_s - from_s, 1.0 / RATE_HZ) + 1;
    let reference = sampled(measured, from_s, to_s, samples, "the measured signal")?;
    let computed = sampled(computed, from_s, to_s, samples, "the computed history")?;
    let dt_s = 1.0 / RATE_HZ;
    let mut problems = Vec::new();
    let mut note = |name: &str, error: String| problems.push(format!("{name}: {error}"));
    let iso = iso18571(&reference, &computed, dt_s).map_err(|e| note("ISO/TS 18571", e.to_string())).ok();
    let cora = match to_s - from_s <= LONGEST_CORA_S {
        true => {
            cora(&reference, &computed, dt_s, &CoraSettings::default()).map_err(|e| note("CORA", e.to_string())).ok()
        }
        false => {
            let longest = format!("longer than {LONGEST_CORA_S} s: cut to the event");
            note("CORA", longest);
            None
        }
    };
    let mpc = sprague_geers(&reference, &computed).map_err(|e| note("Sprague–Geers", e.to_string())).ok();
    let residuals = anova(&reference, &computed).map_err(|e| note("ANOVA", e.to_string())).ok();
    Ok(Rating {
        from_s,
        to_s: from_s + (samples - 1) as f64 * dt_s,
        samples,
        rate_hz: RATE_HZ,
        iso18571: iso.map(|r| Iso {
            overall: r.overall,
            grade: grade(r.grade()),
            corridor: r.corridor,
            phase: r.phase,
            magnitude: r.magnitude,
            slope: r.slope,
            lag_s: r.lag_s,
        }),
        cora: cora.map(|r| CoraScores {
            overall: r.overall,
            corridor: r.corridor,
            cross_correlation: r.cross_correlation,
            progression: r.progression,
            size: r.size,
            phase: r.phase,
            interval_s: r.interval_s.map(|t| t + from_s),
        }),
        sprague_geers: mpc.map(|r| Mpc {
            magnitude: r.magnitude,
            phase: r.phase,
            combined: r.combined,
            within_40_percent: r.accepted(),
        }),
        anova: residuals.map(|r| Residuals {
            mean: r.mean,
            standard_deviation: r.standard_deviation,
            within_5_and_35_percent: r.accepted(),
        }),
        problems,
    })
}

const fn grade(grade: Iso18571Grade) -> &'static str {
    match grade {
        Iso18571Grade::Excellent => "excellent",
        Iso18571Grade::Good => "good",
        Iso18571Grade::Fair => "fair",
        Iso18571Grade::Poor => "poor",
    }
}

/// First and last time that both have and the window lets.
///
/// # Errors
/// There is none.
pub(crate) fn overlap(a: Track<'_>, b: Track<'_>, window: Window) -> Result<[f64; 2], String> {
    let ends = |t: &[f64]| t.first().copied().zip(t.last().copied());
    let (Some((a0, a1)), Some((b0, b1))) = (ends(a.time_s), ends(b.time_s)) else {
        return Err("a history without samples".to_owned());
    };
    let from_s = a0.max(b0).max(window.from_s.unwrap_or(f64::NEG_INFINITY));
    let to_s = a1.min(b1).min(window.to_s.unwrap_or(f64::INFINITY));
    match to_s > from_s {
        true => Ok([from_s, to_s]),
        false => Err(format!(
            "no common time: the computed history covers {a0} s to {a1} s, the measured signal {b0} s to {b1} s{}",
            match (window.from_s, window.to_s) {
                (None, None) => String::new(),
                (from, to) => format!(
                    ", the window {} to {}",
                    from.map_or("the begin".to_owned(), |t| format!("{t} s")),
                    to.map_or("the end".to_owned(), |t| format!("{t} s"))
                ),
            }
        )),
    }
}

/// Values on the common grid: so many at [`RATE_HZ`] from `from_s` on, by straight lines.
///
/// # Errors
/// A value that is missing there.
pub(crate) fn sampled(
    track: Track<'_>,
    from_s: f64,
    to_s: f64,
    samples: usize,
    what: &str,
) -> Result<Vec<f64>, String> {
    // the samples of the window and one beyond on each side
    let first = track.time_s.partition_point(|t| *t <= from_s).saturating_sub(1);
    let last = track.time_s.partition_point(|t| *t < to_s).min(track.time_s.len() - 1);
    let (time_s, values) = (&track.time_s[first..=last], &track.values[first..=last]);
    if let Some(gap) = values.iter().position(|v| !v.is_finite()) {
        return Err(format!("{what} has no value at {} s; --from and --to choose a part without gaps", time_s[gap]));
    }
    let line = Interpolant::new(time_s, values, Interpolation::Linear);
    let line = line.map_err(|e| format!("{what}: {e}"))?;
    Ok((0..samples).map(|i| line.value_at(from_s + i as f64 / RATE_HZ)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(end_s: f64, dt_s: f64, value: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        let time: Vec<f64> = (0..=whole_steps(end_s, dt_s)).map(|i| i as f64 * dt_s).collect();
        let values = time.iter().map(|t| value(*t)).collect();
        (time, values)
    }

    fn track((time_s, values): &(Vec<f64>, Vec<f64>)) -> Track<'_> {
        Track { time_s, values }
    }

    /// A shift of the measured signal's clock undone is no difference.
    #[test]
    fn a_shift_brings_clocks_together() {
        let pulse = |t: f64| {
            if t < 0.05 { (t * 20.0 * std::f64::consts::PI).sin() } else { 0.0 }
        };
        let ours = grid(0.1, 1e-3, pulse);
        let mut theirs = grid(0.1, 1e-3, pulse);
        theirs.0.iter_mut().for_each(|t| *t += 7.5);
        let window = Window { shift_s: -7.5, ..Window::default() };
        let found = rate(track(&ours), track(&theirs), window).unwrap();
        let r = found.iso18571.unwrap().overall;
        assert!((r - 1.0).abs() < 1e-9, "{r}");
        assert!(rate(track(&ours), track(&theirs), Window::default()).unwrap_err().contains("no common time"));
    }

    #[test]
    fn gaps_count_only_in_the_window() {
        let ours = grid(0.1, 1e-3, |t| 1.0 + t);
        let mut theirs = ours.clone();
        theirs.1[90] = f64::NAN;
        assert!(rate(track(&ours), track(&theirs), Window::default()).unwrap_err().contains("0.09 s"));
        let window = Window { to_s: Some(0.08), ..Window::default() };
        assert_eq!(rate(track(&ours), track(&theirs), window).unwrap().samples, 801);
    }

    #[test]
    fn what_cannot_be_rated_is_said() {
        let ours = grid(0.1, 1e-3, |t| t);
        let zero = grid(0.1, 1e-3, |_| 0.0);
        let found = rate(track(&ours), track(&zero), Window::default()).unwrap();
        assert_eq!(found.problems.len(), 4);
        assert!(found.iso18571.is_none() && found.anova.is_none());
    }
}
