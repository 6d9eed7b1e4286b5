//! Measures of a run by type.

/// A measure of an occupant's run, if the body has the instrument.
pub trait Measure: Copy {
    /// Its name among the figures of a run.
    const NAME: &'static str;
    /// Its SI unit; `1` for a plain number.
    const UNIT: &'static str;
}

macro_rules! measures {
    ($($(#[$words:meta])* $Type:ident: $name:literal, $unit:literal;)+) => {
        $(
            $(#[$words])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub struct $Type;

            impl Measure for $Type {
                const NAME: &'static str = $name;
                const UNIT: &'static str = $unit;
            }
        )+

        /// All names, for tests.
        #[cfg(test)]
        pub(crate) const ALL: &[(&str, &str)] = &[$(($name, $unit)),+];
    };
}

measures! {
    /// Head injury criterion over at most 15 ms (49 CFR 571.208).
    Hic15: "hic15", "1";
    /// Head injury criterion over at most 36 ms.
    Hic36: "hic36", "1";
    /// Largest acceleration of the head, m/s².
    HeadPeak: "head.peak", "m/s²";
    /// Acceleration of the head exceeded for 3 ms in total, m/s².
    HeadThreeMs: "head.three_ms_cumulative", "m/s²";
    /// Largest acceleration of the chest, m/s².
    ChestPeak: "chest.peak", "m/s²";
    /// Acceleration of the chest exceeded for 3 ms in total, m/s².
    ChestThreeMs: "chest.three_ms_cumulative", "m/s²";
    /// Largest acceleration of the pelvis, m/s².
    PelvisPeak: "pelvis.peak", "m/s²";
    /// Neck injury criterion.
    Nij: "nij", "1";
    /// Largest error of the energy balance, relative to the largest energy.
    EnergyError: "energy.balance_error", "1";
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Case, ErrorKind, Simulate};

    /// Every measure is a figure of a run, in its unit.
    #[test]
    fn every_measure_is_there() {
        let mut case = Case::from_toml(include_str!("../examples/driver.toml")).unwrap();
        case.ends_at(0.02);
        let results = case.model().unwrap().simulate().unwrap();
        for (name, unit) in ALL {
            let figure = results.figures().iter().find(|figure| figure.name == *name);
            assert_eq!(figure.map(|figure| figure.unit), Some(*unit), "{name}");
        }
        assert!(results.measure(ChestPeak).unwrap() > 0.0);
        let wrong = results.figure("hci15").unwrap_err();
        assert_eq!(wrong.kind(), ErrorKind::Name);
        assert_eq!(wrong.unknown().unwrap().nearest.as_deref(), Some("hic15"));
        let wrong = results.channel("head.place.x").unwrap_err();
        assert!(
            wrong.kind() == ErrorKind::Name && wrong.to_string().contains("did you mean `head.position.x`"),
            "{wrong}"
        );
        assert_eq!(results.channel("head.acceleration.x").unwrap().len(), results.time_s().len());
    }
}
