//! The gas of a bag at one instant, and its balance.
//!
//! The gas has one pressure and temperature. With E = U + p_aV of `gas` and V̇_free of `envelope`
//!
//! ```text
//! Ė = Σ ṁ_in h(T_in) − ṁ_out h(T) − q A_f (T − T_a) − (p − p_a) V̇_free
//! ```
//!
//! whether it fills the bag or not. The last term is summed twice: with the integrator's weights, and from pressures and volumes
//! at the ends of accepted steps. Their difference is the residual of the gas's balance.

use super::data::{Bag, FOLDED, Gas};
use super::envelope::{Envelope, EnvelopeLaw, Room};
use super::gas::{GasLaw, Mixture};
use super::inflator::{InflatorLaw, Outflow, OutletLaw};
use super::past::BagPast;
use super::unfold::{UnfoldLaw, Unfolded};
use crate::forces::element::Instant;
use crate::motion::scalar::Scalar;

/// Offsets of a bag's numbers in the state; then the masses of its gases, the air first.
const ENERGY: usize = 0;
const PRESSED: usize = 1;
const WORK: usize = 2;
const VENTED: usize = 3;
const MASSES: usize = 4;

/// Constants of a bag.
#[derive(Clone, Debug)]
pub struct BagLaw<S> {
    /// Offset of its numbers among those of force elements.
    first: usize,
    pub(super) envelope: EnvelopeLaw<S>,
    unfold: UnfoldLaw<S>,
    /// p_a and T_a.
    ambient: [S; 2],
    air: GasLaw<S>,
    inflators: Vec<InflatorLaw<S>>,
    outlet: OutletLaw<S>,
    /// q, W/(m²·K).
    heat: S,
    pub(super) friction: S,
    pub(super) friction_speed_squared: S,
}

/// A bag at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Now<'a, S: Scalar> {
    pub(super) unfolded: Unfolded<S>,
    pub(super) envelope: Envelope<'a, S>,
    pub(super) gas: Mixture<S>,
}

/// Flows into and out of a bag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flows<S> {
    /// kg/s.
    pub(super) inwards: S,
    pub(super) out: Outflow<S>,
}

impl BagLaw<f64> {
    pub(super) fn new(bag: &Bag) -> Self {
        BagLaw {
            first: 0,
            envelope: EnvelopeLaw::new(bag),
            unfold: UnfoldLaw::new(bag),
            ambient: bag.ambient,
            air: GasLaw::new(&Gas::AIR),
            inflators: bag.inflators.iter().map(InflatorLaw::new).collect(),
            outlet: OutletLaw::new(bag),
            heat: bag.heat_w_m2_k,
            friction: bag.friction,
            friction_speed_squared: bag.friction_speed_m_s.powi(2),
        }
    }

    /// Appends its initial numbers: ambient air in the folded bag.
    pub(super) fn own(&mut self, numbers: &mut Vec<f64>) {
        self.first = numbers.len();
        let temperature = self.ambient[1];
        let energy = FOLDED * self.air.enthalpy(temperature) / (self.air.r * temperature);
        numbers.extend([energy, 0.0, 0.0, 0.0, FOLDED]);
        numbers.extend(self.inflators.iter().map(|_| 0.0));
    }
}

impl<S: Scalar<Mask = bool>> BagLaw<S> {
    /// Fraction between two times at which it was due to fire, a vent to open, or a sphere to reach or leave the
    /// centre; none without.
    pub(super) fn due(&self, before: &BagPast<S>, now: &BagPast<S>, times_s: [S; 2]) -> Option<S> {
        let is_held = |depth: &S| depth.gt(S::zero());
        let held = before.held.iter().zip(&now.held).all(|(a, b)| is_held(a) == is_held(b));
        let fires = before.fired.lt(now.fired).then(|| self.unfold.due(times_s));
        let vent = self.outlet.due(before, now);
        held.then(|| fires.into_iter().chain(vent).reduce(S::min)).flatten()
    }
}

