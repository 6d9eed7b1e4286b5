//! The flag for the units of tables and pages.

use occupant_jobs::base::Units;
use occupant_scenario::kind::UnitSystem;

/// The systems: names on the command line, names in help.
pub(crate) const SYSTEMS: [(&str, &str, UnitSystem); 3] = [
    ("si", "Metre, kilogram, newton", UnitSystem::Si),
    ("in-lbf-s", "Inch, pound, pound-force; speeds in mph", UnitSystem::InchPound),
    ("inch-pound", "The same as in-lbf-s", UnitSystem::InchPound),
];

/// The flag of commands that print numbers.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct UnitsArg {
    /// Units of printed numbers; those of the scenario if absent. JSON is always SI
    #[arg(long, value_name = "SYSTEM", value_parser = super::one_of(&SYSTEMS))]
    units: Option<UnitSystem>,
}

impl UnitsArg {
    /// The requested units, else those of a scenario.
    pub(crate) fn or(self, scenario: Option<UnitSystem>) -> Units {
        Units::asked(self.units, scenario)
    }
}
