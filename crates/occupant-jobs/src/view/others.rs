//! Other runs, and pictures of a test, in the pictures of a run.

use std::path::{Path, PathBuf};

use occupant_files::base::{input_file, output_file::refuse_input, sha256};
use occupant_files::results::{Results, nearest};
use occupant_pictures::body::Snapshot;
use occupant_pictures::film::Frame;
use occupant_pictures::scene::{MOST_GHOSTS, Photograph, Shown, photograph};

use super::{moments, origin};
use crate::base::{Failure, ending, file_name, note};

/// How much later than asked for a picture of a test may be and still count, s: less than a name can tell.
const ALIKE_S: f64 = 1e-9;
/// Words before what `--set` changed in a title.
const CHANGED: &str = ", with ";

/// Flags of what else is shown.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
pub struct Others {
    /// Draw another run translucent in the same picture, at the times of the first; up to three times. Cameras that ride
    /// with the vehicle show each run in axes of its own vehicle, others where it is in space. Needs --3d
    #[cfg_attr(feature = "clap", arg(long = "ghost", value_name = "OTHER.mcap"))]
    pub ghosts: Vec<PathBuf>,

    /// Show another run beside the first, at the same times and to the same scale; or pictures of a real test: a folder of
    /// PNG files named by their times in ms, such as 0.png and 120.5.png, or one PNG file. Needs --3d
    #[cfg_attr(feature = "clap", arg(long, value_name = "OTHER.mcap|FOLDER|FILE.png"))]
    pub beside: Option<PathBuf>,
}

/// A run with what it shows on each picture, and the times of the pictures, s.
pub(super) struct Run {
    pub(super) results: Results,
    pub(super) moments: Vec<Snapshot>,
    pub(super) clock_s: Vec<f64>,
}

/// What else is shown.
pub(super) struct Opened {
    pub(super) ghosts: Vec<Run>,
    pub(super) beside: Option<Beside>,
}

/// What is on the right half.
pub(super) enum Beside {
    Run(Box<Run>),
    Test(Test),
}

impl Others {
    /// Refuses flags without what they need, and an output that would replace an input.
    pub(super) fn check(&self, is_solid: bool, output: &Path, folder: Option<&Path>) -> Result<(), Failure> {
        let flag = if self.ghosts.is_empty() { self.beside.as_ref().map(|_| "--beside") } else { Some("--ghost") };
        if let (Some(flag), false) = (flag, is_solid) {
            return Err(Failure::with_help(format!("{flag} needs a picture in three dimensions"), "add --3d"));
        }
        if self.ghosts.len() > MOST_GHOSTS {
            let found =
                format!("--ghost is given {} times; at most {MOST_GHOSTS} can be told apart", self.ghosts.len());
            return Err(Failure::with_help(found, "give fewer, or make several pictures"));
        }
        for input in self.ghosts.iter().chain(&self.beside) {
            folder.map_or_else(|| refuse_input(output, input), |_| Ok(()))?;
        }
        let home = |path: &'_ Path| match (path.is_dir(), folder) {
            (true, _) => Some(path.to_owned()),
            (false, Some(_)) if ending(path) == "png" => path.parent().map(Path::to_owned),
            _ => None,
        };
        let pictures = self.beside.as_deref().and_then(home).map(here);
        let into = folder.or(output.parent()).map(Path::to_owned).map(here);
        let place = into.and_then(|own| own.canonicalize().ok());
        match pictures {
            Some(own) if place.is_some() && own.canonicalize().ok() == place => Err(Failure::with_help(
                format!("{} is the folder of the pictures of the test, and would get pictures of a run", own.display()),
                "write into another folder",
            )),
            _ => Ok(()),
        }
    }

    /// Reads them, for pictures of the run at its own times.
    pub(super) fn open(&self, times_s: &[f64]) -> Result<Opened, Failure> {
        let ghosts: Result<Vec<Run>, Failure> = self.ghosts.iter().map(|path| Run::open(path, times_s)).collect();
        let beside = self.beside.as_deref().map(|path| Beside::open(path, times_s)).transpose()?;
        Ok(Opened { ghosts: ghosts?, beside })
    }
}

impl Run {
    /// A run at the outputs nearest to some times; before its first and after its last one it stands still.
    fn open(path: &Path, times_s: &[f64]) -> Result<Self, Failure> {
        let results = Results::open(path)?;
        results.notes().iter().chain(&results.doubt()).for_each(note);
        let outputs: Vec<f64> = results.checkpoints.iter().map(|c| c.time_s).collect();
        let wanted: Vec<usize> = times_s.iter().map(|time_s| nearest(&outputs, *time_s)).collect();
        let moments = moments(&results, &wanted)?;
        Ok(Run { results, moments, clock_s: times_s.to_owned() })
    }

    /// With what is to be known of it: after its name, how it differs from another run.
    pub(super) fn shown(&self, role: &str, than: Option<&Run>) -> Shown<'_> {
        let own = &self.results;
        let differs = than.map_or_else(String::new, |than| apart(title(own), title(&than.results)));
        let first = role.to_owned() + &origin(own, &differs);
        let caption = std::iter::once(first).chain(own.notes()).chain(own.doubt()).collect();
        Shown { model: &own.model, moments: &self.moments, clock_s: &self.clock_s, caption }
    }
}

/// A folder; of a name alone this one.
fn here(folder: PathBuf) -> PathBuf {
    if folder == Path::new("") { PathBuf::from(".") } else { folder }
}

