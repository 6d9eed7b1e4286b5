//! `occupant plot`.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args as _, FromArgMatches};
use placed_text::number;

use super::flags::history::{TestArgs, WindowArgs};
use crate::base::{Failure, file_name, note, program, publish, refuse_input, said_and_opened, say, with_word};
use occupant_files::results::Results;
use occupant_jobs::files::history::{AxisChoice, Treatment, UnitChoice};
use occupant_jobs::plot::{Request, plots};
use occupant_pictures::Format;
use occupant_pictures::plot::{Figure, LimitArgument, Sheet, sheet};

/// Plot time histories of one or more runs as SVG or PNG
///
/// Without --channel, draws fourteen standard plots: accelerations of head, chest and pelvis, contact forces, belt loads,
/// spine angles, energies, vehicle motion. Accelerations are those of an accelerometer fixed in the segment, in its axes: X
/// forward, Y left, Z up when the person stands.
#[derive(Debug, clap::Args)]
#[command(mut_arg("map", |map| map.requires("test")))]
pub(crate) struct Args {
    /// The results of `occupant run`; several are overlaid
    #[arg(value_name = "RUN.mcap", required = true)]
    runs: Vec<PathBuf>,

    /// The file to write, all plots on one sheet: .svg or .png; RUN-plot.svg beside the first run if absent
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Write each plot as a file into this folder
    #[arg(long, value_name = "FOLDER", conflicts_with = "output")]
    each: Option<PathBuf>,

    /// File format for --each
    #[arg(long, value_name = "KIND", default_value = "svg", requires = "each")]
    format: Format,

    /// Plot these channels, by name or pattern, such as 'head.acceleration.*,chest.acceleration.x'. Repeat for more plots
    #[arg(long, alias = "channels", value_name = "NAMES")]
    channel: Vec<String>,

    /// The channel on the horizontal axis, instead of time
    #[arg(long, value_name = "NAME", requires = "channel", conflicts_with = "test")]
    x: Option<String>,

    /// Draw a limit line, such as 'head.acceleration.resultant=80 g'; in the unit of the plot if it has none
    #[arg(long, value_name = "CHANNEL=LEVEL")]
    limit: Vec<LimitArgument>,

    /// Draw measured signals in black: a CSV table, ISO-MME folder or .mme file
    #[arg(long, value_name = "FILE")]
    test: Vec<PathBuf>,

    #[command(flatten)]
    signals: TestArgs,

    /// Units of the plots
    #[arg(long, value_name = "SYSTEM", default_value = "g")]
    units: UnitChoice,

    /// Axes of quantities that belong to a segment
    #[arg(long, value_enum, default_value_t)]
    axes: AxisChoice,

    #[command(flatten)]
    treatment: Treatment,

    #[command(flatten)]
    window: WindowArgs,

    /// Title; that of the scenario if absent
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,

    /// Number of plots in a row
    #[arg(long = "across", alias = "columns", value_name = "N", default_value = "3", value_parser = clap::value_parser!(u8).range(1..=10))]
    columns: u8,

    /// Resolution of a PNG, in pixels per 1/96 inch
    #[arg(long, value_name = "N", default_value = "2", value_parser = pixels)]
    pixels: f64,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    /// Open the file with the system's default program
    #[arg(long)]
    open: bool,
}

/// Draws the fourteen standard plots of a run, as the card STAN of a deck requests them.
pub(crate) fn draw_standard(run: &Path, force: bool) -> Result<(), Failure> {
    let words = [OsStr::new("plot"), run.as_os_str()].into_iter().chain(force.then_some(OsStr::new("--force")));
    let matches = Args::augment_args(clap::Command::new("plot")).try_get_matches_from(words);
    let args = matches.and_then(|matches| Args::from_arg_matches(&matches));
    plot(&args.map_err(|error| Failure::plain(error.to_string()))?)
}

pub(crate) fn plot(args: &Args) -> Result<(), Failure> {
    let beside = |run: &PathBuf| with_word(&run.with_extension("svg"), "-plot");
    let output = args.output.clone().or_else(|| args.runs.first().map(beside).filter(|_| args.each.is_none()));
    let kind = match &output {
        Some(output) => Format::of_output(output)?,
        None => args.format,
    };
    let window_s = window(args.window)?;
    let runs = args.runs.iter().map(|path| Results::open(path)).collect::<Result<Vec<_>, _>>()?;
    let (figures, notes) = plots(&Request {
        runs: &runs,
        channels: &args.channel,
        x: args.x.as_deref(),
        limits: &args.limit,
        tests: &args.test,
        map: &args.signals.map,
        seat: args.signals.seat,
        shift_s: args.signals.shift,
        treatment: args.treatment,
        units: args.units,
        axes: args.axes,
        window_s,
    })?;
    notes.iter().for_each(note);
    let words = words(args, &runs);
    match (&output, &args.each) {
        (Some(output), _) => {
            write(args, output, kind, &sheet(&words, &figures))?;
            said_and_opened(args.open, output);
            Ok(())
        }
        (None, Some(folder)) => write_each(args, folder, kind, &words, &figures),
        (None, None) => Ok(()),
    }
}

