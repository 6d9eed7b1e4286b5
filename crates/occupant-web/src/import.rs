//! Tables and reports of recorders as cases.

use std::collections::BTreeMap;
use std::path::Path;

use occupant_files::measured::{Hints, SIDES, import_table};
use occupant_jobs::base::Failure;
use occupant_jobs::import::{Request, import, scenario};
use serde::Serialize;

use crate::case::{Case, Refused};

/// A case made of a record.
#[derive(Serialize)]
pub struct Made {
    case: Case,
    /// What was assumed, filled or dropped.
    notes: Vec<String>,
}

/// The driver in a car on the motion that a table or a report has; `struck` are the sides of the vehicle that were struck.
///
/// # Errors
/// All that is wrong with it; a record without the motion of a vehicle.
pub fn imported(name: &str, bytes: &[u8], struck: &[String]) -> Result<Made, Refused> {
    let sides = SIDES.iter().filter(|(side, ..)| struck.iter().any(|one| one == side));
    let signs = sides.map(|side| side.2).reduce(|a, b| [a[0] + b[0], a[1] + b[1]]);
    let imported = import_table(Path::new(name), bytes.to_vec(), Hints { struck: signs, ..Hints::default() })?;
    let made = import(&imported, &Request::default())?;
    let Some(path) = made.path else {
        let why = format!("{name} contains no vehicle motion");
        return Err(Failure::plain([vec![why], made.notes].concat().join("\n")).into());
    };
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let file = format!("{stem}-path.csv");
    let text = scenario(name, &imported, &path, &file);
    let table = String::from_utf8_lossy(&path.csv).into_owned();
    let case = Case { name: format!("{stem}.toml"), text, set: Vec::new(), tables: BTreeMap::from([(file, table)]) };
    Ok(Made { case, notes: made.notes })
}
