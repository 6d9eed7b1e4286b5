//! Studies: many runs on all cores, as one table; fits and optimisations.

use std::path::{Path, PathBuf};

use occupant_core::model::Model;
use occupant_core::results::summary::Summarizer;
use occupant_files::base::{file_name, program, publish};
use occupant_files::measured::MapArgument;
use occupant_files::scenario::format_of;
use occupant_files::table::Cell;
use occupant_jobs::base::{Failure, Units};
use occupant_jobs::files::study_folder::{Block, Folder, NamedBy, Role, Row, Texts};
use occupant_jobs::fit::fitting::Fitting;
use occupant_jobs::fit::opening::Given;
use occupant_jobs::optimise::Optimising;
use occupant_jobs::search::Work;
use occupant_jobs::study::{Wanted, answer, page};
use occupant_jobs::sweep::Plan;
use occupant_jobs::sweep::job::Sweep;
use occupant_jobs::sweep::kept::chosen;
use occupant_jobs::sweep::plan::study_text;
use occupant_scenario::{Diagnostics, Draft};
use occupant_study::engine::{Finished, NotBegun, Source};
use occupant_study::{StudyText, Value};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyString, PyTuple};
use pythonize::{depythonize, pythonize};
use serde::Serialize;

use crate::batch::{Table, engine, many};
use crate::convert::{changes, json, json_of};
use crate::scenario::{Scenario, Text, named};
use crate::trouble::{failed, plain, refused};
use crate::work::{Progress, SHOW, work};

/// A study, as for `occupant sweep`: a scenario with varied values. A TOML or JSON file, or a dict of its keys.
#[pyclass(module = "occupant", frozen)]
pub(crate) struct Study {
    /// None of a study for a search alone, which has no design.
    plan: Option<Plan>,
    of: Origin,
}

/// What a study is read from.
struct Origin {
    /// Its file, which need not exist.
    path: PathBuf,
    /// Texts in the place of files.
    texts: Vec<(NamedBy, String, Vec<u8>)>,
    /// Changes that its base brings, which the study may change again.
    before: Vec<String>,
    /// Changes of all its runs.
    changes: Vec<String>,
}

impl Origin {
    fn texts(&self) -> Texts {
        let texts = Texts::of_files(&self.path);
        self.texts.iter().for_each(|(by, name, bytes)| texts.put(*by, name, bytes.clone()));
        texts
    }

    fn study(self) -> PyResult<Study> {
        match self.plan() {
            Ok(plan) => Ok(Study { plan: Some(plan), of: self }),
            Err(_) if self.is_search() => Ok(Study { plan: None, of: self }),
            Err(error) => Err(error),
        }
    }

    /// What the base brings may be changed again.
    fn plan(&self) -> PyResult<Plan> {
        self.opened(|| Plan::on(&self.before, &self.path, &self.changes, &self.texts(), program()))
    }

    /// The same for a folder, which has one list of changes.
    fn kept_plan(&self) -> PyResult<Plan> {
        self.opened(|| Plan::open(&self.path, &self.all_changes(), &self.texts(), program()))
    }

    fn opened(&self, open: impl FnOnce() -> Result<Plan, Failure> + Send) -> PyResult<Plan> {
        let plan = Python::attach(|py| py.detach(open));
        let placed = || self.problems().err().filter(|all| all.has_errors());
        plan.map_err(|failure| placed().map_or_else(|| failed(failure), |all| refused(&all)))
    }

    /// All changes as one list: of what the base brings, what the study does not set.
    fn all_changes(&self) -> Vec<String> {
        let set = study_text(&self.path, &self.texts()).map(|text| text.section.set).unwrap_or_default();
        let is_set = |change: &String| change.split_once('=').is_some_and(|(path, _)| set.contains_key(path.trim()));
        self.before.iter().filter(|change| !is_set(change)).chain(&self.changes).cloned().collect()
    }

