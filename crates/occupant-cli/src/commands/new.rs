//! `occupant new`.

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::PathBuf;

use crate::base::failure::{Done, Failure};
use crate::base::talk::say;

/// The scenario that `occupant new` writes.
const STARTER: &str = include_str!("starter.toml");

/// Write a commented starter scenario that runs as it is
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The file to write; .toml is added where there is no extension
    #[arg(value_name = "NAME.toml")]
    file: PathBuf,

    /// Replace the file if it exists
    #[arg(short, long)]
    force: bool,

    /// Say nothing
    #[arg(short, long)]
    quiet: bool,
}

/// Writes the starter scenario.
pub(crate) fn new(args: &Args) -> Result<Done, Failure> {
    let mut file = args.file.clone();
    if file.extension().is_none() {
        file.set_extension("toml");
    }
    let name = file.display();
    if file.extension().is_some_and(|e| !e.eq_ignore_ascii_case("toml")) {
        return Err(Failure::with_help(
            format!("{name} is not named .toml, and the starter scenario is TOML"),
            "give it a name that ends with .toml",
        ));
    }
    let mut options = OpenOptions::new();
    options.write(true);
    match args.force {
        true => options.create(true).truncate(true),
        false => options.create_new(true),
    };
    let written = options.open(&file).and_then(|mut target| target.write_all(STARTER.as_bytes()));
    match written {
        Ok(()) if args.quiet => Ok(Done::Well),
        Ok(()) => {
            say(&format!("wrote {name}\nnext: occupant check {name}\n      occupant run {name}"));
            Ok(Done::Well)
        }
        Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(Failure::with_help(
            format!("{name} exists, and it was left alone"),
            "choose another name, or replace it with --force",
        )),
        Err(error) => Err(Failure::plain(format!("{name} cannot be written: {error}"))),
    }
}
