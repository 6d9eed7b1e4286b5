//! `occupant view`.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use clap::ValueEnum;
use occupant_core::diagnosis::clearances;
use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::attempt;
use rayon::prelude::*;

mod others;
mod solid;

use super::flags::history::seconds;
use crate::base::progress::{bar, counted};
use crate::base::{Failure, deliver_and, ending, file_name, note, publish, refuse_input, say, with_word};
use occupant_files::results::{Results, nearest};
use occupant_jobs::files::scenario::{self, ScenarioArgs, warn_of};
use occupant_pictures::Format;
use occupant_pictures::body::Snapshot;
use occupant_pictures::film::{Draw, FRAMES_A_SECOND, Film, Frame};
use occupant_pictures::scene::sheet;
use occupant_pictures::view::{Measured, Strip, View, draw, frames};
use occupant_scenario::{Loaded, Size};
use others::Run;
use solid::Solid;

/// Pixels of a PNG per drawing unit.
const PIXELS: f64 = 2.0;
/// Interval of the pictures without `--times`, ms.
const EVERY_MS: f64 = 40.0;
/// Largest number of pictures without `--times`.
const MOST_BY_DEFAULT: usize = 12;
/// Largest number with `--times`.
const MOST: usize = 120;
/// How long a film stops, s.
const FROZEN_S: usize = 2;
/// Largest number of frames of a film.
const MOST_FRAMES: usize = 3000;

/// Draw a run at chosen times, or as a film; draw how a scenario starts
///
/// A run becomes a strip: one column per time, one row per view (side, top, front), all to one scale. Arrows are contact
/// forces on the body. A scenario that has not been run is drawn as it starts. Positions are in vehicle axes.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The results of `occupant run`, or a scenario
    #[arg(value_name = "RUN.mcap|SCENARIO")]
    input: PathBuf,

    /// The picture, NAME.svg or NAME.png, or the film, NAME.gif or NAME.mp4 (needs ffmpeg); NAME-view.svg beside the input
    /// if absent, NAME-view.png with --3d
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Write each frame of the film as a PNG file into this folder
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["output", "open"])]
    each: Option<PathBuf>,

    /// Replace existing files
    #[arg(short, long)]
    force: bool,

    /// Open the file with the system's default program
    #[arg(long)]
    open: bool,

    /// Times to draw, such as "0,40,80 ms" or "0.5 s"; seconds if no unit follows. The output nearest to each time is
    /// drawn. Every 40 ms if absent, less often in a long run
    #[arg(long, value_name = "TIMES", allow_hyphen_values = true, value_parser = times)]
    times: Option<Times>,

    /// Views to draw, in this order; all if absent. A film shows the side view if absent
    #[arg(long, value_name = "VIEWS", value_enum, value_delimiter = ',')]
    views: Vec<View>,

    /// Draw the main distances of the car with their SAE names, in mm, in the initial position
    #[arg(long)]
    dimensions: bool,

    /// How many times slower than real time a film plays
    #[arg(long, value_name = "TIMES", default_value = "20", value_parser = slow_motion)]
    slow_motion: f64,

    /// Stop a film for two seconds at this time, such as "80 ms"
    #[arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = seconds)]
    freeze: Option<f64>,

    #[command(flatten)]
    solid: Solid,

    /// Change a value of the scenario, such as --set body.preset=female05. May be repeated
    #[arg(long = "set", value_name = "PATH.TO.KEY=VALUE")]
    overrides: Vec<String>,
}

