//! A bag at one instant.
//!
//! Its gas has one pressure and temperature. The envelope holds V_e, of which the spheres of the body displace ΣV_k; with
//! X = ΣV_k/V_e the gas has V_free = V_e φ(X), φ = 1 − X as far as X = 0.8 and 0.2 e^((0.8 − X)/0.2) beyond, for a body in a bag
//! that has hardly unfolded would leave it less than nothing. With κ = −φ′
//!
//! ```text
//! V̇_free = V̇_e (φ + κX) − κ Σ A_k δ̇_k,   force on a sphere = κ (p − p_a) A_k ∇s
//! ```
//!
//! so that the work of the gas is that of the forces exactly. With E = U + p_aV of `gas`
//!
//! ```text
//! Ė = Σ ṁ_in h(T_in) − ṁ_out h(T) − q A_f (T − T_a) − (p − p_a) V̇_free
//! ```
//!
//! whether it fills the bag or not. The last term is summed twice: with the integrator's weights, and from pressures and volumes
//! at the ends of accepted steps. Their difference is the residual of the gas's balance.

use super::MOST_SPHERES;
use super::data::{Bag, FOLDED, Gas};
use super::gas::{GasLaw, Mixture};
use super::inflator::{InflatorLaw, Outflow, OutletLaw};
use super::past::BagPast;
use super::shape::{ShapeLaw, displaced, size};
use super::unfold::{UnfoldLaw, Unfolded};
use crate::forces::element::Instant;
use crate::motion::frame::VEHICLE;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// X beyond which φ is no longer 1 − X.
const CROWDED: f64 = 0.8;
/// Distance from the middle of a ball or capsule over R below which the direction of its force is lost.
const LOST: f64 = 0.1;

/// Where the numbers stand that a bag owns in a state, from its first on; then the masses of its gases, the air first.
const ENERGY: usize = 0;
const PRESSED: usize = 1;
const WORK: usize = 2;
const VENTED: usize = 3;
const MASSES: usize = 4;

/// Constants of a bag.
#[derive(Clone, Debug)]
pub struct BagLaw<S> {
    /// Index of what it is fixed to.
    pub(super) frame: usize,
    /// Where its numbers stand among those that force elements own.
    first: usize,
    mount: V3<S>,
    shape: ShapeLaw<S>,
    unfold: UnfoldLaw<S>,
    volume: S,
    area: S,
    /// p_a and T_a.
    ambient: [S; 2],
    air: GasLaw<S>,
    inflators: Vec<InflatorLaw<S>>,
    outlet: OutletLaw<S>,
    /// q, W/(m²·K).
    heat: S,
    pub(super) friction: S,
    pub(super) friction_speed_squared: S,
    /// Indices of the spheres, and their reach.
    pub(super) spheres: Vec<(usize, S)>,
}

/// What a sphere does to a bag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pressed<S> {
    /// A and V, m² and m³.
    pub(super) area: S,
    volume: S,
    /// δ̇, m/s.
    closing: S,
    /// ∇s, space axes.
    pub(super) gradient: V3<S>,
    /// 1 where it has reached the mount plane or the middle.
    bottoms: S,
    /// Depth at which it is held, m.
    held: S,
}

/// A bag at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Now<S: Scalar> {
    pub(super) unfolded: Unfolded<S>,
    pub(super) pressed: [Pressed<S>; MOST_SPHERES],
    pub(super) gas: Mixture<S>,
    /// κ.
    pub(super) crowd: S,
    /// V̇_free, m³/s.
    growth: S,
    /// Σ V_k, m³, and Σ A_k, m².
    pub(super) taken: S,
    pub(super) covered: S,
    /// The spheres that have reached the mount plane or the middle: the sum of 2^i of their places i.
    pub(super) bottoms: S,
}

/// What flows into and out of a bag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flows<S> {
    /// kg/s.
    pub(super) inwards: S,
    pub(super) out: Outflow<S>,
}

impl<S: Scalar> Pressed<S> {
    #[inline(always)]
    fn none() -> Self {
        let o = S::zero();
        Pressed { area: o, volume: o, closing: o, gradient: V3::zero(), bottoms: o, held: o }
    }
}

