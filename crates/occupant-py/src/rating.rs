//! Ratings of runs and of values.

use std::path::PathBuf;

use crash_measures::injury::Options;
use crash_measures::rating::{RATINGS, Rating};
use occupant_jobs::base::{Failure, Units};
use occupant_jobs::measures::Judged;
use occupant_jobs::rated::bodies::{One, of_runs, rate_all};
use occupant_jobs::rated::{Answer, Values, rate_values, write};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::convert::json_of;
use crate::results::Given;
use crate::trouble::{failed, plain};
use crate::work::work;

/// Rates runs, or values alone, as `occupant measures --rating --json` prints it: points, stars, grades or a verdict.
/// `rating`: a name such as "euro-ncap-2026-full-width"; `runs`: Runs or result files; `places`: occupants of the rating,
/// one for all bodies or one for each; `values`: a table (CSV, XLSX) of criteria that no run measures; `path`: the values
/// in the layout of the template (CSV, XLSX, Parquet), replaced only with `force`. Blanks have their reasons.
#[pyfunction]
#[pyo3(signature = (rating, *runs, places=Vec::new(), values=None, path=None, force=false))]
pub(crate) fn rate(
    py: Python<'_>,
    rating: &str,
    runs: &Bound<'_, PyTuple>,
    places: Vec<String>,
    values: Option<PathBuf>,
    path: Option<PathBuf>,
    force: bool,
) -> PyResult<Py<PyAny>> {
    let rating = Rating::named(rating).ok_or_else(|| {
        let names: Vec<&str> = RATINGS.iter().map(|known| known.name).collect();
        plain(format!("rating {rating:?}; expected one of {}", names.join(", ")))
    })?;
    let file = values.as_ref().map(|file| file.display().to_string()).unwrap_or_default();
    let values = values.map(|file| Values::read(&file, rating)).transpose().map_err(failed)?;
    let rated = match (runs.is_empty(), values) {
        (true, None) => return Err(plain("no run and no values; expected at least one")),
        (true, Some(values)) => vec![of_values(rating, file, &places, &values).map_err(failed)?],
        (false, values) => {
            let opened = runs.iter().map(|run| Given::of(&run)?.results(py)).collect::<PyResult<Vec<_>>>()?;
            work(py, None, |interrupt| {
                let judged =
                    |results| Judged::of(results, None, Options::default(), Units::default(), interrupt.clone());
                let judged = opened.into_iter().map(judged).collect::<Result<Vec<_>, _>>()?;
                interrupt.refuse("nothing was rated")?;
                rate_all(rating, &places, values.as_ref(), &of_runs(&judged))
            })?
        }
    };
    if let Some(path) = path {
        let all: Vec<_> = rated.iter().map(|one| &one.rated).collect();
        write(&path, force, &all).map_err(failed)?;
    }
    json_of(&Answer::new(rating, rated.iter().map(One::told).collect()), py)
}

fn of_values(rating: &'static Rating, file: String, places: &[String], values: &Values) -> Result<One, Failure> {
    if !places.is_empty() {
        return Err(Failure::with_help(
            "places without runs",
            "leave them out: values name their occupants themselves",
        ));
    }
    let rated = rate_values(rating, values);
    if rated.tests.is_empty() {
        return Err(Failure::with_help(format!("{file} has no value"), "give at least one criterion"));
    }
    Ok(One { items: Vec::new(), file, occupant: String::new(), notes: Vec::new(), rated })
}
