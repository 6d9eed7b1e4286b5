//! Volume that spheres displace of a bag together, the union of their single volumes, with its derivatives.
//!
//! Sphere k alone displaces V_k. Two whose middles are d apart beside each other, d² = |x_k − x_l|² − (s_k − s_l)², have
//! V_kl in common: their sections at the depth z below the envelope are discs of the areas A_k(δ_k − z) and A_l(δ_l − z),
//! whose lens has the area L(z),
//!
//! ```text
//! V_kl = ∫ L dz = z₀ L(0) + (m − z₀)/6 (L(z₀) + 4 L(½(z₀ + m))),   m = min(δ_k, δ_l)
//! ```
//!
//! by Simpson's rule, where both discs stay as wide as they are down to z₀ and L(m) = 0: exact of a small one within a large one.
//! With f_kl = V_kl/V_k, S₁ = Σ_l f_kl and S₂ = Σ_l f_kl², the part of V_k that counts is
//!
//! ```text
//! φ = 1/n + v/(2n √(1 + 0.6u)),   n = 1 + S₁,   v = S₁ − S₂,   u = S₁² − S₂
//! ```
//!
//! the mean of one over the number of spheres that a point of k is in: exact of two, and of any number in one place.
//!
//! The force beside each other is ∂V/∂d (x_k − x_l − ∇s (s_k − s_l))/d. At the rim of a dome |∇s| > 1: d² can be negative there,
//! which is d = 0, and close to that the vector is many times as long as d. It counts at most as three times d, and not at all
//! where d does not change.

use super::MOST_SPHERES;
use super::shape::section;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Coefficient of u in φ: fitted to unions of heads, chests and arms of 3 to 12 spheres, counted point by point. Their
/// areas agree within 5 % (standard deviation), without bias.
const CROWD: f64 = 0.6;
/// Lateral distance below which two centres have no direction, m.
const NEAR_M: f64 = 1e-4;
/// Largest length of a vector beside each other, relative to d.
const MOST_ASIDE: f64 = 3.0;
/// Number of spheres of most bags, for smaller buffers.
const FEW: usize = 8;

/// Number of pairs.
const fn pairs_of(spheres: usize) -> usize {
    spheres * (spheres - 1) / 2
}

/// A sphere's effect on an envelope, alone and then in the union.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cap<S> {
    /// 1 if it touches and is not held.
    pub(super) on: S,
    /// δ and its rate, m and m/s.
    pub(super) depth: S,
    pub(super) closing: S,
    /// Depth from which its area is constant, m.
    pub(super) full: S,
    /// r, m, and its reach.
    pub(super) radius: S,
    pub(super) reach: S,
    /// A and A′, m² and m; V, m³.
    pub(super) area: S,
    pub(super) slope: S,
    pub(super) volume: S,
    /// s, m, and ∇s.
    pub(super) distance: S,
    pub(super) gradient: V3<S>,
    /// Its centre and its velocity, from the mount, m and m/s.
    pub(super) seen: V3<S>,
    pub(super) velocity: V3<S>,
}

/// Joint displacement of all spheres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Union<S> {
    /// Of each sphere ∂V/∂δ, m², and ∂V/∂x at that depth, m².
    pub(super) slopes: [(S, V3<S>); MOST_SPHERES],
    /// V, m³, its rate, m³/s, and Σ ∂V/∂δ, m².
    pub(super) volume: S,
    pub(super) rate: S,
    pub(super) area: S,
}

/// An overlapping pair: indices, V_kl, its derivatives by both depths, and that by d over d; square of the longest vector beside each
/// other, m².
#[derive(Clone, Copy)]
struct Pair<S> {
    of: [usize; 2],
    volume: S,
    by_depth: [S; 2],
    by_distance: S,
    longest: S,
}

/// Σ f and Σ f² of a sphere, then φ and its derivatives by both.
#[derive(Clone, Copy)]
struct Share<S> {
    sums: [S; 2],
    part: S,
    slopes: [S; 2],
}

/// The union of displacements behind a face of this radius, none for a flat one.
#[inline(always)]
pub(super) fn unite<S: Scalar>(caps: &[Cap<S>], face: Option<S>) -> Union<S> {
    if caps.len() <= FEW {
        unite_of::<S, FEW, { pairs_of(FEW) }>(caps, face)
    } else {
        unite_of::<S, MOST_SPHERES, { pairs_of(MOST_SPHERES) }>(caps, face)
    }
}

