//! What a surface or a webbing is made of: the bilinear dissipative spring, as data.
//!
//! Report: "Magnitude of the Contact Force", Fig. 16 (lost; the curve is our reading, see the theory manual).

use crate::forces::spring::LEAST_FRACTION;
use crate::problem::Problems;

/// Force over deformation while loading: slope K₁ up to Δ_b, then K₂.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BilinearSpring {
    /// K₁.
    pub k1_n_per_m: f64,
    /// K₂.
    pub k2_n_per_m: f64,
    /// Δ_b, where the slope changes.
    pub break_m: f64,
    /// μ₁, fraction of the energy stored below Δ_b that unloading returns, 0 to 1.
    pub returned_1: f64,
    /// μ₂, the same above Δ_b.
    pub returned_2: f64,
}

impl BilinearSpring {
    /// One straight line of slope `k_n_per_m` (N/m), of whose energy unloading returns the fraction `returned`.
    pub fn linear(k_n_per_m: f64, returned: f64) -> Self {
        BilinearSpring {
            k1_n_per_m: k_n_per_m,
            k2_n_per_m: k_n_per_m,
            break_m: 0.0,
            returned_1: returned,
            returned_2: returned,
        }
    }

    /// The same up to the deformation `break_m` (m), and the slope `k2_n_per_m` (N/m) beyond.
    pub fn then(self, break_m: f64, k2_n_per_m: f64) -> Self {
        BilinearSpring { break_m, k2_n_per_m, ..self }
    }

    /// Reports what is wrong with it under `path`.
    pub(crate) fn check(&self, path: &str, problems: &mut Problems) {
        problems.check_at_least_zero(&format!("{path}.k1"), self.k1_n_per_m, "N/m");
        problems.check_at_least_zero(&format!("{path}.k2"), self.k2_n_per_m, "N/m");
        problems.check_at_least_zero(&format!("{path}.break_at"), self.break_m, "m");
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

/// Whether a pair remembers its crush after it has opened.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Memory {
    /// Δ_m is forgotten when the pair opens (padding that recovers).
    #[default]
    Reset,
    /// Δ_m is kept for that pair (crushed metal).
    Retain,
}

/// A contact material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Unique name.
    pub name: String,
    /// Normal force law.
    pub spring: BilinearSpring,
    /// f, coefficient of friction.
    pub friction: f64,
    /// v_s, speed at which friction reaches 1/√2 of its full value. Default 0.127 m/s (5 in/s).
    pub friction_speed_m_s: f64,
    /// What is remembered after opening.
    pub memory: Memory,
}

impl Material {
    /// A material with the usual friction speed, which forgets its crush when a pair opens.
    pub fn new(name: impl Into<String>, spring: BilinearSpring, friction: f64) -> Self {
        Material {
            name: name.into(),
            spring,
            friction,
            friction_speed_m_s: DEFAULT_FRICTION_SPEED_M_S,
            memory: Memory::default(),
        }
    }
}

/// v_s unless a scenario gives another: 5 in/s.
pub const DEFAULT_FRICTION_SPEED_M_S: f64 = 0.127;