impl<S: Copy> BagLaw<S> {
    pub(super) fn is_like<A: Copy>(&self, other: &BagLaw<A>) -> bool {
        let inflators = self.inflators.iter().map(InflatorLaw::rows).eq(other.inflators.iter().map(InflatorLaw::rows));
        inflators && self.outlet.shape() == other.outlet.shape() && self.envelope.is_like(&other.envelope)
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &BagLaw<A>, f: &impl Fn(S, A) -> T) -> Option<BagLaw<T>> {
        Some(BagLaw {
            first: self.first,
            envelope: self.envelope.zip(&other.envelope, f)?,
            unfold: self.unfold.zip(&other.unfold, f),
            ambient: std::array::from_fn(|i| f(self.ambient[i], other.ambient[i])),
            air: self.air.zip(&other.air, f),
            inflators: self.inflators.iter().zip(&other.inflators).map(|(a, b)| a.zip(b, f)).collect(),
            outlet: self.outlet.zip(&other.outlet, f),
            heat: f(self.heat, other.heat),
            friction: f(self.friction, other.friction),
            friction_speed_squared: f(self.friction_speed_squared, other.friction_speed_squared),
        })
    }
}

impl<S: Scalar> BagLaw<S> {
    /// Whether it has fired, and its gas has a state.
    #[inline(always)]
    pub(super) fn acts(&self, at: &Instant<'_, S>) -> bool {
        !at.state.own().is_empty() && S::any(self.unfold.fired(at))
    }

    /// Range of its numbers.
    #[inline(always)]
    pub(super) fn numbers(&self) -> std::ops::Range<usize> {
        self.first..self.first + MASSES + 1 + self.inflators.len()
    }

    /// Unit sizes of its numbers: energies in J, masses in kg.
    #[inline(always)]
    fn units(&self) -> [S; 2] {
        let energy = self.ambient[0] * self.envelope.volume;
        [energy, energy / (self.air.r * self.ambient[1])]
    }

    /// W, J, and the mass vented, kg.
    #[inline(always)]
    pub(super) fn sums(&self, at: &Instant<'_, S>) -> [S; 2] {
        let (own, [energy, mass]) = (&at.state.own()[self.first..], self.units());
        [own[WORK] * energy, own[VENTED] * mass]
    }

    /// Temperature, volume and mass of the gas before firing.
    #[inline(always)]
    pub(super) fn folded(&self) -> [S; 3] {
        let [_, mass] = self.units();
        [self.ambient[1], self.envelope.volume * S::of(FOLDED), mass * S::of(FOLDED)]
    }

