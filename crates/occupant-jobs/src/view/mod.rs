//! Pictures and films of a run, and pictures of how a scenario starts.

use std::fs;
use std::path::Path;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use occupant_core::diagnosis::clearances;
use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::run::simulate::attempt;
use rayon::prelude::*;

mod others;
mod solid;

use crate::base::{Failure, Interrupt, Show, file_name, note, publish, refuse_input, say};
use crate::files::history::seconds;
use crate::files::scenario::Opened;
use occupant_files::results::{Results, nearest};
use occupant_pictures::Format;
use occupant_pictures::body::Snapshot;
use occupant_pictures::film::{Draw, FRAMES_A_SECOND, Film, Frame};
use occupant_pictures::scene::sheet;
use occupant_pictures::view::{Measured, Strip, View, draw, frames};
use occupant_scenario::{Loaded, Size};
use others::Run;

pub use others::Others;
pub use solid::{PixelSize, Solid, size};

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
/// All views, in their order.
const ALL: [View; 3] = [View::Side, View::Top, View::Front];

/// What is drawn of a run, and how.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
pub struct Picture {
    /// Times to draw, such as "0,40,80 ms" or "0.5 s"; seconds if no unit follows. The output nearest to each time is
    /// drawn. Every 40 ms if absent, less often in a long run
    #[cfg_attr(feature = "clap", arg(long, value_name = "TIMES", allow_hyphen_values = true, value_parser = times))]
    pub times: Option<Times>,

    /// Views to draw, in this order; all if absent. A film shows the side view if absent
    #[cfg_attr(feature = "clap", arg(long, value_name = "VIEWS", value_enum, value_delimiter = ','))]
    pub views: Vec<View>,

    /// Draw the main distances of the car with their SAE names, in mm, in the initial position
    #[cfg_attr(feature = "clap", arg(long))]
    pub dimensions: bool,

    /// How many times slower than real time a film plays
    #[cfg_attr(feature = "clap", arg(long, value_name = "TIMES", default_value = "20", value_parser = slow_motion))]
    pub slow_motion: f64,

    /// Stop a film for two seconds at this time, such as "80 ms"
    #[cfg_attr(feature = "clap", arg(long, value_name = "TIME", allow_hyphen_values = true, value_parser = seconds))]
    pub freeze: Option<f64>,

    /// What is in three dimensions.
    #[cfg_attr(feature = "clap", command(flatten))]
    pub solid: Solid,
}

/// Where pictures go.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    /// The file, whose extension is that of a picture or a film.
    pub output: &'a Path,
    /// The folder for the frames of a film as PNG files instead.
    pub each: Option<&'a Path>,
    /// Whether existing frames are replaced.
    pub force: bool,
}

impl Target<'_> {
    fn kind(self) -> Result<Kind, Failure> {
        if self.each.is_some() { Ok(Kind::Frames) } else { Kind::of(self.output) }
    }
}

impl Picture {
    /// Refuses what does not fit together, and an output that would replace the input.
    ///
    /// # Errors
    /// The flags that do not.
    pub fn check(&self, input: &Path, target: Target<'_>) -> Result<(), Failure> {
        let kind = target.kind()?;
        refuse_input(target.output, input)?;
        self.solid.others.check(self.solid.is_asked(), target.output, target.each)?;
        if self.solid.is_asked() && matches!(kind, Kind::Picture(Format::Svg)) {
            let expected = ".png, .gif or .mp4, as a picture in three dimensions is made of pixels";
            return Err(Failure::ending(target.output, expected));
        }
        Ok(())
    }

