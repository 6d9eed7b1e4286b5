//! Crash dummies that criteria, limits and risk curves are stated for.

/// A dummy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dummy {
    /// Hybrid III, 50th percentile male.
    HybridIii50M,
    /// Hybrid III, 5th percentile female.
    HybridIii5F,
    /// THOR, 50th percentile male.
    Thor50M,
    /// Hybrid III, 95th percentile male.
    HybridIii95M,
    /// EuroSID-1, 50th percentile male.
    EuroSid1,
    /// ES-2 (EuroSID-2), 50th percentile male.
    Es2,
    /// ES-2re: ES-2 with rib extensions.
    Es2Re,
    /// SID-IIs, 5th percentile female.
    SidIis,
    /// WorldSID, 50th percentile male.
    WorldSid50M,
    /// WorldSID, 5th percentile female.
    WorldSid5F,
    /// BioRID-II, 50th percentile male.
    BioRidIi,
}

/// Direction of impact that a dummy or a rule is for. Criteria of another direction are meaningless for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Blow {
    /// From the front.
    Front,
    /// From the side.
    Side,
    /// From behind.
    Rear,
    /// By a vehicle, on foot.
    OnFoot,
}

use Dummy::{
    BioRidIi, Es2, Es2Re, EuroSid1, HybridIii5F, HybridIii50M, HybridIii95M, SidIis, Thor50M, WorldSid5F, WorldSid50M,
};

impl Dummy {
    /// Every dummy known here.
    pub const ALL: [Self; 11] = [
        HybridIii50M,
        HybridIii5F,
        Thor50M,
        HybridIii95M,
        EuroSid1,
        Es2,
        Es2Re,
        SidIis,
        WorldSid50M,
        WorldSid5F,
        BioRidIi,
    ];

    /// The frontal dummies of one family, by size.
    pub const SIZES: [Dummy; 3] = [HybridIii5F, HybridIii50M, HybridIii95M];

    /// Its usual name.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// Its mass, kg, as generally known.
    #[must_use]
    pub fn mass_kg(self) -> f64 {
        self.row().1
    }

    /// Its direction of impact.
    #[must_use]
    pub fn blow(self) -> Blow {
        self.row().2
    }

    fn row(self) -> (&'static str, f64, Blow) {
        match self {
            HybridIii50M => ("Hybrid III 50M", 77.7, Blow::Front),
            HybridIii5F => ("Hybrid III 5F", 49.0, Blow::Front),
            Thor50M => ("THOR 50M", 76.7, Blow::Front),
            HybridIii95M => ("Hybrid III 95M", 101.2, Blow::Front),
            EuroSid1 => ("EuroSID-1", 72.0, Blow::Side),
            Es2 => ("ES-2", 72.0, Blow::Side),
            Es2Re => ("ES-2re", 72.4, Blow::Side),
            SidIis => ("SID-IIs", 44.1, Blow::Side),
            WorldSid50M => ("WorldSID 50M", 74.4, Blow::Side),
            WorldSid5F => ("WorldSID 5F", 45.9, Blow::Side),
            BioRidIi => ("BioRID-II", 78.2, Blow::Rear),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_dummy_stands_once_under_its_own_name() {
        for (i, dummy) in Dummy::ALL.into_iter().enumerate() {
            assert_eq!(dummy as usize, i);
            assert!(Dummy::ALL[..i].iter().all(|other| other.name() != dummy.name()), "{}", dummy.name());
            assert!((40.0..110.0).contains(&dummy.mass_kg()));
        }
    }
}
