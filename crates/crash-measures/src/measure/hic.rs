//! Head injury criterion.
//!
//! HIC_W = max over t₁ < t₂, t₂ − t₁ ≤ W of (t₂ − t₁)·[ 1/(t₂ − t₁) ∫ a dt ]^2.5, with a the
//! resultant acceleration of the head's c.g. in g, its components filtered CFC 1000 first, and t in
//! seconds.
//!
//! The value is that of the straight line through the samples, over all windows and not only those
//! that start and end on samples: for a smooth pulse the same to many digits; for a spike of a single
//! sample, which the line makes a triangle, up to 39 % more than programs that try pairs of samples.
//!
//! The maximum is found, not approached. With I = ∫ a dt and τ = t₂ − t₁, HIC^0.4 = I·τ^−0.6. The best
//! window either has the length W and a(t₁) = a(t₂), or it starts where the line rises through
//! h = 0.6·I/τ, or with the record above it, and ends where the line falls through h, or with the
//! record. On two straight flanks h follows from a quadratic equation. Most pairs of flanks need no
//! look: a window beats the best so far only if I exceeds best^0.4·τ^0.6. Where no sample is negative,
//! I only grows, so that the next sample with enough of it is found by bisection; else one sample more
//! adds at most a_max·dt, so the shortfall says how many can be skipped. And h of a better window is at
//! least 0.6·best^0.4·W^−0.4: flanks that end below it need no look either.

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

/// Head injury criterion of a resultant acceleration in m/s²: the largest over all windows of the straight line through the
/// samples, wherever they start and end.
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
    if whole_steps(limit_s, dt_s) == 0 {
        return Err(SignalError::TooBrief { what: "HIC window", found_s: limit_s, needed_s: dt_s });
    }
    let limit_s = limit_s.min(integral.duration_s());
    Ok(Search::new(resultant_mps2, integral, dt_s, limit_s).best())
}

/// HIC of a free-motion headform, HIC(d) = 0.75446·HIC + 166.4.
#[must_use]
pub fn hic_d(hic: f64) -> f64 {
    0.754_46 * hic + 166.4
}

/// The search for the best window of a line.
struct Search<'a> {
    a: &'a [f64],
    integral: CumulativeIntegral<'a>,
    dt_s: f64,
    limit_s: f64,
    peak: f64,
    /// Whether no sample is negative: a longer window then gains more.
    only_grows: bool,
    /// τ^0.6 by lag in samples.
    tau_06: Vec<f64>,
    best: Hic,
    /// I·τ^−0.6 of the best window.
    best_04: f64,
    /// What a window must gain at least to be better: I·τ^−0.6 > best^0.4 and I ≤ a_max·τ.
    least_mps: f64,
    /// Level that both ends of a better window have at least, unless it is of the largest length, m/s².
    least_level: f64,
    /// 0.6·W^−0.4.
    level_of_best: f64,
}

/// A rising or falling interval of the line as functions of its level h: t = time + slowness·h, ∫ a dt = integral +
/// ½·slowness·h². At an end of the record the slowness is 0: all levels up to the end value are at that time.
#[derive(Clone, Copy)]
struct Flank {
    slowness: f64,
    time_s: f64,
    integral: f64,
    lowest: f64,
    highest: f64,
}

impl<'a> Search<'a> {
    fn new(a: &'a [f64], integral: CumulativeIntegral<'a>, dt_s: f64, limit_s: f64) -> Self {
        let longest = whole_steps(limit_s, dt_s);
        Search {
            a,
            integral,
            dt_s,
            limit_s,
            peak: a.iter().copied().fold(0.0, f64::max),
            tau_06: (0..=longest).map(|lag| libm::pow(lag as f64 * dt_s, 0.6)).collect(),
            best: Hic { value: 0.0, start_s: 0.0, end_s: 0.0 },
            best_04: 0.0,
            least_mps: 0.0,
            least_level: 0.0,
            level_of_best: 0.6 * libm::pow(limit_s, -0.4),
            only_grows: a.iter().all(|a| *a >= 0.0),
        }
    }

