//! `occupant convert`: card deck → scenario, scenario → card deck.

use std::path::{Path, PathBuf};

use cardio_legacy::{
    CompartmentLayout, ConvertOptions, Deck, DeckSeating, FromScenario, ParseOptions, PathSource, Strictness,
    write_file,
};
use clap::ArgGroup;
use occupant_files::deck::{compartment, compartment_beside, of_compartment};
use occupant_scenario::{Draft, Format, Loaded};

use crate::base::input_file::{deck, read};
use crate::base::{Failure, ending, file_name, print_file, publish, refuse_input, say, with_word};
use occupant_jobs::extend::{extend, extend_run};
use occupant_jobs::files::scenario::{files_beside, format_of};

/// Convert a 1970 card deck to a scenario, or a scenario to a card deck
///
/// A .toml or .json file is a scenario and becomes a deck. A .mcap file is a run; --extend makes the deck that continues it.
/// Any other file is a deck and becomes a scenario. The result goes to -o or to standard output; the conversion report and
/// all messages go to standard error.
#[derive(Debug, clap::Args)]
#[command(group = ArgGroup::new("strictness").args(["strict", "lenient"]))]
pub(crate) struct Args {
    /// The deck or the scenario
    #[arg(value_name = "FILE")]
    input: PathBuf,

    /// The file to write. A file with several decks becomes NAME-1.toml, NAME-2.toml, …
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Also write the conversion report to this file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,

    /// Treat every doubt about a deck as an error
    #[arg(long)]
    strict: bool,

    /// Repair a deck where the repair is obvious, with a warning
    #[arg(long)]
    lenient: bool,

    /// The vehicle path for a deck with MREAD ≠ 0: a CSV table with names and units in its first line, such as t[s],x[in],yaw[deg]
    #[arg(long, value_name = "FILE")]
    path: Option<PathBuf>,

    /// Names and units of the columns of --path, if its first line does not give them
    #[arg(long, value_name = "t[s],x[in],…", requires = "path", conflicts_with = "path_cards")]
    path_columns: Option<String>,

    /// --path contains series 12 cards, one per station
    #[arg(long, requires = "path")]
    path_cards: bool,

    /// The points that bound each surface; if absent compartment.toml beside the deck, else the built-in reconstruction
    #[arg(long, value_name = "FILE.toml")]
    compartment: Option<PathBuf>,

    /// Initial position of a body that the deck seats (NPOS = 0)
    #[arg(long, value_name = "HOW", default_value = "balanced")]
    seating: Seating,

    /// Write the deck that extends a run to this time, in s (series 6 and 14). A deck is run to its end first; a .mcap is used as
    /// it is
    #[arg(long, value_name = "TIME")]
    extend: Option<f64>,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    /// Print only errors
    #[arg(short, long)]
    quiet: bool,
}

/// Initial position of a body that the deck seats.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Seating {
    /// The whole body is moved until its contacts carry its weight
    Balanced,
    /// Only the pelvis sphere is balanced, in exactly the posture of the cards; other contacts add to it
    Pelvis,
}

impl From<Seating> for DeckSeating {
    fn from(how: Seating) -> Self {
        match how {
            Seating::Balanced => Self::Balanced,
            Seating::Pelvis => Self::Pelvis,
        }
    }
}

/// Converts in the direction given by the input's extension.
pub(crate) fn convert(args: &Args) -> Result<(), Failure> {
    let bytes = deck(&args.input)?;
    let is_deck = ending(&args.input) != "mcap" && format_of(&args.input).is_none();
    let beside = if is_deck { compartment_beside(&args.input) } else { None };
    let file = args.compartment.clone().or(beside);
    let layout = file.as_deref().map(compartment).transpose()?;
    if ending(&args.input) == "mcap" {
        return deliver_deck(args, run_to_deck(args, &bytes, layout.as_ref())?);
    }
    match format_of(&args.input) {
        Some(format) => deliver_deck(args, scenario_to_deck(args, &bytes, format, layout.as_ref())?),
        None => decks_to_scenarios(args, &bytes, layout, file.as_deref()),
    }
}

fn read_text(path: &Path) -> Result<String, Failure> {
    String::from_utf8(read(path)?).map_err(|_| Failure::plain(format!("{} is not UTF-8 text", path.display())))
}

fn decks_to_scenarios(
    args: &Args,
    bytes: &[u8],
    layout: Option<CompartmentLayout>,
    of: Option<&Path>,
) -> Result<(), Failure> {
    let decks = decks(args, bytes)?;
    if decks.len() > 1 && args.output.is_none() {
        let found = format!("{} contains {} decks; standard output takes one", args.input.display(), decks.len());
        return Err(Failure::with_help(found, "give a file with -o; its name is numbered"));
    }
    let mut reports = String::new();
    for (at, deck) in decks.iter().enumerate() {
        let own =
            |file: &Path| if decks.len() > 1 { with_word(file, &format!("-{}", at + 1)) } else { file.to_owned() };
        let output = args.output.as_deref().map(own);
        let options = ConvertOptions {
            deck_name: file_name(&args.input),
            path: path_source(args, output.as_deref())?,
            compartment: layout.clone(),
            seating: args.seating.into(),
        };
        let conversion =
            deck.to_scenario(&options).map_err(|error| Failure::plain(format!("{}: {error}", args.input.display())))?;
        let text = match args.extend {
            Some(final_s) => extend(deck, &conversion.toml, &options, final_s, args.quiet)?,
            None => conversion.toml.into_bytes(),
        };
        deliver(args, output.as_deref(), &text)?;
        let (name, title) = (args.input.display(), &deck.titles()[0]);
        reports.push_str(&format!("{name}: {title}\n{}{}\n", of_compartment(of), conversion.report));
    }
    report(args, &reports)
}

