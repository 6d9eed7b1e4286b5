//! What a finished or growing study says: which parameter matters, how much, how sure that is, and how to run it again.
//!
//! ```text
//! folder of a sweep ─ Opened ─ Samples (a table of inputs and responses) ─ Analysis of each response ─ page, Parquet
//! ```

pub mod analysis;
pub mod caution;
mod command;
mod describe;
mod extremes;
mod gather;
mod matters;
mod numbers;
mod open;
mod page;
mod pictures;
mod plots;
mod responses;
pub mod samples;
mod sections;
mod shown;
mod tables;

pub(crate) use open::{Opened, open};
pub(crate) use page::page;
pub(crate) use tables::{Tables, write as write_tables};

use crate::base::failure::Failure;
use analysis::Analysis;
use gather::Gathered;

/// Everything that a report says of a study.
pub(crate) struct Report {
    /// The folder it comes from.
    pub(crate) opened: Opened,
    gathered: Gathered,
    analyses: Vec<Analysis>,
    /// What a reader should know before trusting any number of it.
    pub(crate) notes: Vec<String>,
}

impl Report {
    /// Reads the rows and analyses the responses that `names` asks for, the customary ones for none.
    ///
    /// # Errors
    /// A name that is none; a journal that cannot be read.
    pub(crate) fn of(opened: Opened, names: &[String]) -> Result<Report, Failure> {
        let candidates = responses::candidates(&opened.manifest, names)?;
        let mut gathered = gather::gather(&opened, &candidates)?;
        if names.is_empty() {
            responses::keep_telling(&mut gathered);
        }
        let study = opened.plan.study();
        let count = gathered.samples.responses.len();
        let analyses = (0..count).map(|i| Analysis::of(&gathered.samples, i, study));
        Ok(Report { analyses: analyses.collect(), notes: caution::of_the_study(&opened, &gathered), gathered, opened })
    }
}