    /// Whether it says what to search for, and no design.
    fn is_search(&self) -> bool {
        let text = study_text(&self.path, &self.texts());
        text.is_ok_and(|text| {
            text.section.design.is_none() && (text.section.fit.is_some() || text.section.optimise.is_some())
        })
    }

    /// What is wrong with its words, with places.
    fn problems(&self) -> Result<(), Diagnostics> {
        let (texts, none) = (self.texts(), |_| Diagnostics::new());
        let read = |by, name: &str| texts.get(by, name);
        let bytes = read(NamedBy::CommandLine, &file_name(&self.path)).map_err(none)?;
        let text = StudyText::read_bytes(&bytes, format_of(&self.path), &self.path.display().to_string())?;
        let base = self.path.parent().unwrap_or(Path::new("")).join(text.base());
        let bytes = read(NamedBy::StudyAsBase, text.base()).map_err(none)?;
        let mut draft = Draft::read_bytes(&bytes, format_of(&base), &base.display().to_string())?;
        self.before.iter().try_for_each(|change| draft.set(change))?;
        text.bind(draft, &self.changes, &|name| texts.get(NamedBy::Study, name)).map(drop)
    }
}

/// Opens a path, a dict, or a text; the scenario that a dict brings itself is its base.
fn origin(source: &Bound<'_, PyAny>, folder: &Path, given: Option<&Bound<'_, PyAny>>) -> PyResult<Origin> {
    let Ok(dict) = source.cast::<PyDict>() else {
        let path: PathBuf = source.extract()?;
        // an error of the operating system is one of Python's
        std::fs::metadata(&path)?;
        return Ok(Origin { path, texts: Vec::new(), before: Vec::new(), changes: changes(given)? });
    };
    let (dict, mut bases, mut before) = (dict.copy()?, Vec::new(), Vec::new());
    let is_name =
        |base: &Bound<'_, PyAny>| base.is_instance_of::<PyString>() || base.hasattr("__fspath__").unwrap_or_default();
    if let Some(base) = dict.get_item("base")?.filter(|base| !is_name(base)) {
        let base = scenario_of(&base)?;
        if base.has_forces() {
            let found = "a study of a scenario with forces of Python's; expected one without, or `run` for each";
            return Err(plain(found));
        }
        let name = std::path::absolute(&base.text.path)?.display().to_string();
        dict.set_item("base", &name)?;
        bases.push((NamedBy::StudyAsBase, name, base.text.bytes.clone()));
        before = base.changes;
    }
    let name = named("study", "json")?;
    // the study is the first of its texts
    let texts = [vec![(NamedBy::CommandLine, name.clone(), json(&dict)?.into_bytes())], bases].concat();
    Ok(Origin { path: folder.join(name), texts, before, changes: changes(given)? })
}

fn scenario_of(base: &Bound<'_, PyAny>) -> PyResult<Scenario> {
    match base.cast::<Scenario>() {
        Ok(scenario) => Ok(scenario.borrow().clone()),
        Err(_) => Scenario::new(base),
    }
}

#[pymethods]
impl Study {
    /// `source`: the study's file, or a dict of its keys, whose `base` may be a Scenario or a dict; files of a dict are
    /// searched in `folder`. `changes`: values of its base scenario, a dict by path or a list of texts as `--set` has
    /// them.
    #[new]
    #[pyo3(signature = (source, changes=None, folder=PathBuf::new()))]
    fn new(source: &Bound<'_, PyAny>, changes: Option<&Bound<'_, PyAny>>, folder: PathBuf) -> PyResult<Self> {
        origin(source, &folder, changes)?.study()
    }

    /// A study from `text`, `format` "toml" or "json"; files that it refers to are searched in `folder`. `changes` as
    /// of `Study`.
    #[staticmethod]
    #[pyo3(signature = (text, format="toml", folder=PathBuf::new(), changes=None))]
    fn from_text(text: &str, format: &str, folder: PathBuf, changes: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let name = named("study", format)?;
        let texts = vec![(NamedBy::CommandLine, name.clone(), text.as_bytes().to_vec())];
        Origin { path: folder.join(name), texts, before: Vec::new(), changes: crate::convert::changes(changes)? }
            .study()
    }

