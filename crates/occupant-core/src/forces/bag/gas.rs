//! Ideal gases and the mixture in a bag (B.1 of the theory manual's chapter on air bags).
//!
//! With c_p = a + bT of each part: h = aT + ½bT², u = h − RT. Of all parts together, B = Σm(a − R) and C = Σmb,
//! U = BT + ½CT², so that
//!
//! ```text
//! T = 2U/(B + √(B² + 2CU))
//! ```

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

/// All gas of a bag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mixture<S> {
    /// m, kg.
    pub(super) mass: S,
    /// mR, J/K.
    pub(super) mass_r: S,
    /// T, K.
    pub(super) temperature: S,
    /// U, J.
    pub(super) energy: S,
    /// m c_v, J/K.
    pub(super) heat: S,
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

    /// u, J/kg.
    #[inline(always)]
    pub(super) fn energy(&self, temperature: S) -> S {
        self.enthalpy(temperature) - self.r * temperature
    }
}

impl<S: Scalar> Mixture<S> {
    /// Of masses of these gases with the energy U together.
    #[inline(always)]
    pub(super) fn new(energy: S, parts: impl Iterator<Item = (GasLaw<S>, S)>) -> Self {
        let o = S::zero();
        let (mut mass, mut mass_r, mut b, mut c) = (o, o, o, o);
        for (gas, m) in parts {
            mass += m;
            mass_r += m * gas.r;
            b += m * (gas.a - gas.r);
            c += m * gas.b;
        }
        let two = S::of(2.0);
        let temperature = two * energy / (b + (b * b + two * c * energy).sqrt());
        Mixture { mass, mass_r, temperature, energy, heat: b + c * temperature }
    }

    /// mRT = pV, J.
    #[inline(always)]
    pub(super) fn pressure_volume(&self) -> S {
        self.mass_r * self.temperature
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

    /// Mass flow through a hole of 1 m² from p to p_a, kg/(s·m²), with Π = p_a/p held above that at which the flow chokes:
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
