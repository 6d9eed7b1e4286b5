//! Plates as data: the resistance to their deflections.

use crate::body::{Plate, Shares};
use crate::forces::function::Function;

/// A spring and a damper over the deflection of a plate, or over a sum of those of several.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Its name: that of its plate, or of a link between plates.
    pub name: String,
    /// Plates (indices) with the factors a of their deflections: x = Σ a s.
    pub of: Shares,
    /// Force over x, with what of it comes back.
    pub spring: Function,
    /// The same over −x where x is below 0; as `spring` if none.
    pub outward: Option<Function>,
    /// Damping.
    pub damper: Damper,
    /// Maxwell branch beside it: stiffness, N/m, and time constant, s.
    pub viscous: Option<[f64; 2]>,
}

/// Damping of a band: c₁ẋ + c₂ẋ² inwards, c₀ẋ outwards.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Damper {
    /// c₁, N·s/m.
    pub linear_n_s_m: f64,
    /// c₂, N·s²/m².
    pub quadratic_n_s2_m2: f64,
    /// c₀, N·s/m.
    pub outward_n_s_m: f64,
}

/// What a setup says of plates.
#[derive(Clone, Copy, Debug)]
pub struct PlateData<'a> {
    /// The plates of the bodies.
    pub plates: &'a [Plate],
    /// What resists them.
    pub bands: &'a [Band],
}

impl Band {
    /// The same among several bodies, of one with this name whose plates begin at `first`.
    pub(crate) fn of_member(&self, name: String, first: usize) -> Self {
        let of = self.of.iter().map(|(plate, factor)| (first + plate, *factor)).collect();
        Band { name, of, ..self.clone() }
    }
}
