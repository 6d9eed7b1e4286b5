//! Force–deflection of contact: a loading curve, unloading, a spike of the first loading, and factors of speed.
//!
//! With δ_m the largest deformation (including the present one), F_m = f(δ_m) and A = ∫₀^{δ_m} f, unloading is one of
//!
//! - *stretch*: [`super::curve`];
//! - *slope*: F = max(g(δ), F_m − K(δ_m − δ), 0), with K above all slopes of f and g;
//! - *quadratic*, that of the ATB program, R and G over δ_m: 0 below Gδ_m, then a₁y + a₂y² with y = δ − Gδ_m, L = δ_m −
//!   Gδ_m, a₁ = max(0, 2(3RA/L − F_m)/L), a₂ = (F_m/L − a₁)/L, and where a₂ < 0 instead a₁ = F_m/L, a₂ = 0. Because of
//!   these cuts the returned share is R only between F_mL/3A and F_mL/2A.
//!
//! The spike adds s(δ_m) clamp01(1 − (δ_m − δ)/l), l = min(2 mm, δ_m): full while the deformation grows, gone 2 mm
//! after it reversed, so that nothing jumps (our decision). All this is a function of δ and δ_m alone. U is
//! recoverable; the loss, ∫f + ∫s − U at δ_m, must not fall with δ_m (`dissipation`). Factors of speed c(δ̇) with c(0)
//! = 1 and a damper C δ̇ clamp01(δ/δ_f) only dissipate energy; the whole force is cut at 0.

use super::curve::FunctionLaw;
use super::data::{ForceDeflection, Function, Unloading};
use super::steps::Steps;
use crate::motion::scalar::Scalar;

/// Distance after reversal over which a spike vanishes, m.
const FADES_M: f64 = 2e-3;

/// Constants of a force–deflection law.
#[derive(Clone, Debug)]
pub(crate) struct DeflectionLaw<S> {
    loading: FunctionLaw<S>,
    unloading: Back<S>,
    spike: Option<FunctionLaw<S>>,
    rate: Steps<S>,
    viscous: Option<[S; 2]>,
}

#[derive(Clone, Debug)]
enum Back<S> {
    Stretch,
    Slope(S, FunctionLaw<S>),
    Quadratic([Steps<S>; 2]),
}

impl DeflectionLaw<f64> {
    /// Law with all forces multiplied by `share`.
    pub(crate) fn new(data: &ForceDeflection, share: f64) -> Self {
        let times = |points: &[[f64; 2]]| points.iter().map(|[x, force]| [*x, share * force]).collect();
        let elastic = |points: &[[f64; 2]]| FunctionLaw::new(&Function::lines(times(points), 1.0));
        let nothing = [[0.0, 0.0], [1.0, 0.0]];
        DeflectionLaw {
            loading: FunctionLaw::new(&data.loading.times(share)),
            unloading: match &data.unloading {
                Unloading::Stretch => Back::Stretch,
                Unloading::Slope { n_per_m, least } if least.is_empty() => {
                    Back::Slope(share * n_per_m, elastic(&nothing))
                }
                Unloading::Slope { n_per_m, least } => Back::Slope(share * n_per_m, elastic(least)),
                Unloading::Quadratic { returned, set } => Back::Quadratic([Steps::new(returned), Steps::new(set)]),
            },
            spike: data.spike.last().map(|[end, _]| {
                let after = [*end + 1.0, 0.0];
                elastic(&[&data.spike[..], &[after]].concat())
            }),
            rate: Steps::new(&data.rate),
            viscous: data.viscous.map(|[damping, depth]| [share * damping, depth]),
        }
    }

    /// Least depth at which static loading reaches a force, m; none within 10 m.
    pub(crate) fn depth_under(&self, force: f64) -> Option<f64> {
        let (mut low, mut high) = (0.0, 1e-3);
        while self.loading(high)[0] < force {
            (low, high) = (high, 1.2 * high);
            if high > 10.0 {
                return None;
            }
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            (low, high) = if self.loading(middle)[0] < force { (middle, high) } else { (low, middle) };
        }
        Some(high)
    }

    /// Depth of the last point of loading, m.
    pub(crate) fn last_point(&self) -> f64 {
        self.loading.end()
    }

    /// The largest depth and the end of the known range, as text, if the first exceeds the second.
    pub(crate) fn overrun(&self, of: &str, greatest: f64) -> Option<String> {
        self.loading.overrun(of, greatest, |depth| format!("{:.1} mm", 1e3 * depth))
    }

    /// f + s and its work, up to a deformation.
    pub(super) fn loading(&self, x: f64) -> [f64; 2] {
        let of = |law: &FunctionLaw<f64>| [law.value(x), law.returned_to(x)[1..].iter().sum()];
        let ([force, work], [more, again]) = (of(&self.loading), self.spike.as_ref().map_or([0.0; 2], of));
        [force + more, work + again]
    }
}