    /// Draws a run: the bytes of the output, or none if the frames were written into their folder.
    ///
    /// # Errors
    /// Times outside the run; a picture that cannot be drawn; a frame that cannot be written; interrupted.
    pub fn of_run(
        &self,
        results: Results,
        target: Target<'_>,
        (show, interrupt): (Show, &Interrupt),
    ) -> Result<Option<Vec<u8>>, Failure> {
        let kind = target.kind()?;
        results.notes().iter().chain(&results.doubt()).for_each(note);
        let span_s = span_s(&results);
        let wanted = match (&self.times, kind) {
            (Some(times), _) => times.0.clone(),
            (None, Kind::Picture(_)) => regular(span_s),
            (None, Kind::Film(_) | Kind::Frames) => frames_s(span_s, self.slow_motion)?,
        };
        let wanted = match self.freeze {
            Some(stop_s) => frozen(wanted, stop_s, span_s, kind)?,
            None => wanted,
        };
        let moments = moments(&results, &outputs(&results, &wanted)?)?;
        let pace = self.pace(kind);
        let made = Made { kind, target, show, interrupt };
        if self.solid.is_asked() {
            let clock_s: Vec<f64> = moments.iter().map(|moment| moment.time_s).collect();
            let others = self.solid.others.open(&clock_s)?;
            let run = Run { results, moments, clock_s };
            let one = self.solid.scene(&run, &others, &pace, kind)?;
            return made.frames(run.moments.len(), &one);
        }
        let origin = origin(&results, "") + &pace;
        let dimensions = if self.dimensions { lines(&results.loaded, &results.model, false) } else { Vec::new() };
        let strip = Strip { model: &results.model, moments, views: self.views(kind), origin, dimensions };
        if let Kind::Picture(format) = kind {
            return picture(&strip, format).map(Some);
        }
        let one = frames(&strip);
        made.frames(strip.moments.len(), &|frame| Ok(Frame::Drawing(one(frame))))
    }

    /// Draws how a scenario, called `name`, starts.
    ///
    /// # Errors
    /// A film, times or three dimensions, which need a run; a picture that cannot be drawn.
    pub fn of_start(&self, opened: &Opened, name: &str, target: Target<'_>) -> Result<Vec<u8>, Failure> {
        let format = self.of_scenario(target)?;
        let mut first = First(None);
        let run = attempt(&opened.model, &mut first);
        let moments: Vec<Snapshot> = first.0.into_iter().collect();
        if let (true, Err(error)) = (moments.is_empty(), run) {
            return Err(Failure::BrokeOff(format!("error: {error}")));
        }
        let origin = format!("{name}, before a run");
        let dimensions = if self.dimensions { lines(&opened.loaded, &opened.model, true) } else { Vec::new() };
        let views = self.views(Kind::Picture(format));
        picture(&Strip { model: &opened.model, moments, views, origin, dimensions }, format)
    }

    /// Refuses what needs a run.
    ///
    /// # Errors
    /// A film, times or three dimensions.
    pub fn of_scenario(&self, target: Target<'_>) -> Result<Format, Failure> {
        if self.solid.is_asked() {
            return Err(Failure::with_help("--3d needs a run, and this is a scenario", "run it first"));
        }
        let Kind::Picture(format) = target.kind()? else {
            let help = "run it first, and make the film from its .mcap";
            return Err(Failure::with_help("a film needs a run, and this is a scenario", help));
        };
        if self.times.is_some() {
            let help = "leave --times out, or run it first";
            return Err(Failure::with_help("--times needs a run, and this is a scenario", help));
        }
        Ok(format)
    }

    /// Playback speed of a film, as text.
    fn pace(&self, kind: Kind) -> String {
        match (&self.times, kind) {
            (None, Kind::Film(_) | Kind::Frames) => format!(", {} times slower than real time", self.slow_motion),
            _ => String::new(),
        }
    }

    /// The requested views, each once.
    fn views(&self, kind: Kind) -> Vec<View> {
        let all: &[View] = match kind {
            Kind::Film(_) | Kind::Frames => &[View::Side],
            Kind::Picture(_) => &ALL,
        };
        let asked = if self.views.is_empty() { all } else { &self.views };
        let mut views = Vec::new();
        for view in asked {
            if !views.contains(view) {
                views.push(*view);
            }
        }
        views
    }
}

/// Kind of output.
#[derive(Clone, Copy)]
enum Kind {
    Picture(Format),
    Film(Film),
    Frames,
}

