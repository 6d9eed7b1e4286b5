//! Force functions: a force over a deformation x ≥ 0, straight between points, with a memory of the greatest x alone.
//!
//! Loading follows f. Unloading returns the share μ of what each interval took: with M(x) = ∫₀ˣ μ the force at x after a
//! greatest x_m is f(x*), M(x*) = M(x_m) − (x_m − x), and 0 where the right side is negative; loading again goes back the same
//! way. ∫₀^{x*} μ f is recoverable. With two intervals this is the spring of contacts ([`super::spring`]). What is lost,
//! ∫(1 − μ) f up to x_m, never falls.

use crate::forces::spring::LEAST_FRACTION;
use crate::motion::scalar::Scalar;
use placed_text::Problems;

/// A force function as data.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Deformation and force (N), from (0, 0) on; the last line goes on.
    pub points: Vec<[f64; 2]>,
    /// μ of each interval, 0 to 1.
    pub returned: Vec<f64>,
}

/// Constants of a force function.
#[derive(Clone, Debug)]
pub(crate) struct FunctionLaw<S> {
    pieces: Vec<Piece<S>>,
}

/// One interval; what is said of its beginning has the index 0.
#[derive(Clone, Copy, Debug)]
struct Piece<S> {
    /// x₀ and f(x₀).
    from: S,
    force: S,
    slope: S,
    /// 1/slope; 0 of a plateau.
    give: S,
    /// μ.
    returned: S,
    /// M(x₀).
    way: S,
    /// ∫μf and ∫(1 − μ)f up to x₀.
    energy: S,
    lost: S,
}

impl Function {
    /// Reports what is wrong with it; `falls`: how to mend a force that falls, `rises`: whether every interval must rise.
    pub(crate) fn check(&self, path: &str, rises: bool, falls: &str, problems: &mut Problems) {
        if self.points.len() < 2 || self.points[0] != [0.0, 0.0] {
            problems.error(
                path,
                format!("{} points, the first not (0, 0)", self.points.len()),
                "(0, 0) and at least one more",
            );
        }
        for (i, pair) in self.points.windows(2).enumerate() {
            let ([x, force], [next_x, next_force]) = (pair[0], pair[1]);
            if !(next_x > x && next_x.is_finite()) {
                problems.error(path, format!("{next_x} after {x}"), "deformations that rise from point to point");
            }
            if !(next_force > force || next_force == force && !rises && i > 0) {
                problems.error(path, format!("a force of {next_force} N after {force} N"), falls);
            }
        }
        if self.returned.len() + 1 != self.points.len() || self.returned.iter().any(|mu| !(0.0..=1.0).contains(mu)) {
            problems.error(
                format!("{path}.returned"),
                "other numbers",
                "one number, or one for each interval, from 0 to 1",
            );
        }
    }

    /// The greatest force within its points, N.
    pub(crate) fn greatest_n(&self) -> f64 {
        self.points.iter().fold(0.0, |most, point| most.max(point[1]))
    }

    /// The greatest slope of loading and unloading.
    pub(crate) fn steepest(&self) -> f64 {
        let slopes = self.points.windows(2).zip(&self.returned);
        slopes.fold(0.0, |most: f64, (p, mu)| {
            most.max((p[1][1] - p[0][1]) / (p[1][0] - p[0][0]) / mu.max(LEAST_FRACTION))
        })
    }
}

impl FunctionLaw<f64> {
    pub(crate) fn new(data: &Function) -> Self {
        let mut pieces: Vec<Piece<f64>> = Vec::with_capacity(data.returned.len());
        for (points, mu) in data.points.windows(2).zip(&data.returned) {
            let ([from, force], [to, next]) = (points[0], points[1]);
            let slope = (next - force) / (to - from);
            let give = if slope > 0.0 { 1.0 / slope } else { 0.0 };
            let [way, energy, lost] = pieces.last().map_or([0.0; 3], |before| before.returned_to(from));
            pieces.push(Piece { from, force, slope, give, returned: mu.max(LEAST_FRACTION), way, energy, lost });
        }
        FunctionLaw { pieces }
    }
}