impl<S: Copy> DeflectionLaw<S> {
    /// Combines corresponding numbers of two laws; none if they differ in parts or numbers of points.
    pub(crate) fn zip<A: Copy, T>(&self, other: &DeflectionLaw<A>, f: &impl Fn(S, A) -> T) -> Option<DeflectionLaw<T>> {
        let unloading = match (&self.unloading, &other.unloading) {
            (Back::Stretch, Back::Stretch) => Back::Stretch,
            (Back::Slope(k, g), Back::Slope(other, h)) if g.len() == h.len() => Back::Slope(f(*k, *other), g.zip(h, f)),
            (Back::Quadratic([a, b]), Back::Quadratic([c, d])) if [a.len(), b.len()] == [c.len(), d.len()] => {
                Back::Quadratic([a.zip(c, f), b.zip(d, f)])
            }
            _ => return None,
        };
        let spike = self.spike.as_ref().zip(other.spike.as_ref());
        let is_like = self.loading.len() == other.loading.len()
            && self.spike.as_ref().map(FunctionLaw::len) == other.spike.as_ref().map(FunctionLaw::len)
            && self.rate.len() == other.rate.len()
            && self.viscous.is_some() == other.viscous.is_some();
        is_like.then(|| DeflectionLaw {
            loading: self.loading.zip(&other.loading, f),
            unloading,
            spike: spike.map(|(a, b)| a.zip(b, f)),
            rate: self.rate.zip(&other.rate, f),
            viscous: self.viscous.zip(other.viscous).map(|([a, b], [c, d])| [f(a, c), f(b, d)]),
        })
    }
}

impl<S: Scalar> DeflectionLaw<S> {
    /// Force (N) and recoverable energy (J) at a depth (m) after a largest depth, while the depth grows by `closing` (m/s).
    #[inline(always)]
    pub(crate) fn respond(&self, depth: S, greatest: S, closing: S) -> (S, S) {
        if S::IS_WIDE { self.within(depth, greatest, closing) } else { self.apart(depth, greatest, closing) }
    }

    #[inline(never)]
    fn apart(&self, depth: S, greatest: S, closing: S) -> (S, S) {
        self.within(depth, greatest, closing)
    }

    /// Work of loading up to a deformation, J, without factors of speed and damper.
    #[inline(always)]
    pub(crate) fn work(&self, top: S) -> S {
        let [_, kept, lost] = self.loading.returned_to(top);
        match &self.spike {
            None => kept + lost,
            Some(spike) => {
                let [_, of_spike, gone] = spike.returned_to(top);
                of_spike + gone + (kept + lost)
            }
        }
    }

    #[inline(always)]
    fn within(&self, depth: S, greatest: S, closing: S) -> (S, S) {
        let (o, top) = (S::zero(), depth.max(greatest));
        let (mut force, mut energy) = match &self.unloading {
            Back::Stretch => {
                let found = self.loading.respond(depth, top);
                (found.force, self.loading.returned_to(found.loading)[1])
            }
            Back::Slope(slope, least) => self.by_slope(*slope, least, depth, top),
            Back::Quadratic([returned, set]) => self.by_quadratic([returned.at(top), set.at(top)], depth, top),
        };
        if let Some(spike) = &self.spike {
            let way = top.min(S::of(FADES_M)).max(S::of(1e-12));
            let (full, left) = (spike.value(top), (S::one() - (top - depth) / way).clamp01());
            force += full * left;
            energy += full * way * left * left * S::of(0.5);
        }
        force = self.rate.scale(force + self.loading.unknown(greatest), closing);
        if let Some([damping, fully]) = self.viscous {
            force = (force + damping * closing * (depth / fully).clamp01()).max(o);
        }
        (force, energy)
    }

    #[inline(always)]
    fn by_slope(&self, slope: S, least: &FunctionLaw<S>, depth: S, top: S) -> (S, S) {
        let loaded = self.loading.value(top);
        let crossing = least.crossing(loaded - slope * top, slope).min(top);
        let (above, line) = (depth.gt(crossing), loaded - slope * (top - depth));
        let force = S::select(above, line, least.value(depth));
        let below = least.returned_to(depth.min(crossing))[1];
        let more = (loaded - slope * (top - crossing) + line) * (depth - crossing) * S::of(0.5);
        (force.max(S::zero()), below + S::select(above, more, S::zero()))
    }

    #[inline(always)]
    fn by_quadratic(&self, [returned, set]: [S; 2], depth: S, top: S) -> (S, S) {
        let (o, two) = (S::zero(), S::of(2.0));
        let [_, kept, lost] = self.loading.returned_to(top);
        let (area, force) = (kept + lost, self.loading.value(top));
        let length = (top - set * top).max(S::of(1e-12));
        let first = (two * (S::of(3.0) * returned * area / length - force) / length).max(o);
        let second = (force / length - first) / length;
        let is_straight = second.lt(o);
        let (first, second) = (S::select(is_straight, force / length, first), second.max(o));
        let y = (depth - set * top).max(o);
        ((first + second * y) * y, (first * S::of(0.5) + second * y * S::of(1.0 / 3.0)) * y * y)
    }
}
