//! Units and digits of the printout: inches and pounds as in 1970, or SI.

use occupant_scenario::kind::UnitSystem;
use occupant_units::trig;
use occupant_units::unit::Shown;
use occupant_units::unit::Unit as Measured;

/// A unit of the printout with its number of decimals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unit {
    shown: Shown,
    decimals: usize,
    as_read: bool,
}

/// The units of a printout: metre, kilogram, newton; or inch, pound-force, second with masses as weights in pounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    system: UnitSystem,
    as_read: bool,
}

pub(crate) fn degree() -> Unit {
    Units::from(UnitSystem::Si).of(Measured::Radian)
}

/// Accelerations in units of standard gravity.
pub(crate) fn g() -> Unit {
    Unit { shown: Measured::MetrePerSecondSquared.shown_in("g"), decimals: 3, as_read: false }
}

/// Dimensionless numbers.
pub(crate) fn ratio() -> Unit {
    Units::from(UnitSystem::Si).of(Measured::One)
}

impl From<UnitSystem> for Units {
    fn from(system: UnitSystem) -> Self {
        Units { system, as_read: false }
    }
}

impl Units {
    /// The same units with all digits, for numbers that were read.
    pub(crate) fn as_read(self) -> Self {
        Units { as_read: true, ..self }
    }

    /// Name of the system.
    pub(crate) fn name(self) -> &'static str {
        match self.system {
            UnitSystem::Si => "SI",
            UnitSystem::InchPound => "INCH-POUND",
        }
    }

    /// The unit for a quantity; angles are in degrees.
    pub(crate) fn of(self, measured: Measured) -> Unit {
        use Measured as M;
        let [si, inch_pound] = match measured {
            M::Metre => [4, 3],
            M::MetrePerSecond => [3, 2],
            M::MetrePerSecondSquared => [2, 1],
            M::Newton | M::NewtonPerMetre | M::NewtonSecondPerMetre | M::NewtonSecondSquaredPerMetreSquared => [1, 2],
            M::Kilogram => [4, 3],
            M::KilogramMetreSquared => [5, 4],
            M::Joule | M::NewtonMetre => [2, 1],
            M::Radian | M::RadianPerSecondSquared | M::NewtonMetrePerRadian => [2, 2],
            M::NewtonMetrePerRadianSquared | M::NewtonMetrePerRadianCubed => [2, 2],
            M::RadianPerSecond | M::NewtonMetreSecondPerRadian => [3, 3],
            M::One => [4, 4],
            M::Hertz => [2, 2],
            M::Second => [6, 6],
            M::Kelvin | M::Pascal | M::JoulePerKilogramKelvin | M::WattPerMetreSquaredKelvin => [1, 3],
            M::MetreSquared | M::MetreCubed | M::KilogramPerSecond => [4, 2],
            M::KilogramPerMole | M::JoulePerKilogramKelvinSquared => [4, 4],
        };
        let (shown, decimals) = match (measured, self.system) {
            (M::Radian, _) => (measured.shown_in("deg"), si),
            (_, UnitSystem::Si) => (measured.shown(), si),
            (M::Kilogram, UnitSystem::InchPound) => (measured.shown_in("lb"), inch_pound),
            (_, UnitSystem::InchPound) => (measured.shown_in_inch_pound(), inch_pound),
        };
        Unit { shown, decimals, as_read: self.as_read }
    }

    /// A heading with the names of units in place of `{}`.
    pub(crate) fn heading(self, text: &str, measured: &[Measured]) -> String {
        measured.iter().fold(text.to_owned(), |text, unit| text.replacen("{}", &self.of(*unit).name(), 1))
    }
}

impl Unit {
    /// Its name in headings: `IN-LBF`, `M/S2`.
    pub(crate) fn name(self) -> String {
        self.shown.ascii().to_uppercase().replace('*', "-").replace('^', "")
    }

