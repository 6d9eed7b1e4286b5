//! Ideal gases and the mixture in a bag; equations of the theory manual's chapter on air bags.
//!
//! With c_p = a + bT of each part: h = aT + ½bT², u = h − RT. Of all parts together, B = Σm(a − R) and C = Σmb,
//! U = BT + ½CT², so that T = 2U/(B + √(B² + 2CU)).
//!
//! A bag's state is E = U + p_aV and not U, with p_a the pressure outside: its rate does not jump where gas begins or
//! ceases to fill the bag. Gas that does not fill V_free has p = p_a and the enthalpy E. If it would then take more
//! than V_free, it fills V_free and has U = E − p_aV_free. At mRT = p_aV_free both are the same.

use super::data::Gas;
use crate::forces::decay::{decay, logarithm};
use crate::motion::scalar::Scalar;

/// Constants of a gas.
#[derive(Clone, Copy, Debug)]
pub(super) struct GasLaw<S> {
    pub(super) r: S,
    a: S,
    b: S,
}

/// The gas mixture in a bag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mixture<S> {
    /// m, kg.
    pub(super) mass: S,
    /// mR, J/K.
    mass_r: S,
    /// T, K.
    pub(super) temperature: S,
    /// U, J.
    pub(super) energy: S,
    /// V, m³.
    pub(super) volume: S,
    /// p − p_a, Pa.
    pub(super) gauge: S,
    /// m c_v, J/K.
    heat: S,
}

impl<S: Copy> GasLaw<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &GasLaw<A>, f: &impl Fn(S, A) -> T) -> GasLaw<T> {
        GasLaw { r: f(self.r, other.r), a: f(self.a, other.a), b: f(self.b, other.b) }
    }
}

impl<S: Scalar> GasLaw<S> {
    pub(super) fn new(gas: &Gas) -> Self {
        GasLaw { r: S::of(gas.r_j_kg_k), a: S::of(gas.a_j_kg_k), b: S::of(gas.b_j_kg_k2) }
    }

    /// h, J/kg.
    #[inline(always)]
    pub(super) fn enthalpy(&self, temperature: S) -> S {
        (self.a + self.b * temperature * S::of(0.5)) * temperature
    }
}

impl<S: Scalar> Mixture<S> {
    /// Mixture of gas masses with total energy E in a bag with free volume V_free.
    #[inline(always)]
    pub(super) fn new(total: S, ambient: S, free: S, parts: impl Iterator<Item = (GasLaw<S>, S)>) -> Self {
        let o = S::zero();
        let (mut mass, mut mass_r, mut b, mut c) = (o, o, o, o);
        for (gas, m) in parts {
            mass += m;
            mass_r += m * gas.r;
            b += m * (gas.a - gas.r);
            c += m * gas.b;
        }
        let two = S::of(2.0);
        let temperature = |energy: S, b: S| two * energy / (b + (b * b + two * c * energy).sqrt());
        let slack = temperature(total, b + mass_r);
        let fills = (mass_r * slack).gt(ambient * free);
        let energy = S::select(fills, total - ambient * free, total - mass_r * slack);
        let temperature = if S::any(fills) { S::select(fills, temperature(energy, b), slack) } else { slack };
        let volume = S::select(fills, free, mass_r * temperature / ambient);
        let gauge = S::select(fills, (mass_r * temperature / free - ambient).max(o), o);
        Mixture { mass, mass_r, temperature, energy, volume, gauge, heat: b + c * temperature }
    }

    /// mRT = pV, J.
    #[inline(always)]
    fn pressure_volume(&self) -> S {
        self.mass_r * self.temperature
    }

    /// kg/m³.
    #[inline(always)]
    pub(super) fn density(&self) -> S {
        self.mass / self.volume
    }

    /// h of the mixture, J/kg.
    #[inline(always)]
    pub(super) fn enthalpy(&self) -> S {
        (self.energy + self.pressure_volume()) / self.mass
    }

    /// γ.
    #[inline(always)]
    fn gamma(&self) -> S {
        S::one() + self.mass_r / self.heat
    }

    /// Mass flow through a hole of 1 m² from p to p_a, kg/(s·m²), with Π = p_a/p limited to its critical (choked)
    /// value:
    ///
    /// ```text
    /// p/√(RT)·√(2γ/(γ − 1)·(Π^(2/γ) − Π^((γ + 1)/γ))),  Π ≥ Π_c = (2/(γ + 1))^(γ/(γ − 1))
    /// ```
    #[inline(always)]
    pub(super) fn outflow(&self, pressure: S, ambient: S) -> S {
        let (one, two) = (S::one(), S::of(2.0));
        let gamma = self.gamma();
        let over = gamma / (gamma - one);
        let mut ratio = ambient / pressure;
        // of no gas Π_c is above 1/√e
        if S::any(ratio.lt(S::of(0.61))) {
            ratio = ratio.max(decay(over * -logarithm(two / (gamma + one))));
        }
        let power = decay(-logarithm(ratio) / gamma);
        let shape = two * over * power * (power - ratio);
        pressure * shape.max(S::zero()).sqrt() / (self.pressure_volume() / self.mass).sqrt()
    }
}