fn window(window: WindowArgs) -> Result<[f64; 2], Failure> {
    let [from, to] = [window.from.unwrap_or(f64::NEG_INFINITY), window.to.unwrap_or(f64::INFINITY)];
    if from < to {
        return Ok([from, to]);
    }
    Err(Failure::with_help(
        format!("--from {} s is not before --to {} s", number(from), number(to)),
        "give --from an earlier time than --to",
    ))
}

/// Largest number of runs with titles below the heading.
const MOST_RUNS: usize = 6;

fn words(args: &Args, runs: &[Results]) -> Sheet {
    let title = match (&args.title, runs) {
        (Some(title), _) => title.clone(),
        (None, [one]) => one.loaded.scenario.title.clone(),
        (None, several) => format!("{} runs", several.len()),
    };
    let line = |run: &Results| {
        let end = if run.is_complete() { "" } else { " – RUN DID NOT COMPLETE" };
        let (name, hash) = (file_name(&run.path), run.sha256.get(..12).unwrap_or_default());
        format!("{name}: {} (SHA-256 {hash}…){end}", run.loaded.scenario.title)
    };
    let mut lines: Vec<String> = runs.iter().take(MOST_RUNS).map(line).collect();
    if runs.len() > MOST_RUNS {
        lines.push(format!("and {} more", runs.len() - MOST_RUNS));
    }
    let filter = match args.treatment.words().as_str() {
        "none" => "not filtered".to_owned(),
        words => format!("filter: {words}"),
    };
    lines.push(format!("{}; {filter}; segment axes: X forward, Y left, Z up when upright", program()));
    Sheet { title, lines, columns: usize::from(args.columns) }
}

fn write_each(args: &Args, folder: &Path, kind: Format, words: &Sheet, figures: &[Figure]) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|e| Failure::plain(format!("{} cannot be made: {e}", folder.display())))?;
    for (i, figure) in figures.iter().enumerate() {
        let name = format!("{:02}-{}.{}", i + 1, slug(&figure.title), kind.ending());
        write(args, &folder.join(name), kind, &sheet(words, std::slice::from_ref(figure)))?;
    }
    let empty: Vec<&str> =
        figures.iter().filter(|figure| figure.curves.is_empty()).map(|figure| figure.title.as_str()).collect();
    let without = match empty.len() {
        0 => String::new(),
        count => format!(", {count} of them without a curve: {}", empty.join("; ")),
    };
    say(&format!("wrote {} plots into {}{without}", figures.len(), folder.display()));
    Ok(())
}

/// Longest file name, without number and extension.
const LONGEST_SLUG: usize = 60;

/// `Head acceleration X, ahead` → `head-acceleration-x-ahead`.
fn slug(title: &str) -> String {
    let mut slug = String::new();
    for letter in title.chars() {
        if letter.is_ascii_alphanumeric() {
            slug.push(letter.to_ascii_lowercase());
        } else if !slug.ends_with('-') && !slug.is_empty() {
            slug.push('-');
        }
    }
    slug.truncate(LONGEST_SLUG);
    slug.trim_end_matches('-').to_owned()
}

fn write(args: &Args, path: &Path, kind: Format, drawing: &str) -> Result<(), Failure> {
    for input in args.runs.iter().chain(&args.test) {
        refuse_input(path, input)?;
    }
    let bytes = kind.encode(drawing, args.pixels);
    let bytes = bytes.map_err(|e| Failure::plain(format!("{} cannot be made: {e}", path.display())))?;
    publish(path, args.force, &bytes)
}

fn pixels(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(n) if (0.1..=20.0).contains(&n) => Ok(n),
        _ => Err("expected a number from 0.1 to 20".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_become_file_names() {
        assert_eq!(slug("Head acceleration X, ahead"), "head-acceleration-x-ahead");
        assert_eq!(slug("∑ (a)/b"), "a-b");
        assert!(slug(&"long ".repeat(40)).len() <= LONGEST_SLUG);
    }
}
