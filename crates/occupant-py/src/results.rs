//! What is made of runs: comparisons and reports.

use std::path::PathBuf;

use occupant_files::base::{is_page, publish};
use occupant_files::history::{FAMILIES, Filter};
use occupant_files::measured::MapArgument;
use occupant_files::results::Results;
use occupant_jobs::base::{Failure, Units};
use occupant_jobs::compare::{Request, Window, compare as rate};
use occupant_jobs::files::history::Treatment;
use occupant_jobs::report::{MOST_RUNS, page_judged};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use tempfile::TempDir;

use crate::convert::{json_of, one_of};
use crate::run::Run;
use crate::trouble::{failed, plain};
use crate::work::work;

/// A run, or a file.
enum Given<'py> {
    Run(Bound<'py, Run>),
    File(PathBuf),
}

impl<'py> Given<'py> {
    fn of(given: &Bound<'py, PyAny>) -> PyResult<Self> {
        match given.cast::<Run>() {
            Ok(run) => Ok(Given::Run(run.clone())),
            Err(_) => Ok(Given::File(given.extract()?)),
        }
    }

    /// Its file; that of a run in memory is written into `folder` under this name.
    fn file(&self, py: Python<'_>, folder: &TempDir, name: &str) -> PyResult<PathBuf> {
        match self {
            Given::File(path) => Ok(path.clone()),
            Given::Run(run) => {
                let (path, run) = (folder.path().join(name), run.get());
                py.detach(|| run.write(&path, true)).map_err(failed)?;
                Ok(path)
            }
        }
    }

    fn results(&self, py: Python<'_>) -> PyResult<Results> {
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

/// Reads a result file (MCAP) as written by `occupant run`, `Run.save` or a sweep.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<Run> {
    // an error of the operating system is one of Python's
    let bytes = py.detach(|| std::fs::read(&path))?;
    py.detach(|| Run::read(&path, bytes)).map_err(failed)
}

/// Rates how well a run matches a test or another run, as `occupant compare --json` prints it. `computed`: a Run or a file; `measured`:
/// a test (CSV, ISO-MME folder or .mme file), a Run or a result file. `channels`: names and patterns, all that both have if
/// empty; `maps`: assignments of columns, 'column[unit]=channel'; `seat`: position code in ISO-MME names; `start`, `end`, `shift`, s;
/// `filter`: "none", "j211" or a class such as "CFC180"; `coefficients`: "iso6487" or "sae-j211". A run
/// that failed or lost its energy balance has no valid ratings: `worthless` gives the reasons.
#[pyfunction]
#[pyo3(signature = (computed, measured, channels=Vec::new(), maps=Vec::new(), seat='1', start=None, end=None, shift=0.0,
    filter="none", coefficients="iso6487"))]
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
) -> PyResult<Py<PyAny>> {
    let folder = tempfile::tempdir()?;
    let computed = Given::of(computed)?.file(py, &folder, "computed.mcap")?;
    let measured = Given::of(measured)?.file(py, &folder, "measured.mcap")?;
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
        })
    })?;
    let answer = json_of(&comparison, py)?;
    answer.bind(py).set_item("worthless", &comparison.worthless)?;
    Ok(answer)
}

/// Writes the page of `occupant report`: one to four runs (Run or file) side by side, with 3-D motion, histories and measures. `channels`:
/// plots before the others; `verdict`: judges people too by limits made for dummies. One that exists only with `force`.
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
