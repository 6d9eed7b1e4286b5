//! Measures of a run by type.

/// A measure that every run of an occupant has, or has where its body has the instrument.
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
    /// Greatest acceleration of the head, m/s².
    HeadPeak: "head.peak", "m/s^2";
    /// Acceleration of the head that is exceeded for 3 ms in all, m/s².
    HeadThreeMs: "head.three_ms_cumulative", "m/s^2";
    /// Greatest acceleration of the chest, m/s².
    ChestPeak: "chest.peak", "m/s^2";
    /// Acceleration of the chest that is exceeded for 3 ms in all, m/s².
    ChestThreeMs: "chest.three_ms_cumulative", "m/s^2";
    /// Greatest acceleration of the pelvis, m/s².
    PelvisPeak: "pelvis.peak", "m/s^2";
    /// Neck injury criterion.
    Nij: "nij", "1";
    /// Greatest imbalance of energy as a part of the greatest energy.
    EnergyError: "energy.balance_error", "1";
}
