//! `occupant completions`.

use clap::CommandFactory;
use clap_complete::{Shell, generate};

use super::Cli;
use crate::base::{Failure, talk};

/// Print a script for tab completion in your shell
///
/// For bash: occupant completions bash > ~/.local/share/bash-completion/completions/occupant
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the script.
pub(crate) fn print(args: &Args) -> Result<(), Failure> {
    let mut script = Vec::new();
    generate(args.shell, &mut Cli::command(), "occupant", &mut script);
    talk::print_file(&script)
}
