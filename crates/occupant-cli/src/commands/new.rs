//! `occupant new`.

mod template;

use std::path::PathBuf;

use crate::base::{Failure, publish, quoted, say};
use template::Template;

/// The default template.
pub(super) const STARTER: &str = include_str!("new/driver.toml");

/// Write a commented scenario or study that is ready to run
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The file to write; .toml is added if it has no extension
    #[arg(value_name = "NAME.toml")]
    file: PathBuf,

    /// The template
    #[arg(short, long, value_enum, default_value_t)]
    template: Template,

    /// Replace an existing file
    #[arg(short, long)]
    force: bool,

    /// Print nothing
    #[arg(short, long)]
    quiet: bool,
}

/// The driver's scenario with another title and path; all three as TOML.
pub(super) fn with_path(title: &str, origin: &str, section: &str) -> String {
    let head = "# A belted driver in a generic car, on the vehicle path of a test: change body, posture, belts and interior to those of the test.\n\n";
    let changed = template::changed(STARTER, &format!("{head}title = {title}\n\n{section}"));
    let line = |line: &str| match line.starts_with("path = ") {
        true => format!("path = {origin}\n"),
        false => line.to_owned(),
    };
    changed.split_inclusive('\n').map(line).collect()
}

/// Writes the starter scenario.
pub(crate) fn new(args: &Args) -> Result<(), Failure> {
    let mut file = args.file.clone();
    if file.extension().is_none() {
        file.set_extension("toml");
    }
    let name = file.display();
    if file.extension().is_some_and(|e| !e.eq_ignore_ascii_case("toml")) {
        return Err(Failure::with_help(format!("{name}: the template is written as TOML"), "use the extension .toml"));
    }
    publish(&file, args.force, args.template.text().as_bytes())?;
    if !args.quiet {
        say(&format!("wrote {name}\nnext: {}", args.template.next(&quoted(&name))));
    }
    Ok(())
}
