//! `occupant drive`.

use std::path::PathBuf;

use crate::base::{Done, Failure, UnitsArg, note, print, publish, refuse_input, say};
use occupant_files::table::Form;
use occupant_jobs::drive::{Driven, columns, film, json, path_columns, plan, text, write};
use occupant_jobs::files::scenario::{self, ScenarioArgs};
use occupant_pictures::Format;

/// Pixels of a plan per drawing unit.
const PIXELS: f64 = 2.0;

/// Drive the vehicles of a scenario without simulating the people
///
/// Prints where each vehicle comes to rest, its largest angles and slopes, events, tyre marks, occupant risk (OIV, ORA, THIV,
/// PHD, ASI), and how well each preset value is known. `occupant run` drives the vehicles too, then simulates the people.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    scenario: ScenarioArgs,

    /// Write all vehicles, road, barriers, tyre marks and events for a viewer (.mcap), or a vehicle's motion, wheels and
    /// accelerations as a table that `occupant risk` reads (.csv, .parquet, .xlsx or .mat)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Write only positions and angles, as `path.kind = "table"` reads them
    #[arg(long, value_name = "FILE.csv", conflicts_with = "output")]
    path: Option<PathBuf>,

    /// Draw a plan view of road, barriers, tyre marks and vehicles: .svg or .png
    #[arg(long, value_name = "FILE")]
    plan: Option<PathBuf>,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    /// The vehicle to write; the first if absent
    #[arg(long, value_name = "NAME")]
    vehicle: Option<String>,

    /// Time between two rows of a table, or two frames of an .mcap
    #[arg(long, value_name = "TIME", default_value = "1 ms", value_parser = super::flags::history::interval)]
    interval: f64,

    #[command(flatten)]
    units: UnitsArg,

    /// Print JSON instead of tables, in SI units
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
    if args.path.is_none() && output.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mcap")) {
        let scenario = loaded.scenario.to_toml().map_err(|e| Failure::plain(e.to_string()))?;
        publish(output, args.force, &film(&drives, &all, &loaded.scenario.title, scenario, args.interval)?)?;
        say(&format!("wrote {}", output.display()));
        return Ok(Done::Well);
    }
    let named = |name: &String| drives.vehicles.iter().position(|own| own.name == *name);
    let vehicle = match &args.vehicle {
        Some(name) => named(name).ok_or_else(|| {
            let names: Vec<&str> = drives.vehicles.iter().map(|own| own.name.as_str()).collect();
            let found = format!("--vehicle {name}: there is no such vehicle in `drive`");
            Failure::with_help(found, &format!("name {}", placed_text::one_of(&names, '`')))
        })?,
        None => 0,
    };
    if drives.vehicles.len() > 1 && args.vehicle.is_none() {
        note(&format!("{} is written; choose another with --vehicle", drives.vehicles[0].name));
    }
    let columns = if args.path.is_some() { path_columns() } else { columns() };
    let written = write(output, Form::of_output(output)?, args.force, &drives, vehicle, &columns, args.interval)?;
    say(&format!("wrote {}", written.display()));
    Ok(Done::Well)
}
