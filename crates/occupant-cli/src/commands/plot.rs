//! `occupant plot`.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use occupant_core::results::channel::{Axes, Channel, find};

use super::flags::history::{HistoryArgs, code_letter, time};
use crate::base::failure::{Done, Failure};
use crate::base::names::{file_name, program};
use crate::base::output_file::{Existing, FileProblem, PartialFile, refuse_input};
use crate::base::talk::say;
use crate::files::history::{UnitChoice, choose, load};
use crate::files::measured::{self, MapArgument, Wanted, pairs};
use crate::files::results::Results;
use crate::pictures::Format;
use crate::pictures::plot::{
    Entry, Figure, LimitArgument, Material, Overlay, RunCurves, Sheet, Wish, figure, sheet, standard,
};

/// Draw time histories of one or more runs as SVG or PNG
///
/// Without --channel the fourteen plots of the report's option STAN: accelerations of head, chest and pelvis, contact forces,
/// belt loads, spine angles, energies, vehicle. Accelerations are what an accelerometer in the segment reads, in its axes:
/// X ahead, Y to the left, Z up when standing upright.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Results of `occupant run`; several are drawn over each other
    #[arg(value_name = "RUN.mcap", required = true)]
    runs: Vec<PathBuf>,

    /// The file to write, all plots on one sheet: NAME.svg or NAME.png
    #[arg(short, long, value_name = "FILE", required_unless_present = "each")]
    output: Option<PathBuf>,

    /// A folder for a file for each plot
    #[arg(long, value_name = "FOLDER", conflicts_with = "output")]
    each: Option<PathBuf>,

    /// Kind of the files in the folder of --each
    #[arg(long, value_name = "KIND", default_value = "svg", requires = "each")]
    format: Kind,

    /// A plot of these channels, by name or pattern with commas between; once for each plot
    #[arg(long, value_name = "NAMES")]
    channel: Vec<String>,

    /// The channel across instead of the time
    #[arg(long, value_name = "NAME", requires = "channel", conflicts_with = "test")]
    x: Option<String>,

    /// A level to draw, such as 'head.acceleration.resultant=80 g'; without unit in that of the plot
    #[arg(long, value_name = "CHANNEL=LEVEL")]
    limit: Vec<LimitArgument>,

    /// Measured signals to draw in black: CSV, ISO-MME folder or .mme file
    #[arg(long, value_name = "FILE")]
    test: Vec<PathBuf>,

    /// Which column of the tests is which channel: 'column[unit]=channel', with '-channel' for opposite signs
    #[arg(long, value_name = "MAP", requires = "test")]
    map: Vec<MapArgument>,

    /// Time added to the tests' clocks
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, default_value = "0")]
    shift: String,

    /// Position of the occupant in the tests' ISO-MME codes
    #[arg(long, value_name = "CODE", default_value = "1", value_parser = code_letter)]
    seat: char,

    /// Units
    #[arg(long, value_name = "SYSTEM", default_value = "g")]
    units: UnitChoice,

    #[command(flatten)]
    treatment: HistoryArgs,

    /// First time to draw, such as '20 ms'
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    from: Option<String>,

    /// Last time to draw
    #[arg(long, value_name = "TIME", allow_hyphen_values = true)]
    to: Option<String>,

    /// Heading; the scenario's title if absent
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,

    /// Plots beside each other on a sheet
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u8).range(1..=10))]
    columns: u8,

    /// Pixels of a PNG for each unit of the drawing (1/96 inch)
    #[arg(long, value_name = "N", default_value = "2", value_parser = pixels)]
    pixels: f64,

    /// Replace files that exist
    #[arg(short, long)]
    force: bool,
}

/// Kinds of files.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Kind {
    /// Scalable
    Svg,
    /// Pixels
    Png,
}

pub(crate) fn plot(args: &Args) -> Result<Done, Failure> {
    let kind = kind(args)?;
    let window_s = window(args)?;
    let runs = args.runs.iter().map(|path| Results::open(path)).collect::<Result<Vec<_>, _>>()?;
    let wishes = wishes(args, &runs)?;
    let names = channel_names(args, &wishes);
    let mut notes = Vec::new();
    let curves = load_all(args, &runs, &names, &mut notes)?;
    let overlays = overlays(args, &runs, &names, &mut notes)?;
    let unused = args.limit.iter().find(|l| !names.contains(&l.channel));
    if let Some(limit) = unused {
        return Err(Failure::with_help(
            format!("--limit: no plot shows the channel `{}`", limit.channel),
            "name a channel that is drawn; --channel adds a plot",
        ));
    }
    for note in &notes {
        say(&format!("note: {note}"));
    }
    let material = Material {
        runs: &curves,
        overlays: &overlays,
        limits: &args.limit,
        x: args.x.as_deref(),
        units: args.units,
        window_s,
    };
    let figures =
        wishes.iter().map(|wish| figure(wish, &material)).collect::<Result<Vec<_>, _>>().map_err(|reason| {
            Failure::with_help(reason, "give other channels a plot of their own with another --channel")
        })?;
    let words = words(args, &runs);
    match &args.each {
        Some(folder) => write_each(args, folder, kind, &words, &figures),
        None => write_sheet(args, kind, &words, &figures),
    }
}