/// The decks of a file; their problems are printed.
fn decks(args: &Args, bytes: &[u8]) -> Result<Vec<Deck>, Failure> {
    let strictness = match (args.strict, args.lenient) {
        (true, _) => Strictness::Strict,
        (_, true) => Strictness::Lenient,
        _ => Strictness::Default,
    };
    let (decks, diagnostics) = Deck::parse(bytes, &ParseOptions { file: args.input.display().to_string(), strictness });
    if diagnostics.has_errors() {
        return Err(Failure::CouldNotRun(format!("{diagnostics}\n{}: nothing was converted", args.input.display())));
    }
    if !diagnostics.is_empty() && !args.quiet {
        say(&diagnostics.to_string());
    }
    Ok(decks)
}

/// The path of a deck with MREAD ≠ 0. A CSV file in the scenario's folder is referred to, any other is included.
fn path_source(args: &Args, output: Option<&Path>) -> Result<Option<PathSource>, Failure> {
    let Some(file) = &args.path else {
        return Ok(None);
    };
    let text = read_text(file)?;
    if args.path_cards {
        return Ok(Some(PathSource::Cards { text }));
    }
    let split = |columns: &str| columns.split(',').map(|c| c.trim().to_owned()).collect();
    if let Some(columns) = &args.path_columns {
        return Ok(Some(PathSource::Columns { columns: split(columns), text }));
    }
    let folder = |path: &Path| path.parent().map(Path::to_owned).unwrap_or_default();
    if output.is_some_and(|output| folder(output) == folder(file)) {
        return Ok(Some(PathSource::Csv { name: file_name(file), text }));
    }
    let mut lines = text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
    let header = lines.next().unwrap_or_default().trim_start_matches('\u{feff}').to_owned();
    if !header.contains('[') {
        let found = format!("the first line of {} does not name columns with units: {header}", file.display());
        return Err(Failure::with_help(found, "give them with --path-columns t[s],x[in],…"));
    }
    let rows: String = lines.map(|line| format!("{line}\n")).collect();
    Ok(Some(PathSource::Columns { columns: split(&header), text: rows }))
}

/// The deck that continues the run of a results file.
fn run_to_deck(args: &Args, bytes: &[u8], layout: Option<&CompartmentLayout>) -> Result<FromScenario, Failure> {
    let Some(final_s) = args.extend else {
        return Err(Failure::with_help(
            format!("{} is a run; it can only become a deck that extends it", args.input.display()),
            "give the new end time: --extend TIME",
        ));
    };
    extend_run(&args.input, bytes, layout, final_s)
}

fn scenario_to_deck(
    args: &Args,
    bytes: &[u8],
    format: Format,
    layout: Option<&CompartmentLayout>,
) -> Result<FromScenario, Failure> {
    if args.extend.is_some() || args.path.is_some() {
        return Err(Failure::plain("--extend and --path need a deck as input"));
    }
    let loaded = load(&args.input, bytes, format)?;
    Deck::from_scenario(&loaded, layout).map_err(|error| Failure::plain(format!("{}: {error}", args.input.display())))
}

/// Writes a deck and prints its remarks.
fn deliver_deck(args: &Args, cards: FromScenario) -> Result<(), Failure> {
    let FromScenario { deck, remarks } = cards;
    deliver(args, args.output.as_deref(), &write_file(&[deck]))?;
    let remarks: String = remarks.iter().map(|remark| format!("  - {remark}\n")).collect();
    report(args, &format!("{}: on cards\n{remarks}", args.input.display()))
}

fn load(path: &Path, bytes: &[u8], format: Format) -> Result<Loaded, Failure> {
    let name = path.display().to_string();
    let loaded = Draft::read_bytes(bytes, Some(format), &name).and_then(|draft| draft.load(&files_beside(path)));
    loaded.map_err(|problems| Failure::CouldNotRun(format!("{problems}\n\n{name}: nothing was converted")))
}

fn deliver(args: &Args, output: Option<&Path>, bytes: &[u8]) -> Result<(), Failure> {
    match output {
        Some(file) => write(args, file, bytes),
        None => print_file(bytes),
    }
}

/// Writes a file. An existing file needs `force`; an input is never replaced.
fn write(args: &Args, file: &Path, bytes: &[u8]) -> Result<(), Failure> {
    for input in [Some(&args.input), args.path.as_ref(), args.compartment.as_ref()].into_iter().flatten() {
        refuse_input(file, input)?;
    }
    publish(file, args.force, bytes)
}

/// Prints the conversion report, and writes it to a file if asked.
fn report(args: &Args, text: &str) -> Result<(), Failure> {
    if !args.quiet {
        say(text.trim_end());
    }
    args.report.as_ref().map_or(Ok(()), |file| write(args, file, text.as_bytes()))
}
