//! `occupant man`.

use std::fs;
use std::path::PathBuf;

use clap::CommandFactory;
use clap_mangen::Man;

use super::Cli;
use crate::base::{Failure, publish, say};

/// Write manual pages for all commands
///
/// Example: occupant man ~/.local/share/man/man1, then man occupant-run
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The folder; created if missing
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,
}

/// Writes a page for the program and one for each command.
pub(crate) fn write(args: &Args) -> Result<(), Failure> {
    let folder = &args.folder;
    fs::create_dir_all(folder).map_err(|e| Failure::plain(format!("{} cannot be made: {e}", folder.display())))?;
    let mut program = Cli::command();
    program.build();
    let name = |command: &clap::Command| command.get_display_name().unwrap_or(command.get_name()).to_owned();
    let commands: Vec<_> = std::iter::once(&program).chain(program.get_subcommands()).collect();
    for command in &commands {
        let mut page = Vec::new();
        let title = name(command);
        let made = Man::new((*command).clone()).render(&mut page);
        made.map_err(|error| Failure::plain(format!("the page of {title} cannot be made: {error}")))?;
        publish(&folder.join(format!("{title}.1")), args.force, &page)?;
    }
    say(&format!("wrote {} pages into {}", commands.len(), folder.display()));
    Ok(())
}
