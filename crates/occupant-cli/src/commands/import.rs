//! `occupant import`.

use std::path::{Path, PathBuf};

use occupant_scenario::kind::{FREQUENCY, KINDS, LENGTH, SPEED, TIME};

use super::flags::history::{WindowArgs, interval};
use crate::base::{Failure, ending, file_name, file_stem, note, one_of, publish, quoted, refuse_input, say};
use occupant_files::measured::{self, AXES, Axes, DELTA_V, DeltaV, Hints, Imported, Reading, SIDES};
use occupant_jobs::import::{Made, PathFilter, Request, import as made, is_belted, scenario};

/// Make a scenario from a crash test, an event data recorder or a simulated path
///
/// SOURCE is an NHTSA test (vNNNNN.EV5 with its ASCII curves), an ISO-MME test (folder or .mme file), an OpenSCENARIO
/// trajectory (.xosc), or a table of an event data recorder, of esmini, CarSim, PC-Crash and others. Writes NAME-path.csv,
/// the vehicle's motion; NAME.toml, the driver of `occupant new` on that path, for you to adapt to the car and person; and
/// NAME-curves.csv, all other signals, which `compare`, `plot` and `fit` read.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The record: a folder or a file
    #[arg(value_name = "SOURCE")]
    source: PathBuf,

    /// The scenario to write; named after the source, in the current folder, if absent
    #[arg(short, long, value_name = "NAME.toml")]
    output: Option<PathBuf>,

    /// Which vehicle of the test or table; the first if absent
    #[arg(long, value_name = "NUMBER")]
    vehicle: Option<u32>,

    /// Which object, if the file has several trajectories
    #[arg(long, value_name = "NAME")]
    object: Option<String>,

    /// Which accelerometer location of the test to make the path from, such as DSLF, or DSLF+DSRF for the mean; if absent the
    /// one with least ringing among those that agree on delta-v
    #[arg(long, value_name = "PLACE")]
    at: Option<String>,

    /// Speed at the start of the path, such as '56 km/h'; that of the test if absent
    #[arg(long, value_name = "SPEED", value_parser = written::<SPEED>)]
    speed: Option<String>,

    /// Distance of the centre of gravity ahead of the trajectory's reference point, such as '1.3 m'
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, value_parser = written::<LENGTH>)]
    cg: Option<String>,

    /// Names and units for the columns, instead of the table's headings: `-` skips a column, a minus before a name reverses
    /// its sign, such as 't[ms],-,ax[g]' or 't[ms],-dvx[mph]'
    #[arg(long, value_name = "COLUMNS", allow_hyphen_values = true)]
    columns: Option<String>,

    /// Axes of the record; if absent as the file format defines them, else z_down
    #[arg(long, value_name = "AXES", value_parser = one_of(&AXES))]
    axes: Option<Axes>,

    /// Which event of a recorder's report, if it has several
    #[arg(long, value_name = "EVENT")]
    event: Option<String>,

    /// Where the vehicle was struck; gives the velocity changes of a recorder their signs, if its report prints magnitudes
    #[arg(long, value_name = "SIDE", value_delimiter = ',', value_parser = one_of(&SIDES))]
    struck: Vec<[i8; 2]>,

    /// Whether the velocity changes of a recorder are cumulative or per interval, if its report leaves it open
    #[arg(long, value_name = "KIND", value_parser = one_of(&DELTA_V))]
    delta_v: Option<DeltaV>,

    /// Fill gaps up to this length linearly, such as '5 ms'; gaps are an error if absent
    #[arg(long, value_name = "TIME", value_parser = interval)]
    bridge: Option<f64>,

    /// Length of the quiet part at the start of the record, used to remove zero offsets, such as '50 ms'
    #[arg(long, value_name = "TIME", value_parser = written::<TIME>)]
    baseline: Option<String>,

    /// Length of the quiet part at the end, used to remove linear drift as well
    #[arg(long, value_name = "TIME", requires = "baseline", value_parser = written::<TIME>)]
    baseline_end: Option<String>,

    /// Low-pass filter of the path: a CFC (60, 180, 600, 1000) for accelerations, 60 if absent and the sample rate allows it; a
    /// frequency, such as '15 Hz', for positions and angles; or none
    #[arg(long, value_name = "CLASS|FREQUENCY", value_parser = filter)]
    filter: Option<PathFilter>,

    #[command(flatten)]
    window: WindowArgs,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,
}

