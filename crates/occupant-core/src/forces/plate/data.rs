//! Plates as data: the resistance to their deflections.

use crate::body::{Plate, Shares};
use crate::forces::function::Function;

/// Spring and damper over the deflection of a plate, or over a weighted sum of deflections.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Name: that of its plate, or of a link between plates.
    pub name: String,
    /// Plates (indices) with the factors a of their deflections: x = Σ a s.
    pub of: Shares,
    /// Force over x, with its returned fraction.
    pub spring: Function,
    /// The same over −x for x below 0; as `spring` if none.
    pub outward: Option<Function>,
    /// Damping.
    pub damper: Damper,
    /// Parallel Maxwell branch: stiffness, N/m, and time constant, s.
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

/// Setup data of plates.
#[derive(Clone, Copy, Debug)]
pub struct PlateData<'a> {
    /// The plates of the bodies.
    pub plates: &'a [Plate],
    /// Their springs and dampers.
    pub bands: &'a [Band],
}

impl Band {
    /// The same for one of several bodies, with this name, whose plates begin at index `first`.
    pub(crate) fn of_member(&self, name: String, first: usize) -> Self {
        let of = self.of.iter().map(|(plate, factor)| (first + plate, *factor)).collect();
        Band { name, of, ..self.clone() }
    }
}
