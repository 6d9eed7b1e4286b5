//! What is made of runs: comparisons, reports, pictures and films.

use std::path::PathBuf;

use occupant_files::base::{ending, file_name, is_page, publish};
use occupant_files::history::{FAMILIES, Filter};
use occupant_files::measured::MapArgument;
use occupant_files::results::Results;
use occupant_files::scenario::Opened;
use occupant_jobs::base::{Failure, Units};
use occupant_jobs::compare::{PROTOCOLS, Request, Window, compare as rate};
use occupant_jobs::files::history::Treatment;
use occupant_jobs::report::{MOST_RUNS, page_judged};
use occupant_jobs::view::{
    Others, Picture, Solid, Target, Times, size as pixels, slow_motion as factor, times as parsed,
};
use occupant_pictures::film::Film;
use occupant_pictures::view::View;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use tempfile::TempDir;

use crate::convert::{json_of, one_of};
use crate::run::Run;
use crate::scenario::Scenario;
use crate::trouble::{failed, plain};
use crate::work::{Progress, SHOW, work};

/// A run, or a file.
pub(crate) enum Given<'py> {
    Run(Bound<'py, Run>),
    File(PathBuf),
}

impl<'py> Given<'py> {
    pub(crate) fn of(given: &Bound<'py, PyAny>) -> PyResult<Self> {
        match given.cast::<Run>() {
            Ok(run) => Ok(Given::Run(run.clone())),
            Err(_) => Ok(Given::File(given.extract()?)),
        }
    }

    /// Its file; that of a run in memory is written into `folder`, where `number` is of this one alone.
    fn file(&self, py: Python<'_>, folder: &TempDir, number: usize) -> PyResult<PathBuf> {
        match self {
            Given::File(path) => Ok(path.clone()),
            Given::Run(run) => {
                let (folder, run) = (folder.path().join(number.to_string()), run.get());
                std::fs::create_dir(&folder)?;
                py.detach(|| run.write_into(&folder)).map_err(failed)
            }
        }
    }

    pub(crate) fn results(&self, py: Python<'_>) -> PyResult<Results> {
        let opened = match self {
            Given::File(path) => py.detach(|| Results::open(path)),
            Given::Run(run) => {
                let run = run.get();
                py.detach(|| run.opened_again())
            }
        };
        opened.map_err(failed)
    }
}

/// Reads the result file (MCAP) at `path`, as written by `occupant run`, `Run.save` or a sweep.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<Run> {
    // an error of the operating system is one of Python's
    let bytes = py.detach(|| std::fs::read(&path))?;
    py.detach(|| Run::read(&path, bytes)).map_err(failed)
}

/// Rates how well a run matches a test or another run, as `occupant compare --json` prints it. `computed`: a Run or a
/// file; `measured`: a test (CSV, ISO-MME folder or .mme file), a Run or a result file. `channels`: names and patterns,
/// all that both have if empty; `maps`: assignments of columns, 'column[unit]=channel'; `seat`: position code in
/// ISO-MME names; `start`, `end`, `shift`, s; `filter`: "none", "j211" or a class such as "CFC180"; `coefficients`:
/// "iso6487" or "sae-j211"; `protocol`: also the validation by "far-side" or "frontal". A run that failed or lost its energy balance has no valid ratings: `worthless` gives the
/// reasons.
#[pyfunction]
#[pyo3(signature = (computed, measured, channels=Vec::new(), maps=Vec::new(), seat='1', start=None, end=None, shift=0.0,
    filter="none", coefficients="iso6487", protocol=None))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn compare(
    py: Python<'_>,
    computed: &Bound<'_, PyAny>,
    measured: &Bound<'_, PyAny>,
    channels: Vec<String>,
    maps: Vec<String>,
    seat: char,
    start: Option<f64>,
    end: Option<f64>,
    shift: f64,
    filter: &str,
    coefficients: &str,
    protocol: Option<&str>,
) -> PyResult<Py<PyAny>> {
    let protocol = protocol.map(|name| one_of("protocol", name, &PROTOCOLS)).transpose()?;
    let folder = tempfile::tempdir()?;
    let computed = Given::of(computed)?.file(py, &folder, 0)?;
    let measured = Given::of(measured)?.file(py, &folder, 1)?;
    let map = maps.iter().map(|text| text.parse()).collect::<Result<Vec<MapArgument>, _>>().map_err(plain)?;
    let filter: Filter = filter.parse().map_err(|expected| plain(format!("filter {filter:?}; {expected}")))?;
    for (name, value) in [("start", start), ("end", end), ("shift", Some(shift))] {
        if let Some(wrong) = value.filter(|s| !s.is_finite()) {
            return Err(plain(format!("{name} {wrong} s; expected a time")));
        }
    }
    let family = one_of("coefficients", coefficients, &FAMILIES)?;
    let treatment = Treatment { filter, family, interval_s: None };
    let comparison = work(py, None, |_| {
        rate(&Request {
            computed: &computed,
            measured: &measured,
            channels: &channels,
            map: &map,
            seat,
            window: Window { from_s: start, to_s: end, shift_s: shift },
            treatment,
            filter: treatment.words(),
            protocol,
        })
    })?;
    let answer = json_of(&comparison, py)?;
    answer.bind(py).set_item("worthless", &comparison.worthless)?;
    Ok(answer)
}

