//! Difference between a computed and a measured history, as one number: 0 if they are equal.

use super::fit_section::Misfit;
use crash_measures::correlation::iso18571;
use crash_measures::signal::SignalError;

/// Half width of the parabola fitted through a peak, s.
const PEAK_S: f64 = 1e-3;
/// Autocorrelation below which samples count as independent.
const UNRELATED: f64 = 0.05;
/// The 95 % quantile of χ² with one degree of freedom.
const CHI_SQUARE_95: f64 = 3.841_458_820_694_124;

impl Misfit {
    /// Misfit of one channel: both histories with samples `dt_s` apart, over the same times, filtered alike. "iso18571"
    /// needs 10 kHz.
    ///
    /// # Errors
    /// Too few samples, different lengths, a measured history without content.
    pub fn of(self, measured: &[f64], computed: &[f64], dt_s: f64) -> Result<f64, SignalError> {
        crash_measures::correlation::require_pair(measured, computed, dt_s, 2)?;
        match self {
            Misfit::Iso18571 => Ok(1.0 - iso18571(measured, computed, dt_s)?.overall),
            Misfit::Rms => Ok(rms(measured, computed)),
            Misfit::PeakAndTime => Ok(peak_and_time(measured, computed, dt_s)),
        }
    }

    /// Combined misfit of all channels, from their weights and misfits.
    pub fn combined(self, parts: impl Iterator<Item = (f64, f64)>) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (weight, part) in parts {
            sum += weight * self.cost(part);
            weights += weight;
        }
        if self == Misfit::Iso18571 { sum / weights } else { (sum / weights).sqrt() }
    }

    /// Smooth cost with the same minimum: the square of a root mean square.
    pub fn cost(self, misfit: f64) -> f64 {
        if self == Misfit::Iso18571 { misfit } else { misfit * misfit }
    }

    /// The misfit that belongs to a cost.
    pub fn of_cost(self, cost: f64) -> f64 {
        if self == Misfit::Iso18571 { cost } else { cost.max(0.0).sqrt() }
    }

    /// Its name in a study.
    pub fn name(self) -> &'static str {
        match self {
            Misfit::Iso18571 => "iso18571",
            Misfit::Rms => "rms",
            Misfit::PeakAndTime => "peak_and_time",
        }
    }
}

/// √(mean (c − m)²)/max |m|.
fn rms(measured: &[f64], computed: &[f64]) -> f64 {
    let square: f64 = measured.iter().zip(computed).map(|(m, c)| (c - m) * (c - m)).sum();
    (square / measured.len() as f64).sqrt() / greatest(measured)
}

fn greatest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |g: f64, v| g.max(v.abs()))
}

/// √(½ ((p_c/p_m − 1)² + ((t_c − t_m)/T)²)), the computed peak on the same side as the measured one.
fn peak_and_time(measured: &[f64], computed: &[f64], dt_s: f64) -> f64 {
    let upward = |values: &[f64], sign: f64| {
        let mut best = 0;
        for (i, v) in values.iter().enumerate() {
            if sign * v > sign * values[best] {
                best = i;
            }
        }
        vertex(values, best, ((PEAK_S / dt_s).round() as usize).max(1))
    };
    let largest = greatest(measured);
    let sign = if measured.contains(&largest) { 1.0 } else { -1.0 };
    let ((t_m, p_m), (t_c, p_c)) = (upward(measured, sign), upward(computed, sign));
    let peak = p_c / p_m - 1.0;
    let time = (t_c - t_m) / (measured.len() - 1) as f64;
    (0.5 * (peak * peak + time * time)).sqrt()
}

/// Position, in samples, and height of the vertex of the parabola through the largest sample and those `half` to each
/// side.
fn vertex(values: &[f64], at: usize, half: usize) -> (f64, f64) {
    let there = (at as f64, values[at]);
    if at < half || at + half >= values.len() {
        return there;
    }
    let (a, b, c) = (values[at - half], values[at], values[at + half]);
    let bend = a - 2.0 * b + c;
    if bend == 0.0 {
        return there;
    }
    let shift = (0.5 * (a - c) / bend).clamp(-1.0, 1.0);
    (at as f64 + shift * half as f64, b - 0.25 * (a - c) * shift)
}

