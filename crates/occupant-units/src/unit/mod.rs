//! The one table of units: what results and scenarios are measured in, the names that people may write, and the reader of
//! unit expressions.
//!
//! Inside the program there are SI units only, angles in radians. Conversion happens where a number is read or shown.

mod expression;
mod named;
mod shown;

pub use expression::{UnitError, parse, parse_heading};
pub use named::{NamedUnit, Scale, UNITS};
pub use shown::Shown;

/// Exponents of length, mass, time, angle, temperature and amount of substance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dimension {
    /// Length.
    pub length: i32,
    /// Mass.
    pub mass: i32,
    /// Time.
    pub time: i32,
    /// Plane angle, distinct from plain numbers so that `15` and `15 deg` cannot be confused.
    pub angle: i32,
    /// Temperature.
    pub temperature: i32,
    /// Amount of substance.
    pub amount: i32,
}

impl Dimension {
    /// Dimension of plain numbers.
    pub const NONE: Dimension = Dimension::new(0, 0, 0, 0);

    /// A dimension from its exponents, without temperature and amount of substance.
    pub const fn new(length: i32, mass: i32, time: i32, angle: i32) -> Self {
        Dimension { length, mass, time, angle, temperature: 0, amount: 0 }
    }

    /// The same with exponents of temperature and amount of substance.
    pub const fn with_heat(self, temperature: i32, amount: i32) -> Self {
        Dimension { temperature, amount, ..self }
    }

    /// All exponents.
    pub(crate) fn exponents(self) -> [i32; 6] {
        [self.length, self.mass, self.time, self.angle, self.temperature, self.amount]
    }

    fn of(e: [i32; 6]) -> Self {
        Dimension::new(e[0], e[1], e[2], e[3]).with_heat(e[4], e[5])
    }

    /// The dimension with f applied to every exponent.
    pub(crate) fn map(self, f: impl Fn(i32) -> i32) -> Self {
        Dimension::of(self.exponents().map(f))
    }

    /// Dimension of a product.
    pub(crate) fn plus(self, other: Dimension) -> Self {
        let (a, b) = (self.exponents(), other.exponents());
        Dimension::of(std::array::from_fn(|i| a[i] + b[i]))
    }

    /// Whether a value of dimension `self` is accepted where `wanted` is expected.
    ///
    /// The radian of "per radian" may be left out, as in `5.73 in·lbf·s` for a rotational damper.
    pub fn serves_as(self, wanted: Dimension) -> bool {
        let silent_radian = Dimension { angle: wanted.angle, ..self };
        self == wanted || (wanted.angle < 0 && self.angle == 0 && silent_radian == wanted)
    }
}

/// An SI unit of a result or of a number of a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// m.
    Metre,
    /// m/s.
    MetrePerSecond,
    /// m/s².
    MetrePerSecondSquared,
    /// rad.
    Radian,
    /// rad/s.
    RadianPerSecond,
    /// rad/s².
    RadianPerSecondSquared,
    /// N.
    Newton,
    /// N·m.
    NewtonMetre,
    /// J.
    Joule,
    /// s.
    Second,
    /// A number.
    One,
    /// kg.
    Kilogram,
    /// kg·m².
    KilogramMetreSquared,
    /// N/m.
    NewtonPerMetre,
    /// N·m/rad.
    NewtonMetrePerRadian,
    /// N·m·s/rad.
    NewtonMetreSecondPerRadian,
    /// N·m/rad².
    NewtonMetrePerRadianSquared,
    /// N·m/rad³.
    NewtonMetrePerRadianCubed,
    /// Pa.
    Pascal,
    /// K.
    Kelvin,
    /// m².
    MetreSquared,
    /// m³.
    MetreCubed,
    /// kg/s.
    KilogramPerSecond,
    /// kg/mol.
    KilogramPerMole,
    /// J/(kg·K).
    JoulePerKilogramKelvin,
    /// J/(kg·K²).
    JoulePerKilogramKelvinSquared,
    /// W/(m²·K).
    WattPerMetreSquaredKelvin,
    /// Hz.
    Hertz,
    /// N·s/m.
    NewtonSecondPerMetre,
    /// N·s²/m².
    NewtonSecondSquaredPerMetreSquared,
}

/// Properties of a [`Unit`].
struct Row {
    /// Quantity.
    quantity: &'static str,
    /// Symbol for display: `m/s²`.
    symbol: &'static str,
    /// Expression for [`parse`]: `m/s^2`; empty for plain numbers.
    si: &'static str,
    /// The same quantity in inch, pound-force, second.
    inch_pound: &'static str,
    dimension: Dimension,
}