/// Writes the page of `occupant report` to `path`, NAME.html: one to four `runs` (Run or file) side by side, with 3-D
/// motion, histories and measures. `channels`: plots before the others; `verdict`: judges people too by limits made for
/// dummies. A page that exists is replaced only with `force`.
#[pyfunction]
#[pyo3(signature = (*runs, path, channels=Vec::new(), verdict=false, force=false))]
pub(crate) fn report(
    py: Python<'_>,
    runs: &Bound<'_, PyTuple>,
    path: PathBuf,
    channels: Vec<String>,
    verdict: bool,
    force: bool,
) -> PyResult<()> {
    if runs.is_empty() || runs.len() > MOST_RUNS {
        return Err(plain(format!("{} runs on one page; expected 1 to {MOST_RUNS}", runs.len())));
    }
    if !is_page(&path) {
        return Err(failed(Failure::ending(&path, ".html")));
    }
    let runs = runs.iter().map(|run| Given::of(&run)?.results(py)).collect::<PyResult<Vec<_>>>()?;
    let units = runs.first().map_or_else(Units::default, |run| Units::asked(None, run.loaded.scenario.units));
    work(py, None, |_| publish(&path, force, page_judged(&runs, &channels, units, verdict)?.as_bytes()))
}

/// What is drawn: a run or how a scenario starts.
enum Drawn {
    Run(Box<Results>),
    Start(Box<Opened>, String),
}

impl Drawn {
    fn of(source: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = source.py();
        let scenario = match source.cast::<Scenario>() {
            Ok(scenario) => scenario.borrow().clone(),
            Err(_) => match Given::of(source)? {
                Given::File(path) if ending(&path) != "mcap" => Scenario::open(&path)?,
                run => return Ok(Drawn::Run(Box::new(run.results(py)?))),
            },
        };
        let name = file_name(&scenario.text.path);
        Ok(Drawn::Start(Box::new(scenario.to_run(py)?), name))
    }

    fn path(&self) -> PathBuf {
        match self {
            Drawn::Run(results) => results.path.clone(),
            Drawn::Start(_, name) => PathBuf::from(name),
        }
    }
}

/// Draws and writes.
fn drawn(
    source: &Bound<'_, PyAny>,
    picture: &Picture,
    target: Target<'_>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    let (py, of) = (source.py(), Drawn::of(source)?);
    let progress = Progress::of(py, progress, "frames")?;
    work(py, progress, |interrupt| {
        picture.check(&of.path(), target)?;
        let bytes = match of {
            Drawn::Run(results) => picture.of_run(*results, target, (SHOW, interrupt))?,
            Drawn::Start(opened, name) => Some(picture.of_start(&opened, &name, target)?),
        };
        bytes.map_or(Ok(()), |bytes| publish(target.output, target.force, &bytes))
    })
}