pub(crate) fn view(args: &Args) -> Result<(), Failure> {
    let usual = if args.solid.is_asked() { "png" } else { "svg" };
    let output = args.output.clone().unwrap_or_else(|| with_word(&args.input.with_extension(usual), "-view"));
    let kind = if args.each.is_some() { Kind::Frames } else { Kind::of(&output)? };
    refuse_input(&output, &args.input)?;
    args.solid.others.check(args.solid.is_asked(), &output, args.each.as_deref())?;
    if args.solid.is_asked() && matches!(kind, Kind::Picture(Format::Svg)) {
        return Err(Failure::ending(&output, ".png, .gif or .mp4, as a picture in three dimensions is made of pixels"));
    }
    if ending(&args.input) != "mcap" {
        if args.solid.is_asked() {
            return Err(Failure::with_help("--3d needs a run, and this is a scenario", "run it first"));
        }
        return seated(args, &output, kind);
    }
    if !args.overrides.is_empty() {
        return Err(Failure::with_help("--set changes a scenario, but this is a run", "run the scenario with --set"));
    }
    let results = Results::open(&args.input)?;
    results.notes().iter().chain(&results.doubt()).for_each(note);
    let span_s = span_s(&results);
    let wanted = match (&args.times, kind) {
        (Some(times), _) => times.0.clone(),
        (None, Kind::Picture(_)) => regular(span_s),
        (None, Kind::Film(_) | Kind::Frames) => frames_s(span_s, args.slow_motion)?,
    };
    let wanted = match args.freeze {
        Some(stop_s) => frozen(wanted, stop_s, span_s, kind)?,
        None => wanted,
    };
    let moments = moments(&results, &outputs(&results, &wanted)?)?;
    let pace = pace(args, kind);
    if args.solid.is_asked() {
        let clock_s: Vec<f64> = moments.iter().map(|moment| moment.time_s).collect();
        let others = args.solid.others.open(&clock_s)?;
        let run = Run { results, moments, clock_s };
        let one = args.solid.scene(&run, &others, &pace, kind)?;
        return deliver_frames(args, kind, &output, run.moments.len(), &one);
    }
    let origin = origin(&results, "") + &pace;
    let dimensions = if args.dimensions { lines(&results.loaded, &results.model, false) } else { Vec::new() };
    let strip = Strip { model: &results.model, moments, views: views(args, kind), origin, dimensions };
    if let Kind::Picture(format) = kind {
        return deliver_and(args.open, &output, args.force, &picture(&strip, format)?);
    }
    let one = frames(&strip);
    deliver_frames(args, kind, &output, strip.moments.len(), &|frame| Ok(Frame::Drawing(one(frame))))
}

/// Writes a film, or frames, or a picture of pixels.
fn deliver_frames(args: &Args, kind: Kind, output: &Path, count: usize, draw: Draw<'_>) -> Result<(), Failure> {
    let bar = bar(Some(count as u64), &counted("frames"), false);
    let undrawn = OnceLock::new();
    let one = |frame| {
        let drawing = draw(frame);
        bar.inc(1);
        drawing.inspect_err(|reason| drop(undrawn.set(reason.clone())))
    };
    // a frame that cannot be drawn is mended otherwise than a film that cannot be written
    let failed = |reason: String, help: &str| match undrawn.get() {
        Some(reason) => Failure::plain(reason),
        None => Failure::with_help(reason, help),
    };
    let bytes = match kind {
        Kind::Picture(_) => {
            let all: Result<Vec<_>, _> = (0..count).map(one).collect();
            sheet(all.map_err(Failure::plain)?).map_err(|e| Failure::with_help(e, "draw fewer times"))?
        }
        Kind::Film(film) => {
            let help = "write a .gif; for a shorter film use --times or a smaller --slow-motion";
            film.encode(count, &one).map_err(|e| failed(e, help))?
        }
        Kind::Frames => return write_each(args, count, &one),
    };
    bar.finish_and_clear();
    deliver_and(args.open, output, args.force, &bytes)
}

/// Playback speed of a film, as text.
fn pace(args: &Args, kind: Kind) -> String {
    match (&args.times, kind) {
        (None, Kind::Film(_) | Kind::Frames) => format!(", {} times slower than real time", args.slow_motion),
        _ => String::new(),
    }
}

/// Kind of output.
#[derive(Clone, Copy)]
enum Kind {
    Picture(Format),
    Film(Film),
    Frames,
}

