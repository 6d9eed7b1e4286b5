//! A loading curve with unloading by stretch.
//!
//! Loading follows f. Unloading returns the share μ of each interval's work: with M(x) = ∫₀ˣ μ the force at x after a
//! maximum x_m is f(x*), M(x*) = M(x_m) − (x_m − x), and 0 where the right side is negative; reloading retraces it.
//! ∫₀^{x*} μ f is recoverable. With two intervals this is the spring of contacts ([`crate::forces::spring`]). The loss,
//! ∫(1 − μ) f up to x_m, never falls.

use super::cubic::Cubic;
use super::data::{Beyond, Function};
use crate::forces::spring::LEAST_FRACTION;
use crate::motion::scalar::Scalar;

/// Constants of a force function.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionLaw<S> {
    pieces: Vec<Piece<S>>,
    /// x of the last point, and of the final end; 1e300 where there is none.
    end: S,
    stop: S,
}

/// x that stands for "no last point".
const NOWHERE: f64 = 1e300;

/// One interval; values at its beginning have the index 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece<S> {
    /// f from x₀ on.
    f: Cubic<S>,
    /// μ.
    returned: S,
    /// M(x₀).
    way: S,
    /// ∫μf and ∫(1 − μ)f up to x₀.
    energy: S,
    lost: S,
}

impl FunctionLaw<f64> {
    /// Law of a function.
    pub fn new(data: &Function) -> Self {
        let stop = if data.beyond == Beyond::Limits { data.end() } else { NOWHERE };
        FunctionLaw { end: data.end(), stop, ..Self::of(data.pieces()) }
    }

    /// c₁x + c₂x² + c₃x³ with the constant returned fraction μ.
    pub fn polynomial([c1, c2, c3]: [f64; 3], returned: f64) -> Self {
        Self::of([(Cubic { from: 0.0, c: [0.0, c1, c2, c3] }, returned)])
    }

    /// Whether any of its work is dissipated.
    pub(crate) fn is_lossy(&self) -> bool {
        self.pieces.iter().any(|piece| piece.returned < 1.0)
    }

    fn of(cubics: impl IntoIterator<Item = (Cubic<f64>, f64)>) -> Self {
        let mut law = FunctionLaw { pieces: Vec::new(), end: NOWHERE, stop: NOWHERE };
        for (f, mu) in cubics {
            let [way, energy, lost] = law.pieces.last().map_or([0.0; 3], |before| before.returned_to(f.from));
            law.pieces.push(Piece { f, returned: mu.max(LEAST_FRACTION), way, energy, lost });
        }
        law
    }

    /// Largest slope of loading and unloading up to x, and whether f falls anywhere in this range.
    pub(crate) fn steepness(&self, x: f64) -> (f64, bool) {
        let ends = self.pieces.iter().skip(1).map(|next| next.f.from.min(x)).chain([x]);
        let slopes =
            self.pieces.iter().zip(ends).map(|(piece, end)| (piece.f.slopes(end.max(piece.f.from)), piece.returned));
        slopes.fold((0.0, false), |(most, falls), ([least, steepest], mu)| {
            ((steepest / mu).max(most), falls || least.is_nan() || least < 0.0)
        })
    }
}

impl FunctionLaw<f64> {
    /// The largest deformation and the end of the known range, as text, if the first exceeds the second.
    pub(crate) fn overrun(&self, of: &str, greatest: f64, shown: impl Fn(f64) -> String) -> Option<String> {
        let ends = "beyond the last point of a force function that says `beyond = \"limits\"`";
        (greatest > self.stop).then(|| format!("{of} went to {}, {ends}: {}", shown(greatest), shown(self.stop)))
    }
}

impl<S: Copy> Piece<S> {
    #[inline(always)]
    fn zip<A: Copy, T>(&self, other: &Piece<A>, f: &impl Fn(S, A) -> T) -> Piece<T> {
        Piece {
            f: self.f.zip(&other.f, f),
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
        let (share, work) = (self.returned * (x - self.f.from), self.f.work(x));
        [self.way + share, self.energy + self.returned * work, self.lost + (S::one() - self.returned) * work]
    }

    /// Slope at x₀; constant for a straight line.
    #[inline(always)]
    fn slope(&self) -> S {
        self.f.c[1]
    }

    /// 1/slope at x₀; 0 on a plateau. Not stored as a constant: a plateau that begins to rise has no slope of the law.
    #[inline(always)]
    fn give(&self) -> S {
        let (o, slope) = (S::zero(), self.slope());
        S::select(slope.gt(o), S::one() / slope, o)
    }
}

impl<S: Copy> FunctionLaw<S> {
    /// x of its last point; 1e300 where it has none.
    pub(crate) fn end(&self) -> S {
        self.end
    }

    /// Number of intervals; functions with equal numbers can be computed side by side.
    pub(crate) fn len(&self) -> usize {
        self.pieces.len()
    }

