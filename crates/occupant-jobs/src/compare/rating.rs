//! Agreement of a computed with a measured history: ISO/TS 18571, CORA, Sprague–Geers and ANOVA of one pair.

use crash_measures::correlation::{CoraSettings, Iso18571Grade, anova, cora, iso18571, sprague_geers};
use crash_measures::signal::{Hole, Interpolant, Interpolation, holes, is_sampled, usual_interval, whole_steps};
use placed_text::number;
use serde::Serialize;
use serde_json::{Map, Value, json};

/// The rate at which all metrics are computed, that of ISO/TS 18571.
pub const RATE_HZ: f64 = 10_000.0;

/// Longest time compared, s.
const LONGEST_S: f64 = 100.0;
/// Longest time for CORA, s, whose cost grows with the square of the time; ISO/TS 18571 has the same bound.
const LONGEST_CORA_S: f64 = 2.0;

/// A history: times, s, and values, SI.
#[derive(Clone, Copy, Debug)]
pub struct Track<'a> {
    /// Times, increasing.
    pub time_s: &'a [f64],
    /// Values; NaN where missing.
    pub values: &'a [f64],
}

/// Time window of a comparison.
#[derive(Clone, Copy, Debug, Default)]
pub struct Window {
    /// First time; that of the overlap if absent.
    pub from_s: Option<f64>,
    /// Last time.
    pub to_s: Option<f64>,
    /// Time added to the measured times, s.
    pub shift_s: f64,
}

/// All ratings of a pair.
#[derive(Clone, Debug, Serialize)]
pub struct Rating {
    /// First time compared, s.
    from_s: f64,
    /// Last time compared, s.
    to_s: f64,
    /// Samples compared.
    samples: usize,
    /// Sample rate, 1/s, by linear interpolation.
    rate_hz: f64,
    /// Scores of each metric by its key, null where it cannot be computed.
    #[serde(flatten)]
    scores: Map<String, Value>,
    /// Reasons for missing ratings.
    problems: Vec<String>,
    /// Name of each metric and its scores as text.
    #[serde(skip)]
    words: Vec<(&'static str, String)>,
    /// Largest magnitude of the computed history.
    #[serde(skip)]
    largest_computed: f64,
}

impl Rating {
    /// A score of a metric by its key; none if it was not rated.
    pub fn score(&self, metric: &str, score: &str) -> Option<f64> {
        self.scores.get(metric)?.get(score)?.as_f64()
    }

    /// Largest magnitude of the computed history, SI.
    pub fn largest_computed(&self) -> f64 {
        self.largest_computed
    }

