//! `occupant study`.

mod bands;
mod report;

use clap::Subcommand;

use crate::base::Failure;

/// Report on a finished or running study
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(subcommand)]
    command: Step,
}

#[derive(Debug, Subcommand)]
enum Step {
    Report(report::ReportArgs),
    Bands(bands::BandsArgs),
}

/// Runs a subcommand of `study`.
pub(crate) fn study(args: &Args) -> Result<(), Failure> {
    match &args.command {
        Step::Report(args) => report::report(args),
        Step::Bands(args) => bands::bands(args),
    }
}
