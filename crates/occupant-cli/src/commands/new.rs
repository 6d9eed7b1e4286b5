//! `occupant new`.

use std::path::PathBuf;

use clap::ValueEnum;
use clap::builder::PossibleValue;

use crate::base::{Failure, publish, quoted, say};
use occupant_jobs::templates::Template;

/// Write a commented scenario or study that is ready to run
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The file to write; .toml is added if it has no extension
    #[arg(value_name = "NAME.toml")]
    file: PathBuf,

    /// The template
    #[arg(short, long, value_enum, default_value_t)]
    template: Named,

    /// Replace an existing file
    #[arg(short, long)]
    force: bool,

    /// Print nothing
    #[arg(short, long)]
    quiet: bool,
}

/// A template by its name on the command line.
#[derive(Clone, Copy, Debug, Default)]
struct Named(Template);

impl ValueEnum for Named {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [Named; Template::ALL.len()] = {
            let mut all = [Named(Template::Driver); Template::ALL.len()];
            let mut i = 0;
            while i < all.len() {
                all[i] = Named(Template::ALL[i]);
                i += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let (name, meaning) = self.0.words();
        Some(PossibleValue::new(name).help(meaning))
    }
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
    publish(&file, args.force, args.template.0.text().as_bytes())?;
    if !args.quiet {
        say(&format!("wrote {name}\nnext: {}", args.template.0.next(&quoted(&name))));
    }
    Ok(())
}