    /// Text lines of a name and its scores; `filter` describes the filter of both sides.
    pub fn lines(&self, filter: &str) -> Vec<(&'static str, String)> {
        let span = format!("{:.1} to {:.1} ms", self.from_s * 1e3, self.to_s * 1e3);
        let mut lines = vec![("compared", format!("{span}, {} samples, filter {filter}", self.samples))];
        lines.extend(self.words.iter().cloned());
        lines.extend(self.problems.iter().map(|p| ("not rated", p.clone())));
        lines
    }
}

/// Both histories on the common grid.
struct Sampled {
    measured: Vec<f64>,
    computed: Vec<f64>,
    from_s: f64,
    to_s: f64,
}

/// Scores of a metric: as JSON and as text.
type Scores = Result<(Value, String), String>;

/// A metric: its key in JSON, its name, its scores.
type Metric = (&'static str, &'static str, fn(&Sampled) -> Scores);

const METRICS: [Metric; 4] = [
    ("iso18571", "ISO/TS 18571", rate_iso18571),
    ("cora", "CORA", rate_cora),
    ("sprague_geers", "Sprague–Geers", rate_sprague_geers),
    ("anova", "ANOVA", rate_anova),
];

/// Time between samples, s.
const DT_S: f64 = 1.0 / RATE_HZ;

/// Rates a computed history against a measured one, both already filtered.
///
/// # Errors
/// No common time, values that are missing in it.
pub fn rate(computed: Track<'_>, measured: Track<'_>, window: Window) -> Result<Rating, String> {
    let moved: Vec<f64> = measured.time_s.iter().map(|t| t + window.shift_s).collect();
    let measured = Track { time_s: &moved, values: measured.values };
    let [from_s, to_s] = overlap(computed, measured, window)?;
    if to_s - from_s > LONGEST_S {
        return Err(format!(
            "{} s in common: at most {LONGEST_S} s can be compared; select a part with --from and --to",
            to_s - from_s
        ));
    }
    let samples = whole_steps(to_s - from_s, DT_S) + 1;
    let sampled = Sampled {
        measured: sampled(measured, from_s, to_s, samples, "the measured signal")?,
        computed: sampled(computed, from_s, to_s, samples, "the computed history")?,
        from_s,
        to_s,
    };
    let (mut scores, mut words, mut problems) = (Map::new(), Vec::new(), Vec::new());
    for (key, name, metric) in METRICS {
        let score = match metric(&sampled) {
            Ok((score, text)) => {
                words.push((name, text));
                score
            }
            Err(reason) => {
                problems.push(format!("{name}: {reason}"));
                Value::Null
            }
        };
        scores.insert(key.to_owned(), score);
    }
    let to_s = from_s + (samples - 1) as f64 * DT_S;
    let largest_computed = sampled.computed.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    Ok(Rating { from_s, to_s, samples, rate_hz: RATE_HZ, scores, problems, words, largest_computed })
}

/// Scores from 0 to 1, and the lag of the computed history.
fn rate_iso18571(pair: &Sampled) -> Scores {
    let r = iso18571(&pair.measured, &pair.computed, DT_S).map_err(|e| e.to_string())?;
    let grade = match r.grade() {
        Iso18571Grade::Excellent => "excellent",
        Iso18571Grade::Good => "good",
        Iso18571Grade::Fair => "fair",
        Iso18571Grade::Poor => "poor",
    };
    let lag = match r.lag_s {
        0.0 => "not shifted".to_owned(),
        lag if lag > 0.0 => format!("computed {:.1} ms late", lag * 1e3),
        lag => format!("computed {:.1} ms early", -lag * 1e3),
    };
    let words = format!(
        "{:.3} {grade}: corridor {:.3}, phase {:.3}, magnitude {:.3}, slope {:.3}; {lag}",
        r.overall, r.corridor, r.phase, r.magnitude, r.slope
    );
    let score = json!({
        "overall": r.overall, "grade": grade, "corridor": r.corridor, "phase": r.phase, "magnitude": r.magnitude,
        "slope": r.slope, "lag_s": r.lag_s,
    });
    Ok((score, words))
}

/// Scores from 0 to 1, and the interval of evaluation.
fn rate_cora(pair: &Sampled) -> Scores {
    if pair.to_s - pair.from_s > LONGEST_CORA_S {
        return Err(format!("longer than {LONGEST_CORA_S} s: cut to the event"));
    }
    let r = cora(&pair.measured, &pair.computed, DT_S, &CoraSettings::default()).map_err(|e| e.to_string())?;
    let interval_s = r.interval_s.map(|t| t + pair.from_s);
    let words = format!(
        "{:.3}: corridor {:.3}, cross-correlation {:.3} (progression {:.3}, size {:.3}, phase {:.3}); {:.1} to {:.1} ms",
        r.overall,
        r.corridor,
        r.cross_correlation,
        r.progression,
        r.size,
        r.phase,
        interval_s[0] * 1e3,
        interval_s[1] * 1e3
    );
    let score = json!({
        "overall": r.overall, "corridor": r.corridor, "cross_correlation": r.cross_correlation,
        "progression": r.progression, "size": r.size, "phase": r.phase, "interval_s": interval_s,
    });
    Ok((score, words))
}

/// Errors M, P and C; M is positive where the computed history is larger.
fn rate_sprague_geers(pair: &Sampled) -> Scores {
    let r = sprague_geers(&pair.measured, &pair.computed).map_err(|e| e.to_string())?;
    let [magnitude, phase, combined] = [r.magnitude, r.phase, r.combined].map(signed_percent);
    let verdict = if r.accepted() { "all within 40 %" } else { "not all within 40 %" };
    let score = json!({
        "magnitude": r.magnitude, "phase": r.phase, "combined": r.combined, "within_40_percent": r.accepted(),
    });
    Ok((score, format!("magnitude {magnitude}, phase {phase}, combined {combined}; {verdict}")))
}

/// Residuals over the measured peak; the mean is positive where the measured signal is larger.
fn rate_anova(pair: &Sampled) -> Scores {
    let r = anova(&pair.measured, &pair.computed).map_err(|e| e.to_string())?;
    let verdict = if r.accepted() { "within" } else { "not within" };
    let words = format!(
        "mean residual {}, standard deviation {:.1} %; {verdict} 5 % and 35 %",
        signed_percent(r.mean),
        100.0 * r.standard_deviation
    );
    let score = json!({
        "mean": r.mean, "standard_deviation": r.standard_deviation, "within_5_and_35_percent": r.accepted(),
    });
    Ok((score, words))
}

fn signed_percent(part: f64) -> String {
    format!("{:+.1} %", 100.0 * part)
}

/// First and last time common to both histories and the window.
///
/// # Errors
/// There is none.
pub fn overlap(a: Track<'_>, b: Track<'_>, window: Window) -> Result<[f64; 2], String> {
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
                    from.map_or("the start".to_owned(), |t| format!("{} s", number(t))),
                    to.map_or("the end".to_owned(), |t| format!("{} s", number(t)))
                ),
            }
        )),
    }
}