/// The flags of a picture in three dimensions.
fn solid(
    py: Python<'_>,
    (solid, camera, size): (bool, &str, Option<[usize; 2]>),
    (ghosts, beside): (&[Bound<'_, PyAny>], Option<&Bound<'_, PyAny>>),
    folder: &TempDir,
) -> PyResult<Solid> {
    let size = size.map(|[width, height]| pixels(&format!("{width}x{height}")));
    let size = size.transpose().map_err(|expected| plain(format!("size: {expected}")))?;
    let file = |(number, given): (usize, &Bound<'_, PyAny>)| Given::of(given)?.file(py, folder, number);
    let ghosts: Vec<PathBuf> = ghosts.iter().enumerate().map(file).collect::<PyResult<_>>()?;
    let beside = beside.map(|given| file((ghosts.len(), given))).transpose()?;
    Ok(Solid { solid, camera: camera.to_owned(), size, others: Others { ghosts, beside } })
}

/// Views by name.
fn views(names: &[String]) -> PyResult<Vec<View>> {
    let all = [View::Side, View::Top, View::Front].map(|view| (view.name(), "", view));
    names.iter().map(|name| one_of("view", name, &all)).collect()
}

/// Times, s: numbers, or a text such as "0,40,80 ms".
fn times(given: Option<&Bound<'_, PyAny>>) -> PyResult<Option<Times>> {
    let Some(given) = given else { return Ok(None) };
    let times = match given.extract::<String>() {
        Ok(text) => parsed(&text),
        Err(_) => Times::of(given.try_iter()?.map(|time| time?.extract()).collect::<PyResult<_>>()?),
    };
    times.map(Some).map_err(|reason| plain(format!("times: {reason}")))
}

/// Draws a run at chosen times, or how a scenario starts, as `occupant view`: into `path`, NAME.svg or NAME.png.
/// `source`: a Run, a Scenario or a file. `times`, s, or a text such as "0,40,80 ms", every 40 ms if None; `views`: of
/// "side", "top" and "front", all if empty; `dimensions`: the main distances of the car. With `solid` in three
/// dimensions: `camera` "vehicle", "ground", "chase", "driver" or a TOML file, `size` in pixels, `ghosts` and `beside`:
/// other runs, or a folder of pictures of a test. A file that exists is replaced only with `force`.
#[pyfunction]
#[pyo3(signature = (source, path, times=None, views=Vec::new(), dimensions=false, solid=false, camera="vehicle",
    size=None,
    ghosts=Vec::new(), beside=None, force=false))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn view(
    source: &Bound<'_, PyAny>,
    path: PathBuf,
    times: Option<&Bound<'_, PyAny>>,
    views: Vec<String>,
    dimensions: bool,
    solid: bool,
    camera: &str,
    size: Option<[usize; 2]>,
    ghosts: Vec<Bound<'_, PyAny>>,
    beside: Option<&Bound<'_, PyAny>>,
    force: bool,
) -> PyResult<()> {
    let folder = tempfile::tempdir()?;
    if Film::of(&path).is_some() {
        return Err(failed(Failure::ending(&path, ".svg or .png; `film` makes films")));
    }
    let picture = Picture {
        times: self::times(times)?,
        views: self::views(&views)?,
        dimensions,
        slow_motion: SLOW_MOTION,
        freeze: None,
        solid: self::solid(source.py(), (solid, camera, size), (&ghosts, beside), &folder)?,
    };
    drawn(source, &picture, Target { output: &path, each: None, force }, None)
}

/// How many times slower than real time a film plays, as the command has it.
const SLOW_MOTION: f64 = 20.0;

/// Makes a film of a run, as `occupant view`: into `path`, NAME.gif or NAME.mp4 (which needs ffmpeg), or a folder that
/// gets each frame as a PNG file. `source`: a Run or a result file. It plays `slow_motion` times slower than real time
/// and stops for two seconds at `freeze`, s. `views`: the side view if empty; `solid`, `camera`, `size`, `ghosts`,
/// `beside` and `force` as of `view`. `progress`: True for a bar of tqdm, or a function of the number of frames done
/// and of all.
#[pyfunction]
#[pyo3(signature = (source, path, slow_motion=SLOW_MOTION, freeze=None, views=Vec::new(), solid=false,
    camera="vehicle", size=None,
    ghosts=Vec::new(), beside=None, force=false, progress=None))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn film(
    source: &Bound<'_, PyAny>,
    path: PathBuf,
    slow_motion: f64,
    freeze: Option<f64>,
    views: Vec<String>,
    solid: bool,
    camera: &str,
    size: Option<[usize; 2]>,
    ghosts: Vec<Bound<'_, PyAny>>,
    beside: Option<&Bound<'_, PyAny>>,
    force: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    let folder = tempfile::tempdir()?;
    let is_folder = path.extension().is_none();
    if !is_folder && Film::of(&path).is_none() {
        return Err(failed(Failure::ending(&path, ".gif or .mp4, or none for a folder of frames")));
    }
    let refused = |name: &str, reason: String| plain(format!("{name}: {reason}"));
    let picture = Picture {
        times: None,
        views: self::views(&views)?,
        dimensions: false,
        slow_motion: factor(&slow_motion.to_string()).map_err(|reason| refused("slow_motion", reason))?,
        freeze,
        solid: self::solid(source.py(), (solid, camera, size), (&ghosts, beside), &folder)?,
    };
    drawn(source, &picture, Target { output: &path, each: is_folder.then_some(&path), force }, progress)
}