/// Writes each frame as a picture.
fn write_each(args: &Args, count: usize, draw: Draw<'_>) -> Result<(), Failure> {
    let Some(folder) = &args.each else { return Ok(()) };
    fs::create_dir_all(folder).map_err(|e| Failure::plain(format!("{} cannot be made: {e}", folder.display())))?;
    (0..count).into_par_iter().try_for_each(|frame| {
        let picture = draw(frame).and_then(|drawing| drawing.png(PIXELS)).map_err(Failure::plain)?;
        publish(&folder.join(format!("{:04}.png", frame + 1)), args.force, &picture)
    })?;
    say(&format!("wrote {count} frames into {}", folder.display()));
    Ok(())
}

impl Kind {
    fn of(output: &Path) -> Result<Self, Failure> {
        let kind = Format::of(output).map(Kind::Picture).or_else(|| Film::of(output).map(Kind::Film));
        kind.ok_or_else(|| Failure::ending(output, ".svg, .png, .gif or .mp4"))
    }
}

fn picture(strip: &Strip<'_>, format: Format) -> Result<Vec<u8>, Failure> {
    format.encode(&draw(strip), PIXELS).map_err(|e| Failure::with_help(e, "draw fewer times"))
}

/// The requested views, each once.
fn views(args: &Args, kind: Kind) -> Vec<View> {
    let all: &[View] = match kind {
        Kind::Film(_) | Kind::Frames => &[View::Side],
        Kind::Picture(_) => View::value_variants(),
    };
    let asked = if args.views.is_empty() { all } else { &args.views };
    let mut views = Vec::new();
    for view in asked {
        if !views.contains(view) {
            views.push(*view);
        }
    }
    views
}

/// The distances drawn: those of the first vehicle's car, and the clearances in front of the body and above it.
///
/// A run contains its bodies without the stature that places seats and D-rings: `with_seats` says whether it is known.
fn lines(loaded: &Loaded, model: &Model, with_seats: bool) -> Vec<Measured> {
    let of_car = loaded
        .dimensions()
        .into_iter()
        .filter(|own| own.vehicle.is_none() && (with_seats || !own.name.starts_with("seats.")))
        .filter_map(|own| {
            let key = own.name.rsplit_once('.').map_or(own.name.as_str(), |(_, key)| key);
            let is_drawn =
                own.name.contains(".d_ring.") || own.name.ends_with(".recline") || !own.name.starts_with("seats.");
            let title = if own.name.contains(".d_ring.") {
                format!("D-ring {key}")
            } else if own.code.is_empty() || own.code.contains(' ') {
                own.name.replace('.', " ")
            } else {
                own.code.to_owned()
            };
            let label = match own.size {
                Size::Distance(m) if m > 0.0 => format!("{title} {:.0}", m * 1e3),
                Size::Distance(_) | Size::Force(_) | Size::Moment(_) | Size::Word(_) => return None,
                Size::Angle(rad) => format!("{title} {:.0}°", rad.to_degrees()),
            };
            is_drawn.then_some(Measured { label, ends_m: own.ends_m, is_angle: matches!(own.size, Size::Angle(_)) })
        });
    // knees are a pair
    let free = clearances(model).into_iter().filter(|own| !own.sphere.ends_with("right_knee")).map(|own| {
        let part = own.sphere.replace('_', " ");
        let label = format!("{part} to {} {:.0}", own.surface.replace('_', " "), own.distance_m * 1e3);
        Measured { label, ends_m: own.ends_m, is_angle: false }
    });
    of_car.chain(free).collect()
}

