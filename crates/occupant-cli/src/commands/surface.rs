//! `occupant surface`.

use occupant_units::trig;
use std::path::{Path, PathBuf};

use occupant_scenario::kind::{ANGLE, KINDS, LENGTH, MASS, SPEED};

use super::flags::history::WindowArgs;
use crate::base::{Failure, file_name, print, publish, quoted, refuse_input};
use occupant_files::measured::{self, Reading};
use occupant_jobs::surface::{Impactor, Origin, fit};

/// Fit a surface to the record of a drop or impactor test
///
/// RECORD is a table of time and acceleration of the impactor, or force, or force and depth; a column `tangential` of an
/// oblique impact gives friction. Writes a surface file, which a scenario takes with materials.NAME = { file = "NAME.toml" },
/// and NAME.svg, measured and fitted. What the record cannot tell is marked as not measured, and the scenario has to say it.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The record: a CSV table or an ISO-MME test
    #[arg(value_name = "RECORD")]
    record: PathBuf,

    /// Mass of the impactor, such as '4.54 kg'
    #[arg(long, value_name = "MASS", value_parser = si::<MASS>)]
    mass: Option<f64>,

    /// Speed at first contact, such as '6.7 m/s'
    #[arg(long, value_name = "SPEED", value_parser = si::<SPEED>, conflicts_with = "height")]
    speed: Option<f64>,

    /// Height of a free fall onto the surface, instead of --speed, such as '376 mm'
    #[arg(long, value_name = "LENGTH", value_parser = si::<LENGTH>)]
    height: Option<f64>,

    /// The impactor moves downwards into the surface, so gravity works on it; --height implies it
    #[arg(long)]
    down: bool,

    /// Half width of the 95 % interval of the speed
    #[arg(long, value_name = "SPEED", value_parser = si::<SPEED>, default_value = "0 m/s")]
    speed_error: f64,

    /// Angle between the velocity and the normal of the surface, such as '30 deg'
    #[arg(long, value_name = "ANGLE", value_parser = si::<ANGLE>, default_value = "0 deg")]
    angle: f64,

    /// Radius of the impactor's face
    #[arg(long, value_name = "LENGTH", value_parser = si::<LENGTH>)]
    radius: Option<f64>,

    /// Names and units for the columns, instead of the table's headings: `-` skips a column, a minus before a name reverses
    /// its sign, such as 't[ms],-,acceleration[g]'
    #[arg(long, value_name = "COLUMNS", allow_hyphen_values = true)]
    columns: Option<String>,

    #[command(flatten)]
    window: WindowArgs,

    /// Description of the surface, one line
    #[arg(long, value_name = "WORDS")]
    title: Option<String>,

    /// Author and publication of the measurement
    #[arg(long, value_name = "WORDS")]
    source: Option<String>,

    /// Specimen: make, model, year, position, mounting
    #[arg(long, value_name = "WORDS")]
    specimen: Option<String>,

    /// Form of the impactor, free or guided
    #[arg(long, value_name = "WORDS")]
    impactor: Option<String>,

    /// Date of the measurement
    #[arg(long, value_name = "DATE")]
    date: Option<String>,

    /// Licence for reuse, such as CC0-1.0
    #[arg(long, value_name = "WORDS")]
    licence: Option<String>,

    /// The surface file to write; named after the record, in the current folder, if absent
    #[arg(short, long, value_name = "NAME.toml")]
    output: Option<PathBuf>,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,
}

/// A quantity in SI, at least 0.
fn si<const KIND: usize>(text: &str) -> Result<f64, String> {
    match KINDS[KIND].read(text) {
        Ok(value) if value >= 0.0 => Ok(value),
        Ok(_) => Err("below 0".to_owned()),
        Err(error) => Err(format!("{}; expected {}", error.found, error.expected)),
    }
}

/// Standard gravity, m/s².
const G: f64 = 9.80665;
/// Steepest angle, rad: at 90° there is no impact.
const FLATTEST: f64 = 1.5;

impl Args {
    fn impactor(&self) -> Result<Impactor, Failure> {
        if self.angle > FLATTEST {
            return Err(Failure::with_help(
                "--angle is almost 90 degrees",
                "give the angle from the normal of the surface",
            ));
        }
        for (name, value) in [("--mass", self.mass), ("--speed", self.speed), ("--height", self.height)] {
            if value == Some(0.0) {
                return Err(Failure::with_help(format!("{name} is 0"), "give a number above 0"));
            }
        }
        let falls = self.down || self.height.is_some();
        let fallen = self.height.map(|height| (2.0 * G * height).sqrt());
        Ok(Impactor {
            mass_kg: self.mass,
            speed_m_s: self.speed.or(fallen),
            speed_error_m_s: self.speed_error,
            gravity_m_s2: if falls { G * trig::cos(self.angle) } else { 0.0 },
            angle_rad: self.angle,
        })
    }

    fn origin(&self, sha256: &str) -> Origin {
        Origin {
            title: self.title.clone(),
            source: self.source.clone(),
            specimen: self.specimen.clone(),
            impactor: self.impactor.clone(),
            radius_m: self.radius,
            date: self.date.clone(),
            licence: self.licence.clone(),
            record: [file_name(&self.record), sha256.to_owned()],
        }
    }
}

pub(crate) fn surface(args: &Args) -> Result<(), Failure> {
    let impactor = args.impactor()?;
    let reading = Reading { columns: args.columns.as_deref(), ..Reading::default() };
    let recording = measured::import(&args.record, reading)?.recording;
    let found = fit(&recording, &impactor, [args.window.from, args.window.to])?;
    let named = || Path::new(&file_name(&args.record)).with_extension("toml");
    let output = args.output.clone().unwrap_or_else(named);
    let picture = output.with_extension("svg");
    [&output, &picture].iter().try_for_each(|file| refuse_input(file, &args.record))?;
    let origin = args.origin(&recording.sha256);
    publish(&output, args.force, found.toml(&origin, &impactor).as_bytes())?;
    publish(&picture, args.force, found.svg(origin.title.as_ref().unwrap_or(&origin.record[0])).as_bytes())?;
    let lacks = [(found.friction.is_none(), "friction"), (found.law.back.is_none(), "returned")];
    let own: String = lacks.iter().filter(|(is, _)| *is).map(|(_, key)| format!(", {key} = YOUR ESTIMATE")).collect();
    let file = quoted(output.display());
    print(&format!(
        "{}\nwritten to {file} and {}\nnext: in a scenario, NAME = {{ file = \"{}\"{own} }} under [materials]\n",
        found.words(),
        quoted(picture.display()),
        output.display()
    ))
}