fn title(results: &Results) -> &str {
    &results.model.setup().title
}

/// What a title says that another does not: all of another case, of the same one what was changed.
fn apart(own: &str, other: &str) -> String {
    let parts = |title: &'_ str| -> (String, String) {
        let (case, changed) = title.split_once(CHANGED).unwrap_or((title, ""));
        (case.to_owned(), changed.to_owned())
    };
    match (parts(own), parts(other).0) {
        ((case, changed), same) if case == same && changed.is_empty() => String::new(),
        ((case, changed), same) if case == same => format!(": {changed}"),
        _ => format!(": {own}"),
    }
}

impl Beside {
    fn open(path: &Path, times_s: &[f64]) -> Result<Self, Failure> {
        if path.is_dir() || ending(path) == "png" {
            return Test::open(path).map(Beside::Test);
        }
        if ["gif", "mp4", "avi", "mov", "jpg", "jpeg", "bmp", "tif", "tiff", "webm", "mkv"]
            .contains(&ending(path).as_str())
        {
            let help = "give a folder of PNG files named by their times in ms, such as 0.png and 120.5.png";
            return Err(Failure::with_help(format!("{} is neither a run nor a PNG file", path.display()), help));
        }
        Ok(Beside::Run(Box::new(Run::open(path, times_s)?)))
    }
}

/// Pictures of a real test, in the order of their times.
pub(super) struct Test {
    path: PathBuf,
    pictures: Vec<(Option<f64>, PathBuf)>,
}

impl Test {
    fn open(path: &Path) -> Result<Self, Failure> {
        let unread = |error| Failure::plain(format!("{} cannot be read: {error}", path.display()));
        let mut pictures = if path.is_dir() {
            let all = input_file::entries(path).map_err(unread)?;
            let is_picture = |own: &PathBuf| ending(own) == "png" && !file_name(own).starts_with('.');
            all.into_iter()
                .filter(is_picture)
                .map(|own| Ok((Some(time_s(&own)?), own)))
                .collect::<Result<Vec<_>, Failure>>()?
        } else {
            std::fs::metadata(path).map_err(unread)?;
            vec![(time_s(path).ok(), path.to_owned())]
        };
        if pictures.is_empty() {
            return Err(Failure::with_help(format!("{} holds no PNG file", path.display()), NAMED));
        }
        pictures.sort_by(|a: &(Option<f64>, PathBuf), b| a.0.unwrap_or(0.0).total_cmp(&b.0.unwrap_or(0.0)));
        if let Some(two) = pictures.windows(2).find(|two| two[0].0 == two[1].0) {
            let found = format!("{} and {} have the same time", two[0].1.display(), two[1].1.display());
            return Err(Failure::with_help(found, "leave one picture for each time"));
        }
        Ok(Test { path: path.to_owned(), pictures })
    }

    /// The half of a frame at a time of the run.
    pub(super) fn frame(&self, time_s: f64, size: [usize; 2]) -> Result<Frame, String> {
        let past = self.pictures.partition_point(|own| own.0.is_none_or(|own| own <= time_s + ALIKE_S));
        let shown = past.checked_sub(1).map(|last| &self.pictures[last]);
        let title = format!("Test: {}", file_name(&self.path));
        let place = |path: &Path, reason: String| format!("{}: {reason}", path.display());
        let Some((own_s, path)) = shown else {
            let caption = format!("{}, {} pictures", file_name(&self.path), self.pictures.len());
            let own = Photograph { png: None, title: &title, about: CHOSEN, time_s, caption: &caption };
            return photograph(&own, size);
        };
        let bytes = input_file::bytes(path).map_err(|error| place(path, format!("it cannot be read: {error}")))?;
        let caption = format!("{} (SHA-256 {}…)", file_name(path), &sha256(&bytes)[..12]);
        let png = Some((&bytes[..], *own_s));
        let own = Photograph { png, title: &title, about: CHOSEN, time_s, caption: &caption };
        photograph(&own, size).map_err(|reason| place(path, reason))
    }
}

const CHOSEN: &str = "the last picture at or before this time";
const NAMED: &str = "name PNG files by their times in ms, such as 0.png, 4.png and 120.5.png";

/// The time that a picture's name tells, s.
fn time_s(path: &Path) -> Result<f64, Failure> {
    let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    let time = name.parse::<f64>().ok().filter(|time_ms| time_ms.is_finite());
    time.map(|time_ms| time_ms * 1e-3)
        .ok_or_else(|| Failure::with_help(format!("{}: `{name}` is no time in ms", path.display()), NAMED))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_legend_tells_what_titles_do_not_share() {
        assert_eq!(apart("A, with x = 1", "A"), ": x = 1");
        assert_eq!(apart("A, with x = 1", "A, with x = 2"), ": x = 1");
        assert_eq!(apart("A", "A, with x = 2"), "");
        assert_eq!(apart("B, with x = 1", "A, with x = 1"), ": B, with x = 1");
    }

    #[test]
    fn names_of_pictures_are_times_in_milliseconds() {
        let close = |name: &str, expected: f64| (time_s(Path::new(name)).unwrap() - expected).abs() < 1e-12;
        assert!(close("a/120.5.png", 0.1205) && close("-4.png", -0.004) && close("0010.PNG", 0.01));
        for wrong in ["a.png", "nan.png", "inf.png", "1,5.png", "1e999.png", ".png", "4 ms.png"] {
            assert!(time_s(Path::new(wrong)).is_err(), "{wrong}");
        }
    }
}