/// Draws the initial position of the body of a scenario.
fn seated(args: &Args, output: &Path, kind: Kind) -> Result<(), Failure> {
    let Kind::Picture(format) = kind else {
        let help = "run it first, and make the film from its .mcap";
        return Err(Failure::with_help("a film needs a run, and this is a scenario", help));
    };
    if args.times.is_some() {
        return Err(Failure::with_help(
            "--times needs a run, and this is a scenario",
            "leave --times out, or run it first",
        ));
    }
    let scenario = ScenarioArgs { scenario: args.input.clone(), overrides: args.overrides.clone() };
    let opened = scenario::open(&scenario)?;
    warn_of(&opened);
    let mut first = First(None);
    let run = attempt(&opened.model, &mut first);
    let moments: Vec<Snapshot> = first.0.into_iter().collect();
    if let (true, Err(error)) = (moments.is_empty(), run) {
        return Err(Failure::BrokeOff(format!("error: {error}")));
    }
    let origin = format!("{}, before a run", file_name(&args.input));
    let dimensions = if args.dimensions { lines(&opened.loaded, &opened.model, true) } else { Vec::new() };
    let strip = Strip { model: &opened.model, moments, views: views(args, kind), origin, dimensions };
    deliver_and(args.open, output, args.force, &picture(&strip, format)?)
}

/// Keeps the first output of a run and stops it.
struct First(Option<Snapshot>);

impl Recorder for First {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.0 = Some(Snapshot::of(sample));
        Ok(Flow::Stop)
    }
}

/// Slow-motion factor.
fn slow_motion(text: &str) -> Result<f64, String> {
    let factor = text.parse().ok().filter(|factor| (0.01..=1e4).contains(factor));
    factor.ok_or_else(|| "expected a number from 0.01 to 10000, such as 20".to_owned())
}

/// First and last time of the outputs, s.
fn span_s(results: &Results) -> [f64; 2] {
    let at = &results.checkpoints;
    [at[0].time_s, at[at.len() - 1].time_s]
}

/// The times of a film's frames, s.
fn frames_s([first_s, last_s]: [f64; 2], slow_motion: f64) -> Result<Vec<f64>, Failure> {
    let every_s = 1.0 / (f64::from(FRAMES_A_SECOND) * slow_motion);
    let count = ((last_s - first_s) / every_s + 1e-6).floor() as usize + 1;
    if count > MOST_FRAMES {
        return Err(Failure::with_help(
            format!("the film would have {count} frames; at most {MOST_FRAMES} are possible"),
            "give a smaller --slow-motion",
        ));
    }
    Ok((0..count).map(|i| first_s + i as f64 * every_s).collect())
}

/// The times of a film that stops at one of them.
///
/// # Errors
/// A picture, which does not move; a time outside the run.
fn frozen(mut times: Vec<f64>, stop_s: f64, span_s: [f64; 2], kind: Kind) -> Result<Vec<f64>, Failure> {
    if let Kind::Picture(_) = kind {
        let help = "write a .gif or .mp4, or --each FOLDER; for one moment use --times";
        return Err(Failure::with_help("--freeze stops a film, and this is a picture", help));
    }
    let [first_s, last_s] = span_s;
    if !(first_s..=last_s).contains(&stop_s) {
        let found = format!("--freeze {} ms is outside the run", 1e3 * stop_s);
        return Err(Failure::with_help(found, &format!("the run lasts from {} to {} ms", 1e3 * first_s, 1e3 * last_s)));
    }
    let at = times.partition_point(|time| *time < stop_s).min(times.len().saturating_sub(1));
    let held = times.get(at).copied();
    times.splice(at..at, held.into_iter().cycle().take(FROZEN_S * usize::from(FRAMES_A_SECOND)));
    Ok(times)
}

/// Times, s.
#[derive(Clone, Debug)]
struct Times(Vec<f64>);

