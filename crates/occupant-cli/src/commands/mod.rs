//! The command line, a file for each command: flags, their meaning, the job, and the output.
//!
//! It computes nothing and defines no file format; the crates below do.
//!
//! Results go to standard output, talk to standard error. Exit codes: 0 done; 1 it ran, and a check failed, the
//! integration failed or it was interrupted; 2 it could not run (flags, files, the scenario); 75 another process is at the same
//! work, and the same command succeeds later. A reader that closes the pipe early has what it wanted: that is success.

mod channels;
mod check;
mod compare;
mod completions;
mod convert;
mod drive;
mod explain;
mod export;
mod fit;
mod flags;
mod groups;
mod import;
mod man;
mod measures;
mod new;
mod optimise;
mod plot;
mod print;
mod report;
mod risk;
mod run;
mod schema;
mod seal;
mod sensitivity;
mod study;
mod surface;
mod sweep;
mod tables;
mod view;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::error::ContextKind;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use placed_text::shown;

use crate::base::{Done, Failure, hear_jobs, progress, say, survive_long_files, written};

/// Simulate the people in a car during a crash or a violent manoeuvre
#[derive(Debug, Parser)]
#[command(name = "occupant", version, propagate_version = false, max_term_width = 100)]
#[command(
    after_help = "Start with: occupant new my-case.toml && occupant run my-case.toml\nThen: occupant report my-case.mcap --open\n\n\
Exit codes: 0 success; 1 a run failed or was interrupted, or a check failed; 2 wrong input, nothing was run; \
75 another process is at the same work."
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// The commands: their flags and functions.
macro_rules! commands {
    ($($name:ident: $file:ident::$does:ident,)*) => {
        #[derive(Debug, Subcommand)]
        enum Command {
            $($name($file::Args),)*
        }

        fn done(command: Command) -> Result<Done, Failure> {
            match command {
                $(Command::$name(args) => $file::$does(&args).map(Into::into),)*
            }
        }
    };
}

commands! {
    Run: run::run,
    Drive: drive::drive,
    Sweep: sweep::sweep,
    Study: study::study,
    Fit: fit::fit,
    Optimise: optimise::optimise,
    Surface: surface::surface,
    Check: check::check,
    New: new::new,
    Explain: explain::explain,
    Channels: channels::channels,
    Schema: schema::print,
    Import: import::import,
    Convert: convert::convert,
    Print: print::print_run,
    Plot: plot::plot,
    Export: export::export,
    Compare: compare::compare,
    Measures: measures::measures,
    View: view::view,
    Report: report::report,
    Seal: seal::seal,
    Risk: risk::risk,
    Sensitivity: sensitivity::sensitivity,
    Completions: completions::print,
    Man: man::write,
}

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    survive_long_files();
    answer(std::env::args_os())
}

/// Runs a command line, which starts with the program's name.
pub fn answer(words: impl IntoIterator<Item = OsString>) -> ExitCode {
    hear_jobs();
    let parsed = groups::grouped(Cli::command()).try_get_matches_from(words);
    parsed.iter().for_each(watch_work);
    match parsed.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => {
            let done = done(cli.command);
            progress::end_line();
            exit_code(done)
        }
        Err(wrong) if wrong.use_stderr() => {
            let tip = if asks_to_simulate(&wrong) { "\n\n  tip: `occupant run` simulates a scenario" } else { "" };
            exit_code(Err(Failure::CouldNotRun(in_lines(&wrong.render().to_string()) + tip)))
        }
        Err(help) => exit_code(written(help.print()).map(Done::from)),
    }
}

/// Whether an unknown command is another word for `run`.
fn asks_to_simulate(wrong: &clap::Error) -> bool {
    let word = wrong.get(ContextKind::InvalidSubcommand).map(ToString::to_string);
    word.is_some_and(|word| ["simulate", "sim", "start", "solve", "exec"].contains(&word.as_str()))
}

/// Shows a status line for a command unless it is quiet.
fn watch_work(matches: &ArgMatches) {
    let (mut words, mut own) = (vec!["occupant"], matches);
    while let Some((name, below)) = own.subcommand() {
        words.push(name);
        own = below;
    }
    if !matches!(own.try_get_one::<bool>("quiet"), Ok(Some(true))) {
        progress::watch(words.join(" "));
    }
}

/// A text that contains words of the command line, with control characters made visible.
fn in_lines(text: &str) -> String {
    text.trim_end().lines().map(shown).collect::<Vec<_>>().join("\n")
}

/// Prints the error, if any; the exit code.
fn exit_code(result: Result<Done, Failure>) -> ExitCode {
    let failed = |message: &str, code: u8| {
        say(message);
        ExitCode::from(code)
    };
    match result {
        Ok(Done::Well) => ExitCode::SUCCESS,
        Ok(Done::Unwell) => ExitCode::from(1),
        Err(Failure::BrokeOff(message)) => failed(&message, 1),
        Err(Failure::CouldNotRun(message)) => failed(&message, 2),
        // EX_TEMPFAIL of sysexits.h
        Err(Failure::Busy(message)) => failed(&message, 75),
    }
}
