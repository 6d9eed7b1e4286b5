//! CORA rating (Gehre, Gades and Wernicke, ESV 2009; PDB): corridor and cross-correlation.
//!
//! C = 0.5·corridor + 0.5·(0.5·progression + 0.25·size + 0.25·phase). Default constants as in the
//! documentation of a commercial program; formulas from general knowledge of the method, so compare
//! with the original before quoting a rating as CORA's. Ours: the automatic interval is that between
//! the first and last sample above the thresholds, lengthened by `extension` on both sides; the
//! original's further shortening at the end is left out. Give the interval to be certain. Also ours: shifts whose
//! correlations differ by 1e−12 or less are equal, and the smallest is taken.

use super::{require_pair, shift::best_shift};
use crate::signal::{SignalError, require_positive};

/// Interval of evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CoraInterval {
    /// From the first sample of at least `start_threshold` times the reference's largest magnitude to
    /// the last of at least `end_threshold` times it, lengthened by `extension` of its length.
    Automatic {
        /// A_THRES, default 0.03.
        start_threshold: f64,
        /// B_THRES, default 0.075.
        end_threshold: f64,
        /// A_EVAL, default 0.01.
        extension: f64,
    },
    /// Between two times, s, clamped to the record.
    Between {
        /// Start, s.
        start_s: f64,
        /// End, s.
        end_s: f64,
    },
}

/// Constants of the rating.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoraSettings {
    /// Interval of evaluation.
    pub interval: CoraInterval,
    /// Half width of the inner corridor over the largest magnitude, a₀.
    pub inner_corridor: f64,
    /// Half width of the outer corridor over the largest magnitude, b₀.
    pub outer_corridor: f64,
    /// Exponent between the corridors, K.
    pub corridor_exponent: f64,
    /// Exponent of the progression, K_V.
    pub progression_exponent: f64,
    /// Exponent of the size, K_G.
    pub size_exponent: f64,
    /// Exponent of the phase, K_P.
    pub phase_exponent: f64,
    /// Shift that still rates 1, over the interval, D_MIN.
    pub free_shift: f64,
    /// Shift that rates 0, over the interval, D_MAX.
    pub largest_shift: f64,
    /// Least overlap of the shifted signals, over the interval, INT_MIN.
    pub least_overlap: f64,
}

impl Default for CoraSettings {
    fn default() -> Self {
        Self {
            interval: CoraInterval::Automatic { start_threshold: 0.03, end_threshold: 0.075, extension: 0.01 },
            inner_corridor: 0.05,
            outer_corridor: 0.5,
            corridor_exponent: 2.0,
            progression_exponent: 10.0,
            size_exponent: 1.0,
            phase_exponent: 1.0,
            free_shift: 0.01,
            largest_shift: 0.12,
            least_overlap: 0.8,
        }
    }
}

/// The ratings, each from 0 to 1, and the interval used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cora {
    /// Overall rating.
    pub overall: f64,
    /// Corridor rating.
    pub corridor: f64,
    /// Weighted sum of the three below.
    pub cross_correlation: f64,
    /// Progression (shape).
    pub progression: f64,
    /// Size.
    pub size: f64,
    /// Phase.
    pub phase: f64,
    /// Time by which the computed signal is late at the best correlation, s; negative where early.
    pub lag_s: f64,
    /// Interval of evaluation, s.
    pub interval_s: [f64; 2],
}

/// Rates a computed signal against its reference.
///
/// # Errors
/// Fewer than five samples in the record or the interval, different lengths, a sample that is not
/// finite, an interval that is not positive, a reference without content, settings out of order.
pub fn cora(reference: &[f64], computed: &[f64], dt_s: f64, settings: &CoraSettings) -> Result<Cora, SignalError> {
    require_pair(reference, computed, dt_s, 5)?;
    require_order(settings)?;
    let norm = largest(reference);
    let (first, last) = evaluation_interval(reference, dt_s, settings.interval);
    if last < first + 4 {
        let found = (last + 1).saturating_sub(first);
        return Err(SignalError::TooShort { what: "interval of evaluation", found, needed: 5 });
    }
    let (reference, computed) = (&reference[first..=last], &computed[first..=last]);
    if largest(reference) == 0.0 {
        return Err(SignalError::NoContent { what: "reference signal in the interval of evaluation" });
    }
    let (inner, outer) = (settings.inner_corridor * norm, settings.outer_corridor * norm);
    let corridor = corridor_mean(reference, computed, inner, outer, settings.corridor_exponent);

    let ([progression, size, phase], lag) = cross_ratings(reference, computed, settings);
    let cross_correlation = 0.5 * progression + 0.25 * size + 0.25 * phase;
    Ok(Cora {
        overall: 0.5 * corridor + 0.5 * cross_correlation,
        corridor,
        cross_correlation,
        progression,
        size,
        phase,
        lag_s: lag as f64 * dt_s,
        interval_s: [first as f64 * dt_s, last as f64 * dt_s],
    })
}

