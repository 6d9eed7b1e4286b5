//! The bilinear dissipative spring of contacts and webbing: data and law.
//!
//! Report: Fig. 16 is lost; the curve is our decision. With Δ_m the greatest deformation so far (the present one counts),
//! a = min(Δ_m, Δ_b), b = max(Δ_m − Δ_b, 0) and e = Δ − Δ_m + μ₁a + μ₂b:
//!
//! - F = (K₁/μ₁) e for 0 < e ≤ μ₁a, then slope K₂/μ₂: the unloading line, which meets the loading curve at Δ_m;
//! - U = ∫F de, the energy that unloading gives back: exactly μ₁ of what range 1 took and μ₂ of what range 2 took.
//!
//! Loading is the case Δ = Δ_m of the same formula. K₁ = 0 is a gap: no force up to Δ_b, whatever μ₁ is.

use crate::motion::scalar::Scalar;
use placed_text::Problems;

/// A fraction below this counts as this, so that μ = 0 is a very steep drop.
pub const LEAST_FRACTION: f64 = 0.01;
/// What yields gives back less of its energy than this.
const YIELDING: f64 = 0.5;

/// Force over deformation while loading: slope K₁ up to Δ_b, then K₂.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BilinearSpring {
    /// K₁.
    pub k1_n_per_m: f64,
    /// K₂.
    pub k2_n_per_m: f64,
    /// Δ_b, where the slope changes.
    pub break_m: f64,
    /// μ₁, fraction of the energy stored below Δ_b that unloading returns, 0 to 1.
    pub returned_1: f64,
    /// μ₂, the same above Δ_b.
    pub returned_2: f64,
}

impl BilinearSpring {
    /// One straight line of slope `k_n_per_m` (N/m), of whose energy unloading returns the fraction `returned`.
    pub fn linear(k_n_per_m: f64, returned: f64) -> Self {
        BilinearSpring {
            k1_n_per_m: k_n_per_m,
            k2_n_per_m: k_n_per_m,
            break_m: 0.0,
            returned_1: returned,
            returned_2: returned,
        }
    }

    /// The same up to the deformation `break_m` (m), and the slope `k2_n_per_m` (N/m) beyond.
    pub fn then(self, break_m: f64, k2_n_per_m: f64) -> Self {
        BilinearSpring { break_m, k2_n_per_m, ..self }
    }

    /// The same with forces and energies multiplied by `share`.
    pub(crate) fn times(self, share: f64) -> Self {
        BilinearSpring { k1_n_per_m: share * self.k1_n_per_m, k2_n_per_m: share * self.k2_n_per_m, ..self }
    }

    /// Slope of the stiffest branch, N/m.
    pub(crate) fn steepest_n_per_m(&self) -> f64 {
        Spring::<f64>::new(self).steepest()
    }

    /// Reports what is wrong with it under `path`.
    pub(crate) fn check(&self, path: &str, problems: &mut Problems) {
        problems.check_at_least_zero(&format!("{path}.k1"), self.k1_n_per_m, "N/m");
        problems.check_at_least_zero(&format!("{path}.k2"), self.k2_n_per_m, "N/m");
        problems.check_at_least_zero(&format!("{path}.break_at"), self.break_m, "m");
        let (k1, k2) = (self.k1_n_per_m, self.k2_n_per_m);
        if k1 == 0.0 && k2 == 0.0 {
            let expected = "a stiffness above 0, or behind a gap `k2` above 0 from `delta_b` on";
            problems.error(format!("{path}.k1"), "0 N/m, and no stiffness behind it", expected);
        }
        if k2 > 0.0 && k2 < k1 && self.returned_2 > YIELDING {
            let found = format!("{k2} N/m, softer than k1 = {k1} N/m, of a spring that gives back {}", self.returned_2);
            let expected =
                "the larger of the two, or of what yields mu2 of 0.5 at most: have k1 and k2 changed places?";
            problems.warning(format!("{path}.k2"), found, expected);
        }
        for (key, value) in [("mu1", self.returned_1), ("mu2", self.returned_2)] {
            if !(0.0..=1.0).contains(&value) {
                let expected = "a fraction of returned energy, from 0 to 1";
                problems.error(format!("{path}.{key}"), format!("{value}"), expected);
            } else if value < LEAST_FRACTION {
                problems.warning(
                    format!("{path}.{key}"),
                    format!("{value}, which counts as {LEAST_FRACTION}"),
                    "at least 0.01: unloading needs some slope",
                );
            }
        }
    }
}

/// Constants of the law.
#[derive(Clone, Copy, Debug)]
pub struct Spring<S> {
    k1: S,
    k2: S,
    limit: S,
    mu1: S,
    mu2: S,
    k1_back: S,
    k2_back: S,
}

impl<S: Copy> Spring<S> {
    /// f applied to every number and the one in the same place of `other`.
    pub(crate) fn zip<A: Copy, T>(&self, other: &Spring<A>, f: &impl Fn(S, A) -> T) -> Spring<T> {
        Spring {
            k1: f(self.k1, other.k1),
            k2: f(self.k2, other.k2),
            limit: f(self.limit, other.limit),
            mu1: f(self.mu1, other.mu1),
            mu2: f(self.mu2, other.mu2),
            k1_back: f(self.k1_back, other.k1_back),
            k2_back: f(self.k2_back, other.k2_back),
        }
    }
}

impl<S: Scalar> Spring<S> {
    /// Constants from data; fractions below `LEAST_FRACTION` are raised to it.
    pub fn new(data: &BilinearSpring) -> Self {
        let (mu1, mu2) = (data.returned_1.max(LEAST_FRACTION), data.returned_2.max(LEAST_FRACTION));
        Spring {
            k1: S::of(data.k1_n_per_m),
            k2: S::of(data.k2_n_per_m),
            limit: S::of(data.break_m),
            mu1: S::of(mu1),
            mu2: S::of(mu2),
            k1_back: S::of(data.k1_n_per_m / mu1),
            k2_back: S::of(data.k2_n_per_m / mu2),
        }
    }

    /// Force (N) and recoverable energy (J) at deformation `depth` (m) after a greatest deformation `greatest` (m).
    #[inline(always)]
    pub fn respond(&self, depth: S, greatest: S) -> (S, S) {
        let o = S::zero();
        let top = depth.max(greatest);
        let a = top.min(self.limit).max(o);
        let b = (top - self.limit).max(o);
        let range_1 = self.mu1 * a;
        let e = depth - top + range_1 + self.mu2 * b;
        let e1 = e.max(o).min(range_1);
        let e2 = (e - range_1).max(o);
        let (f1, f2) = (self.k1_back * e1, self.k2_back * e2);
        let half = S::of(0.5);
        (f1 + f2, half * f1 * e1 + self.k1 * a * e2 + half * f2 * e2)
    }

    /// Deformation at which the slope changes, m.
    pub(crate) fn knee(&self) -> S {
        self.limit
    }

    /// Slope of the stiffest branch, N/m, for estimates of the fastest time scale.
    pub fn steepest(&self) -> S {
        self.k1.max(self.k2).max(self.k1_back).max(self.k2_back)
    }
}