/// The same with buffers for this many spheres and pairs.
#[inline(always)]
fn unite_of<S: Scalar, const SPHERES: usize, const PAIRS: usize>(caps: &[Cap<S>], face: Option<S>) -> Union<S> {
    let o = S::zero();
    let mut union = Union { slopes: [(o, V3::zero()); MOST_SPHERES], volume: o, rate: o, area: o };
    let mut shares = [Share { sums: [o; 2], part: S::one(), slopes: [o; 2] }; SPHERES];
    let mut pairs = [Pair { of: [0; 2], volume: o, by_depth: [o; 2], by_distance: o, longest: o }; PAIRS];
    let count = meet(caps, face, &mut shares, &mut pairs);
    for (i, (cap, share)) in caps.iter().zip(&mut shares).enumerate() {
        let mut own = cap.area;
        if count > 0 {
            share.settle();
            let [first, second] = share.slopes;
            own = own * (share.part - first * share.sums[0] - second * (share.sums[1] + share.sums[1]));
        }
        union.slopes[i].0 = own;
        union.volume += cap.volume * share.part;
    }
    for pair in &pairs[..count] {
        let [k, l] = pair.of;
        // beside it in lanes a sphere may displace nothing
        let mut weight = o;
        for i in pair.of {
            let part = S::select(caps[i].volume.gt(o), pair.volume / caps[i].volume, o);
            weight += shares[i].by_common(part);
        }
        union.bear(&caps[k], &caps[l], pair, weight);
    }
    for (cap, (own, _)) in caps.iter().zip(&union.slopes) {
        union.area += *own;
        union.rate += *own * cap.closing;
    }
    union
}

/// Finds overlapping pairs and the overlap of each sphere; the number of pairs.
#[inline(always)]
fn meet<S: Scalar>(caps: &[Cap<S>], face: Option<S>, shares: &mut [Share<S>], pairs: &mut [Pair<S>]) -> usize {
    let (o, mut count) = (S::zero(), 0);
    for k in 0..caps.len() {
        for l in 0..k {
            let (one, two) = (&caps[k], &caps[l]);
            let (beside, deeper) = (one.seen - two.seen, one.distance - two.distance);
            let squared = beside.norm_squared() - deeper * deeper;
            let d = squared.max(o) + S::of(NEAR_M * NEAR_M);
            let reach = one.wide() + two.wide();
            let meets = d.lt(reach * reach) & one.on.gt(o) & two.on.gt(o);
            if !S::any(meets) {
                continue;
            }
            let longest = d * S::of(MOST_ASIDE * MOST_ASIDE);
            let d = d.sqrt();
            let [volume, by_one, by_two, by_d] = common(one, two, face, d);
            let (volume, by_d) = (S::select(meets, volume, o), S::select(meets, by_d, o));
            let (by_one, by_two) = (S::select(meets, by_one, o), S::select(meets, by_two, o));
            let (by_depth, by_distance) = ([by_one, by_two], S::select(squared.gt(o), by_d / d, o));
            pairs[count] = Pair { of: [k, l], volume, by_depth, by_distance, longest };
            count += 1;
            for (i, cap) in [(k, one), (l, two)] {
                let part = S::select(meets, volume / cap.volume, o);
                shares[i].sums[0] += part;
                shares[i].sums[1] += part * part;
            }
        }
    }
    count
}

impl<S: Scalar> Cap<S> {
    /// Radius of its disc, bounded away from 0, m.
    #[inline(always)]
    fn wide(&self) -> S {
        wide(self.area)
    }

    /// Area of its section at the depth z, and its derivative by the remaining depth.
    #[inline(always)]
    fn below(&self, z: S, face: Option<S>) -> [S; 2] {
        let [area, slope] = section((self.depth - z).max(S::zero()), self.radius, face);
        [area * self.reach, slope * self.reach]
    }
}

impl<S: Scalar> Share<S> {
    /// φ and its derivatives.
    #[inline(always)]
    fn settle(&mut self) {
        let (one, half, [first, second]) = (S::one(), S::of(0.5), self.sums);
        let n = one / (one + first);
        let (v, u) = (first - second, first * first - second);
        let root = one / (one + S::of(CROWD) * u).sqrt();
        let slope = S::of(-0.5 * CROWD) * root * root * root;
        self.part = n * (one + half * v * root);
        self.slopes = [n * (half * root + v * slope * first) - n * self.part, -(n * half * (root + v * slope))];
    }

    /// Derivative of V_k φ by its overlap with one that it shares the fraction f with.
    #[inline(always)]
    fn by_common(&self, f: S) -> S {
        self.slopes[0] + f * (self.slopes[1] + self.slopes[1])
    }
}

