//! A low-pass for places and angles of a table whose derivatives are wanted.
//!
//! z minimises Σ hᵢ (yᵢ − zᵢ)² + μ ∫ z″² dt. At even times this is a filter without phase lag with the response of a two-pole Butterworth filter
//! run forward and backward, 1/(1 + (√2 − 1)(f/f_c)⁴); at the ends the second derivative falls to zero, as that of a natural spline does,
//! and nothing is reflected. A straight line passes unchanged. Times may be uneven.

use super::{SignalError, require_positive, require_same_length, require_samples};
use std::f64::consts::{PI, SQRT_2};

/// Weight of the squared second differences against the squared deviations.
pub(super) fn weight(cutoff_hz: f64, dt_s: f64) -> f64 {
    let lift = 2.0 * libm::sin(PI * cutoff_hz * dt_s);
    (SQRT_2 - 1.0) / (lift * lift * lift * lift)
}

/// Low-pass filtered values, 3 dB down at `cutoff_hz`.
///
/// # Errors
/// Fewer than three values, different lengths, times that do not increase, a value that is not finite, a frequency that is not positive or not
/// below half the sample rate.
pub fn smooth(time_s: &[f64], values: &[f64], cutoff_hz: f64) -> Result<Vec<f64>, SignalError> {
    require_positive("cut-off frequency (Hz)", cutoff_hz)?;
    require_samples("values to smooth", values, 1.0, 3)?;
    require_same_length("times", time_s, values)?;
    if let Some(i) = (1..time_s.len()).find(|&i| time_s[i] <= time_s[i - 1]) {
        return Err(SignalError::NotIncreasing { index: i, found_s: time_s[i], previous_s: time_s[i - 1] });
    }
    let usual_s = super::flaws::usual_interval(time_s);
    if cutoff_hz * usual_s >= 0.5 {
        return Err(SignalError::CornerAboveNyquist { corner_hz: cutoff_hz, nyquist_hz: 0.5 / usual_s });
    }
    let last = values.len() - 1;
    // what a straight line between the ends leaves: small numbers
    let slope = (values[last] - values[0]) / (time_s[last] - time_s[0]);
    let line = |i: usize| values[0] + slope * (time_s[i] - time_s[0]);
    let rest: Vec<f64> = (0..=last).map(|i| values[i] - line(i)).collect();
    let smoothed = solved(bands(time_s, weight(cutoff_hz, usual_s), usual_s), rest, time_s, usual_s);
    Ok(smoothed.iter().enumerate().map(|(i, z)| z + line(i)).collect())
}

/// Time span of a sample, relative to the usual interval.
fn share(time_s: &[f64], i: usize, usual_s: f64) -> f64 {
    let (before, after) = (i.saturating_sub(1), (i + 1).min(time_s.len() - 1));
    let halves = if before == i || after == i { 1.0 } else { 0.5 };
    halves * (time_s[after] - time_s[before]) / usual_s
}

/// Diagonal and two upper bands of H + λ Dᵀ W D, D the second divided differences.
fn bands(time_s: &[f64], weight: f64, usual_s: f64) -> Vec<[f64; 3]> {
    let mut bands: Vec<[f64; 3]> = (0..time_s.len()).map(|i| [share(time_s, i, usual_s), 0.0, 0.0]).collect();
    for i in 0..time_s.len() - 2 {
        let (h, g) = ((time_s[i + 1] - time_s[i]) / usual_s, (time_s[i + 2] - time_s[i + 1]) / usual_s);
        let length = 0.5 * (h + g);
        let row = [1.0 / (h * length), -(1.0 / h + 1.0 / g) / length, 1.0 / (g * length)];
        for (a, first) in row.iter().enumerate() {
            for (b, second) in row.iter().enumerate().skip(a) {
                bands[i + a][b - a] += weight * length * first * second;
            }
        }
    }
    bands
}