fn kind(args: &Args) -> Result<Format, Failure> {
    let Some(output) = &args.output else {
        return Ok(match args.format {
            Kind::Svg => Format::Svg,
            Kind::Png => Format::Png,
        });
    };
    Format::of(output).ok_or_else(|| {
        Failure::with_help(
            format!("-o {}: the ending says nothing of a picture", output.display()),
            "end it in .svg or .png",
        )
    })
}

fn window(args: &Args) -> Result<[f64; 2], Failure> {
    let from = args.from.as_deref().map(|t| time("--from", t)).transpose()?;
    let to = args.to.as_deref().map(|t| time("--to", t)).transpose()?;
    let window = [from.unwrap_or(f64::NEG_INFINITY), to.unwrap_or(f64::INFINITY)];
    match window[0] < window[1] {
        true => Ok(window),
        false => Err(Failure::with_help(
            format!("--from {} s is not before --to {} s", window[0], window[1]),
            "--from is the earlier time",
        )),
    }
}

/// The plots asked for, with channels that any of the runs has.
fn wishes(args: &Args, runs: &[Results]) -> Result<Vec<Wish>, Failure> {
    if args.channel.is_empty() {
        let mut wishes = standard(&runs[0].model, runs.len() > 1);
        for other in &runs[1..] {
            for (wish, more) in wishes.iter_mut().zip(standard(&other.model, true)) {
                let new = more.entries.into_iter().filter(|e| !wish.entries.contains(e));
                let new: Vec<Entry> = new.collect();
                wish.entries.extend(new);
            }
        }
        return Ok(wishes);
    }
    args.channel.iter().map(|names| own_wish(names, runs)).collect()
}

/// A plot of channels by name, as the first run that has them knows them.
fn own_wish(names: &str, runs: &[Results]) -> Result<Wish, Failure> {
    let mut first_refusal = None;
    for run in runs {
        match choose(&run.model, &[names.to_owned()]) {
            Ok(channels) => return Ok(wish_of(names, &channels)),
            Err(refusal) => first_refusal = first_refusal.or(Some(refusal)),
        }
    }
    Err(first_refusal.unwrap_or_else(|| Failure::plain("no run was given")))
}

fn wish_of(names: &str, channels: &[Channel]) -> Wish {
    let title = match channels {
        [one] if one.axes != Axes::None => format!("{}, {} axes", one.name, one.axes.name()),
        [one] => one.name.clone(),
        _ => names.split(',').map(str::trim).collect::<Vec<_>>().join(", "),
    };
    let entry = |c: &Channel| Entry { channel: c.name.clone(), label: c.name.clone() };
    Wish {
        title,
        axis: channels.first().map_or("", |c| c.unit.quantity()).to_owned(),
        entries: channels.iter().map(entry).collect(),
        empty: "no value in this time".to_owned(),
    }
}

