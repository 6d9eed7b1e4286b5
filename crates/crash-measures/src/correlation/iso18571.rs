//! Objective rating of ISO/TS 18571: corridor, phase, magnitude and slope.
//!
//! R = 0.4 Z + 0.2 EP + 0.2 EM + 0.2 ES. Formulas and constants as in the open-source OpenVT
//! implementation of the 2024 edition; the document itself was not read.
//!
//! Ours, where the formulas give no number or leave it to rounding: lags whose correlations differ by 1e−12 or less are
//! equal, and the smallest is taken; a constant computed signal correlates with nothing and is rated unshifted; a
//! constant reference is refused, since the slope score would divide by its slope of zero.

use super::{require_pair, shift::best_shift};
use crate::signal::{SignalError, require_positive};

const INTERVAL_S: f64 = 1e-4;
/// Longest signal: time and memory of the warping grow with the square of the length.
const MOST_SAMPLES: usize = 20_000;
const INNER_CORRIDOR: f64 = 0.05;
const OUTER_CORRIDOR: f64 = 0.5;
const LARGEST_SHIFT: f64 = 0.2;
const WARP_WINDOW: f64 = 0.1;
const LARGEST_MAGNITUDE_ERROR: f64 = 0.5;
const LARGEST_SLOPE_ERROR: f64 = 2.0;

/// The four scores and their weighted sum, each from 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iso18571 {
    /// Overall rating R.
    pub overall: f64,
    /// Corridor score Z.
    pub corridor: f64,
    /// Phase score EP.
    pub phase: f64,
    /// Magnitude score EM.
    pub magnitude: f64,
    /// Slope score ES.
    pub slope: f64,
    /// Time by which the computed signal is late at the best correlation, s; negative where early.
    pub lag_s: f64,
}

/// Verbal grade of an overall rating. The bounds are common knowledge, not read in the document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Iso18571Grade {
    /// Above 0.94.
    Excellent,
    /// Above 0.80.
    Good,
    /// Above 0.58.
    Fair,
    /// 0.58 or less.
    Poor,
}

impl Iso18571 {
    /// The grade of the overall rating.
    #[must_use]
    pub fn grade(&self) -> Iso18571Grade {
        match self.overall {
            r if r > 0.94 => Iso18571Grade::Excellent,
            r if r > 0.80 => Iso18571Grade::Good,
            r if r > 0.58 => Iso18571Grade::Fair,
            _ => Iso18571Grade::Poor,
        }
    }
}

/// Rates a computed signal against its reference, both at 10 kHz and synchronised.
///
/// # Errors
/// Fewer than 20 or more than 20 000 samples, different lengths, a sample that is not finite, an interval other than
/// 0.1 ms (the slope score depends on it: resample first), a reference of zeros or without slope.
pub fn iso18571(reference: &[f64], computed: &[f64], dt_s: f64) -> Result<Iso18571, SignalError> {
    require_positive("sample interval (s)", dt_s)?;
    if (dt_s / INTERVAL_S - 1.0).abs() > 1e-3 {
        let expected = "0.0001 s (10 kHz): resample first";
        return Err(SignalError::OutOfRange { what: "sample interval (s)", found: dt_s, expected });
    }
    require_pair(reference, computed, dt_s, 20)?;
    if reference.len() > MOST_SAMPLES {
        let (found, expected) = (reference.len() as f64, "at most 20000 (2 s): cut to the event");
        return Err(SignalError::OutOfRange { what: "number of samples", found, expected });
    }
    let n = reference.len() as f64;
    // floor(0.2 N) in whole numbers
    let shifted = best_shift(reference, computed, reference.len() / 5, pearson);
    let corridor = corridor_score(reference, computed);
    let phase = (1.0 - shifted.lag.unsigned_abs() as f64 / (LARGEST_SHIFT * n)).max(0.0);
    let magnitude = magnitude_score(shifted.reference, shifted.computed)?;
    let slope = slope_score(shifted.reference, shifted.computed)?;
    let overall = 0.4 * corridor + 0.2 * (phase + magnitude + slope);
    Ok(Iso18571 { overall, corridor, phase, magnitude, slope, lag_s: shifted.lag as f64 * dt_s })
}

/// Z: mean of 1 inside the inner corridor, 0 outside the outer one, a parabola between.
fn corridor_score(reference: &[f64], computed: &[f64]) -> f64 {
    let norm = reference.iter().fold(0.0f64, |most, m| most.max(m.abs()));
    super::cora::corridor_mean(reference, computed, INNER_CORRIDOR * norm, OUTER_CORRIDOR * norm, 2.0)
}

