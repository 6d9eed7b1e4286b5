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
}
