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
        match self {
            Self::HybridIii50M => "Hybrid III 50M",
            Self::HybridIii5F => "Hybrid III 5F",
            Self::Thor50M => "THOR 50M",
        }
    }

    /// Its mass, kg, as generally known.
    #[must_use]
    pub fn mass_kg(self) -> f64 {
        match self {
            Self::HybridIii50M => 77.7,
            Self::HybridIii5F => 49.0,
            Self::Thor50M => 76.7,
        }
    }
}