/// Values on the common grid: at [`RATE_HZ`] from `from_s`, interpolated linearly.
///
/// # Errors
/// A value or a row that is missing there.
pub fn sampled(track: Track<'_>, from_s: f64, to_s: f64, samples: usize, what: &str) -> Result<Vec<f64>, String> {
    // the samples of the window and one beyond on each side
    let first = track.time_s.partition_point(|t| *t <= from_s).saturating_sub(1);
    let last = track.time_s.partition_point(|t| *t < to_s).min(track.time_s.len() - 1);
    let (time_s, values) = (&track.time_s[first..=last], &track.values[first..=last]);
    if let Some(gap) = values.iter().position(|v| !v.is_finite()) {
        return Err(format!(
            "{what} has no value at {} s; select a part without gaps with --from and --to",
            time_s[gap]
        ));
    }
    if let Some(hole) = missing_rows(time_s) {
        return Err(format!(
            "{what} has no samples from {} to {} s; select a part without gaps with --from and --to",
            hole.from_s, hole.to_s
        ));
    }
    let line = Interpolant::new(time_s, values, Interpolation::Linear);
    let line = line.map_err(|e| format!("{what}: {e}"))?;
    Ok((0..samples).map(|i| line.value_at(from_s + i as f64 / RATE_HZ)).collect())
}

/// The first place where a sampled signal lacks rows. A single one may be the clock's rounding, and points read from a drawing
/// may be far apart.
fn missing_rows(time_s: &[f64]) -> Option<Hole> {
    let found = if is_sampled(time_s) { holes(time_s) } else { Vec::new() };
    found.into_iter().find(|hole| hole.length_s() > 2.5 * usual_interval(time_s))
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
        let r = found.scores["iso18571"]["overall"].as_f64().unwrap();
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
    fn missing_rows_are_no_straight_line() {
        let ours = grid(0.1, 1e-3, |t| 1.0 + t);
        let without = |rows: std::ops::Range<usize>| {
            let mut theirs = ours.clone();
            theirs.0.drain(rows.clone());
            theirs.1.drain(rows);
            rate(track(&ours), track(&theirs), Window::default())
        };
        assert!(without(40..50).unwrap_err().contains("no samples from 0.039 to 0.05 s"));
        assert!(without(40..41).is_ok());
        // points read from a drawing
        let drawn = [0.0, 0.01, 0.012, 0.015, 0.09, 0.1].map(|t| (t, 1.0 + t));
        let drawn: (Vec<f64>, Vec<f64>) = drawn.into_iter().unzip();
        assert!(rate(track(&ours), track(&drawn), Window::default()).is_ok());
    }

    #[test]
    fn what_cannot_be_rated_is_said() {
        let ours = grid(0.1, 1e-3, |t| t);
        let zero = grid(0.1, 1e-3, |_| 0.0);
        let found = rate(track(&ours), track(&zero), Window::default()).unwrap();
        assert_eq!(found.problems.len(), 4);
        assert!(found.scores["iso18571"].is_null() && found.scores["anova"].is_null());
    }
}