    /// All gases, the air first.
    #[inline(always)]
    fn gases(&self) -> impl Iterator<Item = GasLaw<S>> + '_ {
        [self.air].into_iter().chain(self.inflators.iter().map(|one| one.gas))
    }

    /// The bag at its stored state.
    #[inline(always)]
    pub(super) fn now<'a>(&self, at: &Instant<'_, S>, past: &BagPast<S>, room: &'a mut Room<S>) -> Now<'a, S> {
        let unfolded = self.unfold.at(at);
        let envelope = self.envelope.at(at, &unfolded, &past.held, room);
        let (own, [unit_energy, unit_mass]) = (&at.state.own()[self.first..], self.units());
        let parts = self.gases().zip(own[MASSES..].iter().map(|m| *m * unit_mass));
        let mut gas = Mixture::new(own[ENERGY] * unit_energy, self.ambient[0], envelope.free, parts);
        gas.gauge = S::select(unfolded.fired, gas.gauge, S::zero());
        Now { unfolded, envelope, gas }
    }

    /// Stores the spheres that reached the centre, and opened vents; true where a sphere is newly held or released.
    #[inline(always)]
    pub(super) fn commit(&self, now: &Now<'_, S>, past: &mut BagPast<S>) -> S::Mask {
        let (mut changes, fired) = (S::truth(false), now.unfolded.fired);
        for (held, pressed) in past.held.iter_mut().zip(now.envelope.pressed) {
            // a bag beside it in lanes may have fired before it
            let is_held = S::select(fired, pressed.held, *held);
            changes = changes | held.lt(is_held) | held.gt(is_held);
            *held = is_held;
        }
        self.outlet.commit(fired, now.gas.gauge, past);
        changes
    }

    /// Writes the rates of its numbers; `power` is the work rate of the body on it, W.
    #[inline(always)]
    pub(super) fn flow(
        &self,
        at: &Instant<'_, S>,
        now: &Now<'_, S>,
        past: &BagPast<S>,
        power: S,
        rates: &mut [S],
    ) -> Flows<S> {
        let (o, gas, [p_a, t_a]) = (S::zero(), &now.gas, self.ambient);
        let [energy, mass] = self.units();
        let (per_energy, per_mass) = (S::one() / energy, S::one() / mass);
        let scale = now.unfolded.scale;
        let fabric = (self.envelope.area * scale * scale - now.envelope.covered).max(o);
        let out = self.outlet.at(at, gas, p_a, fabric, past);
        let leaving = out.vents + out.fabric;
        let heat = self.heat * fabric * (gas.temperature - t_a);
        let own = &at.state.own()[self.first..];
        let share = leaving / gas.mass;
        rates[MASSES] = -(own[MASSES] * share);
        let [inwards, enthalpy] = self.blow(at, share, rates);
        let pressed = gas.gauge * now.envelope.growth;
        rates[ENERGY] = (enthalpy - leaving * gas.enthalpy() - heat - pressed) * per_energy;
        rates[PRESSED] = pressed * per_energy;
        rates[WORK] = power * per_energy;
        rates[VENTED] = leaving * per_mass;
        for rate in rates {
            *rate = S::select(now.unfolded.fired, *rate, o);
        }
        Flows { inwards, out }
    }

    /// Writes the mass rates of the inflators' gases, of which the fraction `share` leaves per second; their mass flow,
    /// kg/s, and enthalpy flow, W.
    #[inline(always)]
    fn blow(&self, at: &Instant<'_, S>, share: S, rates: &mut [S]) -> [S; 2] {
        let (own, [_, unit]) = (&at.state.own()[self.first..], self.units());
        let mut sums = [S::zero(); 2];
        for (i, inflator) in self.inflators.iter().enumerate() {
            let [flow, temperature] = inflator.at(at);
            sums[0] += flow;
            sums[1] += flow * inflator.gas.enthalpy(temperature);
            let at = MASSES + 1 + i;
            rates[at] = flow / unit - own[at] * share;
        }
        sums
    }

    /// Updates the gas balance at an accepted step.
    #[inline(always)]
    pub(super) fn keep_balance(&self, at: &Instant<'_, S>, now: &Now<'_, S>, past: &mut BagPast<S>) {
        let (o, gas, [unit, _]) = (S::zero(), &now.gas, self.units());
        let fired = now.unfolded.fired;
        let begins = fired & !past.fired.gt(o);
        if S::any(begins) {
            past.caught = S::select(begins, self.envelope.caught(at), past.caught);
            past.fired = S::select(begins, S::one(), past.fired);
        }
        let mean = (past.gauge + gas.gauge) * S::of(0.5);
        let pressed = S::select(begins, past.pressed, past.pressed + mean * (gas.volume - past.volume));
        let off = (at.state.own()[self.first + PRESSED] * unit - pressed).abs();
        past.pressed = S::select(fired, pressed, past.pressed);
        past.gauge = S::select(fired, gas.gauge, past.gauge);
        past.volume = S::select(fired, gas.volume, past.volume);
        past.residual = S::select(fired, past.residual.max(off), past.residual);
        past.greatest = S::select(fired, past.greatest.max(gas.energy), past.greatest);
    }
}