/// Solution z of the banded system with right side H y, by its Cholesky factors L D Lᵀ.
fn solved(mut bands: Vec<[f64; 3]>, rest: Vec<f64>, time_s: &[f64], usual_s: f64) -> Vec<f64> {
    let n = bands.len();
    let mut z: Vec<f64> = rest.iter().enumerate().map(|(i, y)| y * share(time_s, i, usual_s)).collect();
    for i in 0..n {
        let [pivot, one, two] = bands[i];
        let (l1, l2) = (one / pivot, two / pivot);
        if i + 1 < n {
            bands[i + 1][0] -= l1 * one;
            bands[i + 1][1] -= l1 * two;
            z[i + 1] -= l1 * z[i];
        }
        if i + 2 < n {
            bands[i + 2][0] -= l2 * two;
            z[i + 2] -= l2 * z[i];
        }
        bands[i] = [pivot, l1, l2];
    }
    for i in (0..n).rev() {
        let [pivot, l1, l2] = bands[i];
        z[i] = z[i] / pivot - z.get(i + 1).map_or(0.0, |next| l1 * next) - z.get(i + 2).map_or(0.0, |next| l2 * next);
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(n: u32, dt_s: f64) -> Vec<f64> {
        (0..n).map(|i| f64::from(i) * dt_s).collect()
    }

    #[test]
    fn lines_pass_and_a_tone_is_3_db_down_at_the_cutoff() {
        let time_s = times(600, 0.005);
        let line: Vec<f64> = time_s.iter().map(|t| 3.0 - 25.0 * t).collect();
        let same = smooth(&time_s, &line, 8.0).unwrap();
        assert!(same.iter().zip(&line).all(|(a, b)| (a - b).abs() < 1e-9));
        for hz in [2.0, 8.0, 16.0, 32.0] {
            let ratio = (PI * hz * 0.005).sin() / (PI * 8.0 * 0.005).sin();
            let share = 1.0 / (1.0 + (SQRT_2 - 1.0) * ratio.powi(4));
            let tone: Vec<f64> = time_s.iter().map(|t| (2.0 * PI * hz * t).sin()).collect();
            let out = smooth(&time_s, &tone, 8.0).unwrap();
            let project = |y: &[f64]| (200..400).map(|i| y[i] * tone[i]).sum::<f64>();
            let found = project(&out) / project(&tone);
            assert!((found - share).abs() < 1e-3, "{hz} {found}");
        }
    }

    #[test]
    fn rounding_to_a_millimetre_is_taken_away_at_uneven_times_too() {
        // 9.8 m/s² from 22 m/s, 100 a second, every seventh sample missing
        let time_s: Vec<f64> =
            times(200, 0.01).into_iter().enumerate().filter(|(i, _)| i % 7 != 3).map(|(_, t)| t).collect();
        let place = |t: f64| 22.137 * t - 4.9137 * t * t;
        let rounded: Vec<f64> = time_s.iter().map(|t| (place(*t) * 1e3).round() / 1e3).collect();
        let error = |z: &[f64]| {
            let second = |i: usize| {
                let (h, g) = (time_s[i] - time_s[i - 1], time_s[i + 1] - time_s[i]);
                2.0 * ((z[i + 1] - z[i]) / g - (z[i] - z[i - 1]) / h) / (h + g)
            };
            (20..150).map(|i| (second(i) + 9.8274).abs()).fold(0.0, f64::max)
        };
        let (raw, mended) = (error(&rounded), error(&smooth(&time_s, &rounded, 10.0).unwrap()));
        // as an independent program has it
        assert!((raw - 10.1726).abs() < 1e-6 && (mended - 1.019_521_0).abs() < 1e-6, "{raw} {mended}");
    }

    #[test]
    fn what_cannot_be_smoothed_is_refused() {
        let time_s = times(10, 0.01);
        assert!(matches!(smooth(&time_s, &[0.0; 10], 50.0), Err(SignalError::CornerAboveNyquist { .. })));
        assert!(smooth(&time_s, &[0.0; 9], 5.0).is_err() && smooth(&time_s[..2], &[0.0; 2], 5.0).is_err());
        assert!(smooth(&[0.0, 0.0, 1.0], &[0.0; 3], 0.1).is_err() && smooth(&time_s, &[0.0; 10], 0.0).is_err());
    }
}
