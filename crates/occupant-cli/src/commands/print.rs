//! `occupant print`.

use std::fs;
use std::path::PathBuf;

use clap::ValueEnum;
use occupant_core::scenario::kind::{KINDS, TIME, UnitSystem};

use crate::base::failure::{Done, Failure};
use crate::base::talk::{print, say};
use crate::jobs::print::{Case, Units, printout};

/// Print a run as paged text, as the report's program did
///
/// First everything that was read and the computed seating, then the results at every print time, last the pairs of
/// sphere and surface that an extension needs. 132 columns, 60 lines a page, form feeds between pages.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`
    #[arg(value_name = "RUN.mcap")]
    run: PathBuf,

    /// The file to write instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Replace a file that exists
    #[arg(short, long, requires = "output")]
    force: bool,

    /// Print interval (DTPRNT), such as "10 ms" or 0.01; every recorded output if absent
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    every: Option<String>,

    /// Units; those of the scenario if absent
    #[arg(long, value_name = "SYSTEM")]
    units: Option<UnitsChoice>,
}

/// Units of the printout.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum UnitsChoice {
    /// Metre, kilogram, newton
    Si,
    /// Inch, pound, pound-force
    #[value(name = "in-lbf-s")]
    InchPound,
}

pub(crate) fn print_run(args: &Args) -> Result<Done, Failure> {
    let every_s = args.every.as_deref().map(interval).transpose()?;
    let name = args.run.display();
    let bytes = fs::read(&args.run).map_err(|error| Failure::plain(format!("{name} cannot be read: {error}")))?;
    let refused = |reason| {
        Failure::with_help(
            format!("{name} cannot be printed: {reason}"),
            "give a file that `occupant run` of this version has written",
        )
    };
    let case = Case::read(&bytes).map_err(refused)?;
    let units = match args.units {
        Some(UnitsChoice::Si) => Units(UnitSystem::Si),
        Some(UnitsChoice::InchPound) => Units(UnitSystem::InchPound),
        None => case.units(),
    };
    let text = printout(&case, units, every_s).map_err(|e| Failure::plain(format!("{name}: {e}")))?;
    write(args, &text)?;
    if !case.is_complete() {
        say(&format!("{name} is partial; the last page says so"));
    }
    Ok(Done::Well)
}

/// A time with its unit; a bare number is in seconds.
fn interval(text: &str) -> Result<f64, Failure> {
    let seconds = KINDS[TIME].read(text).map_err(|error| error.expected);
    let wrong = |expected: &str| {
        Failure::with_help(
            format!("--every {text}: not a print interval; expected {expected}"),
            "give a time above zero, such as --every '10 ms'",
        )
    };
    match seconds {
        Ok(seconds) if seconds > 0.0 && seconds.is_finite() => Ok(seconds),
        Ok(_) => Err(wrong("a time above zero")),
        Err(expected) => Err(wrong(&expected)),
    }
}

fn write(args: &Args, text: &str) -> Result<(), Failure> {
    let Some(path) = &args.output else {
        return print(text);
    };
    let mut options = fs::OpenOptions::new();
    options.write(true);
    match args.force {
        true => options.create(true).truncate(true),
        false => options.create_new(true),
    };
    let written = options.open(path).and_then(|mut file| std::io::Write::write_all(&mut file, text.as_bytes()));
    written.map_err(|error| match error.kind() {
        std::io::ErrorKind::AlreadyExists => {
            Failure::with_help(format!("{} exists", path.display()), "--force replaces it, -o gives another name")
        }
        _ => Failure::plain(format!("{} cannot be written: {error}", path.display())),
    })
}