    fn best(mut self) -> Hic {
        if self.peak > 0.0 {
            // a coarse pass first: a good best lets what follows skip most windows
            let coarse = (self.tau_06.len() / 16).max(1);
            (0..self.a.len()).step_by(coarse).for_each(|start| self.try_samples(start, coarse));
            self.try_longest();
            (0..self.a.len()).for_each(|start| self.try_start(start));
        }
        self.best
    }

    /// Keeps a window if it is the best so far.
    fn offer(&mut self, start_s: f64, end_s: f64) {
        let tried = hic_of_window(&self.integral, start_s, end_s);
        if tried.value > self.best.value {
            self.best = tried;
            self.best_04 = libm::pow(tried.value, 0.4) * STANDARD_GRAVITY_MPS2;
            let ratio = self.best_04 / self.peak;
            self.least_mps = self.best_04 * ratio * ratio.sqrt() * (1.0 - 1e-9);
            self.least_level = self.best_04 * self.level_of_best * (1.0 - 1e-9);
        }
    }

    /// The windows of the largest length. While neither end passes a sample the integral over them is a parabola in time,
    /// and the largest is where its growth changes sign, or first or last.
    fn try_longest(&mut self) {
        let last_s = self.integral.duration_s() - self.limit_s;
        let growth =
            |all: &Self, start_s| all.integral.value_at(start_s + all.limit_s) - all.integral.value_at(start_s);
        let steps = (self.limit_s / self.dt_s).ceil();
        let (mut before_s, mut growth_before) = (0.0, Some(0.0));
        for i in 0..=(last_s / self.dt_s) as usize + 1 {
            if !self.may_be_longest(i) {
                growth_before = None;
                continue;
            }
            // a start passes a sample, then an end does
            for start_s in [i as f64 * self.dt_s, (i as f64 + steps) * self.dt_s - self.limit_s] {
                let (start_s, now) = (start_s.min(last_s), growth(self, start_s.min(last_s)));
                let before = growth_before.replace(now).unwrap_or(0.0);
                if before > 0.0 && now < 0.0 {
                    let crest_s = before_s + (start_s - before_s) * before / (before - now);
                    self.offer(crest_s, crest_s + self.limit_s);
                    self.offer(before_s, before_s + self.limit_s);
                }
                if before * now <= 0.0 {
                    self.offer(start_s, start_s + self.limit_s);
                }
                before_s = start_s;
            }
        }
        self.offer(last_s, last_s + self.limit_s);
    }

    /// Whether a window of the largest length that starts after sample `i` − 1 and before `i` + 1 can be better.
    fn may_be_longest(&self, i: usize) -> bool {
        let (sums, last) = (self.integral.at_samples(), self.a.len() - 1);
        let gain = sums[(i + self.tau_06.len() + 1).min(last)] - sums[i.saturating_sub(1).min(last)];
        let least = self.best_04 * self.tau_06.last().copied().unwrap_or(0.0);
        !self.only_grows || gain >= least * (1.0 - 1e-9)
    }

    /// Tries windows from sample `start` to samples `stride` apart.
    fn try_samples(&mut self, start: usize, stride: usize) {
        let sums = self.integral.at_samples();
        let last = (self.tau_06.len() - 1).min(self.a.len() - 1 - start);
        let wins = |lag: &usize| self.best_04 * self.tau_06[*lag] < sums[start + lag] - sums[start];
        let most = |a: &usize, b: &usize| {
            let [a, b] = [a, b].map(|lag| (sums[start + lag] - sums[start]) / self.tau_06[*lag]);
            a.total_cmp(&b)
        };
        if let Some(lag) = (stride..=last).step_by(stride).filter(wins).max_by(most) {
            self.offer(start as f64 * self.dt_s, (start + lag) as f64 * self.dt_s);
        }
    }