/// Parses a list from its end, as a time without a unit takes that of the next one.
fn times(list: &str) -> Result<Times, String> {
    let mut unit = "s";
    let mut times = Vec::new();
    for entry in list.rsplit(',').map(str::trim) {
        let digits = entry.trim_end_matches(|c: char| c.is_alphabetic() || c == 'µ');
        let own = entry[digits.len()..].trim();
        let number = digits.trim();
        if !own.is_empty() && number.parse::<f64>().is_ok() {
            unit = own;
        }
        times.push(seconds(&format!("{number} {unit}")).map_err(|reason| format!("`{entry}` is {reason}"))?);
    }
    if times.len() > MOST {
        return Err(format!("{} pictures; at most {MOST} fit on a sheet", times.len()));
    }
    times.reverse();
    Ok(Times(times))
}

/// Indices of the outputs to draw, in order.
fn outputs(results: &Results, wanted: &[f64]) -> Result<Vec<usize>, Failure> {
    let at: Vec<f64> = results.checkpoints.iter().map(|c| c.time_s).collect();
    let [first, last] = span_s(results);
    let half_interval = 0.5 * results.model.setup().time.output_s * (1.0 + 1e-9);
    let index = |&time: &f64| {
        if time < first - half_interval || time > last + half_interval {
            return Err(Failure::with_help(
                format!("no output near {time} s: outputs cover {first} s to {last} s"),
                "choose --times within the run",
            ));
        }
        Ok(nearest(&at, time))
    };
    wanted.iter().map(index).collect()
}

/// Every 40 ms, or every 80, 200, 400, … in a long run.
fn regular([first_s, last_s]: [f64; 2]) -> Vec<f64> {
    let span_ms = (last_s - first_s) * 1e3;
    let mut every_ms = EVERY_MS;
    for factor in [2.0, 2.5, 2.0].into_iter().cycle() {
        if span_ms / every_ms + 1.0 <= MOST_BY_DEFAULT as f64 || !span_ms.is_finite() {
            break;
        }
        every_ms *= factor;
    }
    let count = (span_ms / every_ms + 1e-6).floor().max(0.0) as usize;
    let time = |i| first_s + i as f64 * every_ms * 1e-3;
    (0..=count).map(time).collect()
}

/// Snapshots of outputs, in the order asked for.
fn moments(results: &Results, outputs: &[usize]) -> Result<Vec<Snapshot>, Failure> {
    let mut seen = Vec::new();
    let mut output = 0;
    results.watch(|sample| {
        if outputs.contains(&output) {
            seen.push((output, Snapshot::of(sample)));
        }
        output += 1;
    })?;
    let find = |wanted: &usize| seen.iter().find(|(at, _)| at == wanted);
    Ok(outputs.iter().filter_map(find).map(|s| s.1.clone()).collect())
}

/// Caption: file, how it differs from others, its hash, program.
fn origin(results: &Results, differs: &str) -> String {
    let name = file_name(&results.path);
    let program = results.run.get("program").map_or("-", String::as_str);
    let state = if results.is_complete() { "" } else { ", a run that did not complete" };
    format!("{name}{differs} (SHA-256 {}…), run by {program}{state}", &results.sha256[..12])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_takes_the_unit_of_the_next() {
        let close = |list, expected: &[f64]| {
            let found = times(list).unwrap().0;
            assert_eq!(found.len(), expected.len(), "{list}");
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b).abs() < 1e-12, "{list}: {found:?}");
            }
        };
        close("0,40,80 ms", &[0.0, 0.04, 0.08]);
        close("0.1, 0.2", &[0.1, 0.2]);
        close("10ms,0.5 s", &[0.01, 0.5]);
        close("-5 ms", &[-0.005]);
        for wrong in ["", "now", "1 lbf", "1,,2", "inf", "1e400"] {
            assert!(times(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_long_run_gets_fewer_pictures() {
        let last = |v: &[f64]| v[v.len() - 1];
        let short = regular([0.0, 0.2]);
        assert_eq!(short.len(), 6);
        assert!((last(&short) - 0.2).abs() < 1e-12);
        let long = regular([0.0, 2.4]);
        assert_eq!(long.len(), 7);
        assert!((long[1] - 0.4).abs() < 1e-12);
        assert_eq!(regular([0.0, 0.0]), [0.0]);
    }
}
