//! The units: names, dimensions, factors.
//!
//! `lb` is the pound of mass, `lbf` the pound of force; `g` is standard gravity, and there is no gram.

use crate::trig;
use std::f64::consts::PI;

use super::Dimension;
use super::expression::UnitError;
use placed_text::nearest;

/// A named unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedUnit {
    /// Names; the first is the usual one.
    pub names: &'static [&'static str],
    /// Dimension that it measures.
    pub dimension: Dimension,
    /// SI value of one unit.
    pub factor: f64,
}

const fn unit(names: &'static [&'static str], [length, mass, time, angle]: [i32; 4], factor: f64) -> NamedUnit {
    NamedUnit { names, dimension: Dimension::new(length, mass, time, angle), factor }
}

const KELVIN: Dimension = Dimension::NONE.with_heat(1, 0);
const MOLE: Dimension = Dimension::NONE.with_heat(0, 1);

/// International pound, kg (exact, 1959).
const POUND_KG: f64 = 0.453_592_37;
/// Pound-force, N (exact: pound times standard gravity).
const POUND_FORCE_N: f64 = 4.448_221_615_260_5;
/// Standard gravity, m/s² (exact, 1901).
const GRAVITY_M_S2: f64 = 9.806_65;

/// All units, exponents of length, mass, time, angle. Every factor but π's is exact by definition.
#[rustfmt::skip]
pub const UNITS: &[NamedUnit] = &[
    unit(&["m", "metre", "meter"], [1, 0, 0, 0], 1.0),
    unit(&["km"], [1, 0, 0, 0], 1000.0),
    unit(&["cm"], [1, 0, 0, 0], 0.01),
    unit(&["mm"], [1, 0, 0, 0], 0.001),
    unit(&["in", "inch", "inches"], [1, 0, 0, 0], 0.0254),
    unit(&["ft", "foot", "feet"], [1, 0, 0, 0], 0.3048),
    unit(&["yd", "yard"], [1, 0, 0, 0], 0.9144),
    unit(&["mi", "mile", "miles"], [1, 0, 0, 0], 1609.344),
    unit(&["s", "sec", "second", "seconds"], [0, 0, 1, 0], 1.0),
    unit(&["ms", "msec"], [0, 0, 1, 0], 0.001),
    unit(&["us", "µs", "μs"], [0, 0, 1, 0], 1e-6),
    unit(&["min"], [0, 0, 1, 0], 60.0),
    unit(&["h", "hr", "hour"], [0, 0, 1, 0], 3600.0),
    unit(&["deg", "°", "degree", "degrees"], [0, 0, 0, 1], PI / 180.0),
    unit(&["rad", "radian", "radians"], [0, 0, 0, 1], 1.0),
    unit(&["rev", "turn"], [0, 0, 0, 1], 2.0 * PI),
    unit(&["mph"], [1, 0, -1, 0], 0.447_04),
    unit(&["kph", "kmh", "kmph"], [1, 0, -1, 0], 1.0 / 3.6),
    unit(&["knot", "knots"], [1, 0, -1, 0], 1852.0 / 3600.0),
    unit(&["g", "g0", "G"], [1, 0, -2, 0], GRAVITY_M_S2),
    unit(&["kg"], [0, 1, 0, 0], 1.0),
    unit(&["t", "tonne"], [0, 1, 0, 0], 1000.0),
    unit(&["lb", "lbm", "lbs"], [0, 1, 0, 0], POUND_KG),
    unit(&["oz"], [0, 1, 0, 0], POUND_KG / 16.0),
    unit(&["slug"], [0, 1, 0, 0], POUND_FORCE_N / 0.3048),
    unit(&["N"], [1, 1, -2, 0], 1.0),
    unit(&["kN"], [1, 1, -2, 0], 1000.0),
    unit(&["MN"], [1, 1, -2, 0], 1e6),
    unit(&["lbf"], [1, 1, -2, 0], POUND_FORCE_N),
    unit(&["kip"], [1, 1, -2, 0], 1000.0 * POUND_FORCE_N),
    unit(&["kgf", "kp"], [1, 1, -2, 0], GRAVITY_M_S2),
    unit(&["Nm"], [2, 1, -2, 0], 1.0),
    unit(&["J"], [2, 1, -2, 0], 1.0),
    unit(&["kJ"], [2, 1, -2, 0], 1000.0),
    unit(&["W"], [2, 1, -3, 0], 1.0),
    unit(&["Pa"], [-1, 1, -2, 0], 1.0),
    unit(&["kPa"], [-1, 1, -2, 0], 1000.0),
    unit(&["MPa"], [-1, 1, -2, 0], 1e6),
    unit(&["psi"], [-1, 1, -2, 0], POUND_FORCE_N / (0.0254 * 0.0254)),
    unit(&["Hz"], [0, 0, -1, 0], 1.0),
    unit(&["%"], [0, 0, 0, 0], 0.01),
    unit(&["l", "L", "litre", "liter"], [3, 0, 0, 0], 1e-3),
    unit(&["bar"], [-1, 1, -2, 0], 1e5),
    NamedUnit { names: &["K"], dimension: KELVIN, factor: 1.0 },
    NamedUnit { names: &["mol"], dimension: MOLE, factor: 1.0 },
    NamedUnit { names: &["kmol"], dimension: MOLE, factor: 1000.0 },
];

/// Value of a unit expression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// Dimension.
    pub dimension: Dimension,
    /// SI value of one unit.
    pub factor: f64,
}

/// Largest plausible power of a base dimension.
pub(super) const MAX_EXPONENT: i32 = 9;

/// The unit with this name.
///
/// # Errors
/// No unit has this name; `start` and `end` say where it stands.
pub(super) fn named(name: &str, start: usize, end: usize) -> Result<Scale, UnitError> {
    let known = UNITS.iter().find(|u| u.names.contains(&name));
    known.map(|u| Scale { dimension: u.dimension, factor: u.factor }).ok_or_else(|| {
        let all = UNITS.iter().flat_map(|u| u.names.iter().copied());
        let expected = "a unit such as m, in, s, deg, km/h, mph, g, kg, lb (mass), N, lbf (force)";
        let hint = nearest(name, all).map(|n| format!("did you mean `{n}`?"));
        UnitError { hint, ..UnitError::new(start, end, format!("unknown unit `{name}`"), expected) }
    })
}

/// Usual spelling of a unit's name written in other letters, `MPH` or `Deg`; none if it is no unit.
pub(super) fn usual_writing(name: &str) -> Option<&'static str> {
    let lower = name.to_lowercase();
    UNITS.iter().flat_map(|u| u.names.iter().copied()).find(|own| own.to_lowercase() == lower)
}

impl Scale {
    /// The power; none if its exponents are implausible.
    pub(super) fn power(self, n: i32) -> Option<Scale> {
        let raised =
            Scale { dimension: self.dimension.map(|exponent| exponent * n), factor: trig::powi(self.factor, n) };
        raised.is_sensible().then_some(raised)
    }

    /// The product; none if its exponents are implausible.
    pub(super) fn times(self, other: Scale) -> Option<Scale> {
        let product = Scale { dimension: self.dimension.plus(other.dimension), factor: self.factor * other.factor };
        product.is_sensible().then_some(product)
    }

    fn is_sensible(&self) -> bool {
        self.dimension.exponents().iter().all(|n| n.abs() <= MAX_EXPONENT) && self.factor.is_normal()
    }
}