impl<S: Copy> Piece<S> {
    #[inline(always)]
    fn zip<A: Copy, T>(&self, other: &Piece<A>, f: &impl Fn(S, A) -> T) -> Piece<T> {
        Piece {
            from: f(self.from, other.from),
            force: f(self.force, other.force),
            slope: f(self.slope, other.slope),
            give: f(self.give, other.give),
            returned: f(self.returned, other.returned),
            way: f(self.way, other.way),
            energy: f(self.energy, other.energy),
            lost: f(self.lost, other.lost),
        }
    }
}

impl<S: Scalar> Piece<S> {
    /// M, ∫μf and ∫(1 − μ)f up to x.
    #[inline(always)]
    fn returned_to(&self, x: S) -> [S; 3] {
        let s = x - self.from;
        let (share, work) = (self.returned * s, s * (self.force + self.slope * s * S::of(0.5)));
        [self.way + share, self.energy + self.returned * work, self.lost + (S::one() - self.returned) * work]
    }
}

impl<S: Copy> FunctionLaw<S> {
    /// How many intervals it has; functions of equally many can be computed side by side.
    pub(crate) fn len(&self) -> usize {
        self.pieces.len()
    }

    pub(crate) fn zip<A: Copy, T>(&self, other: &FunctionLaw<A>, f: &impl Fn(S, A) -> T) -> FunctionLaw<T> {
        FunctionLaw { pieces: self.pieces.iter().zip(&other.pieces).map(|(a, b)| a.zip(b, f)).collect() }
    }
}

/// A force with its slope, and x* where loading has it.
pub(crate) struct Response<S> {
    pub(crate) force: S,
    pub(crate) slope: S,
    pub(crate) loading: S,
}

impl<S: Scalar> FunctionLaw<S> {
    /// The last piece of which `begins` says that it begins before the place that is looked for, or the first.
    #[inline(always)]
    fn piece(&self, begins: impl Fn(&Piece<S>) -> S::Mask) -> Piece<S> {
        let o = S::zero();
        let none = Piece { from: o, force: o, slope: o, give: o, returned: o, way: o, energy: o, lost: o };
        let Some((first, others)) = self.pieces.split_first() else { return none };
        let later = |found: Piece<S>, next: &Piece<S>| {
            let mask = begins(next);
            if S::any(mask) { found.zip(next, &|a, b| S::select(mask, b, a)) } else { found }
        };
        others.iter().fold(*first, later)
    }

    /// M, the recoverable energy, and what is lost up to x*.
    #[inline(always)]
    pub(crate) fn returned_to(&self, loading: S) -> [S; 3] {
        self.piece(|next| next.from.lt(loading)).returned_to(loading)
    }

    /// Force at `x` after a greatest x_m.
    #[inline(always)]
    pub(crate) fn respond(&self, x: S, greatest: S) -> Response<S> {
        let o = S::zero();
        let loads = !x.lt(greatest);
        let way = self.returned_to(greatest)[0] - (greatest - x);
        let back = self.piece(|next| next.way.lt(way));
        let ahead = self.piece(|next| next.from.lt(x));
        let loading = S::select(loads, x, back.from + (way - back.way) / back.returned).max(o);
        let piece = ahead.zip(&back, &|a, b| S::select(loads, a, b));
        let slope = S::select(loads, piece.slope, piece.slope / piece.returned);
        let pulls = loads | way.gt(o);
        let force = piece.force + piece.slope * (loading - piece.from);
        Response { force: S::select(pulls, force, o), slope: S::select(pulls, slope, o), loading }
    }

    /// x at which the force is `force` after a greatest x_m, dx/dforce, and x*; the least where there are many.
    #[inline(always)]
    pub(crate) fn reach(&self, force: S, greatest: S, set: S) -> (S, S, S) {
        let piece = self.piece(|next| next.force.lt(force));
        let loading = piece.from + (force - piece.force) * piece.give;
        let loads = !loading.lt(greatest);
        let x = S::select(loads, loading, piece.returned_to(loading)[0] + set);
        (x, S::select(loads, piece.give, piece.give * piece.returned), loading)
    }

