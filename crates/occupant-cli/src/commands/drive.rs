//! `occupant drive`.

use std::path::PathBuf;

use crate::base::{Done, Failure, UnitsArg, note, print, publish, refuse_input, say};
use occupant_files::table::Form;
use occupant_jobs::drive::{Driven, columns, json, path_columns, plan, text, write};
use occupant_jobs::files::scenario::{self, ScenarioArgs};
use occupant_pictures::Format;

/// Pixels of a user unit of a plan.
const PIXELS: f64 = 2.0;

/// Drive the vehicles of a scenario alone, without people
///
/// Where they come to rest, largest slopes and angles, what happened when, tyre marks, the risk to occupants by OIV, ORA, THIV,
/// PHD and ASI, and how far each number of a preset can be trusted. `occupant run` drives first, too, and then carries the people.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scenario: ScenarioArgs,

    /// Write the motion, wheels and accelerations of a vehicle as a table, which `occupant risk` reads: .csv, .parquet, .xlsx or .mat
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Write places and angles alone, as `path.kind = "table"` reads them
    #[arg(long, value_name = "FILE.csv", conflicts_with = "output")]
    path: Option<PathBuf>,

    /// Draw road, barriers, tyre marks and vehicles at times from above: .svg or .png
    #[arg(long, value_name = "FILE")]
    plan: Option<PathBuf>,

    /// Replace a file that exists
    #[arg(short, long)]
    force: bool,

    /// The vehicle that is written; the first, if absent
    #[arg(long, value_name = "NAME")]
    vehicle: Option<String>,

    /// Time between two lines of the file
    #[arg(long, value_name = "TIME", default_value = "1 ms", value_parser = super::flags::history::interval)]
    interval: f64,

    #[command(flatten)]
    units: UnitsArg,

    /// Print JSON instead of tables; SI units
    #[arg(long)]
    json: bool,
}

pub(crate) fn drive(args: &Args) -> Result<Done, Failure> {
    let (loaded, drives) = scenario::drives(&args.scenario)?;
    let all: Vec<Driven> = (0..drives.vehicles.len()).map(|i| Driven::of(&drives, i)).collect();
    if args.json {
        print(&crate::base::json(&json(&drives, &all))?)?;
    } else {
        print(&text(&drives, &all, args.units.or(loaded.scenario.units)))?;
    }
    if let Some(file) = &args.plan {
        refuse_input(file, &args.scenario.scenario)?;
        let drawing = plan(&drives, &all, &loaded.scenario.title);
        let bytes = Format::of_output(file)?.encode(&drawing, PIXELS).map_err(Failure::plain)?;
        publish(file, args.force, &bytes)?;
        say(&format!("wrote {}", file.display()));
    }
    let Some(output) = args.output.as_ref().or(args.path.as_ref()) else { return Ok(Done::Well) };
    refuse_input(output, &args.scenario.scenario)?;
    let named = |name: &String| drives.vehicles.iter().position(|own| own.name == *name);
    let vehicle = match &args.vehicle {
        Some(name) => named(name).ok_or_else(|| {
            let names: Vec<&str> = drives.vehicles.iter().map(|own| own.name.as_str()).collect();
            let found = format!("--vehicle {name}: no such vehicle is driven");
            Failure::with_help(found, &format!("name {}", placed_text::one_of(&names, '`')))
        })?,
        None => 0,
    };
    if drives.vehicles.len() > 1 && args.vehicle.is_none() {
        note(&format!("{} is written; --vehicle names another", drives.vehicles[0].name));
    }
    let columns = if args.path.is_some() { path_columns() } else { columns() };
    let written = write(output, Form::of_output(output)?, args.force, &drives, vehicle, &columns, args.interval)?;
    say(&format!("wrote {}", written.display()));
    Ok(Done::Well)
}