    fn __len__(&self) -> PyResult<usize> {
        Ok(self.plan()?.study.len() as usize)
    }

    /// The parameters of run `index` by name.
    fn sample<'py>(&self, py: Python<'py>, index: u64) -> PyResult<Bound<'py, PyDict>> {
        let study = &self.at(index)?.study;
        let dict = PyDict::new(py);
        for setting in study.sample(index) {
            let name = &study.parameters[setting.parameter].name;
            match setting.value {
                Value::Number(number) => dict.set_item(name, number)?,
                Value::Text(text) => dict.set_item(name, text)?,
                Value::Truth(truth) => dict.set_item(name, truth)?,
                Value::Base => dict.set_item(name, py.None())?,
            }
        }
        Ok(dict)
    }

    /// The scenario of run `index`.
    fn scenario(&self, index: u64) -> PyResult<Scenario> {
        let (args, bytes) = self.at(index)?.command(index);
        Scenario::of(Text::new(args.scenario, bytes), args.overrides)
    }

    /// Columns of inputs and figures of the table: dicts of `name`, `unit`, `role`.
    #[getter]
    fn columns(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        json_of(&self.plan()?.manifest.columns, py)
    }

    /// Runs all of it on `threads` threads, all cores if None, and gives a table by columns, those of `occupant sweep`:
    /// `index`, the parameters as `input.NAME` in SI units, `status`, `reason`, `caveats`, every figure of a run in its
    /// SI unit, NaN where there is none, `wall_time_s`, `kernel`. The rows are the same to the bit for any number of
    /// threads. `progress`: True for a bar of tqdm, or a function of the number of runs done and of all.
    #[pyo3(signature = (threads=None, progress=None))]
    fn run<'py>(
        &self,
        py: Python<'py>,
        threads: Option<usize>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let plan = self.plan()?;
        let rows = many(py, &Samples(plan), plan.study.len(), threads, progress, |row: &Row| row.index)?;
        let (table, all) = (Table::new(py, rows.iter())?, &plan.manifest.columns);
        let is_input = |role| role != Role::Figure;
        let inputs = all.iter().take_while(|column| is_input(column.role)).count();
        for (at, column) in all.iter().enumerate() {
            if at == inputs {
                table.add_ends(rows.iter())?;
            }
            let number = |row: &Row| row.cells[at].number().unwrap_or(f64::NAN);
            match column.role {
                Role::InputText => {
                    let cells = rows.iter().map(|row| cell(py, &row.cells[at]));
                    table.add(&column.name, cells.collect::<PyResult<_>>()?)?;
                }
                Role::Input | Role::Figure => table.add_numbers(&column.name, rows.iter().map(number).collect())?,
            }
        }
        table.finish(rows.iter())
    }

    /// Fits the parameters to tests, as `occupant fit`: the study has a section `fit`. `tests`: files for tests that
    /// name none; `maps`: assignments of their columns, 'column[unit]=channel'. What it writes goes into `folder`,
    /// where an interrupted fit is resumed unless `restart`; nothing is kept without one. `threads` and `progress` as
    /// of `run`. Gives what `occupant fit --json` prints.
    #[pyo3(signature = (tests=Vec::new(), maps=Vec::new(), folder=None, restart=false, threads=None, progress=None))]
    #[allow(clippy::too_many_arguments)]
    fn fit(
        &self,
        py: Python<'_>,
        tests: Vec<PathBuf>,
        maps: Vec<String>,
        folder: Option<PathBuf>,
        restart: bool,
        threads: Option<usize>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        let maps = maps.iter().map(|text| text.parse()).collect::<Result<Vec<MapArgument>, _>>().map_err(plain)?;
        self.search(py, folder, (restart, threads, progress), |folder, work| {
            let given = Given { files: &tests, maps: &maps, overrides: &self.of.all_changes() };
            let fitting = Fitting::of(&self.of.path, &given, &self.of.texts(), program())?;
            occupant_jobs::fit::fit(&fitting, &Folder::of_fit(folder), work)
        })
    }

    /// Finds the parameters with which a measure is smallest, as `occupant optimise`: the study has a section
    /// `optimise`. `folder`, `restart`, `threads` and `progress` as of `fit`. Gives what `occupant optimise --json`
    /// prints.
    #[pyo3(signature = (folder=None, restart=false, threads=None, progress=None))]
    fn optimise(
        &self,
        py: Python<'_>,
        folder: Option<PathBuf>,
        restart: bool,
        threads: Option<usize>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        self.search(py, folder, (restart, threads, progress), |folder, work| {
            let optimising = Optimising::of(&self.of.path, &self.of.all_changes(), &self.of.texts(), program())?;
            occupant_jobs::optimise::optimise(&optimising, &Folder::of_optimum(folder), work)
        })
    }

    /// Runs all of it into `folder`, as `occupant sweep`: results.parquet, with `csv` results.csv too, and whole runs
    /// where `keep` says so ("all", "3, 17" or "worst 5 by head.peak"; as the study says if None). Runs of a study with
    /// a `rating` are rated: rating.xlsx, rating.json. An interrupted sweep is resumed unless `restart`. `threads` and
    /// `progress` as of `run`. Gives the words that the command prints.
    #[pyo3(signature = (folder, csv=false, keep=None, restart=false, threads=None, progress=None))]
    #[allow(clippy::too_many_arguments)]
    fn sweep(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        csv: bool,
        keep: Option<&str>,
        restart: bool,
        threads: Option<usize>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        self.plan()?;
        let (progress, plan) = (Progress::of(py, progress, "runs")?, self.of.kept_plan()?);
        let keep = chosen(keep, &plan).map_err(failed)?;
        work(py, progress, |interrupt| {
            plan.refuse_hopeless()?;
            let sweep = Sweep {
                csv: csv || plan.study.csv,
                folder: Folder::at(&folder),
                engine: engine(threads)?,
                kernel: None,
                interrupt: interrupt.clone(),
                restart,
                show: SHOW,
                units: Units::of_scenario(plan.study.base.units()),
                block: Block { samples: 0..plan.manifest.samples },
                wait: false,
                plan,
                keep,
            };
            Ok(sweep.run()?.1)
        })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (py, own) = (slf.py(), slf.get());
        let texts = PyList::empty(py);
        for (by, name, bytes) in own.texts() {
            texts.append((pythonize(py, &by)?, name, PyBytes::new(py, &bytes)))?;
        }
        let path = std::path::absolute(&own.of.path)?;
        let parts = (path, texts, own.of.before.clone(), own.of.changes.clone()).into_pyobject(py)?;
        Ok((slf.get_type().getattr("_restored")?, parts))
    }

    #[staticmethod]
    fn _restored(
        path: PathBuf,
        texts: Vec<(Bound<'_, PyAny>, String, Vec<u8>)>,
        before: Vec<String>,
        changes: Vec<String>,
    ) -> PyResult<Self> {
        let text = |(by, name, bytes): (Bound<'_, PyAny>, _, _)| Ok((depythonize(&by)?, name, bytes));
        let texts = texts.into_iter().map(text).collect::<PyResult<_>>()?;
        Origin { path, texts, before, changes }.study()
    }

    fn __repr__(&self) -> String {
        let runs =
            self.plan.as_ref().map_or_else(|| "a search".to_owned(), |plan| format!("{} runs", plan.study.len()));
        format!("<occupant.Study {:?}, {runs}>", self.of.path.display().to_string())
    }
}

impl Study {
    /// All that was read.
    fn texts(&self) -> Vec<(NamedBy, String, Vec<u8>)> {
        let Some(plan) = &self.plan else { return self.of.texts.clone() };
        let texts = plan.manifest.texts.iter().zip(&plan.texts);
        texts.map(|(text, bytes)| (text.by, text.name.clone(), bytes.clone())).collect()
    }

    /// Its samples; why it has none.
    fn plan(&self) -> PyResult<&Plan> {
        match &self.plan {
            Some(plan) => Ok(plan),
            None => Err(self.of.plan().err().unwrap_or_else(|| plain("the study had no design when it was read"))),
        }
    }

    /// The same if there is a run of this number.
    fn at(&self, index: u64) -> PyResult<&Plan> {
        let plan = self.plan()?;
        let length = plan.study.len();
        if index < length { Ok(plan) } else { Err(PyIndexError::new_err(format!("run {index} of {length}"))) }
    }

    /// A search in a folder, or in one that is removed at its end.
    fn search<T: Serialize + Send>(
        &self,
        py: Python<'_>,
        folder: Option<PathBuf>,
        (restart, threads, progress): (bool, Option<usize>, Option<&Bound<'_, PyAny>>),
        search: impl FnOnce(&Path, &Work<'_>) -> Result<T, Failure> + Send,
    ) -> PyResult<Py<PyAny>> {
        let progress = Progress::of(py, progress, "evaluations")?;
        let passing = folder.is_none().then(tempfile::tempdir).transpose()?;
        let folder = folder.or_else(|| passing.as_ref().map(|own| own.path().join("search"))).unwrap_or_default();
        let found = work(py, progress, |interrupt| {
            let engine = engine(threads)?;
            search(&folder, &Work { engine: &engine, interrupt, show: SHOW, restart, wait: false })
        });
        json_of(&found?, py)
    }
}

/// Writes the page of `occupant study report` on the sweep in `folder`: which inputs matter and how much, worst cases,
/// what can be quoted. `path`: the page, FOLDER/report.html if None, with its tables beside it; `to`: results, such as
/// "hic15" or "belts.*.peak", the customary ones if empty; `limits` beside those of rules, such as "hic15=700".
/// Existing files are replaced only with `force`. `progress`: True for a bar of tqdm, or a function of the number of
/// steps done and of all. Gives what the command prints with `--json`.
#[pyfunction]
#[pyo3(signature = (folder, path=None, to=Vec::new(), limits=Vec::new(), force=false, progress=None))]
pub(crate) fn study_report(
    py: Python<'_>,
    folder: PathBuf,
    path: Option<PathBuf>,
    to: Vec<String>,
    limits: Vec<String>,
    force: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    let progress = Progress::of(py, progress, "steps")?;
    let (is_unasked, at) = (path.is_none(), path.unwrap_or_else(|| folder.join("report.html")));
    let folders = [folder];
    let report = work(py, progress, |_| {
        let wanted = Wanted { folders: &folders, page: &at, to: &to, limits: &limits, force, is_unasked };
        let report = wanted.write(Units::of_scenario, SHOW)?;
        publish(&at, true, page(&report).as_bytes())?;
        Ok(report)
    });
    json_of(&answer(&report?), py)
}

/// Runs of a plan, without files.
struct Samples<'a>(&'a Plan);

impl Source for Samples<'_> {
    type Recorder = Summarizer;
    type Row = Row;
    type Error = Failure;

    fn begin(&self, index: u64) -> Result<(Model, Summarizer), NotBegun<Failure>> {
        self.0.refuse_excluded(index)?;
        Ok((self.0.open_sample(index)?.model, Summarizer::new()))
    }

    fn end(&self, run: Finished<Summarizer>) -> Result<Row, Failure> {
        let mut row = self.0.row(&run);
        if let Some(ran) = run.ran {
            self.0.fill(&mut row, &ran.recorder, &ran.model);
        }
        Ok(row)
    }
}

fn cell<'py>(py: Python<'py>, cell: &Cell) -> PyResult<Bound<'py, PyAny>> {
    Ok(match cell {
        Cell::Absent => py.None().into_bound(py),
        Cell::Number(number) => number.into_pyobject(py)?.into_any(),
        Cell::Text(text) => text.into_pyobject(py)?.into_any(),
    })
}