impl Kind {
    fn of(output: &Path) -> Result<Self, Failure> {
        let kind = Format::of(output).map(Kind::Picture).or_else(|| Film::of(output).map(Kind::Film));
        kind.ok_or_else(|| Failure::ending(output, ".svg, .png, .gif or .mp4"))
    }
}

/// A film, or frames, or a picture of pixels in the making.
struct Made<'a> {
    kind: Kind,
    target: Target<'a>,
    show: Show,
    interrupt: &'a Interrupt,
}

impl Made<'_> {
    fn frames(&self, count: usize, draw: Draw<'_>) -> Result<Option<Vec<u8>>, Failure> {
        let (bar, done, undrawn) = (self.show.bar(count as u64, "frames"), AtomicU64::new(0), OnceLock::new());
        let one = |frame| {
            if self.interrupt.is_asked() {
                return Err("interrupted".to_owned());
            }
            let drawing = draw(frame);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            // a film may draw a frame twice
            bar.iter().for_each(|bar| bar.set_position(done.min(count as u64)));
            drawing.inspect_err(|reason| drop(undrawn.set(reason.clone())))
        };
        // a frame that cannot be drawn is mended otherwise than a film that cannot be written
        let failed = |reason: String, help: &str| match undrawn.get() {
            Some(reason) => Failure::plain(reason),
            None => Failure::with_help(reason, help),
        };
        let bytes = match self.kind {
            Kind::Picture(_) => {
                let all: Result<Vec<_>, _> = (0..count).map(one).collect();
                sheet(all.map_err(Failure::plain)?).map_err(|e| Failure::with_help(e, "draw fewer times"))?
            }
            Kind::Film(film) => {
                let help = "write a .gif; for a shorter film use --times or a smaller --slow-motion";
                film.encode(count, &one).map_err(|e| failed(e, help))?
            }
            Kind::Frames => return self.each(count, &one).map(|()| None),
        };
        bar.iter().for_each(|bar| bar.clear());
        Ok(Some(bytes))
    }

    /// Writes each frame as a picture.
    fn each(&self, count: usize, draw: Draw<'_>) -> Result<(), Failure> {
        let Some(folder) = self.target.each else { return Ok(()) };
        fs::create_dir_all(folder).map_err(|e| Failure::plain(format!("{} cannot be made: {e}", folder.display())))?;
        (0..count).into_par_iter().try_for_each(|frame| {
            let picture = draw(frame).and_then(|drawing| drawing.png(PIXELS)).map_err(Failure::plain)?;
            publish(&folder.join(format!("{:04}.png", frame + 1)), self.target.force, &picture)
        })?;
        say(&format!("wrote {count} frames into {}", folder.display()));
        Ok(())
    }
}

fn picture(strip: &Strip<'_>, format: Format) -> Result<Vec<u8>, Failure> {
    format.encode(&draw(strip), PIXELS).map_err(|e| Failure::with_help(e, "draw fewer times"))
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

/// Keeps the first output of a run and stops it.
struct First(Option<Snapshot>);

impl Recorder for First {
    fn record(&mut self, sample: &Sample<'_>) -> Result<Flow, RecorderError> {
        self.0 = Some(Snapshot::of(sample));
        Ok(Flow::Stop)
    }
}

/// Slow-motion factor.
///
/// # Errors
/// No number, or one out of range.
pub fn slow_motion(text: &str) -> Result<f64, String> {
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
pub struct Times(Vec<f64>);

impl Times {
    /// These times.
    ///
    /// # Errors
    /// More than fit on a sheet, or one that is not finite.
    pub fn of(times_s: Vec<f64>) -> Result<Self, String> {
        if times_s.len() > MOST {
            return Err(format!("{} pictures; at most {MOST} fit on a sheet", times_s.len()));
        }
        match times_s.iter().find(|time| !time.is_finite()) {
            Some(wrong) => Err(format!("{wrong} s is not a time; expected a finite time")),
            None => Ok(Times(times_s)),
        }
    }
}

/// Parses a list from its end, as a time without a unit takes that of the next one.
///
/// # Errors
/// What is not a time.
pub fn times(list: &str) -> Result<Times, String> {
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
    times.reverse();
    Times::of(times)
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
