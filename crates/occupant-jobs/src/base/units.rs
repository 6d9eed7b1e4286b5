//! The units of tables and pages: those of the scenario, or as requested. Answers in JSON and tables in files are SI.

use occupant_scenario::Draft;
use occupant_scenario::kind::UnitSystem;
use occupant_study::Parameter;
use occupant_units::trig;
use occupant_units::unit::{Shown, Unit};

use super::text_table::number;

/// Units of printed and drawn numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// The system.
    pub system: UnitSystem,
    /// Whether it was requested, overriding the scenario's.
    is_asked: bool,
}

/// SI unit of a figure, and its display unit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Told {
    /// SI unit.
    pub si: String,
    /// SI value of one display unit, and its symbol; empty for a plain number.
    pub shown: (f64, String),
}

impl Units {
    /// The requested units, or those of a scenario.
    pub fn asked(units: Option<UnitSystem>, scenario: Option<UnitSystem>) -> Self {
        Units { system: units.or(scenario).unwrap_or_default(), is_asked: units.is_some() }
    }

    /// Units of a scenario.
    pub fn of_scenario(system: UnitSystem) -> Self {
        Units { system, is_asked: false }
    }

    /// Display unit instead of a table's unit, and its size in that unit; none if unchanged.
    fn instead(self, unit: &str) -> Option<(f64, Shown)> {
        let (measured, si) = Unit::measuring(unit).filter(|_| self.system == UnitSystem::InchPound)?;
        let dimension = measured.dimension();
        let is_ours = dimension.length == 0 && dimension.mass == 0;
        let shown = measured.shown_to_people(true);
        (!is_ours && shown.si != si).then_some((shown.si / si, shown))
    }

    /// Size of the display unit in a unit, and its symbol.
    pub fn over(self, unit: &str) -> (f64, String) {
        self.instead(unit).map_or_else(|| (1.0, unit.to_owned()), |(per, shown)| (per, shown.symbol()))
    }

    /// Symbol of the display unit for a table's unit.
    pub fn symbol(self, unit: &str) -> String {
        self.over(unit).1
    }

    /// The heading of a column, such as `depth, mm`.
    pub fn heading(self, heading: &str) -> String {
        heading
            .rsplit_once(", ")
            .map_or_else(|| heading.to_owned(), |(of, unit)| format!("{of}, {}", self.symbol(unit)))
    }

    /// A number in the display unit of `unit`, with this many decimals in `unit` and a similar number of digits
    /// otherwise.
    pub fn number(self, value: f64, unit: &str, decimals: usize) -> String {
        let Some((per, _)) = self.instead(unit) else { return number(value, decimals) };
        let decimals = (decimals as f64 + trig::log10(per).trunc()).max(0.0);
        number(value / per, decimals as usize)
    }

    /// A number below a heading.
    pub fn below(self, heading: &str, value: f64, decimals: usize) -> String {
        self.number(value, heading.rsplit_once(", ").map_or("", |(_, unit)| unit), decimals)
    }

    /// A number with its unit.
    pub fn say(self, value: f64, unit: &str, decimals: usize) -> String {
        format!("{} {}", self.number(value, unit, decimals), self.symbol(unit))
    }

    /// Display unit of a figure in SI.
    pub fn told(self, si: &str) -> Told {
        let shown = Unit::measuring(si).map(|(unit, _)| unit.shown_to_people(self.system == UnitSystem::InchPound));
        let plain = if si == "1" { "" } else { si };
        Told { si: si.to_owned(), shown: shown.map_or((1.0, plain.to_owned()), |shown| (shown.si, shown.symbol())) }
    }
}

impl Units {
    /// Display unit of a study's parameter: the unit of the scenario, unless others were requested.
    pub fn told_of(self, parameter: &Parameter, base: &Draft) -> Told {
        let place = parameter.targets.first().filter(|_| !self.is_asked && !parameter.unit.is_empty());
        match place.and_then(|target| base.unit_at(&target.path)).filter(|(_, si)| *si != 1.0) {
            Some((unit, si)) => {
                let symbol = unit.replace("deg", "°").replace("^2", "²");
                Told { si: parameter.unit.to_owned(), shown: (si, symbol) }
            }
            None => self.told(parameter.unit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inches_stand_for_millimetres_and_seconds_for_seconds() {
        let [si, inch_pound] = [UnitSystem::Si, UnitSystem::InchPound].map(Units::of_scenario);
        assert_eq!([si, inch_pound].map(|u| u.heading("depth, mm")), ["depth, mm", "depth, in"]);
        assert_eq!([si, inch_pound].map(|u| u.number(254.0, "mm", 0)), ["254", "10.0"]);
        assert_eq!([si, inch_pound].map(|u| u.say(8.9408, "m/s", 2)), ["8.94 m/s", "20.00 mph"]);
        for unit in ["g", "ms", "°", "%", "HIC", ""] {
            assert_eq!(inch_pound.say(1.25, unit, 2), si.say(1.25, unit, 2), "{unit}");
        }
        assert_eq!(inch_pound.heading("slope, kN/m"), "slope, lbf/in");
        assert_eq!([si, inch_pound].map(|u| u.number(1.0, "kN/m", 1)), ["1.0", "5.7"]);
        assert_eq!(inch_pound.say(1000.0, "N", 0), "225 lbf");
        assert_eq!(inch_pound.heading("surface"), "surface");
    }

    #[test]
    fn figures_are_told_in_the_units_of_everyday() {
        let told = |system: UnitSystem, si| Units::of_scenario(system).told(si).shown;
        assert_eq!(told(UnitSystem::Si, "m/s²"), (9.80665, "g".to_owned()));
        assert_eq!(told(UnitSystem::Si, "m"), (1e-3, "mm".to_owned()));
        assert_eq!(told(UnitSystem::InchPound, "m"), (0.0254, "in".to_owned()));
        assert_eq!(told(UnitSystem::InchPound, "s"), (1e-3, "ms".to_owned()));
        assert_eq!(told(UnitSystem::Si, "1"), (1.0, String::new()));
        assert_eq!(told(UnitSystem::Si, "rad").1, "°");
    }
}