impl BagLaw<f64> {
    pub(super) fn new(bag: &Bag) -> Self {
        BagLaw {
            frame: VEHICLE,
            first: 0,
            mount: V3::of(&bag.mount_m.coords),
            shape: ShapeLaw::new(bag),
            unfold: UnfoldLaw::new(bag),
            volume: bag.volume_m3,
            area: size(&bag.shape)[1],
            ambient: bag.ambient,
            air: GasLaw::new(&Gas::AIR),
            inflators: bag.inflators.iter().map(InflatorLaw::new).collect(),
            outlet: OutletLaw::new(bag),
            heat: bag.heat_w_m2_k,
            friction: bag.friction,
            friction_speed_squared: bag.friction_speed_m_s.powi(2),
            spheres: bag.spheres.iter().take(MOST_SPHERES).copied().collect(),
        }
    }

    /// Appends its numbers as they begin: air around it in the folded bag.
    pub(super) fn own(&mut self, numbers: &mut Vec<f64>) {
        self.first = numbers.len();
        let temperature = self.ambient[1];
        let energy = FOLDED * self.air.enthalpy(temperature) / (self.air.r * temperature);
        numbers.extend([energy, 0.0, 0.0, 0.0, FOLDED]);
        numbers.extend(self.inflators.iter().map(|_| 0.0));
    }
}

impl<S: Copy> BagLaw<S> {
    pub(super) fn is_like<A: Copy>(&self, other: &BagLaw<A>) -> bool {
        let spheres = self.spheres.iter().map(|s| s.0).eq(other.spheres.iter().map(|s| s.0));
        let inflators = self.inflators.iter().map(InflatorLaw::rows).eq(other.inflators.iter().map(InflatorLaw::rows));
        spheres
            && inflators
            && self.outlet.shape() == other.outlet.shape()
            && self.shape.kind() == other.shape.kind()
            && self.frame == other.frame
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &BagLaw<A>, f: &impl Fn(S, A) -> T) -> Option<BagLaw<T>> {
        let spheres = self.spheres.iter().zip(&other.spheres);
        Some(BagLaw {
            frame: self.frame,
            first: self.first,
            mount: self.mount.zip(&other.mount, f),
            shape: self.shape.zip(&other.shape, f)?,
            unfold: self.unfold.zip(&other.unfold, f),
            volume: f(self.volume, other.volume),
            area: f(self.area, other.area),
            ambient: std::array::from_fn(|i| f(self.ambient[i], other.ambient[i])),
            air: self.air.zip(&other.air, f),
            inflators: self.inflators.iter().zip(&other.inflators).map(|(a, b)| a.zip(b, f)).collect(),
            outlet: self.outlet.zip(&other.outlet, f),
            heat: f(self.heat, other.heat),
            friction: f(self.friction, other.friction),
            friction_speed_squared: f(self.friction_speed_squared, other.friction_speed_squared),
            spheres: spheres.map(|((sphere, a), (_, b))| (*sphere, f(*a, *b))).collect(),
        })
    }
}

impl<S: Scalar> BagLaw<S> {
    /// Whether it has fired, and there is a state of its gas.
    #[inline(always)]
    pub(super) fn acts(&self, at: &Instant<'_, S>) -> bool {
        !at.state.own().is_empty() && S::any(self.unfold.fired(at))
    }

    /// Where its numbers stand.
    #[inline(always)]
    pub(super) fn numbers(&self) -> std::ops::Range<usize> {
        self.first..self.first + MASSES + 1 + self.inflators.len()
    }

    /// What one of its numbers is 1 of: energies in J, masses in kg.
    #[inline(always)]
    fn units(&self) -> [S; 2] {
        let energy = self.ambient[0] * self.volume;
        [energy, energy / (self.air.r * self.ambient[1])]
    }

    /// W, J, and the mass that has flowed out, kg.
    #[inline(always)]
    pub(super) fn sums(&self, at: &Instant<'_, S>) -> [S; 2] {
        let (own, [energy, mass]) = (&at.state.own()[self.first..], self.units());
        [own[WORK] * energy, own[VENTED] * mass]
    }

