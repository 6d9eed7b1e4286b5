//! Head injury criterion.
//!
//! HIC_W = max over t₁ < t₂, t₂ − t₁ ≤ W of (t₂ − t₁)·[ 1/(t₂ − t₁) ∫ a dt ]^2.5, with a the
//! resultant acceleration of the head's c.g. in g, its components filtered CFC 1000 first, and t in
//! seconds.
//!
//! Windows on samples are searched first, without pow in the inner loop: with I = ∫ a dt and
//! τ = t₂ − t₁, HIC^0.4 = I·τ^−0.6, so a window beats the best so far if I exceeds best^0.4·τ^0.6.
//! One sample more adds at most a_max·dt to I while the amount needed only grows: the shortfall says
//! how many samples can be skipped. The best window is then refined between samples, on the straight
//! line through them. Known property of the optimum, used as a test: a(t₁) = a(t₂) = 0.6 · mean, or
//! a(t₁) = a(t₂) where the window is at its limit.

use crate::signal::{CumulativeIntegral, STANDARD_GRAVITY_MPS2, SignalError, require_positive, whole_steps};

/// Longest window allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HicWindow {
    /// 15 ms: HIC15.
    Ms15,
    /// 36 ms: HIC36, called HPC in UN rules.
    Ms36,
    /// Any other length, s.
    Other(f64),
}

impl HicWindow {
    /// The length, s.
    #[must_use]
    pub fn seconds(self) -> f64 {
        match self {
            Self::Ms15 => 0.015,
            Self::Ms36 => 0.036,
            Self::Other(seconds) => seconds,
        }
    }
}

/// A head injury criterion and its window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hic {
    /// The criterion, g^2.5·s (by custom written without unit).
    pub value: f64,
    /// t₁, s.
    pub start_s: f64,
    /// t₂, s.
    pub end_s: f64,
}

/// Head injury criterion of a resultant acceleration in m/s².
///
/// A signal shorter than the window is searched as a whole. A signal with no positive window gives
/// zero with an empty window.
///
/// # Errors
/// Fewer than two samples, a sample that is not finite, an interval that is not positive, a window
/// shorter than the interval.
pub fn hic(resultant_mps2: &[f64], dt_s: f64, window: HicWindow) -> Result<Hic, SignalError> {
    let limit_s = window.seconds();
    require_positive("HIC window (s)", limit_s)?;
    let integral = CumulativeIntegral::new(resultant_mps2, dt_s)?;
    let longest = whole_steps(limit_s, dt_s).min(resultant_mps2.len() - 1);
    if longest == 0 {
        return Err(SignalError::TooBrief { what: "HIC window", found_s: limit_s, needed_s: dt_s });
    }
    let Some((start, end)) = best_sampled_window(resultant_mps2, integral.at_samples(), dt_s, longest) else {
        return Ok(Hic { value: 0.0, start_s: 0.0, end_s: 0.0 });
    };
    let sampled = hic_of_window(&integral, start as f64 * dt_s, end as f64 * dt_s);
    Ok(refine(&integral, sampled, dt_s, limit_s.min(integral.duration_s())))
}

/// HIC of a free-motion headform, HIC(d) = 0.75446·HIC + 166.4.
#[must_use]
pub fn hic_d(hic: f64) -> f64 {
    0.754_46 * hic + 166.4
}

/// Best window that starts and ends on samples, as indices; none if no window has a positive integral.
fn best_sampled_window(a: &[f64], integral: &[f64], dt_s: f64, longest: usize) -> Option<(usize, usize)> {
    let peak = a.iter().copied().fold(0.0, f64::max);
    if peak <= 0.0 {
        return None;
    }
    let tau_06: Vec<f64> = (0..=longest).map(|lag| libm::pow(lag as f64 * dt_s, 0.6)).collect();
    let mut search =
        WindowSearch { integral, tau_06: &tau_06, per_gain: 1.0 / (peak * dt_s), best_04: 0.0, window: None };
    // a coarse pass first: a good best lets the full pass skip most windows
    let coarse = (longest / 16).max(1);
    for start in (0..a.len() - 1).step_by(coarse) {
        search.try_start(start, coarse);
    }
    for start in 0..a.len() - 1 {
        search.try_start(start, 1);
    }
    search.window
}

struct WindowSearch<'a> {
    integral: &'a [f64],
    /// τ^0.6 by lag.
    tau_06: &'a [f64],
    /// 1/(a_max·dt): samples per unit of integral at most.
    per_gain: f64,
    /// HIC^0.4 of the best window so far.
    best_04: f64,
    window: Option<(usize, usize)>,
}

impl WindowSearch<'_> {
    /// Tries the windows from `start` whose lags are `stride` apart, skipping those that cannot win.
    fn try_start(&mut self, start: usize, stride: usize) {
        let longest = (self.tau_06.len() - 1).min(self.integral.len() - 1 - start);
        let mut lag = stride;
        while lag <= longest {
            let gain = self.integral[start + lag] - self.integral[start];
            let shortfall = self.best_04 * self.tau_06[lag] - gain;
            if shortfall < 0.0 {
                self.best_04 = gain / self.tau_06[lag];
                self.window = Some((start, start + lag));
            }
            lag = lag.saturating_add(((shortfall * self.per_gain) as usize).max(stride));
        }
    }
}

/// HIC of one window: τ·m^2.5 with m = I/τ in g, and m^2.5 = m²·√m.
fn hic_of_window(integral: &CumulativeIntegral, start_s: f64, end_s: f64) -> Hic {
    let tau_s = end_s - start_s;
    let gain_mps = integral.at(end_s) - integral.at(start_s);
    if tau_s <= 0.0 || gain_mps <= 0.0 {
        return Hic { value: 0.0, start_s, end_s };
    }
    let mean_g = gain_mps / (tau_s * STANDARD_GRAVITY_MPS2);
    Hic { value: tau_s * mean_g * mean_g * mean_g.sqrt(), start_s, end_s }
}

/// Moves both ends between samples by steps that halve while no move helps.
fn refine(integral: &CumulativeIntegral, sampled: Hic, dt_s: f64, limit_s: f64) -> Hic {
    const MOVES: [(f64, f64); 8] =
        [(-1., 0.), (1., 0.), (0., -1.), (0., 1.), (-1., -1.), (1., 1.), (-1., 1.), (1., -1.)];
    let mut best = sampled;
    let mut step_s = 0.5 * dt_s;
    while step_s > 1e-6 * dt_s {
        let mut moved = best;
        let mut improved = false;
        for (at_start, at_end) in MOVES {
            let end_s = (best.end_s + at_end * step_s).min(integral.duration_s());
            let start_s = (best.start_s + at_start * step_s).max(end_s - limit_s).max(0.0);
            let tried = hic_of_window(integral, start_s, end_s.min(start_s + limit_s));
            if tried.value > moved.value {
                moved = tried;
                improved = true;
            }
        }
        if !improved {
            step_s *= 0.5;
        }
        best = moved;
    }
    best
}

#[cfg(test)]
mod tests;