    /// Tries windows from the flank before sample `start` to the flanks after all samples within reach; skips those that
    /// cannot win.
    fn try_start(&mut self, start: usize) {
        let rise = if self.a[start] < self.least_level { None } else { self.flank(start, start.checked_sub(1)) };
        let Some(rise) = rise else { return };
        // the flanks extend by at most one interval at each end
        let room = 2.0 * self.peak * self.dt_s;
        let longest = (self.tau_06.len() - 1).min(self.a.len() - 1 - start);
        let mut lag = 0;
        while lag <= longest {
            let end = start + lag;
            let gain = self.integral.at_samples()[end] - self.integral.at_samples()[start];
            let shortfall = (self.best_04 * self.tau_06[lag]).max(self.least_mps) - gain - room;
            if shortfall >= 0.0 {
                lag = self.next_lag(start, lag, shortfall).max(lag + 1);
                continue;
            }
            if self.a[end] >= self.least_level
                && let Some(fall) = self.flank(end, Some(end + 1).filter(|&i| i < self.a.len()))
            {
                self.try_flanks(rise, fall);
            }
            lag += 1;
        }
    }

    /// The next lag of a window that can win, where that of `lag` falls short by so much.
    fn next_lag(&self, start: usize, lag: usize, shortfall: f64) -> usize {
        if !self.only_grows {
            return lag.saturating_add((shortfall / (self.peak * self.dt_s)) as usize);
        }
        // a longer window must gain more
        let sums = &self.integral.at_samples()[start + lag..];
        let needed = sums[0] + shortfall;
        lag + sums.partition_point(|sum| *sum < needed)
    }

    /// The flank from sample `top` down to its neighbour, or the end of the record; none if it does not fall, or is too
    /// flat for the end of a best window, where |ȧ| ≥ 0.4·h/τ.
    fn flank(&self, top: usize, beside: Option<usize>) -> Option<Flank> {
        let highest = self.a[top];
        let (slowness, lowest) = match beside {
            None => (0.0, f64::NEG_INFINITY),
            Some(foot) => ((top as f64 - foot as f64) * self.dt_s / (highest - self.a[foot]), self.a[foot]),
        };
        let falls = highest > lowest && slowness.abs() * 0.4 * lowest.max(0.0) <= self.limit_s * (1.0 + 1e-9);
        (falls && highest > 0.0).then(|| Flank {
            slowness,
            time_s: top as f64 * self.dt_s - slowness * highest,
            integral: self.integral.at_samples()[top] - 0.5 * slowness * highest * highest,
            lowest,
            highest,
        })
    }

    /// The best window that starts on a rising flank and ends on a falling one: with τ = A + Bh and I = C + ½Bh² the
    /// condition h·τ = 0.6·I has the roots of 0.7Bh² + Ah − 0.6C = 0, of which the smaller is the maximum.
    fn try_flanks(&mut self, rise: Flank, fall: Flank) {
        let (a, b, c) = (fall.time_s - rise.time_s, fall.slowness - rise.slowness, fall.integral - rise.integral);
        let level = 1.2 * c / (a + (a * a + 1.68 * b * c).sqrt());
        let (lowest, highest) = (rise.lowest.max(fall.lowest), rise.highest.min(fall.highest));
        // a level between two flanks must not fall through the gap that rounding leaves: a window tried in vain does no harm
        let near = 1e-6 * self.peak;
        if level > 0.0 && level >= lowest - near && level <= highest + near {
            let level = level.min(highest).max(lowest);
            let [start_s, end_s] = [rise, fall].map(|flank| flank.time_s + flank.slowness * level);
            if end_s - start_s <= self.limit_s {
                self.offer(start_s.max(0.0), end_s.min(self.integral.duration_s()));
            }
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

#[cfg(test)]
mod tests;