    /// Like [`FunctionLaw::reach`], with a spring of stiffness κ and length `rest` beside it.
    #[inline(always)]
    pub(crate) fn reach_beside(&self, force: S, greatest: S, set: S, [kappa, rest]: [S; 2]) -> (S, S, S) {
        // of a piece: the force of both where it begins, loading and unloading
        let up = |p: &Piece<S>| p.force + kappa * (p.from - rest);
        let down = |p: &Piece<S>| p.force + kappa * (p.way + set - rest);
        let piece = self.piece(|next| up(next).lt(force));
        let ahead = piece.from + (force - up(&piece)) / (piece.slope + kappa);
        let other = self.piece(|next| down(next).lt(force));
        let back = other.from + (force - down(&other)) / (other.slope + kappa * other.returned);
        let loads = !ahead.lt(greatest);
        let x = S::select(loads, ahead, other.returned_to(back)[0] + set);
        let give = S::one() / (S::select(loads, piece.slope, other.slope / other.returned) + kappa);
        (x, give, S::select(loads, ahead, back))
    }

    /// x_m − M(x_m), the deformation that stays.
    #[inline(always)]
    pub(crate) fn set(&self, greatest: S) -> S {
        greatest - self.returned_to(greatest)[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forces::spring::{BilinearSpring, Spring};

    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1u64 << 53) as f64
    }

    #[test]
    fn two_intervals_are_the_bilinear_spring_and_reach_inverts_it() {
        let spring =
            BilinearSpring { returned_1: 0.4, returned_2: 0.8, ..BilinearSpring::linear(5e3, 1.0).then(0.02, 9e3) };
        let points = vec![[0.0, 0.0], [0.02, 100.0], [0.05, 370.0]];
        let law = FunctionLaw::new(&Function { points, returned: vec![0.4, 0.8] });
        let (old, mut seed) = (Spring::<f64>::new(&spring), 7);
        for _ in 0..2000 {
            let (x, most) = (0.06 * random(&mut seed), 0.06 * random(&mut seed));
            let greatest = most.max(x);
            let (force, energy) = old.respond(x, greatest);
            let found = law.respond(x, greatest);
            // greatest measured difference: 1.2e-13 N
            assert!((found.force - force).abs() < 1e-11, "{} {force}", found.force);
            assert!((law.returned_to(found.loading)[1] - energy).abs() < 1e-12);
            if force > 0.0 {
                let set = law.set(greatest);
                let (back, give, loading) = law.reach(force, greatest, set);
                assert!((back - x).abs() < 1e-13, "{back} {x}");
                // where unloading begins the slope is that of either side
                assert!(greatest - x < 1e-9 || (give * found.slope - 1.0).abs() < 1e-12);
                let beside = law.reach_beside(force + 300.0 * (x - 0.01), greatest, set, [300.0, 0.01]);
                assert!((beside.0 - x).abs() < 1e-13 && (beside.2 - loading).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn what_a_closed_path_loses_follows_from_the_greatest_alone() {
        let points = vec![[0.0, 0.0], [0.01, 400.0], [0.03, 400.0], [0.05, 1000.0]];
        let law = FunctionLaw::new(&Function { points, returned: vec![0.5, 0.01, 0.7] });
        let lost = |x: f64| {
            (0.5 * 400.0 * 0.01) * 0.5
                + (x.clamp(0.01, 0.03) - 0.01) * 400.0 * 0.99
                + (x.max(0.03) - 0.03) * (400.0 + 15e3 * (x.max(0.03) - 0.03)) * 0.3
        };
        let (mut seed, mut work, mut greatest, mut before) = (3, 0.0, 0.0_f64, (0.0, 0.0));
        for _ in 0..40 {
            let target = if random(&mut seed) < 0.3 { 0.0 } else { 0.05 * random(&mut seed) };
            for i in 1..=20_000 {
                let x = before.0 + (target - before.0) * f64::from(i) / 20_000.0;
                let (from, force) = if i == 1 {
                    before
                } else {
                    (before.0 + (target - before.0) * f64::from(i - 1) / 20_000.0, before.1)
                };
                greatest = greatest.max(x);
                let now = law.respond(x, greatest).force;
                work += 0.5 * (force + now) * (x - from);
                before.1 = now;
            }
            before.0 = target;
        }
        let stored = law.returned_to(law.respond(before.0, greatest).loading)[1];
        if greatest > 0.03 {
            // measured: 2e-5 J of 20 J, the corners' part of the sum over 20,000 steps
            assert!((work - stored - lost(greatest)).abs() < 1e-3, "{work} {stored} {}", lost(greatest));
        } else {
            panic!("the path must go beyond the plateau");
        }
    }
}
