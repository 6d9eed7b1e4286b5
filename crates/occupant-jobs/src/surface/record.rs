//! The columns of a record of an impact, in SI.

use occupant_files::signals::{Recording, Signal, scale_of};
use occupant_units::unit::Scale;

use super::{Impactor, refuse};
use crate::base::Failure;

/// Least number of samples for a fit.
const LEAST: usize = 20;
/// Naming of columns.
const NAMING: &str = "name the columns with --columns, such as 't[ms],acceleration[g]' or 't[ms],force[kN],depth[mm]'; `-` leaves one out";

/// Recorded data, s, N and m.
#[derive(Clone, Debug)]
pub(super) struct Record {
    /// Times.
    pub(super) time_s: Vec<f64>,
    /// Force on the impactor, opposite to its motion into the surface.
    pub(super) force_n: Vec<f64>,
    /// Force on the impactor along the surface.
    pub(super) tangential_n: Option<Vec<f64>>,
    /// Measured depth.
    pub(super) depth_m: Option<Vec<f64>>,
}

/// Role of a column: start of its heading, and its units.
struct Role {
    names: &'static [&'static str],
    units: &'static [&'static str],
}

const NORMAL: Role = Role { names: &["force", "acceleration"], units: &["N", "m/s^2"] };
const TANGENTIAL: Role = Role { names: &["tangential"], units: &["N", "m/s^2"] };
const DEPTH: Role = Role { names: &["depth"], units: &["m"] };

impl Role {
    fn names(&self, signal: &Signal) -> bool {
        let name = signal.name.trim().to_lowercase();
        self.names.iter().any(|own| name.starts_with(own))
    }

    fn has_unit(&self, scale: Option<Scale>) -> bool {
        let fits = |unit: &&str| scale_of(unit).map(|own| own.dimension) == scale.map(|own| own.dimension);
        scale.is_some() && self.units.iter().any(fits)
    }

    /// The column of this role: by its name, or the only one with such a unit, unless a name is required.
    fn of<'a>(&self, recording: &'a Recording, by_unit: bool) -> Result<Option<&'a Signal>, Failure> {
        let file = recording.path.display();
        let own = |signal: &&Signal| self.names(signal);
        let is_other = |signal: &Signal| [NORMAL, TANGENTIAL, DEPTH].iter().any(|role| role.names(signal));
        let alike = |signal: &&Signal| by_unit && !is_other(signal) && self.has_unit(signal.scale);
        let mut found: Vec<&Signal> = recording.signals.iter().filter(own).collect();
        if found.is_empty() {
            found = recording.signals.iter().filter(alike).collect();
        }
        match found[..] {
            [] => Ok(None),
            [one] if self.has_unit(one.scale) => Ok(Some(one)),
            [one] => {
                let unit = one.unit.as_ref().map_or("no unit".to_owned(), |unit| format!("the unit `{unit}`"));
                let expected = self.units.join(" or ").replace("m/s^2", "g");
                Err(refuse(format!("{file}: `{}` has {unit}; expected one such as {expected}", one.name), NAMING))
            }
            _ => {
                let names: Vec<String> = found.iter().map(|signal| format!("`{}`", signal.name)).collect();
                Err(refuse(format!("{file}: {} may all be the {}", names.join(", "), self.names[0]), NAMING))
            }
        }
    }
}

impl Record {
    /// The samples between two times.
    ///
    /// # Errors
    /// Columns that are missing, cannot be told apart or have no unit; missing values; too few samples; no mass.
    pub(super) fn of(
        recording: &Recording,
        impactor: &Impactor,
        window_s: [Option<f64>; 2],
    ) -> Result<Record, Failure> {
        let file = recording.path.display();
        let normal = NORMAL.of(recording, true)?.ok_or_else(|| {
            let names: Vec<&str> = recording.signals.iter().take(12).map(|signal| &signal.name[..]).collect();
            let unitless = recording.signals.iter().any(|signal| signal.scale.is_none());
            let why = if unitless { ", some without a unit" } else { "" };
            refuse(format!("{file} has no force and no acceleration: it has {}{why}", names.join(", ")), NAMING)
        })?;
        let tangential = TANGENTIAL.of(recording, false)?;
        let depth = DEPTH.of(recording, true)?;
        let inside = |t: &f64| window_s[0].is_none_or(|from| *t >= from) && window_s[1].is_none_or(|to| *t <= to);
        let time_s: Vec<f64> = normal.time_s.iter().copied().filter(inside).collect();
        if time_s.len() < LEAST {
            let found = format!("{file} has {} samples in the window", time_s.len());
            return Err(refuse(found, &format!("give a record with at least {LEAST}, or widen --from and --to")));
        }
        let values = |signal: &Signal| si(signal, &normal.time_s, impactor.mass_kg, &inside, &file.to_string());
        Ok(Record {
            force_n: values(normal)?,
            tangential_n: tangential.map(&values).transpose()?,
            depth_m: depth.map(&values).transpose()?,
            time_s,
        })
    }
}

/// Values of a column in N or m.
fn si(
    signal: &Signal,
    times: &[f64],
    mass_kg: Option<f64>,
    inside: &impl Fn(&f64) -> bool,
    file: &str,
) -> Result<Vec<f64>, Failure> {
    if signal.time_s != times {
        return Err(refuse(
            format!("{file}: `{}` has other times", signal.name),
            "give a table with one column of times",
        ));
    }
    let scale = signal.scale.unwrap_or(Scale { dimension: Default::default(), factor: 1.0 });
    let is_acceleration = scale_of("m/s^2").is_some_and(|own| own.dimension == scale.dimension);
    let mass = match (is_acceleration, mass_kg) {
        (true, None) => {
            let found =
                format!("{file}: `{}` is an acceleration, and the mass of the impactor is not known", signal.name);
            return Err(refuse(found, "add --mass, such as --mass '4.54 kg'"));
        }
        (true, Some(mass)) => mass,
        (false, _) => 1.0,
    };
    let rows = times.iter().zip(&signal.values).filter(|(t, _)| inside(t));
    let values: Vec<f64> = rows.map(|(_, value)| value * scale.factor * mass).collect();
    let missing = values.iter().filter(|value| !value.is_finite()).count();
    if missing > 0 {
        let found = format!("{file}: `{}` has {missing} missing values", signal.name);
        return Err(refuse(found, "fill them, or leave them out with --from and --to"));
    }
    Ok(values)
}