    /// An SI value in this unit with its decimals; with an exponent if it does not fit into a column.
    pub(crate) fn show(self, si: f64) -> String {
        let (value, decimals) = (si / self.shown.si, self.decimals);
        if value == 0.0 || value.abs() < 1e7 && value.abs() >= 0.5 * trig::powi(0.1, decimals as i32) {
            // minus zero is zero
            return self.in_full(si, format!("{:.decimals$}", value + 0.0));
        }
        if value.is_finite() { self.in_full(si, format!("{value:.3E}")) } else { value.to_string().to_uppercase() }
    }

    /// A number that was read and differs from `rounded`: the shortest equal decimal of at most ten digits. Otherwise
    /// `rounded`, as for computed numbers.
    pub(crate) fn in_full(self, si: f64, rounded: String) -> String {
        let gives = |text: &String| text.parse::<f64>().is_ok_and(|number| number * self.shown.si == si);
        if !self.as_read || gives(&rounded) {
            return rounded;
        }
        let value = si / self.shown.si;
        let found = (0..10).map(|places| format!("{value:.places$e}")).find(gives);
        found.and_then(|text| text.parse::<f64>().ok()).map_or(rounded, |number| number.to_string())
    }

    /// The same with the name of the unit.
    pub(crate) fn say(self, si: f64) -> String {
        format!("{} {}", self.show(si), self.name())
    }

    /// SI units per unit.
    pub(crate) fn size(self) -> f64 {
        self.shown.si
    }

    /// The same as [`Unit::show`], or `-` for none.
    pub(crate) fn perhaps(self, si: Option<f64>) -> String {
        si.map_or_else(|| "-".to_owned(), |si| self.show(si))
    }

    /// Three components.
    pub(crate) fn vector(self, si: impl Into<[f64; 3]>) -> [String; 3] {
        si.into().map(|component| self.show(component))
    }

    /// Three components as text.
    pub(crate) fn point(self, si: impl Into<[f64; 3]>) -> String {
        format!("({})", self.vector(si).join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_digits() {
        let (si, inch_pound) = (Units::from(UnitSystem::Si), Units::from(UnitSystem::InchPound));
        assert_eq!(inch_pound.of(Measured::Metre).show(0.254), "10.000");
        assert_eq!(inch_pound.of(Measured::Newton).say(inch_pound.of(Measured::Newton).size()), "1.00 LBF");
        assert_eq!(si.of(Measured::Metre).show(-0.12344), "-0.1234");
        assert_eq!(si.of(Measured::Newton).show(-0.0), "0.0");
        assert_eq!(si.of(Measured::Newton).show(0.001), "1.000E-3");
        assert_eq!(si.of(Measured::Newton).show(2.5e9), "2.500E9");
        assert_eq!(si.of(Measured::Newton).show(f64::NAN), "NAN");
    }

    #[test]
    fn numbers_that_were_read_keep_every_digit() {
        let length = Units::from(UnitSystem::InchPound).as_read().of(Measured::Metre);
        let inch = length.size();
        for (number, shown) in
            [(10.0, "10.000"), (3.7525, "3.7525"), (0.123_456_789, "0.123456789"), (2.5e-6, "2.500E-6")]
        {
            assert_eq!(length.show(number * inch), shown);
        }
        assert_eq!(length.show(1.0 / 3.0), "13.123", "computed");
        assert_eq!(length.show(f64::NAN), "NAN");
    }

    #[test]
    fn names_are_those_of_a_line_printer() {
        let (si, inch_pound) = (Units::from(UnitSystem::Si), Units::from(UnitSystem::InchPound));
        let names = |measured| [si.of(measured).name(), inch_pound.of(measured).name()];
        assert_eq!(names(Measured::Kilogram), ["KG", "LB"]);
        assert_eq!(names(Measured::KilogramMetreSquared), ["KG-M2", "LBF-IN-S2"]);
        assert_eq!(names(Measured::NewtonMetreSecondPerRadian), ["N-M-S/RAD", "IN-LBF-S/RAD"]);
        assert_eq!(names(Measured::MetrePerSecondSquared), ["M/S2", "IN/S2"]);
        assert_eq!(inch_pound.heading("A ({}, {})", &[Measured::NewtonPerMetre, Measured::Radian]), "A (LBF/IN, DEG)");
    }
}
