//! `occupant sensitivity`.

use std::path::PathBuf;

use crate::base::progress::show;
use crate::base::{Existing, Failure, UnitsArg, file_name, print, sha256};
use occupant_files::table::Form;
use occupant_jobs::export::TableFiles;
use occupant_jobs::files::history::UnitChoice;
use occupant_jobs::files::scenario::{ScenarioArgs, files_beside, inputs, open_source, source, warn_of};
use occupant_jobs::sensitivity::{Words, about, analyse, answer, ask, histories, text};

/// Compute how measures and channels change with numbers of the scenario
///
/// Derivatives are exact (dual numbers), not differences of runs. Each is then checked against runs in which the number is
/// changed by up to 1 %, and events that limit it are listed: contacts that begin, friction that reverses, belts that go
/// slack. All values are SI, angles in radians. A path to several numbers, such as joints.*.damping, scales all of them.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example: occupant sensitivity cart.toml --to hic15,belts.lap.peak --of joints.neck.damping,materials.seat.k1"
)]
pub(crate) struct Args {
    #[command(flatten)]
    scenario: ScenarioArgs,

    /// Measures to differentiate, such as hic15,belts.lap.peak; `*` matches anything
    #[arg(long, value_name = "MEASURES", required_unless_present = "channels")]
    to: Vec<String>,

    /// Numbers of the scenario to vary, such as joints.neck.damping,materials.seat.k1
    #[arg(long, value_name = "PATHS", required = true)]
    of: Vec<String>,

    /// Also differentiate these channels over time and write them to -o, such as 'head.acceleration.*'
    #[arg(long = "channel", alias = "channels", value_name = "NAMES", requires = "output")]
    channels: Vec<String>,

    /// The table of channels and their derivatives: .csv or .parquet
    #[arg(short, long, value_name = "FILE", requires = "channels")]
    output: Option<PathBuf>,

    #[command(flatten)]
    units: UnitsArg,

    /// Print JSON, in SI units
    #[arg(long)]
    json: bool,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    /// Show no progress
    #[arg(short, long)]
    quiet: bool,
}

/// Computes and prints the derivatives.
pub(crate) fn sensitivity(args: &Args) -> Result<(), Failure> {
    let form = args.output.as_deref().map(Form::of_output).transpose()?;
    let source = source(&args.scenario)?;
    let base = source.draft.clone();
    let opened = open_source(&args.scenario, source)?;
    warn_of(&opened);
    let scenario = &args.scenario.scenario;
    let resolver = files_beside(scenario);
    let words = Words { to: &args.to, of: &args.of, channels: &args.channels };
    // names that are taken are refused before the work
    let kept = inputs(scenario, &opened.loaded);
    let begin = |(path, form): (&PathBuf, Form)| TableFiles::begin(path, form, &kept, Existing::by(args.force));
    let files = args.output.as_ref().zip(form).map(begin).transpose()?;
    let asked = ask(&base, &opened.model, &resolver, &words)?;
    let analysis = analyse(&opened.model, &asked, show(args.quiet))?;
    let name = file_name(scenario);
    if let Some(files) = files {
        let about = about(&opened.model, &asked, &analysis, [&name, &sha256(&opened.bytes)]);
        files.write(&histories(&asked, &analysis), &about, UnitChoice::Si)?;
    }
    print(&if args.json {
        crate::base::json(&answer(&name, &opened.model, &asked, &analysis))?
    } else {
        text(&opened.model, &asked, &analysis, args.units.or(opened.loaded.scenario.units))
    })
}
