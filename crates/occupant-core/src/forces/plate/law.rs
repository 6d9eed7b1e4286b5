//! Resistance of plates.
//!
//! ```text
//! x = Σ a s     f = f_e(x) + f_d(ẋ) + κ(x − e)     ė = (x − e)/τ     S_k = Σ a_k f
//! f_d = c₁ẋ + c₂ẋ² for ẋ ≥ 0, c₀ẋ for ẋ < 0
//! ```
//!
//! f_e unloads by the stretch of [`crate::forces::function`], with a memory x_m for each sign of x; each memory is
//! cleared when x has the other sign.

use super::data::{Band, PlateData};
use super::past::BandPast;
use crate::body::Body;
use crate::forces::function::FunctionLaw;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::MOST_SLIDES;
use crate::motion::scalar::Scalar;

/// Fraction of a chest's depth beyond which there are no tests.
pub(crate) const DEEP: f64 = 0.45;

/// Constants of the plates of all bodies.
#[derive(Clone, Debug, Default)]
pub struct PlateLaws<S> {
    /// By plate: its segment.
    pub(super) segments: Vec<usize>,
    /// By plate: largest deflection covered by tests, m.
    pub(super) deep: Vec<S>,
    pub(super) bands: Vec<BandLaw<S>>,
}

/// Constants of a band.
#[derive(Clone, Debug)]
pub(super) struct BandLaw<S> {
    /// Plates and their factors.
    pub of: Vec<(usize, S)>,
    spring: FunctionLaw<S>,
    outward: Option<FunctionLaw<S>>,
    /// c₁, c₂, c₀.
    damper: [S; 3],
    /// κ, τ and the index of e among the state variables that force elements own.
    viscous: Option<([S; 2], usize)>,
}

/// State of a band at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Now<S> {
    /// f, N.
    pub force: S,
    /// Recoverable energy, J.
    pub stored: S,
}

impl PlateLaws<f64> {
    pub(super) fn new(data: &PlateData<'_>, _body: &Body) -> Self {
        PlateLaws {
            segments: data.plates.iter().map(|plate| plate.segment.index()).collect(),
            deep: data.plates.iter().map(|plate| DEEP * plate.depth_m.unwrap_or(f64::INFINITY)).collect(),
            bands: data.bands.iter().map(BandLaw::new).collect(),
        }
    }

    /// Appends the initial s and ṡ of every plate, then the initial strains of Maxwell branches: all zero.
    pub(super) fn own(&mut self, numbers: &mut Vec<f64>) {
        numbers.extend(self.segments.iter().flat_map(|_| [0.0; 2]));
        for band in &mut self.bands {
            if let Some((_, place)) = &mut band.viscous {
                *place = numbers.len();
                numbers.push(0.0);
            }
        }
    }
}

impl BandLaw<f64> {
    fn new(band: &Band) -> Self {
        let damper = &band.damper;
        BandLaw {
            of: band.of.clone(),
            spring: FunctionLaw::new(&band.spring),
            outward: band.outward.as_ref().map(FunctionLaw::new),
            damper: [damper.linear_n_s_m, damper.quadratic_n_s2_m2, damper.outward_n_s_m],
            viscous: band.viscous.map(|numbers| (numbers, 0)),
        }
    }
}

impl<S: Copy> PlateLaws<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &PlateLaws<A>, f: &impl Fn(S, A) -> T) -> Option<PlateLaws<T>> {
        let is_like = self.segments == other.segments && self.bands.len() == other.bands.len();
        let bands = self.bands.iter().zip(&other.bands).map(|(a, b)| a.zip(b, f));
        Some(PlateLaws {
            segments: is_like.then(|| self.segments.clone())?,
            deep: self.deep.iter().zip(&other.deep).map(|(a, b)| f(*a, *b)).collect(),
            bands: bands.collect::<Option<_>>()?,
        })
    }
}

impl<S: Copy> BandLaw<S> {
    fn zip<A: Copy, T>(&self, other: &BandLaw<A>, f: &impl Fn(S, A) -> T) -> Option<BandLaw<T>> {
        let of = self.of.iter().zip(&other.of);
        let outward = self.outward.as_ref().zip(other.outward.as_ref());
        let is_like = of.clone().all(|(a, b)| a.0 == b.0)
            && self.of.len() == other.of.len()
            && self.spring.len() == other.spring.len()
            && self.outward.as_ref().map(FunctionLaw::len) == other.outward.as_ref().map(FunctionLaw::len)
            && self.viscous.is_some() == other.viscous.is_some();
        is_like.then(|| BandLaw {
            of: of.map(|(a, b)| (a.0, f(a.1, b.1))).collect(),
            spring: self.spring.zip(&other.spring, f),
            outward: outward.map(|(a, b)| a.zip(b, f)),
            damper: std::array::from_fn(|i| f(self.damper[i], other.damper[i])),
            viscous: self.viscous.zip(other.viscous).map(|(([k, t], at), ([l, u], _))| ([f(k, l), f(t, u)], at)),
        })
    }
}

impl<S: Scalar> BandLaw<S> {
    /// x and ẋ.
    #[inline(always)]
    pub(super) fn moved(&self, k: &Kinematics<S>) -> [S; 2] {
        let mut sum = [S::zero(); 2];
        for (plate, factor) in &self.of {
            let slid = &k.slides[*plate % MOST_SLIDES];
            sum[0] += *factor * slid.way;
            sum[1] += *factor * slid.speed;
        }
        sum
    }

    /// Force and energy at x and ẋ; writes the rate of the band's own state variable.
    #[inline(always)]
    pub(super) fn now(&self, [x, speed]: [S; 2], past: &BandPast<S>, own: &[S], rates: &mut [S]) -> Now<S> {
        let o = S::zero();
        let is_out = x.lt(o);
        let (way, greatest) = (x.abs(), S::select(is_out, past.greatest[1], past.greatest[0]));
        let [mut force, mut stored] = elastic(&self.spring, way, greatest);
        if let Some(outward) = &self.outward {
            let [other, energy] = elastic(outward, way, greatest);
            (force, stored) = (S::select(is_out, other, force), S::select(is_out, energy, stored));
        }
        let [linear, quadratic, outward] = self.damper;
        let damping = S::select(speed.lt(o), outward, linear + quadratic * speed) * speed;
        force = S::select(is_out, -force, force) + damping;
        if let (Some(([stiffness, time], at)), true) = (self.viscous, !own.is_empty()) {
            let strain = x - own[at];
            rates[at] = strain / time;
            force += stiffness * strain;
            stored += stiffness * strain * strain * S::of(0.5);
        }
        Now { force, stored }
    }
}

/// Force of a spring and its recoverable energy.
#[inline(always)]
fn elastic<S: Scalar>(spring: &FunctionLaw<S>, way: S, greatest: S) -> [S; 2] {
    let top = greatest.max(way);
    let found = spring.respond(way, top);
    [found.force + spring.unknown(top), spring.returned_to(found.loading)[1]]
}