/// EM: mean distance of the signals warped onto each other, over the reference.
fn magnitude_score(reference: &[f64], computed: &[f64]) -> Result<f64, SignalError> {
    let (mut difference, mut size) = (0.0, 0.0);
    for (i, j) in warping_path(computed, reference) {
        difference += (computed[i] - reference[j]).abs();
        size += reference[j].abs();
    }
    score(difference, size, LARGEST_MAGNITUDE_ERROR)
}

/// ES: distance of the smoothed derivatives, over that of the reference.
fn slope_score(reference: &[f64], computed: &[f64]) -> Result<f64, SignalError> {
    let (of_reference, of_computed) = (smoothed_slope(reference), smoothed_slope(computed));
    let difference: f64 = of_computed.iter().zip(&of_reference).map(|(c, m)| (c - m).abs()).sum();
    let size: f64 = of_reference.iter().map(|m| m.abs()).sum();
    score(difference, size, LARGEST_SLOPE_ERROR)
}

/// 1 − (difference/size)/largest, not below zero.
fn score(difference: f64, size: f64, largest: f64) -> Result<f64, SignalError> {
    if size == 0.0 {
        return Err(SignalError::NoContent { what: "overlapping part of the reference signal" });
    }
    Ok((1.0 - difference / size / largest).max(0.0))
}

/// Pearson's correlation; NaN (never the best) where a signal is constant.
fn pearson(x: &[f64], y: &[f64]) -> f64 {
    let n = x.len() as f64;
    let (mean_x, mean_y) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let (mut xy, mut xx, mut yy) = (0.0, 0.0, 0.0);
    for (x, y) in x.iter().zip(y) {
        let (dx, dy) = (x - mean_x, y - mean_y);
        xy += dx * dy;
        xx += dx * dx;
        yy += dy * dy;
    }
    // a constant signal keeps a trace of rounding that must not count as variation
    let constant = |squares: f64, mean: f64| squares <= n * (1e-13 * mean) * (1e-13 * mean);
    if constant(xx, mean_x) || constant(yy, mean_y) {
        return f64::NAN;
    }
    (xy / (xx.sqrt() * yy.sqrt())).clamp(-1.0, 1.0)
}

/// Derivative per sample (central differences, one-sided at the ends), averaged over nine samples;
/// over 1, 3, 5, 7 samples at the ends.
fn smoothed_slope(values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let slope: Vec<f64> = (0..=last)
        .map(|i| match i {
            0 => values[1] - values[0],
            i if i == last => values[last] - values[last - 1],
            i => 0.5 * (values[i + 1] - values[i - 1]),
        })
        .collect();
    (0..=last)
        .map(|i| {
            let half = i.min(last - i).min(4);
            slope[i - half..=i + half].iter().sum::<f64>() / (2 * half + 1) as f64
        })
        .collect()
}

/// Steps of a warping path, in the order in which equal costs are preferred.
const STEPS: [(usize, usize); 3] = [(1, 0), (0, 1), (1, 1)];

/// Dynamic time warping of x onto y, equally long: the pairs (i, j) of the path of least summed
/// squared distance with |i − j| less than a tenth of the length, from the end to the start.
fn warping_path(x: &[f64], y: &[f64]) -> Vec<(usize, usize)> {
    let n = x.len();
    let band = ((WARP_WINDOW * n as f64).ceil() as usize).saturating_sub(1);
    let width = 2 * band + 1;
    // row i keeps j = i − band ..= i + band; column of j is j + band − i
    let mut steps = vec![0u8; n * width];
    let mut above = vec![f64::INFINITY; width];
    for i in 0..n {
        let mut row = vec![f64::INFINITY; width];
        for (j, yj) in y.iter().enumerate().take(i + band + 1).skip(i.saturating_sub(band)) {
            let column = j + band - i;
            let from = [
                above.get(column + 1).copied().unwrap_or(f64::INFINITY),
                if column > 0 { row[column - 1] } else { f64::INFINITY },
                above[column],
            ];
            let step = (1..3).fold(0, |best, k| if from[k] < from[best] { k } else { best });
            let before = if i == 0 && j == 0 { 0.0 } else { from[step] };
            row[column] = before + (x[i] - yj) * (x[i] - yj);
            steps[i * width + column] = step as u8;
        }
        above = row;
    }
    let (mut i, mut j) = (n - 1, n - 1);
    let mut path = vec![(i, j)];
    while (i, j) != (0, 0) {
        let (back_i, back_j) = STEPS[usize::from(steps[i * width + j + band - i])];
        (i, j) = (i - back_i, j - back_j);
        path.push((i, j));
    }
    path
}

#[cfg(test)]
mod tests;
