//! Units that values are shown in: `kN`, `g`, `deg`, `in/s^2`.

use super::{Unit, parse};

/// A unit of the table, or an expression of such units, that values are shown in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    expression: &'static str,
    /// SI units in one of it.
    pub si: f64,
}

impl Unit {
    /// To show its values in the unit that `expression` names; in itself where that is no unit of the same quantity.
    pub fn shown_in(self, expression: &'static str) -> Shown {
        match parse(expression, 0) {
            Ok(scale) if scale.dimension == self.dimension() => Shown { expression, si: scale.factor },
            _ => Shown { expression: self.expression(), si: 1.0 },
        }
    }

    /// To show its values as they are.
    pub fn shown(self) -> Shown {
        Shown { expression: self.expression(), si: 1.0 }
    }

    /// To show its values in inch, pound-force, second.
    pub fn shown_in_inch_pound(self) -> Shown {
        self.shown_in(self.inch_pound())
    }
}

impl Shown {
    /// Its symbol for people, `in/s²`; empty for plain numbers.
    pub fn symbol(self) -> String {
        if self.expression == "deg" { "°".to_owned() } else { self.expression.replace("^2", "²") }
    }

    /// It in ASCII, as unit expressions of scenarios and tables may have it: `in*lbf`, `m/s^2`; `1` for plain numbers.
    pub fn ascii(self) -> String {
        if self.expression.is_empty() { "1".to_owned() } else { self.expression.replace('·', "*") }
    }

    /// How many of it are one SI unit.
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
        assert_eq!(Unit::MetrePerSecondSquared.shown_in("g").si, crate::signal::STANDARD_GRAVITY_MPS2);
    }
}
