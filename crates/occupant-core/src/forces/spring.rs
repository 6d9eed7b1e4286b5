//! The bilinear dissipative spring of contacts and webbing: data and law.
//!
//! Report: Fig. 16 is lost; the curve is our decision. With Δ_m the largest deformation so far (including the present
//! one), a = min(Δ_m, Δ_b), b = max(Δ_m − Δ_b, 0) and e = Δ − Δ_m + μ₁a + μ₂b:
//!
//! - F = (K₁/μ₁) e for 0 < e ≤ μ₁a, then slope K₂/μ₂: the unloading line, which meets the loading curve at Δ_m;
//! - U = ∫F de, the energy that unloading returns: exactly μ₁ of the work of range 1 and μ₂ of that of range 2.
//!
//! Loading is the case Δ = Δ_m of the same formula. K₁ = 0 is a gap: no force up to Δ_b, whatever μ₁ is.

use crate::motion::scalar::Scalar;
use placed_text::Problems;

/// Least returned fraction: μ = 0 becomes a very steep drop.
pub const LEAST_FRACTION: f64 = 0.01;
/// Returned fraction below which an object counts as yielding.
const YIELDING: f64 = 0.5;

/// Force over deformation in loading: slope K₁ up to Δ_b, then K₂.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BilinearSpring {
    /// K₁.
    pub k1_n_per_m: f64,
    /// K₂.
    pub k2_n_per_m: f64,
    /// Δ_b, deformation at which the slope changes.
    pub break_m: f64,
    /// μ₁, fraction of the energy stored below Δ_b that unloading returns, 0 to 1.
    pub returned_1: f64,
    /// μ₂, the same above Δ_b.
    pub returned_2: f64,
}

impl BilinearSpring {
    /// Straight line of slope `k_n_per_m` (N/m) with the returned fraction `returned`.
    pub fn linear(k_n_per_m: f64, returned: f64) -> Self {
        BilinearSpring {
            k1_n_per_m: k_n_per_m,
            k2_n_per_m: k_n_per_m,
            break_m: 0.0,
            returned_1: returned,
            returned_2: returned,
        }
    }

    /// The same up to the deformation `break_m` (m), with slope `k2_n_per_m` (N/m) beyond.
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

    /// Reports problems of the curve at `path`.
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
                "the larger of the two, or mu2 of at most 0.5 for a part that yields: are k1 and k2 exchanged?";
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
    /// f applied to corresponding numbers of this and `other`.
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

    /// Force (N) and recoverable energy (J) at deformation `depth` (m) after a largest deformation `greatest` (m).
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

    /// Work of loading up to a deformation, J.
    #[inline(always)]
    pub(crate) fn work(&self, top: S) -> S {
        let (o, half) = (S::zero(), S::of(0.5));
        let (a, b) = (top.min(self.limit).max(o), (top - self.limit).max(o));
        half * self.k1 * a * a + (self.k1 * a + half * self.k2 * b) * b
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forces::function::DeflectionLaw;
    use crate::forces::function::{ForceDeflection, Function};

    /// A gap of 25 mm, then 40 kN/m with a returned fraction of 30 %.
    fn gap(returned_1: f64) -> BilinearSpring {
        BilinearSpring { returned_2: 0.3, ..BilinearSpring::linear(0.0, returned_1).then(0.025, 40e3) }
    }

    #[test]
    fn a_first_slope_of_zero_is_a_gap() {
        for returned_1 in [0.0, 0.3, 1.0] {
            let spring = Spring::<f64>::new(&gap(returned_1));
            for depth in [0.0, 0.01, 0.025] {
                assert_eq!(spring.respond(depth, depth), (0.0, 0.0));
            }
            let top = 0.075;
            let (force, energy) = spring.respond(top, top);
            assert!((force - 2000.0).abs() < 1e-9, "{force}"); // 2.3e-13
            assert!((energy - 0.3 * 0.5 * 40e3 * 0.05 * 0.05).abs() < 1e-9, "{energy}"); // 7e-15
            // what comes back on the way down is what was stored
            let steps = 200_000;
            let at = |i: i32| spring.respond(top * f64::from(i) / f64::from(steps), top).0;
            let back: f64 = (0..steps).map(|i| 0.5 * (at(i) + at(i + 1)) * top / f64::from(steps)).sum();
            assert!((back - energy).abs() < 1e-6, "{back} {energy}"); // 1.0e-9
            let mut problems = Problems::new();
            gap(returned_1).check("k", &mut problems);
            assert!(!problems.has_errors());
        }
        let mut problems = Problems::new();
        BilinearSpring::linear(0.0, 0.5).check("k", &mut problems);
        assert!(problems.has_errors(), "a spring that never resists");
    }

    #[test]
    fn a_force_function_with_a_gap_is_the_same_spring() {
        let loading = Function {
            points: vec![[0.0, 0.0], [0.025, 0.0], [0.125, 4000.0]],
            returned: vec![0.6, 0.3],
            ..Function::lines(Vec::new(), 1.0)
        };
        let data = ForceDeflection { loading, ..ForceDeflection::lines(Vec::new(), 1.0) };
        let mut problems = Problems::new();
        data.check("f", &mut problems);
        assert!(!problems.has_errors(), "{problems:?}");
        let (law, spring) = (DeflectionLaw::new(&data, 1.0), Spring::<f64>::new(&gap(0.6)));
        for i in 0..40 {
            for j in i..40 {
                let [depth, top] = [i, j].map(|k| 0.0031 * f64::from(k));
                let (of_law, of_spring) = (law.respond(depth, top, 0.0), spring.respond(depth, top));
                assert!((of_law.0 - of_spring.0).abs() < 1e-9 && (of_law.1 - of_spring.1).abs() < 1e-9); // 2e-12
            }
        }
        let none = ForceDeflection::lines(vec![[0.0, 0.0], [0.1, 0.0]], 1.0);
        let mut problems = Problems::new();
        none.check("f", &mut problems);
        assert!(problems.has_errors(), "a function without force");
    }
}
