//! Crash dummies that limits and risk curves are stated for.

/// A dummy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dummy {
    /// Hybrid III, 50th percentile male.
    HybridIii50M,
    /// Hybrid III, 5th percentile female.
    HybridIii5F,
    /// THOR, 50th percentile male.
    Thor50M,
}

impl Dummy {
    /// Its usual name.
    #[must_use]
    pub fn name(self) -> &'static str {
        ["Hybrid III 50M", "Hybrid III 5F", "THOR 50M"][self as usize]
    }

    /// Its mass, kg, as generally known.
    #[must_use]
    pub fn mass_kg(self) -> f64 {
        [77.7, 49.0, 76.7][self as usize]
    }
}
