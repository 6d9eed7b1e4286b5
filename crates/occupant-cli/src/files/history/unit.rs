//! Units that histories are shown in.

use clap::ValueEnum;
use crash_measures::unit::{Shown, Unit};

/// Units asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum UnitChoice {
    /// Metre, second, newton
    Si,
    /// As si, but accelerations in g (9.80665 m/s²)
    G,
    /// Inch, pound-force, second
    #[value(name = "in-lbf-s")]
    InchPound,
}

impl UnitChoice {
    /// As on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            UnitChoice::Si => "si",
            UnitChoice::G => "g",
            UnitChoice::InchPound => "in-lbf-s",
        }
    }
}

/// The unit for a channel's values; angles in radians.
pub(crate) fn shown(unit: Unit, choice: UnitChoice) -> Shown {
    match (unit, choice) {
        (Unit::MetrePerSecondSquared, UnitChoice::G) => unit.shown_in("g"),
        (_, UnitChoice::InchPound) => unit.shown_in_inch_pound(),
        _ => unit.shown(),
    }
}

/// The unit for a plot: as [`shown`], but angles in degrees and times in milliseconds.
pub(crate) fn plotted(unit: Unit, choice: UnitChoice) -> Shown {
    match unit {
        Unit::Radian => unit.shown_in("deg"),
        Unit::Second => unit.shown_in("ms"),
        _ => shown(unit, choice),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crash_measures::unit::parse;

    /// The names in headings are read back by the reader of unit expressions, as the same size and dimension.
    #[test]
    fn every_unit_reads_back() {
        use Unit::*;
        let dynamic = [Metre, MetrePerSecond, MetrePerSecondSquared, Newton, NewtonMetre, Joule, Second];
        for unit in dynamic.into_iter().chain([Radian, RadianPerSecond, RadianPerSecondSquared]) {
            for choice in [UnitChoice::Si, UnitChoice::G, UnitChoice::InchPound] {
                for shown in [shown(unit, choice), plotted(unit, choice)] {
                    let scale = parse(&shown.ascii(), 0).unwrap();
                    assert_eq!((scale.dimension, scale.factor), (unit.dimension(), shown.si), "{}", shown.ascii());
                }
            }
        }
    }
}