/// Progression, size and phase at the shift of the largest cross-correlation, and that shift in samples.
fn cross_ratings(reference: &[f64], computed: &[f64], settings: &CoraSettings) -> ([f64; 3], isize) {
    let steps = (reference.len() - 1) as f64;
    let most = ((1.0 - settings.least_overlap) * steps + 1e-9).floor() as usize;
    let shifted = best_shift(reference, computed, most, cross_correlation);
    // V = (½(K + 1))^k; a computed signal of zeros has no K
    let progression = if shifted.agreement.is_finite() {
        libm::pow(0.5 * (shifted.agreement + 1.0), settings.progression_exponent)
    } else {
        0.0
    };
    let size = libm::pow(size_ratio(shifted.reference, shifted.computed), settings.size_exponent);
    let shift = shifted.lag.unsigned_abs() as f64 / steps;
    let in_time = (settings.largest_shift - shift) / (settings.largest_shift - settings.free_shift);
    let phase = libm::pow(in_time.clamp(0.0, 1.0), settings.phase_exponent);
    ([progression, size, phase], shifted.lag)
}

/// Mean over the samples of 1 up to the inner distance, 0 beyond the outer one and
/// ((outer − |d|)/(outer − inner))^exponent between.
pub(super) fn corridor_mean(reference: &[f64], computed: &[f64], inner: f64, outer: f64, exponent: f64) -> f64 {
    let rate = |distance: f64| {
        if distance < inner {
            1.0
        } else if distance > outer {
            0.0
        } else {
            libm::pow((outer - distance) / (outer - inner), exponent)
        }
    };
    reference.iter().zip(computed).map(|(m, c)| rate((c - m).abs())).sum::<f64>() / reference.len() as f64
}

fn require_order(settings: &CoraSettings) -> Result<(), SignalError> {
    require_positive("inner corridor a0", settings.inner_corridor)?;
    require_positive("outer corridor minus inner", settings.outer_corridor - settings.inner_corridor)?;
    require_positive("largest shift minus free shift", settings.largest_shift - settings.free_shift)?;
    for exponent in
        [settings.corridor_exponent, settings.progression_exponent, settings.size_exponent, settings.phase_exponent]
    {
        require_positive("exponent", exponent)?;
    }
    if (0.0..=1.0).contains(&settings.least_overlap) {
        return Ok(());
    }
    Err(SignalError::OutOfRange { what: "least overlap", found: settings.least_overlap, expected: "0 to 1" })
}

/// First and last sample of the interval.
fn evaluation_interval(reference: &[f64], dt_s: f64, interval: CoraInterval) -> (usize, usize) {
    let end = reference.len() - 1;
    match interval {
        CoraInterval::Between { start_s, end_s } => {
            let sample = |t_s: f64| (t_s / dt_s).round().clamp(0.0, end as f64) as usize;
            (sample(start_s), sample(end_s))
        }
        CoraInterval::Automatic { start_threshold, end_threshold, extension } => {
            let norm = largest(reference);
            let first = reference.iter().position(|m| m.abs() >= start_threshold * norm).unwrap_or(0);
            let last = reference.iter().rposition(|m| m.abs() >= end_threshold * norm).unwrap_or(end);
            let more = (extension * last.saturating_sub(first) as f64).round().max(0.0) as usize;
            (first.saturating_sub(more), last.saturating_add(more).min(end))
        }
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

/// K = Σxy/√(Σx²·Σy²)
fn cross_correlation(x: &[f64], y: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    (dot(x, y) / (dot(x, x) * dot(y, y)).sqrt()).clamp(-1.0, 1.0)
}

/// Smaller over larger of Σx² and Σy².
fn size_ratio(x: &[f64], y: &[f64]) -> f64 {
    let square = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
    let (of_x, of_y) = (square(x), square(y));
    if of_x.max(of_y) == 0.0 { 0.0 } else { of_x.min(of_y) / of_x.max(of_y) }
}

#[cfg(test)]
mod tests;