pub(crate) fn import(args: &Args) -> Result<(), Failure> {
    let name = args.output.clone().unwrap_or_else(|| Path::new(&stem(&args.source)).with_extension("toml"));
    let sides = |sum: [i8; 2], side: &[i8; 2]| [sum[0] + side[0], sum[1] + side[1]];
    let hints = Hints {
        event: args.event.as_deref(),
        struck: (!args.struck.is_empty()).then(|| args.struck.iter().fold([0, 0], sides)),
        delta_v: args.delta_v,
        speed_m_s: args.speed.as_deref().and_then(|speed| KINDS[SPEED].read(speed).ok()),
    };
    let columns = args.columns.as_deref();
    let reading = Reading { vehicle: args.vehicle, object: args.object.as_deref(), columns, hints: Some(hints) };
    let imported = measured::import(&args.source, reading)?;
    let made = made(
        &imported,
        &Request {
            place: args.at.as_deref(),
            window_s: [args.window.from, args.window.to],
            speed: args.speed.as_deref(),
            cg: args.cg.as_deref(),
            axes: args.axes,
            bridge_s: args.bridge,
            baseline: [args.baseline.as_deref(), args.baseline_end.as_deref()],
            filter: args.filter,
        },
    )?;
    made.notes.iter().for_each(note);
    // curves under the names of channels are of use alone
    let has_channels = imported.recording.signals.iter().any(|signal| is_channel(&signal.name));
    if made.path.is_none() && is_table(&args.source) && !has_channels {
        return Err(Failure::plain(format!(
            "{} contains no vehicle motion: nothing was written",
            args.source.display()
        )));
    }
    write(args, &name, &imported, &made)
}

/// Whether a name is that of a channel, `head.acceleration.x`, and no abbreviation.
fn is_channel(name: &str) -> bool {
    let is_word = |word: &str| {
        word.starts_with(char::is_alphabetic) && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    name.contains('.') && name.split('.').all(is_word)
}

/// Whether the source is a single table, which is useless without a path.
fn is_table(source: &Path) -> bool {
    !source.is_dir() && matches!(ending(source).as_str(), "csv" | "txt" | "tsv" | "asc" | "dat" | "xlsx")
}

/// A low-pass filter as text.
///
/// # Errors
/// The invalid value.
pub(super) fn filter(text: &str) -> Result<PathFilter, String> {
    let word = text.trim().to_ascii_lowercase();
    match word.strip_prefix("cfc").unwrap_or(&word).trim() {
        "none" => return Ok(PathFilter::None),
        class @ ("60" | "180" | "600" | "1000") => {
            return class.parse().map(PathFilter::Class).map_err(|_| String::new());
        }
        _ => {}
    }
    match KINDS[FREQUENCY].read(text) {
        Ok(hertz) if hertz > 0.0 && text.contains("Hz") => Ok(PathFilter::Frequency(hertz)),
        _ => Err("expected CFC60, CFC180, CFC600, CFC1000, a frequency such as '15 Hz', or none".to_owned()),
    }
}

/// A quantity as text, at least 0.
fn written<const KIND: usize>(text: &str) -> Result<String, String> {
    match KINDS[KIND].read(text) {
        Ok(value) if value >= 0.0 => Ok(text.trim().to_owned()),
        Ok(_) => Err("below 0".to_owned()),
        Err(error) => Err(format!("{}; expected {}", error.found, error.expected)),
    }
}

/// The file name of the source without extension.
fn stem(source: &Path) -> String {
    let whole = std::fs::canonicalize(source).unwrap_or_else(|_| source.to_owned());
    let name = if whole.is_dir() { file_name(&whole) } else { file_name(&whole.with_extension("")) };
    file_stem(&name).replace(' ', "_")
}

fn write(args: &Args, name: &Path, imported: &Imported, made: &Made) -> Result<(), Failure> {
    let beside = |word: &str| name.with_file_name(format!("{}{word}", file_name(&name.with_extension(""))));
    let [path_file, curves_file] = [beside("-path.csv"), beside("-curves.csv")];
    [name, &path_file, &curves_file].iter().try_for_each(|file| refuse_input(file, &args.source))?;
    if let Some(path) = &made.path {
        publish(&path_file, args.force, &path.csv)?;
        say(&format!("wrote {}: {}", path_file.display(), path.words));
        let text = scenario(&file_name(&args.source), imported, path, &file_name(&path_file));
        publish(name, args.force, text.as_bytes())?;
        let [from_s, to_s] = path.run_s.map(placed_text::number);
        let who = if is_belted(&imported.report) { "a belted" } else { "an unbelted" };
        say(&format!(
            "wrote {}: {who} driver in a generic car on that path, from {from_s} s to {to_s} s (--from and --to select a part)",
            name.display()
        ));
    }
    if let Some((bytes, count)) = &made.curves {
        publish(&curves_file, args.force, bytes)?;
        say(&format!("wrote {}: {count} signals", curves_file.display()));
    }
    let next = match (&made.path, &made.curves) {
        (Some(_), Some(_)) => vec![
            format!("occupant run {}", quoted(name.display())),
            format!(
                "occupant compare {} {}",
                quoted(name.with_extension("mcap").display()),
                quoted(curves_file.display())
            ),
        ],
        (Some(_), None) => {
            let name = quoted(name.display());
            vec![format!("occupant check {name}"), format!("occupant run {name}")]
        }
        (None, _) => vec![format!("occupant compare RUN.mcap {}", quoted(curves_file.display()))],
    };
    say(&format!("next: {}", next.join("\n      ")));
    Ok(())
}
