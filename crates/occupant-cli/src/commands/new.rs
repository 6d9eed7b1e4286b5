//! `occupant new`.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser};

use crate::base::{Failure, publish, quoted, say};
use occupant_jobs::templates::Template;

/// Write a commented scenario or study that is ready to run
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The file to write; .toml is added if it has no extension
    #[arg(value_name = "NAME.toml")]
    file: PathBuf,

    /// The template
    #[arg(short, long, value_parser = names(), default_value = Template::ALL[0].name)]
    template: String,

    /// Replace an existing file
    #[arg(short, long)]
    force: bool,

    /// Print nothing
    #[arg(short, long)]
    quiet: bool,
}

/// The names of all templates, with what they describe.
fn names() -> PossibleValuesParser {
    Template::ALL.map(|template| PossibleValue::new(template.name).help(template.meaning)).into()
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
    let template = Template::named(&args.template).unwrap_or(Template::ALL[0]);
    publish(&file, args.force, template.text().as_bytes())?;
    if !args.quiet {
        say(&format!("wrote {name}\nnext: {}", template.next(&quoted(&name))));
    }
    Ok(())
}
