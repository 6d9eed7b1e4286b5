//! Units that histories are shown in.

use std::f64::consts::PI;

use clap::ValueEnum;
use crash_measures::unit::Dimension;
use crash_measures::unit::Unit;
use occupant_core::model::setup::STANDARD_GRAVITY_M_S2;

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

/// A unit to show values in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shown {
    /// For people: `m/s²`.
    pub(crate) symbol: &'static str,
    /// In ASCII, as unit expressions of scenarios and tables have it: `m/s^2`.
    pub(crate) ascii: &'static str,
    /// SI units in one of it.
    pub(crate) si: f64,
}

const fn shown_as(symbol: &'static str, ascii: &'static str, si: f64) -> Shown {
    Shown { symbol, ascii, si }
}

/// International inch, m (exact).
const INCH_M: f64 = 0.0254;
/// Pound-force, N (exact: international pound times standard gravity).
const POUND_FORCE_N: f64 = 0.453_592_37 * STANDARD_GRAVITY_M_S2;
const INCH_POUND_J: f64 = INCH_M * POUND_FORCE_N;

/// The unit for a channel's values; angles in radians.
pub(crate) const fn shown(unit: Unit, choice: UnitChoice) -> Shown {
    use UnitChoice::{G, InchPound};
    match (unit, choice) {
        (Unit::MetrePerSecondSquared, G) => shown_as("g", "g", STANDARD_GRAVITY_M_S2),
        (Unit::Metre, InchPound) => shown_as("in", "in", INCH_M),
        (Unit::MetrePerSecond, InchPound) => shown_as("in/s", "in/s", INCH_M),
        (Unit::MetrePerSecondSquared, InchPound) => shown_as("in/s²", "in/s^2", INCH_M),
        (Unit::Newton, InchPound) => shown_as("lbf", "lbf", POUND_FORCE_N),
        (Unit::NewtonMetre | Unit::Joule, InchPound) => shown_as("in·lbf", "in*lbf", INCH_POUND_J),
        (Unit::NewtonMetre, _) => shown_as("N·m", "N*m", 1.0),
        (Unit::One, _) => shown_as("–", "1", 1.0),
        (unit, _) => shown_as(unit.symbol(), unit.expression(), 1.0),
    }
}

/// The unit for a plot: as [`shown`], but angles in degrees and times in milliseconds.
pub(crate) const fn plotted(unit: Unit, choice: UnitChoice) -> Shown {
    match unit {
        Unit::Radian => shown_as("°", "deg", PI / 180.0),
        Unit::Second => shown_as("ms", "ms", 1e-3),
        _ => shown(unit, choice),
    }
}

/// What a channel's unit measures.
pub(crate) const fn dimension(unit: Unit) -> Dimension {
    unit.dimension()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crash_measures::unit::parse;

    const ALL: [Unit; 11] = [
        Unit::Metre,
        Unit::MetrePerSecond,
        Unit::MetrePerSecondSquared,
        Unit::Radian,
        Unit::RadianPerSecond,
        Unit::RadianPerSecondSquared,
        Unit::Newton,
        Unit::NewtonMetre,
        Unit::Joule,
        Unit::Second,
        Unit::One,
    ];

    /// The names in headings are read back by the reader of unit expressions, as the same size and dimension.
    #[test]
    fn every_unit_reads_back() {
        for unit in ALL.into_iter().filter(|u| *u != Unit::One) {
            for choice in [UnitChoice::Si, UnitChoice::G, UnitChoice::InchPound] {
                for shown in [shown(unit, choice), plotted(unit, choice)] {
                    let scale = parse(shown.ascii, 0).unwrap();
                    assert_eq!(scale.dimension, dimension(unit), "{}", shown.ascii);
                    assert!((scale.factor / shown.si - 1.0).abs() < 1e-15, "{}", shown.ascii);
                }
            }
        }
    }
}