    pub(crate) fn zip<A: Copy, T>(&self, other: &FunctionLaw<A>, f: &impl Fn(S, A) -> T) -> FunctionLaw<T> {
        let pieces = self.pieces.iter().zip(&other.pieces).map(|(a, b)| a.zip(b, f)).collect();
        FunctionLaw { pieces, end: f(self.end, other.end), stop: f(self.stop, other.stop) }
    }
}

/// Force with its slope, and x*, the deformation of equal force in loading.
pub(crate) struct Response<S> {
    pub(crate) force: S,
    pub(crate) slope: S,
    pub(crate) loading: S,
}

impl<S: Scalar> FunctionLaw<S> {
    /// Last piece for which `begins` holds, or the first. In order of the pieces, it holds for all before that one.
    #[inline(always)]
    fn piece(&self, begins: impl Fn(&Piece<S>) -> S::Mask) -> Piece<S> {
        let Some((first, others)) = self.pieces.split_first() else {
            let o = S::zero();
            return Piece { f: Cubic::none(), returned: o, way: o, energy: o, lost: o };
        };
        let mut found = *first;
        for next in others {
            let mask = begins(next);
            if !S::any(mask) {
                break;
            }
            found = if S::any(!mask) { found.zip(next, &|a, b| S::select(mask, b, a)) } else { *next };
        }
        found
    }

    /// Zero, or NaN where the largest deformation is beyond the end of the known range.
    #[inline(always)]
    pub(crate) fn unknown(&self, greatest: S) -> S {
        S::select(greatest.gt(self.stop), S::of(f64::NAN), S::zero())
    }

    /// f.
    #[inline(always)]
    pub fn value(&self, x: S) -> S {
        self.piece(|next| next.f.from.lt(x)).f.value(x)
    }

    /// M, the recoverable energy and the dissipated energy up to x*.
    #[inline(always)]
    pub fn returned_to(&self, loading: S) -> [S; 3] {
        self.piece(|next| next.f.from.lt(loading)).returned_to(loading)
    }

    /// Force at `x` after a largest deformation x_m.
    #[inline(always)]
    pub(crate) fn respond(&self, x: S, greatest: S) -> Response<S> {
        let o = S::zero();
        let loads = !x.lt(greatest);
        let way = self.returned_to(greatest)[0] - (greatest - x);
        let back = self.piece(|next| next.way.lt(way));
        let ahead = self.piece(|next| next.f.from.lt(x));
        let loading = S::select(loads, x, back.f.from + (way - back.way) / back.returned).max(o);
        let f = ahead.f.zip(&back.f, &|a, b| S::select(loads, a, b));
        let slope = f.slope(loading);
        let slope = S::select(loads, slope, slope / back.returned);
        let pulls = loads | way.gt(o);
        Response { force: S::select(pulls, f.value(loading), o), slope: S::select(pulls, slope, o), loading }
    }

    /// Recoverable energy at `x` after a largest deformation x_m.
    #[inline(always)]
    pub(crate) fn stored(&self, x: S, greatest: S) -> S {
        self.returned_to(self.respond(x, greatest).loading)[1]
    }

    /// x at which straight lines have the force `force` after a largest deformation x_m, dx/dforce, and x*; the least x
    /// if there are several.
    #[inline(always)]
    pub(crate) fn reach(&self, force: S, greatest: S, set: S) -> (S, S, S) {
        let piece = self.piece(|next| next.f.c[0].lt(force));
        let give = piece.give();
        let loading = piece.f.from + (force - piece.f.c[0]) * give;
        let loads = !loading.lt(greatest);
        let x = S::select(loads, loading, piece.way + piece.returned * (loading - piece.f.from) + set);
        (x, S::select(loads, give, give * piece.returned), loading)
    }

    /// Like [`FunctionLaw::reach`], with a parallel spring of stiffness κ and length `rest`.
    #[inline(always)]
    pub(crate) fn reach_beside(&self, force: S, greatest: S, set: S, [kappa, rest]: [S; 2]) -> (S, S, S) {
        // of a piece: the force of both where it begins, loading and unloading
        let up = |p: &Piece<S>| p.f.c[0] + kappa * (p.f.from - rest);
        let down = |p: &Piece<S>| p.f.c[0] + kappa * (p.way + set - rest);
        let piece = self.piece(|next| up(next).lt(force));
        let ahead = piece.f.from + (force - up(&piece)) / (piece.slope() + kappa);
        let other = self.piece(|next| down(next).lt(force));
        let back = other.f.from + (force - down(&other)) / (other.slope() + kappa * other.returned);
        let loads = !ahead.lt(greatest);
        let x = S::select(loads, ahead, other.returned_to(back)[0] + set);
        let give = S::one() / (S::select(loads, piece.slope(), other.slope() / other.returned) + kappa);
        (x, give, S::select(loads, ahead, back))
    }

    /// x_m − M(x_m), the permanent set.
    #[inline(always)]
    pub(crate) fn set(&self, greatest: S) -> S {
        greatest - self.returned_to(greatest)[0]
    }

    /// Intersection of f with a line of slope K and value `from` at 0, steeper than f everywhere; at least 0.
    #[inline(always)]
    pub(crate) fn crossing(&self, from: S, slope: S) -> S {
        let line = |p: &Piece<S>| from + slope * p.f.from;
        let piece = self.piece(|next| line(next).lt(next.f.c[0]));
        (piece.f.from + (piece.f.c[0] - line(&piece)) / (slope - piece.slope())).max(S::zero())
    }
}