    /// All its gases, the air first.
    #[inline(always)]
    fn gases(&self) -> impl Iterator<Item = GasLaw<S>> + '_ {
        [self.air].into_iter().chain(self.inflators.iter().map(|one| one.gas))
    }

    /// The bag from what it remembers.
    #[inline(always)]
    pub(super) fn now(&self, at: &Instant<'_, S>, past: &BagPast<S>) -> Now<S> {
        let (o, unfolded) = (S::zero(), self.unfold.at(at));
        let (mut taken, mut closing, mut covered, mut bottoms) = (o, o, o, o);
        let mut pressed = [Pressed::none(); MOST_SPHERES];
        for (i, (sphere, reach)) in self.spheres.iter().enumerate() {
            let one = self.press(at, &unfolded, (*sphere, *reach), past.held[i]);
            taken += one.volume;
            closing += one.area * one.closing;
            covered += one.area;
            bottoms += one.bottoms * flag(i);
            pressed[i] = one;
        }
        let envelope = self.volume * unfolded.share;
        let (share, crowd) = free(taken / envelope);
        let (own, [unit_energy, unit_mass]) = (&at.state.own()[self.first..], self.units());
        let masses = own[MASSES..].iter().map(|m| *m * unit_mass);
        let parts = self.gases().zip(masses);
        let mut gas = Mixture::new(own[ENERGY] * unit_energy, self.ambient[0], envelope * share, parts);
        gas.gauge = S::select(unfolded.fired, gas.gauge, o);
        Now {
            unfolded,
            pressed,
            gas,
            crowd,
            growth: self.volume * unfolded.growth * (share + crowd * taken / envelope) - crowd * closing,
            taken,
            covered,
            bottoms,
        }
    }

    /// What a sphere displaces, with its reach.
    #[inline(always)]
    fn press(&self, at: &Instant<'_, S>, unfolded: &Unfolded<S>, (sphere, reach): (usize, S), held: S) -> Pressed<S> {
        let (o, frame, site) = (S::zero(), &at.frames[self.frame], &at.spheres[sphere]);
        let (_, centre, velocity) = site.place(at.k);
        let seen = self.seen(at, sphere);
        let near = self.shape.near(seen, unfolded.scale);
        let depth = site.radius - near.distance;
        let (is_held, touches) = (held.gt(o), depth.gt(o));
        if !S::any(touches | is_held) {
            return Pressed::none();
        }
        let [area, volume] = displaced(S::select(is_held, held, depth).max(o), site.radius, self.shape.face());
        let relative = frame.axes.into_frame(velocity - frame.velocity_at(centre));
        let spread = unfolded.growth / (S::of(3.0) * unfolded.share) * (near.distance - near.gradient.dot(seen));
        let reaches = near.left.map_or(S::truth(false), |left| !depth.lt(left));
        let is_lost = near.from_middle.map_or(S::truth(false), |part| part.lt(S::of(LOST)));
        let holds = S::select(is_held, held, S::select(is_lost, depth, o));
        Pressed {
            area: S::select(touches & !is_held, area.max(o) * reach, o),
            volume: S::select(touches | is_held, volume * reach, o),
            closing: -near.gradient.dot(relative) - spread,
            gradient: frame.axes.out(near.gradient),
            bottoms: S::select(reaches | is_lost | is_held, S::one(), o),
            held: S::select(touches, holds, o),
        }
    }

    /// Remembers the spheres that have come to the middle, and the vents that open; where a sphere is held anew or let go.
    #[inline(always)]
    pub(super) fn commit(&self, now: &Now<S>, past: &mut BagPast<S>) -> S::Mask {
        let mut changes = S::truth(false);
        for (held, pressed) in past.held.iter_mut().zip(&now.pressed) {
            changes = changes | held.lt(pressed.held) | held.gt(pressed.held);
            *held = pressed.held;
        }
        self.outlet.commit(now.gas.gauge, past);
        changes
    }

    /// Writes the rates of the numbers that it owns, the body doing work on it at the rate `power`, W.
    #[inline(always)]
    pub(super) fn flow(
        &self,
        at: &Instant<'_, S>,
        now: &Now<S>,
        past: &BagPast<S>,
        power: S,
        rates: &mut [S],
    ) -> Flows<S> {
        let (o, gas, [p_a, t_a]) = (S::zero(), &now.gas, self.ambient);
        let [per_energy, per_mass] = self.units().map(|unit| S::one() / unit);
        let scale = now.unfolded.scale;
        let fabric = (self.area * scale * scale - now.covered).max(o);
        let out = self.outlet.at(at, gas, p_a, fabric, past);
        let leaving = out.vents + out.fabric;
        let heat = self.heat * fabric * (gas.temperature - t_a);
        let own = &at.state.own()[self.first..];
        let share = leaving / gas.mass;
        rates[MASSES] = -(own[MASSES] * share);
        let (mut inwards, mut enthalpy) = (o, o);
        for (i, inflator) in self.inflators.iter().enumerate() {
            let [flow, temperature] = inflator.at(at);
            inwards += flow;
            enthalpy += flow * inflator.gas.enthalpy(temperature);
            let at = MASSES + 1 + i;
            rates[at] = flow * per_mass - own[at] * share;
        }
        let pressed = gas.gauge * now.growth;
        rates[ENERGY] = (enthalpy - leaving * gas.enthalpy() - heat - pressed) * per_energy;
        rates[PRESSED] = pressed * per_energy;
        rates[WORK] = power * per_energy;
        rates[VENTED] = leaving * per_mass;
        for rate in rates {
            *rate = S::select(now.unfolded.fired, *rate, o);
        }
        Flows { inwards, out }
    }

    /// Keeps the balance of the gas at an accepted step.
    #[inline(always)]
    pub(super) fn keep_balance(&self, at: &Instant<'_, S>, now: &Now<S>, past: &mut BagPast<S>) {
        let (o, gas, [unit, _]) = (S::zero(), &now.gas, self.units());
        let begins = now.unfolded.fired & !past.fired.gt(o);
        if S::any(begins) {
            past.caught = S::select(begins, self.caught(at), past.caught);
            past.fired = S::select(begins, S::one(), past.fired);
        }
        let mean = (past.gauge + gas.gauge) * S::of(0.5);
        past.pressed += S::select(begins, o, mean * (gas.volume - past.volume));
        (past.gauge, past.volume) = (gas.gauge, gas.volume);
        let off = (at.state.own()[self.first + PRESSED] * unit - past.pressed).abs();
        past.residual = past.residual.max(off);
        past.greatest = past.greatest.max(gas.energy);
    }
}