impl<S: Scalar> Union<S> {
    /// Adds the effect of a pair, whose overlap has this derivative.
    #[inline(always)]
    fn bear(&mut self, one: &Cap<S>, two: &Cap<S>, pair: &Pair<S>, weight: S) {
        let [k, l] = pair.of;
        let (beside, deeper) = (one.seen - two.seen, one.distance - two.distance);
        let [from_one, from_two] = [beside - one.gradient * deeper, beside - two.gradient * deeper];
        let squared = from_one.norm_squared().max(from_two.norm_squared());
        let part = S::select(pair.longest.lt(squared), (pair.longest / squared).sqrt(), S::one());
        let aside = weight * pair.by_distance * part;
        let [by_one, by_two] = pair.by_depth;
        self.slopes[k].0 += by_one * weight;
        self.slopes[l].0 += by_two * weight;
        self.slopes[k].1 += from_one * aside;
        self.slopes[l].1 -= from_two * aside;
        // s changes by −δ̇, as the envelope unfolds too
        let apart = beside.dot(one.velocity - two.velocity) + deeper * (one.closing - two.closing);
        self.rate += aside * apart;
    }
}

/// V_kl and its derivatives by both depths and by d.
#[inline(always)]
fn common<S: Scalar>(one: &Cap<S>, two: &Cap<S>, face: Option<S>, d: S) -> [S; 4] {
    let (o, half, sixth) = (S::zero(), S::of(0.5), S::of(1.0 / 6.0));
    let four = S::of(4.0) * sixth;
    let least = one.depth.min(two.depth).max(o);
    let straight = [one.depth - one.full, two.depth - two.full];
    let from = straight[0].min(straight[1]).max(o);
    let middle = half * (from + least);
    let lower = [one.below(middle, face), two.below(middle, face)];
    let [upper_lens, by_d, part_one, part_two] = lens(d, [one.area, two.area]);
    let [lower_lens, lower_by_d, lower_one, lower_two] = lens(d, [lower[0][0], lower[1][0]]);
    let below = (least - from) * four;
    let above = from + (least - from) * sixth;
    let (fall_one, fall_two) = (lower_one * lower[0][1], lower_two * lower[1][1]);
    let by_middle = half * below * -(fall_one + fall_two);
    let by_from = S::select(from.gt(o), upper_lens * S::of(5.0 / 6.0) - lower_lens * four + by_middle, o);
    let by_least = upper_lens * sixth + lower_lens * four + by_middle;
    let ends = [lesser(one.depth, two.depth), lesser(straight[0], straight[1])];
    let by_one = above * part_one * one.slope + below * fall_one + ends[0] * by_least + ends[1] * by_from;
    let [end_two, from_two] = [S::one() - ends[0], S::one() - ends[1]];
    let by_two = above * part_two * two.slope + below * fall_two + end_two * by_least + from_two * by_from;
    [above * upper_lens + below * lower_lens, by_one, by_two, above * by_d + below * lower_by_d]
}

/// 1 if a < b, 0 if a > b, ½ if equal.
#[inline(always)]
fn lesser<S: Scalar>(a: S, b: S) -> S {
    S::select(a.lt(b), S::one(), S::select(b.lt(a), S::zero(), S::of(0.5)))
}

/// Radius of a disc of this area, bounded away from 0.
#[inline(always)]
fn wide<S: Scalar>(area: S) -> S {
    (area.max(S::of(1e-18)) * S::of(std::f64::consts::FRAC_1_PI)).sqrt()
}

/// Overlap area of two discs with distance d, its derivative by d, and those by both areas: the fractions of their
/// circles inside the other.
#[inline(always)]
pub(super) fn lens<S: Scalar>(d: S, areas: [S; 2]) -> [S; 4] {
    let (one, pi) = (S::one(), S::of(std::f64::consts::FRAC_1_PI));
    let [a, b] = [wide(areas[0]), wide(areas[1])];
    let (dd, aa, bb) = (d * d, a * a, b * b);
    let cosine = |square: S, radius: S| (square / ((d + d) * radius)).max(-one).min(one);
    let (near_a, near_b) = (cosine(dd + aa - bb, a), cosine(dd + bb - aa, b));
    let (turn_a, turn_b) = (near_a.acos(), near_b.acos());
    let chord = a * (one - near_a * near_a).max(S::zero()).sqrt();
    [aa * turn_a + bb * turn_b - d * chord, -(chord + chord), turn_a * pi, turn_b * pi]
}