/// Number of independent samples in a history of residuals: n/(1 + 2Σρ), summed until the autocorrelation ρ is
/// negligible.
pub fn unrelated_samples(residuals: &[f64]) -> f64 {
    let n = residuals.len();
    let square: f64 = residuals.iter().map(|r| r * r).sum();
    if n < 2 || square <= 0.0 {
        return n as f64;
    }
    let mut sum = 0.0;
    for lag in 1..n / 2 {
        let product: f64 = residuals.iter().zip(&residuals[lag..]).map(|(a, b)| a * b).sum();
        let correlation = product / square;
        if correlation < UNRELATED {
            break;
        }
        sum += correlation;
    }
    n as f64 / (1.0 + 2.0 * sum)
}

/// Rise of the sum of squares above its minimum at the border of the 95 % likelihood interval of the parameters: F·χ²/n
/// for normal residuals of unknown variance, n of them independent.
pub fn likelihood_rise(least_cost: f64, unrelated: f64) -> f64 {
    least_cost * CHI_SQUARE_95 / unrelated.max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pulse(shift_s: f64, size: f64) -> Vec<f64> {
        let value = |i: usize| {
            let t = i as f64 * 1e-4 - shift_s;
            -size * occupant_units::trig::exp(-((t - 0.05) / 0.012) * ((t - 0.05) / 0.012))
        };
        (0..=1000).map(value).collect()
    }

    #[test]
    fn the_same_history_has_no_misfit_and_a_worse_one_more() {
        for misfit in [Misfit::Iso18571, Misfit::Rms, Misfit::PeakAndTime] {
            let of = |computed: &[f64]| misfit.of(&pulse(0.0, 100.0), computed, 1e-4).unwrap();
            // measured: 0 to 2.3e-16
            assert!(of(&pulse(0.0, 100.0)).abs() < 1e-15);
            let (little, much) = (of(&pulse(1e-3, 105.0)), of(&pulse(8e-3, 140.0)));
            assert!(0.0 < little && little < 0.5 * much, "{little} {much}");
        }
    }

    #[test]
    fn peak_and_time_are_found_between_samples() {
        let found = Misfit::PeakAndTime.of(&pulse(0.0, 100.0), &pulse(2.5e-4, 110.0), 1e-4);
        // 10 % of the peak, 0.25 of 100 ms
        let wanted = (0.5 * (0.1_f64 * 0.1 + 0.0025 * 0.0025)).sqrt();
        // measured: 7e-7; the parabola is not the bell
        assert!((found.unwrap() - wanted).abs() < 1e-5);
    }

    #[test]
    fn weights_share_what_channels_contribute() {
        let parts = [(1.0, 0.3), (3.0, 0.1)];
        let of = |misfit: Misfit| misfit.combined(parts.into_iter());
        assert!((of(Misfit::Iso18571) - 0.15).abs() < 1e-15);
        assert!((of(Misfit::Rms) - (0.12_f64 / 4.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn averaged_noise_is_worth_fewer_samples() {
        let noise = |i: u64| crate::random::unit(1, crate::random::Purpose::MonteCarlo, i, 0) - 0.5;
        let white: Vec<f64> = (0..4000).map(noise).collect();
        let found = unrelated_samples(&white);
        assert!((3500.0..=4000.0).contains(&found), "{found}");
        // the mean of ten neighbours: 1 + 2·Σ(1 − k/10) = 10
        let mean: Vec<f64> = white.windows(10).map(|w| w.iter().sum()).collect();
        let found = unrelated_samples(&mean);
        assert!((330.0..=520.0).contains(&found), "{found}");
    }
}