const fn row(
    quantity: &'static str,
    [symbol, si, inch_pound]: [&'static str; 3],
    [length, mass, time, angle]: [i32; 4],
) -> Row {
    Row { quantity, symbol, si, inch_pound, dimension: Dimension::new(length, mass, time, angle) }
}

impl Row {
    /// With exponents of temperature and amount of substance.
    const fn heat(mut self, temperature: i32, amount: i32) -> Self {
        self.dimension = self.dimension.with_heat(temperature, amount);
        self
    }
}

/// In the order of [`Unit`]; exponents of length, mass, time, angle.
#[rustfmt::skip]
const TABLE: [Row; 30] = [
    row("length", ["m", "m", "in"], [1, 0, 0, 0]),
    row("velocity", ["m/s", "m/s", "in/s"], [1, 0, -1, 0]),
    row("acceleration", ["m/s²", "m/s^2", "in/s^2"], [1, 0, -2, 0]),
    row("angle", ["rad", "rad", "rad"], [0, 0, 0, 1]),
    row("angular velocity", ["rad/s", "rad/s", "rad/s"], [0, 0, -1, 1]),
    row("angular acceleration", ["rad/s²", "rad/s^2", "rad/s^2"], [0, 0, -2, 1]),
    row("force", ["N", "N", "lbf"], [1, 1, -2, 0]),
    row("moment", ["N·m", "N·m", "in·lbf"], [2, 1, -2, 0]),
    row("energy", ["J", "J", "in·lbf"], [2, 1, -2, 0]),
    row("time", ["s", "s", "s"], [0, 0, 1, 0]),
    row("number", ["1", "", ""], [0, 0, 0, 0]),
    row("mass", ["kg", "kg", "lbf·s^2/in"], [0, 1, 0, 0]),
    row("moment of inertia", ["kg·m²", "kg·m^2", "lbf·in·s^2"], [2, 1, 0, 0]),
    row("stiffness", ["N/m", "N/m", "lbf/in"], [0, 1, -2, 0]),
    row("rotational stiffness", ["N·m/rad", "N·m/rad", "in·lbf/rad"], [2, 1, -2, -1]),
    row("rotational damping", ["N·m·s/rad", "N·m·s/rad", "in·lbf·s/rad"], [2, 1, -1, -1]),
    row("moment per angle squared", ["N·m/rad²", "N·m/rad^2", "in·lbf/rad^2"], [2, 1, -2, -2]),
    row("moment per angle cubed", ["N·m/rad³", "N·m/rad^3", "in·lbf/rad^3"], [2, 1, -2, -3]),
    row("pressure", ["Pa", "Pa", "psi"], [-1, 1, -2, 0]),
    row("temperature", ["K", "K", "K"], [0, 0, 0, 0]).heat(1, 0),
    row("area", ["m²", "m^2", "in^2"], [2, 0, 0, 0]),
    row("volume", ["m³", "m^3", "in^3"], [3, 0, 0, 0]),
    row("mass flow", ["kg/s", "kg/s", "lb/s"], [0, 1, -1, 0]),
    row("molar mass", ["kg/mol", "kg/mol", "kg/mol"], [0, 1, 0, 0]).heat(0, -1),
    row("specific heat", ["J/(kg·K)", "J/(kg·K)", "J/(kg·K)"], [2, 0, -2, 0]).heat(-1, 0),
    row("specific heat per kelvin", ["J/(kg·K²)", "J/(kg·K^2)", "J/(kg·K^2)"], [2, 0, -2, 0]).heat(-2, 0),
    row("heat transfer", ["W/(m²·K)", "W/(m^2·K)", "W/(m^2·K)"], [0, 1, -3, 0]).heat(-1, 0),
    row("frequency", ["Hz", "Hz", "Hz"], [0, 0, -1, 0]),
    row("damping", ["N·s/m", "N·s/m", "lbf·s/in"], [0, 1, -1, 0]),
    row("quadratic damping", ["N·s²/m²", "N·s^2/m^2", "lbf·s^2/in^2"], [-1, 1, 0, 0]),
];

/// All units, in the order of [`Unit`].
pub(crate) const ALL: [Unit; 30] = [
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
    Unit::Kilogram,
    Unit::KilogramMetreSquared,
    Unit::NewtonPerMetre,
    Unit::NewtonMetrePerRadian,
    Unit::NewtonMetreSecondPerRadian,
    Unit::NewtonMetrePerRadianSquared,
    Unit::NewtonMetrePerRadianCubed,
    Unit::Pascal,
    Unit::Kelvin,
    Unit::MetreSquared,
    Unit::MetreCubed,
    Unit::KilogramPerSecond,
    Unit::KilogramPerMole,
    Unit::JoulePerKilogramKelvin,
    Unit::JoulePerKilogramKelvinSquared,
    Unit::WattPerMetreSquaredKelvin,
    Unit::Hertz,
    Unit::NewtonSecondPerMetre,
    Unit::NewtonSecondSquaredPerMetreSquared,
];

impl Unit {
    /// Its quantity, as text.
    pub const fn quantity(self) -> &'static str {
        TABLE[self as usize].quantity
    }

    /// Its symbol for display: `m/s²`.
    pub const fn symbol(self) -> &'static str {
        TABLE[self as usize].symbol
    }

    /// Its expression for [`parse`]: `m/s^2`; empty for plain numbers.
    pub const fn expression(self) -> &'static str {
        TABLE[self as usize].si
    }

    /// The inch-pound-second unit of the same quantity, as expression for [`parse`]: `in/s^2`.
    pub const fn inch_pound(self) -> &'static str {
        TABLE[self as usize].inch_pound
    }

    /// Its dimension.
    pub const fn dimension(self) -> Dimension {
        TABLE[self as usize].dimension
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// SI units read back as 1 of themselves, those in inches and pounds as the same dimension.
    #[test]
    fn every_unit_reads_back() {
        for (i, unit) in ALL.into_iter().enumerate() {
            assert_eq!(unit as usize, i);
            let texts = [unit.expression(), unit.inch_pound()];
            for (text, is_si) in texts.into_iter().zip([true, false]).filter(|(text, _)| !text.is_empty()) {
                let scale = parse(text, 0).unwrap();
                assert!(scale.dimension.serves_as(unit.dimension()), "{unit:?}");
                assert!(!is_si || scale.factor == 1.0, "{unit:?}");
            }
        }
    }
}
