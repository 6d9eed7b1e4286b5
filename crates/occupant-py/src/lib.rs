//! Occupant for Python: scenarios from files, texts and dicts, runs, studies; time histories as NumPy arrays.
//!
//! Holds no physics and no file format of its own: it hands Python's values to the crates below and theirs back. Runs
//! go on without Python's lock.

mod batch;
mod convert;
mod force;
mod live;
mod rating;
mod results;
mod run;
mod scenario;
mod study;
mod trouble;
mod work;

use pyo3::prelude::*;

#[pymodule]
mod _occupant {
    #[pymodule_export]
    use super::live::LiveRun;
    #[pymodule_export]
    use super::rating::rate;
    #[pymodule_export]
    use super::results::{compare, film, read, report, view};
    #[pymodule_export]
    use super::run::Run;
    #[pymodule_export]
    use super::scenario::Scenario;
    #[pymodule_export]
    use super::study::{Study, study_report};
    #[pymodule_export]
    use super::trouble::OccupantError;
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        super::work::hear();
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
