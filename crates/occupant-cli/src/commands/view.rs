//! `occupant view`.

use std::path::{Path, PathBuf};

use crate::base::{Failure, Interrupt, deliver_and, ending, file_name, progress, with_word};
use occupant_files::results::Results;
use occupant_jobs::files::scenario::{self, ScenarioArgs, warn_of};
use occupant_jobs::view::{Picture, Target};

/// Draw a run at chosen times, or as a film; draw how a scenario starts
///
/// A run becomes a strip: one column per time, one row per view (side, top, front), all to one scale. Arrows are contact
/// forces on the body. A scenario that has not been run is drawn as it starts. Positions are in vehicle axes.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`, or a scenario
    #[arg(value_name = "RUN.mcap|SCENARIO")]
    input: PathBuf,

    /// The picture, NAME.svg or NAME.png, or the film, NAME.gif or NAME.mp4 (needs ffmpeg); NAME-view.svg beside the input
    /// if absent, NAME-view.png with --3d
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Write each frame of the film as a PNG file into this folder
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["output", "open"])]
    each: Option<PathBuf>,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    /// Open the file with the system's default program
    #[arg(long)]
    open: bool,

    #[command(flatten)]
    picture: Picture,

    /// Change a value of the scenario, such as --set body.preset=female05. May be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,
}

pub(crate) fn view(args: &Args) -> Result<(), Failure> {
    let usual = if args.picture.solid.is_asked() { "png" } else { "svg" };
    let output = args.output.clone().unwrap_or_else(|| with_word(&args.input.with_extension(usual), "-view"));
    let target = Target { output: &output, each: args.each.as_deref(), force: args.force };
    args.picture.check(&args.input, target)?;
    if ending(&args.input) != "mcap" {
        return seated(args, &output, target);
    }
    if !args.overrides.is_empty() {
        return Err(Failure::with_help("--set changes a scenario, but this is a run", "run the scenario with --set"));
    }
    let work = (progress::show(false), &Interrupt::default());
    match args.picture.of_run(Results::open(&args.input)?, target, work)? {
        Some(bytes) => deliver_and(args.open, &output, args.force, &bytes),
        None => Ok(()),
    }
}

/// Draws the initial position of the body of a scenario.
fn seated(args: &Args, output: &Path, target: Target<'_>) -> Result<(), Failure> {
    args.picture.of_scenario(target)?;
    let scenario = ScenarioArgs { scenario: args.input.clone(), overrides: args.overrides.clone() };
    let opened = scenario::open(&scenario)?;
    warn_of(&opened);
    let drawing = args.picture.of_start(&opened, &file_name(&args.input), target)?;
    deliver_and(args.open, output, args.force, &drawing)
}