/// Every channel that some plot needs, once.
fn channel_names(args: &Args, wishes: &[Wish]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let drawn = wishes.iter().flat_map(|w| &w.entries).map(|e| &e.channel);
    for name in drawn.chain(&args.x) {
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    names
}

fn load_all(
    args: &Args,
    runs: &[Results],
    names: &[String],
    notes: &mut Vec<String>,
) -> Result<Vec<RunCurves>, Failure> {
    if let Some(x) = &args.x {
        for run in runs {
            choose(&run.model, std::slice::from_ref(x))?;
        }
    }
    let treatment = args.treatment.treatment(None)?;
    let mut curves = Vec::with_capacity(runs.len());
    for (run, label) in runs.iter().zip(labels(runs)) {
        let mut channels = Vec::with_capacity(names.len());
        for name in names {
            match find(&run.model, name) {
                Ok(channel) => channels.push(channel),
                Err(_) => notes.push(format!("{} has no channel {name}", run.path.display())),
            }
        }
        let histories = load(run, channels, treatment)?;
        notes.extend(histories.notes.iter().cloned());
        curves.push(RunCurves { label, histories });
    }
    Ok(curves)
}

/// Names of runs in legends: their files' names, as much of the path as tells them apart.
fn labels(runs: &[Results]) -> Vec<String> {
    if runs.len() == 1 {
        return vec![String::new()];
    }
    let stem = |r: &Results| {
        let stem = r.path.file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    };
    let label = |(i, run): (usize, &Results)| {
        let same = |r: &&Results| stem(r) == stem(run);
        if runs.iter().filter(same).count() == 1 {
            return stem(run);
        }
        let path = run.path.display().to_string();
        match runs.iter().filter(|r| r.path == run.path).count() {
            1 => path,
            _ => format!("{path} ({})", i + 1),
        }
    };
    runs.iter().enumerate().map(label).collect()
}

fn overlays(args: &Args, runs: &[Results], names: &[String], notes: &mut Vec<String>) -> Result<Vec<Overlay>, Failure> {
    let shift_s = time("--shift", &args.shift)?;
    let known = |n: &String| runs.iter().find_map(|r| find(&r.model, n).ok());
    let channels: Vec<Channel> = names.iter().filter_map(known).collect();
    let wanted: Vec<Wanted> = channels.iter().map(Wanted::from).collect();
    let mut overlays = Vec::new();
    for path in &args.test {
        let recording = measured::read(path)?;
        notes.extend(recording.notes.iter().cloned());
        let found = pairs(&recording, &wanted, &args.map, args.seat, notes)?;
        if found.is_empty() {
            return Err(Failure::with_help(
                format!("no signal of {} belongs to a channel that is drawn", path.display()),
                "say which column is which channel: --map 'column[unit]=head.acceleration.x'",
            ));
        }
        for mut pair in found {
            let channel = wanted[pair.channel].name.clone();
            if let Some(class) = args.treatment.filter.class_of(&channel) {
                pair.filter(class, args.treatment.coefficients)?;
            }
            pair.time_s.iter_mut().for_each(|t| *t += shift_s);
            overlays.push(Overlay { channel, file: file_name(path), pair });
        }
    }
    Ok(overlays)
}

/// Runs whose titles stand below the heading.
const MOST_RUNS_TOLD: usize = 6;

fn words(args: &Args, runs: &[Results]) -> Sheet {
    let title = match (&args.title, runs) {
        (Some(title), _) => title.clone(),
        (None, [one]) => one.loaded.scenario.title.clone(),
        (None, several) => format!("{} runs", several.len()),
    };
    let mut lines: Vec<String> = runs
        .iter()
        .take(MOST_RUNS_TOLD)
        .map(|run| {
            let end = if run.is_complete() { "" } else { " – RUN DID NOT COMPLETE" };
            let hash = run.sha256.get(..12).unwrap_or_default();
            let name = file_name(&run.path);
            format!("{name}: {} (SHA-256 {hash}…){end}", run.loaded.scenario.title)
        })
        .collect();
    if runs.len() > MOST_RUNS_TOLD {
        lines.push(format!("and {} more", runs.len() - MOST_RUNS_TOLD));
    }
    let filter = match args.treatment.words().as_str() {
        "none" => "not filtered".to_owned(),
        words => format!("filter: {words}"),
    };
    lines.push(format!("{}; {filter}; segment axes: X ahead, Y left, Z up when upright", program()));
    Sheet { title, lines, columns: usize::from(args.columns) }
}

fn write_sheet(args: &Args, kind: Format, words: &Sheet, figures: &[Figure]) -> Result<Done, Failure> {
    let Some(path) = &args.output else {
        return Ok(Done::Well);
    };
    write(args, path, kind, &sheet(words, figures))?;
    Ok(Done::Well)
}

fn write_each(args: &Args, folder: &Path, kind: Format, words: &Sheet, figures: &[Figure]) -> Result<Done, Failure> {
    fs::create_dir_all(folder).map_err(|e| Failure::plain(format!("{} cannot be made: {e}", folder.display())))?;
    let ending = match kind {
        Format::Svg => "svg",
        Format::Png => "png",
    };
    for (i, figure) in figures.iter().enumerate() {
        let name = format!("{:02}-{}.{ending}", i + 1, slug(&figure.title));
        let drawing = sheet(words, std::slice::from_ref(figure));
        write(args, &folder.join(name), kind, &drawing)?;
    }
    say(&format!("wrote {} plots into {}", figures.len(), folder.display()));
    Ok(Done::Well)
}

/// Longest name of a file, without number and ending.
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
    let name = path.display();
    for input in args.runs.iter().chain(&args.test) {
        refuse_input(path, input).map_err(|e| Failure::plain(e.to_string()))?;
    }
    let bytes = kind.encode(drawing, args.pixels).map_err(|e| Failure::plain(format!("{name} cannot be made: {e}")))?;
    let problem = |e: FileProblem| Failure::plain(e.to_string());
    let mut file = PartialFile::create(path, Existing::by(args.force)).map_err(problem)?;
    file.write_all(&bytes).map_err(|e| Failure::BrokeOff(format!("error: cannot write {name}: {e}")))?;
    file.publish().map_err(problem)?;
    Ok(())
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
