//! Average over a sliding window.

use super::{CumulativeIntegral, SignalError, require_positive};

/// Averages over windows of one length that slide over a signal.
///
/// The average is the integral of the straight line through the samples over the window, divided by
/// its length; so end samples of a window count half, and a window need not be a multiple of the
/// interval. Programs that take the plain mean of N samples differ by a term of the order of the
/// interval over the window.
#[derive(Debug, Clone)]
pub struct MovingAverage<'a> {
    integral: CumulativeIntegral<'a>,
    window_s: f64,
    dt_s: f64,
}

/// The largest average and its window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WindowExtreme {
    /// The average with its sign, in the unit of the signal.
    pub value: f64,
    /// Start of the window, s.
    pub start_s: f64,
    /// End of the window, s.
    pub end_s: f64,
}

impl<'a> MovingAverage<'a> {
    /// Prepares averages over `window_s`.
    ///
    /// # Errors
    /// A signal shorter than the window, not finite, or an interval or window that is not positive.
    pub fn new(values: &'a [f64], dt_s: f64, window_s: f64) -> Result<Self, SignalError> {
        require_positive("averaging window (s)", window_s)?;
        let integral = CumulativeIntegral::new(values, dt_s)?;
        let found_s = integral.duration_s();
        if found_s < window_s * (1.0 - 1e-9) {
            return Err(SignalError::TooBrief { what: "signal to average", found_s, needed_s: window_s });
        }
        Ok(Self { integral, window_s, dt_s })
    }

    /// The average over [start, start + window].
    #[must_use]
    pub fn from(&self, start_s: f64) -> f64 {
        (self.integral.at(start_s + self.window_s) - self.integral.at(start_s)) / self.window_s
    }

    /// Start of the last window that fits, s.
    #[must_use]
    pub fn last_start_s(&self) -> f64 {
        (self.integral.duration_s() - self.window_s).max(0.0)
    }

    /// The average of largest magnitude among windows that start at `earliest_s` or later.
    ///
    /// Windows that start at `earliest_s`, at a sample, or end at a sample are tried: between those
    /// the average can exceed them only by a term of second order in the interval.
    ///
    /// # Errors
    /// No window fits after `earliest_s`.
    pub fn extreme_from(&self, earliest_s: f64) -> Result<WindowExtreme, SignalError> {
        let earliest_s = earliest_s.max(0.0);
        let last_s = self.last_start_s();
        if earliest_s > last_s + 1e-9 * self.dt_s {
            return Err(SignalError::TooBrief {
                what: "signal after the given time",
                found_s: self.integral.duration_s() - earliest_s,
                needed_s: self.window_s,
            });
        }
        let mut best_start_s = earliest_s;
        let mut best = self.from(earliest_s);
        let mut consider = |start_s: f64| {
            let value = self.from(start_s);
            if value.abs() > best.abs() {
                (best, best_start_s) = (value, start_s);
            }
        };
        let first = (earliest_s / self.dt_s).ceil() as usize;
        for i in first..self.integral.at_samples().len() {
            let (as_start_s, as_end_s) = (i as f64 * self.dt_s, i as f64 * self.dt_s - self.window_s);
            if as_start_s <= last_s {
                consider(as_start_s);
            }
            if as_end_s >= earliest_s {
                consider(as_end_s);
            }
        }
        Ok(WindowExtreme { value: best, start_s: best_start_s, end_s: best_start_s + self.window_s })
    }
}

/// Averages over every window that starts at a sample and fits: value `i` covers
/// [i·dt, i·dt + window].
///
/// # Errors
/// As [`MovingAverage::new`].
pub fn moving_average(values: &[f64], dt_s: f64, window_s: f64) -> Result<Vec<f64>, SignalError> {
    let average = MovingAverage::new(values, dt_s, window_s)?;
    let count = super::whole_steps(average.last_start_s(), dt_s) + 1;
    Ok((0..count).map(|i| average.from(i as f64 * dt_s)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_average_of_a_ramp_is_its_middle() {
        let ramp: Vec<f64> = (0..101).map(|i| i as f64).collect();
        let averages = moving_average(&ramp, 1e-3, 0.010).unwrap();
        assert_eq!(averages.len(), 91);
        for (i, average) in averages.iter().enumerate() {
            assert!((average - (i as f64 + 5.0)).abs() < 1e-9);
        }
        let off_grid = moving_average(&ramp, 1e-3, 0.0105).unwrap();
        assert!((off_grid[3] - 8.25).abs() < 1e-9);
    }

    #[test]
    fn the_extreme_keeps_its_sign_and_respects_the_earliest_start() {
        let mut values = vec![1.0; 200];
        values[20..60].fill(-50.0);
        let average = MovingAverage::new(&values, 1e-3, 0.010).unwrap();
        let first = average.extreme_from(0.0).unwrap();
        assert!((first.value + 50.0).abs() < 1e-9 && first.start_s >= 0.0199 && first.end_s <= 0.0591);
        let later = average.extreme_from(0.1).unwrap();
        assert!((later.value - 1.0).abs() < 1e-9);
        assert!(matches!(average.extreme_from(0.1985), Err(SignalError::TooBrief { .. })));
        assert!(matches!(MovingAverage::new(&values, 1e-3, 0.3), Err(SignalError::TooBrief { .. })));
    }
}
