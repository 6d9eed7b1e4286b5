//! The command line, a file for each command: flags, what they mean, which job they ask for, and what the program answers.
//!
//! Computes nothing and lays out no file: that is the work of the rooms below.
//!
//! Results go to standard output, talk to standard error. Exit codes: 0 done; 1 it ran, and a check failed, the
//! integration failed or it was interrupted; 2 it could not run (flags, files, the scenario). A reader that closes the pipe
//! early has what it wanted: that is success.

mod check;
mod compare;
mod completions;
mod convert;
mod export;
mod fit;
mod flags;
mod measures;
mod new;
mod plot;
mod print;
mod report;
mod risk;
mod run;
mod schema;
mod sensitivity;
mod study;
mod sweep;
mod tables;
mod view;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::base::failure::{Done, Failure};
use crate::base::talk::{say, written};

/// Simulates the occupant of a car in a crash or a violent manoeuvre.
#[derive(Debug, Parser)]
#[command(name = "occupant", version, propagate_version = false, max_term_width = 100)]
#[command(after_help = "Exit codes: 0 done; 1 ran, and a check failed, the integration failed or it was \
interrupted; 2 could not run.\n\nStart with: occupant new my-case.toml && occupant run my-case.toml")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Args),
    Sweep(sweep::Args),
    Study(study::Args),
    Fit(fit::Args),
    Check(check::Args),
    New(new::Args),
    Schema(schema::Args),
    Convert(convert::Args),
    Print(print::Args),
    Plot(plot::Args),
    Export(export::Args),
    Compare(compare::Args),
    Measures(measures::Args),
    View(view::Args),
    Report(report::Args),
    Risk(risk::Args),
    Sensitivity(sensitivity::Args),
    Completions(completions::Args),
}

/// Reads the command line and does what it says.
pub fn main() -> ExitCode {
    answer(std::env::args_os())
}

/// Does what these words say, of which the first is the program's name.
pub fn answer(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    match Cli::try_parse_from(words) {
        Ok(cli) => exit_code(done(cli.command)),
        Err(wrong) if wrong.use_stderr() => wrong.exit(),
        Err(help) => exit_code(written(help.print()).map(|()| Done::Well)),
    }
}

fn done(command: Command) -> Result<Done, Failure> {
    match command {
        Command::Run(args) => run::run(&args),
        Command::Sweep(args) => sweep::sweep(&args),
        Command::Study(args) => study::study(&args),
        Command::Fit(args) => fit::fit(&args),
        Command::Check(args) => check::check(&args),
        Command::New(args) => new::new(&args),
        Command::Schema(args) => schema::print(&args),
        Command::Convert(args) => convert::convert(&args),
        Command::Print(args) => print::print_run(&args),
        Command::Plot(args) => plot::plot(&args),
        Command::Export(args) => export::export(&args),
        Command::Compare(args) => compare::compare(&args),
        Command::Measures(args) => measures::measures(&args),
        Command::View(args) => view::view(&args),
        Command::Report(args) => report::report(&args),
        Command::Risk(args) => risk::risk(&args),
        Command::Sensitivity(args) => sensitivity::sensitivity(&args),
        Command::Completions(args) => completions::print(&args),
    }
}

/// Says what went wrong, if anything, and gives the exit code.
fn exit_code(result: Result<Done, Failure>) -> ExitCode {
    match result {
        Ok(Done::Well) => ExitCode::SUCCESS,
        Ok(Done::Unwell) => ExitCode::from(1),
        Err(Failure::BrokeOff(message)) => {
            say(&message);
            ExitCode::from(1)
        }
        Err(Failure::CouldNotRun(message)) => {
            say(&message);
            ExitCode::from(2)
        }
    }
}
