//! Units that values are shown in: `kN`, `g`, `deg`, `in/s^2`.

use super::{ALL, Unit, parse};

/// A unit of the table, or an expression of such units, for displaying values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    expression: &'static str,
    /// SI value of one unit.
    pub si: f64,
}

impl Unit {
    /// Display in the unit of `expression`; in itself if that is no unit of the same quantity.
    pub fn shown_in(self, expression: &'static str) -> Shown {
        match parse(expression, 0) {
            Ok(scale) if scale.dimension == self.dimension() => Shown { expression, si: scale.factor },
            _ => Shown { expression: self.expression(), si: 1.0 },
        }
    }

    /// Display in SI.
    pub fn shown(self) -> Shown {
        Shown { expression: self.expression(), si: 1.0 }
    }

    /// Display in inch, pound-force, second.
    pub fn shown_in_inch_pound(self) -> Shown {
        self.shown_in(self.inch_pound())
    }

    /// Display in everyday units: accelerations in g, times in ms, angles in degrees; lengths in mm, or in inches with
    /// speeds in mph, masses in pounds and forces in pounds-force.
    pub fn shown_to_people(self, inch_pound: bool) -> Shown {
        self.shown_in(match (self, inch_pound) {
            (Unit::MetrePerSecondSquared, _) => "g",
            (Unit::Second, _) => "ms",
            (Unit::Radian, _) => "deg",
            (Unit::RadianPerSecond, _) => "deg/s",
            (Unit::Metre, false) => "mm",
            (Unit::MetrePerSecond, true) => "mph",
            (Unit::Kilogram, true) => "lb",
            (_, true) => self.inch_pound(),
            (_, false) => self.expression(),
        })
    }

    /// The unit of the table with the dimension of `expression`, and the factor to it: for `mm` metres and 0.001. None
    /// for invalid units and plain numbers.
    pub fn measuring(expression: &str) -> Option<(Unit, f64)> {
        let scale = parse(&expression.replace('²', "^2"), 0).ok()?;
        let unit = ALL.into_iter().find(|unit| unit.dimension() == scale.dimension)?;
        (unit != Unit::One).then_some((unit, scale.factor))
    }
}

impl Shown {
    /// Its symbol for display, `in/s²`; empty for plain numbers.
    pub fn symbol(self) -> String {
        self.expression.replace("deg", "°").replace("^2", "²").replace("^3", "³")
    }

    /// Its ASCII form, valid in scenarios and tables: `in*lbf`, `m/s^2`; `1` for plain numbers.
    pub fn ascii(self) -> String {
        if self.expression.is_empty() { "1".to_owned() } else { self.expression.replace('·', "*") }
    }

    /// Number of these units per SI unit.
    pub fn per_si(self) -> f64 {
        1.0 / self.si
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_shows_its_values_in_any_unit_of_the_same_quantity() {
        assert_eq!(Unit::Newton.shown_in("kN"), Shown { expression: "kN", si: 1000.0 });
        assert_eq!(Unit::Newton.shown_in("kN").per_si(), 1e-3);
        assert_eq!(Unit::Newton.shown_in("mm"), Unit::Newton.shown());
        assert_eq!(Unit::Radian.shown_in("deg").symbol(), "°");
        assert_eq!(Unit::Joule.shown_in_inch_pound().ascii(), "in*lbf");
        assert_eq!((Unit::One.shown().symbol().as_str(), Unit::One.shown().ascii().as_str()), ("", "1"));
        assert_eq!(Unit::measuring("mm"), Some((Unit::Metre, 1e-3)));
        assert_eq!(Unit::measuring("m/s²"), Some((Unit::MetrePerSecondSquared, 1.0)));
        assert_eq!((Unit::measuring("%"), Unit::measuring("forty")), (None, None));
        assert_eq!(Unit::RadianPerSecond.shown_to_people(true).symbol(), "°/s");
        assert_eq!(Unit::MetrePerSecond.shown_to_people(true).si, 0.44704);
        assert_eq!(Unit::MetrePerSecondSquared.shown_in("g").si, 9.806_65);
    }
}