impl<S: Scalar> BagLaw<S> {
    /// The spheres whose centres are within the full envelope: the sum of 2^i of their places i.
    pub(super) fn caught(&self, at: &Instant<'_, S>) -> S {
        let o = S::zero();
        self.spheres.iter().enumerate().fold(o, |sum, (i, (sphere, _))| {
            let distance = self.shape.near(self.seen(at, *sphere), S::one()).distance;
            sum + S::select(distance.lt(o), flag(i), o)
        })
    }

    /// A sphere's centre seen from the mount, in the axes of the frame, m.
    #[inline(always)]
    fn seen(&self, at: &Instant<'_, S>, sphere: usize) -> V3<S> {
        at.centre_in(sphere, self.frame) - self.mount
    }

    /// Temperature, volume and mass of the gas while it has not fired.
    #[inline(always)]
    pub(super) fn folded(&self) -> [S; 3] {
        let [_, mass] = self.units();
        [self.ambient[1], self.volume * S::of(FOLDED), mass * S::of(FOLDED)]
    }
}

/// 2^i.
#[inline(always)]
fn flag<S: Scalar>(i: usize) -> S {
    S::of(f64::from(1_u32 << i))
}

/// φ and κ.
#[inline(always)]
fn free<S: Scalar>(taken: S) -> (S, S) {
    let (one, rest) = (S::one(), S::of(1.0 - CROWDED));
    let beyond = (taken - S::of(CROWDED)).max(S::zero());
    if !S::any(beyond.gt(S::zero())) {
        return (one - taken, one);
    }
    let crowd = crate::forces::decay::decay(beyond / rest);
    (S::select(beyond.gt(S::zero()), rest * crowd, one - taken), crowd)
}
