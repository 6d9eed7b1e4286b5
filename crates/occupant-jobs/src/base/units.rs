//! The units of tables and pages: those of the scenario, or as requested. Answers in JSON and tables in files are SI.

use occupant_scenario::Draft;
use occupant_scenario::kind::UnitSystem;
use occupant_study::Parameter;
use occupant_units::unit::{Shown, Unit};

use super::text_table::number;

/// Units of what is printed or drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Units {
    /// Which units.
    pub system: UnitSystem,
    /// Whether they were asked for, whatever the scenario says.
    is_asked: bool,
}

/// A unit of figures, SI, and how people are told it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Told {
    /// As figures have it.
    pub si: String,
    /// SI units in one that is shown, and its symbol; empty for a plain number.
    pub shown: (f64, String),
}

impl Units {
    /// The units asked for, or those of a scenario.
    pub fn asked(units: Option<UnitSystem>, scenario: Option<UnitSystem>) -> Self {
        Units { system: units.or(scenario).unwrap_or_default(), is_asked: units.is_some() }
    }

    /// Those of a scenario.
    pub fn of_scenario(system: UnitSystem) -> Self {
        Units { system, is_asked: false }
    }

    /// What is shown for a unit of a table, and how many of that unit are one of it; none if it stays as it is.
    fn instead(self, unit: &str) -> Option<(f64, Shown)> {
        let (measured, si) = Unit::measuring(unit).filter(|_| self.system == UnitSystem::InchPound)?;
        let dimension = measured.dimension();
        let is_ours = dimension.length == 0 && dimension.mass == 0;
        let shown = measured.shown_to_people(true);
        (!is_ours && shown.si != si).then_some((shown.si / si, shown))
    }

    /// How many of a unit are one of what is shown for it, and the symbol of that.
    pub fn over(self, unit: &str) -> (f64, String) {
        self.instead(unit).map_or_else(|| (1.0, unit.to_owned()), |(per, shown)| (per, shown.symbol()))
    }

    /// The symbol that is shown for a unit of a table.
    pub fn symbol(self, unit: &str) -> String {
        self.over(unit).1
    }

    /// The heading of a column, such as `depth, mm`.
    pub fn heading(self, heading: &str) -> String {
        heading
            .rsplit_once(", ")
            .map_or_else(|| heading.to_owned(), |(of, unit)| format!("{of}, {}", self.symbol(unit)))
    }

    /// A number that is given in a unit, with so many decimals there, and about as many digits elsewhere.
    pub fn number(self, value: f64, unit: &str, decimals: usize) -> String {
        let Some((per, _)) = self.instead(unit) else { return number(value, decimals) };
        let decimals = (decimals as f64 + per.log10().trunc()).max(0.0);
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

    /// A figure's unit, SI.
    pub fn told(self, si: &str) -> Told {
        let shown = Unit::measuring(si).map(|(unit, _)| unit.shown_to_people(self.system == UnitSystem::InchPound));
        let plain = if si == "1" { "" } else { si };
        Told { si: si.to_owned(), shown: shown.map_or((1.0, plain.to_owned()), |shown| (shown.si, shown.symbol())) }
    }
}

impl Units {
    /// The unit of a parameter of a study: that in which the scenario writes it, unless others were asked for.
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
